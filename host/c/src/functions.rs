//! The functions of the C interface. Each looks at its pointers, does its work in Rust and answers a status.
//!
//! What the functions ask of their caller is what C asks: pointers are NULL or lead to what their types and lengths say,
//! texts end with a NUL, and arrays that were set stay where they are until they are set anew or the surface is closed.
#![allow(unsafe_code, clippy::missing_safety_doc)] // reason: the C interface; what callers keep is said above, once.

use std::ffi::c_char;
use std::sync::Arc;

use wearlaw::plan::ScalingPlan;
use wearlaw::scene::ScalingKind;
use wearlaw_plugin_api::abi::{Quantity, WL_OK};

use crate::abi::{Constants, Description, Outputs, Solver, Source, Step, WLH_ABI_MINOR};
use crate::boundary::{aligned, answer, array, count, done, read, text as text_of, write};
use crate::error::HostError;
use crate::evaluate::told;
use crate::handle::Handle;
use crate::law::{OpenLaw, field_of};
use crate::surface::Surface;

/// An open law.
pub struct LawHandle(());

/// The points of one surface under a law.
pub struct SurfaceHandle(());

/// # Safety
/// As for [`Handle::find`].
unsafe fn law<'a>(pointer: *const LawHandle) -> Result<&'a Handle<Arc<OpenLaw>>, HostError> {
    // SAFETY: as the caller says.
    unsafe { Handle::find(pointer.cast()) }
}

/// # Safety
/// As for [`Handle::find`].
unsafe fn law_of(pointer: *const LawHandle) -> Result<Arc<OpenLaw>, HostError> {
    // SAFETY: as the caller says.
    let mut held = unsafe { law(pointer) }?.wait()?;
    held.get().cloned()
}

/// # Safety
/// As for [`Handle::find`].
unsafe fn surface<'a>(pointer: *const SurfaceHandle) -> Result<&'a Handle<Surface>, HostError> {
    // SAFETY: as the caller says.
    unsafe { Handle::find(pointer.cast()) }
}

/// Does something with an open law, and answers.
///
/// # Safety
/// As for [`Handle::find`] and [`answer`].
unsafe fn on_law(
    pointer: *const LawHandle,
    (text, text_size): (*mut c_char, i64),
    act: impl FnOnce(&OpenLaw) -> Result<(), HostError>,
) -> i32 {
    // SAFETY: as the caller says.
    unsafe { answer(text, text_size, || act(&*law_of(pointer)?).and_then(done)) }
}

/// Does something with a surface that no other thread is using, and answers.
///
/// # Safety
/// As for [`Handle::find`] and [`answer`].
unsafe fn on_surface(
    pointer: *const SurfaceHandle,
    (text, text_size): (*mut c_char, i64),
    act: impl FnOnce(&mut Surface) -> Result<(), HostError>,
) -> i32 {
    // SAFETY: as the caller says.
    unsafe { answer(text, text_size, || act(surface(pointer)?.take_turn()?.get()?).and_then(done)) }
}

/// Puts a handle where the solver wants it.
///
/// # Safety
/// `place` is NULL or leads to a pointer that can be written.
unsafe fn give<T>(
    place: *mut *mut T,
    what: &'static str,
    make: impl FnOnce() -> Result<*mut T, HostError>,
) -> Result<(), HostError> {
    if place.is_null() {
        return Err(HostError::Null(what));
    }
    aligned(place, what, "a pointer")?;
    // SAFETY: as the caller says.
    unsafe { *place = std::ptr::null_mut() };
    let handle = make()?;
    // SAFETY: as above.
    unsafe { *place = handle };
    Ok(())
}

/// Minor version of this interface; the major version is in the name of `wlh_open_1`.
#[unsafe(no_mangle)]
pub extern "C" fn wlh_minor() -> i32 {
    WLH_ABI_MINOR
}

/// Opens a law for a solver. A law that reads what the solver does not provide is refused.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_open_1(
    source: *const Source,
    solver: *const Solver,
    law: *mut *mut LawHandle,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let body = || {
        let open = || {
            // SAFETY: as the module says.
            let open = unsafe { OpenLaw::new(&read(source)?, &read(solver)?) }?;
            Ok(Handle::give(Arc::new(open)).cast())
        };
        // SAFETY: as the module says.
        unsafe { give(law, "law", open) }
    };
    // SAFETY: as the module says.
    unsafe { answer(text, text_size, || body().and_then(done)) }
}

/// Says what a law is: name, fields, outputs, numbers of constants and state variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_describe(
    law: *const LawHandle,
    description: *mut Description,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    // SAFETY: as the module says.
    unsafe { on_law(law, (text, text_size), |law| write(description, &law.description())) }
}

