//! How columns lie: given once, side by side or with gaps, the answers are the same.

use super::super::harness::call::{Asked, Layout, Spread};
use super::super::harness::points::{Case, Point};
use super::super::harness::random::Random;
use super::super::harness::sample::nearest;
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, broken, skip};
use super::super::outcome::Finding;
use super::batch::{Known, over_and_over, over_ways};
use super::bench::{Bench, Differences, POINTS, ask, not_finite, still_good};
use super::extremes::is_unit_vector;
use super::memory::FILLINGS;
use wearlaw_law::{Field, Fields};

/// Points that fill two blocks and begin a third, whatever the size of the blocks a law works in (1024 at most).
const BLOCKS: usize = 2051;

/// Points that share the values of some fields, given once or at every point.
fn shared(case: &Case, fields: Fields) -> Case {
    let first: Point = case.point(0).clone();
    case.map(|point| {
        for field in fields.iter() {
            point.set_vector(field, first.real(field));
            point.set_index(field, first.index(field));
        }
    })
}

/// Compares a case, as it is and over so many points, in two layouts in every way of asking.
fn both(
    law: &Law<'_>,
    instance: &Instance<'_>,
    (case, points): (&Case, Option<usize>),
    (usual, other): (&Layout, &Layout),
    what: &str,
    differences: &mut Differences,
) -> Judged<()> {
    let about = &law.about;
    for case in [Some(case.clone()), points.map(|points| case.repeated(points))].into_iter().flatten() {
        for asked in Asked::ways(about) {
            let expected = ask(about, instance, &case, &Layout { asked, ..*usual });
            if !expected.is_good() {
                // These values do not go together.
                return Ok(());
            }
            let answers = ask(about, instance, &case, &Layout { asked, ..*other });
            still_good(about, &case, &answers, what)?;
            let statuses = expected.point_status.iter().zip(&answers.point_status).enumerate();
            if let Some((point, (wanted, found))) = statuses.into_iter().find(|(_, (wanted, found))| wanted != found) {
                let finding =
                    Finding::new(format!("{what}: the status of point {point} is another one, or not written"));
                return broken(finding.with(format!("{found}"), format!("{wanted}")).at(case.named(about, point)));
            }
            for point in 0..case.count {
                differences.note(expected.at(point).difference(&answers.at(point)), || {
                    Finding::new(what).at(case.named(about, point))
                });
            }
        }
    }
    Ok(())
}

/// Each field and input, and all together, given once.
pub(super) fn uniform_fields(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        if about.fields().is_empty() && about.inputs.is_empty() {
            return skip("the law reads no fields");
        }
        let mut differences = Differences::default();
        let plain = Layout::plain(about);
        // No power of two, so that blocks do not begin with the same point.
        for case in bench.goods(law, instance, POINTS - 1)? {
            let sets = about.fields().iter().map(|field| Fields::EMPTY.with(field)).chain([about.fields()]);
            for fields in sets {
                // A unit vector and what depends on it are taken from one point.
                let with_vectors = fields.iter().any(is_unit_vector) || fields == about.fields();
                let every: Fields = Field::ALL.iter().copied().filter(|field| field.shape().width() == 3).collect();
                let case = shared(&case, if with_vectors { fields.union(every) } else { fields });
                let what = format!("{fields} given once (step 0) instead of at every point");
                let once = Layout { uniform: fields, ..plain };
                both(law, instance, (&case, Some(BLOCKS)), (&plain, &once), &what, &mut differences)?;
            }
            let inputs = case.point(0).inputs.clone();
            if !inputs.is_empty() {
                let case = case.map(|point| point.inputs.clone_from(&inputs));
                let once = Layout { inputs: Spread::Uniform, ..plain };
                let what = "inputs given once (step 0) instead of at every point";
                both(law, instance, (&case, Some(BLOCKS)), (&plain, &once), what, &mut differences)?;
            }
        }
        differences.judge(about)
    })
}

/// Fields, inputs and state with gaps between their points, each and all.
pub(super) fn strided_fields(bench: &Bench) -> Judged {
    over_ways(bench, 2 * POINTS - 1, |known, differences| {
        let mut layouts = Vec::new();
        for times in [3, 2, 7] {
            let gaps = Spread::Strided(times);
            let what = |name: &str| format!("{name} whose values lie {times} times their width apart");
            let fields = Layout { fields: gaps, ..known.layout };
            layouts.push((what("fields, inputs and state"), Layout { inputs: gaps, state: gaps, ..fields }));
            layouts.push((what("fields and inputs"), Layout { inputs: gaps, ..fields }));
            layouts.push((what("fields"), fields));
            layouts.push((what("state"), Layout { state: gaps, ..known.layout }));
            layouts.push((what("inputs"), Layout { inputs: gaps, ..known.layout }));
        }
        for field in known.fields().iter() {
            let spread = Fields::EMPTY.with(field);
            let what = format!("{} alone with gaps between its points", field.name());
            layouts.push((what, Layout { spread, fields: Spread::Strided(2), ..known.layout }));
        }
        for (what, layout) in layouts {
            for count in [known.case.count, BLOCKS] {
                known.compare(&over_and_over(known.case.count, count), &layout, &what, differences)?;
            }
        }
        Ok(())
    })
}

/// Layouts in which every column lies in a way of its own, and arrays that are moved by themselves.
const MIXED: usize = 48;
const MOVED: usize = 32;

