//! The columns of the ABI's view by field, and views of ranges.

use wearlaw_plugin_api::abi;

use super::super::descriptor::LawDescriptor;
use super::super::fields::{Field, Shape};
use super::super::values::CallNumbers;

const ABSENT: abi::Column = abi::Column { ptr: std::ptr::null(), step: 0 };
const NO_INDEX: abi::IndexColumn = abi::IndexColumn { ptr: std::ptr::null(), step: 0 };

/// A view with the numbers of the call and no columns.
pub fn blank_view(numbers: &CallNumbers, points: usize, law: &LawDescriptor) -> abi::View {
    abi::View {
        struct_size: size_of::<abi::View>() as i64,
        points: points as i64,
        dimension: numbers.dimension,
        request: 0,
        time: numbers.time,
        dt: numbers.dt,
        step_time: numbers.step_time,
        load_step: numbers.load_step,
        substep: numbers.substep,
        cycle: numbers.cycle,
        material: numbers.material,
        pair: numbers.pair,
        body: numbers.body,
        counter_body: numbers.counter_body,
        reference_temperature: numbers.reference_temperature,
        absolute_zero: numbers.absolute_zero,
        unit_metre: numbers.units.metre,
        unit_kilogram: numbers.units.kilogram,
        unit_second: numbers.units.second,
        unit_kelvin: numbers.units.kelvin,
        constant_count: law.constants.len() as i64,
        constants: std::ptr::null(),
        input_count: law.inputs.len() as i64,
        inputs: std::ptr::null(),
        state_count: law.state.len() as i64,
        state: ABSENT,
        pressure: ABSENT,
        slip: ABSENT,
        velocity: ABSENT,
        slip_vector: ABSENT,
        normal: ABSENT,
        coordinates: ABSENT,
        tangent: ABSENT,
        temperature: ABSENT,
        counter_temperature: ABSENT,
        friction_stress: ABSENT,
        friction_coefficient: ABSENT,
        friction_work: ABSENT,
        accumulated_wear: ABSENT,
        accumulated_slip: ABSENT,
        nodal_traction: ABSENT,
        gap: ABSENT,
        area: ABSENT,
        contact_state: NO_INDEX,
        point_id: NO_INDEX,
        element_id: NO_INDEX,
    }
}

/// The column of a real field.
pub fn column_of(view: &mut abi::View, field: Field) -> Option<&mut abi::Column> {
    Some(match field {
        Field::Pressure => &mut view.pressure,
        Field::Slip => &mut view.slip,
        Field::Velocity => &mut view.velocity,
        Field::SlipVector => &mut view.slip_vector,
        Field::Normal => &mut view.normal,
        Field::Coordinates => &mut view.coordinates,
        Field::Tangent => &mut view.tangent,
        Field::Temperature => &mut view.temperature,
        Field::CounterTemperature => &mut view.counter_temperature,
        Field::FrictionStress => &mut view.friction_stress,
        Field::FrictionCoefficient => &mut view.friction_coefficient,
        Field::FrictionWork => &mut view.friction_work,
        Field::AccumulatedWear => &mut view.accumulated_wear,
        Field::AccumulatedSlip => &mut view.accumulated_slip,
        Field::NodalTraction => &mut view.nodal_traction,
        Field::Gap => &mut view.gap,
        Field::Area => &mut view.area,
        Field::ContactState | Field::PointId | Field::ElementId => return None,
    })
}

/// The column of an integer field.
pub fn index_column_of(view: &mut abi::View, field: Field) -> Option<&mut abi::IndexColumn> {
    match field {
        Field::ContactState => Some(&mut view.contact_state),
        Field::PointId => Some(&mut view.point_id),
        Field::ElementId => Some(&mut view.element_id),
        _ => None,
    }
}

/// Numbers from point to point of a field, real or integer; 0 if it is one for all or absent.
pub(super) fn step_of(view: &abi::View, field: Field) -> i64 {
    let mut view = *view;
    let step = column_of(&mut view, field).map(|column| column.step);
    step.or_else(|| index_column_of(&mut view, field).map(|column| column.step)).unwrap_or(0)
}

/// The column that begins `points` points later.
pub(super) fn behind(column: abi::Column, points: usize) -> abi::Column {
    abi::Column { ptr: column.ptr.wrapping_offset(points as isize * column.step as isize), step: column.step }
}

/// Lets the column of `field` begin `points` points later; one that is absent has step 0 and stays.
pub(super) fn advance(view: &mut abi::View, field: Field, points: usize) {
    if field.shape() == Shape::Index {
        if let Some(column) = index_column_of(view, field) {
            column.ptr = column.ptr.wrapping_offset(points as isize * column.step as isize);
        }
    } else if let Some(column) = column_of(view, field) {
        *column = behind(*column, points);
    }
}
