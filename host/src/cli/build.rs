//! `wearlaw build SRC.. [-o LIB]`: sources to a library, and what the law in it says of itself.

use serde_json::json;

use super::args::BuildArguments;
use super::console::Console;
use super::inspect::{plugin_json, plugin_text};
use super::interrupt::Interrupt;
use super::opening::opened_library;
use super::unit_text::elapsed;
use crate::error::{Error, UsageError};
use crate::exit_code::ExitCode;
use crate::law::build::adapt::Adaptation;
use crate::law::build::{BuildError, BuildRequest, Built, build};

pub(super) fn command(console: &Console, arguments: &BuildArguments) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let adaptation = arguments.adapt.as_deref().map(|form| {
        let parameters = arguments.params.as_deref().unwrap_or_default();
        Adaptation::parse(form, parameters).map_err(|what| UsageError::Parameters { what })
    });
    let request = BuildRequest {
        sources: arguments.sources.clone(),
        output: arguments.output.clone(),
        adaptation: adaptation.transpose()?,
        ..BuildRequest::default()
    };
    let built = interrupt.over(compiled(console, &request))?;
    let plugin = opened_library(&built.library)?;
    if console.json {
        let mut document = plugin_json(&plugin, None)?;
        document["library"] = built.library.display().to_string().into();
        document["commands"] = json!(built.commands);
        document["messages"] = built.messages.into();
        document["seconds"] = built.seconds.into();
        console.document(&document)?;
    } else if console.quiet {
        console.result(&format!("{}\n", built.library.display()))?;
    } else {
        console.result(&plugin_text(console, &plugin, None)?)?;
        console.note(&format!("\nbuilt in {}", elapsed(built.seconds)));
        plugin.warnings().iter().for_each(|warning| console.note(&format!("warning: {warning}")));
    }
    Ok(ExitCode::Done)
}

/// Builds, and passes on what the compilers said as they said it.
pub(super) fn compiled(console: &Console, request: &BuildRequest) -> Result<Built, Error> {
    let result = build(request);
    let messages = match &result {
        Ok(built) if console.quiet => {
            // A warning is no error.
            let _ = built;
            ""
        }
        Ok(built) => &built.messages,
        Err(error) => error.messages(),
    };
    if !console.json {
        console.messages(messages);
    }
    result.map_err(|error: BuildError| Error::Build(error))
}
