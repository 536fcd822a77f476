use std::sync::Arc;

use wearlaw_plugin_api::abi;

use super::super::super::descriptor::LawDescriptor;
use super::super::super::evaluation::Evaluator;
use super::super::super::fields::{Claim, Field};
use super::super::super::loader::Plugin;
use super::super::super::memory::{InMemory, MemoryInputs, MemoryLaw, MemoryOutputs};
use super::super::super::test_laws::plain;
use super::super::super::values::Values;
use super::*;

/// The pressure itself, but for points with a trouble above 100; leaves those with 50 unwritten.
struct Copies(String);

impl MemoryLaw for Copies {
    fn descriptor() -> LawDescriptor {
        let claims = [Claim::NonNegative].into_iter().collect();
        LawDescriptor { reads: [Field::Pressure].into_iter().collect(), claims, ..plain("copies") }
    }

    fn create(options: Option<&str>) -> Result<Self, String> {
        Ok(Self(options.unwrap_or_default().to_owned()))
    }

    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        let mut worst = abi::WL_OK;
        for point in 0..inputs.points() {
            let pressure = inputs.scalar(Field::Pressure, point).unwrap_or(f64::NAN);
            if self.0 == "unwritten" && pressure == 50.0 {
                continue;
            }
            outputs.increment[point] = pressure;
            if pressure > 100.0 {
                match self.0.as_str() {
                    "negative" => outputs.increment[point] = -1.0,
                    "infinite" => outputs.increment[point] = f64::INFINITY,
                    "unreliable" => worst = abi::WL_UNRELIABLE,
                    "failed" => worst = abi::WL_FAILED,
                    _ => {}
                }
            }
        }
        worst
    }
}

fn law(options: &str) -> LawInstance {
    let plugin = Plugin::from_entry(Arc::new(InMemory::<Copies>::new())).expect("the law is well formed");
    plugin.laws()[0].create(Some(options)).expect("it has no objections")
}

/// Streams the answers of points `first ..` of a batch to a place that begins `shift` numbers behind a line.
fn stream(
    options: &str,
    pressure: &[f64],
    first: usize,
    shift: usize,
) -> (Result<Evaluation, EvaluateError>, Vec<f64>) {
    let law = law(options);
    let whole = Batch::builder(law.descriptor(), pressure.len())
        .field(Field::Pressure, Values::PerPoint(pressure))
        .build()
        .expect("the column fits");
    let batch = whole.range(first..pressure.len());
    let mut room = vec![7.0; batch.points() + 16];
    let start = room.as_ptr().align_offset(64) + shift;
    let place = &mut room[start..start + batch.points()];
    let answer = law.evaluate_streamed(&batch, place, &|_| {}, Guard::Around);
    let written = place.to_vec();
    assert!(room[..start].iter().chain(&room[start + batch.points()..]).all(|one| *one == 7.0), "written outside");
    (answer, written)
}

fn pressures(points: usize) -> Vec<f64> {
    (0..points).map(|point| 1.0 + (point % 50) as f64 / 3.0).collect()
}

#[test]
fn every_increment_arrives_wherever_the_answers_and_the_batch_begin() {
    for points in [1, 7, 8, 65, PIECE - 1, PIECE, PIECE + 1, 3 * PIECE + 13] {
        let pressure = pressures(points + 5);
        for (first, shift) in [(0, 0), (0, 1), (5, 6), (5, 0)] {
            let (answer, written) = stream("", &pressure, first, shift);
            assert_eq!(answer, Ok(Evaluation::Good));
            assert!(written == pressure[first..], "{points} points from {first}, {shift} behind a line");
        }
    }
}

#[test]
fn what_is_fetched_ahead_is_what_the_law_reads_next() {
    let law = law("");
    let pressure = pressures(3 * PIECE);
    let build = |values| Batch::builder(law.descriptor(), 3 * PIECE).field(Field::Pressure, values).build();
    let whole = build(Values::PerPoint(&pressure)).expect("the column fits");
    let batch = whole.range(5..3 * PIECE);
    let mut cursor = batch.cursor(0);
    cursor.at(&(0..PIECE));
    let ahead: Vec<_> = cursor.behind().collect();
    assert_eq!(ahead, [cursor.at(&(PIECE..2 * PIECE)).pressure.ptr]);
    assert_eq!(ahead, [pressure[5 + PIECE..].as_ptr()]);
    let same = build(Values::Uniform(1.0)).expect("one number fits");
    assert_eq!(same.cursor(0).behind().count(), 0, "one number for all points does not move");
}

#[test]
fn a_bad_increment_is_named_with_its_point() {
    let mut pressure = pressures(4 * PIECE);
    let spike = 3 * PIECE + 9;
    pressure[spike] = 1000.0;
    for (options, words) in [
        ("negative", format!("gave increment = -1e0 at point {spike} (pressure = 1e3), but claims")),
        ("infinite", format!("gave increment = inf at point {spike} (pressure = 1e3), expected")),
        ("failed", format!("failed at point {spike} (pressure = 1e3)")),
    ] {
        for first in [0, 2 * PIECE + 1] {
            let error = stream(options, &pressure, first, 3).0.expect_err(options).to_string();
            assert!(error.contains(&words), "{error}");
        }
    }
    let (answer, written) = stream("unreliable", &pressure, 0, 3);
    assert!(matches!(answer, Ok(Evaluation::Unreliable { at: Some(at), .. }) if at.point == spike));
    assert!(written == pressure);
}

#[test]
fn an_increment_that_the_law_does_not_write_is_no_number() {
    let mut pressure = pressures(PIECE);
    pressure[17] = 50.0;
    let error = stream("unwritten", &pressure, 0, 0).0.expect_err("it was not written");
    assert!(error.to_string().contains("increment = NaN at point 17"), "{error}");
}

#[test]
fn answers_stay_in_a_cache_that_holds_them() {
    let cache = 32 << 20;
    assert!(leaves(cache, 24_000_000, 24_000_000, 8_000_000), "one thread goes through all of it");
    assert!(!leaves(cache, 24_000_000, 12_000_000, 4_000_000), "the threads that share it find it again");
    assert!(leaves(cache, 48_000_000, 12_000_000, 4_000_000), "the whole batch does not fit");
    assert!(!leaves(cache, 9_600_000, 9_600_000, 3_200_000), "the whole batch fits");
    assert!(!leaves(cache, 480_000_000, 196_608, 65_536), "a part of it that is read at once");
    assert_eq!(
        ["32768K\n", "32M", "512", "1000000000000M", "", "K", "0K"].map(bytes_of),
        [Some(32 << 20), Some(32 << 20), Some(512), Some(1_000_000_000_000 << 20), None, None, None]
    );
    assert!(last_cache() > 0);
}

#[test]
fn what_a_batch_moves_is_its_columns_that_differ_and_an_increment() {
    let law = law("");
    let pressure = pressures(100);
    let bytes = |values| {
        let batch = Batch::builder(law.descriptor(), 100).field(Field::Pressure, values).build();
        batch.expect("it fits").range(10..20).bytes_moved()
    };
    assert_eq!(bytes(Values::PerPoint(&pressure)), 1600);
    assert_eq!(bytes(Values::Uniform(1.0)), 800);
}
