//! The committed headers: `wearlaw.h` is what cbindgen makes of the ABI today, and every header stands alone.

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// What cbindgen makes of some sources of a crate.
fn generated(member: &str, sources: &[&str]) -> String {
    let member = root().join(member);
    let config = cbindgen::Config::from_file(member.join("cbindgen.toml")).expect("cbindgen.toml is readable");
    let builder = cbindgen::Builder::new().with_config(config);
    let builder = sources.iter().fold(builder, |builder, source| builder.with_src(member.join("src").join(source)));
    let mut text = Vec::new();
    builder.generate().expect("cbindgen reads the sources").write(&mut text);
    String::from_utf8(text).expect("a header is text")
}

/// Compares a committed header with what its crate gives now, or writes it anew.
fn assert_generated(header: &str, member: &str, sources: &[&str]) {
    let path = root().join("include").join(header);
    let now = generated(member, sources);
    if std::env::var_os("WEARLAW_REGENERATE").is_some() {
        std::fs::write(&path, &now).expect("the header can be written");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("include/{header}: {error}"));
    assert!(
        committed == now,
        "include/{header} is out of step with {member}; run WEARLAW_REGENERATE=1 cargo test --test headers"
    );
}

#[test]
fn wearlaw_h_is_what_cbindgen_generates() {
    let sources = ["version", "status", "masks", "views", "descriptor"].map(|name| format!("abi/{name}.rs"));
    assert_generated("wearlaw.h", "plugin-api", &sources.each_ref().map(String::as_str));
}

#[test]
fn wearlaw_host_h_is_what_cbindgen_generates() {
    assert_generated("wearlaw_host.h", "host/c", &["abi.rs", "functions.rs"]);
}

/// What a law must say before it includes the point-wise helper in C.
const MINIMAL: &str = "#define LAW_NAME \"a\"\n#define LAW_VERSION \"1\"\n#define LAW_SUMMARY \"a law\"\n";

/// Compiles a text that includes `header` once or twice, with every warning an error.
fn assert_compiles(header: &str, before: &str, after: &str, standard: &str) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cpp = standard.starts_with("c++");
    let (variable, compiler, name) = if cpp { ("CXX", "c++", "alone.cpp") } else { ("CC", "cc", "alone.c") };
    for times in [1, 2] {
        let source = folder.path().join(name);
        let include = format!("#include \"{header}\"\n").repeat(times);
        std::fs::write(&source, format!("{before}{include}{after}")).expect("a writable folder");
        for optimise in ["-O0", "-O3"] {
            let output = Command::new(std::env::var(variable).unwrap_or_else(|_| compiler.into()))
                .args(["-Wall", "-Wextra", "-pedantic", "-Werror", "-c", optimise])
                .arg(format!("-std={standard}"))
                .arg("-I")
                .arg(root().join("include"))
                .arg("-o")
                .arg(folder.path().join("alone.o"))
                .arg(&source)
                .output()
                .expect("the compiler starts");
            assert!(
                output.status.success(),
                "{header} as {standard}, included {times} times: {}",
                String::from_utf8_lossy(&output.stderr)
            );
        }
    }
}

#[test]
fn every_header_compiles_alone_and_twice() {
    let point = "WL_POINT { out->increment = in->dt; return WL_OK; }\n";
    let class = "struct A : wearlaw::Law<A> {\n\
                 static wearlaw::About about() { return {\"a\", \"1\", \"a law\"}; }\n\
                 int32_t point(const In &in, const C &, const S &, Out &out) const {\n\
                 out.increment = in.dt; return WL_OK; } };\nWEARLAW_EXPORT(A)\n";
    for standard in ["c99", "c11"] {
        assert_compiles("wearlaw.h", "", "typedef int nothing;\n", standard);
        assert_compiles("wearlaw_host.h", "", "typedef int nothing;\n", standard);
        assert_compiles("wearlaw_point.h", MINIMAL, point, standard);
        assert_compiles("wearlaw_point_loop.h", MINIMAL, point, standard);
    }
    for standard in ["c++11", "c++17"] {
        assert_compiles("wearlaw.h", "", "", standard);
        assert_compiles("wearlaw_host.h", "", "", standard);
        for header in ["wearlaw.hpp", "wearlaw_loop.hpp", "wearlaw_entry.hpp"] {
            assert_compiles(header, "", class, standard);
        }
    }
}

#[test]
fn every_header_is_tested_alone() {
    let known = [
        "wearlaw.h",
        "wearlaw.hpp",
        "wearlaw_entry.hpp",
        "wearlaw_host.h",
        "wearlaw_loop.hpp",
        "wearlaw_point.h",
        "wearlaw_point_loop.h",
    ];
    let entries = std::fs::read_dir(root().join("include")).expect("include/ is there");
    let names = entries.map(|e| e.expect("an entry").file_name().into_string().expect("a name"));
    let mut names: Vec<String> = names.filter(|n| n.ends_with(".h") || n.ends_with(".hpp")).collect();
    names.sort();
    assert_eq!(names, known);
}

#[test]
fn fortran_sources_stay_within_132_columns() {
    for name in ["wearlaw.f90", "wearlaw_host.f90", "wearlaw_point.inc", "wearlaw_point_loop.inc"] {
        let text = std::fs::read_to_string(root().join("include").join(name)).expect("it is there");
        let longest = text.lines().map(str::len).max();
        assert!(longest <= Some(132), "{name}: a line of {longest:?}");
    }
}
