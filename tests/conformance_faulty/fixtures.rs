//! The manifest of the faulty laws, and their libraries, built once and kept while their sources are older.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::SystemTime;

/// Works side by side: the machine's cores, which the tester uses too.
const WORKERS: usize = 2;

/// A law that breaks one rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faulty {
    /// Its source, from `plugins/faulty`.
    pub file: String,
    /// `c`, `cpp`, `fortran` or `rust`.
    pub language: String,
    /// The check whose rule it breaks.
    pub check: String,
    /// The check that sees the fault sooner, in a run of all checks.
    pub first: Option<String>,
}

impl Faulty {
    /// The name of its source without folders and ending.
    pub fn name(&self) -> String {
        stem(&self.file)
    }

    /// The check that has to fail in a run of all checks.
    pub fn told_by(&self) -> &str {
        self.first.as_deref().unwrap_or(&self.check)
    }
}

fn stem(file: &str) -> String {
    Path::new(file).file_stem().expect("a file name").to_string_lossy().into_owned()
}

/// Root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the repository is there")
}

/// Every law of the manifest that can be built here.
pub fn faulty() -> Vec<Faulty> {
    let path = root().join("plugins/faulty/manifest.csv");
    let mut table = csv::Reader::from_path(&path).expect("the manifest is there");
    let rows = table.records().map(|row| {
        let row = row.expect("four columns");
        let cell = |k: usize| row[k].to_owned();
        Faulty { file: cell(0), language: cell(1), check: cell(2), first: (!row[3].is_empty()).then(|| cell(3)) }
    });
    rows.filter(|law| law.language != "fortran" || has_fortran()).collect()
}

/// The laws without a fault that the faulty ones are made from, one in each language.
pub fn sound() -> Vec<PathBuf> {
    let sources = ["sound.c", "sound_cpp.cpp", "sound_fortran.f90", "rust/examples/sound_rust.rs"];
    let can_be_built = |source: &&&str| !source.ends_with(".f90") || has_fortran();
    sources.iter().filter(can_be_built).map(|source| library("faulty", source)).collect()
}

/// The libraries of the good laws that look suspicious.
pub fn suspicious() -> Vec<PathBuf> {
    let folder = fs::read_dir(root().join("plugins/suspicious")).expect("the folder is there");
    let names = folder.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    let mut sources: Vec<String> = names.filter(|name| name.ends_with(".c") || name.ends_with(".cpp")).collect();
    sources.sort();
    sources.iter().map(|source| library("suspicious", source)).collect()
}

/// Whether there is a Fortran compiler; its absence is told, and a failure where it is needed.
fn has_fortran() -> bool {
    static FOUND: OnceLock<bool> = OnceLock::new();
    *FOUND.get_or_init(|| {
        let found = Command::new(compiler("FC", "gfortran")).arg("--version").output().is_ok();
        if !found {
            writeln!(std::io::stdout(), "NOT RUN: conformance_faulty fortran: no compiler").expect("stdout is open");
            assert!(std::env::var("WEARLAW_NEED_FORTRAN").as_deref() != Ok("1"), "a Fortran compiler is needed");
        }
        found
    })
}

fn compiler(variable: &str, fallback: &str) -> String {
    std::env::var(variable).unwrap_or_else(|_| fallback.to_owned())
}

/// Folder of everything that is built here.
fn work() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("faulty")
}

/// The library of a source of `plugins/faulty` or `plugins/suspicious`, built if it is older than any source there.
pub fn library(folder: &str, source: &str) -> PathBuf {
    let path = root().join("plugins").join(folder).join(source);
    // A law with an expected.csv has a folder of its own, here as there.
    let beside = path.with_file_name("expected.csv");
    let out = match Path::new(source).parent().filter(|_| beside.exists()) {
        Some(own) => work().join(own).join(stem(source)).with_extension("so"),
        None => work().join(folder).join(stem(source)).with_extension("so"),
    };
    fs::create_dir_all(out.parent().expect("a folder")).expect("the target folder can be written");
    if beside.exists() {
        fs::copy(&beside, out.with_file_name("expected.csv")).expect("the target folder can be written");
    }
    if source.ends_with(".rs") {
        return rust_libraries().join(format!("lib{}.so", stem(source)));
    }
    if !is_fresh(&out) {
        compile(&path, &out);
    }
    out
}

