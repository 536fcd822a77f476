//! Any split, order and layout of the points must give the same answers.

use wearlaw_plugin_api::abi::{WL_CUT_STEP, WL_OK};

use super::super::harness::arrays::Room;
use super::super::harness::call::{Answers, Asked, Call, Layout};
use super::super::harness::closeness::AtPoint;
use super::super::harness::points::{Case, number_text};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken};
use super::super::outcome::Finding;
use super::bench::{Bench, Differences, POINTS, ask, not_finite, still_good};
use super::faults::{odd_cases, odd_points, wild_point};
use crate::law::Fields;

/// Points whose fields run over all decades, in a batch of ordinary ones.
const WILD: usize = 40;

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
        odd.retain(|single| {
            let answers = ask(about, self.instance, single, &self.layout);
            answers.is_good() && not_finite(&answers, 0).is_none()
        });
        let points = self.case.points.iter().cloned().chain(odd.into_iter().flat_map(|single| single.points)).collect();
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

/// A batch against its points, ordinary ones and odd ones among them.
pub(super) fn singles(bench: &Bench) -> Judged {
    over_ways(bench, POINTS, |known, differences| {
        for count in [1, 2, POINTS / 2, POINTS, 8 * POINTS, 16 * POINTS] {
            let indices = over_and_over(POINTS, count);
            known.compare(&indices, &known.layout, &format!("a batch of {count} points"), differences)?;
        }
        let known = known.with_odd_points(bench)?;
        let (ordinary, count) = (all(POINTS), known.case.count);
        for odd in POINTS..count {
            let mut indices = ordinary.clone();
            indices[(5 * odd) % POINTS] = odd;
            known.compare(&indices, &known.layout, "a batch of ordinary points and an odd one", differences)?;
        }
        known.compare(&all(count), &known.layout, "a batch of ordinary points and odd ones", differences)
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
        let blocks = [128, 256, 512, 1024].into_iter().flat_map(|block| [block - 1, block, block + 1]);
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
        let odd = odd_cases(&mut sampler, about, 20);
        let mut mixed = vec![case.clone()];
        for (turn, other) in odd.chunks(5).enumerate() {
            // Every other time beyond the first block of a law that works in blocks.
            let before = if turn % 2 == 0 { 0 } else { AHEAD };
            let mut case = case.pick(&over_and_over(POINTS, before + POINTS));
            for (at, other) in other.iter().enumerate() {
                case.points[before + 3 * at + 1] = other.points[0].clone();
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
            places(law, instance, &case, [&silent, &told], &told.point_status)?;
            for point in (0..case.count).filter(|point| told.is_good_at(*point) && silent.is_good()) {
                differences.note(silent.at(point).difference(&told.at(point)), || {
                    Finding::new("asking for statuses changes a value").at(case.named(about, point))
                });
            }
        }
        differences.judge(about)
    })
}

/// Points ahead of the refused ones: more than a block of the helpers has.
const AHEAD: usize = 259;

/// The statuses stand at their points, and the first bad point is one that is bad.
fn places(law: &Law<'_>, instance: &Instance<'_>, case: &Case, answers: [&Answers; 2], statuses: &[i32]) -> Judged<()> {
    let about = &law.about;
    for (point, status) in statuses.iter().copied().enumerate() {
        let alone = match status {
            // Looked at where it is read anyway.
            WL_OK if point < AHEAD && case.count > AHEAD => continue,
            _ => ask(about, instance, &case.single(point), &Layout::plain(about)).status,
        };
        if alone != status {
            let what = format!("point {point} of {} has another status than alone", case.count);
            let finding = Finding::new(what).at(case.named(about, point));
            return broken(finding.with(format!("status {status}"), format!("status {alone}")));
        }
    }
    for answers in answers {
        let is_bad = |first: i64| usize::try_from(first).is_ok_and(|at| statuses.get(at).is_some_and(|s| *s != WL_OK));
        if answers.status != WL_OK && answers.first_bad != -1 && !is_bad(answers.first_bad) {
            let finding = Finding::new("`first_bad` is no point that is bad").at(case.named(about, 0));
            let expected = "the index of a bad point, or -1 as before the call";
            return broken(finding.with(format!("first_bad {}", answers.first_bad), expected));
        }
        if answers.status == WL_CUT_STEP && !(0.0..1.0).contains(&answers.dt_factor) {
            let finding = Finding::new("a shorter substep is asked for by a factor that shortens none");
            let found = format!("dt_factor {}", number_text(answers.dt_factor));
            return broken(finding.with(found, "in (0, 1), or 0 as before the call").at(case.named(about, 0)));
        }
    }
    Ok(())
}
