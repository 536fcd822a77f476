//! The derivative with respect to the pressure, against differences of the increment, and where it jumps.

use super::super::harness::call::{Asked, Layout};
use super::super::harness::points::{Case, number_text};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, Differences, POINTS, ask, still_good};
use wearlaw_law::{Field, Flag, OutputItem};

/// Good points of a law that writes the derivative.
fn good(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>) -> Judged<Case> {
    if !law.writes(OutputItem::DPressure) {
        return skip("missing: the law writes no derivative, so hosts use a difference quotient");
    }
    bench.good(law, instance, POINTS)
}

/// Increment and derivative of one point at another pressure; none if the law refuses it.
fn at_pressure(law: &Law<'_>, instance: &Instance<'_>, case: &Case, pressure: f64) -> Option<(f64, f64)> {
    let case = case.map(|point| point.set(Field::Pressure, 0, pressure));
    let answers = ask(&law.about, instance, &case, &Layout::plain(&law.about));
    answers.is_good().then(|| (answers.increment[0], answers.d_pressure[0]))
}

/// A derivative from differences, and an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Estimate {
    value: f64,
    error: f64,
}

/// Central differences with steps that shrink by 1.4, extrapolated to step 0 (Ridders, Adv. Eng. Software 4 (1982)
/// 75-76); the error is the change by the last extrapolation plus what the values' own noise and rounding do.
fn ridders(function: impl Fn(f64) -> Option<f64>, at: f64, first: f64) -> Option<Estimate> {
    const SHRINK: f64 = 1.4;
    let noise = [7.0, 50.0, 400.0].into_iter().map(|part| noise(&function, at, first / part));
    let noise = noise.collect::<Option<Vec<f64>>>()?.into_iter().fold(0.0, f64::max);
    let mut best: Option<Estimate> = None;
    let mut last: Vec<f64> = Vec::new();
    let mut step = first;
    for _ in 0..12 {
        let (high, low) = (function(at + step)?, function(at - step)?);
        let rounding = (f64::EPSILON * (high.abs() + low.abs()) + 2.0 * noise) / step;
        let mut row = vec![(high - low) / (2.0 * step)];
        let mut factor = SHRINK * SHRINK;
        for column in 0..last.len() {
            let value = (row[column] * factor - last[column]) / (factor - 1.0);
            let error = (value - row[column]).abs().max((value - last[column]).abs()) + rounding;
            if best.is_none_or(|best| error < best.error) {
                best = Some(Estimate { value, error });
            }
            row.push(value);
            factor *= SHRINK * SHRINK;
        }
        last = row;
        step /= SHRINK;
    }
    best
}

/// What is not smooth in a function around a place: its sixth difference over steps of that length, which is next to
/// nothing for smooth ones, over what it makes of independent errors of size 1 (Hamming, Introduction to Applied
/// Numerical Analysis, 1971, ch. 6).
fn noise(function: &impl Fn(f64) -> Option<f64>, at: f64, step: f64) -> Option<f64> {
    const SIXTH: [f64; 7] = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];
    let mut difference = 0.0;
    for (place, factor) in (-3..=3).zip(SIXTH) {
        difference += factor * function(at + f64::from(place) * step)?;
    }
    let size = SIXTH.iter().map(|factor| factor * factor).sum::<f64>().sqrt();
    Some(difference.abs() / size)
}

/// Relative difference that a derivative may have from a good estimate.
const TOLERANCE: f64 = 1e-6;
/// An estimate with a larger relative error says nothing.
const VAGUE: f64 = 1e-3;
/// One with a smaller relative error is enough for a slope to be right, if it agrees at one scale: a table may look smooth
/// from afar and have another slope in each of its pieces.
const SHARP: f64 = 1e-5;
/// Largest steps of the estimates, over the pressure.
const SCALES: [f64; 7] = [0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];

/// Over the ordinary pressures of the points, others that are tried: a law may go another way far from them, and below 0.
const OTHERS: [f64; 8] = [1e-3, 30.0, -1.0, 1e3, 0.03, -1e-3, 1e-5, 1e5];

