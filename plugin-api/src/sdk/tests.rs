#![allow(unsafe_code)] // the tests stand where a host stands
//! A law written for one point, called the way a host calls it.

use core::ffi::{CStr, c_void};
use core::mem::{offset_of, size_of};
use core::ptr::null;

use super::export::{Exporter, entry, fill};
use super::prelude::*;
use crate::abi;

/// k p s plus a tenth of the state; refuses pressures above 100, panics at 1000.
struct Sample;

impl About for Sample {
    const NAME: &'static str = "sample";
    const VERSION: &'static str = "1.2.3";
    const SUMMARY: &'static str = "for tests";
    const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_SLIP;
    const USES: i64 = WL_FIELD_TEMPERATURE;
    const CONSTANTS: &'static [Quantity] = &[Quantity::new("k", Unit::PER_PASCAL).at_least(0.0)];
    const STATE: &'static [Quantity] = &[Quantity::new("memory", Unit::METRE)];
    fn create(options: Option<&str>) -> Result<Self, String> {
        match options {
            Some("refuse") => Err("told to refuse".to_owned()),
            _ => Ok(Sample),
        }
    }
}

const EXPORTER: Exporter = Exporter { version: "9.8.7", description: "a crate of laws" };

impl PointLaw for Sample {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        assert!(at.pressure != 1000.0, "a thousand is too much");
        let ([k], [memory]) = (at.constants(), at.state());
        out.increment = k * at.pressure * at.slip + 0.1 * memory;
        out.state[0] = memory + at.slip;
        out.text = "pressure over 100";
        if at.pressure > 100.0 { Status::OutOfDomain } else { Status::Ok }
    }
}

struct Call {
    view: View,
    output: Output,
    text: [core::ffi::c_char; 64],
}

fn column(values: &[f64], step: i64) -> abi::Column {
    abi::Column { ptr: values.as_ptr(), step }
}

fn evaluate(pressure: &[f64], step: i64, edit: impl FnOnce(&mut View, &mut Output)) -> (i32, Vec<f64>, Vec<f64>, Call) {
    evaluate_law::<Sample>(pressure, step, edit)
}

fn evaluate_law<T: Law>(
    pressure: &[f64],
    step: i64,
    edit: impl FnOnce(&mut View, &mut Output),
) -> (i32, Vec<f64>, Vec<f64>, Call) {
    let points = if step == 0 { 5 } else { pressure.len() / step as usize };
    let constants = [column(&[2.0], 0)];
    let (slip, state) = ([3.0], vec![10.0; points]);
    let (mut increment, mut end) = (vec![-1.0; points], vec![-1.0; points]);
    // SAFETY: all-zero bytes are a valid view, output and table: numbers, NULL pointers and absent functions.
    let (view, output, mut table): (View, Output, LawTable) = unsafe { core::mem::zeroed() };
    let mut call = Call { view, output, text: [0; 64] };
    call.view.struct_size = size_of::<View>() as i64;
    call.view.points = points as i64;
    call.view.dt = 1.0;
    (call.view.pressure, call.view.slip) = (column(pressure, step), column(&slip, 0));
    (call.view.constants, call.view.constant_count) = (constants.as_ptr(), 1);
    (call.view.state, call.view.state_count) = (column(&state, 1), 1);
    call.output.struct_size = size_of::<Output>() as i64;
    (call.output.increment, call.output.state) = (increment.as_mut_ptr(), end.as_mut_ptr());
    (call.output.text, call.output.text_size) = (call.text.as_mut_ptr(), 64);
    edit(&mut call.view, &mut call.output);
    fill::<T>(&mut table);
    let mut instance: *mut c_void = core::ptr::null_mut();
    // SAFETY: every pointer above outlives the calls, and the instance is destroyed once.
    let status = unsafe {
        let create = table.create.expect("laws are created");
        assert_eq!(create(null(), null(), &mut instance, core::ptr::null_mut(), 0), WL_OK);
        let status = table.evaluate.expect("laws evaluate")(instance, &call.view, &mut call.output);
        table.destroy.expect("laws are destroyed")(instance);
        status
    };
    (status, increment, end, call)
}

