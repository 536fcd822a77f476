//! `wearlaw shim FORM LIB`: a Fortran source that a solver compiles and that calls the law.

use std::path::{Path, PathBuf};

use super::console::Console;
use super::inspect::opened_embedded;
use super::opening::{opened_library, several};
use super::shim_args::{ShimArguments, ShimForm};
use crate::error::{Error, UsageError};
use crate::exit_code::ExitCode;
use crate::law::file_facts::FileFacts;
use crate::law::lookup::{self, LawSource, LookupError};
use crate::output::write_file;
use crate::scene::Located;
use crate::shim::{self, Form, ShimError, Wanted};

pub(super) fn command(console: &Console, arguments: &ShimArguments) -> Result<ExitCode, Error> {
    let form = match arguments.form {
        ShimForm::Umeshmotion => Form::Umeshmotion,
        ShimForm::Uwearindex => Form::Uwearindex,
    };
    let (source, named) = match lookup::find(&arguments.library, Path::new("")) {
        Ok(found) => (found.source, found.law),
        Err(LookupError::PathWithoutSlash { kind: "file", .. }) => {
            (LawSource::Library(arguments.library.clone().into()), None)
        }
        Err(error) => return Err(Located::new(error, None).into()),
    };
    let (plugin, mut library, sha256) = match source {
        LawSource::Source(path) => return Err(UsageError::SourceNotLibrary { path }.into()),
        LawSource::Embedded(law) => (opened_embedded(law)?, format!("embedded:{law}"), String::new()),
        LawSource::Library(path) => {
            let facts = FileFacts::read(&path)?;
            let whole = path.canonicalize().unwrap_or_else(|_| path.clone());
            (opened_library(&path)?, whole.display().to_string(), facts.sha256)
        }
    };
    let law = plugin.law(named.as_deref()).map_err(|error| several(error, &arguments.library))?.descriptor().clone();
    if let Some(name) = &named {
        library = format!("{library}#{name}");
    }
    let units = arguments.units.unwrap_or_default().in_si();
    let wanted = Wanted { form, law: &law, library, sha256, constants: constants(arguments)?, units };
    let text = shim::source(&wanted)?;
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{}.f90", form.name())));
    write_file(&path, |to| std::io::Write::write_all(to, text.as_bytes()))?;
    let names: Vec<&str> = law.constants.iter().map(|constant| constant.name.as_str()).collect();
    if console.json {
        console.document(&serde_json::json!({
            "form": form.name(),
            "law": law.name,
            "library": wanted.library,
            "constants": names,
            "file": path.display().to_string(),
        }))?;
    } else if console.quiet {
        console.result(&format!("{}\n", path.display()))?;
    } else {
        let file = path.display();
        console.result(&format!("{file} calls {} {} from {}\n", law.name, law.version, wanted.library))?;
        console.note(&format!(
            "compile it with the solver's Fortran compiler and link with -lwearlaw_host: {}",
            form.name()
        ));
    }
    Ok(ExitCode::Done)
}

/// `K=1e-4,H=2e3`.
fn constants(arguments: &ShimArguments) -> Result<Vec<(String, f64)>, Error> {
    let each = arguments.constants.iter().map(|one| {
        let wrong = || ShimError::Constant(format!("--constants: found `{one}`, expected NAME=NUMBER, such as K=1e-4"));
        let (name, value) = one.split_once('=').ok_or_else(wrong)?;
        let value: f64 = value.trim().parse().map_err(|_| wrong())?;
        if value.is_finite() { Ok((name.trim().to_owned(), value)) } else { Err(wrong()) }
    });
    Ok(each.collect::<Result<_, ShimError>>()?)
}
