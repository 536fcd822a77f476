//! Numbers at the ends of what a double can be, and at the ends of what the law allows.

use super::super::harness::call::{Asked, Layout};
use super::super::harness::points::{Case, number_text};
use super::super::harness::sample::Sampler;
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict};
use super::bench::{Bench, ask, finite_or_status};
use wearlaw_law::fields::Shape;
use wearlaw_law::{Field, Quantity};

/// Negative zero, the smallest and the largest subnormal, the smallest normal number, small, large, infinite.
const EXTREMES: [f64; 9] = [
    -0.0,
    5e-324,
    2.225_073_858_507_201e-308,
    f64::MIN_POSITIVE,
    1e-300,
    1e300,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

/// True for a field that a host only gives as a unit vector.
pub(super) fn is_unit_vector(field: Field) -> bool {
    matches!(field, Field::Normal | Field::Tangent)
}

/// True for a field that is the size of something: no host gives it with a negative sign.
fn is_size(field: Field) -> bool {
    use Field::{AccumulatedSlip, FrictionCoefficient, FrictionWork, Slip, Velocity};
    matches!(field, Slip | Velocity | FrictionCoefficient | FrictionWork | AccumulatedSlip)
}

/// One ordinary call of one point: a good one, or any if the law refuses all that is tried.
fn ordinary(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>) -> Case {
    let known = bench.known_constants(law);
    let mut sampler = bench.sampler(law, &known);
    sampler.good(instance, 1).unwrap_or_else(|| {
        let numbers = sampler.numbers();
        Case::new(numbers, sampler.constants(), vec![sampler.point(numbers.dt)])
    })
}

/// Calls the law in every way of asking; a silent NaN or infinity breaks the rule.
fn tried(law: &Law<'_>, instance: &Instance<'_>, case: &Case, what: &str) -> Judged<()> {
    for asked in Asked::ways(&law.about) {
        let answers = ask(&law.about, instance, case, &Layout { asked, ..Layout::plain(&law.about) });
        finite_or_status(&law.about, case, &answers, what)?;
    }
    Ok(())
}

/// Puts `value` into every component of every field in turn, alone and together.
fn over_fields(law: &Law<'_>, instance: &Instance<'_>, case: &Case, value: f64, tries: &mut usize) -> Judged<()> {
    for field in law.about.fields().iter().filter(|field| !is_unit_vector(*field) && field.shape() != Shape::Index) {
        if is_size(field) && value == f64::NEG_INFINITY {
            continue;
        }
        let width = field.shape().width();
        let all: Vec<usize> = (0..width).collect();
        let mut choices: Vec<&[usize]> = all.chunks(1).collect();
        if width > 1 {
            choices.push(&all);
        }
        for components in choices {
            let changed = case.map(|point| components.iter().for_each(|at| point.set(field, *at, value)));
            tried(
                law,
                instance,
                &changed,
                &format!("{} {} has no answer and no status", field.name(), number_text(value)),
            )?;
            *tries += 1;
        }
    }
    for (index, input) in law.about.inputs.iter().enumerate() {
        let changed = case.map(|point| point.inputs[index] = value);
        tried(
            law,
            instance,
            &changed,
            &format!("input {} {} has no answer and no status", input.name, number_text(value)),
        )?;
        *tries += 1;
    }
    Ok(())
}

/// Whether a NaN in any input gives a status or a finite value.
pub(super) fn nan(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = ordinary(bench, law, instance);
        let mut tries = 0;
        for value in [f64::NAN, -f64::NAN, f64::from_bits(0x7ff4_0000_0000_0001)] {
            over_fields(law, instance, &case, value, &mut tries)?;
        }
        Ok(Verdict::Pass(Some(format!("{tries} calls"))))
    })
}

/// Whether extreme values of fields, inputs, constants, state variables and dt give a finite value or a status.
pub(super) fn extremes(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = ordinary(bench, law, instance);
        let mut tries = 0;
        for value in EXTREMES {
            over_fields(law, instance, &case, value, &mut tries)?;
            let text = number_text(value);
            for (index, constant) in allowing(&law.about.constants, value) {
                let mut changed = case.clone();
                changed.constants[index] = value;
                tried(
                    law,
                    instance,
                    &changed,
                    &format!("constant {} {text} has no answer and no status", constant.name),
                )?;
                tries += 1;
            }
            for (index, variable) in allowing(&law.about.state, value) {
                let changed = case.map(|point| point.state[index] = value);
                let what = format!("state variable {} {text} has no answer and no status", variable.name);
                tried(law, instance, &changed, &what)?;
                tries += 1;
            }
            if value > 0.0 && value.is_finite() {
                let mut changed = case.clone();
                changed.numbers.dt = value;
                tried(law, instance, &changed, &format!("dt {text} has no answer and no status"))?;
                tries += 1;
            }
        }
        sums(law, instance, &case, &mut tries)?;
        Ok(Verdict::Pass(Some(format!("{tries} calls"))))
    })
}

