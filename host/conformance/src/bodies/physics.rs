//! The author's claims, each against the equation behind it.

use super::super::harness::call::Layout;
use super::super::harness::closeness::agree;
use super::super::harness::points::{Case, Point, number_text, vector_text};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, POINTS, ask, still_good};
use super::values::{changed, no_wear, without_pressure, without_slip};
use wearlaw_law::{Claim, Degree, Field, OutputItem};

/// Relative difference between two ways to the same number.
const TOLERANCE: f64 = 1e-9;

fn claimed(law: &Law<'_>, claim: Claim) -> Judged<()> {
    if law.about.claims(claim) { Ok(()) } else { skip(format!("the law does not claim `{}`", claim.name())) }
}

/// Fields that no host gives with a negative sign: what a law makes of one is no promise.
const MAGNITUDES: [Field; 7] = [
    Field::Slip,
    Field::Velocity,
    Field::AccumulatedSlip,
    Field::AccumulatedWear,
    Field::FrictionCoefficient,
    Field::FrictionWork,
    Field::Area,
];

/// No negative increment, at ordinary and wide inputs.
pub(super) fn non_negative(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        claimed(law, Claim::NonNegative)?;
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let mut cases: Vec<Case> = (0..200)
            .map(|_| {
                let numbers = sampler.numbers();
                Case::new(numbers, sampler.constants(), vec![sampler.point(numbers.dt)])
            })
            .collect();
        cases.extend(super::faults::odd_cases(&mut sampler, about, 200));
        cases.retain(|case| !MAGNITUDES.iter().any(|field| case.point(0).scalar(*field) < 0.0));
        let mut answered = 0;
        for case in cases {
            let answers = ask(about, instance, &case, &Layout::plain(about));
            if !answers.is_good() {
                continue;
            }
            answered += 1;
            if answers.increment[0] < 0.0 {
                let finding = Finding::new("the increment is negative, and the law claims `non_negative`");
                let found = format!("increment {}", number_text(answers.increment[0]));
                return broken(finding.with(found, "0 or more").at(case.named(about, 0)));
            }
        }
        Ok(Verdict::Pass(Some(format!("{answered} calls answered"))))
    })
}

/// No pressure, no wear.
pub(super) fn zero_without_pressure(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        claimed(law, Claim::ZeroWithoutPressure)?;
        let what = "it wears without pressure, and claims `zero_without_pressure`";
        let change = |case: &mut Case| *case = case.map(|point| without_pressure(point, 0.0));
        changed(bench, law, instance, change, what, no_wear(what))
    })
}

/// No slip, no wear.
pub(super) fn zero_without_slip(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        claimed(law, Claim::ZeroWithoutSlip)?;
        let what = "it wears without slip, and claims `zero_without_slip`";
        let change = |case: &mut Case| *case = case.map(without_slip);
        changed(bench, law, instance, change, what, no_wear(what))
    })
}

/// A substep so many times as long: what is travelled and dissipated goes with the time, rates stay.
fn lasting(case: &Case, factor: f64) -> Case {
    let mut part = case.map(|point| {
        for field in [Field::Slip, Field::SlipVector, Field::FrictionWork] {
            point.scale(field, factor);
        }
    });
    part.numbers.dt *= factor;
    part
}

/// Wear of a substep in equal parts, one after the other; none if one of them is refused.
fn in_parts(law: &Law<'_>, instance: &Instance<'_>, case: &Case, parts: usize) -> Option<f64> {
    let mut part = lasting(case, 1.0 / parts as f64);
    let mut sum = 0.0;
    for _ in 0..parts {
        let answers = ask(&law.about, instance, &part, &Layout::plain(&law.about));
        if !answers.is_good() {
            return None;
        }
        sum += answers.increment[0];
        part = part.map(|point| point.state.clone_from(&answers.state));
    }
    Some(sum)
}

/// Durations, over an ordinary one, of which one moves a state by its own size, whatever that is.
const WITH_STATE: [f64; 5] = [1.0, 1e3, 1e6, 1e9, 1e12];
/// Sets of constants: with one that a default makes idle, such as a factor of 1, a claim may hold that is none otherwise.
const SETS: usize = 4;

