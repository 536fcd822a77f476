#![allow(unsafe_code)] // the tests stand where a host stands
//! The law through its ABI, the way a host calls it: extreme inputs and their right answers.

use std::ffi::c_char;
use std::mem::{size_of, zeroed};
use std::ptr::{null, null_mut};

use wearlaw_plugin_api::abi::{self, LawTable, Output, View};
use wearlaw_plugin_api::sdk::export::fill;
use wearlaw_plugin_api::sdk::prelude::*;

use super::Archard;

struct Answered {
    status: i32,
    increment: Vec<f64>,
    slope: Vec<f64>,
    first_bad: i64,
    text: String,
}

/// Evaluates with constants [K, H, m, n] over a step `dt`.
fn evaluate(constants: [f64; 4], dt: f64, pressure: &[f64], velocity: &[f64]) -> Answered {
    let [answered, alone] = [true, false].map(|slope| ask(constants, dt, pressure, velocity, slope));
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&alone.increment), bits(&answered.increment), "without and with the slope");
    // A slope may overflow where the increment does not.
    assert!(alone.status <= answered.status);
    answered
}

fn ask(constants: [f64; 4], dt: f64, pressure: &[f64], velocity: &[f64], with_slope: bool) -> Answered {
    let points = pressure.len();
    let column = |values: &[f64]| abi::Column { ptr: values.as_ptr(), step: i64::from(values.len() == points) };
    let columns = constants.each_ref().map(|c| abi::Column { ptr: c, step: 0 });
    let (mut increment, mut slope) = (vec![f64::NAN; points], vec![f64::NAN; points]);
    let mut text = [0 as c_char; 128];
    // SAFETY: all-zero bytes are valid for these structs, every pointer outlives the calls, and the sizes are true.
    let (status, output) = unsafe {
        let (mut view, mut output, mut table): (View, Output, LawTable) = zeroed();
        view.struct_size = size_of::<View>() as i64;
        view.points = points as i64;
        view.dt = dt;
        (view.pressure, view.velocity) = (column(pressure), column(velocity));
        (view.constants, view.constant_count) = (columns.as_ptr(), 4);
        output.struct_size = size_of::<Output>() as i64;
        output.increment = increment.as_mut_ptr();
        if with_slope {
            output.d_pressure = slope.as_mut_ptr();
        }
        (output.text, output.text_size, output.first_bad) = (text.as_mut_ptr(), 128, -1);
        fill::<Archard>(&mut table);
        let mut instance = null_mut();
        let create = table.create.expect("there is a create");
        assert_eq!(create(null(), null(), &mut instance, null_mut(), 0), WL_OK);
        let status = table.evaluate.expect("there is an evaluate")(instance, &view, &mut output);
        table.destroy.expect("there is a destroy")(instance);
        (status, output)
    };
    let text = text.iter().take_while(|c| **c != 0).map(|c| *c as u8 as char).collect();
    Answered { status, increment, slope, first_bad: output.first_bad, text }
}

fn one(constants: [f64; 4], p: f64, v: f64) -> Answered {
    evaluate(constants, 1.0, &[p], &[v])
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-15 * expected.abs(), "found {found:e}, expected {expected:e}");
}

#[test]
fn linear_wear_and_its_slope() {
    let answer = evaluate([1e-4, 1e10, 1.0, 1.0], 3.5, &[1e9, 2e9, -1.0], &[1.0, -2.0, 1.0]);
    assert_eq!((answer.status, answer.increment[2], answer.slope[2]), (WL_OK, 0.0, 0.0));
    assert_close(answer.increment[0], 3.5e-5);
    assert_close(answer.increment[1], 1.4e-4);
    assert_close(answer.slope[1], 7e-14);
}

#[test]
fn nothing_overflows_only_in_between() {
    assert_close(one([1e-300, 1.0, 40.0, 1.0], 1e9, 1.0).increment[0], 1e60);
    assert_close(one([1e-200, 1e200, 20.0, 1.0], 1e9, 1.0).increment[0], 1e-220);
    // 1e-320 is a subnormal number; what it stands for is 9.99989e-321.
    let found = one([1e-320, 1.0, 34.0, 1.0], 1e9, 1.0).increment[0];
    assert!((found / 1e-14 - 1.0).abs() < 1e-3, "{found:e}");
}

