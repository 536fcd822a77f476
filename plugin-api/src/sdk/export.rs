#![allow(unsafe_code)] // the functions that other languages call; each states what its caller promises
//! The functions behind a plugin's entry, made for every [`Law`].

use core::ffi::{CStr, c_char, c_void};
use core::fmt::Write;
use core::mem::{MaybeUninit, offset_of, size_of};
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::abi::{
    Host, LawTable, Output, Quantity as RawQuantity, View, WL_ABI_MINOR, WL_FAILED, WL_KIND_CONSTANT, WL_KIND_FIELD,
    WL_KIND_INPUT, WL_KIND_STATE, WL_NO_MORE, WL_OK, WL_OUT_STATE,
};

use super::answer::Room;
use super::{Answer, Batch, Degree, Law, Quantity, SELFTEST, Status};

/// The table of one law, as its entry gives it.
pub type Fill = fn(&mut LawTable);

/// The crate that exports laws, as its manifest has it: what a law says nothing of is taken from here.
#[derive(Clone, Copy, Debug)]
pub struct Exporter {
    /// Version of the crate.
    pub version: &'static str,
    /// Description of the crate.
    pub description: &'static str,
}

/// Makes the plugin's entry, `wearlaw_entry_1`, for one or several laws.
///
/// With the feature `layout` of this crate the plugin also exports the layout of the ABI structs it was built with.
#[macro_export]
macro_rules! export_laws {
    ($($law:ty),+ $(,)?) => {
        /// The entry that hosts call; see `wearlaw.h`.
        ///
        /// # Safety
        /// `host` and `law` are as `wearlaw.h` promises: valid, with their sizes set.
        #[allow(unsafe_code)]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn wearlaw_entry_1(
            index: i32,
            host: *const $crate::abi::Host,
            law: *mut $crate::abi::LawTable,
        ) -> i32 {
            // SAFETY: handed through with the caller's own promise.
            unsafe {
                let exporter = $crate::sdk::export::Exporter {
                    version: option_env!("CARGO_PKG_VERSION").unwrap_or(""),
                    description: option_env!("CARGO_PKG_DESCRIPTION").unwrap_or(""),
                };
                $crate::sdk::export::entry(&[$($crate::sdk::export::fill::<$law>),+], exporter, index, host, law)
            }
        }
        $crate::__export_layout!();
    };
}

/// Exports the layout of the ABI structs, for hosts that look at it.
#[cfg(feature = "layout")]
#[doc(hidden)]
#[macro_export]
macro_rules! __export_layout {
    () => {
        /// Layout of the ABI structs that this plugin was built with.
        #[allow(unsafe_code)]
        #[unsafe(export_name = "wearlaw_layout_1")]
        pub static WEARLAW_LAYOUT_1: $crate::layout::LayoutExport = $crate::layout::EXPORT;
    };
}

/// Exports nothing: this crate was built without the feature `layout`.
#[cfg(not(feature = "layout"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __export_layout {
    () => {};
}

/// Answers a host that asks for law `index` of a plugin.
///
/// # Safety
/// `law` is NULL or points to at least as many bytes as its first field says.
pub unsafe fn entry(laws: &[Fill], exporter: Exporter, index: i32, _host: *const Host, law: *mut LawTable) -> i32 {
    let Some(fill) = usize::try_from(index).ok().and_then(|k| laws.get(k)) else {
        return WL_NO_MORE;
    };
    if law.is_null() {
        return WL_FAILED;
    }
    // SAFETY: the caller promises `struct_size` bytes; all-zero bytes are a valid table, and no byte beyond what both
    // sides know is read or written.
    unsafe {
        let given = usize::try_from((*law).struct_size).unwrap_or(0);
        if given < offset_of!(LawTable, extension) + size_of::<usize>() {
            return WL_FAILED;
        }
        let size = given.min(size_of::<LawTable>());
        let mut table: LawTable = core::mem::zeroed();
        core::ptr::copy_nonoverlapping(law.cast::<u8>(), (&raw mut table).cast::<u8>(), size);
        fill(&mut table);
        if table.version[0] == 0 {
            write_text(&mut table.version, exporter.version);
        }
        if table.summary[0] == 0 {
            write_text(&mut table.summary, exporter.description);
        }
        core::ptr::copy_nonoverlapping((&raw const table).cast::<u8>(), law.cast::<u8>(), size);
    }
    WL_OK
}