/// One substep against its parts; the observed order where it is not claimed.
pub(super) fn linear_in_dt(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        if !law.about.claims(Claim::LinearInDt) {
            let case = bench.good(law, instance, POINTS)?;
            return skip(match order(law, instance, &case) {
                Some(order) => format!("the law does not claim `linear_in_dt` (observed: dt to the power {order:.2})"),
                None => "the law does not claim `linear_in_dt`".to_owned(),
            });
        }
        let cases = bench.several(law, instance, POINTS, SETS)?;
        match cases.iter().find_map(|case| unequal_parts(law, instance, case)) {
            Some(finding) => broken(finding),
            None => Ok(Verdict::Pass(None)),
        }
    })
}

/// The first point and duration at which a substep wears otherwise than its parts.
fn unequal_parts(law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> Option<Finding> {
    let durations = if law.about.state.is_empty() { &WITH_STATE[..1] } else { &WITH_STATE };
    for (index, factor) in (0..case.count).flat_map(|index| durations.iter().map(move |factor| (index, *factor))) {
        let single = lasting(&case.single(index), factor);
        let Some(whole) = in_parts(law, instance, &single, 1) else { continue };
        for parts in [2, 7, 64] {
            let Some(sum) = in_parts(law, instance, &single, parts) else { continue };
            if agree(sum, whole, TOLERANCE) {
                continue;
            }
            let what =
                format!("{parts} parts of a substep wear otherwise than the whole, and the law claims `linear_in_dt`");
            let found = format!("{} in {parts} parts", number_text(sum));
            let finding = Finding::new(what).at(single.named(&law.about, 0));
            return Some(finding.with(found, format!("{} as in one", number_text(whole))));
        }
    }
    None
}

/// The observed power of dt: 1 for a law that is linear in it.
fn order(law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> Option<f64> {
    let single = case.single(case.count - 1);
    let whole = in_parts(law, instance, &single, 1)?;
    let answers = ask(&law.about, instance, &lasting(&single, 0.5), &Layout::plain(&law.about));
    let order = (whole / answers.increment[0]).log2();
    (answers.is_good() && order.is_finite()).then_some(order)
}

/// Pressure times f, and what comes of pressure too.
pub(super) fn pressure_degree(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        if about.pressure_degree == Degree::Unclaimed {
            return skip("the law claims no pressure degree");
        }
        let case = bench.good(law, instance, POINTS)?;
        let Some(degree) = about.pressure_degree.value(&case.constants) else {
            return skip("the constant that holds the degree is not there");
        };
        let expected = ask(about, instance, &case, &Layout::plain(about));
        still_good(about, &case, &expected, "ordinary inputs")?;
        let mut compared = 0;
        for factor in [0.5, 0.9, 1.7, 8.0] {
            let scaled = case.map(|point| {
                for field in [Field::Pressure, Field::NodalTraction, Field::FrictionStress, Field::FrictionWork] {
                    point.scale(field, factor);
                }
            });
            for index in 0..case.count {
                let single = scaled.single(index);
                let answers = ask(about, instance, &single, &Layout::plain(about));
                if !answers.is_good() {
                    continue;
                }
                compared += 1;
                let wanted = expected.increment[index] * factor.powf(degree);
                if agree(answers.increment[0], wanted, TOLERANCE) {
                    continue;
                }
                let what =
                    format!("the increment is not of degree {} in the pressure, as claimed", number_text(degree));
                let finding = Finding::new(what).at(single.named(about, 0));
                let words = format!("{factor}^{} times that at 1/{factor} of the pressure", number_text(degree));
                return broken(finding.with(
                    format!("increment {}", number_text(answers.increment[0])),
                    format!("{}, {words}", number_text(wanted)),
                ));
            }
        }
        Ok(Verdict::Pass(Some(format!("degree {}, {compared} points compared", number_text(degree)))))
    })
}

/// A rotation by Rodrigues' formula about a random axis.
fn rotation(random: &mut super::super::harness::random::Random) -> impl Fn([f64; 3]) -> [f64; 3] + use<> {
    let axis = random.direction();
    let (sine, cosine) = random.between(0.3, 3.0).sin_cos();
    move |v: [f64; 3]| {
        let along: f64 = axis.iter().zip(v).map(|(a, b)| a * b).sum();
        let cross = [axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0]];
        [0, 1, 2].map(|i| v[i] * cosine + cross[i] * sine + axis[i] * along * (1.0 - cosine))
    }
}

