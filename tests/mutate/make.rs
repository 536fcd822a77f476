//! From a mutant to its fate: a copy of the law is built with it and checked.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::Mutex;

use super::operators::Mutant;
use super::subjects::{Subject, root};

/// Mutants that are tried side by side.
const WORKERS: usize = 2;

/// Seconds for a check, many times what it takes: a busy machine must not look like a mutant that hangs.
const TIMEOUT: &str = "40";

/// What became of a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// Its compiler refuses it: no author would have it.
    DoesNotCompile,
    /// The tester found it.
    Found,
    /// It passed.
    Survived,
}

/// A place where the mutants of one file are built.
pub struct Workshop<'a> {
    subject: &'a Subject,
    folder: tempfile::TempDir,
}

/// Copies a folder of sources without what is built in it.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a temporary folder");
    for entry in fs::read_dir(from).unwrap_or_else(|error| panic!("{}: {error}", from.display())) {
        let path = entry.expect("an entry").path();
        let target = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).expect("a temporary folder");
        }
    }
}

impl<'a> Workshop<'a> {
    /// A folder for each worker, with the sources as they are.
    pub fn new(subject: &'a Subject) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for worker in 0..WORKERS {
            for part in [Path::new("include"), Path::new("plugin-api/src"), &subject.law] {
                copy(&root().join(part), &folder.path().join(worker.to_string()).join(part));
            }
        }
        Self { subject, folder }
    }

    /// The law without a mistake is built and passes, or its mutants say nothing.
    pub fn assert_sound(&self) {
        let sound = Mutant { text: self.subject.text.clone(), line: 0, lines: Default::default() };
        assert_eq!(self.fate(&sound, 0), Fate::Survived, "{} itself", self.subject.name());
    }

    /// The fates of mutants, in order.
    pub fn try_all(&self, mutants: &[Mutant]) -> Vec<Fate> {
        let next = Mutex::new(0..mutants.len());
        let fates = Mutex::new(vec![Fate::DoesNotCompile; mutants.len()]);
        std::thread::scope(|scope| {
            for worker in 0..WORKERS {
                let (next, fates) = (&next, &fates);
                scope.spawn(move || {
                    loop {
                        let Some(at) = next.lock().expect("no worker panics").next() else { break };
                        let fate = self.fate(&mutants[at], worker);
                        fates.lock().expect("no worker panics")[at] = fate;
                    }
                });
            }
        });
        fates.into_inner().expect("no worker panics")
    }

    fn fate(&self, mutant: &Mutant, worker: usize) -> Fate {
        let place = self.folder.path().join(worker.to_string());
        fs::write(place.join(&self.subject.file), &mutant.text).expect("a temporary folder");
        // What the shipped law does not use of a helper, the law that uses everything does: that one tells more.
        if let Some((source, name)) = &self.subject.everything {
            let source = root().join(source);
            let Some(library) = self.build(&place, Some(&source)) else { return Fate::DoesNotCompile };
            let mut library = library.into_os_string();
            library.push(format!("#{name}"));
            let waived = root().join("tests/mutate/waived.toml").into();
            let arguments =
                [library, "--expected".into(), source.with_extension("csv").into(), "--waive".into(), waived];
            if !passes(mutant, &place, &arguments) {
                return Fate::Found;
            }
        }
        let Some(library) = self.build(&place, None) else { return Fate::DoesNotCompile };
        let expected = root().join(&self.subject.law).join("expected.csv");
        let arguments = [library.into_os_string(), "--expected".into(), expected.into()];
        if passes(mutant, &place, &arguments) { Fate::Survived } else { Fate::Found }
    }

    /// Builds the law of the subject, or another one, with the mutant.
    fn build(&self, place: &Path, other: Option<&Path>) -> Option<PathBuf> {
        let law = place.join(&self.subject.law);
        let library = place.join("law.so");
        let _ = fs::remove_file(&library);
        let built = match other {
            None if law.join("Cargo.toml").exists() => build_rust(place, &law.join("src/lib.rs"), &library),
            Some(source) if source.extension().is_some_and(|ending| ending == "rs") => {
                build_rust(place, source, &library)
            }
            None => build_native(place, &native_source(&law), &library),
            Some(source) => build_native(place, source, &library),
        };
        (built && library.exists()).then_some(library)
    }
}

