//! What every integrator does in steps from a tenth of the explicit limit to a million times it.

use super::present::Present;
use super::run::Coupled;
use super::segment::Segment;
use super::stepper::Stepper;
use super::system::Substep;
use super::trial::{Came, How, Refined, Start};
use crate::integrator::Formula;
use crate::scene::{BeyondLimit, Mode};
use crate::solve::SolveError;
use crate::solve::ladder::{Ladder, Moment, Outcome, OwnMethod, Pressed, Row, Stiff};
use crate::stability::{EXPLICIT_LIMIT, explicit_limit};

/// Lengths of the steps in units of 1 / stiffness; the explicit limit lies at 2.
pub(super) const RATIOS: [f64; 7] = [0.1, 0.5, 1.9, 2.1, 10.0, 1e3, 1e6];
/// Steps of each trial.
pub(super) const STEPS: u32 = 8;

/// A method of the ladder.
struct Tried {
    name: String,
    formula: Formula,
    guards: bool,
}

impl<'p> Coupled<'p> {
    /// Climbs the ladder from the state at a represented time. `None`: it was interrupted.
    ///
    /// # Errors
    /// A time outside the loading, at which nothing is in contact; whatever ends the run before that time.
    pub(in crate::solve) fn ladder(
        &self,
        at: f64,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Ladder>, SolveError> {
        let Some(present) = self.present(at, goes_on)? else { return Ok(None) };
        let touching = present.pressure.iter().filter(|p| **p > 0.0).count();
        if touching == 0 {
            return Err(SolveError::NothingTouches { time: at });
        }
        let driven = Segment {
            step: &present.step,
            start: 0.0,
            length: 0.0,
            represented: at,
            scale: 1.0,
            number: present.number,
            cycle: present.cycle,
        }
        .at(0.0);
        let largest = present.pressure.iter().fold(0.0, |most: f64, p| most.max(*p));
        let mean = present.pressure.iter().sum::<f64>() / touching as f64;
        let mut ladder = Ladder {
            moment: Moment {
                time: at,
                load: present.solution.load,
                approach: present.solution.approach,
                velocity: driven.velocity,
                temperature: driven.temperature,
                cells_in_contact: touching,
                largest_pressure: largest,
                mean_pressure: mean,
            },
            control: if present.load_given() { Pressed::Load } else { Pressed::Approach },
            stiff: Vec::new(),
            steps: STEPS,
            rows: Vec::new(),
            own: OwnMethod::default(),
        };
        if self.plan.material.mode == Mode::Post {
            let words = "wear is only a result and never changes the contact: no step has a stability limit";
            ladder.own = OwnMethod { method: self.own_name(), fine: true, words: words.to_owned(), beside: None };
            return Ok(Some(ladder));
        }
        for control in [Pressed::Load, Pressed::Approach] {
            if !self.climb(&present, control, &mut ladder, goes_on)? {
                return Ok(None);
            }
        }
        ladder.own = self.own(&ladder);
        Ok(Some(ladder))
    }

    /// All rows under one control; false if it was interrupted.
    fn climb(
        &self,
        present: &Present,
        pressed: Pressed,
        ladder: &mut Ladder,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, SolveError> {
        let load_given = pressed == Pressed::Load;
        if !load_given && self.solved.is_periodic() && ladder.moment.cells_in_contact == self.points() {
            let why =
                "in full contact a periodic surface has no approach of its own: its mean pressure is not determined";
            ladder.stiff.push(Stiff { control: pressed, without: Some(why.to_owned()), ..Stiff::default() });
            return Ok(true);
        }
        let control = present.control(load_given);
        let step = present.pressed(control);
        let measured = {
            let mut system = self.system(1);
            let segment = Segment {
                step: &step,
                start: 0.0,
                length: 0.0,
                represented: present.time,
                scale: 1.0,
                number: present.number,
                cycle: present.cycle,
            };
            system.slides = self.slides(&step)?;
            system.pressure.clone_from(&present.pressure);
            system.solution = present.solution;
            system.state.clone_from(&present.state);
            system.distance.clone_from(&present.distance);
            system.uniform_distance = present.uniform_distance;
            system.remembered_wear.clone_from(&present.wear);
            system.substep = Substep { segment, start: 0.0, dt: self.usual_step(), number: 1 };
            system.measure_gap(&present.wear);
            let idle = Stepper::is_idle(&system, &segment);
            let found = system.stiffness(segment.at(0.0), load_given, true);
            let found = found.map_err(|source| SolveError::Advance {
                load_step: present.number,
                substep: 1,
                time: present.time,
                source: Box::new(source.into()),
            })?;
            (!idle).then_some(found)
        };
        let Some(measured) = measured.filter(|measured| measured.stiffness.per_time > 0.0) else {
            let why = "nothing that wears changes the pressure: no step has a stability limit";
            ladder.stiff.push(Stiff { control: pressed, without: Some(why.to_owned()), ..Stiff::default() });
            return Ok(true);
        };
        let stiffness = measured.stiffness.per_time;
        ladder.stiff.push(Stiff {
            control: pressed,
            stiffness_per_s: Some(stiffness),
            explicit_limit_s: Some(explicit_limit(stiffness)),
            points_left_out: measured.left_out,
            without: None,
        });
        let start = Start::new(self, present, &measured);
        let set = start.set.clone();
        for held in [true, false] {
            let how = |formula, guards| How { formula, guards, control, held: held.then_some(&set[..]) };
            let spans = RATIOS.map(|ratio| f64::from(STEPS) * ratio / stiffness);
            let best = if self.solved.scheme.rate { Formula::TrBdf2 } else { Formula::ImplicitEuler };
            let refined = self.moments(&start, how(best, true), &spans, goes_on);
            // Without anything to compare with there is nothing to say of any step.
            let (refined, why) = refined.unwrap_or_else(|error| (Vec::new(), error.to_string()));
            for (k, ratio) in RATIOS.into_iter().enumerate() {
                let mut row = |method: &str, outcome: Outcome| {
                    ladder.rows.push(Row {
                        control: pressed,
                        held,
                        method: method.to_owned(),
                        ratio,
                        step: ratio / stiffness,
                        outcome,
                    });
                };
                let mut same: Option<Outcome> = None;
                for tried in self.methods() {
                    if !goes_on() {
                        return Ok(false);
                    }
                    let outcome = match (refined.get(k), &same) {
                        (None, _) => Outcome::NotTried(why.clone()),
                        // The rule never stepped in: the method alone does the same.
                        (_, Some(outcome)) if tried.formula == Formula::TrBdf2 && !tried.guards => outcome.clone(),
                        (Some(refined), _) => {
                            self.tried(&start, how(tried.formula, tried.guards), ratio / stiffness, refined)?
                        }
                    };
                    if tried.formula == Formula::TrBdf2 && tried.guards {
                        same = matches!(&outcome, Outcome::Seen(seen) if seen.replaced == 0).then(|| outcome.clone());
                    }
                    row(&tried.name, outcome);
                }
            }
        }
        Ok(true)
    }

    fn tried(&self, start: &Start<'_>, how: How<'_>, dt: f64, refined: &Refined) -> Result<Outcome, SolveError> {
        Ok(match self.trial(start, how, (dt, STEPS), refined)? {
            Came::Seen(seen) => Outcome::Seen(seen),
            Came::Outside => Outcome::NotTried("the contact reaches the rim of the grid".to_owned()),
            Came::Failed(source) => Outcome::Failed(source.to_string()),
        })
    }

    /// The methods that the law can be advanced with; the scene's own among them.
    fn methods(&self) -> Vec<Tried> {
        let tried = |name: &str, formula, guards| Tried { name: name.to_owned(), formula, guards };
        let mut methods = vec![
            tried("explicit-euler", Formula::ExplicitEuler, true),
            tried("implicit-euler", Formula::ImplicitEuler, true),
        ];
        if self.solved.scheme.rate {
            methods.push(tried(DEFAULT, Formula::TrBdf2, true));
            methods.push(tried("tr-bdf2 alone", Formula::TrBdf2, false));
            methods.push(tried("sdirk2 alone", Formula::Sdirk2, false));
            if self.solved.scheme.formula == Formula::Sdirk2 {
                methods.push(tried(SDIRK2, Formula::Sdirk2, true));
            }
        }
        methods
    }

    /// The scene's method by its name in the ladder.
    fn own_name(&self) -> String {
        match self.solved.scheme.formula {
            Formula::TrBdf2 => DEFAULT.to_owned(),
            Formula::Sdirk2 => SDIRK2.to_owned(),
            formula => formula.name().to_owned(),
        }
    }

    /// Represented length of a step that a run might take.
    fn usual_step(&self) -> f64 {
        let steps = self.plan.blocks.iter().flat_map(|block| &block.steps);
        let longest = steps.filter_map(|step| step.duration).fold(0.0, f64::max);
        let step = longest / self.plan.substeps.unwrap_or(1) as f64;
        if step > 0.0 { step } else { 1.0 }
    }

    /// Whether the scene's own method is fine.
    fn own(&self, ladder: &Ladder) -> OwnMethod {
        let method = self.own_name();
        let limit = ladder.limit();
        if self.solved.scheme.formula == Formula::ExplicitEuler {
            let (fine, words) = match (limit, self.plan.substeps, self.solved.beyond_limit) {
                (None, _, _) => (true, "explicit steps have no limit here".to_owned()),
                (Some(limit), None, _) => (
                    true,
                    format!(
                        "explicit steps of its own begin short enough for the limit {limit:.4e}, and are no longer anywhere"
                    ),
                ),
                (Some(limit), Some(_), _) if self.usual_step() <= limit => {
                    (true, format!("explicit steps of {:.4e} keep the limit {limit:.4e}", self.usual_step()))
                }
                (Some(limit), Some(_), BeyondLimit::Substep) => {
                    (true, format!("explicit steps of {:.4e} are cut to the limit {limit:.4e}", self.usual_step()))
                }
                (Some(limit), Some(_), beyond) => {
                    let then = if beyond == BeyondLimit::Run { "leave a chequerboard" } else { "are refused" };
                    let step = self.usual_step();
                    (false, format!("explicit steps of {step:.4e} are beyond the limit {limit:.4e} and {then}"))
                }
            };
            return OwnMethod { method, fine, words, beside: None };
        }
        let wrong = |under: &dyn Fn(Pressed) -> bool| -> Vec<String> {
            let rows = ladder.rows.iter().filter(|row| row.method == method && under(row.control));
            let told = |row: &Row| {
                let what = match &row.outcome {
                    Outcome::Failed(_) => "failed".to_owned(),
                    outcome => outcome.trouble()?,
                };
                Some(format!("{what} in steps of {:e} / stiffness", row.ratio))
            };
            rows.filter_map(told).collect()
        };
        let (own, beside) = (wrong(&|control| control == ladder.control), wrong(&|control| control != ladder.control));
        let words = match (own.is_empty(), limit) {
            (true, Some(_)) => format!(
                "positive, smooth and bounded in steps up to {:.0e} times the explicit limit",
                RATIOS[RATIOS.len() - 1] / EXPLICIT_LIMIT
            ),
            (true, None) => "nothing that wears changes the pressure, so no step has a limit".to_owned(),
            (false, _) => own.join("; "),
        };
        let other = if ladder.control == Pressed::Load { Pressed::Approach } else { Pressed::Load };
        let beside = (!beside.is_empty())
            .then(|| format!("under a given {}, which the scene does not have: {}", other.word(), beside.join("; ")));
        OwnMethod { method, fine: own.is_empty(), words, beside }
    }
}

/// What a scene gets that names no method.
const DEFAULT: &str = "tr-bdf2 with its rule";
const SDIRK2: &str = "sdirk2 with its rule";
