//! What the point-wise helpers do around a law: steps, optional fields, statuses, texts, instances.

#[path = "support/native.rs"]
mod native;

use std::path::PathBuf;
use std::ptr::null_mut;

use native::{Native, Numbers, column, output, view};
use wearlaw_plugin_api::abi::*;

/// The law that uses every part of the helper, in the languages that can be compiled here.
fn everything(test: &str) -> Vec<(PathBuf, Native)> {
    let mut names = vec!["everything.c", "everything.cpp"];
    if native::fortran(test) {
        names.push("everything.f90");
    }
    names.into_iter().map(|name| (native::data(name), native::build(&native::data(name)))).collect()
}

/// How the columns of a call are laid out.
#[derive(Clone, Copy)]
struct Layout {
    scalar: i64,
    vector: i64,
    constant: i64,
    optional: bool,
}

/// Inputs of the law `everything`, and its answers.
struct Case {
    values: Vec<f64>,
    states: Vec<i64>,
    start: Vec<f64>,
}

#[derive(PartialEq, Debug)]
struct Answer {
    status: i32,
    increment: Vec<f64>,
    slope: Vec<f64>,
    direction: Vec<f64>,
    end: Vec<f64>,
}

impl Case {
    fn new(points: usize) -> Self {
        Self {
            values: Numbers(3).take(8 * points + 64).collect(),
            states: (0..points as i64).map(|i| i % 3).collect(),
            start: Numbers(5).take(2 * points).collect(),
        }
    }

    /// Evaluates points `from..to` under a layout; `ask` are the output bits wanted.
    fn run(&self, law: &Native, from: usize, to: usize, how: Layout, ask: i64) -> Answer {
        let n = to - from;
        let at = |step: i64, offset: usize| Column { ptr: self.values[offset + from * step as usize..].as_ptr(), step };
        let constants = [at(how.constant, 1)];
        let inputs = [at(how.scalar, 2), at(0, 3)];
        let mut v = view(n, 0.5);
        v.absolute_zero = -273.15;
        v.constants = constants.as_ptr();
        v.constant_count = 1;
        v.inputs = inputs.as_ptr();
        v.input_count = 2;
        v.state = column(&self.start[2 * from..], 2);
        v.state_count = 2;
        v.pressure = at(how.scalar, 0);
        v.normal = at(how.vector, 4);
        v.slip_vector = at(how.vector, 5);
        v.contact_state = IndexColumn { ptr: self.states[from..].as_ptr(), step: 1 };
        if how.optional {
            v.temperature = at(how.scalar, 6);
            v.tangent = at(how.vector, 7);
            v.point_id = IndexColumn { ptr: self.states.as_ptr(), step: 0 };
        }
        let mut answer = Answer {
            status: 0,
            increment: vec![f64::NAN; n],
            slope: vec![7.0; n],
            direction: vec![7.0; 3 * n],
            end: vec![7.0; 2 * n],
        };
        let mut statuses = vec![0; n];
        let mut o = output(&mut answer.increment);
        o.state = answer.end.as_mut_ptr();
        if ask & WL_OUT_D_PRESSURE != 0 {
            o.d_pressure = answer.slope.as_mut_ptr();
        }
        if ask & WL_OUT_DIRECTION != 0 {
            o.direction = answer.direction.as_mut_ptr();
        }
        if ask & WL_OUT_STATUS != 0 {
            o.status = statuses.as_mut_ptr();
        }
        answer.status = law.call(null_mut(), &v, &mut o);
        answer
    }
}

const ALL: i64 = WL_OUT_D_PRESSURE | WL_OUT_DIRECTION;