fn words(call: &Call) -> String {
    call.text.iter().take_while(|c| **c != 0).map(|c| *c as u8 as char).collect()
}

#[test]
fn a_batch_is_its_points() {
    let pressure: Vec<f64> = (0..200).map(|i| i as f64 / 2.0).collect();
    let (status, increment, end, _) = evaluate(&pressure, 1, |_, _| ());
    assert_eq!(status, WL_OK);
    for (p, w) in pressure.iter().zip(&increment) {
        assert_eq!(*w, 2.0 * p * 3.0 + 1.0);
    }
    assert!(end.iter().all(|s| *s == 13.0));
}

#[test]
fn strided_and_uniform_columns_give_the_same() {
    let spread: Vec<f64> = (0..300).map(|i| if i % 3 == 0 { f64::from(i) / 3.0 } else { f64::NAN }).collect();
    let (status, increment, ..) = evaluate(&spread, 3, |_, _| ());
    assert_eq!((status, increment.len()), (WL_OK, 100));
    assert!(increment.iter().enumerate().all(|(i, w)| *w == 6.0 * i as f64 + 1.0));
    let (status, increment, ..) = evaluate(&[7.0], 0, |_, _| ());
    assert_eq!((status, increment), (WL_OK, vec![43.0; 5]));
}

#[test]
fn the_first_bad_point_is_named_and_the_others_are_there() {
    let mut pressure = vec![1.0; 150];
    (pressure[77], pressure[140]) = (101.0, 102.0);
    let mut every = vec![-1; 150];
    let at = every.as_mut_ptr();
    let (status, _, _, call) = evaluate(&pressure, 1, |_, output| output.status = at);
    assert_eq!((status, call.output.first_bad), (WL_OUT_OF_DOMAIN, 77));
    assert_eq!(words(&call), "pressure over 100");
    assert_eq!(every.iter().filter(|s| **s == WL_OK).count(), 148);
    assert_eq!((every[77], every[140]), (WL_OUT_OF_DOMAIN, WL_OUT_OF_DOMAIN));
}

#[test]
fn a_missing_field_is_named_by_its_bit() {
    let (status, _, _, call) = evaluate(&[1.0], 1, |view, _| view.slip = abi::Column { ptr: null(), step: 0 });
    assert_eq!((status, call.output.missing), (WL_MISSING_INPUT, WL_FIELD_SLIP));
}

#[test]
fn a_view_that_ends_early_lacks_its_tail() {
    let (status, _, _, call) = evaluate(&[1.0], 1, |view, _| view.struct_size = offset_of!(View, slip) as i64);
    assert_eq!((status, call.output.missing), (WL_MISSING_INPUT, WL_FIELD_SLIP));
    let (status, increment, ..) =
        evaluate(&[1.0], 1, |view, _| view.struct_size = offset_of!(View, slip_vector) as i64);
    assert_eq!((status, increment), (WL_OK, vec![7.0]));
}

#[test]
fn a_panic_stays_inside_and_says_why() {
    let (status, _, _, call) = evaluate(&[1000.0], 1, |_, _| ());
    assert_eq!(status, WL_FAILED);
    assert!(words(&call).contains("a thousand is too much"), "{}", words(&call));
}

#[test]
fn an_empty_batch_is_fine() {
    let (status, increment, ..) = evaluate(&[], 1, |_, _| ());
    assert_eq!((status, increment), (WL_OK, vec![]));
}

/// k p s, against the normal; refuses pressures above 100, panics at 1000.
struct Stateless;

