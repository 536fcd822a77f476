//! `wearlaw apdl FILE`: the wear commands of an input deck as the law section of a scene.

use super::args::ApdlArguments;
use super::console::Console;
use crate::apdl::{Deck, to_toml};
use crate::error::Error;
use crate::exit_code::ExitCode;

pub(super) fn command(console: &Console, arguments: &ApdlArguments) -> Result<ExitCode, Error> {
    let deck = Deck::read(&arguments.file)?;
    let material = deck.material(arguments.material)?;
    let lower = |error| Error::Lower { file: arguments.file.clone(), error };
    let toml = to_toml(material).map_err(lower)?;
    let notes: Vec<String> = deck.notes.iter().map(ToString::to_string).collect();
    if console.json {
        let sections: Option<serde_json::Value> = toml::from_str(&toml).ok();
        console.document(&serde_json::json!({
            "file": arguments.file.display().to_string(),
            "material": material.id,
            "sections": sections,
            "toml": toml,
            "notes": notes,
        }))?;
    } else {
        console.result(&toml)?;
        for note in &notes {
            console.note(&format!("note: {note}"));
        }
    }
    Ok(ExitCode::Done)
}
