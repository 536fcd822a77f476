//! Real builds of small sources.

use super::{BuildError, BuildRequest, Compilers, build};
use crate::file_facts::FileFacts;
use std::fs;
use std::path::{Path, PathBuf};

pub(super) fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, text).unwrap();
    path
}

/// A request for some sources with the output `law.so` in the same folder.
fn request(folder: &Path, sources: &[(&str, &str)]) -> BuildRequest {
    BuildRequest {
        sources: sources.iter().map(|(name, text)| write(folder, name, text)).collect(),
        output: Some(folder.join("law.so")),
        ..BuildRequest::default()
    }
}

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

const C: &str = "#include <math.h>\nint wearlaw_entry_1(int i) { return i + (int)sqrt((double)i); }\n";
const CPP: &str = "#include <vector>\nextern \"C\" int of_cpp(int n) { return (int)std::vector<int>(n).size(); }\n";
const FORTRAN: &str = "function wearlaw_entry_1(i) bind(c) result(r)\n  use iso_c_binding\n  integer(c_int), value :: i\n  \
                       integer(c_int) :: r\n  r = i + 1\nend function\n";

fn has_gfortran(test: &str) -> bool {
    let found = std::process::Command::new("gfortran").arg("--version").output().is_ok();
    if !found {
        println!("NOT RUN: {test}: gfortran missing");
    }
    found
}

#[test]
fn c_becomes_a_library() {
    let folder = tempfile::tempdir().unwrap();
    let built = build(&request(folder.path(), &[("law.c", C)])).unwrap();
    assert_eq!(built.library, folder.path().join("law.so"));
    assert!(FileFacts::read(&built.library).unwrap().elf.has_entry);
    assert_eq!(built.commands.len(), 2, "{:?}", built.commands);
    for flag in ["-O3", "-fPIC", "-Wall", "-ffp-contract=off"] {
        assert!(built.commands[0].contains(flag), "{flag} in {}", built.commands[0]);
    }
    assert!(built.seconds > 0.0 && built.messages.is_empty(), "{}", built.messages);
    assert_eq!(names_in(folder.path()), ["law.c", "law.so"], "nothing else is left");
}

#[test]
fn c_and_cpp_go_together() {
    let folder = tempfile::tempdir().unwrap();
    let built = build(&request(folder.path(), &[("law.c", C), ("more.cpp", CPP)])).unwrap();
    let facts = FileFacts::read(&built.library).unwrap();
    assert!(facts.elf.has_entry && facts.elf.needed.iter().any(|name| name.starts_with("libstdc++")));
    assert_eq!(built.commands.len(), 3);
}

#[test]
fn the_same_source_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let request = request(folder.path(), &[("law.c", C)]);
    let first = FileFacts::read(build(&request).unwrap().library).unwrap();
    let second = FileFacts::read(build(&request).unwrap().library).unwrap();
    assert_eq!(first.sha256, second.sha256);
}

#[test]
fn own_headers_come_before_the_carried_ones_and_flags_last() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "mine/mine.h", "#define MINE 7\n");
    let source = "#include \"mine.h\"\n#if MINE != 7 || LAST != 3\n#error not reached\n#endif\nint wearlaw_entry_1(int i) { return i; }\n";
    let mut request = request(folder.path(), &[("law.c", source)]);
    request.include_dirs = vec![folder.path().join("mine")];
    request.extra_flags = vec!["-DLAST=3".into()];
    build(&request).unwrap();
}

#[test]
fn fortran_becomes_a_library() {
    if !has_gfortran("fortran_becomes_a_library") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let built = build(&request(folder.path(), &[("law.f90", FORTRAN), ("more.cpp", CPP)])).unwrap();
    assert!(FileFacts::read(&built.library).unwrap().elf.has_entry);
    assert_eq!(names_in(folder.path()), ["law.f90", "law.so", "more.cpp"], "no .mod file is left");
}

#[cfg(unix)]
#[test]
fn fortran_is_called_as_it_should_be() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    // Stands in for gfortran: writes what it is asked to write, so that the order of calls shows without it.
    let fake = write(
        folder.path(),
        "fc",
        "#!/bin/sh\nwhile [ $# -gt 1 ]; do shift; [ \"$1\" = -o ] && echo made > \"$2\"; done; exit 0\n",
    );
    fs::set_permissions(&fake, fs::Permissions::from_mode(0o755)).unwrap();
    let mut request = request(folder.path(), &[("law.f90", FORTRAN)]);
    request.compilers.fortran = Some(fake.into());
    let built = build(&request).unwrap();
    assert_eq!(fs::read_to_string(&built.library).unwrap(), "made\n");
    let own = built.commands.iter().position(|line| line.contains("/law.f90") && line.contains("-c ")).unwrap();
    let module = super::CARRIED.iter().filter(|(name, _)| name.ends_with(".f90")).count();
    assert!(own >= module && built.commands[own].contains(" -J ") && built.commands[own].contains("-O3 -fPIC"));
    assert!(built.commands.last().unwrap().contains("-shared"));
}

#[test]
fn messages_are_kept_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let warned =
        build(&request(folder.path(), &[("warn.c", "static int unused;\nint wearlaw_entry_1(int i) { return i; }\n")]));
    assert!(warned.unwrap().messages.contains("unused"));

    let before = fs::read(folder.path().join("law.so")).unwrap();
    let failed = build(&request(folder.path(), &[("bad.c", "int f( { return no_such_name; }\n")])).unwrap_err();
    assert!(failed.messages().contains("bad.c:1"), "{}", failed.messages());
    assert!(failed.to_string().contains("exit code 1"), "{failed}");
    assert_eq!(fs::read(folder.path().join("law.so")).unwrap(), before, "the library before it stays");
    assert_eq!(names_in(folder.path()), ["bad.c", "law.so", "warn.c"]);
}

