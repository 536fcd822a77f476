//! The laws and the commands printed in `include/README.md` work as printed, in a folder that has only `include/`.

#[path = "support/native.rs"]
mod native;
#[path = "support/rust_law.rs"]
mod rust_law;

use std::path::Path;
use std::process::Command;

/// The fenced blocks of one language, in order.
fn blocks<'a>(text: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("```{language}\n");
    text.split(&fence).skip(1).map(|rest| rest.split("```").next().expect("a block ends")).collect()
}

/// The block of a language that has this text in it.
fn block_with<'a>(text: &'a str, language: &str, marker: &str) -> &'a str {
    blocks(text, language).into_iter().find(|block| block.contains(marker)).expect("the page has such a block")
}

fn shell(folder: &Path, command: &str) -> String {
    let output = Command::new("sh").arg("-c").arg(command).current_dir(folder).output().expect("a shell");
    assert!(output.status.success(), "{command}\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// A folder with the law in C that has this text in it, built as `law.so`.
fn built(marker: &str) -> tempfile::TempDir {
    let text = std::fs::read_to_string(native::include().join("README.md")).expect("include/README.md is there");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("law.c");
    std::fs::write(&source, block_with(&text, "c", marker)).expect("a writable folder");
    native::try_compile(&source, &native::include(), &folder.path().join("law.so"), &[]).expect("it compiles");
    folder
}

/// A law that a reader copies is one that may be given to others.
fn passes_the_check(folder: &Path, name: &str) {
    let mut program = Command::new(env!("CARGO_BIN_EXE_wearlaw"));
    let output = program.args(["check", "law.so", "--quick", "-q"]).current_dir(folder).output().expect("it starts");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stdout));
}

#[test]
fn the_law_on_the_first_page_passes_the_check() {
    let text = std::fs::read_to_string(native::root().join("README.md")).expect("README.md is there");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("law.c");
    std::fs::write(&source, blocks(&text, "c")[0]).expect("a writable folder");
    native::try_compile(&source, &native::include(), &folder.path().join("law.so"), &[]).expect("it compiles");
    passes_the_check(folder.path(), "README.md");
}

#[test]
fn the_laws_of_the_readme_build_and_run_as_printed() {
    let text = std::fs::read_to_string(native::include().join("README.md")).expect("include/README.md is there");
    let commands = blocks(&text, "sh");
    let c = blocks(&text, "c");
    let mut laws = vec![("law.c", c[0], commands[0]), ("law.cpp", blocks(&text, "cpp")[0], commands[1])];
    if native::fortran("the_laws_of_the_readme_build_and_run_as_printed") {
        laws.push(("law.f90", blocks(&text, "fortran")[0], commands[2]));
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::os::unix::fs::symlink(native::include().canonicalize().expect("include/"), folder.path().join("include"))
        .expect("a writable folder");
    std::fs::write(folder.path().join("try.c"), block_with(&text, "c", "dlopen")).expect("a writable folder");
    // The table of known values on the page is one of theirs.
    let known = block_with(&text, "csv", "WL_OUT_OF_DOMAIN");
    std::fs::write(folder.path().join("expected.csv"), known).expect("a writable folder");
    for (name, source, command) in laws {
        std::fs::write(folder.path().join(name), source).expect("a writable folder");
        shell(folder.path(), command);
        let said = shell(folder.path(), commands[3]);
        assert!(said.starts_with("my-archard: status 0, increment 2.5"), "{name}: {said}");
        let value: f64 = said.trim().rsplit(' ').next().and_then(|w| w.parse().ok()).expect("a number");
        assert!((value - 2.5e-9).abs() < 1e-23, "{name}: {said}");
        passes_the_check(folder.path(), name);
        std::fs::remove_file(folder.path().join("law.so")).expect("it was built");
    }
}

#[test]
fn the_law_with_options_passes_the_whole_check_with_a_table() {
    let folder = built("\"tabulated\"");
    std::fs::write(folder.path().join("table.csv"), "0, 0\n1, 1\n2, 3\n5, 4\n").expect("a writable folder");
    std::fs::write(
        folder.path().join("expected.csv"),
        "k,p_0,pressure,slip,dt,increment\n2,1e6,5e5,0.1,1,0.1\n2,1e6,3.5e6,0.1,1,0.7\n2,1e6,9e9,0.1,1,0.8\n",
    )
    .expect("a writable folder");
    let check = |options: &[&str]| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_wearlaw"));
        program.args(["check", "law.so"]).args(options).current_dir(folder.path()).output().expect("it starts")
    };
    let output = check(&["--options", "table=table.csv"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("(3 rows,") && said.contains("beside instances with"), "{said}");
    let (without, wrong) = (check(&[]), check(&["--options", "table=other.csv"]));
    for output in [without, wrong] {
        let said = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("not tested: ") && said.contains("there is no file"), "{said}");
    }
}