/// What differences say of the slope at one pressure.
enum Compared {
    /// Nothing: they are too vague, or the law refuses its values there.
    Nothing,
    /// It is right, and what it is.
    Right(f64),
    /// It is wrong: what it is, and the best estimate.
    Wrong(f64, Estimate),
}

/// Holds the slope of a point at a pressure to differences of the increment.
fn compared(law: &Law<'_>, instance: &Instance<'_>, single: &Case, pressure: f64) -> Compared {
    let Some((increment, slope)) = at_pressure(law, instance, single, pressure) else { return Compared::Nothing };
    let increment_at = |p: f64| at_pressure(law, instance, single, p).map(|(increment, _)| increment);
    let size = pressure.abs();
    let estimates = SCALES.into_iter().filter_map(|part| ridders(increment_at, pressure, part * size));
    let mut estimates: Vec<Estimate> = estimates.collect();
    estimates.sort_by(|a, b| a.error.total_cmp(&b.error));
    let Some(estimate) = estimates.first() else { return Compared::Nothing };
    // What does not matter beside the increment itself is rounding, and so is what comes near the smallest numbers.
    let least = (1e-9 * increment.abs()).max(1e9 * f64::MIN_POSITIVE) / size;
    let within = |estimate: &Estimate, part: f64| estimate.error <= part * estimate.value.abs().max(least);
    if !within(estimate, VAGUE) {
        return Compared::Nothing;
    }
    let agrees = |estimate: &Estimate| {
        let allowed = 20.0 * estimate.error + TOLERANCE * slope.abs().max(estimate.value.abs()) + least;
        (slope - estimate.value).abs() <= allowed
    };
    if agrees(estimate) || estimates.iter().any(|estimate| within(estimate, SHARP) && agrees(estimate)) {
        return Compared::Right(slope);
    }
    Compared::Wrong(slope, *estimate)
}

/// The derivative at good points against differences: at their own pressures, and far from them.
pub(super) fn pressure(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = good(bench, law, instance)?;
        let (mut count, mut zero) = (0, true);
        let (mut first_wrong, mut below): (Option<Finding>, Option<Finding>) = (None, None);
        for index in 0..case.count {
            let single = case.single(index);
            let ordinary = single.point(0).scalar(Field::Pressure);
            let others = [OTHERS[2 * index % OTHERS.len()], OTHERS[(2 * index + 1) % OTHERS.len()]];
            for factor in std::iter::once(1.0).chain(others).take_while(|_| bench.has_time()) {
                let pressure = factor * ordinary;
                match compared(law, instance, &single, pressure) {
                    Compared::Nothing => {}
                    Compared::Right(slope) => (count, zero) = (count + 1, zero && slope == 0.0),
                    // No contact has one, so a solver that asks there only finds its way back more slowly.
                    Compared::Wrong(slope, estimate) if pressure < 0.0 => {
                        below.get_or_insert_with(|| wrong(law, &single, pressure, slope, &estimate));
                    }
                    Compared::Wrong(slope, estimate) => {
                        count += 1;
                        zero &= slope == 0.0;
                        first_wrong.get_or_insert_with(|| wrong(law, &single, pressure, slope, &estimate));
                    }
                }
            }
        }
        match (first_wrong, below) {
            (Some(mut finding), _) => {
                if zero {
                    finding.what =
                        "the derivative with respect to the pressure is missing: it is 0 everywhere".to_owned();
                }
                broken(finding)
            }
            (None, Some(mut finding)) => {
                finding.what = "the derivative is wrong at negative pressures".to_owned();
                Ok(Verdict::Warn(finding))
            }
            (None, None) if count == 0 => skip("no point where differences of the increment tell a derivative"),
            (None, None) => Ok(Verdict::Pass(Some(format!("{count} points compared")))),
        }
    })
}

