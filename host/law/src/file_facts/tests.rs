//! Real files of every wrong kind. Each library carries a constructor that writes a file; none may run.

use super::{FileFacts, PinMismatch, check_pin};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(super) const ENTRY: &str = "int wearlaw_entry_1(int i, const void *host, void *law) { return 1; }\n";

/// A folder with a library whose constructor writes `folder/ran`.
pub(super) struct Bench {
    pub(super) folder: tempfile::TempDir,
}

impl Bench {
    pub(super) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(super) fn compile(&self, name: &str, source: &str, flags: &[&str]) -> PathBuf {
        let (file, library) = (self.path(&format!("{name}.c")), self.path(name));
        let constructor = format!(
            "#include <stdio.h>\n__attribute__((constructor)) static void ran(void) {{\n  FILE *f = fopen({:?}, \"w\");\n  \
             if (f) fclose(f);\n}}\n",
            self.path("ran")
        );
        fs::write(&file, constructor + source).unwrap();
        let output =
            Command::new("cc").args(["-w", "-shared", "-fPIC", "-o"]).arg(&library).arg(&file).args(flags).output();
        let output = output.unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        library
    }

    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        fs::write(self.path(name), bytes).unwrap();
        self.path(name)
    }

    /// A good library with bytes replaced at some places.
    fn patched(&self, name: &str, patches: &[(usize, u8)]) -> PathBuf {
        let mut bytes = fs::read(self.compile("whole.so", ENTRY, &[])).unwrap();
        for &(place, byte) in patches {
            bytes[place] = byte;
        }
        self.file(name, &bytes)
    }

    /// The refusal's one sentence; no code of the file has run.
    pub(super) fn refusal(&self, path: &Path) -> String {
        let said = FileFacts::read(path).unwrap_err().to_string();
        assert!(!self.path("ran").exists(), "code of {} has run", path.display());
        assert!(!said.contains('\n') && said.contains(&path.display().to_string()), "{said}");
        said.replace(&path.display().to_string(), "FILE")
    }
}

#[test]
fn a_good_library_says_what_it_is() {
    let bench = Bench::new();
    let source =
        format!("{ENTRY}int wearlaw_layout_1;\nint puts(const char *);\nint other(void) {{ return puts(\"\"); }}\n");
    let library = bench.compile("law.so", &source, &["-Wl,-soname,mine.so", "-Wl,-rpath,$ORIGIN/x:/y"]);
    let facts = FileFacts::read(&library).unwrap();
    let bytes = fs::read(&library).unwrap();
    assert_eq!(facts.size, bytes.len() as u64);
    let sum = Command::new("sha256sum").arg(&library).output().unwrap().stdout;
    assert_eq!(facts.sha256, String::from_utf8_lossy(&sum[..64]));
    assert_eq!((facts.elf.bits, facts.elf.architecture.as_str()), (64, super::elf_file::HOST_ARCHITECTURE));
    assert!(facts.elf.has_entry && facts.elf.has_layout && facts.elf.other_majors.is_empty());
    assert_eq!(facts.elf.soname.as_deref(), Some("mine.so"));
    assert!(facts.elf.exported_symbols >= 3, "{:?}", facts.elf);
    assert_eq!(facts.elf.runpath.len() + facts.elf.rpath.len(), 2);
    assert!(facts.elf.needed.iter().any(|name| name.starts_with("libc.so")));
    for symbol in ["puts", "fopen"] {
        assert!(facts.elf.undefined.iter().any(|name| name == symbol), "{symbol} in {:?}", facts.elf.undefined);
    }
    assert!(!bench.path("ran").exists());
}

#[test]
fn both_hash_tables_and_a_file_without_sections_are_read() {
    let bench = Bench::new();
    for style in ["sysv", "gnu", "both"] {
        let library = bench.compile(style, ENTRY, &[&format!("-Wl,--hash-style={style}")]);
        assert!(FileFacts::read(&library).unwrap().elf.has_entry, "{style}");
    }
    // e_shoff, e_shnum, e_shstrndx: the dynamic linker does not need sections either.
    let patches: Vec<_> = (0x28..0x30).chain(0x3c..0x40).map(|place| (place, 0)).collect();
    let facts = FileFacts::read(bench.patched("bare.so", &patches)).unwrap();
    assert!(facts.elf.has_entry && !facts.elf.undefined.is_empty());
}

