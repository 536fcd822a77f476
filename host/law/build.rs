//! Puts into the program what it needs to build wear laws on its own: the headers, the Rust side's source, and
//! the name of the target it was built for.

use std::fmt::Write;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rustc-env=WEARLAW_TARGET={}", std::env::var("TARGET")?);

    // Links to what lies beside this crate, so that a package of it holds the files themselves.
    let root = PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?).join("carried");
    let mut code = String::new();
    let folder = root.join("include").canonicalize()?;
    let include = carried(&folder, &folder)?;
    table(&mut code, "CARRIED", "The files of `include/`, by their path in it", &include)?;
    let api = root.join("plugin-api").join("src").canonicalize()?;
    let mut source = vec![("Cargo.toml".to_owned(), root.join("plugin-api").join("manifest.toml").canonicalize()?)];
    source.extend(carried(&api, &api)?.into_iter().map(|(name, path)| (format!("src/{name}"), path)));
    table(&mut code, "PLUGIN_API", "The source of `wearlaw-plugin-api`, by its path in the crate", &source)?;
    let manifest = root.join("workspace.toml").canonicalize()?;
    for file in [&source[0].1, &manifest] {
        println!("cargo:rerun-if-changed={}", file.display());
    }
    writeln!(
        code,
        "/// The workspace's manifest, from which the crate's inherits.\nconst WORKSPACE_MANIFEST: &str = \
         include_str!({manifest:?});"
    )?;
    std::fs::write(PathBuf::from(std::env::var("OUT_DIR")?).join("carried.rs"), code)?;
    Ok(())
}

/// The files below a folder, sorted, so that the same tree gives the same program.
fn carried(folder: &Path, root: &Path) -> std::io::Result<Vec<(String, PathBuf)>> {
    println!("cargo:rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    if !folder.is_dir() {
        return Ok(files);
    }
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.strip_prefix(root).unwrap_or(&path).to_path_buf();
        let hidden = path.file_name().is_none_or(|name| name.to_string_lossy().starts_with('.'));
        if hidden {
            continue;
        }
        if path.is_dir() {
            files.extend(carried(&path, root)?);
        } else {
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