fn wrong(law: &Law<'_>, single: &Case, pressure: f64, slope: f64, estimate: &Estimate) -> Finding {
    let there = single.map(|point| point.set(Field::Pressure, 0, pressure));
    let (value, error) = (number_text(estimate.value), estimate.error);
    let expected = format!("d_pressure {value} +- {error:.0e}, from differences of the increment");
    let finding = Finding::new("the derivative with respect to the pressure is wrong");
    finding.with(format!("d_pressure {}", number_text(slope)), expected).at(there.named(&law.about, 0))
}

/// Pressures between which jumps are looked for, Pa: more than any contact has, and how many.
const LOWEST: f64 = 1e4;
const HIGHEST: f64 = 1e11;
const GRID: usize = 300;

/// A jump of the derivative.
struct Jump {
    pressure: f64,
    before: f64,
    after: f64,
}

/// Looks along one point's pressure for a jump that stays when the interval shrinks.
fn jump(law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> Option<Jump> {
    let slope = |pressure: f64| at_pressure(law, instance, case, pressure).map(|(_, slope)| slope);
    let grid = (0..=GRID).map(|index| LOWEST * (HIGHEST / LOWEST).powf(index as f64 / GRID as f64));
    let known: Vec<(f64, f64)> = grid.filter_map(|p| slope(p).filter(|s| s.is_finite()).map(|s| (p, s))).collect();
    let change = |a: f64, b: f64| (a - b).abs() / a.abs().max(b.abs()).max(f64::MIN_POSITIVE);
    let mut pairs: Vec<_> =
        known.windows(2).map(|pair| (pair[0], pair[1])).filter(|(a, b)| change(a.1, b.1) > 1e-4).collect();
    pairs.sort_by(|a, b| change(b.0.1, b.1.1).total_cmp(&change(a.0.1, a.1.1)));
    'pairs: for (mut low, mut high) in pairs.into_iter().take(12) {
        let whole = (high.1 - low.1).abs();
        while high.0 - low.0 > 1e-12 * high.0 {
            let middle = low.0.midpoint(high.0);
            if middle <= low.0 || middle >= high.0 {
                break;
            }
            let Some(at) = slope(middle).filter(|slope| slope.is_finite()) else { continue 'pairs };
            if (at - low.1).abs() > (high.1 - at).abs() {
                high = (middle, at);
            } else {
                low = (middle, at);
            }
            // A steep curve becomes flat when one looks closer.
            if (high.1 - low.1).abs() < 0.1 * whole {
                continue 'pairs;
            }
        }
        if change(low.1, high.1) > 1e-5 {
            return Some(Jump { pressure: high.0, before: low.1, after: high.1 });
        }
    }
    None
}

/// Increments on both sides of a jump of the derivative, if they are much farther apart than a slope explains.
fn step(law: &Law<'_>, instance: &Instance<'_>, case: &Case, pressure: f64) -> Option<(f64, f64)> {
    const AWAY: f64 = 1e-10;
    let (below, before) = at_pressure(law, instance, case, pressure * (1.0 - AWAY))?;
    let (above, after) = at_pressure(law, instance, case, pressure * (1.0 + AWAY))?;
    let slopes = before.abs().max(after.abs()) * 2.0 * AWAY * pressure;
    let jump = (above - below).abs();
    (jump > 1e-6 * above.abs().max(below.abs()) && jump > 100.0 * slopes).then_some((below, above))
}

/// Jumps of the derivative at positive pressures, and whether the law says so.
pub(super) fn kinks(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = good(bench, law, instance)?;
        let declared = law.about.flags.contains(Flag::Kinks);
        let found = [0, POINTS / 2, POINTS - 1].into_iter().find_map(|index| {
            let single = case.single(index);
            jump(law, instance, &single).map(|jump| (single, jump))
        });
        match found {
            None if declared => Ok(Verdict::Pass(Some("declared; none found along the pressures tried".to_owned()))),
            None => Ok(Verdict::Pass(None)),
            Some((single, jump)) if declared => match step(law, instance, &single, jump.pressure) {
                Some((below, above)) => {
                    let finding =
                        Finding::new("the increment itself jumps with the pressure: no implicit step settles there");
                    let found = format!(
                        "increment from {} to {} at pressure {}",
                        number_text(below),
                        number_text(above),
                        number_text(jump.pressure)
                    );
                    let wanted = "an increment without a jump, whatever its derivative does";
                    Ok(Verdict::Warn(finding.with(found, wanted).at(single.named(&law.about, 0))))
                }
                None => {
                    Ok(Verdict::Pass(Some(format!("declared, and found at pressure {}", number_text(jump.pressure)))))
                }
            },
            Some((single, jump)) => {
                let finding = Finding::new("the derivative jumps, and the law does not have the flag WL_FLAG_KINKS");
                let words = |slope: f64| number_text(slope);
                let found = format!(
                    "d_pressure from {} to {} at pressure {}",
                    words(jump.before),
                    words(jump.after),
                    number_text(jump.pressure)
                );
                broken(finding.with(found, "no jump, or the flag").at(single.named(&law.about, 0)))
            }
        }
    })
}

