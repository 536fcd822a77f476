//! Every place at which a run tells of a checkpoint can be gone on from with the same bits, whatever the run keeps there.

#[allow(dead_code)] // reason: a part of these laws is for other tests.
#[path = "wear_reference/laws.rs"]
mod laws;
#[path = "support/solved.rs"]
mod solved;

use std::borrow::Cow;

use laws::RunningIn;
use solved::{archard, memory};
use wearlaw::law::Evaluator;
use wearlaw::plan::Plan;
use wearlaw::record::{Checkpoint, End, Event, Nobody, Observer, Record, Wish};
use wearlaw::scene::Scene;
use wearlaw::solve::{Run, SolveError};

/// Keeps all checkpoints of a run.
#[derive(Default)]
struct All(Vec<Checkpoint<'static>>);

impl Observer for All {
    fn observe(&mut self, event: Event<'_>) -> Wish {
        if let Event::Checkpoint { checkpoint, .. } = event {
            self.0.push(Checkpoint {
                history: Cow::Owned(checkpoint.history.clone().into_owned()),
                warnings: checkpoint.warnings.to_vec().into(),
                asides: checkpoint.asides.to_vec().into(),
                numbers: checkpoint.numbers.clone(),
                arrays: checkpoint.arrays.iter().map(|(name, data)| (name.clone(), data.to_vec().into())).collect(),
                ..Checkpoint { time: checkpoint.time, cost: checkpoint.cost, ..Checkpoint::default() }
            });
        }
        Wish::GoOn
    }

    fn wants_checkpoint(&mut self, _last: bool) -> bool {
        true
    }
}

/// What has to agree, with every bit of its numbers.
fn bits(record: &Record<SolveError>) -> String {
    format!(
        "{:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {}",
        record.history,
        record.wear,
        record.pressure,
        record.state,
        record.estimated,
        record.largest_step,
        record.warnings,
        record.profile,
        record.stability,
        record.end,
        record.cost.steps,
    )
}

/// Goes through a scene once, then from each of about eight of its checkpoints.
#[track_caller]
fn every_place(law: &dyn Evaluator, text: &str) {
    let scene = Scene::parse(text, "scene.toml", &[]).unwrap_or_else(|error| panic!("{error:?}\n{text}"));
    let plan = Plan::new(&scene, law.descriptor()).unwrap_or_else(|error| panic!("{error:?}\n{text}"));
    let run = Run::prepare(&plan, law).expect("a surface");
    let mut all = All::default();
    let whole = run.go(1, &mut all);
    assert!(matches!(whole.end, End::Done | End::Stopped(_)), "{:?}\n{text}", whole.end);
    assert!(all.0.len() > 2, "{} checkpoints\n{text}", all.0.len());
    let expected = bits(&whole);
    for checkpoint in all.0.iter().step_by(all.0.len().div_ceil(8)).chain(all.0.last()) {
        let resumed = run.resume(1, &mut Nobody, checkpoint).expect("a checkpoint of this run");
        assert!(bits(&resumed) == expected, "from time {}:\n{text}", checkpoint.time);
    }
}

const ARCHARD: &str = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n";
const CURVED: &str = "[law]\nuse = \"archard\"\nconstants = { K = 1e-6, H = 1e10, m = 1.3 }\n";
const REMEMBERS: &str = "[law]\nuse = \"archard\"\nconstants = [1e-14, 1e-15, 0.04]\n";
const SPRINGS: &str = "[contact]\nmodel = \"foundation\"\ndimension = 2\nstiffness = 1e13\n";
const BODIES: &str = "[contact]\nmodel = \"halfspace\"\ndimension = 2\nmodulus = 1.1e11\n";
const GRID: &str = "[grid]\nsize = [1.2e-3]\ncells = [40]\n[surface]\nshape = \"cylinder\"\nradius = 1e-2\n";
const CYCLES: &str = "[[cycle]]\ncount = 12\n[[cycle.step]]\nduration = 0.5\nload = 1000.0\nvelocity = 1.0\nstick = 2e-5\n\
    [[cycle.step]]\nduration = 0.7\nload = 400.0\nvelocity = -0.5\nramp = [\"load\", \"velocity\"]\n";
const STEADY: &str =
    "[[step]]\nduration = 3.0\nload = 1000.0\nvelocity = 1.0\n[[step]]\nduration = 9.0\nload = 500.0\nvelocity = 0.3\n";

#[test]
fn substeps_of_every_method_and_law() {
    for method in ["auto", "implicit-euler", "sdirk2"] {
        let integrator = format!("[integrator]\nmethod = \"{method}\"\nsubsteps = 3\n");
        every_place(&archard(), &format!("{ARCHARD}{SPRINGS}{GRID}{CYCLES}{integrator}"));
        every_place(&archard(), &format!("{ARCHARD}{BODIES}{GRID}{CYCLES}{integrator}"));
        every_place(&archard(), &format!("{CURVED}{SPRINGS}{GRID}{CYCLES}{integrator}"));
    }
    let integrator = "[integrator]\nsubsteps = 3\n";
    every_place(&memory::<RunningIn>(None), &format!("{REMEMBERS}{BODIES}{GRID}{CYCLES}{integrator}"));
    let post = format!("{ARCHARD}mode = \"post\"\n{BODIES}{GRID}{CYCLES}{integrator}");
    every_place(&archard(), &post);
}

#[test]
fn explicit_substeps_on_both_sides_of_the_limit() {
    for beyond in ["substep", "run"] {
        for substeps in [2, 400] {
            let integrator = format!(
                "[integrator]\nmethod = \"explicit-euler\"\nbeyond_limit = \"{beyond}\"\nsubsteps = {substeps}\n"
            );
            // Two substeps a load step are beyond the limit of both contacts, 400 within it.
            let cycles = CYCLES.replace("count = 12", "count = 2");
            every_place(&archard(), &format!("{ARCHARD}{BODIES}{GRID}{cycles}{integrator}"));
            let slow = cycles.replace("duration = 0.", "duration = ").replace("stick = 2e-5\n", "");
            let soft = ARCHARD.replace("1e-4", "1e-3");
            every_place(&archard(), &format!("{soft}{SPRINGS}{GRID}{slow}{integrator}"));
        }
    }
}

#[test]
fn stretches_to_a_tolerance() {
    let fields = "[output]\nfields = [\"wear\"]\nevery = 7\n";
    for integrator in
        ["[integrator]\ntolerance = 1e-3\n".to_owned(), format!("[integrator]\ntolerance = 1e-3\n{fields}")]
    {
        every_place(&archard(), &format!("{ARCHARD}{SPRINGS}{GRID}{CYCLES}{integrator}"));
        every_place(&archard(), &format!("{ARCHARD}{BODIES}{GRID}{CYCLES}{integrator}"));
        let stop = "[stop]\nwear_depth = 1.5e-7\n";
        every_place(&archard(), &format!("{ARCHARD}{SPRINGS}{GRID}{CYCLES}{integrator}{stop}"));
    }
}

/// Keeps all checkpoints and ends the run behind one step.
struct Until {
    step: u64,
    all: All,
}

impl Observer for Until {
    fn observe(&mut self, event: Event<'_>) -> Wish {
        let ends = matches!(event, Event::Step { steps, .. } if steps == self.step);
        self.all.observe(event);
        if ends { Wish::Stop } else { Wish::GoOn }
    }

    fn wants_checkpoint(&mut self, _last: bool) -> bool {
        true
    }
}

/// With fields of single steps a stretch is gone through again when its steps are known: an interruption ends it there.
#[test]
fn an_interruption_within_a_stretch_ends_the_run_behind_that_step() {
    let fields = "[integrator]\ntolerance = 1e-3\n[output]\nfields = [\"wear\"]\nevery = 3\n";
    for scaling in ["", "[scaling]\nkind = \"cycle\"\nsafety = 0.05\n"] {
        let cycles = CYCLES.replace("count = 12", "count = 4");
        let text = format!("{ARCHARD}{BODIES}{GRID}{cycles}{scaling}{fields}");
        let scene = Scene::parse(&text, "scene.toml", &[]).expect("a scene");
        let law = archard();
        let plan = Plan::new(&scene, law.descriptor()).expect("a plan");
        let run = Run::prepare(&plan, &law).expect("a surface");
        let whole = run.go(1, &mut Nobody);
        assert!(matches!(whole.end, End::Done), "{:?}", whole.end);
        let mut inside = 0;
        for step in (1..whole.cost.steps).step_by(whole.cost.steps.div_ceil(9) as usize) {
            let mut until = Until { step, all: All::default() };
            let cut = run.go(1, &mut until);
            assert!(matches!(cut.end, End::Interrupted), "{:?}", cut.end);
            assert_eq!(cut.history.rows, whole.history.rows[..=step as usize], "the run ended behind step {step}");
            let last = until.all.0.last().expect("a checkpoint where it ended");
            assert_eq!(last.time, cut.history.rows[step as usize].time);
            inside += usize::from(!last.arrays["again.until"].is_empty());
            let resumed = run.resume(1, &mut Nobody, last).expect("a checkpoint of this run");
            assert!(bits(&resumed) == bits(&whole), "from step {step}:\n{text}");
        }
        assert!(inside > 4, "{inside} of the steps lie within a stretch");
    }
}

#[test]
fn scaled_substeps_and_cycles() {
    let substeps = "[integrator]\nsubsteps = 20\n";
    let scaled = |kind: &str| format!("[scaling]\nkind = \"{kind}\"\nsafety = 0.05\n");
    every_place(&archard(), &format!("{ARCHARD}{SPRINGS}{GRID}{STEADY}{substeps}{}", scaled("auto")));
    for integrator in ["[integrator]\nsubsteps = 3\n", "[integrator]\ntolerance = 1e-3\n"] {
        let cycles = CYCLES.replace("count = 12", "count = 100");
        every_place(&archard(), &format!("{ARCHARD}{SPRINGS}{GRID}{cycles}{integrator}{}", scaled("cycle")));
        every_place(&archard(), &format!("{ARCHARD}{BODIES}{GRID}{cycles}{integrator}{}", scaled("cycle")));
    }
}

#[test]
fn prescribed_pieces_of_rates_and_of_laws_with_a_memory() {
    let loading = "[contact]\nmodel = \"prescribed\"\n[[cycle]]\ncount = 9\n[[cycle.step]]\nduration = 0.02\npressure = 1e8\nvelocity = 1.0\n\
        [[cycle.step]]\nduration = 0.05\npressure = 3e8\nvelocity = -0.5\nramp = [\"pressure\", \"velocity\"]\n";
    for scaling in ["", "[scaling]\nkind = \"cycle\"\nmaximum = 3.0\n"] {
        every_place(&archard(), &format!("{CURVED}{loading}{scaling}"));
        every_place(
            &memory::<RunningIn>(None),
            &format!("{REMEMBERS}{loading}{scaling}[integrator]\ntolerance = 1e-5\n"),
        );
    }
}
