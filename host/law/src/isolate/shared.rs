//! Memory that parent and worker share: a file without a name, mapped by both.
#![allow(unsafe_code)] // reason: maps memory that another process writes to.

use std::fs::File;
use std::io;
use std::os::fd::{AsRawFd, FromRawFd, RawFd};

use memmap2::MmapRaw;

use super::protocol::{WORD_AT_END, WORD_AT_FIRST, WORD_BYTES};

/// Shared memory as 64-bit words.
///
/// Parent and worker take turns: the one that waits for the other's byte touches nothing but the two words that say
/// where the law is.
pub(super) struct Shared {
    file: File,
    map: MmapRaw,
}

impl Shared {
    /// Makes memory of so many words, all zero.
    pub(super) fn create(words: usize) -> io::Result<Self> {
        // SAFETY: the name is closed by a NUL; the call touches no other memory.
        let descriptor = unsafe { libc::memfd_create(c"wearlaw".as_ptr(), libc::MFD_CLOEXEC) };
        if descriptor < 0 {
            return Err(io::Error::last_os_error());
        }
        // SAFETY: the descriptor was just made and belongs to nobody else.
        let file = unsafe { File::from_raw_fd(descriptor) };
        file.set_len(8 * words as u64)?;
        let map = MmapRaw::map_raw(&file)?;
        Ok(Self { file, map })
    }

    /// Maps the memory of an inherited descriptor.
    pub(super) fn inherit(descriptor: RawFd) -> io::Result<Self> {
        // SAFETY: the parent made the descriptor for this process, which opens it once.
        let file = unsafe { File::from_raw_fd(descriptor) };
        let map = MmapRaw::map_raw(&file)?;
        Ok(Self { file, map })
    }

    /// The descriptor, for the worker to inherit.
    pub(super) fn descriptor(&self) -> RawFd {
        self.file.as_raw_fd()
    }

    /// Number of words.
    pub(super) fn len(&self) -> usize {
        self.map.len() / 8
    }

    /// Makes room for so many words, in the parent; what was there before is kept.
    pub(super) fn reserve(&mut self, words: usize) -> io::Result<()> {
        if words > self.len() {
            // Twice the size, so that growing batches do not map the memory anew each time.
            let words = words.max(2 * self.len());
            self.file.set_len(8 * words as u64)?;
            self.map = MmapRaw::map_raw(&self.file)?;
        }
        Ok(())
    }

    /// Maps the memory anew if the parent made it larger, in the worker.
    pub(super) fn follow(&mut self) -> io::Result<()> {
        if self.words(WORD_BYTES, 1)[0] > 8 * self.len() as u64 {
            self.map = MmapRaw::map_raw(&self.file)?;
        }
        Ok(())
    }

    /// Words from `offset` on.
    ///
    /// # Panics
    /// If they reach beyond the memory, as indexing a slice does.
    pub(super) fn words(&self, offset: usize, length: usize) -> &[u64] {
        let first = self.at(offset, length);
        // SAFETY: `at` checked the range; it is this process's turn, so nobody writes there.
        unsafe { std::slice::from_raw_parts(first, length) }
    }

    /// Words from `offset` on, to write.
    ///
    /// # Panics
    /// As [`Shared::words`].
    pub(super) fn words_mut(&mut self, offset: usize, length: usize) -> &mut [u64] {
        let first = self.at(offset, length);
        // SAFETY: `at` checked the range; it is this process's turn, and `self` is borrowed as exclusive.
        unsafe { std::slice::from_raw_parts_mut(first, length) }
    }

    /// The address of a range that lies in the memory.
    pub(super) fn at(&self, offset: usize, length: usize) -> *mut u64 {
        let end = offset.checked_add(length).expect("a range of words ends below the largest number");
        assert!(end <= self.len(), "words {offset} to {end} of {}", self.len());
        self.map.as_mut_ptr().cast::<u64>().wrapping_add(offset)
    }

    /// Notes in the worker which points the law is at.
    pub(super) fn note(&self, points: &std::ops::Range<usize>) {
        for (word, value) in [(WORD_AT_FIRST, points.start), (WORD_AT_END, points.end)] {
            // SAFETY: `at` checked the range; volatile, because the parent reads it if this process dies right after.
            unsafe { self.at(word, 1).write_volatile(value as u64) };
        }
    }

    /// Which points of `points` the law was at when the worker was lost.
    pub(super) fn noted(&self, points: usize) -> std::ops::Range<usize> {
        let [first, end] = [WORD_AT_FIRST, WORD_AT_END].map(|word| self.words(word, 1)[0]);
        // A law that went astray may have written there too.
        match (usize::try_from(first), usize::try_from(end)) {
            (Ok(first), Ok(end)) if first < end && end <= points => first..end,
            _ => 0..points,
        }
    }
}
