//! The life of a law that is in memory: batches, calls, checks and what they say.

use std::sync::Arc;

use super::batch::{Batch, BatchError, Outputs};
use super::evaluation::{EvaluateError, Evaluation, Evaluator};
use super::fields::Field;
use super::handle::{LawInstance, PIECE};
use super::loader::{LoadError, Plugin};
use super::memory::InMemory;
use super::test_laws::Linear;
use super::values::{Indices, Values};

fn law(options: &str) -> LawInstance {
    let plugin = Plugin::from_entry(Arc::new(InMemory::<Linear>::new())).expect("the law is well formed");
    let law = plugin.law(None).expect("it is the only one").clone();
    drop(plugin);
    law.create(Some(options)).expect("it has no objections")
}

struct Answers {
    increment: Vec<f64>,
    direction: Vec<f64>,
    state: Vec<f64>,
    d_pressure: Vec<f64>,
}

/// Pressures 1, 2, .. with one of 1000 at `spike`; slip 0.5 everywhere; K = 2.
fn run(law: &LawInstance, points: usize, spike: Option<usize>) -> (Result<Evaluation, EvaluateError>, Answers) {
    let mut pressure: Vec<f64> = (0..points).map(|point| 1.0 + (point % 50) as f64).collect();
    if let Some(spike) = spike {
        pressure[spike] = 1000.0;
    }
    let batch = Batch::builder(law.descriptor(), points)
        .field(Field::Pressure, Values::PerPoint(&pressure))
        .field(Field::Slip, Values::Uniform(0.5))
        .field(Field::Temperature, Values::Uniform(300.0))
        .constants(&[2.0])
        .state(Values::Uniform(10.0))
        .build()
        .expect("every column fits");
    let mut answers = Answers {
        increment: vec![0.0; points],
        direction: vec![0.0; 3 * points],
        state: vec![0.0; points],
        d_pressure: vec![0.0; points],
    };
    let mut outputs = Outputs {
        direction: Some(&mut answers.direction),
        state: Some(&mut answers.state),
        d_pressure: Some(&mut answers.d_pressure),
        ..Outputs::new(&mut answers.increment)
    };
    (law.evaluate(&batch, &mut outputs), answers)
}

#[test]
fn every_item_is_written_at_every_point_whatever_the_number_of_pieces() {
    for points in [0, 1, 2, PIECE - 1, PIECE, PIECE + 1, 3 * PIECE + 7] {
        let (result, answers) = run(&law(""), points, None);
        assert_eq!(result, Ok(Evaluation::Good));
        for point in 0..points {
            assert_eq!(answers.increment[point], 1.0 + (point % 50) as f64);
            assert_eq!(answers.direction[3 * point..3 * point + 3], [0.0, 0.0, -1.0]);
            assert_eq!(answers.state[point], 10.5);
            assert_eq!(answers.d_pressure[point], 1.0);
        }
    }
}

#[test]
fn a_bad_status_names_the_point_and_what_was_given_there() {
    let spike = PIECE + 17;
    let inputs = format!("point {spike} (pressure = 1e3, slip = 5e-1, K = 2e0, distance = 1e1)");
    for (trouble, words) in [
        ("domain", format!("law `linear` cannot answer at {inputs}: pressure 1000")),
        ("failed", format!("law `linear` failed at {inputs}: pressure 1000")),
        ("unknown", format!("law `linear` answered status 77, which does not exist, at {inputs}: pressure 1000")),
        (
            "missing",
            format!(
                "law `linear` misses `temperature`, fields unknown here (bits 0x10000000000) at {inputs}: pressure 1000"
            ),
        ),
        (
            "bad cut",
            format!(
                "law `linear` asked to cut the substep by the factor 0, expected one between 0 and 1, at {inputs}: pressure 1000"
            ),
        ),
        ("nan", format!("law `linear` gave increment = NaN at {inputs}, expected a finite number")),
        ("infinite", format!("law `linear` gave increment = inf at {inputs}, expected a finite number")),
        ("negative", format!("law `linear` gave increment = -1.5e0 at {inputs}, but claims that it is never negative")),
        ("state", format!("law `linear` gave state variable `distance` = NaN at {inputs}, expected a finite number")),
        ("derivative", format!("law `linear` gave d_pressure = NaN at {inputs}, expected a finite number")),
    ] {
        let (result, _) = run(&law(trouble), 2 * PIECE, Some(spike));
        let error = result.expect_err(trouble);
        assert_eq!(error.to_string(), words);
        let json = serde_json::to_string(&error).expect("an error is JSON");
        let back: EvaluateError = serde_json::from_str(&json).expect("its own text");
        assert_eq!(back.to_string(), words);
    }
}

