//! Named references of solved scenes: what they say of a scene that they do not cover, before it runs.

use crate::solved::{Case, archard};
use wearlaw::record::{End, Event, Nobody, Observer, Wish};
use wearlaw::solve::{Run, SolveError};

const BALL: &str = "[law]\nuse = \"archard\"\nconstants = [1e-14, 1.0, 1.0, 1.0]\n\
    [contact]\nmodel = \"halfspace\"\nmodulus = 1e11\n[grid]\nsize = [2e-4, 2e-4]\ncells = [8, 8]\n\
    [surface]\nshape = \"sphere\"\nradius = 5e-3\n[[step]]\nduration = 0.1\nload = 1.0\nvelocity = 1.0\n\
    [integrator]\nsubsteps = 1\n";

/// The refusal of a ball on flat after some replacements; empty where it is not refused.
fn refusal(kind: &str, changes: &[(&str, &str)]) -> String {
    let mut scene = BALL.to_owned();
    for (from, to) in changes {
        assert!(scene.contains(from), "{from}");
        scene = scene.replace(from, to);
    }
    let law = archard();
    let plan = Case::text(&format!("{scene}[reference]\nkind = \"{kind}\"\n")).plan(&law);
    let run = Run::prepare(&plan, &law).expect("a surface");
    run.check_reference().err().map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn what_is_not_covered_is_told_before_the_run() {
    let springs = [("model = \"halfspace\"\nmodulus = 1e11", "model = \"foundation\"\nstiffness = 1e13")];
    let held = [springs[0], ("load = 1.0", "approach = 1e-6")];
    for (kind, changes, reason) in [
        ("hertz-scar", &[][..], ""),
        ("hertz-scar", &[("1.0, 1.0, 1.0]", "1.0, 1.5, 1.0]")], "the pressure exponent is 1.5, expected 1"),
        ("hertz-scar", &[("shape = \"sphere\"\nradius = 5e-3", "shape = \"cone\"\nangle = 1.0")], "neither a sphere"),
        ("hertz-scar", &[("modulus = 1e11", "modulus = 1e11\nboundary = \"periodic\"")], "no half-space with a free"),
        ("hertz-scar", &[("load = 1.0", "load = 1.0\nramp = [\"load\"]")], "not the same throughout"),
        ("hertz-scar", &[("load = 1.0", "approach = 1e-7")], "expected a load"),
        ("hertz-scar", &[("load = 1.0", "load = 1.0\nstick = 1e-5")], "differs from cell to cell"),
        ("hertz-scar", &[("duration = 0.1", "duration = 1e9")], "expected at most 1e4"),
        ("hertz-scar", &[("use = \"archard\"", "use = \"archard\"\naverage = true")], "averaged"),
        ("hertz-scar", &[("use = \"archard\"", "use = \"archard\"\nbasis = \"nodal-stress\"")], "nodal stresses"),
        ("hertz-scar", &[("use = \"archard\"", "use = \"archard\"\nmode = \"post\"")], "postprocessing"),
        ("hertz", &[], "the surface wears away"),
        ("hertz", &[("velocity = 1.0", "velocity = 0.0")], ""),
        ("hertz", &[("use = \"archard\"", "use = \"archard\"\nmode = \"post\"")], ""),
        ("archard-prescribed", &[], "this contact is solved"),
        ("winkler-parabola", &[], "expected a foundation"),
        ("winkler-parabola", &springs, ""),
        ("winkler-discrete", &springs, ""),
        ("winkler-discrete", &[springs[0], ("duration = 0.1", "duration = 1e9")], "expected at most 1e5"),
        ("winkler-point", &springs, "under a load"),
        ("winkler-point", &held, ""),
        ("mode-decay", &[], "no periodic half-space"),
        ("mode-decay", &[("modulus = 1e11", "modulus = 1e11\nboundary = \"periodic\"")], "not wavy"),
        ("stick-limit", &[], "the same `stick`"),
        ("stick-limit", &[("load = 1.0", "load = 1.0\nstick = 1e-5")], ""),
        ("mccoll-fretting", &[], "`contact.dimension` = 2"),
    ] {
        let said = refusal(kind, changes);
        assert_eq!(said.is_empty(), reason.is_empty(), "{kind}, {changes:?}: {said}");
        assert!(said.contains(reason), "{kind}, {changes:?}: {said}");
        let begins = format!("the reference \"{kind}\" does not cover this scene: ");
        assert!(said.is_empty() || said.starts_with(&begins), "{said}");
    }
}

#[test]
fn a_prescribed_scene_refuses_answers_to_solved_contact() {
    let case = Case::steps(
        "constants = [1e-4, 1e9, 1, 1]",
        "[[step]]\nduration = 1.0\npressure = 1e6\nvelocity = 1.0\n[reference]\nkind = \"hertz-scar\"",
    );
    let law = archard();
    let plan = case.plan(&law);
    let said = Run::prepare(&plan, &law).expect("no files").check_reference().expect_err("another model").to_string();
    assert!(said.contains("does not cover this scene: it is for a contact that is solved"), "{said}");
}

/// Ends a run at its second step.
struct Impatient(u64);

impl Observer for Impatient {
    fn observe(&mut self, event: Event<'_>) -> Wish {
        if let Event::Step { steps, .. } = event {
            self.0 = steps;
        }
        if self.0 >= 2 { Wish::Stop } else { Wish::GoOn }
    }
}

#[test]
fn a_refined_run_tells_of_its_steps_and_ends_when_it_is_asked_to() {
    let springs = "[law]\nuse = \"archard\"\nconstants = [1e-4, 1e9, 1, 1]\n[contact]\nmodel = \"foundation\"\n\
                   stiffness = 1e12\ndimension = 2\n[grid]\nsize = [1e-3]\ncells = [4]\n[surface]\nshape = \"cylinder\"\n\
                   radius = 1e-2\n[[step]]\nduration = 1.0\nload = 100.0\nvelocity = 1.0\n";
    let prescribed = "[law]\nuse = \"archard\"\nconstants = [1e-4, 1e9, 1, 1]\n[contact]\nmodel = \"prescribed\"\n\
                      [[cycle]]\ncount = 100\n[[cycle.step]]\nduration = 1.0\npressure = 1e6\nvelocity = 1.0\n";
    for scene in [springs, prescribed] {
        let case = Case::text(&format!("{scene}[integrator]\nsubsteps = 4\n[reference]\nkind = \"self\"\n"));
        let law = archard();
        let plan = case.plan(&law);
        let run = Run::prepare(&plan, &law).expect("no files");
        let record = run.go(1, &mut Nobody);
        assert!(matches!(record.end, End::Done), "{:?}", record.end);
        let mut impatient = Impatient(0);
        let error = run.error(&record, &mut impatient);
        assert!(matches!(error, Err(SolveError::Interrupted)), "{error:?}");
        assert!((2..=10).contains(&impatient.0), "it went on for {} steps", impatient.0);
        assert!(run.error(&record, &mut Nobody).expect("a reference").is_some());
    }
}
