//! Builds a law in Rust as an outsider does: a crate of one file beside the carried source of `wearlaw-plugin-api`.

#![allow(dead_code)] // every test target takes its own part of this file

use std::fs;
use std::path::{Path, PathBuf};

use wearlaw::law::build::{BuildError, BuildRequest, build, headers};

/// The crate of every law: no dependency but the carried one, so that no registry is asked.
const MANIFEST: &str = r#"[package]
name = "law"
version = "1.0.0"
edition = "2024"
description = "K / H * p^m * v^n * dt"

[lib]
crate-type = ["cdylib"]

[dependencies]
wearlaw-plugin-api = { path = "wearlaw-plugin-api" }

[workspace]
"#;

/// Builds a law into a library in `folder`; answers the compiler's messages if it refuses.
///
/// # Errors
/// What cargo said.
pub fn try_build(law: &str, folder: &Path) -> Result<PathBuf, String> {
    fs::create_dir_all(folder.join("src")).expect("a writable folder");
    headers::write_plugin_api(&folder.join("wearlaw-plugin-api")).expect("a writable folder");
    fs::write(folder.join("Cargo.toml"), MANIFEST).expect("a writable folder");
    fs::write(folder.join("src/lib.rs"), law).expect("a writable folder");
    let request = BuildRequest {
        sources: vec![folder.to_path_buf()],
        output: Some(folder.join("law.so")),
        extra_flags: vec!["--offline".into(), "--target-dir".into(), folder.join("target").into()],
        ..BuildRequest::default()
    };
    match build(&request) {
        Ok(built) => Ok(built.library),
        Err(error @ BuildError::CompilerFailed { .. }) => Err(format!("{error}\n{}", error.messages())),
        Err(error) => panic!("{error}"),
    }
}
