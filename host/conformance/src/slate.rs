//! Memory that the checker and its worker share: the task, the breadcrumb and the answer.
#![allow(unsafe_code)] // reason: memory that another process writes to, also when it is about to crash.

use std::fs::File;
use std::io;
use std::os::fd::{AsRawFd, FromRawFd, RawFd};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use memmap2::MmapRaw;

/// What of the law is running.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u64)]
pub(super) enum Phase {
    /// Nothing of it: the checker itself.
    Checker,
    /// Its constructors, while the library is loaded.
    Opening,
    /// Its entry function.
    Entry,
    /// Its `describe`.
    Describing,
    /// Its `extension`.
    Extension,
    /// Its `create`.
    Creating,
    /// Its `evaluate`.
    Evaluating,
    /// Its `destroy`.
    Destroying,
    /// Its destructors, while the library is unloaded.
    Closing,
}

impl Phase {
    const ALL: [Phase; 9] = [
        Self::Checker,
        Self::Opening,
        Self::Entry,
        Self::Describing,
        Self::Extension,
        Self::Creating,
        Self::Evaluating,
        Self::Destroying,
        Self::Closing,
    ];

    /// The phase in the words of a report.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Checker => "outside of the law's functions",
            Self::Opening => "while the library was loaded",
            Self::Entry => "in wearlaw_entry_1",
            Self::Describing => "in describe",
            Self::Extension => "in extension",
            Self::Creating => "in create",
            Self::Evaluating => "in evaluate",
            Self::Destroying => "in destroy",
            Self::Closing => "while the library was unloaded",
        }
    }
}

/// What kind of memory a fault touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u64)]
pub(super) enum Touched {
    /// No fault was noted.
    Nothing,
    /// The page right behind an array.
    Behind,
    /// The page right before an array.
    Before,
    /// An array that may only be read.
    ReadOnly,
    /// The end of the stack.
    Stack,
    /// The first page: a pointer that was NULL.
    Null,
    /// Somewhere else.
    Elsewhere,
}

impl Touched {
    const ALL: [Touched; 7] =
        [Self::Nothing, Self::Behind, Self::Before, Self::ReadOnly, Self::Stack, Self::Null, Self::Elsewhere];
}

/// What the law was doing last, as the worker noted it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Crumb {
    pub(super) phase: Phase,
    /// Number of the call of `evaluate`, from 1.
    pub(super) call: u64,
    /// Points of that call.
    pub(super) points: u64,
    /// What the checker was about, in words.
    pub(super) label: String,
    /// How long ago the law was last called with a single point, where points were tried one by one.
    pub(super) stayed: Duration,
    /// Inputs at the first point of the call, a line each, `name value`.
    pub(super) input: String,
    pub(super) touched: Touched,
    /// The array that was touched, and how many bytes from its nearer end.
    pub(super) array: String,
    pub(super) offset: u64,
}

const WORD_PHASE: usize = 0;
const WORD_CALL: usize = 1;
const WORD_POINTS: usize = 2;
const WORD_TOUCHED: usize = 3;
const WORD_OFFSET: usize = 4;
const WORD_SINCE: usize = 5;

/// A text in the memory: the word of its length, its first byte, its room.
struct Text {
    length: usize,
    first: usize,
    room: usize,
}

const TASK: Text = Text { length: 8, first: 0x1000, room: 0x1_0000 };
const LABEL: Text = Text { length: 9, first: 0x1_1000, room: 0x400 };
const INPUT: Text = Text { length: 10, first: 0x1_1400, room: 0x8000 };
const ARRAY: Text = Text { length: 11, first: 0x1_9400, room: 0x100 };
const ANSWER: Text = Text { length: 12, first: 0x2_0000, room: 0x8_0000 };
const BYTES: u64 = 0xa_0000;

/// The shared memory.
pub(super) struct Slate {
    file: File,
    map: MmapRaw,
}

