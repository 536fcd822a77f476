//! Results that appear whole: written aside, then renamed.
//!
//! Whole means: against an interrupted or failing program. Only a checkpoint is also synced to the
//! disk before its rename, because it is there for the machine that goes down; waiting for the disk
//! to take large fields would cost more than the run.

use super::OutputError;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, TempDir};

/// The mark of a finished result: placed last, taken away first.
const REPORT: &str = "report.json";
/// What a run can be gone on from.
const CHECKPOINT: &str = "checkpoint";
/// Everything a run writes at the top of its folder; nothing else there is ever removed.
const FILES: [&str; 5] = [REPORT, CHECKPOINT, "report.html", "history.csv", "plot.svg"];
/// What a sweep writes: a file for each case in a folder, and the table.
const CASES: &str = "cases";
const SWEEP: &str = "cases.csv";
const FIELDS: &str = "fields";
const FIELD_ENDINGS: [&str; 5] = ["csv", "npz", "vtp", "vti", "pvd"];
const ASIDE: &str = ".partial-";
/// Inside the folder written aside: the results it replaces, until they are all replaced.
const REPLACED: &str = ".replaced";

/// Writes the file `path` whole: `fill` writes it under another name beside it, then it is renamed.
///
/// # Errors
/// `Io` with the path and the step that failed; then nothing is left of the file, and a file that
/// had this name before is as it was.
pub fn write_file(path: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), OutputError> {
    write_aside(path, fill, |_| Ok(()))
}

/// Writes the file `path` whole like `write_file`, on the disk before it has its name.
///
/// # Errors
/// As `write_file`.
pub fn write_file_synced(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    write_aside(path, fill, File::sync_all)
}

fn write_aside(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    settle: impl FnOnce(&File) -> io::Result<()>,
) -> Result<(), OutputError> {
    let mut builder = Builder::new();
    builder.prefix(ASIDE);
    permit(&mut builder, 0o666);
    let aside = builder.tempfile_in(parent(path)).map_err(OutputError::io("create", path))?;
    let (file, name) = aside.into_parts();
    let mut writer = BufWriter::with_capacity(1 << 16, file);
    fill(&mut writer)
        .and_then(|()| writer.flush())
        .and_then(|()| settle(writer.get_ref()))
        .map_err(OutputError::io("write", path))?;
    drop(writer);
    name.persist(path).map_err(|failed| failed.error).map_err(OutputError::io("rename", path))
}

/// Checks that results may go to the folder `path`: it is new, empty, or an earlier result.
///
/// # Errors
/// `NotAFolder` for a file, `NotAResult` for a folder with other entries and no earlier result,
/// `Io` when it cannot be read.
pub fn check_folder(path: &Path) -> Result<(), OutputError> {
    match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(OutputError::io("read", path)(error)),
        Ok(found) if !found.is_dir() => return Err(OutputError::NotAFolder { path: path.into() }),
        Ok(_) => {}
    }
    if path.join(REPORT).is_file() || path.join(CHECKPOINT).is_file() {
        return Ok(());
    }
    // A run killed while it placed its files leaves only names of this kind.
    let mut names = names_in(path)?;
    names.retain(|name| !(FILES.contains(&name.as_str()) || name == FIELDS || name.starts_with(ASIDE)));
    match names.into_iter().next() {
        Some(found) => Err(OutputError::NotAResult { path: path.into(), found }),
        None => Ok(()),
    }
}

/// Opens the folder `path` for a sweep, new, empty, or of an earlier sweep; gives the folder of its cases.
///
/// # Errors
/// `NotAFolder` for a file, `NotAResult` for a folder with other entries, `Io` when it cannot be read or made.
pub fn sweep_folder(path: &Path) -> Result<PathBuf, OutputError> {
    let cases = path.join(CASES);
    match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        Err(error) => return Err(OutputError::io("read", path)(error)),
        Ok(found) if !found.is_dir() => return Err(OutputError::NotAFolder { path: path.into() }),
        Ok(_) => {
            let others = |name: &String| ![CASES, SWEEP].contains(&name.as_str()) && !name.starts_with(ASIDE);
            if let Some(found) = names_in(path)?.into_iter().find(others) {
                return Err(OutputError::NotAResult { path: path.into(), found });
            }
        }
    }
    fs::create_dir_all(&cases).map_err(OutputError::io("create", &cases))?;
    Ok(cases)
}