#[test]
fn a_result_that_overflows_is_refused() {
    let answer = one([1.0, 1.0, 40.0, 1.0], 1e9, 1.0);
    assert_eq!((answer.status, answer.first_bad), (WL_OUT_OF_DOMAIN, 0));
    assert!(answer.text.contains("overflows"), "{}", answer.text);
}

#[test]
fn no_pressure_no_wear_whatever_the_exponent() {
    for m in [-1.0, 0.0, 0.5, 1.0, 2.0] {
        for p in [0.0, -0.0, -5.0] {
            let answer = one([1e-4, 1e9, m, 1.0], p, 1.0);
            assert_eq!((answer.status, answer.increment[0]), (WL_OK, 0.0), "m = {m}, p = {p}");
        }
    }
}

#[test]
fn no_velocity_depends_on_its_exponent() {
    assert_eq!(one([1e-4, 1e9, 1.0, 0.5], 1e9, 0.0).increment, [0.0]);
    assert_close(one([1e-4, 1e9, 1.0, 0.0], 1e9, 0.0).increment[0], 1e-4);
    let answer = one([1e-4, 1e9, 1.0, -0.5], 1e9, 0.0);
    assert_eq!(answer.status, WL_OUT_OF_DOMAIN);
    assert!(answer.text.contains("velocity is 0"), "{}", answer.text);
}

#[test]
fn inputs_that_are_no_numbers_are_named_even_where_powers_hide_them() {
    // IEEE has pow(NaN, 0) = pow(1, NaN) = 1.
    for (constants, p, v, word) in [
        ([1.0, 1.0, 0.0, 1.0], f64::NAN, 1.0, "pressure is NaN"),
        ([1.0, 1.0, 1.0, 0.0], 1.0, f64::NAN, "velocity is NaN"),
        ([1.0, 1.0, f64::NAN, 1.0], 1.0, 1.0, "m is NaN"),
        ([1.0, 1.0, 1.0, 1.0], f64::INFINITY, 0.0, "pressure is inf"),
        ([-1.0, 1.0, 1.0, 1.0], 1.0, 1.0, "K is -1"),
        ([1.0, 0.0, 1.0, 1.0], 1.0, 1.0, "H is 0"),
        ([1.0, 1.0, -1.0, 1.0], 1e-310, 1e300, "m is -1 and the pressure is 1e-310"),
    ] {
        let answer = one(constants, p, v);
        assert_eq!(answer.status, WL_OUT_OF_DOMAIN, "{word}");
        assert!(answer.text.contains(word), "found \"{}\", expected \"{word}\"", answer.text);
    }
}

#[test]
fn the_first_bad_point_of_many_blocks_is_named() {
    let mut pressure = vec![1e6; 5000];
    (pressure[3333], pressure[4444]) = (f64::NAN, f64::NAN);
    let answer = evaluate([1e-4, 1e9, 1.5, 1.0], 1.0, &pressure, &[1.0]);
    assert_eq!((answer.status, answer.first_bad), (WL_OUT_OF_DOMAIN, 3333));
}

#[test]
fn zero_coefficient_and_zero_time_give_exactly_zero() {
    assert_eq!(one([0.0, 1e9, 40.0, 1.0], 1e300, 1.0).increment, [0.0]);
    assert_eq!(evaluate([1.0, 1.0, 1.0, 1.0], 0.0, &[1e9], &[1.0]).increment, [0.0]);
    assert_eq!(evaluate([1.0, 1.0, 1.0, 1.0], f64::NAN, &[1e9], &[1.0]).status, WL_OUT_OF_DOMAIN);
}

#[test]
fn a_slope_beyond_doubles_stays_finite() {
    let answer = one([1.0, 1.0, 1e-3, 1.0], 1e-320, 1.0);
    assert_eq!(answer.status, WL_OK, "{}", answer.text);
    assert!(answer.slope[0].is_finite() && answer.slope[0] > 1e300, "{:e}", answer.slope[0]);
}
