//! `wearlaw inspect LIB`: the facts of the file, then what the law in it says of itself.

use std::path::Path;

use serde_json::json;

use super::args::InspectArguments;
use super::console::Console;
use super::description::{file_json, file_text, law_text};
use super::opening::opened_library;
use crate::error::{Error, UsageError};
use crate::exit_code::ExitCode;
use crate::law::file_facts::FileFacts;
use crate::law::lookup::{self, LawSource, LookupError};
use crate::law::{Plugin, embedded};
use crate::scene::Located;

pub(super) fn command(console: &Console, arguments: &InspectArguments) -> Result<ExitCode, Error> {
    let typed = &arguments.library;
    let (source, named) = match lookup::find(typed, Path::new("")) {
        Ok(found) => (found.source, found.law),
        // A file without an ending in this folder is what was meant.
        Err(LookupError::PathWithoutSlash { kind: "file", .. }) => (LawSource::Library(typed.into()), None),
        Err(error) => return Err(Located::new(error, None).into()),
    };
    let wanted = arguments.law.as_deref().or(named.as_deref());
    if arguments.only_file && wanted.is_some() {
        return Err(UsageError::StaticLaw.into());
    }
    match source {
        LawSource::Source(path) if path.is_file() => Err(UsageError::SourceNotLibrary { path }.into()),
        LawSource::Embedded(law) if arguments.only_file => Err(UsageError::NoFile { law: law.to_owned() }.into()),
        LawSource::Library(path) | LawSource::Source(path) if arguments.only_file => {
            let facts = FileFacts::read(path)?;
            if console.json {
                console.document(&json!({ "file": file_json(&facts) }))?;
            } else {
                console.result(&file_text(&facts, console))?;
            }
            Ok(ExitCode::Done)
        }
        LawSource::Library(path) | LawSource::Source(path) => {
            let plugin = opened_library(&path)?;
            show(console, &plugin, wanted)
        }
        LawSource::Embedded(law) => {
            let plugin = opened_embedded(law)?;
            show(console, &plugin, wanted)
        }
    }
}

/// A law of this program.
pub(super) fn opened_embedded(law: &str) -> Result<Plugin, Error> {
    let Some(entry) = embedded::entry(law) else {
        let known = embedded::NAMES.iter().map(|&name| name.to_owned()).collect();
        return Err(Located::new(LookupError::NotEmbedded { name: law.to_owned(), known }, None).into());
    };
    Ok(Plugin::from_entry(entry)?)
}

/// Prints the description of a library and of its laws, or of the one that is wanted.
fn show(console: &Console, plugin: &Plugin, wanted: Option<&str>) -> Result<ExitCode, Error> {
    if console.json {
        console.document(&plugin_json(plugin, wanted)?)?;
    } else {
        console.result(&plugin_text(console, plugin, wanted)?)?;
        plugin.warnings().iter().for_each(|warning| console.note(&format!("warning: {warning}")));
    }
    Ok(ExitCode::Done)
}

/// File facts and descriptions for people.
pub(super) fn plugin_text(console: &Console, plugin: &Plugin, wanted: Option<&str>) -> Result<String, Error> {
    let mut text = match plugin.facts() {
        Some(facts) => file_text(facts, console),
        None => format!("{}\n  part of this program\n", console.headline(plugin.name())),
    };
    for law in chosen(plugin, wanted)? {
        text.push('\n');
        text.push_str(&law_text(law.descriptor(), console));
    }
    Ok(text)
}

/// File facts and descriptions for programs; `file` is null for a law of this program.
pub(super) fn plugin_json(plugin: &Plugin, wanted: Option<&str>) -> Result<serde_json::Value, Error> {
    let laws: Vec<_> = chosen(plugin, wanted)?.iter().map(|law| law.descriptor()).collect();
    Ok(json!({
        "file": plugin.facts().map(file_json),
        "laws": laws,
        "warnings": plugin.warnings(),
    }))
}

fn chosen<'a>(plugin: &'a Plugin, wanted: Option<&str>) -> Result<Vec<&'a crate::law::Law>, Error> {
    match wanted {
        Some(name) => Ok(vec![plugin.law(Some(name))?]),
        None => Ok(plugin.laws().iter().collect()),
    }
}
