//! The law at some cells of a contact: columns gathered, the law called, its answers brought to the default direction.

use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::segment::Driven;
use crate::contact::Cells;
use crate::integrator::Reply;
use crate::law::batch::BatchBuilder;
use crate::law::{
    Batch, CallNumbers, Evaluation, Evaluator, Field, Flag, Indices, OutputItem, Outputs, PointInputs, Values,
};
use crate::plan::Plan;
use crate::solve::kinematics::{ALONG, UP, contact_state};
use crate::solve::{PointError, ShortStep};

/// Cells above which several threads share a call.
const SHARED: usize = 1 << 16;
/// Cells of one thread's part; fixed, so that bits do not depend on the number of threads.
const PART: usize = 8192;

/// What a law remembers of the cells `[cells]`, at the start of the substep.
pub(super) struct Remembered<'m> {
    pub(super) wear: &'m [f64],
    /// Sliding distances; empty where all cells slide alike.
    pub(super) distance: &'m [f64],
    pub(super) uniform_distance: f64,
    /// State variables `[cells][variables]`.
    pub(super) state: &'m [f64],
    /// Gap `[cells]`; empty unless the law reads it.
    pub(super) gap: &'m [f64],
    /// Velocities relative to the segment's `[cells]`; empty where all cells slide alike.
    pub(super) slides: &'m [f64],
}

/// One call.
pub(super) struct Call<'c> {
    pub(super) driven: Driven,
    /// Represented time at the start of the call.
    pub(super) time: f64,
    /// Represented duration.
    pub(super) dt: f64,
    pub(super) load_step: i64,
    pub(super) substep: i64,
    pub(super) cycle: i64,
    /// The cells.
    pub(super) cells: &'c [u32],
    /// What drives wear at each of them: contact pressure, or the traction that stands for it.
    pub(super) pressure: &'c [f64],
    /// Nodal tractions at each of them; empty unless the law reads them.
    pub(super) traction: &'c [f64],
    /// Whether the law's derivative is wanted.
    pub(super) slope: bool,
}

/// Answers of the law and room for the columns it is given; arrays are as long as the list of cells of the last call.
#[derive(Default)]
pub(super) struct LawPoints {
    /// Increments of wear depth.
    pub(super) increment: Vec<f64>,
    /// Their derivative with respect to the pressure, where it was wanted.
    pub(super) slope: Vec<f64>,
    /// State variables at the end.
    pub(super) state: Vec<f64>,
    /// Wear directions.
    pub(super) direction: Vec<f64>,
    pub(super) law_time: Duration,
    pub(super) law_calls: u64,
    pub(super) points_evaluated: u64,
    pub(super) warnings: Vec<String>,
    /// Where the law last wished for a shorter step, and its words.
    pub(super) wish: Option<(Option<PointInputs>, String)>,
    rooms: Rooms,
}

#[derive(Default)]
struct Rooms {
    speed: Vec<f64>,
    slip: Vec<f64>,
    slip_vector: Vec<f64>,
    stress: Vec<f64>,
    work: Vec<f64>,
    coordinates: Vec<f64>,
    wear: Vec<f64>,
    distance: Vec<f64>,
    gap: Vec<f64>,
    state: Vec<f64>,
    contact: Vec<i64>,
    ids: Vec<i64>,
    constants: Vec<f64>,
}

/// Values of an array at the listed cells.
fn gather(room: &mut Vec<f64>, from: &[f64], cells: &[u32], width: usize) {
    room.clear();
    for cell in cells {
        let at = *cell as usize * width;
        room.extend_from_slice(&from[at..at + width]);
    }
}

fn map(room: &mut Vec<f64>, points: usize, value: impl Fn(usize) -> f64) {
    room.clear();
    room.extend((0..points).map(value));
}