#[test]
fn what_is_no_file_is_refused() {
    let bench = Bench::new();
    assert_eq!(bench.refusal(&bench.path("none.so")), "no file `FILE`, expected a wear-law library");
    fs::create_dir(bench.path("folder")).unwrap();
    assert_eq!(bench.refusal(&bench.path("folder")), "`FILE` is a folder, expected a wear-law library file");
    assert!(bench.refusal(Path::new("/dev/zero")).contains("device"));
    assert_eq!(bench.refusal(&bench.file("empty.so", b"")), "`FILE` is empty, expected a wear-law library");
}

#[test]
fn what_is_no_library_is_named() {
    let bench = Bench::new();
    let whole = bench.compile("whole.so", ENTRY, &[]);
    let source = bench.path("whole.so.c");
    let cc = |args: &[&str]| assert!(Command::new("cc").arg("-w").args(args).arg(&source).status().unwrap().success());
    let object = bench.path("law.o");
    cc(&["-c", "-fPIC", "-o", object.to_str().unwrap()]);
    assert!(bench.refusal(&object).contains("an object file; link it with -shared"));
    let archive = bench.path("law.a");
    assert!(Command::new("ar").arg("rcs").args([&archive, &object]).status().unwrap().success());
    assert!(bench.refusal(&archive).contains("a static archive"));
    let main = bench.file("main.c", b"int main(void) { return 0; }\n");
    for (name, flag) in [("pie", "-pie"), ("fixed", "-no-pie")] {
        let program = bench.path(name);
        cc(&["-fPIE", flag, "-o", program.to_str().unwrap(), main.to_str().unwrap()]);
        assert_eq!(bench.refusal(&program), "`FILE` is not a shared library but an executable program");
    }
    let cases: [(&str, &[u8], &str); 11] = [
        ("run.sh", b"#!/bin/sh\n", "a script"),
        ("law.c", b"int f(void);\n", "C source; `wearlaw build` makes a library of it"),
        ("law.f90", b"end\n", "Fortran source; `wearlaw build`"),
        ("notes.txt", "wear é\n".as_bytes(), "not a shared library but text"),
        ("libm.so", b"/* GNU ld script */\nGROUP ( /lib/libm.so.6 )\n", "a linker script"),
        ("law.dll", b"MZ\x90\0", "a Windows program or DLL"),
        ("law.dylib", b"\xcf\xfa\xed\xfe\x07\0\0\x01", "a macOS binary"),
        ("fat.dylib", b"\xca\xfe\xba\xbe\0\0\0\x02", "a macOS binary"),
        ("law.bc", b"BC\xc0\xde\x35", "LLVM bitcode"),
        ("law.so.gz", b"\x1f\x8b\x08\0", "a compressed file"),
        ("noise", b"\x01\x02\x03\x04", "data of no known kind"),
    ];
    for (name, bytes, words) in cases {
        let said = bench.refusal(&bench.file(name, bytes));
        assert!(said.contains(words), "{name}: {said}");
    }
    assert!(whole.exists());
}

#[test]
fn a_file_cut_short_is_told_at_any_length() {
    let bench = Bench::new();
    let bytes = fs::read(bench.compile("whole.so", ENTRY, &[])).unwrap();
    for length in [4, 17, 30, 63, 64, 100, 2000, bytes.len() / 2, bytes.len() - 1] {
        let said = bench.refusal(&bench.file("cut.so", &bytes[..length]));
        assert!(said.starts_with(&format!("`FILE` is cut short: it holds {length} bytes")), "{said}");
    }
    let said = bench.refusal(&bench.file("cut.so", &bytes[..bytes.len() - 1]));
    assert!(said.ends_with(&format!("its headers describe {}", bytes.len())), "{said}");
}