/// Whether the tester finds nothing in a law: a few checks find most, all of them are for the rest.
fn passes(mutant: &Mutant, place: &Path, arguments: &[OsString]) -> bool {
    let passes = |more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_wearlaw"))
            .current_dir(place)
            .arg("check")
            .args(arguments)
            .args(["-q", "--threads", "1", "--timeout", TIMEOUT])
            .args(more)
            .stdin(Stdio::null())
            .output()
            .expect("the program starts");
        let code = output.status.code().expect("no signal ends the tester");
        assert!([0, 1, 2, 3].contains(&code), "{}: {code} {output:?}", mutant.change());
        code == 0
    };
    passes(&["--quick", "--only", "values,batch"]) && passes(&[])
}

fn succeeds(command: &mut Command) -> bool {
    let output: Output = command.stdin(Stdio::null()).output().expect("the compiler starts");
    output.status.success()
}

/// The source in the folder of a law.
fn native_source(law: &Path) -> PathBuf {
    let mut files = fs::read_dir(law).expect("a folder of a law").map(|entry| entry.expect("an entry").path());
    let ends = |path: &PathBuf| path.extension().is_some_and(|e| ["c", "cpp", "f90"].iter().any(|s| e == *s));
    files.find(ends).expect("a source")
}

/// As `wearlaw build` does, with the copied headers in place of the carried ones.
fn build_native(place: &Path, source: &Path, library: &Path) -> bool {
    let variable = |name: &str, fallback: &str| std::env::var(name).unwrap_or_else(|_| fallback.to_owned());
    let include = place.join("include");
    let mut command = match source.extension().and_then(|ending| ending.to_str()) {
        Some("c") => Command::new(variable("CC", "cc")),
        Some("cpp") => Command::new(variable("CXX", "c++")),
        _ => {
            let mut command = Command::new(variable("FC", "gfortran"));
            command.args(["-nostdinc", "-J"]).arg(place).arg(include.join("wearlaw.f90"));
            command
        }
    };
    command.args(["-O3", "-fPIC", "-shared", "-w", "-ffp-contract=off", "-fno-trapping-math"]);
    if source.extension().is_some_and(|ending| ending != "f90") {
        command.arg("-fno-math-errno");
    }
    succeeds(command.arg("-I").arg(include).arg(source).arg("-o").arg(library).args(["-Wl,--no-undefined", "-lm"]))
}

/// The compiler alone, since cargo would look at every dependency for each mutant.
fn build_rust(place: &Path, source: &Path, library: &Path) -> bool {
    let rustc = |source: &Path, more: &[&str]| {
        let mut command = Command::new(std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned()));
        let version = ["CARGO_PKG_VERSION", "CARGO_PKG_DESCRIPTION"];
        command.envs(version.map(|name| (name, "1.0.0"))).arg(source);
        command.args(["--edition", "2024", "-C", "opt-level=3", "-A", "warnings"]).args(more);
        command
    };
    let api = place.join("libwearlaw_plugin_api.rlib");
    let text = |path: &Path| path.to_str().expect("a temporary path is text").to_owned();
    let stamp = place.join("plugin-api/src/sdk/point.rs");
    let time = |path: &Path| fs::metadata(path).and_then(|data| data.modified()).ok();
    if time(&api) < time(&stamp) {
        let source = place.join("plugin-api/src/lib.rs");
        let kind = ["--crate-type", "rlib", "--crate-name", "wearlaw_plugin_api", "-o", &text(&api)];
        if !succeeds(&mut rustc(&source, &kind)) {
            return false;
        }
    }
    let with = format!("wearlaw_plugin_api={}", text(&api));
    let kind = ["--crate-type", "cdylib", "--crate-name", "law", "--extern", &with, "-o", &text(library)];
    succeeds(&mut rustc(source, &kind))
}