#[test]
fn a_missing_symbol_shows_when_linking() {
    let folder = tempfile::tempdir().unwrap();
    let source = "int nobody_has_this(int);\nint wearlaw_entry_1(int i) { return nobody_has_this(i); }\n";
    let failed = build(&request(folder.path(), &[("law.c", source)])).unwrap_err();
    assert!(failed.messages().contains("nobody_has_this"), "{failed}: {}", failed.messages());
}

#[test]
fn of_many_errors_in_fortran_the_first_few_are_told() {
    if !has_gfortran("of_many_errors_in_fortran_the_first_few_are_told") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let source = FORTRAN.replace("r = i + 1", "a = 1\n  b = 2\n  d = 3\n  e = 4\n  f = 5\n  r = i + 1");
    let source = source.replace("use iso_c_binding\n", "use iso_c_binding\n  implicit none\n");
    let failed = build(&request(folder.path(), &[("law.f90", &source)])).unwrap_err();
    let told = failed.messages().matches("has no IMPLICIT type").count();
    assert!((1..=3).contains(&told), "{told} of 5: {}", failed.messages());
}

#[test]
fn a_missing_compiler_is_named_with_its_package() {
    let folder = tempfile::tempdir().unwrap();
    let missing = |name: &str| Some(format!("/nonexistent/{name}").into());
    let compilers =
        Compilers { c: missing("cc"), cpp: missing("c++"), fortran: missing("fc"), cargo: missing("cargo") };
    let crate_files: [(&str, &str); 1] = [("krate/Cargo.toml", "[package]\nname = \"a\"\n")];
    let sources = [
        (("law.c", C), "gcc"),
        (("law.cpp", CPP), "g++"),
        (("law.f90", FORTRAN), "gfortran"),
        (crate_files[0], "cargo"),
    ];
    for (source, package) in sources {
        let mut request = request(folder.path(), &[source]);
        request.compilers = compilers.clone();
        let said = build(&request).unwrap_err().to_string();
        assert!(said.contains("was not found") && said.contains("/nonexistent/"), "{said}");
        assert!(said.contains(&format!("apt install {package})")), "{said}");
    }
}

#[test]
fn requests_that_make_no_sense_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let said = |request: &BuildRequest| build(request).unwrap_err().to_string();
    assert!(said(&BuildRequest::default()).contains("no sources"));
    let refused = said(&request(folder.path(), &[("law.xyz", "")]));
    assert!(refused.contains("law.xyz") && refused.contains(".f90") && refused.contains(".c,"), "{refused}");
    assert!(said(&request(folder.path(), &[("law.rs", "")])).contains("expected its crate"));
    fs::create_dir(folder.path().join("empty")).unwrap();
    let missing = BuildRequest { sources: vec![folder.path().join("none.c")], ..BuildRequest::default() };
    assert!(matches!(build(&missing), Err(BuildError::SourceUnreadable { .. })));
    let empty = BuildRequest { sources: vec![folder.path().join("empty")], ..BuildRequest::default() };
    assert!(said(&empty).contains("no Cargo.toml"));
    let mixed = request(folder.path(), &[("law.c", C), ("krate/Cargo.toml", "")]);
    assert!(said(&mixed).contains("expected it alone"));
}

#[test]
fn an_output_that_cannot_be_written_is_named_before_compiling() {
    let folder = tempfile::tempdir().unwrap();
    let mut request = request(folder.path(), &[("law.c", "this does not compile")]);
    request.output = Some(folder.path().join("no/such/folder/law.so"));
    assert!(matches!(build(&request), Err(BuildError::OutputNotWritable { .. })));
    request.output = Some(folder.path().to_path_buf());
    assert!(build(&request).unwrap_err().to_string().contains("directory"));
}

/// Runs one test of this file in a process of its own, with environment variables of its own.
fn in_a_process_of_its_own(test: &str, variables: &[(&str, &str)]) {
    let output = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["--exact", &format!("build::tests::{test}"), "--nocapture"])
        .env("WEARLAW_TEST_INNER", "1")
        .envs(variables.iter().copied())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("1 passed"), "{said}{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn the_environment_names_the_compilers() {
    if std::env::var_os("WEARLAW_TEST_INNER").is_none() {
        let missing = [("CC", "/nonexistent/my-cc"), ("CXX", "/nonexistent/my-cxx"), ("FC", "/nonexistent/my-fc")];
        let flags = [("CFLAGS", "-DFROM_CFLAGS"), ("FFLAGS", "-DFROM_FFLAGS")];
        return in_a_process_of_its_own("the_environment_names_the_compilers", &[&missing[..], &flags].concat());
    }
    let folder = tempfile::tempdir().unwrap();
    for (source, name) in [(("law.c", C), "my-cc"), (("law.cpp", CPP), "my-cxx"), (("law.f90", FORTRAN), "my-fc")] {
        let said = build(&request(folder.path(), &[source])).unwrap_err().to_string();
        assert!(said.contains(&format!("/nonexistent/{name}")) && said.contains("was not found"), "{said}");
    }
    let mut request =
        request(folder.path(), &[("flagged.c", "#ifndef FROM_CFLAGS\n#error\n#endif\nint wearlaw_entry_1;\n")]);
    request.compilers.c = Some("cc".into());
    build(&request).unwrap();
}
