//! The structs and numbers of the C interface; `include/wearlaw_host.h` is generated from here and from `functions.rs`.

use std::ffi::c_char;

use wearlaw_plugin_api::abi::{WL_NAME_SIZE, WL_VERSION_SIZE};

/// Minor version of this interface; functions and members are only ever added between minors.
pub const WLH_ABI_MINOR: i32 = 0;

/// An argument is wrong; the text names it. Nothing was changed or evaluated.
pub const WLH_BAD_INPUT: i32 = 16;
/// The law could not be opened.
pub const WLH_NOT_LOADED: i32 = 17;
/// The handle is NULL, closed, or not of this kind.
pub const WLH_BAD_HANDLE: i32 = 18;
/// Another thread is using the surface.
pub const WLH_BUSY: i32 = 19;
/// A defect of this library; the handle can only be closed.
pub const WLH_INTERNAL: i32 = 20;

/// Which law is opened, and how.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Source {
    /// Bytes of this struct.
    pub struct_size: i64,
    /// `embedded:archard`, or a library's path (with a `/` or the ending of a library); `LIB#NAME` for one of several.
    pub name: *const c_char,
    /// SHA-256 that the library must have, in hexadecimal; NULL: any.
    pub sha256: *const c_char,
    /// Text for laws that take options; NULL: none.
    pub options: *const c_char,
    /// Path of the program `wearlaw`, of this version: the law runs in processes of its own. NULL: in this process.
    pub worker: *const c_char,
    /// Longest time for one call of a law in a process of its own, s; 0: 60.
    pub deadline: f64,
}

/// What the solver is and provides.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Solver {
    /// Bytes of this struct.
    pub struct_size: i64,
    /// `WL_FIELD_` bits that it provides. A law that reads others is refused; others cannot be set.
    pub provides: i64,
    /// Dimension of its scene, 2 or 3. Vectors have 3 components in both.
    pub dimension: i64,
    /// Its unit of length in metres; 0: 1.
    pub unit_metre: f64,
    /// Its unit of mass in kilograms; 0: 1.
    pub unit_kilogram: f64,
    /// Its unit of time in seconds; 0: 1.
    pub unit_second: f64,
    /// Its degree of temperature in kelvin; 0: 1.
    pub unit_kelvin: f64,
    /// Absolute zero on its temperature scale: 0 for kelvin, -273.15 for degrees Celsius.
    pub absolute_zero: f64,
    /// Reference temperature, on its temperature scale.
    pub reference_temperature: f64,
}

/// What a law says of itself.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Description {
    /// Bytes of this struct, set by the solver.
    pub struct_size: i64,
    /// `WL_FIELD_` bits that the law must have.
    pub reads: i64,
    /// `WL_FIELD_` bits that it uses if they are there.
    pub uses: i64,
    /// `WL_OUT_` bits that it can write beside the wear increment.
    pub writes: i64,
    /// `WL_CLAIM_` bits.
    pub claims: i64,
    /// `WL_FLAG_` bits.
    pub flags: i64,
    /// Number of constants.
    pub constant_count: i64,
    /// Number of state variables at a point.
    pub state_count: i64,
    /// Number of further inputs.
    pub input_count: i64,
    /// Name, NUL-terminated.
    pub name: [c_char; WL_NAME_SIZE],
    /// Version, NUL-terminated.
    pub version: [c_char; WL_VERSION_SIZE],
}

/// Constants of the law, or a table of them: linear between its points in time and temperature, held outside them.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Constants {
    /// Bytes of this struct.
    pub struct_size: i64,
    /// Constants in a row.
    pub count: i64,
    /// Their names `[count]`; NULL: the first `count` in the law's order. What is left out takes its default.
    pub names: *const *const c_char,
    /// Values `[times][temperatures][count]`, in the solver's units.
    pub values: *const f64,
    /// Numbers in `values`.
    pub value_count: i64,
    /// Times of the table, rising; NULL: the same at all times.
    pub times: *const f64,
    /// Number of times.
    pub time_count: i64,
    /// Temperatures of the table, rising; NULL: the same at all temperatures.
    pub temperatures: *const f64,
    /// Number of temperatures.
    pub temperature_count: i64,
}

/// The substep that is evaluated; times in the solver's units.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Step {
    /// Bytes of this struct.
    pub struct_size: i64,
    /// Time at its start. Tables are read in its middle.
    pub time: f64,
    /// Its duration: the represented time, if wear is scaled.
    pub dt: f64,
    /// Time since the start of the load step.
    pub step_time: f64,
    /// Number of the load step, from 1; 0: 1.
    pub load_step: i64,
    /// Number of the substep in its load step, from 1; 0: 1.
    pub substep: i64,
    /// Number of the cycle, from 1; 0: outside cycles.
    pub cycle: i64,
    /// Number of the wear material; 0: 1.
    pub material: i64,
    /// Number of the contact pair; 0: 1.
    pub pair: i64,
    /// Number of the worn body; 0: 1.
    pub body: i64,
    /// Number of the counter body; 0: 2.
    pub counter_body: i64,
}

/// The solver's arrays that the law writes, and what it answers beside them. They overlap no input.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Outputs {
    /// Bytes of this struct.
    pub struct_size: i64,
    /// Increment of the wear depth over the substep `[points]`; length. Never NULL.
    pub increment: *mut f64,
    /// Numbers in `increment`: the points.
    pub increment_length: i64,
    /// Wear direction `[points][3]`, unit length; or NULL.
    pub direction: *mut f64,
    /// Numbers in `direction`.
    pub direction_length: i64,
    /// Derivative of the increment with respect to the contact pressure `[points]`; or NULL.
    pub d_pressure: *mut f64,
    /// Numbers in `d_pressure`.
    pub d_pressure_length: i64,
    /// Status of every point `[points]`; or NULL.
    pub status: *mut i32,
    /// Numbers in `status`.
    pub status_length: i64,
    /// Answered: with `WL_CUT_STEP` the factor in (0, 1) for the next try, otherwise 1.
    pub dt_factor: f64,
    /// Answered: the first point that the text is about, from 0; -1: none.
    pub first_bad: i64,
}
