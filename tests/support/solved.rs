//! Scenes given as text, run through the library: scene, plan, record.

#![allow(dead_code)] // every test target takes its own part of this file

use std::fs;
use std::sync::Arc;

use tempfile::TempDir;
use wearlaw::law::memory::{InMemory, MemoryLaw};
use wearlaw::law::{Evaluator, LawInstance, Plugin, embedded};
use wearlaw::plan::Plan;
use wearlaw::record::{End, Nobody, Record};
use wearlaw::scene::Scene;
use wearlaw::solve::{ErrorNorm, Run, SolveError};

/// The law of the program.
pub fn archard() -> LawInstance {
    let plugin = Plugin::from_entry(embedded::entry("archard").expect("archard is embedded")).expect("a law");
    plugin.law(None).expect("one law").create(None).expect("no options are needed")
}

/// A law of the tests.
pub fn memory<L: MemoryLaw>(options: Option<&str>) -> LawInstance {
    let plugin = Plugin::from_entry(Arc::new(InMemory::<L>::new())).expect("a law");
    plugin.law(None).expect("one law").create(options).expect("options that the law takes")
}

/// A scene, with the files beside it.
pub struct Case {
    folder: TempDir,
    scene: String,
}

/// What a case came to.
pub struct Solved {
    /// Its plan.
    pub plan: Plan,
    /// What happened.
    pub record: Record<SolveError>,
    /// The error, where the scene names a reference.
    pub error: Option<ErrorNorm>,
}

impl Case {
    /// A prescribed scene without a history; `[law]` and `[contact]` are made here.
    pub fn steps(law: &str, rest: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        Self { folder, scene: format!("[law]\nuse = \"archard\"\n{law}\n[contact]\nmodel = \"prescribed\"\n{rest}\n") }
    }

    /// A scene as it stands.
    pub fn text(scene: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        Self { folder, scene: scene.to_owned() }
    }

    /// A prescribed scene with a history of these CSV lines.
    pub fn history(law: &str, csv: &str, rest: &str) -> Self {
        let case = Self::steps(law, &format!("history = \"h.csv\"\n{rest}"));
        case.file("h.csv", csv);
        case
    }

    /// Writes a file beside the scene.
    pub fn file(&self, name: &str, text: &str) {
        fs::write(self.folder.path().join(name), text).expect("a writable folder");
    }

    /// The plan for a law, or why the scene has none; a scene that cannot be read is a fault of the test.
    pub fn try_plan(&self, law: &dyn Evaluator) -> Result<Plan, wearlaw::plan::PlanError> {
        let scene = Scene::parse(&self.scene, self.folder.path().join("scene.toml"), &[]);
        Plan::new(&scene.unwrap_or_else(|error| panic!("{error:?}\n{}", self.scene)), law.descriptor())
    }

    /// The plan for a law.
    pub fn plan(&self, law: &dyn Evaluator) -> Plan {
        let scene = Scene::parse(&self.scene, self.folder.path().join("scene.toml"), &[]);
        let scene = scene.unwrap_or_else(|error| panic!("{error:?}\n{}", self.scene));
        Plan::new(&scene, law.descriptor()).unwrap_or_else(|error| panic!("{error:?}\n{}", self.scene))
    }

    /// Runs with a law, to whatever end.
    pub fn end(&self, law: &dyn Evaluator) -> Solved {
        self.end_on(1, law)
    }

    /// Runs with a law on so many threads, to whatever end.
    pub fn end_on(&self, threads: usize, law: &dyn Evaluator) -> Solved {
        let plan = self.plan(law);
        let run = Run::prepare(&plan, law).unwrap_or_else(|error| panic!("{error}\n{}", self.scene));
        let record = run.go(threads, &mut Nobody);
        let finished = matches!(record.end, End::Done | End::Stopped(_));
        let error =
            if finished { run.error(&record, &mut Nobody).unwrap_or_else(|error| panic!("{error}")) } else { None };
        Solved { plan, record, error }
    }

    /// Runs with a law, to the end.
    pub fn solve(&self, law: &dyn Evaluator) -> Solved {
        self.solve_on(1, law)
    }

    /// Runs with a law on so many threads, to the end.
    pub fn solve_on(&self, threads: usize, law: &dyn Evaluator) -> Solved {
        let solved = self.end_on(threads, law);
        assert!(matches!(solved.record.end, End::Done), "{:?}\n{}", solved.record.end, self.scene);
        solved
    }

    /// Wear depths [points] at the end with `archard`.
    pub fn wear(&self) -> Vec<f64> {
        self.solve(&archard()).record.wear
    }
}

/// Fails unless two numbers agree to a relative tolerance.
#[track_caller]
pub fn near(found: f64, expected: f64, tolerance: f64) {
    let error = ((found - expected) / expected).abs();
    assert!(found == expected || error <= tolerance, "{found:e} against {expected:e}: {error:e} > {tolerance:e}");
}
