//! Where a law's entry function comes from: this program, a library file, or (in [`super::memory`]) a Rust type.
#![allow(unsafe_code)] // reason: an entry is a C function; the trait promises that it stays valid.

use std::path::Path;

use libloading::os::unix::{Library, RTLD_LOCAL, RTLD_NOW, Symbol};
use wearlaw_plugin_api::abi;

/// A source of laws: something that has the entry function of the ABI and keeps it valid.
///
/// # Safety
/// `call` behaves as the ABI says of `wearlaw_entry_1`, and every function that it puts into a table stays valid as
/// long as the entry lives.
pub unsafe trait Entry: Send + Sync {
    /// What messages call it: a path, or a name.
    fn name(&self) -> &str;

    /// Calls the entry function.
    ///
    /// # Safety
    /// `table` has its `struct_size` and presets.
    unsafe fn call(&self, index: i32, host: &'static abi::Host, table: &mut abi::LawTable) -> i32;
}

/// A law that is part of this program.
#[derive(Debug)]
pub struct Embedded {
    name: String,
    entry: abi::EntryFn,
}

impl Embedded {
    /// A law of this program by its entry function.
    ///
    /// # Safety
    /// `entry` keeps the contract of `wearlaw_entry_1`.
    pub unsafe fn new(name: &str, entry: abi::EntryFn) -> Self {
        Self { name: name.to_owned(), entry }
    }
}

// SAFETY: functions of this program are valid for all its life; the creator of the value promised the rest.
unsafe impl Entry for Embedded {
    fn name(&self) -> &str {
        &self.name
    }

    unsafe fn call(&self, index: i32, host: &'static abi::Host, table: &mut abi::LawTable) -> i32 {
        // SAFETY: the creator promised that the function keeps the ABI; the caller has prepared the table.
        unsafe { (self.entry)(index, host, table) }
    }
}

/// A shared library that has been opened; it is closed when the last law and instance of it are gone.
#[derive(Debug)]
pub struct LibraryFile {
    name: String,
    entry: abi::EntryFn,
    library: Library,
}

impl LibraryFile {
    /// Opens a library with all symbols resolved at once and kept local, which runs its constructors.
    ///
    /// # Errors
    /// The linker's refusal, or no entry function.
    ///
    /// # Safety
    /// The file's constructors and its entry function keep the ABI's contract; nothing can check that beforehand.
    pub unsafe fn open(path: &Path) -> Result<Self, libloading::Error> {
        // A bare file name would be searched for in the system's folders.
        let named = if path.components().count() == 1 { Path::new(".").join(path) } else { path.to_owned() };
        // SAFETY: the caller answers for what the library's constructors do.
        let library = unsafe { Library::open(Some(&named), RTLD_NOW | RTLD_LOCAL) }?;
        // SAFETY: by the ABI, a symbol of this name is a function of this type.
        let entry: Symbol<abi::EntryFn> = unsafe { library.get(abi::ENTRY_SYMBOL) }?;
        let entry = *entry;
        Ok(Self { name: path.display().to_string(), entry, library })
    }

    /// Compares the type layout that a law in Rust exports with this host's; see [`super::layout_check`].
    ///
    /// # Errors
    /// The layouts differ.
    #[cfg(feature = "layout-check")]
    pub fn check_layout(&self) -> Result<(), super::layout_check::LayoutMismatch> {
        super::layout_check::check_library(&self.library)
    }

    /// Address of an exported symbol, valid as long as this value lives; none if there is no such symbol.
    pub fn address(&self, symbol: &[u8]) -> Option<*const std::ffi::c_void> {
        // SAFETY: the symbol is taken as an address only; whoever follows it must know what is there.
        let found: Symbol<*const std::ffi::c_void> = unsafe { self.library.get(symbol) }.ok()?;
        Some(found.into_raw().cast_const())
    }
}

// SAFETY: the library stays open as long as the value lives, and with it every function it named; that they keep the
// ABI's contract was promised to `open`.
unsafe impl Entry for LibraryFile {
    fn name(&self) -> &str {
        &self.name
    }

    unsafe fn call(&self, index: i32, host: &'static abi::Host, table: &mut abi::LawTable) -> i32 {
        // SAFETY: `library` is open, so the function is mapped; the caller has prepared the table.
        unsafe { (self.entry)(index, host, table) }
    }
}