/// The scene of the earlier result in the folder `path`, as its report has it; `None` where there is no report.
///
/// # Errors
/// `ForeignReport` when the folder holds a `report.json` that no run wrote, `Io` when it cannot be read.
pub fn earlier_scene(path: &Path) -> Result<Option<Value>, OutputError> {
    let report = path.join(REPORT);
    let text = match fs::read_to_string(&report) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) if error.kind() == io::ErrorKind::InvalidData => return Err(OutputError::ForeignReport { report }),
        Err(error) => return Err(OutputError::io("read", &report)(error)),
    };
    let document: Option<Value> = serde_json::from_str(&text).ok();
    let scene = document.filter(|document| ["law", "result"].iter().all(|key| document[key].is_object()));
    match scene.map(|mut document| document["scene"].take()) {
        Some(scene) if scene.is_object() => Ok(Some(scene)),
        _ => Err(OutputError::ForeignReport { report }),
    }
}

/// A folder of results that is written aside and appears whole, or not at all when it is dropped.
#[derive(Debug)]
pub struct WholeFolder {
    target: PathBuf,
    aside: TempDir,
    kept: BTreeSet<PathBuf>,
}

impl WholeFolder {
    /// Opens a folder aside for the results that will appear at `target`.
    ///
    /// # Errors
    /// As `check_folder`; `Io` when no folder can be made.
    pub fn begin(target: &Path) -> Result<Self, OutputError> {
        check_folder(target)?;
        let mut builder = Builder::new();
        permit(&mut builder, 0o777);
        // Aside inside the target where there is one: it may be a mount point or a link.
        let (prefix, place) = if target.exists() {
            (ASIDE.to_owned(), target)
        } else {
            let place = parent(target);
            fs::create_dir_all(place).map_err(OutputError::io("create", place))?;
            let name = target.file_name().unwrap_or_default().to_string_lossy();
            (format!(".{name}{ASIDE}"), place)
        };
        let aside = builder.prefix(&prefix).tempdir_in(place).map_err(OutputError::io("create a folder in", place))?;
        Ok(Self { target: target.into(), aside, kept: BTreeSet::new() })
    }

    /// The folder to write into.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.aside.path()
    }

    /// Where the results will appear.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// The folder to write into as seen from the one of the results: a name in it, or `..` and a name beside it.
    #[must_use]
    pub fn place(&self) -> String {
        let name = self.path().file_name().unwrap_or_default().to_string_lossy();
        // By its name and not by its path, which may be absolute where the target is not.
        if name.starts_with(ASIDE) { name.into_owned() } else { format!("../{name}") }
    }

    /// How the names of what is written aside in the folder of the results begin.
    pub const ASIDE: &'static str = ASIDE;

    /// Whether a folder of this name was written aside.
    #[must_use]
    pub fn is_aside(name: &str) -> bool {
        name.contains(ASIDE)
    }

    /// Lets what was written aside stay when this goes without a commit, because a checkpoint counts on it.
    pub fn stay(&mut self) {
        self.aside.disable_cleanup(true);
    }

    /// Writes a single file at its final place (`name` is relative to it) while the run still goes
    /// on, synced: a checkpoint.
    ///
    /// # Errors
    /// As `write_file`.
    pub fn write_now(
        &self,
        name: &str,
        fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        let path = self.target.join(name);
        let folder = parent(&path);
        fs::create_dir_all(folder).map_err(OutputError::io("create", folder))?;
        write_file_synced(&path, fill)
    }

    /// Keeps a file that is already at its final place as part of the new result, unless the new
    /// result has one of this name: fields that a resumed run wrote before it was stopped.
    pub fn keep(&mut self, name: impl Into<PathBuf>) {
        self.kept.insert(name.into());
    }

    /// Makes the results appear at the target, in place of an earlier result; every file that no
    /// run writes stays.
    ///
    /// A new folder appears by one rename. In an existing one the files are renamed one by one,
    /// `report.json` taken away first and placed last, so that its presence says the rest is whole, and the checkpoint next
    /// to it, so that the fields that it counts on are there whenever it is.
    ///
    /// # Errors
    /// `Io` or `InTheWay`; then the earlier result is as it was and the new one is gone.
    pub fn commit(mut self) -> Result<(), OutputError> {
        if !self.target.exists() && fs::rename(self.aside.path(), &self.target).is_ok() {
            // Nothing is left under the old name for the guard to remove.
            let _ = self.aside.keep();
            return Ok(());
        }
        let mut moves = Moves::default();
        let placed = self.put(&mut moves);
        if placed.is_err() {
            moves.undo();
        } else {
            self.aside.disable_cleanup(false);
            // Only an empty folder goes: the earlier run had fields and this one has none.
            let _ = fs::remove_dir(self.target.join(FIELDS));
        }
        placed
    }

    fn put(&self, moves: &mut Moves) -> Result<(), OutputError> {
        let (aside, target) = (self.aside.path(), self.target.as_path());
        let mut new = results_in(aside, |_| true)?;
        let mut old = results_in(target, is_result)?;
        old.retain(|name| !self.kept.contains(name) || new.contains(name));
        old.sort_by_key(|name| std::cmp::Reverse(counting(name)));
        new.sort_by_key(|name| counting(name));
        let replaced = aside.join(REPLACED);
        for folder in [replaced.join(FIELDS), target.to_path_buf()] {
            fs::create_dir_all(&folder).map_err(OutputError::io("create", &folder))?;
        }
        for name in &old {
            moves.rename(target.join(name), replaced.join(name))?;
        }
        for name in &new {
            let place = target.join(name);
            if fs::symlink_metadata(&place).is_ok() {
                return Err(OutputError::InTheWay { path: place });
            }
            let folder = parent(&place);
            fs::create_dir_all(folder).map_err(OutputError::io("create", folder))?;
            moves.rename(aside.join(name), place)?;
        }
        Ok(())
    }
}