impl About for Stateless {
    const NAME: &'static str = "stateless";
    const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_SLIP;
    const USES: i64 = WL_FIELD_SLIP_VECTOR;
    const CONSTANTS: &'static [Quantity] = &[Quantity::new("k", Unit::PER_PASCAL).at_least(0.0)];
    const INSTANCE: Option<Self> = Some(Stateless);
}

impl PointLaw for Stateless {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        assert!(at.pressure != 1000.0, "a thousand is too much");
        let [k] = at.constants();
        let more = if at.slip_vector[1].is_nan() { 0.0 } else { at.slip_vector[1] };
        out.increment = k * at.pressure * at.slip + more;
        out.text = "pressure over 100";
        if at.pressure > 100.0 { Status::OutOfDomain } else { Status::Ok }
    }
}

/// Calls for the increments alone, or for statuses too, with slips of 0.25, 0.5 ..
fn stateless(pressure: &[f64], alone: bool, edit: impl FnOnce(&mut View)) -> (i32, Vec<f64>, i64, String) {
    let slip: Vec<f64> = (1..=pressure.len()).map(|i| i as f64 / 4.0).collect();
    let mut every = vec![-1; pressure.len()];
    let at = every.as_mut_ptr();
    let (status, increment, _, call) = evaluate_law::<Stateless>(pressure, 1, |view, output| {
        view.slip = column(&slip, 1);
        output.state = core::ptr::null_mut();
        output.first_bad = -1;
        if !alone {
            output.status = at;
        }
        edit(view);
    });
    (status, increment, call.output.first_bad, words(&call))
}

