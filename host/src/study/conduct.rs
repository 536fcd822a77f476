//! A study from its scene to its record.

use std::path::Path;

use super::asked::Asked;
use super::budget::Budget;
use super::cases::{Field, Found};
use super::error::StudyError;
use super::lines::Ground;
use super::setup::Setup;
use super::yardstick::{self, Gauge};
use super::{frame, front, grids, orders, verdict};
use crate::law::Evaluator;
use crate::plan::Plan;
use crate::record::{Case, Event, GridError, Kind, Limit, Observer, StudyRecord, Wish};
use crate::scene::{Mode, Model, Override, Scene};
use crate::solve::{Run, SolveError};

/// The law of the scene.
#[derive(Clone, Copy)]
pub struct Laws<'a> {
    /// The one that all cases use.
    pub here: &'a dyn Evaluator,
    /// The same in a process of its own, where that is to be compared.
    pub elsewhere: Option<&'a dyn Evaluator>,
}

/// Whoever waits for a study.
pub struct Watcher<'a> {
    /// Hears what is run next.
    pub tell: &'a mut dyn FnMut(&str),
    /// Says whether to go on.
    pub goes_on: &'a (dyn Fn() -> bool + Sync),
}

/// Steps are as much shorter than the limit at the start, which falls a little as a contact grows.
const WITHIN: f64 = 0.9;

/// Studies a scene file under the user's own overrides.
///
/// # Errors
/// A scene that is wrong or cannot be run, parts asked for by name that it does not have, a yardstick that cannot be had
/// within the budget, an interruption before there is anything to compare with.
pub fn study(
    file: &Path,
    own: &[Override],
    laws: Laws<'_>,
    asked: &Asked,
    watcher: &mut Watcher<'_>,
) -> Result<StudyRecord, StudyError> {
    let budget = Budget::begin(asked.budget, asked.runs);
    let scene = Scene::read(file, own)?;
    let ground = Ground { scene: &scene, asked, limit: None, elsewhere: laws.elsewhere.is_some() };
    ground.check()?;
    let plan = Plan::new(&scene, laws.here.descriptor())?;
    let points = {
        let run = Run::prepare(&plan, laws.here)?;
        run.check_reference()?;
        run.points()
    };
    let setup = Setup { file, own, threads: asked.threads, goes_on: watcher.goes_on };
    let gauge = yardstick::make(&setup, laws.here, &ground, &budget, watcher.tell)?;
    (watcher.tell)("explicit limit");
    let limit = limit(&setup, laws.here, &ground);
    let ground = Ground { limit, ..ground };
    (watcher.tell)("half the grid");
    let estimated = grids::estimated(&setup, laws.here, &ground, &budget, &gauge);
    let (lines, mut left_out) = ground.lines();
    let has_grids = lines.iter().any(|line| line.kind == Kind::Grid);
    let worn = gauge.fields.wear.iter().any(|depth| *depth != 0.0);
    let norm = if worn || gauge.fields.pressure.is_empty() { frame::WEAR } else { frame::PRESSURE };
    let Laws { here, elsewhere } = laws;
    let field = Field { setup: &setup, here, elsewhere, budget: &budget, gauge: &gauge, norm };
    let mut found = field.run(lines, watcher.tell);
    let against = has_grids.then(|| grids::compare(&ground, &gauge, &mut found));
    left_out.extend(found.ended.iter().cloned());
    left_out.extend(asides(&scene));
    let grid = gauge.frame.counts.is_some().then(|| GridError {
        against: against.unwrap_or_else(|| "nothing: grids were not asked for".to_owned()),
        estimated: estimated.unwrap_or_default(),
    });
    let Gauge { yardstick, .. } = gauge;
    let Found { cases, interrupted, .. } = found;
    let descriptor = laws.here.descriptor();
    let mut record = StudyRecord {
        scene: file.display().to_string(),
        title: scene.title.clone().unwrap_or_else(|| file.display().to_string()),
        law: format!("{} {}", descriptor.name, descriptor.version),
        points,
        cells: scene.grid.as_ref().map(|grid| grid.cells.clone()),
        threads: asked.threads,
        clock: asked.clock,
        processor_share: share(&cases),
        budget_s: budget.whole_s(),
        spent_s: 0.0,
        interrupted,
        norm: norm.to_owned(),
        norms: frame::norms(),
        orders: orders::orders(&cases, norm, &yardstick.stated),
        front: front::front(&cases, norm, &yardstick.stated, asked.clock),
        cheapest: front::cheapest(&cases, norm, &yardstick.stated, asked.clock),
        yardstick,
        grid,
        explicit_limit: limit,
        cases,
        verdict: Vec::new(),
        left_out,
    };
    record.verdict = verdict::words(&record);
    record.spent_s = budget.spent_s();
    Ok(record)
}

/// Processor over wall time of the cases in this process.
fn share(cases: &[Case]) -> Option<f64> {
    let timings = cases.iter().filter(|case| !case.isolated).filter_map(|case| case.timing);
    let sums = timings.fold((0.0, 0.0), |sum, timing| (sum.0 + timing.processor_s, sum.1 + timing.wall_s));
    (sums.1 > 0.0).then(|| sums.0 / sums.1)
}

/// What is to be known of a scene before its errors are read.
fn asides(scene: &Scene) -> Vec<String> {
    let mut texts = Vec::new();
    if scene.stop.wear_depth.is_some() || scene.stop.wear_volume.is_some() {
        texts.push(
            "the time between substeps: the scene stops at the first substep that reaches its bound, so runs end at \
             different times, and errors contain that"
                .to_owned(),
        );
    }
    texts
}

/// Ends a run after its first step, or when its study is to end.
struct First;

impl Observer for First {
    fn observe(&mut self, _event: Event<'_>) -> Wish {
        Wish::Stop
    }
}

/// The limit of explicit steps at the start; `None`: there is none, or it is not known before something touches.
fn limit(setup: &Setup<'_>, law: &dyn Evaluator, ground: &Ground<'_>) -> Option<Limit> {
    let scene = ground.scene;
    if matches!(scene.contact.model, Model::Prescribed(_)) || scene.law.mode == Some(Mode::Post) {
        return None;
    }
    let mut texts = ground.method(crate::scene::Method::ExplicitEuler);
    texts.extend(["integrator.substeps=1", "integrator.beyond_limit=refuse"].map(str::to_owned));
    let scene = setup.scene(&texts).ok()?;
    let plan = Plan::new(&scene, law.descriptor()).ok()?;
    let record = Run::prepare(&plan, law).ok()?.go(setup.threads, &mut First);
    let step = match &record.end {
        crate::record::End::Failed(SolveError::BeyondLimit { limit, .. }) => *limit,
        _ => record.stability.explicit_limit?,
    };
    let longest =
        plan.blocks.iter().flat_map(|block| &block.steps).filter_map(|step| step.duration).fold(0.0, f64::max);
    let substeps = (longest / (WITHIN * step)).ceil();
    (substeps.is_finite() && substeps < 1e15).then(|| Limit { step, substeps: substeps.max(1.0) as u64 })
}