impl LawPoints {
    /// Evaluates the law at the cells of a call.
    ///
    /// # Errors
    /// As the law; a direction that does not lead into the worn body.
    pub(super) fn evaluate(
        &mut self,
        plan: &Plan,
        cells: &Cells,
        evaluator: &dyn Evaluator,
        call: &Call<'_>,
        remembered: &Remembered<'_>,
    ) -> Result<Reply, PointError> {
        let law = evaluator.descriptor();
        let points = call.cells.len();
        let states = law.state.len();
        self.increment.resize(points, 0.0);
        self.slope.resize(if call.slope { points } else { 0 }, 0.0);
        self.state.resize(points * states, 0.0);
        let turns = law.writes(OutputItem::Direction);
        self.direction.resize(if turns { 3 * points } else { 0 }, 0.0);
        if points == 0 {
            return Ok(Reply::Good);
        }
        let batch = columns(&mut self.rooms, plan, cells, evaluator, call, remembered)?;
        let mut outputs = Outputs::new(&mut self.increment);
        outputs.d_pressure = call.slope.then_some(&mut self.slope[..]);
        outputs.state = (states > 0).then_some(&mut self.state[..]);
        outputs.direction = turns.then_some(&mut self.direction[..]);
        let begin = Instant::now();
        let answer = if points > SHARED && !law.flags.contains(Flag::Serial) {
            shared(evaluator, &batch, outputs, states)
        } else {
            evaluator.evaluate(&batch, &mut outputs)
        };
        self.law_time += begin.elapsed();
        self.law_calls += 1;
        self.points_evaluated += points as u64;
        let cell_of = |at: PointInputs| PointInputs { point: call.cells[at.point.min(points - 1)] as usize, ..at };
        let answer = answer.map_err(|mut error| {
            if let Some(at) = error.at_mut() {
                at.point = call.cells[at.point.min(points - 1)] as usize;
            }
            PointError::from(error)
        })?;
        match answer {
            Evaluation::Good => {}
            Evaluation::Unreliable { at, text } => {
                let place = at.map(|at| format!(" at point {}", cell_of(at).point)).unwrap_or_default();
                let words = if text.is_empty() { String::new() } else { format!(": {text}") };
                if self.warnings.is_empty() {
                    self.warnings.push(format!("law `{}` is unreliable{place}{words}", law.name));
                }
            }
            Evaluation::CutStep { factor, at, text } => {
                self.wish = Some((at.map(cell_of), text));
                return Ok(Reply::Cut(factor));
            }
        }
        self.turn(plan, call.cells, turns)?;
        Ok(Reply::Good)
    }

    /// The error for a step that would get shorter than what is allowed.
    pub(super) fn short_step(&mut self, law: &str, time: f64, asked: f64, smallest: f64) -> PointError {
        let (at, text) = self.wish.take().unwrap_or_default();
        PointError::SmallestStep(Box::new(ShortStep { law: law.to_owned(), time, asked, smallest, at, text }))
    }

    /// Brings increments along a direction d to depths: the gap grows by increment * (-d.n).
    fn turn(&mut self, plan: &Plan, cells: &[u32], by_law: bool) -> Result<(), PointError> {
        let into = |d: [f64; 3]| -(d[0] * UP[0] + d[1] * UP[1] + d[2] * UP[2]);
        let given = plan.material.direction;
        if given.is_none() && !by_law {
            return Ok(());
        }
        for (i, cell) in cells.iter().enumerate() {
            let along = match given {
                Some(direction) => into(direction),
                None => into([self.direction[3 * i], self.direction[3 * i + 1], self.direction[3 * i + 2]]),
            };
            if self.increment[i] == 0.0 && self.slope.get(i).is_none_or(|slope| *slope == 0.0) {
                continue;
            }
            if along <= 0.0 || along.is_nan() {
                return Err(PointError::Direction { point: *cell as usize, along, by_law: given.is_none() });
            }
            self.increment[i] *= along;
            if let Some(slope) = self.slope.get_mut(i) {
                *slope *= along;
            }
        }
        Ok(())
    }
}

/// Shares a large batch among the threads of the pool, in parts of fixed size.
fn shared(
    evaluator: &dyn Evaluator,
    batch: &Batch<'_>,
    outputs: Outputs<'_>,
    states: usize,
) -> Result<Evaluation, crate::law::EvaluateError> {
    let mut parts = Vec::new();
    let (mut rest, mut first) = (outputs, 0);
    while first < batch.points() {
        let length = PART.min(batch.points() - first);
        let (part, more) = rest.split_at(length, states);
        parts.push((first..first + length, part));
        (rest, first) = (more, first + length);
    }
    let mut answers = Vec::new();
    let evaluate = |(range, mut part)| evaluator.evaluate(&batch.range(range), &mut part);
    parts.into_par_iter().map(evaluate).collect_into_vec(&mut answers);
    answers.into_iter().try_fold(Evaluation::Good, |worst, answer| Ok(worst.worse(answer?)))
}

