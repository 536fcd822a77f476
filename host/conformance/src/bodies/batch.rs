//! Any split, order and layout of the points must give the same answers.

use wearlaw_plugin_api::abi::WL_OK;

use super::super::harness::arrays::Room;
use super::super::harness::call::{Answers, Asked, Call, Layout};
use super::super::harness::closeness::AtPoint;
use super::super::harness::points::{Case, Point};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken};
use super::super::outcome::Finding;
use super::bench::{Bench, Differences, POINTS, ask, not_finite, still_good};
use super::faults::{odd_points, wild_point};
use wearlaw_law::fields::Shape;
use wearlaw_law::{Claim, Field, Fields};

/// Points whose fields run over all decades, in a batch of ordinary ones.
const WILD: usize = 40;

/// Points of a batch that are all far from ordinary in one field: a law that looks at a batch as a whole, to take a
/// shorter way, never sees that among ordinary points. No remainder of a vectorised loop, which would take another way.
const FAR: usize = 4 * VECTOR;
const VECTOR: usize = 8;
/// By how much, and by how much its other scalar fields make up for it: then a product has digits to lose on the way.
const FAR_DECADES: [[(f64, f64); 2]; 3] =
    [[(1e-312, 1e-300), (1.0, 1.0)], [(1e-312, 1e-300), (1e2, 1e12)], [(1e285, 1e299), (1.0, 1.0)]];

/// A case with the answers to each of its points alone.
pub(super) struct Known<'a> {
    law: &'a Law<'a>,
    instance: &'a Instance<'a>,
    pub(super) case: Case,
    pub(super) layout: Layout,
    single: Vec<AtPoint>,
}

