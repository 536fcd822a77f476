//! Any split, order and layout of the points must give the same answers.

use super::super::harness::arrays::Room;
use super::super::harness::call::{Answers, Asked, Call, Layout, Spread};
use super::super::harness::closeness::AtPoint;
use super::super::harness::points::{Case, Point};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, Differences, POINTS, ask, still_good};
use super::extremes::is_unit_vector;
use crate::law::{Field, Fields};

/// A case with the answers to each of its points alone.
struct Known<'a> {
    law: &'a Law<'a>,
    instance: &'a Instance<'a>,
    case: Case,
    layout: Layout,
    single: Vec<AtPoint>,
}

impl<'a> Known<'a> {
    fn of(law: &'a Law<'a>, instance: &'a Instance<'a>, case: Case, asked: Asked) -> Judged<Self> {
        let layout = Layout { asked, ..Layout::plain(&law.about) };
        let mut single = Vec::new();
        for point in 0..case.count {
            let one = case.single(point);
            let answers = ask(&law.about, instance, &one, &layout);
            still_good(&law.about, &one, &answers, "one point alone")?;
            single.push(answers.at(0));
        }
        Ok(Self { law, instance, case, layout, single })
    }

    /// Compares a batch of these points, by their indices, with the points alone.
    fn compare(&self, indices: &[usize], layout: &Layout, what: &str, differences: &mut Differences) -> Judged<()> {
        let case = self.case.pick(indices);
        let answers = ask(&self.law.about, self.instance, &case, layout);
        self.judge(indices, &case, &answers, what, differences)
    }

    fn judge(
        &self,
        indices: &[usize],
        case: &Case,
        answers: &Answers,
        what: &str,
        differences: &mut Differences,
    ) -> Judged<()> {
        still_good(&self.law.about, case, answers, what)?;
        for (at, index) in indices.iter().enumerate() {
            differences.note(self.single[*index].difference(&answers.at(at)), || {
                let count = indices.len();
                let what = format!("{what}: point {at} of {count} answers otherwise than alone");
                Finding::new(what).at(case.named(&self.law.about, at))
            });
        }
        Ok(())
    }
}

/// Runs `work` with good points known one by one, for every way of asking.
fn over_ways(bench: &Bench, count: usize, work: impl Fn(&Known<'_>, &mut Differences) -> Judged<()>) -> Judged {
    bench.with(|law, instance| {
        let case = bench.good(law, instance, count)?;
        let mut differences = Differences::default();
        for asked in Asked::ways(&law.about) {
            work(&Known::of(law, instance, case.clone(), asked)?, &mut differences)?;
        }
        differences.judge(&law.about)
    })
}

fn all(count: usize) -> Vec<usize> {
    (0..count).collect()
}

/// A batch against its points.
pub(super) fn singles(bench: &Bench) -> Judged {
    over_ways(bench, POINTS, |known, differences| {
        for count in [1, 2, POINTS / 2, POINTS, 8 * POINTS, 16 * POINTS] {
            let indices: Vec<usize> = (0..count).map(|index| index % POINTS).collect();
            known.compare(&indices, &known.layout, &format!("a batch of {count} points"), differences)?;
        }
        Ok(())
    })
}

/// The points in other orders.
pub(super) fn shuffled(bench: &Bench) -> Judged {
    over_ways(bench, 2 * POINTS, |known, differences| {
        let mut random = super::super::harness::random::Random::new(bench.task.seed, "batch/shuffled, orders");
        let mut order = all(known.case.count);
        order.reverse();
        for _ in 0..10 {
            known.compare(&order, &known.layout, "points in another order", differences)?;
            random.shuffle(&mut order);
        }
        // The same point twice.
        let twice: Vec<usize> = order.iter().flat_map(|index| [*index, *index]).collect();
        known.compare(&twice, &known.layout, "points that occur twice", differences)
    })
}

/// Parts of a batch, in the arrays of the whole as a host has them.
pub(super) fn ranges(bench: &Bench) -> Judged {
    over_ways(bench, 2 * POINTS, |known, differences| {
        let count = known.case.count;
        let mut random = super::super::harness::random::Random::new(bench.task.seed, "batch/ranges, parts");
        for _ in 0..30 {
            let first = random.below(count);
            let length = 1 + random.below(count - first);
            let indices: Vec<usize> = (first..first + length).collect();
            // Arrays that begin anywhere but at the multiples that vector instructions like.
            let layout = Layout { skew: 1 + random.below(7), ..known.layout };
            known.compare(&indices, &layout, &format!("points {first} to {}", first + length - 1), differences)?;
        }
        Ok(())
    })
}

/// No points at all.
pub(super) fn empty(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = bench.good(law, instance, 1)?;
        let case = Case { count: 0, ..case };
        for room in [Room::GuardBehind, Room::GuardBefore] {
            for asked in Asked::ways(&law.about) {
                let layout = Layout { room, asked, text: Some(64), ..Layout::plain(&law.about) };
                let answers = ask(&law.about, instance, &case, &layout);
                if answers.status != wearlaw_plugin_api::abi::WL_OK {
                    let finding = Finding::new("a batch without points is refused");
                    return broken(finding.with(format!("status {}", answers.status), "status 0 (WL_OK)"));
                }
            }
        }
        Ok(Verdict::Pass(None))
    })
}

