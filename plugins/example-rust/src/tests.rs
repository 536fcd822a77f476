#![allow(unsafe_code)] // the tests stand where a host stands
//! The law through its ABI, the way a host calls it.

use std::ffi::c_char;
use std::mem::{size_of, zeroed};
use std::ptr::null;

use wearlaw_plugin_api::abi::{self, LawTable, Output, View};

use super::*;

/// What a call answered at its one point.
struct Answered {
    status: i32,
    increment: f64,
    direction: [f64; 3],
    d_pressure: f64,
    text: String,
}

/// One point, by default of steel at the temperature where H holds, sliding along x under a normal along z.
#[derive(Clone, Copy)]
struct Case {
    /// K, H, softening, T0, tilt.
    constants: [f64; 5],
    pressure: f64,
    slip: f64,
    temperature: f64,
    absolute_zero: f64,
    normal: [f64; 3],
    slip_vector: Option<[f64; 3]>,
}

const CASE: Case = Case {
    constants: [1e-4, 2e9, 1e-3, 293.15, 0.0],
    pressure: 5e7,
    slip: 1e-2,
    temperature: 293.15,
    absolute_zero: 0.0,
    normal: [0.0, 0.0, 1.0],
    slip_vector: Some([1e-2, 0.0, 0.0]),
};

fn table() -> LawTable {
    // SAFETY: all-zero bytes are a valid table; the entry is told its true size.
    unsafe {
        let mut table: LawTable = zeroed();
        table.struct_size = size_of::<LawTable>() as i64;
        assert_eq!(wearlaw_entry_1(0, null(), &mut table), WL_OK);
        assert_eq!(wearlaw_entry_1(1, null(), &mut table), WL_NO_MORE);
        table
    }
}

impl Case {
    fn evaluate(&self) -> Answered {
        let table = table();
        let one = |value: &f64| abi::Column { ptr: value, step: 0 };
        let columns = self.constants.each_ref().map(one);
        let (mut increment, mut d_pressure, mut direction) = (f64::NAN, f64::NAN, [f64::NAN; 3]);
        let mut text = [0 as c_char; 128];
        // SAFETY: all-zero bytes are valid for these structs, every pointer outlives the call, the sizes are true.
        let status = unsafe {
            let (mut view, mut output): (View, Output) = zeroed();
            view.struct_size = size_of::<View>() as i64;
            (view.points, view.dimension, view.dt) = (1, 3, 1.0);
            view.absolute_zero = self.absolute_zero;
            (view.constants, view.constant_count) = (columns.as_ptr(), 5);
            (view.pressure, view.slip) = (one(&self.pressure), one(&self.slip));
            (view.temperature, view.normal) = (one(&self.temperature), one(&self.normal[0]));
            view.normal.ptr = self.normal.as_ptr();
            view.slip_vector.ptr = self.slip_vector.as_ref().map_or(null(), |s| s.as_ptr());
            output.struct_size = size_of::<Output>() as i64;
            (output.increment, output.d_pressure) = (&mut increment, &mut d_pressure);
            output.direction = direction.as_mut_ptr();
            (output.text, output.text_size, output.first_bad) = (text.as_mut_ptr(), 128, -1);
            let mut instance = std::ptr::null_mut();
            let create = table.create.expect("there is a create");
            assert_eq!(create(null(), null(), &mut instance, std::ptr::null_mut(), 0), WL_OK);
            let status = table.evaluate.expect("there is an evaluate")(instance, &view, &mut output);
            table.destroy.expect("there is a destroy")(instance);
            status
        };
        let text = text.iter().take_while(|c| **c != 0).map(|c| *c as u8 as char).collect();
        Answered { status, increment, direction, d_pressure, text }
    }

    #[track_caller]
    fn good(&self) -> Answered {
        let answered = self.evaluate();
        assert_eq!(answered.status, WL_OK, "{}", answered.text);
        answered
    }

    #[track_caller]
    fn refused(&self, words: &str) {
        let answered = self.evaluate();
        assert_eq!(answered.status, WL_OUT_OF_DOMAIN, "{words}");
        assert!(answered.text.contains(words), "found \"{}\", expected \"{words}\"", answered.text);
    }
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-15 * expected.abs(), "found {found:e}, expected {expected:e}");
}

#[test]
fn warm_metal_is_softer_and_wears_more() {
    let cold = CASE.good();
    assert_close(cold.increment, 1e-4 / 2e9 * 5e7 * 1e-2);
    assert_close(cold.d_pressure, 1e-4 / 2e9 * 1e-2);
    let warm = Case { temperature: 293.15 + 500.0, ..CASE }.good();
    assert_close(warm.increment, 2.0 * cold.increment);
    assert_close(warm.d_pressure, 2.0 * cold.d_pressure);
    let freezing = Case { temperature: 293.15 - 250.0, ..CASE }.good();
    assert_close(freezing.increment, cold.increment / 1.25);
}