/// Says what a constant, state variable or further input is: `kind` WL_KIND_CONSTANT, _STATE or _INPUT, `index` from 0.
/// Bounds and defaults are in SI units.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_quantity(
    law: *const LawHandle,
    kind: i32,
    index: i64,
    quantity: *mut Quantity,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    // SAFETY: as the module says.
    unsafe { on_law(law, (text, text_size), |law| write(quantity, &law.quantity(kind, index)?)) }
}

/// Takes the warnings since the last call, a line each, into `text`: what a law changed that was put back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_warnings(law: *const LawHandle, text: *mut c_char, text_size: i64) -> i32 {
    // SAFETY: as the module says.
    unsafe { answer(text, text_size, || Ok((WL_OK, law_of(law)?.take_warnings()))) }
}

/// Closes a law; it goes when its last surface is closed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_close_law(handle: *mut LawHandle, text: *mut c_char, text_size: i64) -> i32 {
    // SAFETY: as the module says.
    unsafe { answer(text, text_size, || law(handle)?.close().and_then(done)) }
}

/// Makes a surface of `points` points, which may be 0. Constants and state variables have their defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_open_surface(
    law: *const LawHandle,
    points: i64,
    surface: *mut *mut SurfaceHandle,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let body = || {
        // SAFETY: as the module says.
        let make = || Ok(Handle::give(Surface::new(unsafe { law_of(law) }?, count("points", points)?)?).cast());
        // SAFETY: as the module says.
        unsafe { give(surface, "surface", make) }
    };
    // SAFETY: as the module says.
    unsafe { answer(text, text_size, || body().and_then(done)) }
}

/// Sets the law's constants, or a table of them over time and temperature; they are copied.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_set_constants(
    handle: *mut SurfaceHandle,
    constants: *const Constants,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let act = |surface: &mut Surface| {
        // SAFETY: as the module says.
        let given = unsafe { read(constants) }?;
        let number = count("wlh_constants.count", given.count)?;
        // SAFETY: as the module says.
        let (values, times, temperatures) = unsafe {
            (
                array(given.values, given.value_count, "wlh_constants.values")?,
                array(given.times, given.time_count, "wlh_constants.times")?,
                array(given.temperatures, given.temperature_count, "wlh_constants.temperatures")?,
            )
        };
        if given.names.is_null() {
            return surface.set_constants(None, values, times, temperatures, number);
        }
        // SAFETY: as the module says.
        let names = unsafe { array(given.names, given.count, "wlh_constants.names") }?;
        let name = |pointer: &*const c_char| {
            // SAFETY: as the module says.
            unsafe { text_of(*pointer, "wlh_constants.names") }?.ok_or(HostError::Null("wlh_constants.names"))
        };
        let names = names.iter().map(name).collect::<Result<Vec<_>, _>>()?;
        surface.set_constants(Some(&names), values, times, temperatures, number)
    };
    // SAFETY: as the module says.
    unsafe { on_surface(handle, (text, text_size), act) }
}

/// Says where a field is: `length` numbers from `values` on, `step` numbers from one point to the next (0: one value
/// for all points). The array is read in place by every evaluation until another is set; NULL takes it away.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_set_field(
    handle: *mut SurfaceHandle,
    field: i64,
    values: *const f64,
    length: i64,
    step: i64,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let act = |surface: &mut Surface| surface.set_reals(field_of(field)?, (values, length, step));
    // SAFETY: as the module says.
    unsafe { on_surface(handle, (text, text_size), act) }
}

/// As wlh_set_field, for fields of integers: WL_FIELD_CONTACT_STATE, _POINT_ID and _ELEMENT_ID.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_set_index_field(
    handle: *mut SurfaceHandle,
    field: i64,
    values: *const i64,
    length: i64,
    step: i64,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let act = |surface: &mut Surface| surface.set_integers(field_of(field)?, (values, length, step));
    // SAFETY: as the module says.
    unsafe { on_surface(handle, (text, text_size), act) }
}

/// As wlh_set_field, for a further input that the law declares by name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_set_input(
    handle: *mut SurfaceHandle,
    name: *const c_char,
    values: *const f64,
    length: i64,
    step: i64,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let act = |surface: &mut Surface| {
        // SAFETY: as the module says.
        let name = unsafe { text_of(name, "name") }?.ok_or(HostError::Null("name"))?;
        surface.set_input(name, (values, length, step))
    };
    // SAFETY: as the module says.
    unsafe { on_surface(handle, (text, text_size), act) }
}

