//! The floating-point environment: what the library found wrong in each phase of its life.

use super::super::harness::call::{Call, Layout};
use super::super::harness::points::Case;
use super::super::harness::subject::Library;
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::super::slate::Phase;
use super::bench::{Bench, POINTS, ask};
use super::faults::odd_cases;
use super::options::others;
use wearlaw_law::float_env::FloatEnv;

/// Calls that are made in a row.
const MANY: usize = 30_000;

/// The verdict on what was changed in some phases.
fn judge(library: &Library, phases: &[Phase], hint: &str) -> Judged {
    match library.floats().into_iter().find(|(phase, _)| phases.contains(phase)) {
        Some((phase, change)) => {
            let what = format!("the floating-point environment is changed {}{hint}", phase.words());
            broken(Finding::new(what).with(change, "as it was found"))
        }
        None => Ok(Verdict::Pass(None)),
    }
}

/// After loading and describing.
pub(super) fn load(bench: &Bench) -> Judged {
    let library = bench.open()?;
    // What is malformed is told by other checks.
    let _ = library.law(&bench.task);
    let hint = " (gcc and gfortran link code for it into a library if -ffast-math stands on the command that links)";
    judge(&library, &[Phase::Opening, Phase::Entry, Phase::Describing], hint)
}

/// Runs an instance through good and odd inputs, and through many calls.
fn exercise(bench: &Bench, library: &Library) -> Judged<()> {
    let law = library.law(&bench.task)?;
    let instance = law.instance(&bench.task)?;
    let known = bench.known_constants(&law);
    let mut sampler = bench.sampler(&law, &known);
    let good = sampler.good(&instance, POINTS);
    for case in good.into_iter().chain(odd_cases(&mut sampler, &law.about, 40)) {
        ask(&law.about, &instance, &case, &Layout { text: Some(256), ..Layout::everything(&law.about) });
    }
    let Some(good) = sampler.good(&instance, 1) else { return Ok(()) };
    ask(&law.about, &instance, &Case { count: 0, ..good.clone() }, &Layout::everything(&law.about));
    // What happens once in many calls.
    let mut call = Call::new(&law.about, &good, &Layout::everything(&law.about));
    bench.label("many calls");
    (0..MANY).take_while(|_| bench.has_time()).for_each(|_| {
        call.repeat(&instance);
    });
    Ok(())
}

/// After `create`.
pub(super) fn create(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let law = library.law(&bench.task)?;
    if law.table.create.is_none() {
        return skip("the law has no create");
    }
    drop(law.create(None));
    // What is refused leaves it alone as well.
    for options in others(&bench.task) {
        drop(law.create(options.words.as_deref()));
    }
    drop(law.instance(&bench.task)?);
    judge(&library, &[Phase::Creating], "")
}

/// After every evaluation.
pub(super) fn evaluate(bench: &Bench) -> Judged {
    let library = bench.open()?;
    exercise(bench, &library)?;
    judge(&library, &[Phase::Evaluating], "")
}

/// After `destroy`.
pub(super) fn destroy(bench: &Bench) -> Judged {
    let library = bench.open()?;
    if library.law(&bench.task)?.table.destroy.is_none() {
        return skip("the law has no destroy");
    }
    exercise(bench, &library)?;
    judge(&library, &[Phase::Destroying], "")
}

/// In a thread that starts once the library is loaded.
pub(super) fn thread(bench: &Bench) -> Judged {
    let before = FloatEnv::capture();
    let library = bench.open()?;
    let (start, exercised) = std::thread::scope(|scope| {
        let work = || (before.changed_since(), exercise(bench, &library));
        scope.spawn(work).join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    exercised?;
    if let Some(change) = start {
        let finding = Finding::new("a thread started after loading begins with another floating-point environment");
        return broken(finding.with(change.to_string(), "as before the library was loaded"));
    }
    judge(&library, &[Phase::Creating, Phase::Evaluating, Phase::Destroying], ", in a thread started after loading")
}