#[test]
fn garbled_headers_never_panic() {
    let bench = Bench::new();
    let bytes = fs::read(bench.compile("whole.so", ENTRY, &[])).unwrap();
    let dynamic = bytes.windows(8).position(|w| w == b"libc.so.").unwrap();
    let mut refused = 0;
    for place in (16..1200).step_by(3).chain(dynamic - 64..dynamic + 64) {
        for byte in [0, 0x7f, 0xff] {
            let mut bytes = bytes.clone();
            bytes[place] = byte;
            refused += usize::from(FileFacts::read(bench.file("garbled.so", &bytes)).is_err());
        }
    }
    assert!(refused > 100, "{refused}");
    assert!(!bench.path("ran").exists());
}

#[cfg(target_arch = "x86_64")]
#[test]
fn another_architecture_or_system_is_told() {
    let bench = Bench::new();
    let cases: [(&[(usize, u8)], &str); 6] = [
        (&[(18, 183)], "`FILE` is built for aarch64, this program runs on x86-64"),
        (&[(18, 243)], "`FILE` is built for risc-v, this program runs on x86-64"),
        (&[(18, 3), (4, 1)], "`FILE` is built for 32-bit x86, this program runs on x86-64"),
        (&[(4, 1)], "`FILE` is built for 32-bit x86-64, this program runs on x86-64"),
        (&[(5, 2), (18, 0), (19, 21)], "`FILE` is built for big-endian powerpc64, this program runs on x86-64"),
        (&[(7, 9)], "`FILE` is built for FreeBSD, this program runs on Linux"),
    ];
    for (patches, words) in cases {
        assert_eq!(bench.refusal(&bench.patched("other.so", patches)), words);
    }
}

#[test]
fn no_entry_and_other_versions_are_told() {
    let bench = Bench::new();
    let said = bench.refusal(&bench.compile("none.so", "int f(void) { return 0; }\n", &[]));
    assert_eq!(said, "`FILE` exports no function `wearlaw_entry_1`, so it is no wear law");
    let hidden = format!("__attribute__((visibility(\"hidden\"))) {ENTRY}");
    assert!(bench.refusal(&bench.compile("hidden.so", &hidden, &[])).contains("exports no function"));
    let said = bench.refusal(&bench.compile("next.so", "int wearlaw_entry_2(int i) { return i; }\n", &[]));
    assert_eq!(said, "`FILE` exports `wearlaw_entry_2`, this host speaks major version 1 (`wearlaw_entry_1`)");
    let both = bench.compile("both.so", &format!("{ENTRY}int wearlaw_entry_2(int i) {{ return i; }}\n"), &[]);
    assert_eq!(FileFacts::read(&both).unwrap().elf.other_majors, [2]);
    for (source, words) in [
        ("int _Z15wearlaw_entry_1i(int i) { return i; }\n", "declare the function extern \"C\""),
        ("int wearlaw_entry_1_(int i) { return i; }\n", "bind(c, name=\"wearlaw_entry_1\")"),
        ("int __law_MOD_wearlaw_entry_1(int i) { return i; }\n", "lies in a Fortran module"),
        ("int wearlaw_entry_1 = 7;\n", "is data, not a function"),
    ] {
        let said = bench.refusal(&bench.compile("near.so", source, &[]));
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn a_pin_is_held_to() {
    let bench = Bench::new();
    let facts = FileFacts::read(bench.compile("law.so", ENTRY, &[])).unwrap();
    assert_eq!(check_pin(&facts, &facts.sha256), Ok(()));
    assert_eq!(check_pin(&facts, &format!(" {}\n", facts.sha256.to_uppercase())), Ok(()));
    let other = check_pin(&facts, &"0".repeat(64)).unwrap_err();
    assert!(matches!(&other, PinMismatch::Differs { found, .. } if *found == facts.sha256));
    assert!(other.to_string().contains("expected 0000"), "{other}");
    assert!(check_pin(&facts, "abc").unwrap_err().to_string().contains("64 hexadecimal digits"));
}