/// Sets the state variables at the start of the substep, `length` numbers `[points][state_count]`; they are copied.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_set_state(
    handle: *mut SurfaceHandle,
    values: *const f64,
    length: i64,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    // SAFETY: as the module says.
    unsafe { on_surface(handle, (text, text_size), |surface| surface.set_state(array(values, length, "values")?)) }
}

/// Copies the state variables as they were committed into `length` numbers `[points][state_count]`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_get_state(
    handle: *mut SurfaceHandle,
    values: *mut f64,
    length: i64,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let act = |surface: &mut Surface| {
        let state = surface.state(length)?;
        if state.is_empty() {
            return Ok(());
        }
        if values.is_null() {
            return Err(HostError::Null("values"));
        }
        aligned(values, "values", "an array of doubles")?;
        // SAFETY: as the module says; the length was found to be that of the state.
        unsafe { std::ptr::copy(state.as_ptr(), values, state.len()) };
        Ok(())
    };
    // SAFETY: as the module says.
    unsafe { on_surface(handle, (text, text_size), act) }
}

/// Evaluates the law over a substep, from the state at its start. Answers WL_OK, WL_UNRELIABLE (the values may be used),
/// WL_CUT_STEP (try again with `dt` times `dt_factor`) or an error; but for the first two the outputs are void.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_evaluate(
    handle: *mut SurfaceHandle,
    step: *const Step,
    outputs: *mut Outputs,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let body = || {
        // SAFETY: as the module says.
        let mut held = unsafe { surface(handle) }?.take_turn()?;
        // SAFETY: as the module says.
        let (step, mut wanted) = unsafe { (read(step)?, read(outputs.cast_const())?) };
        // SAFETY: as the module says.
        let evaluated = unsafe { held.get()?.evaluate(&step, &wanted) };
        wanted.first_bad = evaluated.point.map_or(-1, |point| point as i64);
        let (ended, factor) = match evaluated.result {
            Ok(evaluation) => {
                let (status, factor, words) = told(evaluation);
                (Ok((status, words)), factor)
            }
            Err(error) => (Err(error), 1.0),
        };
        wanted.dt_factor = factor;
        // SAFETY: as the module says.
        unsafe { write(outputs, &wanted) }?;
        ended
    };
    // SAFETY: as the module says.
    unsafe { answer(text, text_size, body) }
}

/// Takes the last good evaluation: its state at the end is the state at the start of the next substep.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_commit(handle: *mut SurfaceHandle, text: *mut c_char, text_size: i64) -> i32 {
    // SAFETY: as the module says.
    unsafe { on_surface(handle, (text, text_size), Surface::commit) }
}

/// Forgets the evaluations since the last commit. Evaluating again without it does the same.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_roll_back(handle: *mut SurfaceHandle, text: *mut c_char, text_size: i64) -> i32 {
    let act = |surface: &mut Surface| {
        surface.roll_back();
        Ok(())
    };
    // SAFETY: as the module says.
    unsafe { on_surface(handle, (text, text_size), act) }
}

/// Closes a surface. What is kept of it is a few words, so that a use of it after this is an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_close_surface(handle: *mut SurfaceHandle, text: *mut c_char, text_size: i64) -> i32 {
    // SAFETY: as the module says.
    unsafe { answer(text, text_size, || surface(handle)?.close().and_then(done)) }
}

/// The factor on the represented time of a substep or cycle, clamp(safety / change, 1, maximum), where the wear of an
/// unscaled one changes the contact pressure by the part `change` (TB,WEAR with AUTS or CBCS: C1, C2).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wlh_scaling_factor(
    change: f64,
    safety: f64,
    maximum: f64,
    factor: *mut f64,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let body = || {
        let wrong = |what: &str, found: f64, expected: &str| HostError::Number {
            what: what.to_owned(),
            found: found.to_string(),
            expected: expected.to_owned(),
        };
        if !(change >= 0.0 && change.is_finite()) {
            return Err(wrong("change", change, "a finite number, 0 or more"));
        }
        if !(safety > 0.0 && safety < 1.0) {
            return Err(wrong("safety", safety, "a number above 0 and below 1"));
        }
        if !(maximum >= 1.0 && maximum.is_finite()) {
            return Err(wrong("maximum", maximum, "a finite number from 1"));
        }
        if factor.is_null() {
            return Err(HostError::Null("factor"));
        }
        aligned(factor, "factor", "a double")?;
        let plan = ScalingPlan { kind: ScalingKind::default(), safety, maximum };
        // SAFETY: as the module says.
        unsafe { *factor = plan.factor(change) };
        Ok(())
    };
    // SAFETY: as the module says.
    unsafe { answer(text, text_size, || body().and_then(done)) }
}