/// Puts the largest number into a state variable and into each field in turn: a sum of the two is none any more.
fn sums(law: &Law<'_>, instance: &Instance<'_>, case: &Case, tries: &mut usize) -> Judged<()> {
    for (index, variable) in law.about.state.iter().enumerate().filter(|(_, v)| v.allows(f64::MAX)) {
        for field in law.about.fields().iter().filter(|field| field.shape() == Shape::Scalar) {
            let changed = case.map(|point| {
                point.state[index] = f64::MAX;
                point.set(field, 0, f64::MAX);
            });
            let text = number_text(f64::MAX);
            let what = format!("{} and {} of {text} have no answer and no status", variable.name, field.name());
            tried(law, instance, &changed, &what)?;
            *tries += 1;
        }
    }
    Ok(())
}

/// The quantities of a list that may have this value, where it is not one of their bounds.
fn allowing(quantities: &[Quantity], value: f64) -> impl Iterator<Item = (usize, &Quantity)> {
    let inside =
        move |quantity: &Quantity| quantity.allows(value) && value != quantity.minimum && value != quantity.maximum;
    quantities.iter().enumerate().filter(move |(_, quantity)| inside(quantity))
}

/// Values at the bounds of a quantity, just inside of them, and simple ones where it has none.
fn at_bounds(quantity: &Quantity) -> Vec<f64> {
    let (low, high) = (quantity.minimum, quantity.maximum);
    let candidates = [low, low.next_up(), high, high.next_down(), 0.0, 1.0, -1.0, low.midpoint(high)];
    let mut values: Vec<f64> = candidates.into_iter().filter(|value| quantity.allows(*value)).collect();
    values.dedup();
    values
}

/// Whether the law answers at the bounds that it declares; beyond them the host refuses, by the descriptor.
pub(super) fn bounds(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let case = ordinary(bench, law, instance);
        let known = bench.known_constants(law);
        let mut sampler = Sampler::new(about, bench.task.seed, "values/bounds, points", &known);
        let mut tries = 0;
        for (index, constant) in about.constants.iter().enumerate() {
            for value in at_bounds(constant) {
                let mut changed = case.clone();
                changed.constants[index] = value;
                changed.points.push(sampler.point(changed.numbers.dt));
                for point in 0..changed.points.len() {
                    let what = format!("constant {} {} is allowed, but {}", constant.name, number_text(value), HINT);
                    tried(law, instance, &changed.single(point), &what)?;
                    tries += 1;
                }
            }
        }
        for (index, variable) in about.state.iter().enumerate() {
            for value in at_bounds(variable) {
                let what = format!("state variable {} {} is allowed, but {}", variable.name, number_text(value), HINT);
                tried(law, instance, &case.map(|point| point.state[index] = value), &what)?;
                tries += 1;
            }
        }
        for (index, input) in about.inputs.iter().enumerate() {
            for value in at_bounds(input) {
                let what = format!("input {} {} is allowed, but {}", input.name, number_text(value), HINT);
                tried(law, instance, &case.map(|point| point.inputs[index] = value), &what)?;
                tries += 1;
            }
        }
        // Combinations: every constant at one of its bounds.
        for _ in 0..100 {
            let mut changed = case.clone();
            for (value, constant) in changed.constants.iter_mut().zip(&about.constants) {
                let choices = at_bounds(constant);
                if sampler.random.unit() < 0.5 && !choices.is_empty() {
                    *value = choices[sampler.random.below(choices.len())];
                }
            }
            tried(law, instance, &changed, &format!("the constants are allowed, but {HINT}"))?;
            tries += 1;
        }
        Ok(Verdict::Pass(Some(format!("{tries} calls"))))
    })
}

const HINT: &str = "has no answer and no status: narrow its bounds, or answer with a status";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn excluded_bounds_are_met_from_inside() {
        let plain = Quantity {
            name: "H".to_owned(),
            summary: String::new(),
            exponents: [0.0; 4],
            minimum: 0.0,
            maximum: f64::INFINITY,
            default: None,
            closes_units: false,
            above_minimum: false,
            below_maximum: false,
        };
        assert!(at_bounds(&plain).contains(&0.0));
        let above = Quantity { above_minimum: true, ..plain };
        assert!(!at_bounds(&above).contains(&0.0) && at_bounds(&above).contains(&5e-324));
    }
}
