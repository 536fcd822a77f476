//! `wearlaw run SCENE`: the settings of a run, and the run itself.

use std::path::PathBuf;

use serde_json::json;

use super::args::{RunArguments, SceneArguments};
use super::console::Console;
use super::interrupt::Interrupt;
use super::opening::{self, OpenedLaw};
use super::table::labelled;
use crate::error::Error;
use crate::exit_code::ExitCode;
use crate::output::check_folder;
use crate::reference::NamedReference;
use crate::scene::{Override, Scene};

/// What a run is told.
#[derive(Debug, Clone)]
pub(super) struct Settings {
    /// The scene file.
    pub(super) scene: PathBuf,
    /// What `plan` is told too.
    pub(super) shared: SceneArguments,
    /// The folder for the results.
    pub(super) out: PathBuf,
    /// Number of threads; `None`: as many as the machine has.
    pub(super) threads: Option<usize>,
}

pub(super) fn command(console: &Console, arguments: RunArguments) -> Result<ExitCode, Error> {
    match arguments.scene {
        None => references(console),
        Some(scene) => execute(
            console,
            &Settings {
                out: arguments.out.unwrap_or_else(|| default_folder(&scene)),
                scene,
                shared: arguments.shared,
                threads: arguments.threads.map(usize::from),
            },
        ),
    }
}

/// Runs the scene: reads it, opens its law, plans, solves, writes the results and sums them up.
fn execute(console: &Console, settings: &Settings) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let (_scene, _law) = prepared(console, &interrupt, &settings.scene, &settings.shared)?;
    check_folder(&settings.out)?;
    Err(Error::Fault { what: "`run` is not connected to the solver".to_owned() })
}

/// The scene with its overrides, and its law.
pub(super) fn prepared(
    console: &Console,
    interrupt: &Interrupt,
    file: &std::path::Path,
    shared: &SceneArguments,
) -> Result<(Scene, OpenedLaw), Error> {
    let overrides: Vec<Override> = shared.overrides.iter().map(|text| Override::from(text.as_str())).collect();
    let scene = Scene::read(file, &overrides)?;
    let law = opening::open(console, interrupt, &scene, shared.law.as_deref(), shared.isolate)?;
    law.warnings.iter().for_each(|warning| console.note(&format!("warning: {warning}")));
    Ok((scene, law))
}

/// `NAME.out` in the current folder for a scene `NAME.toml` in any.
fn default_folder(scene: &std::path::Path) -> PathBuf {
    let mut name = scene.file_stem().unwrap_or("scene".as_ref()).to_owned();
    name.push(".out");
    PathBuf::from(name)
}

/// The exact answers that a scene can name.
fn references(console: &Console) -> Result<ExitCode, Error> {
    if console.json {
        let all = NamedReference::ALL.map(|one| json!({ "kind": one.name(), "description": one.description() }));
        console.document(&json!({ "references": all }))?;
    } else {
        let mut text = format!("{}\n", console.headline("exact answers for [reference] kind"));
        for one in NamedReference::ALL {
            text.push_str(&labelled(one.name(), one.description(), 20, 96));
        }
        console.result(&text)?;
    }
    Ok(ExitCode::Done)
}

#[cfg(test)]
mod tests {
    use super::default_folder;
    use std::path::Path;

    #[test]
    fn results_go_to_a_folder_here_that_is_named_after_the_scene() {
        assert_eq!(default_folder(Path::new("scenes/pin_on_disc.toml")), Path::new("pin_on_disc.out"));
    }
}
