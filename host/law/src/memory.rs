//! A law that is a Rust type of this program, behind the same C functions as any other: for tests of the life cycle.
#![allow(unsafe_code)] // reason: builds the C functions of a law around a safe trait.

use std::ffi::{CStr, c_char, c_void};
use std::marker::PhantomData;
use std::panic::{AssertUnwindSafe, catch_unwind};

use wearlaw_plugin_api::abi;

use super::descriptor::{Degree, LawDescriptor, Quantity};
use super::entry::Entry;
use super::fields::Field;
use super::table::chars;

/// A law in safe Rust.
pub trait MemoryLaw: Send + Sync + Sized + 'static {
    /// What the law says of itself.
    fn descriptor() -> LawDescriptor;

    /// Makes an instance.
    ///
    /// # Errors
    /// The reason of a refusal.
    fn create(options: Option<&str>) -> Result<Self, String>;

    /// Answers one call with a status of the ABI.
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32;

    /// Changes the finished table, to break it in a chosen way.
    fn tamper(_table: &mut abi::LawTable) {}

    /// Changes a finished description of a quantity, to break it in a chosen way.
    fn tamper_quantity(_kind: i32, _index: i64, _quantity: &mut abi::Quantity) {}
}

/// The entry of a [`MemoryLaw`].
pub struct InMemory<L> {
    law: PhantomData<fn() -> L>,
}

impl<L: MemoryLaw> InMemory<L> {
    /// The entry of the law `L`.
    pub const fn new() -> Self {
        Self { law: PhantomData }
    }
}

impl<L: MemoryLaw> Default for InMemory<L> {
    fn default() -> Self {
        Self::new()
    }
}

// SAFETY: the functions below are part of this program, valid for all its life, and keep the ABI's contract.
unsafe impl<L: MemoryLaw> Entry for InMemory<L> {
    fn name(&self) -> &str {
        "memory"
    }

    unsafe fn call(&self, index: i32, _host: &'static abi::Host, table: &mut abi::LawTable) -> i32 {
        if index != 0 {
            return abi::WL_NO_MORE;
        }
        let law = L::descriptor();
        table.abi_minor = law.abi_minor;
        table.name = chars(&law.name);
        table.version = chars(&law.version);
        table.summary = chars(&law.summary);
        table.source = chars(&law.source);
        table.reads = law.reads.bits();
        table.uses = law.uses.bits();
        table.writes = law.writes.bits();
        table.claims = law.claims.bits();
        table.flags = law.flags.bits();
        table.constant_count = law.constants.len() as i64;
        table.state_count = law.state.len() as i64;
        table.input_count = law.inputs.len() as i64;
        match law.pressure_degree {
            Degree::Unclaimed => {}
            Degree::Value(value) => table.pressure_degree = value,
            Degree::Constant(index) => table.pressure_degree_constant = index as i64,
        }
        table.describe = Some(describe::<L>);
        table.create = Some(create::<L>);
        table.evaluate = Some(evaluate::<L>);
        table.destroy = Some(destroy::<L>);
        L::tamper(table);
        abi::WL_OK
    }
}

unsafe extern "C" fn describe<L: MemoryLaw>(kind: i32, index: i64, quantity: *mut abi::Quantity) -> i32 {
    let law = L::descriptor();
    let list: &[Quantity] = match kind {
        abi::WL_KIND_CONSTANT => &law.constants,
        abi::WL_KIND_STATE => &law.state,
        abi::WL_KIND_INPUT => &law.inputs,
        _ => &[],
    };
    // SAFETY: the host allocated the struct and holds it for the call.
    let place = unsafe { &mut *quantity };
    let found = usize::try_from(index).ok().and_then(|index| list.get(index));
    if let Some(found) = found {
        place.name = chars(&found.name);
        place.summary = chars(&found.summary);
        [place.metre, place.kilogram, place.second, place.kelvin] = found.exponents;
        place.minimum = found.minimum;
        place.maximum = found.maximum;
        place.default_value = found.default.unwrap_or(f64::NAN);
        let flags = [
            (found.closes_units, abi::WL_QUANTITY_CLOSES_UNITS),
            (found.above_minimum, abi::WL_QUANTITY_ABOVE_MINIMUM),
            (found.below_maximum, abi::WL_QUANTITY_BELOW_MAXIMUM),
        ];
        place.flags = flags.into_iter().filter(|(set, _)| *set).map(|(_, bit)| bit).sum();
    }
    L::tamper_quantity(kind, index, place);
    if found.is_some() || place.name[0] != 0 { abi::WL_OK } else { abi::WL_NO_MORE }
}

unsafe extern "C" fn create<L: MemoryLaw>(
    _host: *const abi::Host,
    options: *const c_char,
    instance: *mut *mut c_void,
    text: *mut c_char,
    text_size: i64,
) -> i32 {
    let options = if options.is_null() {
        None
    } else {
        // SAFETY: a text of the host is closed by a NUL.
        unsafe { CStr::from_ptr(options) }.to_str().ok()
    };
    match catch_unwind(|| L::create(options)) {
        Ok(Ok(law)) => {
            // SAFETY: the host gave a place for the pointer.
            unsafe { *instance = Box::into_raw(Box::new(law)).cast() };
            abi::WL_OK
        }
        Ok(Err(reason)) => {
            // SAFETY: the host gave a buffer of that size.
            unsafe { write_text(&reason, text, text_size) };
            abi::WL_FAILED
        }
        Err(_) => abi::WL_FAILED,
    }
}

