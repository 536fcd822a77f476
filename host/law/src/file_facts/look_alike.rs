//! Names for files that are no shared library.

use std::fmt;
use std::path::Path;

use crate::build::Language;

/// What a file looks like that is not a shared library.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LookAlike {
    /// `!<arch>`: a static library.
    StaticArchive,
    /// ELF, relocatable.
    ObjectFile,
    /// ELF, executable, whether position-independent or not.
    Executable,
    /// ELF, core dump.
    CoreDump,
    /// Starts with `#!`.
    Script,
    /// A library's name, but text for the linker inside.
    LinkerScript,
    /// PE: `MZ`.
    WindowsProgram,
    /// Mach-O, thin or universal.
    AppleBinary,
    /// LLVM bitcode, as left by link-time optimisation.
    Bitcode,
    /// gzip, xz, zstd, bzip2 or zip.
    Compressed,
    /// Text whose name ends like source that can be built.
    Source {
        /// The language of the name's ending.
        language: Language,
    },
    /// Any other text.
    Text,
    /// None of these.
    Unknown,
}

impl LookAlike {
    /// Names a file by its first bytes, or `None` if it is ELF.
    pub(super) fn of_no_elf(path: &Path, head: &[u8]) -> Option<Self> {
        let starts = |magic: &[u8]| head.starts_with(magic);
        Some(if starts(b"\x7fELF") {
            return None;
        } else if starts(b"!<arch>\n") || starts(b"!<thin>\n") {
            Self::StaticArchive
        } else if starts(b"#!") {
            Self::Script
        } else if starts(b"MZ") {
            Self::WindowsProgram
        } else if [0xfeed_face_u32, 0xfeed_facf, 0xcafe_babe]
            .iter()
            .any(|magic| starts(&magic.to_be_bytes()) || starts(&magic.to_le_bytes()))
        {
            Self::AppleBinary
        } else if starts(b"BC\xc0\xde") {
            Self::Bitcode
        } else if [&b"\x1f\x8b"[..], b"\xfd7zXZ", b"\x28\xb5\x2f\xfd", b"BZh", b"PK\x03\x04"].iter().any(|m| starts(m))
        {
            Self::Compressed
        } else if is_text(head) {
            let text = String::from_utf8_lossy(head);
            match Language::of(path) {
                Some(language) => Self::Source { language },
                None if text.contains("GNU ld script") || text.contains("INPUT") && text.contains('(') => {
                    Self::LinkerScript
                }
                None => Self::Text,
            }
        } else {
            Self::Unknown
        })
    }

    /// What to do about it, as the rest of a sentence.
    pub(super) fn hint(&self) -> &'static str {
        match self {
            Self::Source { language: Language::Rust } => "; `wearlaw build` makes a library of its crate",
            Self::Source { .. } => "; `wearlaw build` makes a library of it",
            Self::ObjectFile => "; link it with -shared",
            Self::StaticArchive => "; link its objects with -shared",
            _ => "",
        }
    }
}

impl fmt::Display for LookAlike {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::StaticArchive => "a static archive",
            Self::ObjectFile => "an object file",
            Self::Executable => "an executable program",
            Self::CoreDump => "a core dump",
            Self::Script => "a script",
            Self::LinkerScript => "a linker script",
            Self::WindowsProgram => "a Windows program or DLL (PE)",
            Self::AppleBinary => "a macOS binary (Mach-O)",
            Self::Bitcode => "LLVM bitcode",
            Self::Compressed => "a compressed file",
            Self::Source { language } => return write!(f, "{language} source"),
            Self::Text => "text",
            Self::Unknown => "data of no known kind",
        })
    }
}

fn is_text(head: &[u8]) -> bool {
    // A character may be cut in two at the end of the bytes read.
    let whole = match std::str::from_utf8(head) {
        Ok(_) => true,
        Err(error) => error.error_len().is_none(),
    };
    whole && !head.iter().any(|&b| b < 0x20 && !b"\t\n\r\x0c".contains(&b))
}