/// Batches of 2 to 67 points.
pub(super) fn odd(bench: &Bench) -> Judged {
    over_ways(bench, 67, |known, differences| {
        for count in (2..=33).chain([47, 63, 64, 65, 67]) {
            known.compare(&all(count), &known.layout, &format!("a batch of {count} points"), differences)?;
        }
        Ok(())
    })
}

/// Points of the largest batch.
const LARGE: usize = 1_000_000;
/// Different points in it: no power of two, so that a remainder meets all of them.
const DIFFERENT: usize = 61;

/// As many points as there is time for, by the time of a smaller batch.
fn affordable(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> usize {
    let mut call = Call::new(&law.about, &case.repeated(4096), &Layout::plain(&law.about));
    call.evaluate(instance);
    let start = std::time::Instant::now();
    call.repeat(instance);
    let each = start.elapsed().as_secs_f64() / 4096.0;
    ((0.5 * bench.budget().as_secs_f64() / each) as usize).clamp(4096, LARGE)
}

/// A batch of a million points.
pub(super) fn large(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = bench.good(law, instance, DIFFERENT)?;
        let known = Known::of(law, instance, case, Asked::values(&law.about))?;
        let count = affordable(bench, law, instance, &known.case);
        let case = known.case.repeated(count);
        bench.label(&format!("a batch of {count} points"));
        let mut call = Call::new(&law.about, &case, &known.layout);
        let answers = call.answers(instance);
        still_good(&law.about, &case, &answers, &format!("a batch of {count} points"))?;
        let mut differences = Differences::default();
        for point in 0..count {
            let expected = &known.single[point % DIFFERENT];
            // Most are the same, and a whole comparison takes its time.
            if expected.increment.to_bits() == answers.increment[point].to_bits() && point % DIFFERENT != 0 {
                continue;
            }
            differences.note(expected.difference(&answers.at(point)), || {
                let what = format!("point {point} of a batch of {count} answers otherwise than alone");
                Finding::new(what).at(case.named(&law.about, point))
            });
        }
        differences.judge(&law.about)
    })
}

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

/// Each field, and all together, given once.
pub(super) fn uniform_fields(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        if about.fields().is_empty() && about.inputs.is_empty() {
            return skip("the law reads no fields");
        }
        let case = bench.good(law, instance, POINTS)?;
        let mut differences = Differences::default();
        let sets = about.fields().iter().map(|field| Fields::EMPTY.with(field)).chain([about.fields()]);
        for fields in sets {
            // A unit vector and what depends on it are taken from one point.
            let with_vectors = fields.iter().any(is_unit_vector) || fields == about.fields();
            let every: Fields = Field::ALL.iter().copied().filter(|field| field.shape().width() == 3).collect();
            let case = shared(&case, if with_vectors { fields.union(every) } else { fields });
            for asked in Asked::ways(about) {
                let layout = Layout { asked, ..Layout::plain(about) };
                let expected = ask(about, instance, &case, &layout);
                if !expected.is_good() {
                    // These values do not go together.
                    continue;
                }
                let answers = ask(about, instance, &case, &Layout { uniform: fields, ..layout });
                let what = format!("{fields} given once (step 0) instead of at every point");
                still_good(about, &case, &answers, &what)?;
                for point in 0..case.count {
                    differences.note(expected.at(point).difference(&answers.at(point)), || {
                        Finding::new(what.clone()).at(case.named(about, point))
                    });
                }
            }
        }
        uniform_inputs(law, instance, &case, &mut differences)?;
        differences.judge(about)
    })
}

