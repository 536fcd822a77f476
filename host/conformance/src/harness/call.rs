//! One call of a law: a case laid out in columns, with arrays for the answers.
#![allow(unsafe_code)] // reason: fills arrays that a law gets as raw pointers, and reads what it left there.

use std::ffi::c_char;

use wearlaw_plugin_api::abi;

use super::arrays::{Arrays, Room};
use super::columns::view_of;
pub(crate) use super::layout::{Asked, Given, Layout, Spread};
use super::points::Case;
use super::sample::Answering;
use super::subject::Instance;
use wearlaw_law::batch::column_of;
use wearlaw_law::{Field, LawDescriptor};

/// Most points of a batch that are called one by one to find the one that matters.
const SEARCHED: usize = 1 << 17;

/// A call, ready to be made.
pub(crate) struct Call {
    case: Case,
    /// Values of scalar fields that are different from those of the case.
    changed: Vec<(Field, Vec<f64>)>,
    law: LawDescriptor,
    layout: Layout,
    _arrays: [Arrays; 2],
    view: *mut abi::View,
    output: *mut abi::Output,
    outputs: Outputs,
}

/// Where the arrays of the outputs are, whatever the law does to the struct that says so.
#[derive(Clone, Copy)]
struct Outputs {
    increment: *mut f64,
    direction: *mut f64,
    state: *mut f64,
    d_pressure: *mut f64,
    status: *mut i32,
    text: *mut u8,
}

/// What a call came to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Answers {
    pub(crate) status: i32,
    pub(crate) first_bad: i64,
    pub(crate) dt_factor: f64,
    pub(crate) missing: i64,
    pub(crate) increment: Vec<f64>,
    /// Three a point, or empty.
    pub(crate) direction: Vec<f64>,
    /// All variables of a point, point by point, or empty.
    pub(crate) state: Vec<f64>,
    pub(crate) d_pressure: Vec<f64>,
    pub(crate) point_status: Vec<i32>,
    pub(crate) text: Vec<u8>,
}

impl Answers {
    /// True if the values are meant to be used.
    pub(crate) fn is_good(&self) -> bool {
        good(self.status)
    }
}

/// True for a status whose values are meant to be used.
pub(crate) fn good(status: i32) -> bool {
    status == abi::WL_OK || status == abi::WL_UNRELIABLE
}

impl Call {
    /// Lays a case out.
    pub(crate) fn new(law: &LawDescriptor, case: &Case, layout: &Layout) -> Self {
        let mut arrays = Arrays::new(layout.room, 8 * layout.skew).skewed(layout.skews);
        let mut view = view_of(law, case, layout, &mut arrays);
        let outputs = Outputs::place(&mut arrays, law, case.count, layout);
        view.request = bits(&layout.asked);
        let output = abi::Output {
            struct_size: size_of::<abi::Output>() as i64,
            increment: outputs.increment,
            direction: outputs.direction,
            state: outputs.state,
            status: outputs.status,
            first_bad: -1,
            dt_factor: 0.0,
            missing: 0,
            text: outputs.text.cast::<c_char>(),
            text_size: layout.text.unwrap_or(0) as i64,
            d_pressure: outputs.d_pressure,
        };
        // What lies behind a struct is looked at with structs of other sizes.
        let room = if layout.room == Room::GuardBehind { Room::Plain } else { layout.room };
        let mut structs = Arrays::new(room, 0);
        let view = put(&mut structs, "the view", view, true);
        let output = put(&mut structs, "the output", output, false);
        if layout.sealed {
            structs.seal();
        }
        if layout.sealed || layout.state_sealed {
            arrays.seal();
        }
        Self {
            case: case.clone(),
            changed: Vec::new(),
            law: law.clone(),
            layout: *layout,
            _arrays: [arrays, structs],
            view,
            output,
            outputs,
        }
    }

