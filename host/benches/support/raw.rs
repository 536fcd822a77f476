//! A law called through its C functions and nothing else: what the call itself takes.
#![allow(unsafe_code)] // reason: opens a library and calls the law's functions by their addresses.

use std::ffi::c_void;
use std::path::Path;

use wearlaw_plugin_api::abi;

use wearlaw_plugin_api::abi::EntryFn;
type EvaluateFn = unsafe extern "C" fn(*mut c_void, *const abi::View, *mut abi::Output) -> i32;

/// The first law of an entry, with an instance; the library stays open to the end of the program.
pub struct RawLaw {
    evaluate: EvaluateFn,
    instance: *mut c_void,
}

impl RawLaw {
    /// Opens a library for good.
    pub fn open(path: &Path) -> RawLaw {
        // SAFETY: a law that this program's build made; loading it runs nothing but what its language needs.
        let library = unsafe { libloading::Library::new(path) }.expect("a library that was just built");
        // SAFETY: the symbol has this type by the ABI.
        let entry = unsafe { *library.get::<EntryFn>(b"wearlaw_entry_1").expect("a law") };
        std::mem::forget(library);
        // SAFETY: all-zero bytes are a host that gives nothing, and a table and texts that are empty.
        let (host, mut table) = unsafe { (std::mem::zeroed::<abi::Host>(), std::mem::zeroed::<abi::LawTable>()) };
        table.struct_size = size_of::<abi::LawTable>() as i64;
        // SAFETY: the table says its size; the function keeps the ABI.
        assert_eq!(unsafe { entry(0, &host, &mut table) }, abi::WL_OK);
        let mut instance = std::ptr::null_mut();
        if let Some(create) = table.create {
            // SAFETY: there are no options and no place for a text, which the ABI allows.
            let status = unsafe { create(&host, std::ptr::null(), &mut instance, std::ptr::null_mut(), 0) };
            assert_eq!(status, abi::WL_OK);
        }
        RawLaw { evaluate: table.evaluate.expect("a law evaluates"), instance }
    }

    /// Calls the law `calls` times on the points of the columns.
    pub fn call(&self, calls: usize, columns: &Columns<'_>, increment: &mut [f64]) {
        assert!(columns.pressure.len() == increment.len() && columns.velocity.len() == increment.len());
        // SAFETY: all-zero bytes are a view and an output in which everything is absent.
        let (mut view, mut output) = unsafe { (std::mem::zeroed::<abi::View>(), std::mem::zeroed::<abi::Output>()) };
        let list: Vec<abi::Column> = columns.constants.iter().map(|c| abi::Column { ptr: c, step: 0 }).collect();
        view.struct_size = size_of::<abi::View>() as i64;
        view.points = increment.len() as i64;
        view.dimension = 3;
        view.dt = columns.dt;
        view.constant_count = list.len() as i64;
        view.constants = list.as_ptr();
        view.pressure = abi::Column { ptr: columns.pressure.as_ptr(), step: 1 };
        view.velocity = abi::Column { ptr: columns.velocity.as_ptr(), step: 1 };
        output.struct_size = size_of::<abi::Output>() as i64;
        output.increment = increment.as_mut_ptr();
        for _ in 0..calls {
            // SAFETY: every column reaches over the points, as asserted above, and the output is borrowed alone.
            let status = unsafe { (self.evaluate)(self.instance, std::hint::black_box(&view), &mut output) };
            assert_eq!(status, abi::WL_OK);
        }
    }
}

/// What the raw call gives.
pub struct Columns<'a> {
    pub pressure: &'a [f64],
    pub velocity: &'a [f64],
    pub constants: &'a [f64],
    pub dt: f64,
}
