//! A Rust crate to a library.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::command::Log;
use super::{Aside, BuildError, BuildRequest, Language};

/// Builds the crate of a manifest in release mode and copies its shared library to the output.
pub(super) fn build(request: &BuildRequest, manifest: &Path) -> Result<(PathBuf, Log), BuildError> {
    let unreadable = |source| BuildError::SourceUnreadable { path: manifest.to_path_buf(), source };
    let manifest = manifest.canonicalize().map_err(unreadable)?;
    if let Some(output) = &request.output {
        // Found out before the long part rather than after it.
        drop(Aside::new(output)?);
    }
    let cargo = request.compilers.cargo.clone().or_else(|| std::env::var_os("CARGO"));
    let mut command = Command::new(cargo.unwrap_or_else(|| "cargo".into()));
    command.args(["build", "--release", "--message-format=json-render-diagnostics", "--manifest-path"]);
    command.arg(&manifest).args(&request.extra_flags);
    if let Some(folder) = manifest.parent() {
        // The crate's own `.cargo/config.toml` and `rust-toolchain.toml` are looked for from there.
        command.current_dir(folder);
    }
    let mut log = Log::default();
    let stdout = log.run(command, Language::Rust)?;
    let built = cdylib_of(&manifest, &stdout).ok_or_else(|| BuildError::NoCdylib { manifest: manifest.clone() })?;

    let name = built.file_name().map(PathBuf::from).unwrap_or_default();
    let output = request.output.clone().unwrap_or(name);
    let aside = Aside::new(&output)?;
    let fail = |source| BuildError::OutputNotWritable { path: output.clone(), source };
    std::fs::copy(&built, aside.library()).map_err(fail)?;
    Ok((aside.finish()?, log))
}

/// The shared library that cargo says the crate of this manifest gave; dependencies may give others.
fn cdylib_of(manifest: &Path, messages: &[u8]) -> Option<PathBuf> {
    let lines = messages.split(|&byte| byte == b'\n');
    let artifacts = lines.filter_map(|line| serde_json::from_slice::<serde_json::Value>(line).ok());
    artifacts.filter(|artifact| artifact["reason"] == "compiler-artifact").find_map(|artifact| {
        let of_crate = Path::new(artifact["manifest_path"].as_str()?).canonicalize().ok()?;
        let is_cdylib = artifact["target"]["crate_types"].as_array()?.iter().any(|kind| kind == "cdylib");
        if of_crate != manifest || !is_cdylib {
            return None;
        }
        let files = artifact["filenames"].as_array()?;
        let library = files.iter().filter_map(|file| file.as_str()).find(|f| f.ends_with(std::env::consts::DLL_SUFFIX));
        library.map(PathBuf::from)
    })
}
