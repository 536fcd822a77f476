//! The sources of the repository, walked as folders.

#![allow(dead_code)] // every test target takes its own part of this file

use std::path::{Path, PathBuf};

/// Root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the repository is there")
}

/// Every file below a folder of the repository that is a source of its own, by its path from the root, sorted.
pub fn below(folder: &str) -> Vec<PathBuf> {
    let root = root();
    let mut found = Vec::new();
    walk(&root.join(folder), &mut found);
    found.sort();
    found.iter().map(|path| path.strip_prefix(&root).expect("it is below the root").to_owned()).collect()
}

/// The text of a file by its path from the root; `None` for one that is not text.
pub fn text(path: &Path) -> Option<String> {
    String::from_utf8(std::fs::read(root().join(path)).expect("it was there a moment ago")).ok()
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of the repository") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        // Results of runs and builds stand beside the sources and are no part of them.
        if name.starts_with('.') && name != ".github" || name == "target" || name.ends_with(".out") {
            continue;
        }
        // What a link leads to is walked where it lies.
        if path.is_symlink() {
            continue;
        }
        if path.is_dir() {
            walk(&path, found);
        } else {
            found.push(path);
        }
    }
}
