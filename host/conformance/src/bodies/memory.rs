//! Arrays with guards, arrays that cannot be written, outputs that are not written, and pointers that are NULL.

use super::super::harness::arrays::Room;
use super::super::harness::call::{Answers, Asked, Given, Layout, Spread};
use super::super::harness::points::Case;
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, Differences, ask, finite_or_status, still_good};
use super::faults::odd_cases;
use wearlaw_law::{Fields, LawDescriptor};

/// Points of the batches: one, remainders of vectorised loops, whole ones, more than a block.
const COUNTS: [usize; 8] = [1, 2, 3, 8, 16, 31, 64, 259];

/// Calls of every size, good and refused, in every way of asking, laid out by `layout`.
fn over_sizes(
    bench: &Bench,
    layout: impl Fn(&LawDescriptor) -> Layout,
    look: impl Fn(&Law<'_>, &Instance<'_>, &Case, &Layout) -> Judged<()>,
) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let goods = bench.goods(law, instance, 16)?;
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let mut calls = 0;
        let sizes = goods.iter().flat_map(|good| COUNTS.iter().map(|count| good.repeated(*count)));
        let cases = sizes.chain(odd_cases(&mut sampler, about, 10));
        for case in cases {
            for asked in Asked::ways(about) {
                look(law, instance, &case, &Layout { asked, ..layout(about) })?;
                calls += 1;
            }
        }
        Ok(Verdict::Pass(Some(format!("{calls} calls"))))
    })
}

/// A page that nobody may touch right behind every array.
pub(super) fn after(bench: &Bench) -> Judged {
    let layout = |law: &LawDescriptor| Layout { room: Room::GuardBehind, ..Layout::plain(law) };
    over_sizes(bench, layout, |law, instance, case, layout| {
        ask(&law.about, instance, case, layout);
        // What is given once is one value long, and what has gaps ends with its last value.
        let gaps = Spread::Strided(3);
        ask(&law.about, instance, case, &Layout { uniform: law.about.fields(), inputs: Spread::Uniform, ..*layout });
        ask(
            &law.about,
            instance,
            case,
            &Layout { fields: gaps, inputs: gaps, state: gaps, constants: gaps, ..*layout },
        );
        Ok(())
    })
}

/// A page that nobody may touch right before every array.
pub(super) fn before(bench: &Bench) -> Judged {
    let layout = |law: &LawDescriptor| Layout { room: Room::GuardBefore, ..Layout::plain(law) };
    over_sizes(bench, layout, |law, instance, case, layout| {
        ask(&law.about, instance, case, layout);
        Ok(())
    })
}

/// Inputs and the view in pages that can only be read.
pub(super) fn inputs(bench: &Bench) -> Judged {
    let layout = |law: &LawDescriptor| Layout { room: Room::GuardBefore, sealed: true, ..Layout::plain(law) };
    over_sizes(bench, layout, |law, instance, case, layout| {
        ask(&law.about, instance, case, layout);
        Ok(())
    })
}

/// Two different NaNs that no computation gives.
pub(super) const FILLINGS: [u64; 2] = [0x7ff8_dead_beef_0001, 0x7ff8_c0de_cafe_0002];

/// The first item that holds what it was filled with in both calls: its name and point. Values of a refused point are
/// void, but its status is not; a call that is refused as a whole has no points.
fn untouched(one: &Answers, other: &Answers, count: usize) -> Option<(&'static str, usize)> {
    let [first, second] = FILLINGS.map(|filling| filling as i32);
    let status = |at: &usize| one.point_status[*at] == first && other.point_status[*at] == second;
    let statuses = one.point_status.len();
    let as_a_whole = !one.is_good() && (0..statuses).all(|at| status(&at));
    if let Some(point) = (0..statuses).find(status).filter(|_| !as_a_whole) {
        return Some(("status", point));
    }
    let items = [
        ("increment", &one.increment, &other.increment),
        ("direction", &one.direction, &other.direction),
        ("d_pressure", &one.d_pressure, &other.d_pressure),
    ];
    for (name, one_value, other_value) in items {
        let width = one_value.len() / count.max(1);
        let same = |at: &usize| one_value[*at].to_bits() == FILLINGS[0] && other_value[*at].to_bits() == FILLINGS[1];
        let mut points = (0..one_value.len()).filter(same).map(|at| at / width);
        if let Some(point) = points.find(|point| one.is_good_at(*point)) {
            return Some((name, point));
        }
    }
    None
}

