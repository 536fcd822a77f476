//! Arrays for a call, with room around them or with a page right behind or before them that nobody may touch.
#![allow(unsafe_code)] // reason: maps and protects memory, and hands its addresses to a law.

use super::fault_note;

/// What surrounds an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Room {
    /// Zeros on both sides, so that a slip over the end changes no answer.
    Plain,
    /// A page right behind it that nobody may touch.
    GuardBehind,
    /// A page right before it that nobody may touch.
    GuardBefore,
}

/// Bytes of zeros on either side of a plain array; also the alignment, that of a cache line.
const PADDING: usize = 1024;
const ALIGNMENT: usize = 64;

/// Address space that arrays with guards are cut from: a call has some thirty, and to map each by itself takes its time.
struct Region {
    first: *mut u8,
    length: usize,
    used: usize,
}

/// Pages of a region, more than the arrays of a small call take.
const PAGES: usize = 256;

struct Block {
    /// Of the allocation, or of the pages with the guards around them.
    first: *mut u8,
    length: usize,
    /// Of the pages that hold the array.
    pages: (*mut u8, usize),
    read_only: bool,
    #[allow(dead_code, reason = "the fault notes point at it")]
    name: Box<str>,
}

/// The arrays of one call; they are freed with the value.
pub(crate) struct Arrays {
    room: Room,
    /// Bytes by which plain arrays are moved away from a multiple of [`ALIGNMENT`].
    skew: usize,
    /// Which arrays begin eight bytes later.
    skews: u64,
    blocks: Vec<Block>,
    regions: Vec<Region>,
    watched: usize,
}

impl Arrays {
    /// No arrays yet; plain ones will begin `skew` bytes, below [`ALIGNMENT`], behind the start of a cache line.
    pub(crate) fn new(room: Room, skew: usize) -> Self {
        let (blocks, regions) = (Vec::new(), Vec::new());
        Self { room, skew: skew % ALIGNMENT, skews: 0, blocks, regions, watched: fault_note::watched() }
    }

    /// The same, the arrays whose bit is set, in the order in which they are made, beginning eight bytes later if plain.
    pub(crate) fn skewed(mut self, skews: u64) -> Self {
        self.skews = skews;
        self
    }

    /// Makes a zeroed array of so many bytes.
    ///
    /// # Panics
    /// If the system has no memory.
    pub(crate) fn place(&mut self, name: &str, bytes: usize, read_only: bool) -> *mut u8 {
        match self.room {
            Room::Plain => self.place_plain(name, bytes, read_only),
            Room::GuardBehind | Room::GuardBefore => self.place_guarded(name, bytes, read_only),
        }
    }

    fn place_plain(&mut self, name: &str, bytes: usize, read_only: bool) -> *mut u8 {
        let length = bytes + 2 * PADDING + ALIGNMENT;
        let layout = std::alloc::Layout::from_size_align(length, ALIGNMENT).expect("a size below the largest");
        // SAFETY: the layout is not empty.
        let first = unsafe { std::alloc::alloc_zeroed(layout) };
        if first.is_null() {
            std::alloc::handle_alloc_error(layout);
        }
        let pages = (std::ptr::null_mut(), 0);
        let later = 8 * ((self.skews >> (self.blocks.len() % 64)) & 1) as usize;
        self.blocks.push(Block { first, length, pages, read_only, name: name.into() });
        first.wrapping_add(PADDING + (self.skew + later) % ALIGNMENT)
    }

    fn place_guarded(&mut self, name: &str, bytes: usize, read_only: bool) -> *mut u8 {
        let page = page_size();
        let data = bytes.div_ceil(page) * page;
        let length = data + 2 * page;
        let first = self.reserve(length);
        let pages = first.wrapping_add(page);
        if data > 0 {
            // SAFETY: the range lies in what was just reserved.
            let done = unsafe { libc::mprotect(pages.cast(), data, libc::PROT_READ | libc::PROT_WRITE) };
            assert_eq!(done, 0, "{}", std::io::Error::last_os_error());
        }
        let start = if self.room == Room::GuardBehind { pages.wrapping_add(data - bytes) } else { pages };
        let name: Box<str> = name.into();
        let at = start as usize;
        fault_note::watch(first as usize, first as usize + length, at, at + bytes, &name);
        self.blocks.push(Block { first, length, pages: (pages, data), read_only, name });
        start
    }