#[test]
fn the_law_in_rust_builds_and_answers_as_printed() {
    let text = std::fs::read_to_string(native::include().join("README.md")).expect("include/README.md is there");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let library = rust_law::try_build(blocks(&text, "rust")[0], folder.path()).unwrap_or_else(|said| panic!("{said}"));
    std::fs::rename(library, folder.path().join("law.so")).expect("a writable folder");
    std::os::unix::fs::symlink(native::include().canonicalize().expect("include/"), folder.path().join("include"))
        .expect("a writable folder");
    std::fs::write(folder.path().join("try.c"), block_with(&text, "c", "dlopen")).expect("a writable folder");
    let said = shell(folder.path(), blocks(&text, "sh")[3]);
    assert!(said.starts_with("my-archard: status 0, increment 2.5"), "{said}");
    passes_the_check(folder.path(), "the law in Rust");
}

#[test]
fn the_law_with_a_state_passes_the_check_and_answers_alike_however_time_is_cut() {
    let folder = built("my-running-in");
    // K_inf s + (K_0 - K_inf) s_0 (1 - exp(-s / s_0)), over H and times p: 5e7 * (1e-5 + 9e-5 * 0.1 (1 - exp(-10))) / 2e9.
    let whole = 5e7 / 2e9 * (1e-5 + 9e-6 * -(-10.0_f64).exp_m1());
    let half = 5e7 / 2e9 * (5e-6 + 9e-6 * -(-5.0_f64).exp_m1());
    let rows = format!(
        "K_0,K_inf,s_0,H,pressure,slip,distance_start,increment,distance_end\n\
         1e-4,1e-5,0.1,2e9,5e7,1,0,{whole:e},1\n1e-4,1e-5,0.1,2e9,5e7,0.5,0,{half:e},0.5\n\
         1e-4,1e-5,0.1,2e9,5e7,0.5,0.5,{rest:e},1\n1e-4,1e-5,0.1,2e9,0,0.5,0.5,0,1\n",
        rest = whole - half
    );
    std::fs::write(folder.path().join("expected.csv"), rows).expect("a writable folder");
    passes_the_check(folder.path(), "the law with a state");
}

#[test]
fn units_are_named_alike_in_all_languages() {
    let read = |file: &str| std::fs::read_to_string(native::include().join(file)).expect("a file of include/");
    let (text, c, cpp, fortran) =
        (read("README.md"), read("wearlaw_point.h"), read("wearlaw.hpp"), read("wearlaw.f90").to_lowercase());
    let rust = std::fs::read_to_string(native::root().join("plugin-api/src/sdk/about.rs")).expect("the Rust side");
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("| `WL_") && line.contains("Unit::")).collect();
    let declared =
        c.lines().filter(|line| line.strip_prefix("#define ").is_some_and(|l| l.contains(" WL_SI("))).count();
    assert_eq!(rows.len(), declared, "the page has every unit of wearlaw_point.h");
    for row in rows {
        let cells: Vec<&str> = row.split('|').map(|cell| cell.trim().trim_matches('`')).collect();
        let [_, in_c, in_cpp, in_fortran, in_rust, exponents, _] = cells[..] else { panic!("{row}") };
        let floats: Vec<String> = exponents.split(", ").map(|exponent| format!("{exponent}.0")).collect();
        let floats = floats.join(", ").replace("-0.0", "0.0");
        assert!(c.contains(&format!("#define {in_c} WL_SI({exponents})\n")), "{row}");
        assert!(cpp.contains(&format!("constexpr Unit {in_cpp}{{{exponents}}};")), "{row}");
        assert!(fortran.contains(&format!("parameter :: {in_fortran} = ")), "{row}");
        let name = in_rust.trim_start_matches("Unit::");
        assert!(rust.contains(&format!("pub const {name}: Unit = Unit::new({floats});")), "{row}");
    }
}

#[test]
fn two_laws_fit_in_one_library_in_c() {
    let text = std::fs::read_to_string(native::include().join("README.md")).expect("include/README.md is there");
    let c = blocks(&text, "c");
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, fill) in [("one.c", "archard_fill"), ("two.c", "fretting_fill")] {
        let law = format!("#define LAW_FILL {fill}\n{}", c[0].replace("my-archard", fill));
        std::fs::write(folder.path().join(name), law).expect("a writable folder");
    }
    std::fs::write(folder.path().join("entry.c"), c[1]).expect("a writable folder");
    let out = folder.path().join("law.so");
    native::try_compile(&folder.path().join("entry.c"), &native::include(), &out, &["one.c", "two.c"])
        .expect("it compiles");
    for (index, name) in ["archard_fill", "fretting_fill"].into_iter().enumerate() {
        let law = native::Native::open(&out, index as i32);
        assert_eq!(native::text(&law.law.name), name);
        assert_eq!(law.names(wearlaw_plugin_api::abi::WL_KIND_CONSTANT), ["K", "H"]);
    }
}
