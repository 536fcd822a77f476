//! `wearlaw new NAME --lang L`: a folder with a working law, and the three commands to type next.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde_json::json;

use super::args::{NewArguments, NewLanguage};
use super::console::Console;
use crate::error::{Error, UsageError};
use crate::exit_code::ExitCode;
use crate::templates::{self, NewLaw};

pub(super) fn command(console: &Console, arguments: &NewArguments) -> Result<ExitCode, Error> {
    let Some(language) = arguments.lang else {
        let values = NewLanguage::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let known = values.map(|value| value.get_name().to_owned()).collect();
        return Err(UsageError::NoLanguage { known }.into());
    };
    let wanted = NewLaw { folder: arguments.folder.clone(), language: language.into(), program: program_as_typed() };
    let created = templates::create(&wanted)?;
    if console.json {
        console.document(&json!({
            "law": created.name,
            "folder": arguments.folder.display().to_string(),
            "language": wanted.language.to_string(),
            "files": created.files,
            "commands": created.commands,
            "check": created.check,
        }))?;
    } else if !console.quiet {
        let folder = arguments.folder.display();
        let law = format!("{folder}/{}", created.files[0]);
        let commands: String = created.commands.iter().map(|command| format!("  {command}\n")).collect();
        let then = format!(
            "and, when you have changed it, `{}`: what is wrong with it. Other constants than these stand in expected.csv, \
             scene.toml and README.md too.\n",
            created.check
        );
        console.result(&format!("{law} is a working law in {}. Type next:\n\n{commands}\n{then}", wanted.language))?;
    }
    Ok(ExitCode::Done)
}

/// How the user calls this program: `wearlaw` where the shell finds it under that name, else as it was called now.
fn program_as_typed() -> PathBuf {
    let own = std::env::current_exe().and_then(|path| path.canonicalize()).ok();
    let called = std::env::args_os().next().map_or_else(|| PathBuf::from("wearlaw"), PathBuf::from);
    choose_name(own.as_deref(), called, std::env::var_os("PATH"))
}

fn choose_name(own: Option<&Path>, called: PathBuf, search: Option<OsString>) -> PathBuf {
    let folders: Vec<PathBuf> = search.iter().flat_map(std::env::split_paths).collect();
    let first = folders.iter().map(|folder| folder.join("wearlaw")).find(|path| path.is_file());
    let on_path = first.and_then(|path| path.canonicalize().ok());
    if own.is_some() && on_path.as_deref() == own { PathBuf::from("wearlaw") } else { called }
}

#[cfg(test)]
mod tests {
    use super::choose_name;
    use std::path::Path;

    #[test]
    fn the_program_is_named_so_that_the_shell_finds_the_same_one() {
        let folder = tempfile::tempdir().unwrap();
        let other = tempfile::tempdir().unwrap();
        for place in [&folder, &other] {
            std::fs::write(place.path().join("wearlaw"), "").unwrap();
        }
        let own = folder.path().join("wearlaw").canonicalize().unwrap();
        let name = |search: &[&Path]| {
            choose_name(Some(&own), "target/release/wearlaw".into(), std::env::join_paths(search).ok())
        };
        assert_eq!(name(&[folder.path(), other.path()]), Path::new("wearlaw"));
        assert_eq!(name(&[other.path(), folder.path()]), Path::new("target/release/wearlaw"));
        assert_eq!(name(&[]), Path::new("target/release/wearlaw"));
    }
}
