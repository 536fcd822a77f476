//! What a run holds before it goes: the grid and its memory, the model, the velocities of a load step.

use super::run::{Coupled, SHARED};
use super::segment::Segment;
use super::system::{Room, Substep, System, Work};
use crate::contact::foundation::Foundation;
use crate::contact::halfspace::{Boundary, HalfSpace, mirrors};
use crate::contact::surface::std_of_gap;
use crate::contact::{Cells, ContactModel, Solution};
use crate::integrator::{Formula, Stages};
use crate::law::Field;
use crate::plan::{Elastic, LoadStep, Skipped};
use crate::record::{self, MemoryLine};
use crate::scene::Basis;
use crate::solve::SolveError;

impl<'p> Coupled<'p> {
    pub(in crate::solve) fn geometry(&self) -> record::Geometry<'static> {
        let cells = self.solved.cells;
        let size = [0, 1].map(|axis| cells.spacing[axis] * cells.counts[axis] as f64);
        // A line has no width: its one row of cells lies on y = 0.
        let origin = if cells.dimension == 2 { [0.0, -0.5 * size[1]] } else { [0.0, 0.0] };
        record::Geometry::Grid(record::Grid { cells: cells.counts, size, origin })
    }

    /// Whether points of one scene slide over different distances.
    fn distances(&self) -> bool {
        let steps = self.plan.blocks.iter().flat_map(|block| &block.steps);
        steps.into_iter().any(|step| step.velocity_file.is_some() || step.stick.is_some_and(|stick| stick > 0.0))
    }

    /// What the run leaves out, and why.
    pub(in crate::solve) fn skipped(&self) -> Vec<Skipped> {
        let mut skipped = self.plan.skipped.clone();
        let Elastic::HalfSpace { periodic, .. } = self.solved.elastic else { return skipped };
        let (part, axes) = match mirrors(&self.solved.cells, boundary(periodic), &self.gap) {
            _ if self.plan.material.basis == Basis::NodalStress => return skipped,
            [true, true] => ("three quarters of the contact", "x and y"),
            [true, false] => ("half of the contact", "x"),
            [false, true] => ("half of the contact", "y"),
            [false, false] => return skipped,
        };
        let why = format!("the gap is its own mirror image in {axes}: solved on one side as long as it stays so");
        skipped.push(Skipped { what: part.to_owned(), why });
        skipped
    }

    pub(in crate::solve) fn memory(&self) -> Vec<MemoryLine> {
        let cells = self.gap.len();
        let line = |what: &str, bytes: usize| MemoryLine { what: what.to_owned(), bytes: bytes as u64 };
        let mut lines = vec![
            line("initial gap", 8 * cells),
            line("wear depth, at the start and the end of a step", 16 * cells),
            line("contact pressure, now and at the start of a step", 16 * cells),
            line("wear rates of the stages", Stages::bytes(self.solved.scheme.formula, cells)),
            line("gap of a stage", 8 * cells),
        ];
        if self.solved.scheme.slope != crate::plan::Slope::Proportional
            && self.solved.scheme.formula != Formula::ExplicitEuler
        {
            lines.push(line("linearisation of the law", 24 * cells));
        }
        let states = self.plan.initial_state.len();
        if states > 0 {
            lines.push(line("state variables, at the start and the end of a step", 16 * cells * states));
        }
        if self.distances() {
            lines.push(line("sliding distances and velocities", 16 * cells));
        }
        if self.plan.tolerance.is_some() {
            let memory = states + usize::from(self.distances());
            lines.push(line("start and ends of the passes that are compared", 8 * cells * (7 + memory)));
        }
        if let Elastic::HalfSpace { modulus, periodic, datum } = self.solved.elastic {
            let threads = if cells < SHARED { 1 } else { std::thread::available_parallelism().map_or(1, usize::from) };
            let model = half_space(self.solved.cells, (modulus, periodic, datum), threads);
            let varies = self.distances() || self.solved.scheme.slope != crate::plan::Slope::Proportional;
            let smoothed = self.plan.material.basis == Basis::NodalStress;
            let [transforms, arrays] = model.most_bytes(varies, smoothed);
            lines.push(line("half-space: transforms over the grid and a window, at most", transforms));
            lines.push(line("half-space: arrays of a contact solve, at most", arrays));
        }
        lines
    }

    pub(in crate::solve) fn segments_planned(&self) -> u64 {
        let substeps = self.plan.substeps.unwrap_or(1);
        self.plan.blocks.iter().map(|block| block.count * block.steps.len() as u64 * substeps).sum()
    }

    fn model(&self, threads: usize) -> Box<dyn ContactModel> {
        match self.solved.elastic {
            Elastic::Foundation(stiffness) => Box::new(Foundation::new(self.solved.cells, stiffness)),
            Elastic::HalfSpace { modulus, periodic, datum } => {
                Box::new(half_space(self.solved.cells, (modulus, periodic, datum), threads))
            }
        }
    }

    pub(super) fn system(&self, threads: usize) -> System<'p> {
        let cells = self.gap.len();
        let first = self.plan.blocks.first().and_then(|block| block.steps.first());
        let segment = Segment {
            step: first.unwrap_or(const { &LoadStep::NOTHING }),
            start: 0.0,
            length: 0.0,
            represented: 0.0,
            scale: 1.0,
            number: 1,
            cycle: 0,
        };
        let reads_wear = self.plan.fields.contains(Field::AccumulatedWear);
        System {
            plan: self.plan,
            solved: self.solved,
            evaluator: self.evaluator,
            model: self.model(threads),
            gap_scale: std_of_gap(&self.solved.cells, &self.gap),
            initial_gap: self.gap.clone(),
            pressure: vec![0.0; cells],
            solution: Solution::default(),
            closed: Vec::new(),
            law: Default::default(),
            substep: Substep { segment, start: 0.0, dt: 0.0, number: 1 },
            slides: Vec::new(),
            remembered_wear: if reads_wear { vec![0.0; cells] } else { Vec::new() },
            distance: if self.distances() { vec![0.0; cells] } else { Vec::new() },
            uniform_distance: 0.0,
            state: self.plan.initial_state.repeat(cells),
            end_state: self.plan.initial_state.repeat(cells),
            work: Work::default(),
            room: Room::default(),
            steady: None,
            trial: false,
            stands: true,
        }
    }

    /// Relative velocities of the cells in a load step; empty where all slide alike.
    pub(super) fn slides(&self, step: &LoadStep) -> Result<Vec<f64>, SolveError> {
        let stick = step.stick.filter(|stick| *stick > 0.0);
        let mut slides = match (step.velocity_file, stick) {
            (Some(file), _) => self.velocities[file].clone(),
            (None, Some(_)) => vec![1.0; self.gap.len()],
            (None, None) => Vec::new(),
        };
        if let Some(stick) = stick {
            let radii = self.solved.surface.distances(&self.solved.cells, self.solved.is_periodic())?;
            for (slide, radius) in slides.iter_mut().zip(radii) {
                if radius < stick {
                    *slide = 0.0;
                }
            }
        }
        Ok(slides)
    }
}

/// The elastic half-space under a grid, of a contact modulus, a boundary and a datum.
fn half_space(cells: Cells, (modulus, periodic, datum): (f64, bool, Option<f64>), threads: usize) -> HalfSpace {
    HalfSpace::new(cells, modulus, boundary(periodic), datum, threads)
}

fn boundary(periodic: bool) -> Boundary {
    if periodic { Boundary::Periodic } else { Boundary::Free }
}
