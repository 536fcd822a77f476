//! What is published builds by itself: a crate's package holds every file that its build reads.

#[path = "support/sources.rs"]
mod sources;

use std::path::Path;
use std::process::Command;

/// The files of a crate's package.
fn packaged(name: &str) -> Vec<String> {
    let words = ["package", "--list", "--offline", "--allow-dirty", "-p", name];
    let output = Command::new(env!("CARGO")).args(words).current_dir(sources::root()).output().expect("cargo starts");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect()
}

#[test]
fn the_program_takes_along_what_it_carries() {
    let files = packaged("wearlaw-law");
    let mut wanted = vec!["carried/workspace.toml".to_owned(), "carried/plugin-api/manifest.toml".to_owned()];
    for folder in ["include", "plugin-api/src"] {
        wanted.extend(sources::below(folder).iter().map(|path| format!("carried/{}", path.display())));
    }
    assert!(wanted.len() > 20, "the sources are where this test looks: {wanted:?}");
    for file in wanted {
        assert!(files.contains(&file), "the package has no {file}");
    }
    assert!(files.iter().any(|file| file == "build.rs"), "the package has no build.rs");
    let files = packaged("wearlaw");
    for needed in ["README.md", "scenes/README.md", "src/templates/c/law.c"] {
        assert!(files.iter().any(|file| file == needed), "the package has no {needed}");
    }
}

#[test]
fn what_is_carried_is_what_lies_beside_the_crate() {
    for (link, file) in [
        ("include/wearlaw.h", "include/wearlaw.h"),
        ("plugin-api/src/lib.rs", "plugin-api/src/lib.rs"),
        ("plugin-api/manifest.toml", "plugin-api/Cargo.toml"),
        ("workspace.toml", "Cargo.toml"),
    ] {
        let carried = sources::text(&Path::new("host/law/carried").join(link)).expect("text");
        assert_eq!(Some(carried), sources::text(Path::new(file)), "{link}");
    }
}

#[test]
fn the_crates_it_needs_are_packaged_too() {
    let crates = [
        ("wearlaw-plugin-api", "src/abi/views.rs"),
        ("wearlaw-archard", "src/lib.rs"),
        ("wearlaw-conformance", "src/runner.rs"),
        ("wearlaw-contact", "src/halfspace/solve.rs"),
        ("wearlaw-law", "src/loader.rs"),
        ("wearlaw-scene", "src/document.rs"),
        ("wearlaw-transforms", "src/real.rs"),
    ];
    for (name, file) in crates {
        let files = packaged(name);
        assert!(files.iter().any(|found| found == file), "{name}: {files:?}");
    }
}