#[test]
fn increments_alone_are_those_of_any_call() {
    let factors: Vec<f64> = (0..150).map(|i| 1.0 + f64::from(i)).collect();
    let factor = [column(&factors, 1)];
    let vectors: Vec<f64> = (0..450).map(f64::from).collect();
    for points in [0, 1, 2, 63, 65, 150] {
        let pressure: Vec<f64> = (0..points).map(|i| i as f64 / 3.0).collect();
        let right: Vec<f64> = pressure.iter().enumerate().map(|(i, p)| 2.0 * p * ((i + 1) as f64 / 4.0)).collect();
        assert_eq!(stateless(&pressure, true, |_| ()), (WL_OK, right, -1, String::new()));
        type Edit<'a> = &'a dyn Fn(&mut View);
        let edits: [Edit<'_>; 4] =
            [&|_| (), &|view| view.slip = column(&[0.5], 0), &|view| view.constants = factor.as_ptr(), &|view| {
                view.slip_vector = column(&vectors, 3)
            }];
        for edit in edits {
            assert_eq!(stateless(&pressure, true, edit), stateless(&pressure, false, edit));
        }
    }
}

#[test]
fn what_is_wrong_with_increments_alone_is_told_as_ever() {
    let mut pressure = vec![1.0; 90];
    pressure[77] = 101.0;
    let (status, increment, first_bad, said) = stateless(&pressure, true, |_| ());
    assert_eq!((status, first_bad, said.as_str()), (WL_OUT_OF_DOMAIN, 77, "pressure over 100"));
    assert_eq!(increment[89], 45.0);
    pressure[77] = 1000.0;
    let (status, _, _, said) = stateless(&pressure, true, |_| ());
    assert!(status == WL_FAILED && said.contains("a thousand is too much"), "{said}");
    let absent = |view: &mut View| view.slip = abi::Column { ptr: null(), step: 0 };
    assert_eq!(stateless(&pressure, true, absent).0, WL_MISSING_INPUT);
    assert_eq!(stateless(&pressure, true, |view| view.constant_count = 0).0, WL_MISSING_INPUT);
}

#[test]
fn the_entry_counts_its_laws_and_refuses_short_tables() {
    // SAFETY: all-zero bytes are a valid table; the size given is the struct's own.
    unsafe {
        let mut table: LawTable = core::mem::zeroed();
        table.struct_size = size_of::<LawTable>() as i64;
        assert_eq!(entry(&[fill::<Sample>], EXPORTER, 0, null(), &mut table), WL_OK);
        assert_eq!(table.struct_size, size_of::<LawTable>() as i64);
        assert_eq!(entry(&[fill::<Sample>], EXPORTER, 1, null(), &mut table), WL_NO_MORE);
        table.struct_size -= 8;
        assert_eq!(entry(&[fill::<Sample>], EXPORTER, 0, null(), &mut table), WL_FAILED);
    }
}

#[test]
fn a_refused_create_says_why() {
    // SAFETY: all-zero bytes are a valid table.
    let mut table: LawTable = unsafe { core::mem::zeroed() };
    fill::<Sample>(&mut table);
    let (mut instance, mut text) = (core::ptr::null_mut(), [0; 16]);
    // SAFETY: the options end in NUL and the text has the size that is told.
    let status = unsafe {
        table.create.expect("laws are created")(null(), c"refuse".as_ptr(), &mut instance, text.as_mut_ptr(), 16)
    };
    let said: String = text.iter().take_while(|c| **c != 0).map(|c| *c as u8 as char).collect();
    assert_eq!((status, said.as_str()), (WL_FAILED, "told to refuse"));
    assert!(instance.is_null());
}

/// A law that says no more of itself than it must.
struct Terse;

impl About for Terse {
    const NAME: &'static str = "terse";
    const READS: i64 = WL_FIELD_SLIP;
    const KNOWN_VALUES: Option<&'static CStr> = Some(c"slip,increment\n1,0\n");
    const INSTANCE: Option<Self> = Some(Terse);
}

impl PointLaw for Terse {
    fn point(&self, _at: &Point, _out: &mut PointAnswer) -> Status {
        Status::Ok
    }
}

#[test]
fn what_a_law_does_not_say_is_its_crates() {
    let said = |fill| {
        // SAFETY: all-zero bytes are a valid table; the entry is told its true size.
        let table = unsafe {
            let mut table: LawTable = core::mem::zeroed();
            table.struct_size = size_of::<LawTable>() as i64;
            assert_eq!(entry(&[fill], EXPORTER, 0, null(), &mut table), WL_OK);
            table
        };
        let text = |chars: &[core::ffi::c_char]| -> String {
            chars.iter().take_while(|c| **c != 0).map(|c| *c as u8 as char).collect()
        };
        [text(&table.version), text(&table.summary)]
    };
    assert_eq!(said(fill::<Terse>), ["9.8.7", "a crate of laws"]);
    assert_eq!(said(fill::<Sample>), ["1.2.3", "for tests"]);
}

#[test]
fn known_values_are_an_extension_and_nothing_else_is() {
    let function = |fill: fn(&mut LawTable)| {
        // SAFETY: all-zero bytes are a valid table.
        let mut table: LawTable = unsafe { core::mem::zeroed() };
        fill(&mut table);
        table.extension
    };
    assert!(function(fill::<Sample>).is_none());
    let extension = function(fill::<Terse>).expect("it has known values");
    // SAFETY: names of extensions are NULL or end in NUL.
    let ask = |id: *const core::ffi::c_char| unsafe { extension(id) };
    let found = ask(c"wearlaw.selftest/1".as_ptr());
    assert!(!found.is_null());
    // SAFETY: this extension is a text closed by NUL.
    assert_eq!(unsafe { CStr::from_ptr(found.cast()) }, c"slip,increment\n1,0\n");
    assert!(ask(null()).is_null() && ask(c"wearlaw.selftest/2".as_ptr()).is_null() && ask(c"".as_ptr()).is_null());
}

#[test]
fn a_law_without_options_refuses_them() {
    assert!(Terse::create(None).is_ok() && Terse::create(Some("")).is_ok());
    let refusal = Terse::create(Some("fast")).err();
    assert_eq!(refusal.as_deref(), Some("found options \"fast\", expected none: terse has no options"));
}