unsafe extern "C" fn destroy<L: MemoryLaw>(instance: *mut c_void) {
    // SAFETY: `create` made this pointer from a box of the same type, and the host destroys it once.
    drop(unsafe { Box::from_raw(instance.cast::<L>()) });
}

unsafe extern "C" fn evaluate<L: MemoryLaw>(
    instance: *mut c_void,
    view: *const abi::View,
    output: *mut abi::Output,
) -> i32 {
    // SAFETY: `create` made the instance as this type; the host holds view and output for the call.
    let (law, view, raw) = unsafe { (&*instance.cast::<L>(), &*view, &mut *output) };
    let points = view.points as usize;
    let mut outputs = MemoryOutputs {
        // SAFETY: the host gives [points] for the increment, and nothing else refers to it during the call.
        increment: unsafe { std::slice::from_raw_parts_mut(raw.increment, points) },
        direction: given(raw.direction, 3 * points),
        state: given(raw.state, points * view.state_count as usize),
        status: given(raw.status, points),
        d_pressure: given(raw.d_pressure, points),
        first_bad: raw.first_bad,
        dt_factor: raw.dt_factor,
        missing: raw.missing,
        text: String::new(),
    };
    let status = catch_unwind(AssertUnwindSafe(|| law.evaluate(&MemoryInputs { view }, &mut outputs)));
    (raw.first_bad, raw.dt_factor, raw.missing) = (outputs.first_bad, outputs.dt_factor, outputs.missing);
    // SAFETY: the host gave a buffer of that size, or NULL.
    unsafe { write_text(&outputs.text, raw.text, raw.text_size) };
    status.unwrap_or(abi::WL_FAILED)
}

fn given<'a, T>(pointer: *mut T, length: usize) -> Option<&'a mut [T]> {
    // SAFETY: only called by `evaluate`, with an array of the host of the length that the ABI gives, or NULL.
    (!pointer.is_null()).then(|| unsafe { std::slice::from_raw_parts_mut(pointer, length) })
}

unsafe fn write_text(words: &str, text: *mut c_char, text_size: i64) {
    if text.is_null() || text_size < 1 {
        return;
    }
    // SAFETY: the caller has a buffer of that size.
    let buffer = unsafe { std::slice::from_raw_parts_mut(text, text_size as usize) };
    let bytes = words.bytes().take(buffer.len() - 1).chain([0]);
    for (place, byte) in buffer.iter_mut().zip(bytes) {
        *place = c_char::from_ne_bytes([byte]);
    }
}

/// The inputs of one call, safe to read.
pub struct MemoryInputs<'a> {
    view: &'a abi::View,
}

impl MemoryInputs<'_> {
    /// The raw view.
    pub fn view(&self) -> &abi::View {
        self.view
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.view.points as usize
    }

    /// A scalar field at a point; none if it is absent.
    pub fn scalar(&self, field: Field, point: usize) -> Option<f64> {
        self.vector(field, point).map(|[first, ..]| first)
    }

    /// A real field at a point, its first component alone if it is no vector; none if it is absent.
    pub fn vector(&self, field: Field, point: usize) -> Option<[f64; 3]> {
        let mut view = *self.view;
        let column = *super::batch::column_of(&mut view, field)?;
        let width = field.shape().width();
        let mut vector = [0.0; 3];
        for (index, place) in vector.iter_mut().enumerate().take(width) {
            *place = self.read(column, point, index)?;
        }
        Some(vector)
    }

    /// Constant `index` at a point; none if there is no such constant.
    pub fn constant(&self, index: usize, point: usize) -> Option<f64> {
        if index >= self.view.constant_count as usize {
            return None;
        }
        // SAFETY: the host gives [constant_count] columns.
        self.read(unsafe { *self.view.constants.add(index) }, point, 0)
    }

    /// Further input `index` at a point; none if there is no such input.
    pub fn input(&self, index: usize, point: usize) -> Option<f64> {
        if index >= self.view.input_count as usize {
            return None;
        }
        // SAFETY: the host gives [input_count] columns.
        self.read(unsafe { *self.view.inputs.add(index) }, point, 0)
    }

    /// State variable `index` at a point; none if there is no such variable.
    pub fn state(&self, index: usize, point: usize) -> Option<f64> {
        if index >= self.view.state_count as usize { None } else { self.read(self.view.state, point, index) }
    }

    fn read(&self, column: abi::Column, point: usize, index: usize) -> Option<f64> {
        assert!(point < self.points(), "point {point} of {}", self.points());
        if column.ptr.is_null() {
            return None;
        }
        // SAFETY: the host gives columns that reach over all points, and `point` is one of them.
        Some(unsafe { *column.ptr.offset(point as isize * column.step as isize).add(index) })
    }
}

/// The outputs of one call.
pub struct MemoryOutputs<'a> {
    /// Wear increment `[points]`.
    pub increment: &'a mut [f64],
    /// Wear direction `[points][3]`, if it is wanted.
    pub direction: Option<&'a mut [f64]>,
    /// State variables at the end `[points][variables]`, if there are any.
    pub state: Option<&'a mut [f64]>,
    /// Status of every point, if it is wanted.
    pub status: Option<&'a mut [i32]>,
    /// Derivative with respect to the pressure `[points]`, if it is wanted.
    pub d_pressure: Option<&'a mut [f64]>,
    /// First bad point, or -1.
    pub first_bad: i64,
    /// Factor for the next try.
    pub dt_factor: f64,
    /// Field bits of what is missing.
    pub missing: i64,
    /// What went wrong.
    pub text: String,
}
