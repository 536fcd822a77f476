//! The same temperatures in a scale with another zero: the answer must be the same.

use super::super::harness::call::Layout;
use super::super::harness::closeness::{AtPoint, agree};
use super::super::harness::points::{Case, number_text};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, POINTS, ask};
use wearlaw_law::{Field, LawDescriptor, Quantity};

/// Relative difference that rounding in another scale may make.
const TOLERANCE: f64 = 1e-9;
/// Kelvin from absolute zero to the zero of a scale; with whole powers of two ordinary temperatures are moved exactly.
const ZEROS: [f64; 2] = [256.0, -128.0];
/// Calls of several points.
const CALLS: usize = 3;
/// Most quantities in kelvin, each of which may be a temperature or a difference of two.
const MOST: usize = 10;

/// Fields in the temperature scale.
const TEMPERATURES: [Field; 2] = [Field::Temperature, Field::CounterTemperature];

/// Those that a law reads or uses.
fn temperatures(law: &LawDescriptor) -> impl Iterator<Item = Field> {
    let fields = law.fields();
    TEMPERATURES.into_iter().filter(move |field| fields.contains(*field))
}

/// The quantities of a law in kelvin: constants, inputs, then state variables, by their place in that order.
fn in_kelvin(law: &LawDescriptor) -> Vec<usize> {
    let kelvin = |quantity: &Quantity| quantity.exponents == [0.0, 0.0, 0.0, 1.0];
    let all = law.constants.iter().chain(&law.inputs).chain(&law.state).enumerate();
    all.filter(|(_, quantity)| kelvin(quantity)).map(|(place, _)| place).collect()
}

/// The same call in a scale whose zero lies `zero` above the absolute one; of the quantities in kelvin those of `moved`
/// are temperatures of that scale, the others differences. None if a value would leave its bounds.
fn moved(case: &Case, law: &LawDescriptor, zero: f64, moved: &[usize]) -> Option<Case> {
    let (constants, inputs) = (law.constants.len(), law.inputs.len());
    let mut case = case.map(|point| {
        for field in TEMPERATURES {
            point.set(field, 0, point.scalar(field) - zero);
        }
        for place in moved.iter().filter_map(|place| place.checked_sub(constants)) {
            match place.checked_sub(inputs) {
                None => point.inputs[place] -= zero,
                Some(variable) => point.state[variable] -= zero,
            }
        }
    });
    for place in moved.iter().filter(|place| **place < constants) {
        case.constants[*place] -= zero;
    }
    case.numbers.absolute_zero -= zero;
    case.numbers.reference_temperature -= zero;
    let point = case.point(0);
    let values = case.constants.iter().chain(&point.inputs).chain(&point.state);
    let quantities = law.constants.iter().chain(&law.inputs).chain(&law.state);
    quantities.zip(values).all(|(quantity, value)| quantity.allows(*value)).then_some(case)
}

/// The answer at one point, if there is one.
fn answer(law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> Option<AtPoint> {
    let answers = ask(&law.about, instance, case, &Layout::plain(&law.about));
    answers.is_good().then(|| answers.at(0))
}

fn same(one: &AtPoint, other: &AtPoint) -> bool {
    let slopes = one.d_pressure.zip(other.d_pressure);
    let turned = one.direction.iter().zip(&other.direction).any(|(a, b)| (a - b).abs() > TOLERANCE);
    agree(one.increment, other.increment, TOLERANCE) && slopes.is_none_or(|(a, b)| agree(a, b, TOLERANCE)) && !turned
}

/// Scales with other zeros.
pub(super) fn scale(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        if temperatures(about).next().is_none() {
            return skip("the law reads no temperature");
        }
        let kelvin = in_kelvin(about);
        if kelvin.len() > MOST {
            return skip(format!("more than {MOST} quantities in kelvin, each a temperature or a difference"));
        }
        let chosen =
            |set: u32| kelvin.iter().enumerate().filter(move |(k, _)| set >> k & 1 != 0).map(|(_, place)| *place);
        let sets: Vec<Vec<usize>> = (0..1 << kelvin.len()).map(|set| chosen(set).collect()).collect();
        let mut fits = vec![true; sets.len()];
        let mut compared = 0;
        for case in bench.several(law, instance, POINTS, CALLS)? {
            for index in 0..case.count {
                let single = case.single(index);
                let Some(wanted) = answer(law, instance, &single) else { continue };
                for zero in ZEROS {
                    let mut last = None;
                    for (set, fits) in sets.iter().zip(&mut fits).filter(|(_, fits)| **fits) {
                        let Some(moved) = moved(&single, about, zero, set) else {
                            *fits = false;
                            continue;
                        };
                        let found = answer(law, instance, &moved);
                        *fits = found.as_ref().is_some_and(|found| same(found, &wanted));
                        last = Some((moved, found));
                    }
                    compared += 1;
                    if !fits.contains(&true) {
                        return broken(unlike(about, zero, last, &wanted));
                    }
                }
            }
        }
        if compared == 0 {
            return skip("the law refused every ordinary input that was tried");
        }
        Ok(Verdict::Pass(Some(format!("{compared} points in other scales compared"))))
    })
}

fn unlike(law: &LawDescriptor, zero: f64, last: Option<(Case, Option<AtPoint>)>, wanted: &AtPoint) -> Finding {
    let what = format!(
        "in a temperature scale whose zero is at {} K the law answers otherwise: an absolute temperature is `temperature \
         - absolute_zero`",
        number_text(zero)
    );
    let text = |at: &AtPoint| format!("increment {}", number_text(at.increment));
    let expected = format!("{}, as in kelvin", text(wanted));
    match last {
        None => Finding::new(what).with("a temperature out of its bounds", expected),
        Some((case, found)) => {
            let found = found.map_or_else(|| "refused".to_owned(), |found| text(&found));
            let kelvin = temperatures(law)
                .map(|field| format!("`{}` {}", field.name(), number_text(case.point(0).scalar(field) + zero)));
            let expected = format!("{expected} with {}", kelvin.collect::<Vec<_>>().join(" and "));
            Finding::new(what).with(found, expected).at(case.named(law, 0))
        }
    }
}
