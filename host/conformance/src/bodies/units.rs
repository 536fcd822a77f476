//! The same contact in other base units: the answer must be the same length.

use super::super::harness::call::Layout;
use super::super::harness::closeness::agree;
use super::super::harness::points::{Case, number_text};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, POINTS, ask};
use wearlaw_law::{Field, LawDescriptor, UnitSizes};

/// Relative difference after the way to other units and back.
const TOLERANCE: f64 = 1e-9;
/// Largest power of two of a unit's size.
const MOST: f64 = 13.0;

/// What a number in SI units is divided by to be in units of these sizes.
fn factor(sizes: &UnitSizes, exponents: [f64; 4]) -> f64 {
    sizes.factor(exponents)
}

/// The same call in units of these sizes; `closing` multiplies the constant that closes the units.
fn converted(case: &Case, law: &LawDescriptor, sizes: &UnitSizes, closing: f64) -> Case {
    let mut case = case.map(|point| {
        for field in Field::ALL.iter().copied() {
            point.scale(field, 1.0 / factor(sizes, field.exponents()));
        }
        for (value, input) in point.inputs.iter_mut().zip(&law.inputs) {
            *value /= factor(sizes, input.exponents);
        }
        for (value, variable) in point.state.iter_mut().zip(&law.state) {
            *value /= factor(sizes, variable.exponents);
        }
    });
    for (value, constant) in case.constants.iter_mut().zip(&law.constants) {
        *value /= factor(sizes, constant.exponents);
        if constant.closes_units {
            *value *= closing;
        }
    }
    let numbers = &mut case.numbers;
    for time in [&mut numbers.time, &mut numbers.dt, &mut numbers.step_time] {
        *time /= sizes.second;
    }
    for temperature in [&mut numbers.reference_temperature, &mut numbers.absolute_zero] {
        *temperature /= sizes.kelvin;
    }
    numbers.units = *sizes;
    case
}

/// What a law answers to one point, in SI units.
struct Answered {
    /// The wear increment, the state at the end and the derivative, with their names.
    values: Vec<(String, f64)>,
}

impl Answered {
    fn increment(&self) -> f64 {
        self.values[0].1
    }

    /// The first value that is not the same as that of another answer, with what it should be.
    fn differs(&self, wanted: &Self) -> Option<(&str, f64, f64)> {
        let pairs = self.values.iter().zip(&wanted.values);
        let mut pairs = pairs.map(|((name, found), (_, wanted))| (name.as_str(), *found, *wanted));
        pairs.find(|(_, found, wanted)| !agree(*found, *wanted, TOLERANCE))
    }
}

/// The answer to one point in SI units; none if it is refused.
fn answered(law: &Law<'_>, instance: &Instance<'_>, case: &Case, sizes: &UnitSizes) -> Option<Answered> {
    let about = &law.about;
    let answers = ask(about, instance, case, &Layout::plain(about));
    if !answers.is_good() {
        return None;
    }
    let mut values = vec![("increment".to_owned(), answers.increment[0] * sizes.metre)];
    for (variable, value) in about.state.iter().zip(&answers.state) {
        values.push((format!("{}_end", variable.name), value * factor(sizes, variable.exponents)));
    }
    if let Some(slope) = answers.d_pressure.first().filter(|slope| slope.is_finite()) {
        values.push(("d_pressure".to_owned(), slope * sizes.metre / factor(sizes, Field::Pressure.exponents())));
    }
    Some(Answered { values })
}

/// The wear increment in metres.
fn metres(law: &Law<'_>, instance: &Instance<'_>, case: &Case, sizes: &UnitSizes) -> Option<f64> {
    answered(law, instance, case, sizes).map(|answered| answered.increment())
}

/// What came of the search for the factor of the closing constant.
enum Fit {
    Factor(f64),
    /// The numbers leave what a double can hold on the way: these units say nothing.
    Beyond,
    /// No factor makes the point come out.
    None,
}

/// The factor of the closing constant that makes one point come out.
fn fitted(law: &Law<'_>, instance: &Instance<'_>, case: &Case, sizes: &UnitSizes, wanted: f64) -> Fit {
    let mut closing = 1.0;
    for _ in 0..20 {
        let changed = converted(case, &law.about, sizes, closing);
        let values = changed.constants.iter().zip(&case.constants);
        let lost = values
            .into_iter()
            .any(|(value, was)| !value.is_finite() || (value.abs() < f64::MIN_POSITIVE && *was != 0.0));
        let Some(found) = metres(law, instance, &changed, sizes).filter(|_| !lost) else { return Fit::Beyond };
        if agree(found, wanted, 1e-12) {
            return Fit::Factor(closing);
        }
        let next = closing * wanted / found;
        if !next.is_finite() || next <= 0.0 {
            return Fit::Beyond;
        }
        closing = next;
    }
    Fit::None
}

