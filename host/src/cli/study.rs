//! `wearlaw study SCENE`: error against run time, as a table, a verdict and three files.

use std::path::{Path, PathBuf};
use std::time::Instant;

use super::args::SceneArguments;
use super::console::Console;
use super::interrupt::Interrupt;
use super::machine;
use super::opening::{self, OpenedLaw};
use super::progress::Progress;
use super::run::prepared;
use super::study_args::{StudyArguments, StudyClock, StudyMethod, StudyPart, StudyReference};
use super::study_table;
use crate::error::Error;
use crate::exit_code::ExitCode;
use crate::output::{check_study_folder, write_study};
use crate::record::Clock;
use crate::scene::{Method, Override, Scene};
use crate::study::{Asked, Compare, Laws, Part, Watcher, study};

pub(super) fn command(console: &Console, arguments: StudyArguments) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let asked = asked(&arguments);
    let out = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.scene));
    let (scene, law) = prepared(console, &interrupt, &arguments.scene, &arguments.shared)?;
    check_study_folder(&out)?;
    let elsewhere = apart(console, &interrupt, &scene, &arguments.shared, &asked);
    let overrides: Vec<Override> =
        arguments.shared.overrides.iter().map(|text| Override::from(text.as_str())).collect();
    let (progress, begin) = (Progress::start(console), Instant::now());
    let mut tell = |case: &str| progress.show_case(case, begin.elapsed().as_secs_f64() / asked.budget.as_secs_f64());
    let goes_on = || !interrupt.asked();
    let laws = Laws { here: law.evaluator.as_ref(), elsewhere: elsewhere.as_ref().map(|law| law.evaluator.as_ref()) };
    let mut watcher = Watcher { tell: &mut tell, goes_on: &goes_on };
    let record = study(&arguments.scene, &overrides, laws, &asked, &mut watcher)?;
    drop(progress);
    let provenance = arguments.html.then(|| provenance(&law, &arguments));
    write_study(&record, provenance.as_deref(), &out)?;
    if console.json {
        console.document(&record)?;
    } else if !console.quiet {
        console.result(&study_table::text(console, &record, &out))?;
    }
    if record.interrupted {
        console.note(&format!("interrupted: what was done so far is in {}", out.display()));
        return Ok(ExitCode::Interrupted);
    }
    Ok(ExitCode::Done)
}

/// What a page says of how the study came about.
fn provenance(law: &OpenedLaw, arguments: &StudyArguments) -> Vec<(String, String)> {
    let fact = |label: &str, text: String| (label.to_owned(), text);
    let of_program = || "part of the program".to_owned();
    let hash = law.facts.as_ref().map_or_else(of_program, |facts| facts.sha256.clone());
    let mut facts = vec![
        fact("wearlaw", env!("CARGO_PKG_VERSION").to_owned()),
        fact("law", law.origin.clone()),
        fact("SHA-256 of the law", hash),
    ];
    if !arguments.shared.overrides.is_empty() {
        facts.push(fact("keys that were set", arguments.shared.overrides.join(" ; ")));
    }
    facts.extend(machine::facts(Some(arguments.threads.into())));
    facts
}

/// The law in a process of its own, where the study compares that; `None` where all run there, or it cannot be opened,
/// which the study then says.
fn apart(
    console: &Console,
    interrupt: &Interrupt,
    scene: &Scene,
    shared: &SceneArguments,
    asked: &Asked,
) -> Option<OpenedLaw> {
    if shared.isolate || !asked.wants(Part::Isolation) {
        return None;
    }
    let isolated = SceneArguments { isolate: true, ..shared.clone() };
    match opening::open(console, interrupt, scene, &isolated) {
        Ok(law) => Some(law),
        Err(error) => {
            console.note(&format!("the law was not opened in a process of its own: {error}"));
            None
        }
    }
}

fn asked(arguments: &StudyArguments) -> Asked {
    let part = |part: &StudyPart| match part {
        StudyPart::Substeps => Part::Substeps,
        StudyPart::Tolerances => Part::Tolerances,
        StudyPart::Scaling => Part::Scaling,
        StudyPart::Grids => Part::Grids,
        StudyPart::Isolation => Part::Isolation,
    };
    let method = |method: &StudyMethod| match method {
        StudyMethod::Auto => Method::Auto,
        StudyMethod::ExplicitEuler => Method::ExplicitEuler,
        StudyMethod::ImplicitEuler => Method::ImplicitEuler,
        StudyMethod::TrBdf2 => Method::TrBdf2,
        StudyMethod::Sdirk2 => Method::Sdirk2,
    };
    Asked {
        budget: arguments.budget.unwrap_or(Asked::BUDGET),
        threads: usize::from(arguments.threads),
        runs: arguments.runs,
        parts: arguments.only.iter().map(part).collect(),
        methods: arguments.methods.iter().map(method).collect(),
        substeps: arguments.substeps.clone(),
        tolerances: arguments.tolerances.clone(),
        safety: arguments.safety.clone(),
        grids: arguments.grids.clone(),
        clock: match arguments.clock {
            StudyClock::Wall => Clock::Wall,
            StudyClock::Processor => Clock::Processor,
        },
        compare: match arguments.reference {
            StudyReference::Scene => Compare::Scene,
            StudyReference::SelfConverged => Compare::SelfConverged,
        },
    }
}

/// `NAME.study` in the current folder for a scene `NAME.toml` in any.
fn default_folder(scene: &Path) -> PathBuf {
    let mut name = scene.file_stem().unwrap_or_default().to_os_string();
    name.push(".study");
    PathBuf::from(name)
}

#[cfg(test)]
mod tests {
    use super::default_folder;
    use std::path::Path;

    #[test]
    fn a_study_goes_to_a_folder_here_that_is_named_after_the_scene() {
        assert_eq!(default_folder(Path::new("scenes/ball.toml")), Path::new("ball.study"));
    }
}
