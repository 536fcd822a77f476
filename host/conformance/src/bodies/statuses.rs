//! Asking for statuses changes nothing else, and the call returns the worst of them.

use wearlaw_plugin_api::abi::{WL_CUT_STEP, WL_OK};

use super::super::harness::call::{Answers, Asked, Layout};
use super::super::harness::points::{Case, number_text};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, broken};
use super::super::outcome::Finding;
use super::batch::over_and_over;
use super::bench::{Bench, Differences, POINTS, ask};
use super::faults::odd_cases;

/// Statuses asked for or not, in every way of asking for the rest, also where some points are refused.
pub(super) fn status_array(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let known = bench.known_constants(law);
        let mut differences = Differences::default();
        for case in bench.goods(law, instance, POINTS)? {
            let odd = odd_cases(&mut bench.sampler(law, &known), about, 20);
            for case in mixtures(case, &odd) {
                for asked in Asked::ways(about).into_iter().filter(|asked| !asked.status) {
                    compare(law, instance, &case, asked, &mut differences)?;
                }
            }
        }
        differences.judge(about)
    })
}

/// An ordinary batch, and the same with odd points in it: one in each, and several together.
fn mixtures(ordinary: Case, odd: &[Case]) -> Vec<Case> {
    let mut mixed: Vec<Case> = odd
        .iter()
        .enumerate()
        .map(|(turn, other)| {
            let mut case = ordinary.clone();
            case.points[(5 * turn) % POINTS] = other.points[0].clone();
            case
        })
        .collect();
    for (turn, other) in odd.chunks(5).enumerate() {
        // Every other time beyond the first block of a law that works in blocks.
        let before = if turn % 2 == 0 { 0 } else { AHEAD };
        let mut case = ordinary.pick(&over_and_over(POINTS, before + POINTS));
        for (at, other) in other.iter().enumerate() {
            case.points[before + 3 * at + 1] = other.points[0].clone();
        }
        mixed.push(case);
    }
    mixed.push(ordinary);
    mixed
}

/// Holds a call without the array to the same with it.
fn compare(
    law: &Law<'_>,
    instance: &Instance<'_>,
    case: &Case,
    asked: Asked,
    differences: &mut Differences,
) -> Judged<()> {
    let about = &law.about;
    let plain = Layout { asked, ..Layout::plain(about) };
    let with = Layout { asked: Asked { status: true, ..asked }, ..plain };
    let (silent, told) = (ask(about, instance, case, &plain), ask(about, instance, case, &with));
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
    places(law, instance, case, [&silent, &told], &told.point_status)?;
    for point in (0..case.count).filter(|point| told.is_good_at(*point) && silent.is_good()) {
        differences.note(silent.at(point).difference(&told.at(point)), || {
            Finding::new("asking for statuses changes a value").at(case.named(about, point))
        });
    }
    Ok(())
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