/// Whether a product is younger than everything it may be made from.
fn is_fresh(out: &Path) -> bool {
    let time = |path: &Path| fs::metadata(path).and_then(|data| data.modified()).ok();
    let newest = |folder: PathBuf| -> Option<SystemTime> {
        fs::read_dir(folder).ok()?.filter_map(|entry| time(&entry.ok()?.path())).max()
    };
    let folders = ["include", "plugins/faulty", "plugins/suspicious", "plugins/faulty/expected_off"];
    let sources = folders.iter().filter_map(|folder| newest(root().join(folder))).max();
    time(out) > sources.max(newest(root().join("tests/data/faulty_host")))
}

/// Compiles a law with the flags of `wearlaw build`, beside a temporary name, so that what exists is whole.
fn compile(source: &Path, out: &Path) {
    let aside = out.with_extension(format!("{}.partial", std::process::id()));
    let modules = out.with_extension("modules");
    let include = root().join("include");
    let mut command = match source.extension().and_then(|ending| ending.to_str()) {
        Some("c") => {
            let mut command = Command::new(compiler("CC", "cc"));
            command.args(["-std=gnu11", "-fno-math-errno"]);
            command
        }
        Some("cpp") => {
            let mut command = Command::new(compiler("CXX", "c++"));
            command.args(["-std=gnu++17", "-fno-math-errno"]);
            command
        }
        _ => {
            fs::create_dir_all(&modules).expect("the target folder can be written");
            let mut command = Command::new(compiler("FC", "gfortran"));
            command.args(["-nostdinc", "-J"]).arg(&modules).arg(include.join("wearlaw.f90"));
            command
        }
    };
    // What a law is bad in is also what a compiler may warn of.
    command.args(["-O3", "-fPIC", "-shared", "-w", "-ffp-contract=off", "-fno-trapping-math", "-I"]).arg(&include);
    if !source.ends_with("undefined_symbol.c") {
        command.arg("-Wl,--no-undefined");
    }
    let output = command.arg(source).arg("-o").arg(&aside).arg("-lm").output().expect("the compiler starts");
    assert!(output.status.success(), "{}: {}", source.display(), String::from_utf8_lossy(&output.stderr));
    fs::rename(&aside, out).expect("a file in the same folder");
}

/// Folder of the laws in Rust, built by cargo as the examples of one crate.
fn rust_libraries() -> PathBuf {
    static BUILT: Mutex<bool> = Mutex::new(false);
    let mut built = BUILT.lock().unwrap_or_else(PoisonError::into_inner);
    let target = work().join("rust");
    if !*built {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let output = Command::new(cargo)
            .args(["build", "--offline", "--quiet", "-p", "wearlaw-faulty", "--examples", "--target-dir"])
            .arg(&target)
            .current_dir(root())
            .output()
            .expect("cargo starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        *built = true;
    }
    target.join("debug/examples")
}

/// The host in plain C that proves a law bad: `faulty_host LIBRARY CHECK`.
pub fn c_host() -> &'static Path {
    static HOST: OnceLock<PathBuf> = OnceLock::new();
    HOST.get_or_init(|| {
        let out = work().join("faulty_host");
        fs::create_dir_all(work()).expect("the target folder can be written");
        if is_fresh(&out) {
            return out;
        }
        let folder = root().join("tests/data/faulty_host");
        let files = fs::read_dir(&folder).expect("its sources").map(|entry| entry.expect("an entry").path());
        let mut sources: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "c")).collect();
        sources.sort();
        let aside = work().join(format!("faulty_host.{}.partial", std::process::id()));
        let output = Command::new(compiler("CC", "cc"))
            .args(["-std=gnu11", "-O1", "-Wall", "-Wextra", "-Wno-missing-field-initializers", "-Werror", "-I"])
            .arg(root().join("include"))
            .args(&sources)
            .arg("-o")
            .arg(&aside)
            .args(["-lm", "-ldl", "-pthread"])
            .output()
            .expect("a C compiler");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        fs::rename(aside, &out).expect("a file in the same folder");
        out
    })
}

/// Does `work` for every item, some at a time, and gives the answers in order.
pub fn side_by_side<T: Sync, A: Send>(items: &[T], work: impl Fn(&T) -> A + Sync) -> Vec<A> {
    let next = Mutex::new(0..items.len());
    let answers: Mutex<Vec<(usize, A)>> = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..WORKERS {
            scope.spawn(|| {
                loop {
                    let Some(index) = next.lock().unwrap_or_else(PoisonError::into_inner).next() else { break };
                    let answer = work(&items[index]);
                    answers.lock().unwrap_or_else(PoisonError::into_inner).push((index, answer));
                }
            });
        }
    });
    let mut answers = answers.into_inner().unwrap_or_else(PoisonError::into_inner);
    answers.sort_by_key(|(index, _)| *index);
    answers.into_iter().map(|(_, answer)| answer).collect()
}
