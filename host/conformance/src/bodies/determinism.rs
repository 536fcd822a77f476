//! The same call must give the same answer, whoever asks and whatever was asked before.

use super::super::harness::call::{Answers, Asked, Layout};
use super::super::harness::closeness::AtPoint;
use super::super::harness::points::Case;
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict};
use super::super::outcome::Finding;
use super::bench::{Bench, Differences, POINTS, ask, still_good};
use super::options::altered;

/// Answers to a case in every way of asking.
pub(super) fn all_ways(law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> Vec<Answers> {
    let ways = Asked::ways(&law.about).into_iter();
    ways.map(|asked| ask(&law.about, instance, case, &Layout { asked, ..Layout::plain(&law.about) })).collect()
}

/// Notes the differences between two sets of answers to the same case.
pub(super) fn compare(
    law: &Law<'_>,
    case: &Case,
    (one, other): (&[Answers], &[Answers]),
    what: &str,
    differences: &mut Differences,
) -> Judged<()> {
    for (one, other) in one.iter().zip(other) {
        still_good(&law.about, case, other, what)?;
        for point in 0..case.count {
            let difference = one.at(point).difference(&other.at(point));
            differences.note(difference, || Finding::new(what).at(case.named(&law.about, point)));
        }
    }
    Ok(())
}

/// The same call several times, with others in between.
pub(super) fn repeat(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = bench.good(law, instance, POINTS)?;
        let other = case.map(|point| point.scale(wearlaw_law::Field::Pressure, 0.5));
        let first = all_ways(law, instance, &case);
        let mut differences = Differences::default();
        for time in 0..8 {
            if time > 3 {
                all_ways(law, instance, &other);
            }
            let again = all_ways(law, instance, &case);
            compare(
                law,
                &case,
                (&first, &again),
                "the same call gives another answer when it is made again",
                &mut differences,
            )?;
        }
        differences.judge(&law.about)
    })
}

/// The same call in another thread.
pub(super) fn thread(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = bench.good(law, instance, POINTS)?;
        let first = all_ways(law, instance, &case);
        let mut differences = Differences::default();
        for _ in 0..3 {
            let again = std::thread::scope(|scope| {
                let work = || all_ways(law, instance, &case);
                scope.spawn(work).join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            });
            compare(
                law,
                &case,
                (&first, &again),
                "the same call gives another answer in another thread",
                &mut differences,
            )?;
        }
        differences.judge(&law.about)
    })
}

/// Leaves the bits of the answers to the checker, which hands them to another process; there they are compared.
pub(super) fn process(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = bench.good(law, instance, POINTS)?;
        let answers = all_ways(law, instance, &case);
        let points: Vec<(usize, AtPoint)> = answers.iter().flat_map(|way| way.each().into_iter().enumerate()).collect();
        if bench.task.bits.is_empty() {
            *bench.bits() = points.iter().flat_map(|(_, point)| point.bits()).collect();
            return Ok(Verdict::Pass(None));
        }
        let mut other = bench.task.bits.iter().copied();
        let mut differences = Differences::default();
        for (index, point) in points {
            let theirs = point.like(&mut other);
            differences.note(theirs.difference(&point), || {
                let what = "the same call gives another answer in another process";
                Finding::new(what).at(case.named(&law.about, index))
            });
        }
        differences.judge(&law.about)
    })
}

/// The same call after the instance was destroyed and another one made.
pub(super) fn recreate(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let law = library.law(&bench.task)?;
    let first = law.instance(&bench.task)?;
    let case = bench.good(&law, &first, POINTS)?;
    let before = all_ways(&law, &first, &case);
    drop(first);
    let mut differences = Differences::default();
    for _ in 0..4 {
        let next = law.instance(&bench.task)?;
        let again = all_ways(&law, &next, &case);
        let what = "the same call gives another answer in another instance";
        compare(&law, &case, (&before, &again), what, &mut differences)?;
    }
    // Of two instances either one, once the other is gone.
    for first_goes in [true, false] {
        let (one, other) = (law.instance(&bench.task)?, law.instance(&bench.task)?);
        let (gone, kept) = if first_goes { (one, other) } else { (other, one) };
        drop(gone);
        let again = all_ways(&law, &kept, &case);
        let what = "an instance gives another answer once another one was destroyed";
        compare(&law, &case, (&before, &again), what, &mut differences)?;
    }
    // The text of its options is the host's again once it is made.
    let mut alone = law.instance(&bench.task)?;
    alone.lose_options();
    let again = all_ways(&law, &alone, &case);
    let what = "an instance gives another answer once the text of its options is gone";
    compare(&law, &case, (&before, &again), what, &mut differences)?;
    // One with other options is another one.
    let mut others = 0;
    for options in altered(&bench.task) {
        let kept = law.instance(&bench.task)?;
        let Ok(other) = law.create(options.words.as_deref()) else { continue };
        others += 1;
        all_ways(&law, &other, &case);
        let again = all_ways(&law, &kept, &case);
        let what = format!("an instance gives another answer beside one with the options {}", options.label);
        compare(&law, &case, (&before, &again), &what, &mut differences)?;
    }
    Ok(match differences.judge(&law.about)? {
        Verdict::Pass(Some(note)) if others > 0 => {
            Verdict::Pass(Some(format!("{note}; beside instances with {others} other options")))
        }
        other => other,
    })
}
