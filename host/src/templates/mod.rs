//! A folder to start a wear law in: working code, its test values, and a scene that runs it.
//!
//! One equation stands here in four languages, with the text that surrounds it; [`create`] writes one of them under a
//! name of the user's. Building the law and what a user types are not here.

mod error;
mod shell;
#[cfg(test)]
mod tests;

pub use error::TemplateError;
pub use shell::quoted;

use std::fs;
use std::path::{Path, PathBuf};

use crate::law::build::{Language, headers};

/// What to create.
#[derive(Debug, Clone)]
pub struct NewLaw {
    /// The folder to make; its last part is the law's name.
    pub folder: PathBuf,
    /// The language of the law.
    pub language: Language,
    /// What the commands to type begin with.
    pub program: PathBuf,
}

/// What was created.
#[derive(Debug, Clone)]
pub struct CreatedLaw {
    /// The law's name.
    pub name: String,
    /// The files that are the user's own, by their path in the folder: the law first.
    pub files: Vec<String>,
    /// The three commands to type next: build, inspect, run.
    pub commands: [String; 3],
    /// The command that tells what is wrong with the law, once it is built.
    pub check: String,
}

/// Bytes that a law's name may have: those of the ABI but for the closing one, and of a file name around it.
const LONGEST_NAME: usize = 60;

/// Makes the folder with the law, its test values, a scene, and what the compiler and the editor need.
///
/// The folder appears whole or not at all.
///
/// # Errors
/// A name that no law can have, a folder that holds something, or one that cannot be written.
pub fn create(wanted: &NewLaw) -> Result<CreatedLaw, TemplateError> {
    let name = law_name(&wanted.folder)?;
    check_free(&wanted.folder)?;
    let library = format!("{}{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let source = source_file(wanted.language, &name);
    let sources = match wanted.language {
        Language::Rust => wanted.folder.clone(),
        _ => wanted.folder.join(&source),
    };
    let command = |words: &[&str], path: &Path| {
        format!("{} {} {}", quoted(wanted.program.as_os_str()), words.join(" "), quoted(path.as_os_str()))
    };
    let built = wanted.folder.join(&library);
    let commands = [
        format!("{} -o {}", command(&["build"], &sources), quoted(built.as_os_str())),
        command(&["inspect"], &built),
        command(&["run"], &wanted.folder.join("scene.toml")),
    ];
    let check = command(&["check"], &built);
    let fill = |text: &str| {
        text.replace("{{name}}", &name)
            .replace("{{library}}", &library)
            .replace("{{source}}", &source)
            .replace("{{language}}", &wanted.language.to_string())
            .replace("{{carried}}", carried_words(wanted.language))
            .replace("{{commands}}", &format!("    {}", commands.join("\n    ")))
    };
    let mut files: Vec<(String, String)> = vec![(source.clone(), fill(law_text(wanted.language)))];
    if wanted.language == Language::Rust {
        files.push(("Cargo.toml".to_owned(), fill(include_str!("rust/manifest.toml"))));
    }
    files.push(("expected.csv".to_owned(), include_str!("expected.csv").to_owned()));
    files.push(("scene.toml".to_owned(), fill(include_str!("scene.toml"))));
    files.push(("history.csv".to_owned(), include_str!("history.csv").to_owned()));
    files.push(("README.md".to_owned(), fill(include_str!("readme.md"))));

    write_whole(&wanted.folder, |aside| {
        for (name, text) in &files {
            let path = aside.join(name);
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent)?;
            }
            fs::write(path, text)?;
        }
        match wanted.language {
            Language::Rust => headers::write_plugin_api(&aside.join(CARRIED_CRATE)),
            // The build takes the program's own; these are for the eyes and the editor.
            _ => headers::write_into(&aside.join("include")),
        }
    })?;
    Ok(CreatedLaw { name, files: files.into_iter().map(|(name, _)| name).collect(), commands, check })
}

/// The folder of the Rust side in a law's crate.
const CARRIED_CRATE: &str = "wearlaw-plugin-api";

fn law_text(language: Language) -> &'static str {
    match language {
        Language::C => include_str!("c/law.c"),
        Language::Cpp => include_str!("cpp/law.cpp"),
        Language::Fortran => include_str!("fortran/law.f90"),
        Language::Rust => include_str!("rust/law.rs"),
    }
}

fn source_file(language: Language, name: &str) -> String {
    match language {
        Language::C => format!("{name}.c"),
        Language::Cpp => format!("{name}.cpp"),
        Language::Fortran => format!("{name}.f90"),
        Language::Rust => "src/lib.rs".to_owned(),
    }
}

fn carried_words(language: Language) -> &'static str {
    match language {
        Language::Rust => {
            "`wearlaw-plugin-api/` is the Rust side of the wear-law ABI; with it the law builds without a network."
        }
        _ => "`include/` is a copy of the headers for reading and for editors; the build brings its own.",
    }
}

/// The law's name: the folder's, if a law can have it.
fn law_name(folder: &Path) -> Result<String, TemplateError> {
    let last = folder.file_name().unwrap_or(folder.as_os_str()).to_string_lossy().into_owned();
    let fault = |expected| TemplateError::Name { name: last.clone(), expected };
    let letters = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if !last.starts_with(|c: char| c.is_ascii_alphabetic()) || !last.chars().all(letters) {
        return Err(fault("a letter, then letters, digits, `-` and `_`"));
    }
    if last.len() > LONGEST_NAME {
        return Err(fault("at most 60 characters"));
    }
    Ok(last)
}

fn check_free(folder: &Path) -> Result<(), TemplateError> {
    let unreadable = |source| TemplateError::Io { path: folder.to_path_buf(), source };
    match fs::symlink_metadata(folder) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
        Err(error) => Err(unreadable(error)),
        Ok(_) if !folder.is_dir() => Err(TemplateError::NotAFolder { path: folder.to_path_buf() }),
        Ok(_) => match fs::read_dir(folder).map_err(unreadable)?.next() {
            None => Ok(()),
            Some(entry) => {
                let found = entry.map_err(unreadable)?.file_name().to_string_lossy().into_owned();
                Err(TemplateError::NotEmpty { path: folder.to_path_buf(), found })
            }
        },
    }
}

/// Fills a folder beside the wanted one and renames it into place.
fn write_whole(folder: &Path, fill: impl FnOnce(&Path) -> std::io::Result<()>) -> Result<(), TemplateError> {
    let fail = |source| TemplateError::Io { path: folder.to_path_buf(), source };
    let parent = folder.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::create_dir_all(parent).map_err(fail)?;
    let aside = tempfile::Builder::new().prefix(".wearlaw-new-").tempdir_in(parent).map_err(fail)?;
    // One level down: the temporary folder itself is closed to others, the law's folder should not be.
    let inner = aside.path().join("law");
    fs::create_dir(&inner).and_then(|()| fill(&inner)).and_then(|()| fs::rename(&inner, folder)).map_err(fail)
}