/// Fills the table of law `T`, all but its size.
pub fn fill<T: Law>(table: &mut LawTable) {
    table.abi_minor = i64::from(WL_ABI_MINOR);
    write_text(&mut table.name, T::NAME);
    write_text(&mut table.version, T::VERSION);
    write_text(&mut table.summary, T::SUMMARY);
    write_text(&mut table.source, T::SOURCE);
    table.reads = T::READS;
    table.uses = T::USES;
    // The state at the end is written by whoever has one.
    table.writes = T::WRITES | if T::STATE.is_empty() { 0 } else { WL_OUT_STATE };
    table.claims = T::CLAIMS;
    table.flags = T::FLAGS;
    table.constant_count = T::CONSTANTS.len() as i64;
    table.state_count = T::STATE.len() as i64;
    table.input_count = T::INPUTS.len() as i64;
    (table.pressure_degree, table.pressure_degree_constant) = match T::DEGREE {
        Degree::Unclaimed => (f64::NAN, -1),
        Degree::Value(degree) => (degree, -1),
        Degree::Constant(index) => (f64::NAN, index as i64),
    };
    table.describe = Some(describe::<T>);
    table.create = Some(create::<T>);
    table.evaluate = Some(evaluate::<T>);
    table.destroy = Some(destroy::<T>);
    table.extension = T::KNOWN_VALUES.is_some().then_some(extension::<T>);
}

fn write_text(place: &mut [c_char], text: &str) {
    // SAFETY: a `c_char` is a byte, of whichever sign.
    let bytes = unsafe { core::slice::from_raw_parts_mut(place.as_mut_ptr().cast::<u8>(), place.len()) };
    let mut room = Room { bytes, used: 0 };
    // A text that is too long is cut at a whole character.
    let _ = room.write_str(text);
    room.close();
}

const FIELD_NAMES: [&str; 20] = [
    "pressure",
    "slip",
    "velocity",
    "slip_vector",
    "normal",
    "coordinates",
    "tangent",
    "temperature",
    "counter_temperature",
    "friction_stress",
    "friction_coefficient",
    "friction_work",
    "accumulated_wear",
    "accumulated_slip",
    "nodal_traction",
    "gap",
    "area",
    "contact_state",
    "point_id",
    "element_id",
];

unsafe extern "C" fn describe<T: Law>(kind: i32, index: i64, out: *mut RawQuantity) -> i32 {
    let Ok(index) = usize::try_from(index) else { return WL_NO_MORE };
    let field = FIELD_NAMES.get(index).map(|name| Quantity::new(name, super::Unit::NUMBER));
    let found = match kind {
        WL_KIND_CONSTANT => T::CONSTANTS.get(index).copied(),
        WL_KIND_STATE => T::STATE.get(index).copied(),
        WL_KIND_INPUT => T::INPUTS.get(index).copied(),
        WL_KIND_FIELD => field,
        _ => None,
    };
    let Some(quantity) = found else { return WL_NO_MORE };
    if out.is_null() {
        return WL_FAILED;
    }
    // SAFETY: the host promises `struct_size` bytes; no byte beyond what both sides know is touched.
    unsafe {
        let given = usize::try_from((*out).struct_size).unwrap_or(0);
        if given < offset_of!(RawQuantity, flags) + size_of::<i64>() {
            return WL_FAILED;
        }
        let initial = kind == WL_KIND_STATE && quantity.default.is_nan();
        let place = &mut *out;
        write_text(&mut place.name, quantity.name);
        write_text(&mut place.summary, quantity.summary);
        place.metre = quantity.unit.metre;
        place.kilogram = quantity.unit.kilogram;
        place.second = quantity.unit.second;
        place.kelvin = quantity.unit.kelvin;
        place.minimum = quantity.minimum;
        place.maximum = quantity.maximum;
        place.default_value = if initial { 0.0 } else { quantity.default };
        place.flags = quantity.flags;
    }
    WL_OK
}

