//! `wearlaw new` in every language: the printed commands, typed as they stand, in a folder that holds nothing else.

use std::path::Path;
use std::process::{Command, Stdio};

use wearlaw::law::{Batch, Evaluation, Evaluator, Field, LoadOptions, Outputs, Plugin, Values};

/// Has the law made and its commands typed by a shell, but for the last; gives back the last.
fn typed(here: &Path, name: &str, language: &str) -> String {
    let program = env!("CARGO_BIN_EXE_wearlaw");
    let made = Command::new(program).current_dir(here).args(["new", name, "--lang", language]).output().unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let text = String::from_utf8(made.stdout).unwrap();
    let mut commands: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("  ")).collect();
    assert_eq!(commands.len(), 3, "{text}");
    let last = commands.pop().unwrap();
    assert!(text.contains(&format!(" check {name}/lib{name}.so`: what is wrong with it")), "{text}");
    assert!(last.ends_with(&format!("run {name}/scene.toml")), "{last}");
    for command in commands {
        let ended = shell(here, command);
        assert!(ended.0, "{command}: {}", ended.1);
        assert!(ended.1.contains(&format!("{name} 0.1.0")), "{command}: {}", ended.1);
        assert!(!ended.1.to_lowercase().contains("warning"), "{command}: {}", ended.1);
    }
    last.to_owned()
}

/// Types a command; whether it succeeded, and all that it said.
fn shell(here: &Path, command: &str) -> (bool, String) {
    let mut shell = Command::new("sh");
    // A package registry that cannot be reached is none that was used.
    shell.env("CARGO_NET_OFFLINE", "true").env("CARGO_HOME", here.join(".cargo-home"));
    let ended = shell.current_dir(here).args(["-c", command]).stdin(Stdio::null()).output().unwrap();
    let said = [ended.stdout, ended.stderr].concat();
    (ended.status.success(), String::from_utf8_lossy(&said).into_owned())
}

/// The law gives the values of its `expected.csv`: pressure, slip, k, p_half, increment.
fn gives_the_expected_values(folder: &Path, library: &str) {
    let plugin = Plugin::open(folder.join(library), &LoadOptions::default()).unwrap();
    let law = plugin.law(None).unwrap().create(None).unwrap();
    let text = std::fs::read_to_string(folder.join("expected.csv")).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with(['#', 'p']));
    let mut checked = 0;
    for row in rows {
        let numbers: Vec<f64> = row.split(',').map(|number| number.parse().unwrap()).collect();
        let [pressure, slip, k, p_half, expected] = numbers[..] else { panic!("{row}") };
        let batch = Batch::builder(law.descriptor(), 1)
            .field(Field::Pressure, Values::Uniform(pressure))
            .field(Field::Slip, Values::Uniform(slip))
            .constants(&[k, p_half])
            .build()
            .unwrap();
        let mut increment = [f64::NAN];
        let answer = law.evaluate(&batch, &mut Outputs::new(&mut increment)).unwrap();
        assert_eq!(answer, Evaluation::Good, "{row}");
        assert!((increment[0] - expected).abs() <= 4.0 * f64::EPSILON * expected, "{row}: {}", increment[0]);
        checked += 1;
    }
    assert!(checked >= 8, "{checked} rows");
}

fn works_as_printed(language: &str) {
    let here = tempfile::tempdir().unwrap();
    let name = format!("my-{language}-law");
    let run = typed(here.path(), &name, language);
    let ended = shell(here.path(), &run);
    assert!(ended.0 && ended.1.contains("1.7102838178e-6 m"), "{}", ended.1);
    assert!(here.path().join("scene.out/report.json").is_file());
    gives_the_expected_values(&here.path().join(&name), &format!("lib{name}.so"));
    let left: Vec<_> = std::fs::read_dir(here.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    let expected = |file: &std::ffi::OsString| *file == *name || file == ".cargo-home" || file == "scene.out";
    assert!(left.iter().all(expected), "{left:?}");
}

#[test]
fn c_works_as_printed() {
    works_as_printed("c");
}

#[test]
fn cpp_works_as_printed() {
    works_as_printed("cpp");
}

#[test]
fn fortran_works_as_printed() {
    if Command::new("gfortran").arg("--version").output().is_err() {
        println!("NOT RUN: fortran_works_as_printed: gfortran missing");
        return;
    }
    works_as_printed("fortran");
}

#[test]
fn rust_works_as_printed() {
    works_as_printed("rust");
}

#[cfg(unix)]
#[test]
fn a_program_on_the_path_is_called_by_its_name() {
    let here = tempfile::tempdir().unwrap();
    let bin = here.path().join("bin");
    std::fs::create_dir(&bin).unwrap();
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_wearlaw"), bin.join("wearlaw")).unwrap();
    let old = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(bin).chain(std::env::split_paths(&old))).unwrap();
    let make = Command::new("sh")
        .env("PATH", path)
        .current_dir(here.path())
        .args(["-c", "wearlaw new mine --lang c"])
        .output();
    let text = String::from_utf8(make.unwrap().stdout).unwrap();
    assert!(text.contains("\n  wearlaw build mine/mine.c -o mine/libmine.so\n"), "{text}");
    assert!(text.contains("\n  wearlaw run mine/scene.toml\n"), "{text}");
}
