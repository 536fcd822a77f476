//! The host library from C, C++ and Fortran: its programs are compiled against `include/` alone and run.

#[path = "support/native.rs"]
mod native;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use native::{fortran, include, root, try_compile};

/// The folder in which cargo builds libraries beside the tests.
fn deps() -> PathBuf {
    let program = std::env::current_exe().expect("a test knows its own path");
    program.parent().expect("a program lies in a folder").to_owned()
}

/// A compiler by its environment variable or its usual name, told where headers and library are.
fn linked(variable: &str, usual: &str, arguments: &[&str], sources: &[PathBuf], program: &Path) {
    let library = format!("{}wearlaw_host{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    assert!(deps().join(&library).exists(), "cargo builds {library} with this test");
    let mut command = Command::new(std::env::var(variable).unwrap_or_else(|_| usual.into()));
    command.args(arguments).args(["-O2", "-Wall", "-I"]).arg(include()).args(sources);
    command.arg("-L").arg(deps()).args(["-lwearlaw_host", "-pthread", "-o"]).arg(program);
    command.arg(format!("-Wl,-rpath,{}", deps().display()));
    let folder = program.parent().expect("a program lies in a folder");
    let output = command.current_dir(folder).output().expect("the compiler starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

const C: [&str; 5] = ["-std=c99", "-Wextra", "-pedantic", "-Werror", "-Wno-missing-field-initializers"];

/// Compiles a program of `tests/data/host_c` and runs it in its folder; gives back what it printed.
fn checked(folder: &Path, name: &str, arguments: &[&str]) -> String {
    let program = folder.join(name);
    let source = root().join("tests/data/host_c").join(format!("{name}.c"));
    linked("CC", "cc", &C, &[source.canonicalize().expect("it is there")], &program);
    let output = Command::new(&program).args(arguments).current_dir(folder).output().expect("the program starts");
    let said = said(&output);
    assert!(output.status.success() && said.contains(" checks\n"), "{name}: {:?}\n{said}", output.status);
    said
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// A law of the repository as a library in a folder.
fn law(folder: &Path, source: &str, name: &str, more: &[&str]) -> String {
    let library = folder.join(name);
    let source = root().join(source).canonicalize().expect("it is there");
    let include = include().canonicalize().expect("it is there");
    try_compile(&source, &include, &library, more).unwrap_or_else(|said| panic!("{}: {said}", source.display()));
    library.display().to_string()
}

#[test]
fn bad_input_is_said_and_changes_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let here = folder.path();
    let good = law(here, "plugins/example-c/threshold.c", "good.so", &[]);
    let facts = wearlaw::law::file_facts::FileFacts::read(&good).expect("a library");
    let refuses = law(here, "plugins/faulty/bounds_crossed.c", "refuses.so", &[]);
    std::fs::write(here.join("law.c"), "").expect("a writable folder");
    checked(here, "inputs", &[&good, &facts.sha256, &refuses, "./law.c"]);
}

#[test]
fn bad_input_from_cpp_and_fortran_is_said_and_changes_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let here = folder.path();
    let source = |name: &str| root().join("tests/data/host_c").join(name).canonicalize().expect("it is there");
    let ran = |program: &Path, least: usize| {
        let output = Command::new(program).output().expect("the program starts");
        let said = said(&output);
        let checks = said.trim().strip_suffix(" checks").and_then(|count| count.parse::<usize>().ok());
        assert!(output.status.success() && checks >= Some(least), "{:?}: {said}", output.status);
    };
    linked(
        "CXX",
        "c++",
        &["-std=c++11", "-Wextra", "-pedantic", "-Werror"],
        &[source("inputs.cpp")],
        &here.join("cpp"),
    );
    ran(&here.join("cpp"), 18);
    if fortran("bad input to the host library from Fortran") {
        let mut sources =
            ["wearlaw.f90", "wearlaw_host.f90"].map(|name| include().canonicalize().unwrap().join(name)).to_vec();
        sources.push(source("inputs.f90"));
        linked("FC", "gfortran", &["-std=f2008"], &sources, &here.join("f90"));
        ran(&here.join("f90"), 25);
    }
}

#[test]
fn state_is_committed_rolled_back_and_restarted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let library = law(folder.path(), "plugins/example-cpp/running_in.cpp", "running_in.so", &[]);
    checked(folder.path(), "state", &[&library, env!("CARGO_BIN_EXE_wearlaw")]);
}

#[test]
fn a_law_that_ends_its_process_is_a_status() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let library = law(folder.path(), "plugins/faulty/aborts_on_high_pressure.c", "aborts.so", &[]);
    checked(folder.path(), "apart", &[&library, env!("CARGO_BIN_EXE_wearlaw")]);
}