unsafe extern "C" fn create<T: Law>(
    _host: *const Host,
    options: *const c_char,
    instance: *mut *mut c_void,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let say = |words: &str| {
        let size = usize::try_from(text_size).unwrap_or(0);
        if !text.is_null() && size > 0 {
            // SAFETY: the host promises `text_size` bytes behind a text that is not NULL.
            let place = unsafe { core::slice::from_raw_parts_mut(text, size) };
            write_text(place, words);
        }
        WL_FAILED
    };
    if instance.is_null() {
        return say("the host gave no place for the instance");
    }
    // SAFETY: options are NULL or a text that ends in NUL, by the host's promise.
    let options = (!options.is_null()).then(|| unsafe { CStr::from_ptr(options) });
    let options = match options.map(CStr::to_str).transpose() {
        Ok(options) => options,
        Err(_) => return say("the options are not UTF-8"),
    };
    match catch_unwind(|| T::create(options)) {
        Ok(Ok(law)) => {
            // SAFETY: checked above not to be NULL; the host gives the place for one pointer.
            unsafe { *instance = Box::into_raw(Box::new(law)).cast() };
            WL_OK
        }
        Ok(Err(words)) => say(&words),
        Err(_) => say("the law panicked in create"),
    }
}

unsafe extern "C" fn evaluate<T: Law>(instance: *mut c_void, view: *const View, output: *mut Output) -> i32 {
    // SAFETY: the host promises that view and output are valid for the call, and gives the instance that `create` made.
    unsafe {
        if increments_alone::<T>(instance, view, output) { WL_OK } else { evaluate_any::<T>(instance, view, output) }
    }
}

/// Lets a law that has a way of its own for it write the increments of a call that wants nothing else; whether it did.
///
/// It is apart from all else so that a call of one point sets up nothing that it does not need.
///
/// # Safety
/// As for [`evaluate_any`].
#[inline(always)]
unsafe fn increments_alone<T: Law>(instance: *mut c_void, view: *const View, output: *mut Output) -> bool {
    // SAFETY: the caller's promise, which covers the length of the increments.
    unsafe {
        let (Some(law), Some(batch)) = (instance.cast::<T>().as_ref(), Batch::in_place(view)) else { return false };
        let Some(increment) = Answer::increments_alone(output, batch.points()) else { return false };
        matches!(catch_unwind(AssertUnwindSafe(|| law.increments(&batch, increment))), Ok(true))
    }
}

/// Evaluates a law with whatever is wanted.
///
/// # Safety
/// View and output are valid for the call, and the instance is one that `create` made.
#[inline(never)]
unsafe fn evaluate_any<T: Law>(instance: *mut c_void, view: *const View, output: *mut Output) -> i32 {
    let mut room = MaybeUninit::uninit();
    // SAFETY: the caller's promise.
    let (law, batch) = unsafe { (instance.cast::<T>().as_ref(), Batch::new(view, &mut room)) };
    let (Some(law), Some(batch)) = (law, batch) else { return WL_FAILED };
    // SAFETY: as above, and the contract of `Answer::new` is a part of it.
    let Some(mut answer) = (unsafe { Answer::new(output, batch.points(), T::STATE.len()) }) else {
        return WL_FAILED;
    };
    let status = match catch_unwind(AssertUnwindSafe(|| law.evaluate(&batch, &mut answer))) {
        Ok(status) => status.max(answer.worst()),
        Err(payload) => {
            let words = payload.downcast_ref::<&str>().copied().map(str::to_owned);
            let words = words.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
            answer.say(Status::Failed, format_args!("the law panicked: {words}"));
            Status::Failed
        }
    };
    if status != Status::Ok {
        // SAFETY: this is the output that the answer was made from; what is noted there means something on a bad status.
        unsafe { answer.finish(output) };
    }
    status as i32
}

unsafe extern "C" fn extension<T: Law>(id: *const c_char) -> *const c_void {
    // SAFETY: the host promises a text that ends in NUL where it is not NULL.
    let asked = (!id.is_null()).then(|| unsafe { CStr::from_ptr(id) });
    let found = T::KNOWN_VALUES.filter(|_| asked == Some(SELFTEST));
    found.map_or(core::ptr::null(), |text| text.as_ptr().cast())
}

unsafe extern "C" fn destroy<T: Law>(instance: *mut c_void) {
    if !instance.is_null() {
        // SAFETY: the host gives back, once, the box that `create` made.
        let law = unsafe { Box::from_raw(instance.cast::<T>()) };
        // A panic in a law's drop stays inside; the host has no use for it.
        let _ = catch_unwind(AssertUnwindSafe(move || drop(law)));
    }
}
