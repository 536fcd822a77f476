//! What a library needs from others: libraries, sanitizer runtimes, symbols.

use super::tests::{Bench, ENTRY};
use super::{FileFacts, FileFactsError, LinkerRefusal};
use std::fs;
use std::path::Path;

#[test]
fn a_missing_library_is_named_and_a_present_one_is_found() {
    let bench = Bench::new();
    fs::create_dir(bench.path("sub")).unwrap();
    bench.compile("sub/libhelp.so", "int help(void) { return 0; }\n", &[]);
    let from = format!("-L{}", bench.path("sub").display());
    let source = format!("{ENTRY}int help(void);\nint use(void) {{ return help(); }}\n");
    let said = bench.refusal(&bench.compile("alone.so", &source, &[&from, "-lhelp"]));
    assert!(said.starts_with("`FILE` needs the library `libhelp.so`, which is not there (searched: /"), "{said}");
    for rpath in ["-Wl,-rpath,$ORIGIN/sub", "-Wl,--disable-new-dtags,-rpath,${ORIGIN}/sub"] {
        FileFacts::read(bench.compile("with.so", &source, &[&from, "-lhelp", rpath])).unwrap();
    }
    // What cannot be told is left to the linker.
    FileFacts::read(bench.compile("doubt.so", &source, &[&from, "-lhelp", "-Wl,-rpath,/x/$LIB"])).unwrap();
}

#[test]
fn a_sanitized_library_is_refused_with_the_command_that_helps() {
    let bench = Bench::new();
    for (short, name) in
        [("asan", "address sanitizer"), ("ubsan", "undefined-behaviour sanitizer"), ("tsan", "thread sanitizer")]
    {
        // A runtime of that name, so that the test needs none installed.
        bench.compile(
            &format!("lib{short}.so"),
            "int rt(void) { return 0; }\n",
            &[&format!("-Wl,-soname,lib{short}.so.8")],
        );
        let from = format!("-L{}", bench.folder.path().display());
        let source = format!("{ENTRY}int rt(void);\nint use(void) {{ return rt(); }}\n");
        let said = bench.refusal(&bench.compile("law.so", &source, &[&from, &format!("-l{short}")]));
        assert!(said.contains(name) && said.contains(&format!("lib{short}.so.8")), "{said}");
        assert!(said.contains(&format!("LD_PRELOAD=$(gcc -print-file-name=lib{short}.so)")), "{said}");
    }
    let clang = format!("{ENTRY}void __asan_init(void);\nvoid use(void) {{ __asan_init(); }}\n");
    let said = bench.refusal(&bench.compile("clang.so", &clang, &[]));
    assert!(said.contains("clang -print-file-name=libclang_rt.asan-"), "{said}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_runtime_that_is_in_the_process_is_enough() {
    const TEST: &str = "file_facts::tests_needs::a_runtime_that_is_in_the_process_is_enough";
    if let Some(law) = std::env::var_os("WEARLAW_TEST_SANITIZED") {
        FileFacts::read(Path::new(&law)).unwrap();
        return;
    }
    let bench = Bench::new();
    // A runtime of that name, so that the test needs none installed.
    let runtime = bench.compile("libtsan.so", "int rt(void) { return 0; }\n", &["-Wl,-soname,libtsan.so"]);
    let from = format!("-L{}", bench.folder.path().display());
    let source = format!("{ENTRY}int rt(void);\nint use(void) {{ return rt(); }}\n");
    let law = bench.compile("law.so", &source, &[&from, "-ltsan"]);
    assert!(bench.refusal(&law).contains("thread sanitizer"));
    let output = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["--exact", TEST, "--nocapture"])
        .env("WEARLAW_TEST_SANITIZED", &law)
        .env("LD_PRELOAD", &runtime)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("1 passed"), "{said}{}", String::from_utf8_lossy(&output.stderr));
}

#[cfg(target_os = "linux")]
#[test]
fn what_the_linker_says_is_put_into_words() {
    let bench = Bench::new();
    let load = |library: &Path| {
        let facts = FileFacts::read(library).unwrap();
        // The test's own libraries, which the linker refuses before any of their code runs.
        let said = super::tests_load::refusal_of(library);
        assert!(!bench.path("ran").exists());
        LinkerRefusal::from_error(&facts, &said)
    };
    let source = format!("{ENTRY}int nowhere(void);\nint use(void) {{ return nowhere(); }}\n");
    let refused = load(&bench.compile("symbol.so", &source, &[]));
    assert!(matches!(&refused, LinkerRefusal::MissingSymbol { symbol, .. } if symbol == "nowhere"), "{refused}");
    assert!(refused.to_string().contains("libc.so.6"), "{refused}");

    bench.compile("libdeep.so", "int deep(void) { return 0; }\n", &[]);
    let from = format!("-L{}", bench.folder.path().display());
    let middle = "int deep(void);\nint middle(void) { return deep(); }\n";
    bench.compile("libmiddle.so", middle, &[&from, "-ldeep"]);
    let source = format!("{ENTRY}int middle(void);\nint use(void) {{ return middle(); }}\n");
    let flags = [&from, "-lmiddle", "-Wl,-rpath,$ORIGIN", "-Wl,--allow-shlib-undefined"];
    let law = bench.compile("law.so", &source, &flags);
    fs::remove_file(bench.path("libdeep.so")).unwrap();
    let refused = load(&law);
    assert!(matches!(&refused, LinkerRefusal::MissingLibrary { library, .. } if library == "libdeep.so"), "{refused}");

    let facts = FileFacts::read(&law).unwrap_or_else(|error: FileFactsError| panic!("{error}"));
    let newer = "/lib/libm.so.6: version `GLIBC_9.99' not found (required by /x/law.so)";
    let said = LinkerRefusal::from_message(&facts, newer).to_string();
    assert!(said.contains("needs `GLIBC_9.99` of `/lib/libm.so.6`"), "{said}");
}