    /// Notes the inputs on the slate and calls the law.
    pub(crate) fn evaluate(&mut self, instance: &Instance<'_>) -> i32 {
        let slate = instance.law.library.slate;
        let number = slate.count_call(self.case.count);
        slate.input(lines(&self.single(0), &self.law).as_bytes());
        if narrowed(number) && self.case.count > 1 {
            slate.points(1);
            for point in 0..self.case.count.min(SEARCHED) {
                let single = self.single(point);
                let mut call = Call::new(&self.law, &single, &self.layout);
                slate.input(lines(&single, &self.law).as_bytes());
                slate.single_begins();
                call.repeat(instance);
            }
            slate.points(self.case.count);
            slate.input(lines(&self.single(0), &self.law).as_bytes());
        }
        self.repeat(instance)
    }

    /// One point of the call, with the values that its columns have now.
    fn single(&self, point: usize) -> Case {
        if self.case.count == 0 {
            return self.case.clone();
        }
        let mut single = self.case.single(point);
        for (field, values) in &self.changed {
            single.points[0].set(*field, 0, values[point]);
        }
        single
    }

    /// Changes the values of a scalar field that was given per point.
    ///
    /// # Panics
    /// If there are not as many as points.
    pub(crate) fn set_field(&mut self, field: Field, values: Vec<f64>) {
        assert_eq!(values.len(), self.case.count);
        // SAFETY: the view lives as long as `self`; its column of this field was made by `new`.
        let column = unsafe { column_of(&mut *self.view, field).map(|column| *column) };
        let Some(column) = column.filter(|column| column.step == 1) else { return };
        // SAFETY: a column with step 1 that `new` made has one double for each point, in an array of this call.
        unsafe { column.ptr.cast_mut().copy_from_nonoverlapping(values.as_ptr(), values.len()) };
        self.changed.retain(|(other, _)| *other != field);
        self.changed.push((field, values));
    }

    /// Calls the law again without a note: for loops.
    pub(crate) fn repeat(&mut self, instance: &Instance<'_>) -> i32 {
        // SAFETY: `new` filled view and output as the ABI says; the arrays live as long as `self`.
        unsafe {
            ((*self.output).first_bad, (*self.output).dt_factor, (*self.output).missing) = (-1, 0.0, 0);
            instance.evaluate(self.view, self.output)
        }
    }

    /// Calls the law and reads its answers.
    pub(crate) fn answers(&mut self, instance: &Instance<'_>) -> Answers {
        let status = self.evaluate(instance);
        self.read(status)
    }

    /// Reads the answers of the last call, which came to `status`.
    pub(crate) fn read(&self, status: i32) -> Answers {
        // SAFETY: the struct lives as long as `self`, and any bits are values of its numbers.
        self.read_from(status, &unsafe { *self.output })
    }

    /// As [`Call::read`], for a call that was made with another struct over the same arrays.
    pub(crate) fn read_from(&self, status: i32, output: &abi::Output) -> Answers {
        let (count, variables) = (self.case.count, self.law.state.len());
        let place = &self.outputs;
        Answers {
            status,
            first_bad: output.first_bad,
            dt_factor: output.dt_factor,
            missing: output.missing,
            increment: numbers(place.increment, count),
            direction: numbers(place.direction, 3 * count),
            state: numbers(place.state, variables * count),
            d_pressure: numbers(place.d_pressure, count),
            point_status: numbers(place.status, count),
            text: numbers(place.text, self.layout.text.unwrap_or(0)),
        }
    }

    /// The view, for a copy of it.
    pub(crate) fn view(&self) -> *const abi::View {
        self.view
    }

    /// The output, for a copy of it.
    pub(crate) fn output(&self) -> *const abi::Output {
        self.output
    }

    /// The values of the state at the start as they are now.
    pub(crate) fn state_at_start(&self) -> Vec<f64> {
        // SAFETY: the view lives as long as `self`; a law that changed its pointer wrote what another check finds.
        let column = unsafe { (*self.view).state };
        let variables = self.law.state.len();
        if variables == 0 || column.step != variables as i64 {
            return Vec::new();
        }
        numbers(column.ptr.cast_mut(), variables * self.case.count)
    }
}

