//! When checkpoints of a run are written and where, and how the fields of its earlier part come into its results.
//!
//! While a run goes on, its checkpoint is the file `checkpoint` in the folder of the results, and the fields that it counts
//! on are in the folder aside that the results are written into. A run that ends leaves both in the folder of the results.

use std::fs::{self, File};
use std::path::{Component, Path, PathBuf};
use std::time::{Duration, Instant};

use super::{EarlierFields, EarlierFile, read_checkpoint, write_checkpoint};
use crate::output::{FieldSeries, OutputError, WholeFolder, write_file};
use crate::record::{Checkpoint, Identity};

/// Name of the file.
pub const CHECKPOINT: &str = "checkpoint";
/// Name of the folder of fields.
const FIELDS: &str = "fields";
/// Name of the locked file in a folder aside.
const LOCK: &str = ".running";

/// Writes the checkpoints of one run, and its results as a whole.
#[derive(Debug)]
pub struct Keeper {
    folder: WholeFolder,
    identity: Identity,
    interval: Option<Duration>,
    written: Instant,
    /// Whether a checkpoint of this run is at its place while the run goes on.
    placed: bool,
    /// Whether the last checkpoint is with the results.
    finished: bool,
    /// Fields whose bytes are on the disk.
    synced: usize,
    /// Locked in the folder aside as long as this run lives, so that a later one can tell what a killed run left behind.
    lock: Option<File>,
    /// A folder aside of an earlier part of the run, which goes when nothing counts on it any more.
    left_over: Option<PathBuf>,
}

impl Keeper {
    /// Writes a checkpoint every `interval` seconds at most; `None`: only the last.
    #[must_use]
    pub fn new(folder: WholeFolder, identity: Identity, interval: Option<f64>) -> Self {
        let interval = interval.map(|seconds| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX));
        let written = Instant::now();
        // Where there are no locks, nothing is ever cleared away.
        let lock = File::create(folder.path().join(LOCK)).ok().filter(|file| file.try_lock().is_ok());
        Self { folder, identity, interval, written, placed: false, finished: false, synced: 0, lock, left_over: None }
    }

    /// The folder that the results are written into.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Brings the fields of the earlier part of a run into the new results.
    ///
    /// # Errors
    /// Fields that are not there any more, or not whole.
    pub fn take_up(&mut self, earlier: &EarlierFields, series: Option<&mut FieldSeries>) -> Result<(), OutputError> {
        let place = place_of(self.folder.target(), &earlier.place);
        if let (Some(series), Some(place)) = (series, &place) {
            for file in &earlier.files {
                let from = place.join(FIELDS).join(plain(&file.name));
                let found = match fs::metadata(&from) {
                    Ok(found) if found.len() == file.bytes => None,
                    Ok(found) => Some(format!("{} bytes", found.len())),
                    Err(error) => Some(error.to_string()),
                };
                if let Some(found) = found {
                    return Err(OutputError::EarlierFields { path: from, found, expected: file.bytes });
                }
                let to = series.folder().join(plain(&file.name));
                // A second name is enough: nobody writes into a file of results, they are replaced.
                fs::hard_link(&from, &to)
                    .or_else(|_| fs::copy(&from, &to).map(|_| ()))
                    .map_err(OutputError::io("copy", &from))?;
            }
            series.resume(earlier.files.iter().map(|file| (file.time, plain(&file.name).to_owned())));
        }
        if earlier.place != "." {
            self.left_over = place;
        }
        Ok(())
    }

    /// Clears away what killed runs of the same results left behind and no checkpoint counts on.
    pub fn sweep(&self) {
        let target = self.folder.target();
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        for (place, prefix) in [(target, String::new()), (beside(target), format!(".{name}"))] {
            for entry in fs::read_dir(place).into_iter().flatten().flatten() {
                let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
                let aside = name.strip_prefix(&prefix).is_some_and(|rest| rest.starts_with(WholeFolder::ASIDE));
                if !aside || path == self.path() || self.left_over.as_ref() == Some(&path) {
                    continue;
                }
                // What cannot be removed only takes room.
                let _ = match path.is_dir() {
                    true if is_dead(&path) => fs::remove_dir_all(&path),
                    true => Ok(()),
                    false => fs::remove_file(&path),
                };
            }
        }
    }

    /// Whether a checkpoint is wanted now.
    #[must_use]
    pub fn is_due(&self, last: bool) -> bool {
        last || self.interval.is_some_and(|interval| self.written.elapsed() >= interval)
    }

    /// Writes a checkpoint; the last one also among the results.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(
        &mut self,
        checkpoint: &Checkpoint<'_>,
        series: Option<&FieldSeries>,
        last: bool,
    ) -> Result<(), OutputError> {
        let mut fields = EarlierFields { place: ".".to_owned(), files: Vec::new() };
        for (time, name) in series.map_or(&[][..], FieldSeries::files) {
            let path = self.path().join(FIELDS).join(name);
            let bytes = fs::metadata(&path).map_err(OutputError::io("read", &path))?.len();
            fields.files.push(EarlierFile { name: name.clone(), time: *time, bytes });
        }
        if last {
            let path = self.path().join(CHECKPOINT);
            write_file(&path, |to| write_checkpoint(to, &self.identity, &fields, true, checkpoint))?;
            self.finished = true;
        }
        if self.interval.is_some() {
            for file in fields.files.iter().skip(self.synced) {
                let path = self.path().join(FIELDS).join(&file.name);
                File::open(&path).and_then(|file| file.sync_all()).map_err(OutputError::io("write", &path))?;
            }
            self.synced = fields.files.len();
            fields.place = self.folder.place();
            self.folder.write_now(CHECKPOINT, |to| write_checkpoint(to, &self.identity, &fields, false, checkpoint))?;
            self.folder.stay();
            self.placed = true;
            self.clean();
            self.written = Instant::now();
        }
        Ok(())
    }

    fn clean(&mut self) {
        if let Some(folder) = self.left_over.take().filter(|folder| folder != self.path()) {
            // What cannot be removed only takes room.
            let _ = fs::remove_dir_all(folder);
        }
    }

    /// Makes the results appear at their place, with the newest checkpoint there is.
    ///
    /// # Errors
    /// As the folder's.
    pub fn commit(mut self) -> Result<(), OutputError> {
        if !self.finished && self.placed {
            // The run failed where it cannot be gone on from: the last place before stands, its fields here.
            let mut stored = read_checkpoint(&self.folder.target().join(CHECKPOINT))?;
            stored.fields.place = ".".to_owned();
            write_file(&self.path().join(CHECKPOINT), |to| {
                write_checkpoint(to, &stored.identity, &stored.fields, true, &stored.checkpoint)
            })?;
        }
        if self.lock.take().is_some() {
            let path = self.path().join(LOCK);
            fs::remove_file(&path).map_err(OutputError::io("remove", &path))?;
        }
        let left_over = self.left_over.take().filter(|folder| folder != self.path());
        self.folder.commit()?;
        if let Some(folder) = left_over {
            let _ = fs::remove_dir_all(folder);
        }
        Ok(())
    }
}

