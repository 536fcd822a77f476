//! A law's table of functions, bound to the entry that keeps the functions valid.
#![allow(unsafe_code)] // reason: calls the functions of a law through the C ABI.

use std::ffi::{CString, c_char, c_void};
use std::sync::{Arc, OnceLock};

use wearlaw_plugin_api::abi;

use super::describe::{DescribeError, describe};
use super::descriptor::LawDescriptor;
use super::entry::Entry;

/// What this host says of itself to every law.
pub fn this_host() -> &'static abi::Host {
    static HOST: OnceLock<abi::Host> = OnceLock::new();
    HOST.get_or_init(|| abi::Host {
        struct_size: size_of::<abi::Host>() as i64,
        abi_minor: i64::from(abi::WL_ABI_MINOR),
        provides: abi::WL_FIELDS_KNOWN,
        accepts: abi::WL_OUTS_KNOWN,
        name: chars("wearlaw"),
        version: chars(env!("CARGO_PKG_VERSION")),
    })
}

/// A NUL-terminated text in a fixed array, cut where it does not fit.
pub fn chars<const SIZE: usize>(text: &str) -> [c_char; SIZE] {
    let mut array = [0; SIZE];
    for (place, byte) in array.iter_mut().take(SIZE - 1).zip(text.bytes()) {
        *place = c_char::from_ne_bytes([byte]);
    }
    array
}

/// A table as the host hands it to an entry: zeroed, with its size and presets.
pub fn preset_table() -> abi::LawTable {
    abi::LawTable {
        struct_size: size_of::<abi::LawTable>() as i64,
        abi_minor: 0,
        name: [0; abi::WL_NAME_SIZE],
        version: [0; abi::WL_VERSION_SIZE],
        summary: [0; abi::WL_SUMMARY_SIZE],
        source: [0; abi::WL_SUMMARY_SIZE],
        reads: 0,
        uses: 0,
        writes: 0,
        claims: 0,
        flags: 0,
        constant_count: 0,
        state_count: 0,
        input_count: 0,
        pressure_degree: f64::NAN,
        pressure_degree_constant: -1,
        describe: None,
        create: None,
        evaluate: None,
        destroy: None,
        extension: None,
    }
}

/// A quantity as the host hands it to `describe`: no bounds and no default.
pub fn preset_quantity() -> abi::Quantity {
    abi::Quantity {
        struct_size: size_of::<abi::Quantity>() as i64,
        name: [0; abi::WL_NAME_SIZE],
        summary: [0; abi::WL_SUMMARY_SIZE],
        metre: 0.0,
        kilogram: 0.0,
        second: 0.0,
        kelvin: 0.0,
        minimum: f64::NEG_INFINITY,
        maximum: f64::INFINITY,
        default_value: f64::NAN,
        flags: 0,
    }
}

/// One law of an entry: its functions, which live as long as this value does.
pub(super) struct BoundLaw {
    pub(super) descriptor: LawDescriptor,
    table: abi::LawTable,
    evaluate: EvaluateFn,
    entry: Arc<dyn Entry>,
}

type EvaluateFn = unsafe extern "C" fn(*mut c_void, *const abi::View, *mut abi::Output) -> i32;

/// What an entry said for one index.
pub(super) enum Answer {
    Law(Arc<BoundLaw>),
    NoMore,
    Status(i32),
    Malformed { name: String, error: Box<DescribeError> },
}