#[test]
fn every_language_gives_the_same_bits_at_every_step_and_batch() {
    let laws = everything("every_language_gives_the_same_bits_at_every_step_and_batch");
    let n = 700;
    let case = Case::new(n);
    for (scalar, vector, constant, optional) in
        [(1, 3, 0, true), (1, 3, 0, false), (0, 0, 0, true), (4, 5, 0, true), (2, 3, 1, false), (0, 3, 2, true)]
    {
        let how = Layout { scalar, vector, constant, optional };
        let right = case.run(&laws[0].1, 0, n, how, ALL);
        assert_eq!(right.status, WL_OK);
        // By hand, at one point of the case.
        let i = 400;
        let x = |step: i64, offset: usize| case.values[offset + i * step as usize];
        let scale = if optional { x(scalar, 6) - -273.15 } else { 3.0 };
        let slip = x(vector, 5) + 2.0 * x(vector, 6) + 3.0 * x(vector, 7);
        let slope = x(constant, 1) * slip * x(scalar, 2) * x(0, 3) * scale;
        let slope = if case.states[i] == WL_OPEN { 0.0 } else { slope };
        assert_eq!(right.slope[i], slope);
        assert_eq!(right.increment[i], slope * x(scalar, 0));
        assert_eq!(right.end[2 * i], case.start[2 * i] + right.increment[i]);
        assert_eq!(right.end[2 * i + 1], case.start[2 * i + 1] + 1.0);
        let direction = if optional { [9, 7, 8].map(|k| x(vector, k)) } else { [4, 5, 6].map(|k| -x(vector, k)) };
        assert_eq!(right.direction[3 * i..3 * i + 3], direction);
        for (source, law) in &laws {
            assert!(case.run(law, 0, n, how, ALL) == right, "{}: other bits", source.display());
            assert!(case.run(law, 0, n, how, ALL | WL_OUT_STATUS) == right, "{}: with statuses", source.display());
            let fewer = case.run(law, 0, n, how, 0);
            assert!(fewer.increment == right.increment, "{}: increments alone", source.display());
            assert!(fewer.slope.iter().chain(&fewer.direction).all(|x| *x == 7.0), "wrote what was not asked");
            for (from, to) in [(0, 1), (3, 4), (100, 355), (10, 266), (200, 457), (699, 700)] {
                let part = case.run(law, from, to, how, ALL);
                assert!(part.increment == right.increment[from..to], "{}: {from}..{to}", source.display());
                assert!(part.direction == right.direction[3 * from..3 * to], "{}: {from}..{to}", source.display());
                assert!(part.end == right.end[2 * from..2 * to], "{}: {from}..{to}", source.display());
            }
        }
    }
}

#[test]
fn every_language_describes_itself_alike() {
    let laws = everything("every_language_describes_itself_alike");
    for (source, native) in &laws {
        let law = &native.law;
        let name = source.display();
        assert_eq!(native::text(&law.version), "1.2.3", "{name}");
        assert_eq!(native::text(&law.source), "none", "{name}");
        let reads = WL_FIELD_PRESSURE | WL_FIELD_NORMAL | WL_FIELD_CONTACT_STATE | WL_FIELD_SLIP_VECTOR;
        assert_eq!(law.reads, reads, "{name}");
        assert_eq!(law.uses, WL_FIELD_TEMPERATURE | WL_FIELD_TANGENT | WL_FIELD_POINT_ID, "{name}");
        assert_eq!(law.writes, WL_OUTS_KNOWN, "{name}");
        assert_eq!(law.flags, WL_FLAG_OPEN_POINTS, "{name}");
        assert_eq!((law.pressure_degree, law.pressure_degree_constant), (1.0, -1), "{name}");
        assert_eq!(native.names(WL_KIND_CONSTANT), ["k"], "{name}");
        assert_eq!(native.names(WL_KIND_STATE), ["total", "calls"], "{name}");
        assert_eq!(native.names(WL_KIND_INPUT), ["film", "humidity"], "{name}");
        let k = native.quantity(WL_KIND_CONSTANT, 0).expect("a constant");
        assert_eq!((k.metre, k.kilogram, k.second, k.kelvin), (1.0, -1.0, 2.0, 0.0), "{name}");
        assert_eq!((k.minimum, k.maximum, k.flags), (0.0, 1.0, 0), "{name}");
        assert!(k.default_value.is_nan(), "{name}");
        let film = native.quantity(WL_KIND_INPUT, 0).expect("an input");
        assert_eq!((film.default_value, film.flags), (2.0, WL_QUANTITY_ABOVE_MINIMUM), "{name}");
        assert_eq!(film.maximum, f64::INFINITY, "{name}");
        for bit in 0..63 {
            let declared = (law.reads | law.uses) >> bit & 1 == 1;
            assert_eq!(native.quantity(WL_KIND_FIELD, bit).is_some(), declared, "{name}: bit {bit}");
        }
        let field = native.quantity(WL_KIND_FIELD, 17).expect("a field");
        assert_eq!(native::text(&field.name), "contact_state", "{name}");
    }
}