#[test]
fn the_direction_is_tilted_against_the_slip_and_stays_a_unit_vector_into_the_body() {
    let third = 1.0 / 3.0_f64;
    let normals = [[0.0, 0.0, 1.0], [0.6, -0.8, 0.0], [third, 2.0 * third, -2.0 * third]];
    let slips = [[1e-2, 0.0, 0.0], [-3e-7, 4e-7, 5e-9], [1e-300, 2e-300, 0.0], [1e200, 0.0, -3e200]];
    for normal in normals {
        for slip in slips {
            for tilt in [0.0, 0.1, 1.0, 10.0] {
                let mut case = Case { normal, slip_vector: Some(slip), ..CASE };
                case.constants[4] = tilt;
                let d = case.good().direction;
                let inward = -dot(d, normal);
                assert!((dot(d, d) - 1.0).abs() <= 1e-12, "{normal:?} {slip:?} {tilt}: {d:?}");
                assert!((inward - 1.0 / (1.0 + tilt * tilt).sqrt()).abs() <= 1e-12, "{normal:?} {slip:?} {tilt}");
                let most = slip.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                let unit = slip.map(|x| x / most);
                let tangential: [f64; 3] = std::array::from_fn(|i| unit[i] - dot(unit, normal) * normal[i]);
                let along = dot(d, tangential) / dot(tangential, tangential).sqrt();
                assert!((along + tilt * inward).abs() <= 1e-12 * (1.0 + tilt), "{normal:?} {slip:?} {tilt}: {along}");
            }
        }
    }
}

#[test]
fn without_a_slip_direction_it_is_against_the_normal() {
    for slip_vector in [None, Some([0.0; 3]), Some([0.0, 0.0, 3e-3])] {
        let mut case = Case { slip_vector, ..CASE };
        case.constants[4] = 0.5;
        assert_eq!(case.good().direction, [-0.0, -0.0, -1.0], "{slip_vector:?}");
    }
}

#[test]
fn turning_the_frame_turns_the_direction_and_leaves_the_increment() {
    // A turn that carries x to y, y to z and z to x is exact in doubles.
    let turn = |[x, y, z]: [f64; 3]| [z, x, y];
    let mut case = Case { normal: [0.6, 0.0, 0.8], slip_vector: Some([0.8e-3, 2e-3, -0.6e-3]), ..CASE };
    case.constants[4] = 0.3;
    let (before, turned) =
        (case.good(), Case { normal: turn(case.normal), slip_vector: case.slip_vector.map(turn), ..case });
    let after = turned.good();
    assert_eq!(after.increment, before.increment);
    for (found, expected) in after.direction.iter().zip(turn(before.direction)) {
        assert!((found - expected).abs() <= 4e-16, "{:?} {:?}", after.direction, before.direction);
    }
}

#[test]
fn no_pressure_or_no_slip_is_no_wear() {
    for pressure in [0.0, -0.0, -1e6] {
        let answered = Case { pressure, ..CASE }.good();
        assert_eq!((answered.increment, answered.d_pressure), (0.0, 0.0));
    }
    assert_eq!(Case { slip: 0.0, slip_vector: Some([0.0; 3]), ..CASE }.good().increment, 0.0);
}

#[test]
fn a_hardness_near_its_end_is_warned_of_and_beyond_it_refused() {
    let low = Case { temperature: 293.15 + 800.0, ..CASE }.evaluate();
    assert_eq!(low.status, WL_UNRELIABLE, "{}", low.text);
    assert!(low.increment.is_finite() && low.text.contains("a quarter of H"), "{}", low.text);
    Case { temperature: 293.15 + 950.0, ..CASE }.refused("a tenth of H");
    Case { temperature: 293.15 + 2000.0, ..CASE }.refused("a tenth of H");
}

#[test]
fn what_cannot_be_is_refused() {
    Case { temperature: -1.0, ..CASE }.refused("below absolute zero");
    let mut celsius = Case { temperature: -20.0, absolute_zero: -273.15, ..CASE };
    celsius.constants[3] = 20.0;
    assert_close(celsius.good().increment, 1e-4 / (2e9 * 1.04) * 1e-2 * 5e7);
    for case in [
        Case { pressure: f64::NAN, ..CASE },
        Case { pressure: f64::INFINITY, ..CASE },
        Case { slip: f64::NAN, ..CASE },
        Case { slip: -1e-3, ..CASE },
        Case { temperature: f64::NAN, ..CASE },
    ] {
        case.refused("out of its range or not a number");
    }
    for (k, value) in [(0, -1.0), (1, 0.0), (1, f64::NAN), (2, -1e-3), (3, f64::NAN), (4, -0.1), (4, 11.0)] {
        let mut case = CASE;
        case.constants[k] = value;
        case.refused("out of its range or not a number");
    }
    Case { slip_vector: Some([0.0, f64::NAN, 1.0]), ..CASE }.refused("slip vector");
    Case { normal: [0.0; 3], ..CASE }.refused("normal is no vector");
    Case { normal: [0.0, f64::INFINITY, 0.0], ..CASE }.refused("normal is no vector");
    Case { pressure: 1e300, slip: 1e300, ..CASE }.refused("overflows");
}

#[test]
fn options_are_refused() {
    assert!(SofteningPlough::create(Some("fast")).is_err_and(|words| words.contains("\"fast\"")));
    assert!(SofteningPlough::create(Some("")).is_ok());
}