#[test]
fn a_direction_of_length_two_is_refused() {
    let (result, _) = run(&law("long"), 3, Some(1));
    let error = result.expect_err("its length is the root of 5");
    assert!(matches!(error, EvaluateError::DirectionLength { .. }));
    assert!(error.to_string().contains("a direction of length 2.23606797749979 at point 1"), "{error}");
}

#[test]
fn a_panic_fails_the_call_and_nothing_else() {
    let (result, _) = run(&law("panic"), 3, Some(1));
    assert!(matches!(result, Err(EvaluateError::Failed { at: Some(at), .. }) if at.point == 1));
}

#[test]
fn a_warning_or_a_cut_is_no_error() {
    let (result, answers) = run(&law("unreliable"), 2 * PIECE, Some(PIECE));
    assert!(
        matches!(result, Ok(Evaluation::Unreliable { at: Some(at), text }) if at.point == PIECE && text == "pressure 1000")
    );
    assert_eq!(answers.increment[PIECE], 1000.0);
    let (result, _) = run(&law("cut"), 2 * PIECE, Some(PIECE));
    assert!(matches!(result, Ok(Evaluation::CutStep { factor: 0.25, at: Some(at), .. }) if at.point == PIECE));
}

#[test]
fn the_shortest_of_several_cuts_counts() {
    let cut = |factor| Evaluation::CutStep { factor, at: None, text: String::new() };
    let warning = || Evaluation::Unreliable { at: None, text: String::new() };
    assert_eq!(cut(0.5).worse(cut(0.25)), cut(0.25));
    assert_eq!(cut(0.25).worse(cut(0.5)), cut(0.25));
    assert_eq!(Evaluation::Good.worse(warning()), warning());
    assert_eq!(warning().worse(cut(0.5)), cut(0.5));
    assert_eq!(cut(0.5).worse(warning()), cut(0.5));
    assert_eq!(warning().worse(Evaluation::Good), warning());
}

#[test]
fn ranges_of_a_batch_give_the_bits_of_the_whole_from_several_threads() {
    let law = law("");
    let points = 10_000;
    // Pressure and constant lie in one array of structs, the constant differs from point to point.
    let rows: Vec<f64> = (0..points).flat_map(|point| [point as f64 / 101.0, 1.0 / (1.0 + point as f64)]).collect();
    let ids: Vec<i64> = (0..points as i64).collect();
    let normals: Vec<f64> =
        (0..points).flat_map(|point| if point % 2 == 0 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }).collect();
    let state: Vec<f64> = (0..points).map(|point| point as f64).collect();
    let batch = Batch::builder(law.descriptor(), points)
        .field(Field::Pressure, Values::Strided { data: &rows, step: 2 })
        .field(Field::Slip, Values::Uniform(0.25))
        .field(Field::Normal, Values::PerPoint(&normals))
        .indices(Field::PointId, Indices::PerPoint(&ids))
        .constant_values(&[Values::Strided { data: &rows[1..], step: 2 }])
        .state(Values::PerPoint(&state))
        .build()
        .expect("every column fits");
    let fill = |cuts: &[usize]| {
        let (mut increment, mut direction, mut next) = (vec![0.0; points], vec![0.0; 3 * points], vec![0.0; points]);
        let mut rest =
            Outputs { direction: Some(&mut direction), state: Some(&mut next), ..Outputs::new(&mut increment) };
        std::thread::scope(|scope| {
            let mut start = 0;
            for &end in cuts {
                let (mut mine, others) = rest.split_at(end - start, 1);
                rest = others;
                let (range, law) = (batch.range(start..end), &law);
                scope.spawn(move || assert_eq!(law.evaluate(&range, &mut mine), Ok(Evaluation::Good)));
                start = end;
            }
        });
        (increment, direction, next)
    };
    let whole = fill(&[points]);
    assert_eq!(whole.0[7], rows[14] * rows[15] * 0.25);
    assert_eq!(whole.1[3..6], [0.0, -1.0, 0.0]);
    assert_eq!(whole.2[9], 9.25);
    assert_eq!(fill(&[1, 1, 4999, points]), whole);
    let inner = batch.range(100..200).range(5..7);
    assert_eq!((inner.first(), inner.points()), (105, 2));
    let said = inner.inputs_at(1).to_string();
    assert!(said.starts_with("point 106 (pressure = 1.049504950495049"), "{said}");
    assert!(said.contains("normal = [1.0, 0.0, 0.0], point_id = 1.06e2"), "{said}");
}