#[test]
fn the_worst_status_names_its_first_point_with_text_and_factor() {
    for (source, law) in everything("the_worst_status_names_its_first_point_with_text_and_factor") {
        for (bad, status, first, factor, said) in [
            (vec![(3, 9.5e7)], WL_UNRELIABLE, 3, 0.0, ""),
            (vec![(2, 9.5e7), (5, 2e8), (6, 3e8)], WL_CUT_STEP, 5, 0.25, "point 41"),
            (vec![(4, 2e8), (7, -2.0)], WL_FAILED, 7, 0.25, ""),
        ] {
            let mut pressure = vec![1.0; 300];
            for (i, p) in &bad {
                pressure[*i] = *p;
            }
            let (vector, one, start, states) = (vec![1.0; 3], [1.0], vec![0.0; 600], [WL_SLIDING]);
            let constants = [column(&one, 0), column(&one, 0)];
            let mut v = view(300, 1.0);
            v.constants = constants.as_ptr();
            v.constant_count = 1;
            v.inputs = constants.as_ptr();
            v.input_count = 2;
            v.state = column(&start, 2);
            v.state_count = 2;
            v.pressure = column(&pressure, 1);
            v.normal = column(&vector, 0);
            v.slip_vector = column(&vector, 0);
            v.contact_state = IndexColumn { ptr: states.as_ptr(), step: 0 };
            let ids = [41];
            v.point_id = IndexColumn { ptr: ids.as_ptr(), step: 0 };
            let (mut increment, mut direction, mut end) = (vec![0.0; 300], vec![0.0; 900], vec![0.0; 600]);
            for ask in [false, true] {
                let (mut text, mut statuses) = ([1; 40], vec![-9; 300]);
                let mut o = output(&mut increment);
                o.direction = direction.as_mut_ptr();
                o.state = end.as_mut_ptr();
                o.text = text.as_mut_ptr();
                o.text_size = 40;
                o.status = if ask { statuses.as_mut_ptr() } else { null_mut() };
                let name = source.display();
                assert_eq!(law.call(null_mut(), &v, &mut o), status, "{name}");
                assert_eq!((o.first_bad, o.dt_factor), (first, factor), "{name}");
                assert_eq!(native::text(&text).trim_end(), said, "{name}");
                if ask {
                    let ok = statuses.iter().filter(|s| **s == WL_OK).count();
                    assert_eq!((ok, statuses[first as usize]), (300 - bad.len(), status), "{name}");
                }
            }
            v.normal.ptr = std::ptr::null();
            v.contact_state.ptr = std::ptr::null();
            let mut text = [1; 40];
            let mut o = output(&mut increment);
            o.state = end.as_mut_ptr();
            o.text = text.as_mut_ptr();
            o.text_size = 40;
            assert_eq!(law.call(null_mut(), &v, &mut o), WL_MISSING_INPUT, "{}", source.display());
            assert_eq!(o.missing, WL_FIELD_NORMAL | WL_FIELD_CONTACT_STATE, "{}", source.display());
            assert_eq!(native::text(&text), "not given: normal", "{}", source.display());
        }
    }
}

#[test]
fn an_exception_becomes_a_failure_with_its_text() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("law.so");
    native::try_compile(&native::data("everything.cpp"), &native::include(), &out, &[]).expect("it compiles");
    let law = Native::open(&out, 1);
    assert_eq!(native::text(&law.law.name), "thrower");
    let refused = law.create(c"!").expect_err("its constructor throws");
    assert_eq!(refused, (WL_FAILED, "the table has no row".to_owned()));
    let instance = law.create(c"5").expect("these options are right");
    for (slip, status, first) in [([1.0, 2.0, 3.0], WL_OK, -1), ([1.0, 9.0, 3.0], WL_FAILED, 1)] {
        let mut v = view(3, 1.0);
        v.slip = column(&slip, 1);
        let (mut increment, mut text) = ([0.0; 3], [1; 40]);
        let mut o = output(&mut increment);
        o.text = text.as_mut_ptr();
        o.text_size = 40;
        assert_eq!(law.call(instance, &v, &mut o), status);
        assert_eq!(o.first_bad, first);
        if status == WL_FAILED {
            assert_eq!(native::text(&text), "the table has no row");
        }
        assert_eq!(increment[2], 3.0);
    }
    law.destroy(instance);
}