impl Slate {
    /// Makes the memory, in the checker.
    pub(super) fn create() -> io::Result<Self> {
        let file = memory_file()?;
        file.set_len(BYTES)?;
        Ok(Self { map: MmapRaw::map_raw(&file)?, file })
    }

    /// Maps the memory of an inherited descriptor, in the worker.
    pub(super) fn inherit(descriptor: RawFd) -> io::Result<Self> {
        // SAFETY: the checker made the descriptor for this process, which opens it once.
        let file = unsafe { File::from_raw_fd(descriptor) };
        let map = MmapRaw::map_raw(&file)?;
        if map.len() as u64 != BYTES {
            return Err(io::Error::other("shared memory of another size"));
        }
        Ok(Self { file, map })
    }

    /// The descriptor, for the worker to inherit.
    pub(super) fn descriptor(&self) -> RawFd {
        self.file.as_raw_fd()
    }

    fn word(&self, index: usize) -> &AtomicU64 {
        assert!(index < 16);
        // SAFETY: the memory is longer than 16 words, aligned to a page, and lives as long as `self`; words are only
        // reached as atomics, in both processes.
        unsafe { &*self.map.as_mut_ptr().cast::<AtomicU64>().add(index) }
    }

    fn put(&self, text: &Text, bytes: &[u8]) -> bool {
        let length = bytes.len().min(text.room);
        self.word(text.length).store(0, Ordering::Release);
        // SAFETY: the room lies in the memory; the other process reads it only once the length is there, or when this
        // process is gone.
        unsafe { self.map.as_mut_ptr().add(text.first).copy_from_nonoverlapping(bytes.as_ptr(), length) };
        self.word(text.length).store(length as u64, Ordering::Release);
        length == bytes.len()
    }

    fn get(&self, text: &Text) -> Vec<u8> {
        // A law that went astray may have written there too.
        let length = (self.word(text.length).load(Ordering::Acquire) as usize).min(text.room);
        let mut bytes = vec![0; length];
        // SAFETY: the range lies in the memory, and any bytes are bytes.
        unsafe { bytes.as_mut_ptr().copy_from_nonoverlapping(self.map.as_ptr().add(text.first), length) };
        bytes
    }

    /// Leaves the task; false if it is too long.
    pub(super) fn put_task(&self, bytes: &[u8]) -> bool {
        self.put(&TASK, bytes)
    }

    /// Takes the task.
    pub(super) fn task(&self) -> Vec<u8> {
        self.get(&TASK)
    }

    /// Leaves the answer; false if it is too long.
    pub(super) fn put_answer(&self, bytes: &[u8]) -> bool {
        self.put(&ANSWER, bytes)
    }

    /// Takes the answer; empty if there is none.
    pub(super) fn answer(&self) -> Vec<u8> {
        self.get(&ANSWER)
    }

    /// Notes what of the law runs from now on; answers what ran before.
    pub(super) fn enter(&self, phase: Phase) -> Phase {
        let before = self.word(WORD_PHASE).swap(phase as u64, Ordering::AcqRel);
        Phase::ALL.get(before as usize).copied().unwrap_or(Phase::Checker)
    }

    /// Notes what the checker is about.
    pub(super) fn label(&self, words: &str) {
        self.put(&LABEL, words.as_bytes());
    }

    /// Notes that one more call begins, of so many points; answers its number.
    pub(super) fn count_call(&self, points: usize) -> u64 {
        self.word(WORD_POINTS).store(points as u64, Ordering::Release);
        self.word(WORD_CALL).fetch_add(1, Ordering::AcqRel) + 1
    }

    /// Notes how many points the law is called with, where that is not what the call as a whole has.
    pub(super) fn points(&self, points: usize) {
        self.word(WORD_POINTS).store(points as u64, Ordering::Release);
    }

    /// Notes that the law is called with one point now.
    pub(super) fn single_begins(&self) {
        self.word(WORD_SINCE).store(milliseconds(), Ordering::Release);
    }