fn uniform_inputs(law: &Law<'_>, instance: &Instance<'_>, case: &Case, differences: &mut Differences) -> Judged<()> {
    let about = &law.about;
    if about.inputs.is_empty() {
        return Ok(());
    }
    let inputs = case.point(0).inputs.clone();
    let case = case.map(|point| point.inputs.clone_from(&inputs));
    let layout = Layout::plain(about);
    let expected = ask(about, instance, &case, &layout);
    if !expected.is_good() {
        return Ok(());
    }
    let answers = ask(about, instance, &case, &Layout { inputs: Spread::Uniform, ..layout });
    let what = "inputs given once (step 0) instead of at every point";
    still_good(about, &case, &answers, what)?;
    for point in 0..case.count {
        differences.note(expected.at(point).difference(&answers.at(point)), || {
            Finding::new(what).at(case.named(about, point))
        });
    }
    Ok(())
}

/// Fields, inputs and state with gaps between their points.
pub(super) fn strided_fields(bench: &Bench) -> Judged {
    over_ways(bench, 2 * POINTS - 1, |known, differences| {
        for times in [3, 2, 7] {
            let spread = Spread::Strided(times);
            let layout = Layout { fields: spread, inputs: spread, ..known.layout };
            let what = format!("fields whose values lie {times} times their width apart");
            known.compare(&all(known.case.count), &layout, &what, differences)?;
        }
        Ok(())
    })
}

/// Points with constants of their own, against each alone.
fn with_constants_at(bench: &Bench, spreads: &[Spread], what: &str) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        if about.constants.is_empty() {
            return skip("the law has no constants");
        }
        let mut case = bench.good(law, instance, POINTS)?;
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let mut each = Vec::new();
        for point in 0..case.count {
            // Constants that go with this point; the shared ones do in any case.
            let mut single = case.single(point);
            for _ in 0..10 {
                single.constants = sampler.constants();
                let answers = ask(about, instance, &single, &Layout::plain(about));
                if answers.is_good() && super::bench::not_finite(&answers, 0).is_none() {
                    break;
                }
                single.constants.clone_from(&case.constants);
            }
            each.push(single.constants);
        }
        case.constants_at = Some(each);
        let same = Case { constants_at: Some(vec![case.constants.clone()]), ..case.clone() };
        let mut differences = Differences::default();
        for asked in Asked::ways(about) {
            for case in [&case, &same] {
                let known = Known::of(law, instance, case.clone(), asked)?;
                for constants in spreads {
                    let layout = Layout { constants: *constants, ..known.layout };
                    known.compare(&all(case.count), &layout, what, &mut differences)?;
                }
            }
        }
        differences.judge(about)
    })
}

/// Constants at every point.
pub(super) fn per_point_constants(bench: &Bench) -> Judged {
    with_constants_at(bench, &[Spread::PerPoint], "constants given for every point")
}

/// Constants with gaps.
pub(super) fn strided_constants(bench: &Bench) -> Judged {
    let spreads = [Spread::Strided(3), Spread::Strided(2)];
    with_constants_at(bench, &spreads, "constants with gaps between their points")
}

/// Statuses asked for or not, also where some points are refused.
pub(super) fn status_array(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let case = bench.good(law, instance, POINTS)?;
        let plain = Layout::plain(about);
        let with = Layout { asked: Asked { status: true, ..plain.asked }, ..plain };
        let mut differences = Differences::default();
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let odd = super::faults::odd_cases(&mut sampler, about, 20);
        let mut mixed = vec![case.clone()];
        for other in odd.chunks(5) {
            let mut case = case.clone();
            for (at, other) in other.iter().enumerate() {
                case.points[3 * at + 1] = other.points[0].clone();
            }
            mixed.push(case);
        }
        for case in mixed {
            let (silent, told) = (ask(about, instance, &case, &plain), ask(about, instance, &case, &with));
            let worst = told.point_status.iter().copied().max().unwrap_or(0);
            let input = || case.named(about, told.point_status.iter().position(|s| *s == worst).unwrap_or(0));
            if silent.status != told.status {
                let finding = Finding::new("asking for statuses changes the status of the call").at(input());
                let expected = format!("status {}, as without the array", silent.status);
                return broken(finding.with(format!("status {}", told.status), expected));
            }
            if worst != told.status {
                let finding = Finding::new("the call does not return the worst status of its points").at(input());
                return broken(finding.with(format!("status {}", told.status), format!("status {worst}")));
            }
            for point in (0..case.count).filter(|point| told.is_good_at(*point) && silent.is_good()) {
                differences.note(silent.at(point).difference(&told.at(point)), || {
                    Finding::new("asking for statuses changes a value").at(case.named(about, point))
                });
            }
        }
        differences.judge(about)
    })
}
