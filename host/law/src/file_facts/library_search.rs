//! Where the dynamic linker would look for the libraries that a library needs.
//!
//! A wrong "missing" would refuse a library that loads, so whatever may be found counts as found: the linker
//! itself refuses the rest, before it runs any code.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::ElfFacts;

/// The first needed library that is nowhere, with the folders looked into; `None` also where this cannot be told.
pub(super) fn first_missing(path: &Path, elf: &ElfFacts) -> Option<(String, Vec<PathBuf>)> {
    // Other C libraries search elsewhere.
    if !cfg!(all(target_os = "linux", target_env = "gnu")) {
        return None;
    }
    let loaded = loaded_libraries();
    let cache = std::fs::read("/etc/ld.so.cache").unwrap_or_default();
    let folders = folders(path, elf, &loaded)?;
    let missing = elf.needed.iter().find(|name| {
        let is_loaded = loaded.iter().any(|path| path.file_name() == Some(OsStr::new(name.as_str())));
        let found = if name.contains('/') {
            name.contains('$') || Path::new(name).exists()
        } else {
            folders.iter().any(|folder| folder.join(name).exists())
        };
        !is_loaded && !found && !cache_names(&cache, name)
    })?;
    let searched = if missing.contains('/') { Vec::new() } else { without_repeats(folders) };
    Some((missing.clone(), searched))
}

/// The files mapped into this process, by their paths.
pub(super) fn loaded_libraries() -> Vec<PathBuf> {
    let maps = std::fs::read("/proc/self/maps").unwrap_or_default();
    let mut paths: Vec<PathBuf> = String::from_utf8_lossy(&maps)
        .lines()
        .filter_map(|line| line.find('/').map(|start| PathBuf::from(&line[start..])))
        .collect();
    paths.dedup();
    paths
}

/// Every folder that may be searched, or `None` if one of them cannot be told.
fn folders(path: &Path, elf: &ElfFacts, loaded: &[PathBuf]) -> Option<Vec<PathBuf>> {
    let origin = std::path::absolute(path).ok()?.parent()?.to_path_buf();
    let mut folders = Vec::new();
    for folder in elf.rpath.iter().chain(&elf.runpath) {
        let replaced = folder.replace("${ORIGIN}", "$ORIGIN").replace("$ORIGIN", &origin.to_string_lossy());
        if replaced.contains('$') {
            // $LIB and $PLATFORM depend on how the linker was built.
            return None;
        }
        folders.push(PathBuf::from(replaced));
    }
    if let Some(list) = std::env::var_os("LD_LIBRARY_PATH") {
        folders.extend(
            std::env::split_paths(&list).map(
                |folder| {
                    if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder }
                },
            ),
        );
    }
    let arch = std::env::consts::ARCH;
    for root in ["/lib", "/usr/lib", "/usr/local/lib"] {
        folders.push(PathBuf::from(format!("{root}/{arch}-linux-gnu")));
        folders.push(PathBuf::from(format!("{root}64")));
        folders.push(PathBuf::from(root));
    }
    // Systems that keep their libraries elsewhere search the C library's own folder; the program's own search
    // path has led to the others already loaded.
    folders.extend(
        loaded
            .iter()
            .filter(|path| path.to_string_lossy().contains(".so"))
            .filter_map(|path| path.parent().map(Path::to_path_buf)),
    );
    Some(folders)
}

fn without_repeats(folders: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut kept: Vec<PathBuf> = Vec::new();
    for folder in folders {
        if !kept.contains(&folder) && folder.is_dir() {
            kept.push(folder);
        }
    }
    kept
}

/// Whether the linker's cache knows this name: it keeps names ending with a zero byte, one behind the other.
fn cache_names(cache: &[u8], name: &str) -> bool {
    let mut wanted = name.as_bytes().to_vec();
    wanted.push(0);
    cache.windows(wanted.len()).any(|window| window == wanted)
}