    /// Notes the inputs at the first point of the call.
    pub(super) fn input(&self, lines: &[u8]) {
        self.put(&INPUT, lines);
    }

    /// Notes a fault; only makes stores, so that a signal handler may call it.
    pub(super) fn fault(&self, touched: Touched, array: &[u8], offset: u64) {
        self.word(WORD_TOUCHED).store(touched as u64, Ordering::Release);
        self.word(WORD_OFFSET).store(offset, Ordering::Release);
        self.put(&ARRAY, array);
    }

    /// The breadcrumb.
    pub(super) fn crumb(&self) -> Crumb {
        let number = |index: usize| self.word(index).load(Ordering::Acquire);
        let text = |text: &Text| String::from_utf8_lossy(&self.get(text)).into_owned();
        Crumb {
            phase: Phase::ALL.get(number(WORD_PHASE) as usize).copied().unwrap_or(Phase::Checker),
            call: number(WORD_CALL),
            points: number(WORD_POINTS),
            label: text(&LABEL),
            stayed: Duration::from_millis(milliseconds().saturating_sub(number(WORD_SINCE))),
            input: text(&INPUT),
            touched: Touched::ALL.get(number(WORD_TOUCHED) as usize).copied().unwrap_or(Touched::Elsewhere),
            array: text(&ARRAY),
            offset: number(WORD_OFFSET),
        }
    }
}

/// A clock that two processes share.
fn milliseconds() -> u64 {
    let mut now = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the struct lives through the call.
    unsafe { libc::clock_gettime(libc::CLOCK_MONOTONIC, &mut now) };
    1000 * now.tv_sec.cast_unsigned() + now.tv_nsec.cast_unsigned() / 1_000_000
}

/// A file without a name, in memory, that goes with its last descriptor.
pub(super) fn memory_file() -> io::Result<File> {
    // SAFETY: the name is closed by a NUL; the call touches no other memory.
    let descriptor = unsafe { libc::memfd_create(c"wearlaw-check".as_ptr(), libc::MFD_CLOEXEC) };
    if descriptor < 0 {
        return Err(io::Error::last_os_error());
    }
    // SAFETY: the descriptor was just made and belongs to nobody else.
    Ok(unsafe { File::from_raw_fd(descriptor) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_see_the_same() {
        let slate = Slate::create().unwrap();
        // SAFETY: takes an integer; the copy belongs to the other side alone.
        let copy = unsafe { libc::dup(slate.descriptor()) };
        let other = Slate::inherit(copy).unwrap();
        assert!(slate.put_task(b"do it"));
        assert_eq!(other.task(), b"do it");
        assert!(other.answer().is_empty());
        other.label("a label");
        other.input(b"pressure 5e7\n");
        assert_eq!(other.enter(Phase::Evaluating), Phase::Checker);
        assert_eq!((other.count_call(3), other.count_call(7)), (1, 2));
        other.fault(Touched::Behind, b"pressure", 8);
        let crumb = slate.crumb();
        assert_eq!((crumb.phase, crumb.call, crumb.points), (Phase::Evaluating, 2, 7));
        assert_eq!((crumb.label.as_str(), crumb.input.as_str()), ("a label", "pressure 5e7\n"));
        assert_eq!((crumb.touched, crumb.array.as_str(), crumb.offset), (Touched::Behind, "pressure", 8));
    }

    #[test]
    fn what_a_law_wrote_over_it_is_no_reason_to_panic() {
        let slate = Slate::create().unwrap();
        for index in 0..16 {
            slate.word(index).store(u64::MAX, Ordering::Release);
        }
        assert_eq!(slate.crumb().phase, Phase::Checker);
        assert_eq!(slate.answer().len(), ANSWER.room);
        assert!(!slate.put_task(&vec![b'x'; TASK.room + 1]));
    }
}
