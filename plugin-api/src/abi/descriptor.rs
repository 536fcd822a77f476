//! What a host says of itself and what a law says of itself.

use core::ffi::{c_char, c_void};

use super::{Output, View, WL_NAME_SIZE, WL_SUMMARY_SIZE, WL_VERSION_SIZE};

/// What the host is and what it can give; filled by the host, constant.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Host {
    /// Bytes of this struct, set by the host.
    pub struct_size: i64,
    /// Minor version of the ABI that the host speaks.
    pub abi_minor: i64,
    /// Field bits that the host knows.
    pub provides: i64,
    /// Output bits that the host knows.
    pub accepts: i64,
    /// Name of the host, NUL-terminated.
    pub name: [c_char; WL_NAME_SIZE],
    /// Version of the host, NUL-terminated.
    pub version: [c_char; WL_VERSION_SIZE],
}

/// One constant, state variable or further input of a law; allocated by the host, filled by the law's `describe`.
///
/// Bounds and default are in SI units; a host that knows the sizes of its units converts them.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Quantity {
    /// Bytes of this struct, set by the host.
    pub struct_size: i64,
    /// Name: a letter, then letters, digits and underscores; NUL-terminated.
    pub name: [c_char; WL_NAME_SIZE],
    /// One line on what it is, NUL-terminated.
    pub summary: [c_char; WL_SUMMARY_SIZE],
    /// SI exponent of the metre.
    pub metre: f64,
    /// SI exponent of the kilogram.
    pub kilogram: f64,
    /// SI exponent of the second.
    pub second: f64,
    /// SI exponent of the kelvin.
    pub kelvin: f64,
    /// Smallest value allowed (-infinity: none).
    pub minimum: f64,
    /// Largest value allowed (infinity: none).
    pub maximum: f64,
    /// Default of a constant or input, initial value of a state variable; NaN: it must be given.
    pub default_value: f64,
    /// `WL_QUANTITY_` bits.
    pub flags: i64,
}

/// What a law is and its functions; allocated, zeroed and given defaults by the host, filled by the entry.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct LawTable {
    /// Bytes of this struct, set by the host.
    pub struct_size: i64,
    /// Minor version of the ABI that the law was built for.
    pub abi_minor: i64,
    /// Name of the law: letters, digits, `-` and `_`; NUL-terminated.
    pub name: [c_char; WL_NAME_SIZE],
    /// Version of the law, NUL-terminated.
    pub version: [c_char; WL_VERSION_SIZE],
    /// One line on what the law does, NUL-terminated.
    pub summary: [c_char; WL_SUMMARY_SIZE],
    /// Where its equation comes from, NUL-terminated; may be empty.
    pub source: [c_char; WL_SUMMARY_SIZE],
    /// Field bits that the law must have.
    pub reads: i64,
    /// Field bits that the law uses if they are there.
    pub uses: i64,
    /// Output bits that the law can write.
    pub writes: i64,
    /// `WL_CLAIM_` bits.
    pub claims: i64,
    /// `WL_FLAG_` bits.
    pub flags: i64,
    /// Number of constants.
    pub constant_count: i64,
    /// Number of state variables at a point.
    pub state_count: i64,
    /// Number of further inputs declared by name.
    pub input_count: i64,
    /// Claim: the increment is homogeneous of this degree in the pressure. NaN (preset): not claimed.
    pub pressure_degree: f64,
    /// Claim: index (from 0) of the constant that holds that degree. -1 (preset): none.
    pub pressure_degree_constant: i64,
    /// Describes constant, state variable, input or field `index`; NULL if there is nothing to describe.
    pub describe: Option<unsafe extern "C" fn(kind: i32, index: i64, quantity: *mut Quantity) -> i32>,
    /// Makes an instance. NULL: no instance is needed. `options` is the scene's text or NULL; a refusal writes its
    /// reason into `text` (at most `text_size` bytes with the closing NUL).
    pub create: Option<
        unsafe extern "C" fn(
            host: *const Host,
            options: *const c_char,
            instance: *mut *mut c_void,
            text: *mut c_char,
            text_size: i64,
        ) -> i32,
    >,
    /// Evaluates the law at the points of `view`. Pure: everything is read from `view` and written to `output`.
    pub evaluate: Option<unsafe extern "C" fn(instance: *mut c_void, view: *const View, output: *mut Output) -> i32>,
    /// Frees an instance. NULL: nothing to free.
    pub destroy: Option<unsafe extern "C" fn(instance: *mut c_void)>,
    /// Finds an extension by its name (`wearlaw.selftest/1`); NULL, or an answer of NULL: not there.
    pub extension: Option<unsafe extern "C" fn(id: *const c_char) -> *const c_void>,
}