/// Columns given once, side by side and with gaps in one call, some with constants of their own; arrays of which some begin
/// at an address that pairs of numbers do not like.
pub(super) fn mixed(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let mut random = Random::new(bench.task.seed, "batch/mixed, layouts");
        let every: Fields = Field::ALL.iter().copied().filter(|field| field.shape().width() == 3).collect();
        let read: Vec<Field> = about.fields().iter().collect();
        let mut differences = Differences::default();
        for case in bench.goods(law, instance, POINTS - 1)? {
            let own = own_constants(bench, law, instance, &case);
            // Over several blocks now and then: it takes its time.
            let several = |turn: usize| turn.is_multiple_of(8).then_some(BLOCKS);
            let plain = Layout::plain(about);
            for turn in (0..MIXED).take_while(|_| bench.has_time()) {
                // About half of the fields are the same at all points, each of them in its turn in any case.
                let alone = read.get(turn % read.len().max(1));
                let same = read.iter().filter(|field| Some(*field) == alone || random.below(2) == 0);
                let fields: Fields = same.copied().collect();
                let with_vectors = fields.iter().any(is_unit_vector);
                let mut case = shared(&case, if with_vectors { fields.union(every) } else { fields });
                // Constants of each point's own, columns of shared ones, and shared ones given once.
                let constants = if turn % 3 == 2 { Spread::Uniform } else { Spread::PerPoint };
                if turn % 3 == 0 {
                    case.constants_at = Some(own.clone());
                }
                let plain = Layout { constants, ..plain };
                let state = Spread::Strided(1 + turn / 3 % 3);
                let (mixed, skews) = (Some(random.bits()), random.bits());
                let other = Layout { state, mixed, skews, filling: FILLINGS[0], ..plain };
                let what = "columns given once, side by side and with gaps in the same call";
                both(law, instance, (&case, several(turn)), (&plain, &other), what, &mut differences)?;
            }
            for place in (0..MOVED).take_while(|_| bench.has_time()) {
                let skews = if place % 2 == 0 { 1 << (place / 2) } else { random.bits() };
                let what = "arrays of which some begin at an odd multiple of eight bytes";
                let moved = Layout { skews, ..plain };
                both(law, instance, (&case, several(place)), (&plain, &moved), what, &mut differences)?;
            }
        }
        differences.judge(about)
    })
}

/// Whether the law answers a call of one point with good, finite values.
fn answers_well(law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> bool {
    let answers = ask(&law.about, instance, case, &Layout::plain(&law.about));
    answers.is_good() && not_finite(&answers, 0).is_none()
}

/// Constants for each point of a case that go with it; at some points one of them is 0, or as near to it as it may be.
fn own_constants(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> Vec<Vec<f64>> {
    let about = &law.about;
    let known = bench.known_constants(law);
    let mut sampler = bench.sampler(law, &known);
    let mut each = Vec::new();
    for point in 0..case.count {
        // Constants that go with this point; the shared ones do in any case.
        let mut single = case.single(point);
        for _ in 0..10 {
            single.constants = sampler.constants();
            if answers_well(law, instance, &single) {
                break;
            }
            single.constants.clone_from(&case.constants);
        }
        let mut least = single.clone();
        if !about.constants.is_empty() {
            let place = point / 2 % about.constants.len();
            least.constants[place] = nearest(&about.constants[place]);
        }
        each.push(if point % 2 == 1 && answers_well(law, instance, &least) {
            least.constants
        } else {
            single.constants
        });
    }
    each
}

/// Points with constants of their own, against each alone.
fn with_constants_at(bench: &Bench, spreads: &[Spread], what: &str) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        if about.constants.is_empty() {
            return skip("the law has no constants");
        }
        let mut case = bench.good(law, instance, POINTS - 1)?;
        let good = |case: &Case| answers_well(law, instance, case);
        let each = own_constants(bench, law, instance, &case);
        case.constants_at = Some(each.clone());
        let same = Case { constants_at: Some(vec![case.constants.clone()]), ..case.clone() };
        let mut cases = vec![(case.clone(), None), (same, None)];
        for alone in 0..about.constants.len() {
            // The other constants are given once.
            let mixed = each.iter().enumerate().map(|(point, own)| {
                let mut single = case.single(point);
                single.constants.clone_from(&case.constants);
                single.constants[alone] = own[alone];
                if good(&single) { single.constants } else { case.constants.clone() }
            });
            cases.push((Case { constants_at: Some(mixed.collect()), ..case.clone() }, Some(alone)));
        }
        let mut differences = Differences::default();
        for asked in Asked::ways(about) {
            for (case, constant_alone) in &cases {
                let known = Known::of(law, instance, case.clone(), asked)?;
                for constants in spreads {
                    let layout = Layout { constants: *constants, constant_alone: *constant_alone, ..known.layout };
                    for count in [case.count, BLOCKS] {
                        known.compare(&over_and_over(case.count, count), &layout, what, &mut differences)?;
                    }
                }
            }
        }
        differences.judge(about)
    })
}

/// Constants at every point, all and each.
pub(super) fn per_point_constants(bench: &Bench) -> Judged {
    with_constants_at(bench, &[Spread::PerPoint], "constants given for every point")
}

/// Constants with gaps, all and each.
pub(super) fn strided_constants(bench: &Bench) -> Judged {
    let spreads = [Spread::Strided(3), Spread::Strided(2)];
    with_constants_at(bench, &spreads, "constants with gaps between their points")
}