impl Answering for Instance<'_> {
    fn wears(&self, case: &Case) -> Option<bool> {
        let law = &self.law.about;
        let layout = Layout { asked: Asked::values(law), ..Layout::plain(law) };
        let answers = Call::new(law, case, &layout).answers(self);
        let finite =
            answers.increment.iter().chain(&answers.direction).chain(&answers.state).all(|value| value.is_finite());
        (answers.is_good() && finite).then(|| answers.increment.iter().any(|increment| *increment != 0.0))
    }
}

/// Number of the call that is made point by point first; 0: none.
static NARROW: std::sync::atomic::AtomicU64 = std::sync::atomic::AtomicU64::new(0);

/// Makes the call of this number point by point first.
pub(crate) fn narrow(call: Option<u64>) {
    NARROW.store(call.unwrap_or(0), std::sync::atomic::Ordering::Relaxed);
}

fn narrowed(number: u64) -> bool {
    NARROW.load(std::sync::atomic::Ordering::Relaxed) == number
}

/// The inputs at the first point, a line each.
fn lines(case: &Case, law: &LawDescriptor) -> String {
    case.named(law, 0).iter().fold(String::new(), |text, (name, value)| text + name + "\t" + value + "\n")
}

fn put<T>(arrays: &mut Arrays, name: &str, value: T, read_only: bool) -> *mut T {
    let place = arrays.place(name, size_of::<T>(), read_only).cast::<T>();
    // SAFETY: the place was just made with room for the value; arrays begin or end at a page, and the sizes of the
    // structs are multiples of their alignment.
    unsafe { place.write(value) };
    place
}

impl Outputs {
    fn place(arrays: &mut Arrays, law: &LawDescriptor, count: usize, layout: &Layout) -> Self {
        let filling = layout.filling;
        let mut doubles = |name: &str, wanted: bool, length: usize| {
            if !wanted {
                return std::ptr::null_mut();
            }
            let first = arrays.place(name, 8 * length, false).cast::<u64>();
            // SAFETY: the array was just made with room for `length` words.
            unsafe { std::slice::from_raw_parts_mut(first, length) }.fill(filling);
            first.cast::<f64>()
        };
        let asked = &layout.asked;
        let (increment, direction) =
            (doubles("increment", true, count), doubles("direction", asked.direction, 3 * count));
        let state = doubles("state (end)", asked.state, law.state.len() * count);
        let d_pressure = doubles("d_pressure", asked.d_pressure, count);
        let mut status = std::ptr::null_mut();
        if asked.status {
            status = arrays.place("status", 4 * count, false).cast::<i32>();
            // SAFETY: the array was just made with room for `count` integers.
            unsafe { std::slice::from_raw_parts_mut(status, count) }.fill(filling as i32);
        }
        let mut text = std::ptr::null_mut();
        if let Some(size) = layout.text {
            text = arrays.place("the buffer for a text", size, false);
            // SAFETY: the buffer was just made with room for `size` bytes.
            unsafe { std::slice::from_raw_parts_mut(text, size) }.fill(filling as u8);
        }
        Self { increment, direction, state, d_pressure, status, text }
    }
}

fn bits(asked: &Asked) -> i64 {
    let bit = |set: bool, bit: i64| if set { bit } else { 0 };
    bit(asked.direction, abi::WL_OUT_DIRECTION)
        | bit(asked.state, abi::WL_OUT_STATE)
        | bit(asked.d_pressure, abi::WL_OUT_D_PRESSURE)
        | bit(asked.status, abi::WL_OUT_STATUS)
}

fn numbers<T: Copy>(first: *mut T, length: usize) -> Vec<T> {
    if first.is_null() {
        return Vec::new();
    }
    // SAFETY: `first` leads to an array of this call of that length, which the law has left.
    unsafe { std::slice::from_raw_parts(first, length) }.to_vec()
}