#[test]
fn a_batch_that_does_not_fit_is_refused() {
    let law = law("");
    let three = [1.0; 3];
    let build = |slip, pressure, constants: &[f64], state| {
        let builder = Batch::builder(law.descriptor(), 3).field(Field::Slip, slip).field(Field::Pressure, pressure);
        builder.constants(constants).state(state).build().map(|batch| batch.points()).map_err(|error| error.to_string())
    };
    let one = Values::Uniform(1.0);
    assert_eq!(build(one, one, &[1.0], one), Ok(3));
    let said = |words: &str| Err(words.to_owned());
    assert_eq!(build(Values::Absent, one, &[1.0], one), said("law `linear` needs `slip`, which was not given"));
    assert_eq!(build(one, one, &[1.0], Values::Absent), said("law `linear` needs `state`, which was not given"));
    assert_eq!(build(one, Values::PerPoint(&three[1..]), &[1.0], one), said("`pressure` has 2 values, expected 3"));
    assert_eq!(build(one, one, &[], one), said("0 constants were given, law `linear` declares 1"));
    assert_eq!(
        build(one, Values::UniformVector([0.0; 3]), &[1.0], one),
        said("`pressure` is a vector, expected a scalar")
    );
    let short = Values::Strided { data: &three, step: 2 };
    assert_eq!(build(one, short, &[1.0], one), said("`pressure` has 3 values, expected 5"));
    let still = Values::Strided { data: &three, step: 0 };
    assert_eq!(build(one, still, &[1.0], one), said("`pressure` has a step of 0, expected at least 1"));
    let error = Batch::builder(law.descriptor(), 3).field(Field::PointId, one).constants(&[1.0]).build().err();
    assert!(
        matches!(error, Some(BatchError::Kind { found: "column of reals", .. } | BatchError::Missing { .. })),
        "{error:?}"
    );
}

#[test]
fn outputs_that_do_not_fit_are_refused() {
    let law = law("");
    let batch = Batch::builder(law.descriptor(), 2)
        .field(Field::Pressure, Values::Uniform(1.0))
        .field(Field::Slip, Values::Uniform(1.0))
        .constants(&[1.0])
        .state(Values::Uniform(0.0))
        .build()
        .expect("every column fits");
    let said = |outputs: &mut Outputs<'_>| law.evaluate(&batch, outputs).expect_err("it does not fit").to_string();
    assert_eq!(said(&mut Outputs::new(&mut [0.0; 3])), "output `increment` of law `linear` has 3 values, expected 2");
    assert_eq!(said(&mut Outputs::new(&mut [0.0; 2])), "output `state` of law `linear` has 0 values, expected 2");
    let mut other = law.descriptor().clone();
    other.name = "other".to_owned();
    let foreign = Batch::builder(&other, 0)
        .field(Field::Pressure, Values::Uniform(1.0))
        .field(Field::Slip, Values::Uniform(1.0))
        .constants(&[1.0])
        .state(Values::Uniform(0.0))
        .build()
        .expect("every column fits");
    let error = law.evaluate(&foreign, &mut Outputs::new(&mut [])).expect_err("another law's batch");
    assert_eq!(error.to_string(), "law `linear` was given a batch that was built for law `other`");
}

#[test]
fn a_refusal_to_start_is_told_in_the_laws_own_words() {
    let plugin = Plugin::from_entry(Arc::new(InMemory::<Linear>::new())).expect("the law is well formed");
    let law = plugin.law(Some("linear")).expect("it has that name");
    let error = law.create(Some("refuse")).expect_err("it refuses");
    assert_eq!(error.to_string(), "law `linear` of `memory` refused to start (status 5): no such table");
    assert!(matches!(law.create(Some("a\0b")), Err(LoadError::OptionsNul { position: 1, .. })));
    let error = plugin.law(Some("archard")).expect_err("no such law");
    assert_eq!(error.to_string(), "`memory` holds no law `archard`, it has linear");
}
