//! What a run is a run of, and the checkpoint that it goes on from.

use std::path::Path;

use super::console::Console;
use super::opening::OpenedLaw;
use crate::contact::{INSTRUCTIONS_VARIABLE, Instructions};
use crate::error::Error;
use crate::output::{CHECKPOINT, Stored, read_checkpoint};
use crate::record::{Identity, LawIdentity};
use crate::scene::Scene;
use crate::solve::Run;

/// What a run of a scene with a law is a run of.
///
/// # Errors
/// A history that cannot be read again.
pub(super) fn identity(scene: &Scene, law: &OpenedLaw, run: &Run<'_>) -> Result<Identity, Error> {
    let descriptor = law.evaluator.descriptor();
    let scene = serde_json::to_value(scene);
    Ok(Identity {
        program: env!("CARGO_PKG_VERSION").to_owned(),
        law: LawIdentity {
            name: descriptor.name.clone(),
            version: descriptor.version.clone(),
            sha256: law.facts.as_ref().map(|facts| facts.sha256.clone()),
        },
        scene: scene.map_err(|error| Error::Fault { what: format!("the scene as JSON: {error}") })?,
        contents: run.contents()?,
        instructions: Instructions::asked()?.name().to_owned(),
    })
}

/// Reads the checkpoint in a folder of results; `None`: there is none.
///
/// # Errors
/// A file that is no checkpoint, is damaged, or is of another run.
pub(super) fn earlier(console: &Console, out: &Path, identity: &Identity) -> Result<Option<Stored>, Error> {
    let path = out.join(CHECKPOINT);
    if !path.exists() {
        return Ok(None);
    }
    let stored = read_checkpoint(&path)?;
    identity.follows(&stored.identity, stored.checkpoint.time)?;
    let (before, now) = (&stored.identity.instructions, &identity.instructions);
    if before != now && !before.is_empty() {
        console.note(&format!(
            "warning: the checkpoint was written with {before} instructions, the run goes on with {now}: the last digits may \
             differ from those of a run that was never stopped ({INSTRUCTIONS_VARIABLE}={before} keeps them, where the \
             processor has them)"
        ));
    }
    Ok(Some(stored))
}