const VECTORS: [Field; 5] =
    [Field::SlipVector, Field::Normal, Field::Coordinates, Field::Tangent, Field::FrictionStress];

/// All vectors turned.
pub(super) fn frame(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        claimed(law, Claim::FrameIndifferent)?;
        let case = bench.good(law, instance, POINTS)?;
        let expected = ask(about, instance, &case, &Layout::plain(about));
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        for _ in 0..4 {
            let turn = rotation(&mut sampler.random);
            let turned = case.map(|point: &mut Point| {
                VECTORS.iter().for_each(|field| point.set_vector(*field, turn(point.real(*field))));
            });
            let answers = ask(about, instance, &turned, &Layout::plain(about));
            still_good(about, &turned, &answers, "in a turned frame")?;
            for index in 0..case.count {
                let (before, after) = (expected.at(index), answers.at(index));
                if !agree(before.increment, after.increment, TOLERANCE) {
                    let finding =
                        Finding::new("turning the frame changes the increment, and the law claims `frame_indifferent`");
                    return broken(finding.at(turned.named(about, index)).with(
                        format!("increment {}", number_text(after.increment)),
                        format!("{}, as before the turn", number_text(before.increment)),
                    ));
                }
                let (Some(was), Some(is)) = (vector(&before.direction), vector(&after.direction)) else { continue };
                let wanted = turn(was);
                if wanted.iter().zip(is).any(|(a, b)| (a - b).abs() > TOLERANCE) {
                    let finding = Finding::new(
                        "the direction does not turn with the frame, and the law claims `frame_indifferent`",
                    );
                    return broken(finding.at(turned.named(about, index)).with(vector_text(is), vector_text(wanted)));
                }
            }
        }
        Ok(Verdict::Pass(None))
    })
}

fn vector(components: &[f64]) -> Option<[f64; 3]> {
    components.try_into().ok()
}

/// Looks at every direction of good points, ordinary and with constants and slips of all sizes.
fn over_directions(bench: &Bench, fault: impl Fn([f64; 3], [f64; 3]) -> Option<Finding>) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        if !law.writes(OutputItem::Direction) {
            return skip("the law keeps the default direction");
        }
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let mut seen = 0;
        for _ in 0..6 {
            let Some(mut case) = sampler.good(instance, POINTS) else { break };
            for factor in [1.0, 0.0, 1e-9, 1e9] {
                case = case.map(|point| point.scale(Field::SlipVector, factor));
                for index in 0..case.count {
                    let single = case.single(index);
                    let answers = ask(about, instance, &single, &Layout::plain(about));
                    let Some(direction) = vector(&answers.direction).filter(|_| answers.is_good()) else { continue };
                    seen += 1;
                    if let Some(finding) = fault(direction, single.point(0).real(Field::Normal)) {
                        return broken(finding.at(single.named(about, 0)));
                    }
                }
            }
        }
        if seen == 0 {
            return skip("the law refused every ordinary input that was tried");
        }
        Ok(Verdict::Pass(Some(format!("{seen} directions"))))
    })
}

/// Directions of unit length, as a host checks it.
pub(super) fn direction_length(bench: &Bench) -> Judged {
    over_directions(bench, |direction, _| {
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let off = length.is_nan() || (length - 1.0).abs() > TOLERANCE;
        off.then(|| {
            let finding = Finding::new("a wear direction does not have unit length");
            finding.with(format!("{} of length {}", vector_text(direction), number_text(length)), "length 1 to 1e-9")
        })
    })
}

/// Directions into the worn body.
pub(super) fn direction_inward(bench: &Bench) -> Judged {
    over_directions(bench, |direction, normal| {
        let inward: f64 = -direction.iter().zip(normal).map(|(d, n)| d * n).sum::<f64>();
        let outward = inward <= 0.0;
        outward.then(|| {
            let finding = Finding::new("a wear direction does not point into the worn body");
            let found = format!("{}, normal {}", vector_text(direction), vector_text(normal));
            finding.with(found, "a direction against the outward normal, -d.n > 0")
        })
    })
}