/// The folder that a checkpoint names relative to the results: themselves, or a folder aside in or beside them.
fn place_of(out: &Path, place: &str) -> Option<PathBuf> {
    if place == "." {
        return Some(out.to_owned());
    }
    let mut parts = Path::new(place).components();
    let (is_beside, name) = match (parts.next()?, parts.next()) {
        (Component::ParentDir, Some(Component::Normal(name))) => (true, name),
        (Component::Normal(name), None) => (false, name),
        _ => return None,
    };
    let aside = parts.next().is_none() && WholeFolder::is_aside(&name.to_string_lossy());
    let folder = if is_beside { beside(out) } else { out };
    aside.then(|| folder.join(name))
}

/// The folder in which a folder of results lies.
fn beside(out: &Path) -> &Path {
    out.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."))
}

/// Whether the run that wrote a folder aside is no more; one without the file was being made or cleared away.
fn is_dead(aside: &Path) -> bool {
    match File::open(aside.join(LOCK)) {
        Ok(lock) => lock.try_lock().is_ok(),
        Err(error) => error.kind() == std::io::ErrorKind::NotFound,
    }
}

/// A name without any folder in it.
fn plain(name: &str) -> &str {
    Path::new(name).file_name().and_then(|name| name.to_str()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_folders_that_were_written_aside_are_places_of_fields() {
        let out = Path::new("a/run.out");
        assert_eq!(place_of(out, "."), Some(out.to_owned()));
        assert_eq!(place_of(out, ".partial-xyz"), Some(out.join(".partial-xyz")));
        assert_eq!(place_of(out, "../.run.out.partial-xyz"), Some(PathBuf::from("a/.run.out.partial-xyz")));
        assert_eq!(
            place_of(Path::new("run.out"), "../.run.out.partial-x"),
            Some(PathBuf::from("./.run.out.partial-x"))
        );
        for other in ["", "fields", "..", "../..", "../../.partial-x", "/.partial-x", "../.partial-x/b", "../home"] {
            assert_eq!(place_of(out, other), None, "{other}");
        }
    }
}