/// Outputs that hold something else before the call.
pub(super) fn unwritten(bench: &Bench) -> Judged {
    over_sizes(bench, Layout::plain, |law, instance, case, layout| {
        let [one, other] = FILLINGS.map(|filling| ask(&law.about, instance, case, &Layout { filling, ..*layout }));
        match untouched(&one, &other, case.count) {
            None => Ok(()),
            Some((item, point)) => {
                let finding = Finding::new(format!("{item} of point {point} of {} is not written", case.count));
                let found = "what the array held before the call";
                broken(
                    finding
                        .with(found, format!("a value of its own (status {})", one.status))
                        .at(case.named(&law.about, point)),
                )
            }
        }
    })
}

/// As a host calls: what the law does not declare is NULL.
pub(super) fn undeclared(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let case = bench.good(law, instance, 16)?;
        let mut differences = Differences::default();
        for asked in Asked::ways(about) {
            let all = Layout { asked, ..Layout::plain(about) };
            let (with, without) = (
                ask(about, instance, &case, &all),
                ask(about, instance, &case, &Layout { given: Given::Declared, ..all }),
            );
            let what = "with only the fields that the law declares";
            still_good(about, &case, &without, what)?;
            for point in 0..case.count {
                differences.note(with.at(point).difference(&without.at(point)), || {
                    let what = "the answer depends on a field that the law does not declare in reads or uses";
                    Finding::new(what).at(case.named(about, point))
                });
            }
        }
        differences.judge(about)
    })
}

/// Fields that the law merely uses are absent, all and each.
pub(super) fn uses(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        if about.uses.is_empty() {
            return skip("the law uses no fields beside those that it reads");
        }
        let case = bench.good(law, instance, 16)?;
        let sets = about.uses.iter().map(|field| Fields::EMPTY.with(field)).chain([about.uses]);
        for absent in sets {
            for asked in Asked::ways(about) {
                let layout = Layout { asked, absent, given: Given::Declared, ..Layout::plain(about) };
                let answers = ask(about, instance, &case, &layout);
                let what = format!("without {absent}, which the law only uses, there is no answer and no status");
                finite_or_status(about, &case, &answers, &what)?;
                if answers.status == wearlaw_plugin_api::abi::WL_MISSING_INPUT {
                    let finding = Finding::new(format!("it refuses to go without {absent}, which it only uses"));
                    let expected = "an answer, or the field in reads";
                    return broken(finding.with("status 4 (WL_MISSING_INPUT)", expected).at(case.named(about, 0)));
                }
            }
        }
        Ok(Verdict::Pass(None))
    })
}

/// Outputs that are not asked for are NULL: all of them, and each.
pub(super) fn outputs(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let case = bench.good(law, instance, 16)?;
        let all = Asked::everything(about);
        let expected = ask(about, instance, &case, &Layout::everything(about));
        still_good(about, &case, &expected, "with every output asked for")?;
        let ways = [
            Asked::NOTHING,
            Asked { direction: all.direction, ..Asked::NOTHING },
            Asked { state: all.state, ..Asked::NOTHING },
            Asked { d_pressure: all.d_pressure, ..Asked::NOTHING },
            Asked { status: true, ..Asked::NOTHING },
            Asked { status: false, ..all },
            Asked { d_pressure: false, ..all },
            // The values of these two are compared; what statuses and derivatives change is told by their own checks.
            Asked { state: false, ..all },
            Asked { direction: false, ..all },
        ];
        let mut differences = Differences::default();
        for asked in ways {
            for text in [None, Some(64)] {
                let answers = ask(about, instance, &case, &Layout { asked, text, ..Layout::plain(about) });
                still_good(about, &case, &answers, "with some outputs not asked for")?;
                // A law that never answers the same is told by another check too.
                let again = ask(about, instance, &case, &Layout::everything(about));
                let compared = asked.status && asked.d_pressure == all.d_pressure && again == expected;
                for point in (0..case.count).filter(|_| compared) {
                    differences.note(expected.at(point).difference(&answers.at(point)), || {
                        Finding::new("what is asked for changes a value").at(case.named(about, point))
                    });
                }
            }
        }
        differences.judge(about)
    })
}
