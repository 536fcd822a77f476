//! Puts into the program what it needs to build wear laws on its own: the headers, the Rust side's source, and
//! the name of the target it was built for.

use std::fmt::Write;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rustc-env=WEARLAW_TARGET={}", std::env::var("TARGET")?);

    let root = PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?).join("..").canonicalize()?;
    let mut code = String::new();
    let include = carried(&root.join("include"), &root.join("include"), |_| true)?;
    table(&mut code, "CARRIED", "The files of `include/`, by their path in it", &include)?;
    let api = root.join("plugin-api");
    let source = carried(&api, &api, |path| {
        path == Path::new("Cargo.toml") || path.starts_with("src") || path == Path::new("README.md")
    })?;
    table(&mut code, "PLUGIN_API", "The source of `wearlaw-plugin-api`, by its path in the crate", &source)?;
    let manifest = root.join("Cargo.toml");
    println!("cargo:rerun-if-changed={}", manifest.display());
    writeln!(
        code,
        "/// The workspace's manifest, from which the crate's inherits.\nconst WORKSPACE_MANIFEST: &str = \
         include_str!({manifest:?});"
    )?;
    std::fs::write(PathBuf::from(std::env::var("OUT_DIR")?).join("carried.rs"), code)?;
    Ok(())
}

/// The files below a folder, sorted, so that the same tree gives the same program.
fn carried(folder: &Path, root: &Path, wanted: fn(&Path) -> bool) -> std::io::Result<Vec<(String, PathBuf)>> {
    println!("cargo:rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    if !folder.is_dir() {
        return Ok(files);
    }
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.strip_prefix(root).unwrap_or(&path).to_path_buf();
        let hidden = path.file_name().is_none_or(|name| name.to_string_lossy().starts_with('.'));
        if hidden || name.components().next().is_some_and(|first| first.as_os_str() == "target") {
            continue;
        }
        if path.is_dir() {
            files.extend(carried(&path, root, wanted)?);
        } else if wanted(&name) {
            files.push((name.to_string_lossy().replace('\\', "/"), path));
        }
    }
    files.sort();
    Ok(files)
}

fn table(code: &mut String, name: &str, what: &str, files: &[(String, PathBuf)]) -> std::fmt::Result {
    writeln!(code, "/// {what}: name, text.\npub const {name}: &[(&str, &str)] = &[")?;
    for (file, path) in files {
        writeln!(code, "    ({file:?}, include_str!({path:?})),")?;
    }
    writeln!(code, "];")
}