/// The values with and without the derivative being asked for.
pub(super) fn asked(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = good(bench, law, instance)?;
        let all = Asked::values(&law.about);
        let mut differences = Differences::default();
        for count in [1, 7, POINTS, 67] {
            let case = case.repeated(count);
            let layout = Layout::plain(&law.about);
            let with = ask(&law.about, instance, &case, &layout);
            let asked = Asked { d_pressure: false, ..all };
            let without = ask(&law.about, instance, &case, &Layout { asked, ..layout });
            still_good(&law.about, &case, &without, "without the derivative asked for")?;
            for point in 0..count {
                differences.note(without.at(point).difference(&with.at(point)), || {
                    Finding::new("asking for the derivative changes a value").at(case.named(&law.about, point))
                });
            }
        }
        differences.judge(&law.about)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_give_smooth_derivatives_to_many_digits_with_an_honest_error() {
        type Pair = (fn(f64) -> f64, fn(f64) -> f64);
        let pairs: [Pair; 4] = [
            (|x| x, |_| 1.0),
            (|x| x.powf(1.7), |x| 1.7 * x.powf(0.7)),
            (|x| (x / 3e7).exp(), |x| (x / 3e7).exp() / 3e7),
            (|x| 1e-20 * x.sqrt(), |x| 0.5e-20 / x.sqrt()),
        ];
        for (function, derivative) in pairs {
            for at in [1e6, 5e7] {
                let found = ridders(|x| Some(function(x)), at, 0.1 * at).unwrap();
                let exact = derivative(at);
                assert!((found.value - exact).abs() <= 2.0 * found.error + 1e-12 * exact, "{found:?} {exact}");
                assert!(found.error < 1e-7 * exact, "{found:?} {exact}");
            }
        }
    }

    #[test]
    fn noise_and_pieces_make_an_estimate_vague_instead_of_wrong() {
        let single = |x: f64| f64::from((x.powf(1.3) * 1e-12) as f32);
        let exact = |x: f64| 1.3e-12 * x.powf(0.3);
        for part in SCALES {
            let found = ridders(|x| Some(single(x)), 2e6, part * 2e6).unwrap();
            assert!((found.value - exact(2e6)).abs() <= 20.0 * found.error + 1e-6 * exact(2e6), "{part}: {found:?}");
        }
        // A table with a thousand pieces of 1e4 each.
        let table = |x: f64| {
            let piece = (x / 1e4).floor();
            let at = |piece: f64| (piece * 1e4).powi(2) * 1e-20;
            at(piece) + (at(piece + 1.0) - at(piece)) * (x / 1e4 - piece)
        };
        let x = 3.123_4e6;
        let slope = (table(x + 10.0) - table(x - 10.0)) / 20.0;
        let agrees = SCALES.into_iter().filter_map(|part| ridders(|x| Some(table(x)), x, part * x)).any(|found| {
            found.error <= SHARP * found.value && (found.value - slope).abs() <= 20.0 * found.error + 1e-6 * slope
        });
        assert!(agrees, "the slope of its own piece is right");
    }

    #[test]
    fn a_refused_value_gives_no_derivative() {
        assert_eq!(ridders(|x| (x > 0.0).then_some(x), 1.0, 2.0), None);
    }
}
