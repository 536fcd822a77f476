//! Libraries built with a sanitizer: their runtime has to be in the process from its start.

use std::fmt;

use super::ElfFacts;
use super::library_search::loaded_libraries;

/// A sanitizer of gcc or clang.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sanitizer {
    /// `-fsanitize=address`
    Address,
    /// `-fsanitize=undefined`
    Undefined,
    /// `-fsanitize=thread`
    Thread,
    /// `-fsanitize=memory`
    Memory,
    /// `-fsanitize=leak`
    Leak,
}

const ALL: [(Sanitizer, &str); 5] = [
    (Sanitizer::Address, "asan"),
    (Sanitizer::Thread, "tsan"),
    (Sanitizer::Memory, "msan"),
    (Sanitizer::Leak, "lsan"),
    (Sanitizer::Undefined, "ubsan"),
];

impl Sanitizer {
    fn short(self) -> &'static str {
        ALL.iter().find(|(sanitizer, _)| *sanitizer == self).map_or("", |(_, short)| short)
    }

    /// The words to put before the program's name so that the runtime is there from the start.
    pub(super) fn preload(self, runtime: &str) -> String {
        let short = self.short();
        // Rust's and the system's own one-time allocations are not the law's leaks.
        let options = if self == Self::Address { " ASAN_OPTIONS=detect_leaks=0" } else { "" };
        if runtime.starts_with("lib") && !runtime.contains("clang_rt") {
            format!("LD_PRELOAD=$(gcc -print-file-name=lib{short}.so){options}")
        } else {
            let suffix = if self == Self::Undefined { "ubsan_standalone" } else { short };
            let arch = std::env::consts::ARCH;
            format!("LD_PRELOAD=$(clang -print-file-name=libclang_rt.{suffix}-{arch}.so){options}")
        }
    }
}

impl fmt::Display for Sanitizer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Address => "address sanitizer",
            Self::Undefined => "undefined-behaviour sanitizer",
            Self::Thread => "thread sanitizer",
            Self::Memory => "memory sanitizer",
            Self::Leak => "leak sanitizer",
        })
    }
}

/// The first sanitizer whose runtime the library needs and this process does not have.
pub(super) fn runtime_wanted(elf: &ElfFacts) -> Option<(Sanitizer, String)> {
    let loaded = loaded_libraries();
    let present = |short: &str| loaded.iter().any(|path| is_runtime(&path.to_string_lossy(), short));
    ALL.iter().find_map(|(sanitizer, short)| {
        let library = elf.needed.iter().find(|name| is_runtime(name, short));
        // clang leaves the runtime out of shared libraries: only the calls into it show.
        let call = || elf.undefined.iter().find(|name| name.starts_with(&format!("__{short}_")));
        let wanted = library.or_else(call)?;
        (!present(short)).then(|| (*sanitizer, wanted.clone()))
    })
}

fn is_runtime(name: &str, short: &str) -> bool {
    let name = name.rsplit('/').next().unwrap_or(name);
    name.starts_with(&format!("lib{short}.so"))
        || name.starts_with("libclang_rt.") && name.contains(short) && (short != "asan" || !name.contains("hwasan"))
}