impl BoundLaw {
    /// Asks `entry` for its law of that index.
    pub(super) fn ask(entry: &Arc<dyn Entry>, index: i32) -> Answer {
        let mut table = preset_table();
        // SAFETY: the table is preset above; the entry keeps the ABI by the promise of its type.
        let status = unsafe { entry.call(index, this_host(), &mut table) };
        match status {
            abi::WL_OK => {}
            abi::WL_NO_MORE => return Answer::NoMore,
            other => return Answer::Status(other),
        }
        let given = size_of::<abi::LawTable>() as i64;
        if table.struct_size != given {
            let error = DescribeError::TableSize { found: table.struct_size, expected: given };
            return Answer::Malformed { name: readable(&table.name), error: Box::new(error) };
        }
        let mut ask = table.describe.map(|function| {
            move |kind: i32, item: i64| {
                let mut quantity = preset_quantity();
                // SAFETY: the quantity is preset; the function belongs to `entry`, which this function borrows.
                let status = unsafe { function(kind, item, &mut quantity) };
                (status, quantity)
            }
        });
        let described = describe(&table, ask.as_mut().map(|ask| ask as &mut dyn FnMut(i32, i64) -> _));
        match (described, table.evaluate) {
            (Ok(descriptor), Some(evaluate)) => {
                Answer::Law(Arc::new(Self { descriptor, table, evaluate, entry: Arc::clone(entry) }))
            }
            (Ok(_), None) => {
                Answer::Malformed { name: readable(&table.name), error: Box::new(DescribeError::NoEvaluate) }
            }
            (Err(error), _) => Answer::Malformed { name: readable(&table.name), error: Box::new(error) },
        }
    }

    /// What messages call the place it comes from.
    pub(super) fn library(&self) -> &str {
        self.entry.name()
    }

    /// Finds an extension of the law; the address stays valid as long as the law.
    pub(super) fn extension(&self, id: &std::ffi::CStr) -> Option<*const c_void> {
        let function = self.table.extension?;
        // SAFETY: the function belongs to `self.entry`, which is alive; `id` is closed by a NUL.
        let found = unsafe { function(id.as_ptr()) };
        (!found.is_null()).then_some(found)
    }
}

fn readable(bytes: &[c_char]) -> String {
    let bytes: Vec<u8> = bytes.iter().map(|byte| byte.to_ne_bytes()[0]).take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// An instance that was made and is not destroyed yet; only its drop destroys it, while its library is still open.
pub(super) struct Created {
    pointer: *mut c_void,
    pub(super) law: Arc<BoundLaw>,
}

// SAFETY: the ABI lets an instance be used from any thread, and from several at once unless the law is serial, which
// `LawInstance` sees to.
unsafe impl Send for Created {}
// SAFETY: as for Send.
unsafe impl Sync for Created {}

/// Why `create` made nothing.
pub(super) struct Refusal {
    pub(super) status: i32,
    pub(super) text: String,
}

impl Created {
    /// Makes an instance with the scene's options.
    pub(super) fn new(law: Arc<BoundLaw>, options: Option<CString>) -> Result<Self, Refusal> {
        let mut pointer = std::ptr::null_mut();
        if let Some(create) = law.table.create {
            let mut text: [c_char; TEXT_SIZE] = [0; TEXT_SIZE];
            let words = options.as_ref().map_or(std::ptr::null(), |options| options.as_ptr());
            // SAFETY: the function belongs to the law's entry, which is alive; all pointers lead to live values.
            let status = unsafe { create(this_host(), words, &mut pointer, text.as_mut_ptr(), TEXT_SIZE as i64) };
            if status != abi::WL_OK {
                return Err(Refusal { status, text: readable(&text) });
            }
        }
        Ok(Self { pointer, law })
    }

    /// Calls the law.
    ///
    /// # Safety
    /// The pointers in `view` and `output` lead to as many numbers as the ABI says, live for the call, and outputs do
    /// not overlap inputs.
    #[inline]
    pub(super) unsafe fn evaluate(&self, view: &abi::View, output: &mut abi::Output) -> i32 {
        // SAFETY: the function and the instance belong to the law's entry, which is alive; the caller answers for the rest.
        unsafe { (self.law.evaluate)(self.pointer, view, output) }
    }
}

impl Drop for Created {
    fn drop(&mut self) {
        if let Some(destroy) = self.law.table.destroy {
            // SAFETY: `create` gave this pointer (or there is no `create` and it is NULL); nothing uses it afterwards.
            unsafe { destroy(self.pointer) };
        }
    }
}

/// Bytes of the buffer for a law's text.
pub(super) const TEXT_SIZE: usize = 512;