#[test]
fn a_serial_law_is_called_in_turn() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let count = |said: &str, what: &str| -> u64 {
        let line = said.lines().find_map(|line| line.strip_prefix(what)).expect("it prints a number");
        line.trim().parse().expect("a number")
    };
    let library = law(folder.path(), "tests/data/host_c/alone.c", "serial.so", &["-DSERIAL"]);
    let said = checked(folder.path(), "threads", &[&library]);
    assert_eq!(count(&said, "failed"), 0, "{said}");
    assert!(count(&said, "busy") > 0, "two threads met in one surface: {said}");
    // Without the flag the same law sees both threads, so the numbers above mean something.
    let library = law(folder.path(), "tests/data/host_c/alone.c", "parallel.so", &[]);
    let said = checked(folder.path(), "threads", &[&library]);
    assert!(count(&said, "failed") > 0, "{said}");
}

#[test]
fn an_evaluation_copies_no_array() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    checked(folder.path(), "memory", &[]);
}

/// What `wearlaw run` gives for the pin on a disc.
fn depth_of_run() -> f64 {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = root().join("host/scenes/pin_on_disc.toml");
    let mut program = Command::new(env!("CARGO_BIN_EXE_wearlaw"));
    let output = program.arg("run").arg(scene).arg("--out").arg(folder.path().join("out")).output();
    let output = output.expect("the program starts");
    assert!(output.status.success(), "{}", said(&output));
    let report = std::fs::read_to_string(folder.path().join("out/report.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    report["result"]["max_wear_depth"].as_f64().expect("a depth")
}

/// The depths that an example prints.
fn depths(program: &Path, arguments: &[&str]) -> Vec<f64> {
    let output = Command::new(program).args(arguments).output().expect("the program starts");
    assert!(output.status.success(), "{}", said(&output));
    String::from_utf8_lossy(&output.stdout).split_whitespace().map(|word| word.parse().expect("a number")).collect()
}

fn example(ending: &str) -> PathBuf {
    let path = root().join(format!("host/c/examples/pin_on_disc.{ending}"));
    path.canonicalize().expect("the example is there")
}

#[test]
fn the_examples_agree_with_a_run() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let here = folder.path();
    let right = depth_of_run();
    let mut found = Vec::new();
    linked("CC", "cc", &C, &[example("c")], &here.join("c"));
    found.push(depths(&here.join("c"), &[]));
    linked("CXX", "c++", &["-std=c++11", "-Wextra", "-pedantic", "-Werror"], &[example("cpp")], &here.join("cpp"));
    found.push(depths(&here.join("cpp"), &[]));
    if fortran("the example of the host library in Fortran") {
        let modules = ["wearlaw.f90", "wearlaw_host.f90"].map(|name| include().canonicalize().unwrap().join(name));
        let sources = [&modules[0], &modules[1], &example("f90")].map(Clone::clone);
        linked("FC", "gfortran", &["-std=f2008", "-Wextra", "-Werror"], &sources, &here.join("f90"));
        found.push(depths(&here.join("f90"), &[]));
    }
    for depths in &found {
        assert_eq!(depths.len(), 3, "{found:?}");
        // Substeps of 1/2000, with the constants of their middle: an error of second order, 2e-7.
        assert!(depths.iter().all(|depth| (depth / right - 1.0).abs() < 1e-6), "{found:?} for {right}");
    }
    assert!(found.iter().all(|depths| *depths == found[0]), "the same bits from every language: {found:?}");
    // Ranks of an MPI program are programs of their own, each with a share of the points.
    let ranks = ["0", "1"].map(|rank| depths(&here.join("c"), &[rank, "2"]));
    assert_eq!((ranks[0].len(), ranks[1].len()), (1, 2));
    assert_eq!(ranks.concat(), found[0]);
}

/// Names and values of the constants `WLH_..` of a header or a module, and of its functions.
fn names(text: &str, is_fortran: bool) -> Vec<String> {
    let mut found = Vec::new();
    for line in text.lines() {
        let line = line.trim();
        if let Some(rest) = line.strip_prefix("#define WLH_") {
            found.push(format!("WLH_{}", rest.replace(' ', "=")));
        } else if let Some((_, rest)) = line.split_once("parameter :: WLH_") {
            found.push(format!("WLH_{}", rest.replace(" = ", "=").replace("_c_int32_t", "")));
        } else if let Some(rest) = line.strip_prefix(if is_fortran { "function wlh_" } else { "int32_t wlh_" }) {
            found.push(rest.split('(').next().unwrap_or_default().to_owned());
        }
    }
    found.sort();
    found
}

#[test]
fn the_module_in_fortran_has_what_the_header_has() {
    let read = |name: &str| std::fs::read_to_string(include().join(name)).expect("it is there");
    let header = names(&read("wearlaw_host.h"), false);
    assert!(header.len() > 20, "{header:?}");
    assert_eq!(names(&read("wearlaw_host.f90"), true), header);
}

/// Offsets of the members of every struct, printed by a program in C and by one in Fortran.
#[test]
fn structs_lie_alike_in_c_and_fortran() {
    if !fortran("the structs of the host library in Fortran") {
        return;
    }
    let structs = structs(&std::fs::read_to_string(include().join("wearlaw_host.h")).expect("it is there"));
    assert_eq!(structs.len(), 6);
    let (mut c, mut f90) = (String::new(), String::new());
    let mut declared = String::new();
    for (name, members) in &structs {
        declared += &format!("  type({name}), target :: a_{name}\n");
        c += &format!("  printf(\"%zu\\n\", sizeof({name}));\n");
        f90 += &format!("  print '(i0)', c_sizeof(a_{name})\n");
        for member in members {
            c += &format!("  printf(\"%zu\\n\", offsetof({name}, {member}));\n");
            f90 += &format!("  print '(i0)', at(c_loc(a_{name}%{member})) - at(c_loc(a_{name}))\n");
        }
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (c_source, f90_source) = (folder.path().join("c.c"), folder.path().join("f.f90"));
    let head = "#include \"wearlaw_host.h\"\n#include <stddef.h>\n#include <stdio.h>\nint main(void) {\n";
    std::fs::write(&c_source, format!("{head}{c}  return 0;\n}}\n")).expect("a writable folder");
    let head = "program structs\n  use, intrinsic :: iso_c_binding\n  use wearlaw_host\n  implicit none\n";
    let tail = "contains\n  integer(c_intptr_t) function at(place)\n    type(c_ptr), intent(in) :: place\n    \
                at = transfer(place, at)\n  end function at\nend program structs\n";
    std::fs::write(&f90_source, format!("{head}{declared}{f90}{tail}")).expect("a writable folder");
    linked("CC", "cc", &C, &[c_source], &folder.path().join("in_c"));
    let module = include().canonicalize().expect("it is there").join("wearlaw_host.f90");
    linked("FC", "gfortran", &["-std=f2008"], &[module, f90_source], &folder.path().join("in_f90"));
    let printed = |name: &str| depths(&folder.path().join(name), &[]);
    assert!(printed("in_c").len() > 50);
    assert_eq!(printed("in_c"), printed("in_f90"));
}

/// The structs of a header and the names of their members.
fn structs(header: &str) -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    for part in header.split("typedef struct {").skip(1) {
        let (body, rest) = part.split_once("\n} ").expect("a struct ends");
        let name = rest.split(';').next().expect("a struct has a name").to_owned();
        let members = body.lines().filter_map(|line| line.strip_suffix(';'));
        let member = |line: &str| {
            let word = line.rsplit([' ', '*']).next().expect("a member has a name");
            word.split('[').next().expect("a member has a name").to_owned()
        };
        found.push((name, members.map(member).collect()));
    }
    found
}
