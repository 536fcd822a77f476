//! One call of a law: the points of one substep in, the wear increments out.

use core::ffi::c_char;

/// A real input: `ptr` NULL means absent, `step` is the number of doubles from point to point (0: one value for all).
///
/// Vectors have their 3 components adjacent at `ptr + i * step`, in the global frame, also in 2-D.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// First value, or NULL.
    pub ptr: *const f64,
    /// Doubles from one point to the next.
    pub step: i64,
}

/// An integer input; as [`Column`], with `step` counted in 64-bit integers.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct IndexColumn {
    /// First value, or NULL.
    pub ptr: *const i64,
    /// Integers from one point to the next.
    pub step: i64,
}

/// The inputs of one call: points of one surface, the worn body, over one substep.
///
/// Inputs are constant over the substep. Units are the scene's own, consistent set.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Bytes of this struct, set by the host.
    pub struct_size: i64,
    /// Number of points.
    pub points: i64,
    /// Dimension of the scene, 2 or 3.
    pub dimension: i64,
    /// Output bits that are wanted; the same as the output pointers that are not NULL.
    pub request: i64,
    /// Time at the start of the substep.
    pub time: f64,
    /// Duration of the substep (represented time).
    pub dt: f64,
    /// Time since the start of the load step.
    pub step_time: f64,
    /// Number of the load step, from 1.
    pub load_step: i64,
    /// Number of the substep in its load step, from 1.
    pub substep: i64,
    /// Number of the cycle, from 1; 0 outside cycles.
    pub cycle: i64,
    /// Number of the wear material.
    pub material: i64,
    /// Number of the contact pair.
    pub pair: i64,
    /// Number of the worn body.
    pub body: i64,
    /// Number of the counter body.
    pub counter_body: i64,
    /// Reference temperature, in the scene's temperature scale.
    pub reference_temperature: f64,
    /// Temperature of absolute zero, in the scene's temperature scale.
    pub absolute_zero: f64,
    /// Size of the scene's unit of length in metres; 0: not stated.
    pub unit_metre: f64,
    /// Size of the scene's unit of mass in kilograms; 0: not stated.
    pub unit_kilogram: f64,
    /// Size of the scene's unit of time in seconds; 0: not stated.
    pub unit_second: f64,
    /// Size of the scene's degree of temperature in kelvin; 0: not stated.
    pub unit_kelvin: f64,
    /// Number of columns in `constants`: what the law declared.
    pub constant_count: i64,
    /// Constants, one column each `[constant_count]`.
    pub constants: *const Column,
    /// Number of columns in `inputs`: what the law declared.
    pub input_count: i64,
    /// Further inputs, one column each `[input_count]`.
    pub inputs: *const Column,
    /// Number of state variables at a point: what the law declared.
    pub state_count: i64,
    /// State variables at the start of the substep `[points][state_count]`, the variables of a point adjacent.
    pub state: Column,
    /// Contact pressure `[points]`, positive in compression; pressure.
    pub pressure: Column,
    /// Slip increment `[points]`: path length over the substep; length.
    pub slip: Column,
    /// Sliding velocity `[points]`; length per time.
    pub velocity: Column,
    /// Net slip displacement `[points][3]`; length.
    pub slip_vector: Column,
    /// Outward unit normal of the worn body `[points][3]`.
    pub normal: Column,
    /// Position `[points][3]`; length.
    pub coordinates: Column,
    /// First unit tangent `[points][3]`.
    pub tangent: Column,
    /// Temperature of the worn surface `[points]`.
    pub temperature: Column,
    /// Temperature of the counter surface `[points]`.
    pub counter_temperature: Column,
    /// Friction stress on the worn body `[points][3]`; pressure.
    pub friction_stress: Column,
    /// Friction coefficient `[points]`.
    pub friction_coefficient: Column,
    /// Friction work per area over the substep `[points]`; pressure times length.
    pub friction_work: Column,
    /// Wear depth at the start of the substep `[points]`; length.
    pub accumulated_wear: Column,
    /// Sliding distance at the start of the substep `[points]`; length.
    pub accumulated_slip: Column,
    /// Normal traction from nodal stresses `[points]`; pressure.
    pub nodal_traction: Column,
    /// Gap `[points]`, negative is penetration; length.
    pub gap: Column,
    /// Area of the point `[points]`; length squared (length in 2-D).
    pub area: Column,
    /// Contact state `[points]`: `WL_OPEN`, `WL_STICK` or `WL_SLIDING`.
    pub contact_state: IndexColumn,
    /// Number of the point in the host's numbering `[points]`.
    pub point_id: IndexColumn,
    /// Number of the contact element `[points]`.
    pub element_id: IndexColumn,
}

/// Where the answers of one call go: arrays of the host, contiguous, never overlapping an input.
///
/// A law writes every item whose pointer is given, and nothing else.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Output {
    /// Bytes of this struct, set by the host.
    pub struct_size: i64,
    /// Wear increment over the substep `[points]`; length. Never NULL.
    pub increment: *mut f64,
    /// Wear direction `[points][3]`, unit length; or NULL.
    pub direction: *mut f64,
    /// State variables at the end of the substep `[points][state_count]`; or NULL.
    pub state: *mut f64,
    /// Status of every point `[points]`; or NULL.
    pub status: *mut i32,
    /// For the law to set on a bad status: index of the first bad point in this call (preset -1).
    pub first_bad: i64,
    /// For the law to set with `WL_CUT_STEP`: factor in (0, 1) for the next try (preset 0).
    pub dt_factor: f64,
    /// For the law to set with `WL_MISSING_INPUT`: field bits of what is missing (preset 0).
    pub missing: i64,
    /// Buffer for a text on what went wrong `[text_size]`, NUL-terminated by the law; may be NULL.
    pub text: *mut c_char,
    /// Bytes of `text`.
    pub text_size: i64,
    /// Derivative of the increment with respect to the pressure `[points]`; length per pressure; or NULL.
    pub d_pressure: *mut f64,
}
