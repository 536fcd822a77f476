//! Where a law's entry function comes from: this program, a library file, or a Rust type in memory.
#![allow(unsafe_code)] // reason: an entry is a C function; the trait promises that it stays valid.

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
    unsafe fn call(&self, index: i32, host: &abi::Host, table: &mut abi::LawTable) -> i32;
}

/// A law that is part of this program.
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
        Self {
            name: name.to_owned(),
            entry,
        }
    }
}

// SAFETY: functions of this program are valid for all its life; the creator of the value promised the rest.
unsafe impl Entry for Embedded {
    fn name(&self) -> &str {
        &self.name
    }

    unsafe fn call(&self, index: i32, host: &abi::Host, table: &mut abi::LawTable) -> i32 {
        // SAFETY: the creator promised that the function keeps the ABI; the caller has prepared the table.
        unsafe { (self.entry)(index, host, table) }
    }
}