    /// Address space of so many bytes, whole pages that nobody may touch yet.
    fn reserve(&mut self, length: usize) -> *mut u8 {
        if self.regions.last().is_none_or(|region| region.length - region.used < length) {
            let whole = length.max(PAGES * page_size());
            let (access, kind) = (libc::PROT_NONE, libc::MAP_PRIVATE | libc::MAP_ANONYMOUS);
            // SAFETY: asks for fresh memory anywhere; the result is checked.
            let first = unsafe { libc::mmap(std::ptr::null_mut(), whole, access, kind, -1, 0) };
            assert!(first != libc::MAP_FAILED, "{whole} bytes of memory: {}", std::io::Error::last_os_error());
            self.regions.push(Region { first: first.cast(), length: whole, used: 0 });
        }
        let region = self.regions.last_mut().expect("one was just made if there was none");
        let first = region.first.wrapping_add(region.used);
        region.used += length;
        first
    }

    /// Lets nobody write to the arrays that are for reading only; only arrays with guards can be sealed.
    pub(crate) fn seal(&self) {
        for block in self.blocks.iter().filter(|block| block.read_only && block.pages.1 > 0) {
            // SAFETY: the pages belong to the block and hold nothing else.
            let done = unsafe { libc::mprotect(block.pages.0.cast(), block.pages.1, libc::PROT_READ) };
            assert_eq!(done, 0, "{}", std::io::Error::last_os_error());
        }
    }
}

impl Drop for Arrays {
    fn drop(&mut self) {
        fault_note::forget_from(self.watched);
        for block in self.blocks.iter().filter(|_| self.room == Room::Plain) {
            let layout = std::alloc::Layout::from_size_align(block.length, ALIGNMENT);
            let layout = layout.expect("it was allocated with the same");
            // SAFETY: `place_plain` allocated it with this layout, and nothing refers to it any more.
            unsafe { std::alloc::dealloc(block.first, layout) };
        }
        for region in &self.regions {
            // SAFETY: `reserve` mapped exactly this, and nothing refers to it any more.
            unsafe { libc::munmap(region.first.cast(), region.length) };
        }
    }
}

fn page_size() -> usize {
    // SAFETY: takes an integer and touches no memory.
    usize::try_from(unsafe { libc::sysconf(libc::_SC_PAGESIZE) }).unwrap_or(4096)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_guarded_array_ends_or_begins_at_a_page() {
        let page = page_size();
        for bytes in [0, 8, 24, 4096, 4104] {
            let mut arrays = Arrays::new(Room::GuardBehind, 0);
            let first = arrays.place("a", bytes, true);
            assert_eq!((first as usize + bytes) % page, 0, "{bytes}");
            arrays.seal();
            let mut arrays = Arrays::new(Room::GuardBefore, 0);
            assert_eq!(arrays.place("a", bytes, false) as usize % page, 0, "{bytes}");
        }
        assert_eq!(fault_note::watched(), 0);
    }

    #[test]
    fn arrays_with_guards_share_no_page() {
        let page = page_size();
        let (mut arrays, mut ranges) = (Arrays::new(Room::GuardBehind, 0), Vec::new());
        for bytes in [8, 3 * page, 0, PAGES * page, 24] {
            let end = arrays.place("a", bytes, false) as usize + bytes;
            ranges.push((end - bytes.div_ceil(page) * page - page, end + page));
        }
        for (at, one) in ranges.iter().enumerate() {
            let apart = |other: &(usize, usize)| one.1 <= other.0 || other.1 <= one.0;
            assert!(ranges[at + 1..].iter().all(apart), "{ranges:x?}");
        }
        assert_eq!(arrays.regions.len(), 3, "a large array has a region of its own, and what follows another");
    }

    #[test]
    fn a_plain_array_is_aligned_and_zero() {
        let mut arrays = Arrays::new(Room::Plain, 0);
        let first = arrays.place("a", 80, false);
        assert_eq!(first as usize % ALIGNMENT, 0);
        // SAFETY: the array has 80 bytes, and padding before and behind.
        let bytes = unsafe { std::slice::from_raw_parts(first.sub(PADDING), 80 + 2 * PADDING) };
        assert!(bytes.iter().all(|byte| *byte == 0));
    }
}