/// True for constants whose powers stay within what a double can hold.
fn is_moderate(case: &Case) -> bool {
    case.constants.iter().all(|value| *value == 0.0 || (1e-100..1e100).contains(&value.abs()))
}

/// Whether the law states any unit at all.
fn stated(law: &LawDescriptor) -> bool {
    let mut quantities = law.constants.iter().chain(&law.state).chain(&law.inputs).peekable();
    quantities.peek().is_none() || quantities.any(|quantity| quantity.closes_units || quantity.exponents != [0.0; 4])
}

/// Random sizes of the base units.
pub(super) fn units(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let closes = about.constants.iter().any(|constant| constant.closes_units);
        let mut compared = 0;
        for _ in 0..3 {
            let Some(case) = sampler.good(instance, POINTS) else { break };
            let wanted: Vec<Option<Answered>> =
                (0..case.count).map(|index| answered(law, instance, &case.single(index), &UnitSizes::SI)).collect();
            for _ in 0..3 {
                // Powers of two, so that the conversion itself rounds nothing.
                let [metre, kilogram, second, kelvin] =
                    [0; 4].map(|_| 2.0_f64.powf(sampler.random.between(-MOST, MOST).round()));
                let sizes = UnitSizes { metre, kilogram, second, kelvin };
                let mut closing = 1.0;
                if closes {
                    let wearing = (0..case.count)
                        .rev()
                        .find_map(|i| wanted[i].as_ref().map(|w| (i, w.increment())).filter(|(_, w)| *w != 0.0));
                    let Some((at, depth)) = wearing else { continue };
                    match fitted(law, instance, &case.single(at), &sizes, depth) {
                        Fit::Factor(factor) => closing = factor,
                        Fit::Beyond => continue,
                        Fit::None => return broken(unfitted(law, &case.single(at), &sizes)),
                    }
                }
                for (index, wanted) in wanted.iter().enumerate() {
                    let Some(wanted) = wanted else { continue };
                    let single = converted(&case.single(index), about, &sizes, closing);
                    if !is_moderate(&single) || !is_moderate(&case.single(index)) {
                        continue;
                    }
                    let found = answered(law, instance, &single, &sizes);
                    compared += 1;
                    let different = match &found {
                        Some(found) => found.differs(wanted).map(|(name, found, wanted)| (name, Some(found), wanted)),
                        None => Some(("increment", None, wanted.increment())),
                    };
                    let Some(different) = different else { continue };
                    let mut finding = unlike(&single, about, &sizes, different);
                    if !stated(about) {
                        finding.what = format!(
                            "in {} the law answers otherwise, and none of its quantities has a unit: a number with a unit is \
                             hidden in it, unless it is meant for one set of units alone",
                            sizes_text(&sizes)
                        );
                        return Ok(Verdict::Warn(finding));
                    }
                    return broken(finding);
                }
            }
        }
        if compared == 0 {
            return skip(
                "the law refused every ordinary input that was tried, or its numbers leave the range of a double",
            );
        }
        Ok(Verdict::Pass(Some(format!("{compared} points in other units compared"))))
    })
}

fn sizes_text(sizes: &UnitSizes) -> String {
    let [metre, kilogram, second, kelvin] = [sizes.metre, sizes.kilogram, sizes.second, sizes.kelvin].map(number_text);
    format!("units of {metre} m, {kilogram} kg, {second} s, {kelvin} K")
}

fn unlike(
    single: &Case,
    law: &LawDescriptor,
    sizes: &UnitSizes,
    (name, found, wanted): (&str, Option<f64>, f64),
) -> Finding {
    let what = format!(
        "in {} the law answers otherwise: a quantity has another unit than it says, a number with a unit is hidden in the \
         law, or an exponent other than 1 gives a constant another unit: that one closes the units",
        sizes_text(sizes)
    );
    let found =
        found.map_or_else(|| "refused".to_owned(), |found| format!("{name} of {} in SI units", number_text(found)));
    let expected = format!("{name} of {}, as asked in SI units", number_text(wanted));
    Finding::new(what).with(found, expected).at(single.named(law, 0))
}

fn unfitted(law: &Law<'_>, single: &Case, sizes: &UnitSizes) -> Finding {
    let name = law.about.constants.iter().find(|constant| constant.closes_units).map_or("", |c| c.name.as_str());
    let what = format!(
        "in {} no value of constant `{name}`, which closes the units, gives the same answer",
        sizes_text(sizes)
    );
    Finding::new(what).at(single.named(&law.about, 0))
}
