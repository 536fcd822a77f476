//! The columns of a call: the values of a case laid out as the ABI wants them.
#![allow(unsafe_code)] // reason: fills arrays that a law gets as raw pointers.

use wearlaw_plugin_api::abi;

use super::arrays::Arrays;
use super::layout::{Given, Layout, Spread};
use super::points::Case;
use wearlaw_law::batch::{blank_view, column_of, index_column_of};
use wearlaw_law::fields::Shape;
use wearlaw_law::{Field, LawDescriptor};

/// More points than this, and fields that the law does not declare are given once for all.
const MANY: usize = 4096;
/// What lies between the values of a column: a law that takes it for a value gives a NaN.
const BETWEEN: f64 = f64::NAN;

/// A view whose columns hold the values of a case, in arrays of their own.
pub(super) fn view_of(law: &LawDescriptor, case: &Case, layout: &Layout, arrays: &mut Arrays) -> abi::View {
    let mut view = blank_view(&case.numbers, case.count, law);
    for field in Field::ALL.iter().copied().filter(|field| is_given(law, *field, layout)) {
        lay_field(arrays, &mut view, law, case, layout, field);
    }
    let constants: Vec<_> = (0..law.constants.len())
        .map(|index| {
            let name = &law.constants[index].name;
            let once = layout.constant_alone.is_some_and(|alone| alone != index);
            let spread = if once { Spread::Uniform } else { layout.constants };
            let value = |case: &Case, point: usize, _: usize| case.constants(point)[index];
            let spread = mixed(layout, case, spread, 1, 32 + index, value);
            lay(arrays, name, case, spread, 1, value)
        })
        .collect();
    let inputs: Vec<_> = (0..law.inputs.len())
        .map(|index| {
            let name = &law.inputs[index].name;
            let value = |case: &Case, point: usize, _: usize| case.point(point).inputs[index];
            lay(arrays, name, case, mixed(layout, case, layout.inputs, 1, 48 + index, value), 1, value)
        })
        .collect();
    view.constants = columns(arrays, "the columns of the constants", &constants);
    view.inputs = columns(arrays, "the columns of the inputs", &inputs);
    if !law.state.is_empty() {
        view.state = lay_state(arrays, case, layout, law.state.len());
    }
    view
}

fn is_given(law: &LawDescriptor, field: Field, layout: &Layout) -> bool {
    if layout.absent.contains(field) {
        return false;
    }
    match layout.given {
        Given::All => true,
        Given::Declared => law.fields().contains(field),
    }
}

fn lay_field(
    arrays: &mut Arrays,
    view: &mut abi::View,
    law: &LawDescriptor,
    case: &Case,
    layout: &Layout,
    field: Field,
) {
    let many = case.count > MANY && !law.fields().contains(field);
    let spread = match layout.spread.contains(field) {
        _ if layout.uniform.contains(field) || many => Spread::Uniform,
        true => layout.fields,
        false => Spread::PerPoint,
    };
    if field.shape() == Shape::Index {
        // The bits of the integer, as the array has room for words.
        let value =
            |case: &Case, point: usize, _: usize| f64::from_bits(case.point(point).index(field).cast_unsigned());
        let spread = mixed(layout, case, spread, 1, field as usize, value);
        let column = lay(arrays, field.name(), case, spread, 1, value);
        if let Some(place) = index_column_of(view, field) {
            *place = abi::IndexColumn { ptr: column.ptr.cast(), step: column.step };
        }
    } else if let Some(place) = column_of(view, field) {
        let width = field.shape().width();
        let value = |case: &Case, point: usize, component: usize| case.point(point).real(field)[component];
        let spread = mixed(layout, case, spread, width, field as usize, value);
        *place = lay(arrays, field.name(), case, spread, width, value);
    }
}

/// How a column lies where each lies in a way of its own: once for all if its values are the same at every point and the
/// bits say so, else side by side or with gaps.
fn mixed(
    layout: &Layout,
    case: &Case,
    usual: Spread,
    width: usize,
    place: usize,
    value: impl Fn(&Case, usize, usize) -> f64,
) -> Spread {
    let Some(bits) = layout.mixed.filter(|_| usual != Spread::Uniform) else { return usual };
    // Two bits of each column.
    let pick = bits.rotate_right((2 * place % 64) as u32) & 3;
    let same = (1..case.count)
        .all(|point| (0..width).all(|at| value(case, point, at).to_bits() == value(case, 0, at).to_bits()));
    match pick {
        0 | 1 if same => Spread::Uniform,
        0 | 2 => Spread::PerPoint,
        1 => Spread::Strided(3),
        _ => Spread::Strided(2),
    }
}

fn lay_state(arrays: &mut Arrays, case: &Case, layout: &Layout, variables: usize) -> abi::Column {
    let value = |case: &Case, point: usize, variable: usize| case.point(point).state[variable];
    lay_sealed(arrays, "state (start)", case, layout.state, variables, layout.state_sealed, value)
}

fn lay(
    arrays: &mut Arrays,
    name: &str,
    case: &Case,
    spread: Spread,
    width: usize,
    value: impl Fn(&Case, usize, usize) -> f64,
) -> abi::Column {
    lay_sealed(arrays, name, case, spread, width, true, value)
}

fn lay_sealed(
    arrays: &mut Arrays,
    name: &str,
    case: &Case,
    spread: Spread,
    width: usize,
    read_only: bool,
    value: impl Fn(&Case, usize, usize) -> f64,
) -> abi::Column {
    let (step, rows) = match spread {
        Spread::PerPoint => (width, case.count),
        Spread::Uniform => (0, case.count.min(1)),
        Spread::Strided(times) => (times * width, case.count),
    };
    let length = if rows == 0 { 0 } else { (rows - 1) * step + width };
    let first = arrays.place(name, 8 * length, read_only).cast::<f64>();
    // SAFETY: the array was just made with room for `length` doubles, and nothing else refers to it.
    let array = unsafe { std::slice::from_raw_parts_mut(first, length) };
    if step > width {
        array.fill(BETWEEN);
    }
    for row in 0..rows {
        for component in 0..width {
            array[row * step + component] = value(case, row, component);
        }
    }
    abi::Column { ptr: first, step: step as i64 }
}

fn columns(arrays: &mut Arrays, name: &str, columns: &[abi::Column]) -> *const abi::Column {
    if columns.is_empty() {
        return std::ptr::null();
    }
    let first = arrays.place(name, size_of_val(columns), true).cast::<abi::Column>();
    // SAFETY: the array was just made with room for them.
    unsafe { first.copy_from_nonoverlapping(columns.as_ptr(), columns.len()) };
    first
}