/// The more of the other files something counts on, the higher.
fn counting(name: &Path) -> u8 {
    u8::from(name == Path::new(CHECKPOINT)) + 2 * u8::from(name == Path::new(REPORT))
}

/// Renames done so far, to be taken back when a later one fails.
#[derive(Debug, Default)]
struct Moves(Vec<(PathBuf, PathBuf)>);

impl Moves {
    fn rename(&mut self, from: PathBuf, to: PathBuf) -> Result<(), OutputError> {
        fs::rename(&from, &to).map_err(OutputError::io("rename", &to))?;
        self.0.push((from, to));
        Ok(())
    }

    fn undo(&mut self) {
        for (from, to) in self.0.drain(..).rev() {
            // The first error is the one to report; what can be taken back is.
            let _ = fs::rename(to, from);
        }
    }
}

/// Whether a run writes a file of this name (relative to its folder).
fn is_result(name: &Path) -> bool {
    let text = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    if parent(name) == Path::new(FIELDS) {
        let (stem, ending) = (text(name.file_stem()), text(name.extension()));
        return stem.starts_with(FIELDS) && FIELD_ENDINGS.contains(&ending.as_str());
    }
    FILES.iter().any(|file| name == Path::new(file))
}

/// The files of a result folder and of its `fields`, relative, sorted, as far as `wanted`.
fn results_in(folder: &Path, wanted: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>, OutputError> {
    let mut found = Vec::new();
    if !folder.exists() {
        return Ok(found);
    }
    found.extend(names_in(folder)?.into_iter().map(PathBuf::from));
    let fields = folder.join(FIELDS);
    if fields.is_dir() {
        found.retain(|name| name != Path::new(FIELDS));
        found.extend(names_in(&fields)?.into_iter().map(|name| Path::new(FIELDS).join(name)));
    }
    found.retain(|name| wanted(name));
    found.sort();
    Ok(found)
}

fn names_in(folder: &Path) -> Result<Vec<String>, OutputError> {
    let entries = fs::read_dir(folder).map_err(OutputError::io("read", folder))?;
    let mut names = entries
        .map(|entry| entry.map(|entry| entry.file_name().to_string_lossy().into_owned()))
        .collect::<io::Result<Vec<_>>>()
        .map_err(OutputError::io("read", folder))?;
    names.sort();
    Ok(names)
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// Files made aside are private by default; results get what the user's mask allows.
fn permit(builder: &mut Builder<'_, '_>, mode: u32) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(mode));
    }
    #[cfg(not(unix))]
    let _ = (builder, mode);
}

#[cfg(test)]
mod tests;
