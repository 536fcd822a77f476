//! Rule broken: no exception or panic gets out. An assertion that the pressure is a number below 1e200 panics in a function of its
//! own in front of the helper's, which would have caught it.
#![allow(unsafe_code)] // reason: stands in for the entry and the function that hosts call.

use core::ffi::c_void;
use core::mem::zeroed;

use wearlaw_faulty::{sound_about, sound_point};
use wearlaw_plugin_api::abi::{Host, LawTable, Output, View};
use wearlaw_plugin_api::sdk::export::{Exporter, entry, fill};
use wearlaw_plugin_api::sdk::prelude::*;

struct Panics;
sound_about!(Panics, "panics");

impl PointLaw for Panics {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        sound_point(at, out)
    }
}

unsafe extern "C" fn evaluate(instance: *mut c_void, view: *const View, output: *mut Output) -> i32 {
    // SAFETY: the host promises a view of the 1.0 size with columns as long as its points; zeroes are a valid table.
    unsafe {
        let pressure = (*view).pressure;
        for point in 0..(*view).points {
            let value =
                if pressure.ptr.is_null() { 0.0 } else { *pressure.ptr.offset((point * pressure.step) as isize) };
            assert!(value < 1e200, "the pressure is {value}");
        }
        let mut helper: LawTable = zeroed();
        fill::<Panics>(&mut helper);
        helper.evaluate.map_or(5, |evaluate| evaluate(instance, view, output))
    }
}

/// The entry that hosts call.
///
/// # Safety
/// As `wearlaw.h` promises.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wearlaw_entry_1(index: i32, host: *const Host, law: *mut LawTable) -> i32 {
    let exporter = Exporter { version: "1.0.0", description: "" };
    // SAFETY: handed through with the caller's own promise; a table that was filled may be written.
    unsafe {
        let status = entry(&[fill::<Panics>], exporter, index, host, law);
        if status == 0 {
            (*law).evaluate = Some(evaluate);
        }
        status
    }
}
