//! A scene in other units is the same scene.

use wearlaw::record::Record;
use wearlaw::solve::SolveError;

use crate::draw::{Drawn, Law, Units, draw};
use crate::{Laws, case};

const ONE: Units = Units { length: 1.0, modulus: 1.0, time: 1.0 };

fn run(drawn: &Drawn, laws: &Laws) -> Option<Record<SolveError>> {
    let law = laws.of(drawn.law);
    case(drawn).try_plan(law).ok()?;
    let record = case(drawn).end(law).record;
    matches!(record.end, wearlaw::record::End::Done).then_some(record)
}

/// The scenes of the first seeds that finish in units of one.
fn finished(laws: &Laws, wanted: usize, takes: impl Fn(&Drawn) -> bool) -> Vec<(u64, Record<SolveError>)> {
    let all = (1..).filter(|seed| takes(&draw(*seed, ONE)));
    all.filter_map(|seed| run(&draw(seed, ONE), laws).map(|record| (seed, record))).take(wanted).collect()
}

#[test]
fn powers_of_two_as_units_leave_the_same_bits() {
    let laws = Laws::new();
    // p^m is rounded, and a root of two is no power of two: only m = 1 and 2 leave every digit.
    let exact = |drawn: &Drawn| !matches!(drawn.law, Law::Archard(m) if m.fract() != 0.0);
    for (seed, one) in finished(&laws, 40, exact) {
        let units = match seed % 3 {
            0 => Units { length: (-40.0_f64).exp2(), modulus: 70.0_f64.exp2(), time: 1.0 },
            1 => Units { length: 30.0_f64.exp2(), modulus: (-90.0_f64).exp2(), time: 50.0_f64.exp2() },
            _ => Units { length: 0.5, modulus: 4.0, time: (-60.0_f64).exp2() },
        };
        let drawn = draw(seed, units);
        let other = run(&drawn, &laws).unwrap_or_else(|| panic!("seed {seed} finishes in other units\n{}", drawn.text));
        let scaled = |values: &[f64], unit: f64| values.iter().map(|value| value * unit).collect::<Vec<_>>();
        assert!(other.wear == scaled(&one.wear, units.length), "wear of seed {seed}\n{}", drawn.text);
        assert!(other.pressure == scaled(&one.pressure, units.modulus), "pressure of seed {seed}\n{}", drawn.text);
        assert!(one.wear.iter().any(|wear| *wear > 0.0) || one.wear == other.wear);
        assert_eq!(other.cost.steps, one.cost.steps, "seed {seed}");
    }
}

#[test]
fn other_units_leave_volume_and_depth_to_nine_digits() {
    let laws = Laws::new();
    for (seed, one) in finished(&laws, 40, |drawn| drawn.fixed) {
        let units = match seed % 3 {
            0 => Units { length: 1e-3, modulus: 1e6, time: 3600.0 },
            1 => Units { length: 25.4, modulus: 6894.757, time: 1e-6 },
            _ => Units { length: 1e6, modulus: 1e-9, time: 0.1 },
        };
        let drawn = draw(seed, units);
        let other = run(&drawn, &laws).unwrap_or_else(|| panic!("seed {seed} finishes in other units\n{}", drawn.text));
        let center = |record: &Record<SolveError>| record.wear[center(&drawn, record.wear.len())];
        let volume = |record: &Record<SolveError>| record.wear.iter().sum::<f64>();
        for (what, a, b) in [("volume", volume(&one), volume(&other)), ("depth", center(&one), center(&other))] {
            let expected = a * units.length;
            assert!(
                (b - expected).abs() <= 1e-9 * volume(&one) * units.length,
                "{what} of seed {seed}: {b:e}, {expected:e}"
            );
            if what == "volume" {
                assert!((b - expected).abs() <= 1e-9 * expected.abs(), "{what} of seed {seed}: {b:e}, {expected:e}");
            }
        }
    }
}

/// The cell n/2.
fn center(drawn: &Drawn, cells: usize) -> usize {
    let line = drawn.text.lines().find_map(|line| line.strip_prefix("cells = ")).expect("cells");
    let counts: Vec<usize> =
        line.trim_matches(['[', ']']).split(", ").map(|count| count.parse().expect("a count")).collect();
    let place = counts[0] / 2 + counts.get(1).map_or(0, |ny| ny / 2 * counts[0]);
    place.min(cells - 1)
}