/// The columns of a call, each gathered only if the law declared it.
fn columns<'b>(
    rooms: &'b mut Rooms,
    plan: &Plan,
    grid: &Cells,
    evaluator: &'b dyn Evaluator,
    call: &Call<'b>,
    remembered: &Remembered<'_>,
) -> Result<Batch<'b>, PointError> {
    let law = evaluator.descriptor();
    let (cells, points, driven) = (call.cells, call.cells.len(), call.driven);
    let wants = |field: Field| plan.fields.contains(field);
    let any = |fields: &[Field]| fields.iter().any(|field| wants(*field));
    let numbers = CallNumbers {
        dimension: i64::from(plan.dimension),
        time: call.time,
        dt: call.dt,
        step_time: driven.step_time - (driven.time - call.time),
        load_step: call.load_step,
        substep: call.substep,
        cycle: call.cycle,
        material: plan.material.number,
        reference_temperature: plan.units.reference_temperature.unwrap_or(0.0),
        absolute_zero: plan.units.absolute_zero(),
        units: plan.sizes,
        ..CallNumbers::default()
    };
    let temperature = if plan.temperature { Values::Uniform(driven.temperature) } else { Values::Absent };
    let constants = plan.material.constants.at(driven.time, &temperature, points, &mut rooms.constants);
    let mut builder = BatchBuilder::new(law, points)
        .numbers(numbers)
        .constant_values(&constants)
        .field(Field::Pressure, Values::PerPoint(call.pressure))
        .field(Field::Temperature, temperature)
        .field(Field::Normal, Values::UniformVector(UP))
        .field(Field::Tangent, Values::UniformVector(ALONG));
    if wants(Field::NodalTraction) {
        builder = builder.field(Field::NodalTraction, Values::PerPoint(call.traction));
    }
    if wants(Field::Area) {
        builder = builder.field(Field::Area, Values::Uniform(grid.area()));
    }
    let velocity = driven.velocity;
    let alike = remembered.slides.is_empty();
    let at = |i: usize| velocity * remembered.slides[cells[i] as usize];
    let moving = [
        Field::Velocity,
        Field::Slip,
        Field::SlipVector,
        Field::FrictionWork,
        Field::FrictionStress,
        Field::ContactState,
    ];
    if !alike && any(&moving) {
        map(&mut rooms.speed, points, |i| at(i).abs());
        map(&mut rooms.slip, points, |i| at(i).abs() * call.dt);
    }
    let speeds = if alike { Values::Uniform(velocity.abs()) } else { Values::PerPoint(&rooms.speed) };
    let slips = if alike { Values::Uniform(velocity.abs() * call.dt) } else { Values::PerPoint(&rooms.slip) };
    builder = builder.field(Field::Velocity, speeds).field(Field::Slip, slips);
    if wants(Field::SlipVector) {
        let vectors = if alike {
            Values::UniformVector(ALONG.map(|x| x * velocity * call.dt))
        } else {
            rooms.slip_vector.clear();
            (0..points).for_each(|i| rooms.slip_vector.extend(ALONG.map(|x| x * at(i) * call.dt)));
            Values::PerPoint(&rooms.slip_vector)
        };
        builder = builder.field(Field::SlipVector, vectors);
    }
    if let Some(friction) = plan.friction {
        let signed = |i: usize| if alike { velocity } else { at(i) };
        let shear = |i: usize| friction * call.pressure[i].max(0.0);
        if wants(Field::FrictionWork) {
            map(&mut rooms.work, points, |i| shear(i) * signed(i).abs() * call.dt);
            builder = builder.field(Field::FrictionWork, Values::PerPoint(&rooms.work));
        }
        if wants(Field::FrictionStress) {
            rooms.stress.clear();
            for i in 0..points {
                // Friction on the worn body opposes its own motion.
                let against = if signed(i) == 0.0 { 0.0 } else { -signed(i).signum() };
                rooms.stress.extend(ALONG.map(|x| x * against * shear(i)));
            }
            builder = builder.field(Field::FrictionStress, Values::PerPoint(&rooms.stress));
        }
        builder = builder.field(Field::FrictionCoefficient, Values::Uniform(friction));
    }
    if wants(Field::Coordinates) {
        rooms.coordinates.clear();
        for cell in cells {
            let (i, j) = (*cell as usize % grid.counts[0], *cell as usize / grid.counts[0]);
            let y = if grid.dimension == 2 { 0.0 } else { (j as f64 + 0.5) * grid.spacing[1] };
            rooms.coordinates.extend([(i as f64 + 0.5) * grid.spacing[0], y, 0.0]);
        }
        builder = builder.field(Field::Coordinates, Values::PerPoint(&rooms.coordinates));
    }
    if wants(Field::AccumulatedWear) {
        gather(&mut rooms.wear, remembered.wear, cells, 1);
        builder = builder.field(Field::AccumulatedWear, Values::PerPoint(&rooms.wear));
    }
    if wants(Field::AccumulatedSlip) {
        let distances = if remembered.distance.is_empty() {
            Values::Uniform(remembered.uniform_distance)
        } else {
            gather(&mut rooms.distance, remembered.distance, cells, 1);
            Values::PerPoint(&rooms.distance)
        };
        builder = builder.field(Field::AccumulatedSlip, distances);
    }
    if wants(Field::Gap) {
        gather(&mut rooms.gap, remembered.gap, cells, 1);
        builder = builder.field(Field::Gap, Values::PerPoint(&rooms.gap));
    }
    if wants(Field::ContactState) {
        rooms.contact.clear();
        for (i, pressure) in call.pressure.iter().enumerate() {
            let speed = if alike { velocity.abs() } else { rooms.speed[i] };
            rooms.contact.push(contact_state(*pressure, speed));
        }
        builder = builder.indices(Field::ContactState, Indices::PerPoint(&rooms.contact));
    }
    if wants(Field::PointId) {
        rooms.ids.clear();
        rooms.ids.extend(cells.iter().map(|cell| i64::from(*cell)));
        builder = builder.indices(Field::PointId, Indices::PerPoint(&rooms.ids));
    }
    if !law.state.is_empty() {
        gather(&mut rooms.state, remembered.state, cells, law.state.len());
        builder = builder.state(Values::PerPoint(&rooms.state));
    }
    Ok(builder.build()?)
}
