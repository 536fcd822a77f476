//! What the program carries for authors of laws: the folder `include/` and the Rust side's source.

use std::fs;
use std::io;
use std::path::Path;

use toml::{Table, Value};

include!(concat!(env!("OUT_DIR"), "/carried.rs"));

/// Writes the files of `include/` into a folder, which is made if it is not there.
///
/// # Errors
/// A folder or a file cannot be written.
pub fn write_into(folder: &Path) -> io::Result<()> {
    write_files(folder, CARRIED.iter().copied())
}

/// Writes the crate `wearlaw-plugin-api` into a folder, with a manifest that needs no workspace around it.
///
/// Its optional dependencies (the layout check's) and the features over them are left out: a law then builds
/// without a package registry, on a machine without a network too.
///
/// # Errors
/// A folder or a file cannot be written.
pub fn write_plugin_api(folder: &Path) -> io::Result<()> {
    let files = PLUGIN_API.iter().filter(|(name, _)| *name != "Cargo.toml");
    write_files(folder, files.copied())?;
    fs::write(folder.join("Cargo.toml"), plugin_api_manifest()?)
}

/// The manifest of `wearlaw-plugin-api` with everything that it inherits from the workspace put in.
///
/// # Errors
/// The carried manifests are not of the expected form, which a test rules out.
pub fn plugin_api_manifest() -> io::Result<String> {
    let own = PLUGIN_API.iter().find(|(name, _)| *name == "Cargo.toml").map_or("", |(_, text)| text);
    concrete_manifest(own, WORKSPACE_MANIFEST).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
}

fn write_files<'a>(folder: &Path, files: impl Iterator<Item = (&'a str, &'a str)>) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    for (name, text) in files {
        let path = folder.join(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::write(path, text)?;
    }
    Ok(())
}

/// Puts in what a manifest inherits, and leaves out its optional dependencies.
fn concrete_manifest(own: &str, workspace: &str) -> Result<String, toml::de::Error> {
    let mut own: Table = toml::from_str(own)?;
    let workspace: Table = toml::from_str(workspace)?;
    let shared = |key: &str| workspace.get("workspace").and_then(|table| table.get(key));
    let inherits = |value: &Value| value.get("workspace").and_then(Value::as_bool) == Some(true);

    if let Some(Value::Table(package)) = own.get_mut("package") {
        for (key, value) in package.iter_mut() {
            if inherits(value)
                && let Some(inherited) = shared("package").and_then(|table| table.get(key))
            {
                *value = inherited.clone();
            }
        }
        package.insert("publish".into(), Value::Boolean(false));
        // It names a file that does not come along.
        package.remove("readme");
    }
    if own.get("lints").is_some_and(inherits)
        && let Some(lints) = shared("lints")
    {
        own.insert("lints".into(), lints.clone());
    }
    let mut optional = Vec::new();
    if let Some(Value::Table(dependencies)) = own.get_mut("dependencies") {
        for (name, value) in dependencies.iter_mut() {
            if inherits(value)
                && let Some(inherited) = shared("dependencies").and_then(|table| table.get(name))
            {
                *value = inherited.clone();
            }
        }
        dependencies.retain(|name, value| {
            let is_optional = value.get("optional").and_then(Value::as_bool) == Some(true);
            if is_optional {
                optional.push(name.to_string());
            }
            !is_optional
        });
    }
    own.remove("dev-dependencies");
    let mut left_out = Vec::new();
    if let Some(Value::Table(features)) = own.get_mut("features") {
        features.retain(|name, parts| {
            let of_optional = |part: &Value| {
                let part = part.as_str().unwrap_or_default().trim_start_matches("dep:");
                optional.iter().any(|name| part.split(['/', '?']).next() == Some(name))
            };
            let keep = !parts.as_array().is_some_and(|parts| parts.iter().any(of_optional));
            if !keep {
                left_out.push(name.to_string());
            }
            keep
        });
    }
    allow_cfg_of(&mut own, &left_out);
    toml::to_string(&own).map_err(serde::de::Error::custom)
}

/// Lets the source go on naming features that the manifest no longer has.
fn allow_cfg_of(manifest: &mut Table, features: &[String]) {
    if features.is_empty() {
        return;
    }
    let names = features.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    let check = Value::Array(vec![Value::String(format!("cfg(feature, values({names}))"))]);
    let level = Table::from_iter([("level".to_owned(), Value::String("warn".into())), ("check-cfg".to_owned(), check)]);
    let lints = manifest.entry("lints").or_insert_with(|| Value::Table(Table::new()));
    if let Value::Table(lints) = lints
        && let Value::Table(rust) = lints.entry("rust").or_insert_with(|| Value::Table(Table::new()))
    {
        rust.insert("unexpected_cfgs".into(), Value::Table(level));
    }
}

#[cfg(test)]
mod tests {
    use super::{CARRIED, PLUGIN_API, concrete_manifest, plugin_api_manifest, write_into, write_plugin_api};
    use std::path::Path;

    #[test]
    fn a_manifest_is_made_concrete() {
        let own = "[package]\nname = \"a\"\nversion.workspace = true\nreadme = \"../README.md\"\n\
                   [dependencies]\nb = { version = \"1\", optional = true }\nc.workspace = true\n\
                   [features]\nlayout = [\"dep:b\"]\nkept = []\n[lints]\nworkspace = true\n";
        let workspace = "[workspace.package]\nversion = \"0.3.0\"\n[workspace.dependencies]\nc = \"2\"\n\
                         [workspace.lints.rust]\nunsafe_code = \"deny\"\n";
        let text = concrete_manifest(own, workspace).unwrap();
        let manifest: toml::Table = toml::from_str(&text).unwrap();
        assert_eq!(manifest["package"]["version"].as_str(), Some("0.3.0"));
        assert_eq!(manifest["dependencies"]["c"].as_str(), Some("2"));
        assert!(manifest["dependencies"].get("b").is_none() && manifest["features"].get("layout").is_none());
        assert!(manifest["features"].get("kept").is_some() && manifest["package"].get("readme").is_none());
        assert_eq!(manifest["lints"]["rust"]["unsafe_code"].as_str(), Some("deny"));
        assert!(text.contains("values(\\\"layout\\\")") || text.contains("values(\"layout\")"), "{text}");
        assert!(!text.contains("workspace"), "{text}");
    }

    #[test]
    fn what_is_carried_is_what_the_folders_hold() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        for (name, text) in CARRIED {
            assert_eq!(std::fs::read_to_string(root.join("include").join(name)).unwrap(), *text, "{name}");
        }
        for (name, text) in PLUGIN_API {
            assert_eq!(std::fs::read_to_string(root.join("plugin-api").join(name)).unwrap(), *text, "{name}");
        }
        assert!(PLUGIN_API.iter().any(|(name, _)| *name == "src/lib.rs"));
        assert!(!plugin_api_manifest().unwrap().contains("workspace"));
    }

    #[test]
    fn both_are_written_out() {
        let folder = tempfile::tempdir().unwrap();
        write_into(&folder.path().join("include")).unwrap();
        for (name, text) in CARRIED {
            assert_eq!(std::fs::read_to_string(folder.path().join("include").join(name)).unwrap(), *text);
        }
        let api = folder.path().join("api");
        write_plugin_api(&api).unwrap();
        assert!(api.join("src/lib.rs").is_file() && api.join("Cargo.toml").is_file());
    }
}