impl<'a> Known<'a> {
    pub(super) fn of(law: &'a Law<'a>, instance: &'a Instance<'a>, case: Case, asked: Asked) -> Judged<Self> {
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

    /// These points, and behind them odd ones that the law answers too.
    fn with_odd_points(&self, bench: &Bench) -> Judged<Self> {
        let about = &self.law.about;
        let mut sampler = bench.sampler(self.law, &[]);
        let mut odd = odd_points(about, &self.case.single(0));
        odd.extend((0..WILD).map(|_| wild_point(&mut sampler, about, &self.case.single(0))));
        self.answered(self.case.points.clone(), odd)
    }

    /// These points with a scalar field, and the others, scaled at every one by so many decades, as far as the law
    /// answers them.
    fn far(&self, bench: &Bench, field: Field, [own, others]: [(f64, f64); 2]) -> Judged<Self> {
        let mut sampler = bench.sampler(self.law, &[]);
        let far = over_and_over(self.case.count, FAR).into_iter().map(|point| {
            self.case.single(point).map(|point| {
                for scaled in scalars(self.fields()) {
                    let (low, high) = if scaled == field { own } else { others };
                    point.scale(scaled, sampler.random.decades(low, high));
                }
            })
        });
        self.answered(Vec::new(), far.collect())
    }

    /// `first`, and behind them the points of those calls that the law answers.
    fn answered(&self, first: Vec<Point>, mut calls: Vec<Case>) -> Judged<Self> {
        calls.retain(|single| {
            let answers = ask(&self.law.about, self.instance, single, &self.layout);
            answers.is_good() && not_finite(&answers, 0).is_none()
        });
        let points = first.into_iter().chain(calls.into_iter().flat_map(|single| single.points)).collect();
        let case = Case::new(self.case.numbers, self.case.constants.clone(), points);
        Self::of(self.law, self.instance, case, self.layout.asked)
    }

    /// The fields that the law reads or uses.
    pub(super) fn fields(&self) -> Fields {
        self.law.about.fields()
    }

    /// Compares a batch of these points, by their indices, with the points alone.
    pub(super) fn compare(
        &self,
        indices: &[usize],
        layout: &Layout,
        what: &str,
        differences: &mut Differences,
    ) -> Judged<()> {
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

/// The scalar fields of a set.
fn scalars(fields: Fields) -> impl Iterator<Item = Field> {
    Field::ALL.iter().copied().filter(move |field| fields.contains(*field) && field.shape() == Shape::Scalar)
}

/// Runs `work` with good points known one by one, for every way of asking.
pub(super) fn over_ways(
    bench: &Bench,
    count: usize,
    work: impl Fn(&Known<'_>, &mut Differences) -> Judged<()>,
) -> Judged {
    bench.with(|law, instance| {
        let mut differences = Differences::default();
        for case in bench.goods(law, instance, count)? {
            for asked in Asked::ways(&law.about) {
                work(&Known::of(law, instance, case.clone(), asked)?, &mut differences)?;
            }
        }
        differences.judge(&law.about)
    })
}

fn all(count: usize) -> Vec<usize> {
    (0..count).collect()
}

/// The indices of `count` points, which are `different` ones over and over.
pub(super) fn over_and_over(different: usize, count: usize) -> Vec<usize> {
    (0..count).map(|index| index % different).collect()
}

/// A batch against its points: ordinary ones, odd ones among them, and all of them far from ordinary in one field.
pub(super) fn singles(bench: &Bench) -> Judged {
    over_ways(bench, POINTS, |known, differences| {
        for count in [1, 2, POINTS / 2, POINTS, 8 * POINTS, 16 * POINTS] {
            let indices = over_and_over(POINTS, count);
            known.compare(&indices, &known.layout, &format!("a batch of {count} points"), differences)?;
        }
        // A law that does not claim the same bits may take its products in another order at some points, which far from
        // ordinary numbers costs digits.
        let same = known.law.about.claims(Claim::Deterministic);
        for field in scalars(known.fields()).filter(|_| same) {
            for decades in FAR_DECADES {
                let far = known.far(bench, field, decades)?;
                let what = format!("a batch whose {} is far from ordinary at every point", field.name());
                far.compare(&all(far.case.count / VECTOR * VECTOR), &far.layout, &what, differences)?;
            }
        }
        let known = known.with_odd_points(bench)?;
        let (ordinary, count) = (all(POINTS), known.case.count);
        for odd in POINTS..count {
            let mut indices = ordinary.clone();
            indices[(5 * odd) % POINTS] = odd;
            known.compare(&indices, &known.layout, "a batch of ordinary points and an odd one", differences)?;
        }
        // No remainder here either, which is another check's.
        let whole = all(count / VECTOR * VECTOR);
        known.compare(&whole, &known.layout, "a batch of ordinary points and odd ones", differences)
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
                if answers.status != WL_OK {
                    let finding = Finding::new("a batch without points is refused");
                    return broken(finding.with(format!("status {}", answers.status), "status 0 (WL_OK)"));
                }
            }
        }
        Ok(Verdict::Pass(None))
    })
}

/// Batches of 2 to 67 points, and of about as many as the blocks that a law may work in.
pub(super) fn odd(bench: &Bench) -> Judged {
    over_ways(bench, 67, |known, differences| {
        let blocks = [128, 256, 512, 1024, 4096].into_iter().flat_map(|block| [block - 1, block, block + 1]);
        for count in (2..=33).chain([47, 63, 64, 65, 67]).chain(blocks) {
            let indices = over_and_over(known.case.count, count);
            known.compare(&indices, &known.layout, &format!("a batch of {count} points"), differences)?;
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
    ((0.25 * bench.budget().as_secs_f64() / each) as usize).clamp(4096, LARGE)
}

/// A batch of a million points.
pub(super) fn large(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = bench.good(law, instance, DIFFERENT)?;
        let known = Known::of(law, instance, case, Asked::values(&law.about))?;
        let count = affordable(bench, law, instance, &known.case);
        let case = known.case.repeated(count);
        let mut differences = Differences::default();
        for asked in [Asked::values(&law.about), Asked::everything(&law.about)] {
            bench.label(&format!("a batch of {count} points"));
            let layout = Layout { asked, ..known.layout };
            // In a thread as the host's are: the stack is theirs, too.
            let answers = std::thread::scope(|scope| {
                let work = || ask(&law.about, instance, &case, &layout);
                scope.spawn(work).join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            });
            still_good(&law.about, &case, &answers, &format!("a batch of {count} points"))?;
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
        }
        differences.judge(&law.about)
    })
}
