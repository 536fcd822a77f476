//! What a law is given at one moment of a piece: every field it declared, and nothing else.

use std::ops::Range;

use crate::contact::prescribed::{Column, History, Motion};
use crate::law::{Batch, BatchError, CallNumbers, Field, Indices, Values};
use crate::plan::{Linear, Plan};
use crate::scene::Basis;
use crate::solve::kinematics::{ALONG, UP, contact_state, normal_at, path, speed_of, speeds, tangent};
use crate::solve::schedule::Piece;
use crate::solve::site::{Moment, Remembered, Rooms, Site};
use crate::solve::source::{Rate, Source, map, value, vector, vectors, zip};
use crate::solve::sweeps::no_sign;

/// Everything that drives the points over one piece.
pub(super) struct Drive<'h> {
    pub(super) pressure: Source<'h>,
    pub(super) velocity: Source<'h>,
    slip: [Rate<'h>; 3],
    pub(super) temperature: Source<'h>,
    pub(super) shear: Source<'h>,
    friction: Source<'h>,
    normal: [Source<'h>; 3],
    stress: [Source<'h>; 6],
    area: Source<'h>,
    coordinates: [Source<'h>; 3],
    inputs: Vec<Source<'h>>,
    motion: Motion,
}

impl<'h> Drive<'h> {
    pub(super) fn new(plan: &Plan, history: Option<&'h History>, piece: &Piece<'_>) -> Drive<'h> {
        let column = |column: Column| match (history, piece.between) {
            (Some(history), Some(between)) => Source::column(history.column(column), between),
            _ => Source::Absent,
        };
        let rate = |column: Column| match (history, piece.between) {
            (Some(history), Some(between)) => Source::rate(history.column(column), between),
            _ => Rate::Uniform(0.0),
        };
        let step = |line: Option<Linear>| line.map_or(Source::Absent, |line| Source::Uniform(piece.linear(line)));
        let or = |first: Source<'h>, second: Source<'h>| if first.is_absent() { second } else { first };
        let placed = piece.placed.step;
        let constant = |value: Option<f64>| value.map(|value| Linear { from: value, to: value });
        Drive {
            pressure: or(column(Column::Pressure), step(placed.pressure)),
            velocity: or(column(Column::Velocity), step(placed.velocity)),
            slip: match plan.motion {
                Motion::Slip => [rate(Column::Slip), Rate::Uniform(0.0), Rate::Uniform(0.0)],
                _ => Column::SLIP_VECTOR.map(rate),
            },
            temperature: or(column(Column::Temperature), step(placed.temperature)),
            shear: column(Column::Shear),
            friction: or(column(Column::Friction), or(step(placed.friction), step(constant(plan.friction)))),
            normal: Column::NORMAL.map(column),
            stress: Column::STRESS.map(column),
            area: column(Column::Area),
            coordinates: Column::COORDINATES.map(column),
            inputs: plan.inputs.iter().map(|input| input.map_or(Source::Absent, column)).collect(),
            motion: plan.motion,
        }
    }

    /// Whether nothing that the law sees changes over the piece but, linearly, the pressure.
    pub(super) fn only_pressure_changes(&self, plan: &Plan) -> bool {
        let still = |sources: &[Source<'_>]| sources.iter().all(Source::is_constant);
        let nodal = plan.material.basis == Basis::NodalStress || plan.fields.contains(Field::NodalTraction);
        let moving = self.motion == Motion::Velocity && !self.velocity.is_constant();
        let table = plan.material.constants.varies_in_time();
        let friction = [Field::FrictionStress, Field::FrictionWork].iter().any(|field| plan.fields.contains(*field));
        !moving
            && !table
            && !nodal
            && !friction
            && still(&[self.temperature, self.friction, self.area])
            && still(&self.normal)
            && still(&self.coordinates)
            && still(&self.inputs)
    }

    /// Whether the pressure does not change over the piece.
    pub(super) fn pressure_is_constant(&self) -> bool {
        self.pressure.is_constant()
    }

    /// Whether the speed is the same at every point.
    pub(super) fn speed_is_uniform(&self) -> bool {
        match self.motion {
            Motion::None => true,
            Motion::Velocity => !matches!(self.velocity, Source::Rows { .. }),
            Motion::Slip | Motion::SlipVector => self.slip.iter().all(Rate::is_uniform),
        }
    }

    /// The velocities of points that keep them over the piece.
    pub(super) fn lasting_velocities(&self, range: Range<usize>) -> Option<&'h [f64]> {
        match self.velocity {
            Source::Rows { from, to, .. } if self.motion == Motion::Velocity && std::ptr::eq(from, to) => {
                Some(&from[range])
            }
            _ => None,
        }
    }

    /// Areas of the points at a fraction of the piece.
    pub(super) fn areas<'b>(&self, part: f64, range: Range<usize>, room: &'b mut Vec<f64>) -> Values<'b>
    where
        'h: 'b,
    {
        self.area.at(part, range, room)
    }

    /// The contact pressure at a moment, or the normal traction of nodal stresses that stands for it.
    pub(super) fn driving_pressure<'b>(
        &self,
        plan: &Plan,
        part: f64,
        range: Range<usize>,
        rooms: (&'b mut Vec<f64>, &mut [Vec<f64>; 9]),
    ) -> Values<'b>
    where
        'h: 'b,
    {
        if plan.material.basis == Basis::NodalStress {
            return self.traction(part, range, rooms.0, rooms.1);
        }
        self.pressure.at(part, range, rooms.0)
    }

    /// max(0, -n.sigma.n) with the stress positive in tension.
    fn traction<'b>(
        &self,
        part: f64,
        range: Range<usize>,
        room: &'b mut Vec<f64>,
        parts: &mut [Vec<f64>; 9],
    ) -> Values<'b> {
        self.signed_traction(part, range, room, parts);
        room.iter_mut().for_each(|traction| *traction = traction.max(0.0));
        Values::PerPoint(room)
    }

    /// -n.sigma.n, negative where the surface is pulled.
    fn signed_traction(&self, part: f64, range: Range<usize>, room: &mut Vec<f64>, parts: &mut [Vec<f64>; 9]) {
        let points = range.len();
        let [a, b, c, d, e, f, x, y, z] = parts;
        let s = [
            self.stress[0].at(part, range.clone(), a),
            self.stress[1].at(part, range.clone(), b),
            self.stress[2].at(part, range.clone(), c),
            self.stress[3].at(part, range.clone(), d),
            self.stress[4].at(part, range.clone(), e),
            self.stress[5].at(part, range.clone(), f),
        ];
        let n = [
            self.normal[0].at(part, range.clone(), x),
            self.normal[1].at(part, range.clone(), y),
            self.normal[2].at(part, range, z),
        ];
        room.clear();
        room.extend((0..points).map(|i| {
            let [xx, yy, zz, xy, yz, xz] = [0, 1, 2, 3, 4, 5].map(|k| value(&s[k], i));
            let [nx, ny, nz] = normal_at(&n, i);
            let along = nx * nx * xx + ny * ny * yy + nz * nz * zz + 2.0 * (nx * ny * xy + ny * nz * yz + nx * nz * xz);
            -along
        }));
    }

    /// Fractions of the piece at which the driving pressure of the points changes sign, at most `most` different
    /// ones; none if there are more, or if normals turn, so that tractions are not linear.
    pub(super) fn lift_offs(&self, plan: &Plan, points: usize, most: usize) -> Vec<f64> {
        if plan.material.basis != Basis::NodalStress {
            return self.pressure.crossings(0.0, most).unwrap_or_default();
        }
        if !self.normal.iter().all(Source::is_constant) {
            return Vec::new();
        }
        let (mut from, mut to, mut parts) = (Vec::new(), Vec::new(), Default::default());
        self.signed_traction(0.0, 0..points, &mut from, &mut parts);
        self.signed_traction(1.0, 0..points, &mut to, &mut parts);
        Source::Rows { from: &from, to: &to, a: 0.0, b: 1.0 }.crossings(0.0, most).unwrap_or_default()
    }

    /// Outward unit normals at a moment.
    pub(super) fn normals<'b>(
        &self,
        part: f64,
        range: Range<usize>,
        room: &'b mut Vec<f64>,
        parts: &mut [Vec<f64>; 9],
    ) -> Values<'b> {
        if self.normal[0].is_absent() {
            return Values::UniformVector(UP);
        }
        let [a, b, c, ..] = parts;
        let n = [
            self.normal[0].at(part, range.clone(), a),
            self.normal[1].at(part, range.clone(), b),
            self.normal[2].at(part, range.clone(), c),
        ];
        vectors(range.len(), room, |i| normal_at(&n, i))
    }

    /// Lengths of the slip paths from fraction `from` to fraction `to` of a piece that lasts `length`.
    pub(super) fn paths<'b>(
        &self,
        (from, to): (f64, f64),
        length: f64,
        range: Range<usize>,
        room: &'b mut Vec<f64>,
        parts: &mut [Vec<f64>; 9],
    ) -> Values<'b> {
        let dt = (to - from) * length;
        let [a, b, c, ..] = parts;
        match self.motion {
            Motion::None => Values::Uniform(0.0),
            Motion::Velocity => {
                let start = self.velocity.at(from, range.clone(), a);
                let end = self.velocity.at(to, range.clone(), b);
                zip(&start, &end, range.len(), room, |v, w| path(v, w, dt))
            }
            Motion::Slip | Motion::SlipVector => {
                let speeds = speeds(&self.slip, range, [a, b, c], room);
                if let Values::Uniform(speed) = speeds {
                    return Values::Uniform(speed * dt);
                }
                room.iter_mut().for_each(|speed| *speed *= dt);
                Values::PerPoint(room)
            }
        }
    }

    /// The batch of the points of `range` at a moment, handed to `call` together with the pressure and the normals.
    pub(super) fn with_batch<T, E: From<BatchError>>(
        &self,
        site: &Site<'_>,
        moment: &Moment,
        range: Range<usize>,
        remembered: Remembered<'_>,
        rooms: &mut Rooms,
        call: impl FnOnce(&Batch<'_>, &Values<'_>, &Values<'_>) -> Result<T, E>,
    ) -> Result<T, E> {
        let Site { plan, law, piece, .. } = *site;
        let (points, part, dt) = (range.len(), moment.at, moment.dt);
        let fields = plan.fields;
        let wants = |field: Field| fields.contains(field);
        let any = |list: &[Field]| list.iter().any(|field| fields.contains(*field));
        let length = piece.end - piece.start;
        let start = piece.start + moment.from * length;
        let mut builder = Batch::builder(law, points).numbers(CallNumbers {
            dimension: i64::from(plan.dimension),
            time: start,
            dt,
            step_time: start - piece.placed.start,
            load_step: piece.placed.number,
            substep: piece.substep,
            cycle: piece.placed.cycle,
            material: plan.material.number,
            reference_temperature: plan.units.reference_temperature.unwrap_or(0.0),
            absolute_zero: plan.units.absolute_zero(),
            units: plan.sizes,
            ..CallNumbers::default()
        });
        let pressure = self.driving_pressure(plan, part, range.clone(), (&mut rooms.pressure, &mut rooms.parts));
        let normals = self.normals(part, range.clone(), &mut rooms.normal, &mut rooms.parts);
        if wants(Field::NodalTraction) {
            builder = builder
                .field(Field::NodalTraction, self.traction(part, range.clone(), &mut rooms.traction, &mut rooms.parts));
        }
        let temperature = if plan.temperature {
            self.temperature.at(part, range.clone(), &mut rooms.temperature)
        } else {
            Values::Absent
        };
        let constants = plan.material.constants.at(
            start + (part - moment.from) * length,
            &temperature,
            points,
            &mut rooms.constants,
        );
        builder =
            builder.constant_values(&constants).field(Field::Pressure, pressure).field(Field::Temperature, temperature);
        if wants(Field::Normal) {
            builder = builder.field(Field::Normal, normals);
        }
        let directed = any(&[Field::Tangent, Field::SlipVector, Field::FrictionStress]);
        let tangents = match normals {
            _ if !directed => Values::Absent,
            Values::UniformVector(_) => Values::UniformVector(ALONG),
            _ => vectors(points, &mut rooms.tangent, |i| tangent(vector(&normals, i))),
        };
        if wants(Field::Tangent) {
            builder = builder.field(Field::Tangent, tangents);
        }
        let [u, v, w] = &mut rooms.velocity;
        let velocity = match self.motion {
            Motion::None => [Values::Uniform(0.0); 3],
            Motion::Velocity => [self.velocity.at(part, range.clone(), u), Values::Uniform(0.0), Values::Uniform(0.0)],
            Motion::Slip => [self.slip[0].at(range.clone(), u), Values::Uniform(0.0), Values::Uniform(0.0)],
            Motion::SlipVector => [
                self.slip[0].at(range.clone(), u),
                self.slip[1].at(range.clone(), v),
                self.slip[2].at(range.clone(), w),
            ],
        };
        let moves =
            any(&[Field::Velocity, Field::Slip, Field::FrictionWork, Field::FrictionStress, Field::ContactState]);
        let speed = match self.motion {
            _ if !moves => Values::Absent,
            Motion::SlipVector => speed_of(&velocity, points, &mut rooms.speed),
            _ => match velocity[0] {
                Values::PerPoint(all) if no_sign(all) => velocity[0],
                _ => map(&velocity[0], &mut rooms.speed, f64::abs),
            },
        };
        builder = builder.field(Field::Velocity, speed);
        let slip = if any(&[Field::Slip, Field::FrictionWork]) {
            let exact = moment.at != moment.from && self.motion == Motion::Velocity && !self.velocity.is_constant();
            let to = moment.from + if length > 0.0 { dt / length } else { 0.0 };
            match site.whole && exact {
                true => self.paths((moment.from, to), length, range.clone(), &mut rooms.slip, &mut rooms.parts),
                false => map(&speed, &mut rooms.slip, |speed| speed * dt),
            }
        } else {
            Values::Absent
        };
        builder = builder.field(Field::Slip, slip);
        let moved = |i: usize| match self.motion {
            Motion::SlipVector => [0, 1, 2].map(|k| value(&velocity[k], i)),
            _ => vector(&tangents, i).map(|along| along * value(&velocity[0], i)),
        };
        if wants(Field::SlipVector) {
            let vectors = vectors(points, &mut rooms.slip_vector, |i| moved(i).map(|v| v * dt));
            builder = builder.field(Field::SlipVector, vectors);
        }
        if any(&[Field::FrictionWork, Field::FrictionStress, Field::FrictionCoefficient]) {
            let friction = self.friction.at(part, range.clone(), &mut rooms.coefficient);
            let shear = match self.shear.is_absent() {
                false => self.shear.at(part, range.clone(), &mut rooms.shear),
                true => zip(&friction, &pressure, points, &mut rooms.shear, |mu, p| mu * p.max(0.0)),
            };
            if wants(Field::FrictionWork) {
                let work = zip(&shear, &slip, points, &mut rooms.work, |shear, slip| shear.abs() * slip);
                builder = builder.field(Field::FrictionWork, work);
            }
            if wants(Field::FrictionStress) {
                let given = !self.shear.is_absent();
                let stress = vectors(points, &mut rooms.stress, |i| match (given, value(&speed, i)) {
                    (true, _) => vector(&tangents, i).map(|along| along * value(&shear, i)),
                    (false, 0.0) => [0.0; 3],
                    // Friction on the worn body opposes its own motion.
                    (false, speed) => moved(i).map(|v| -value(&shear, i) * v / speed),
                });
                builder = builder.field(Field::FrictionStress, stress);
            }
            builder = builder.field(Field::FrictionCoefficient, friction);
        }
        if wants(Field::Area) {
            builder = builder.field(Field::Area, self.area.at(part, range.clone(), &mut rooms.area));
        }
        if wants(Field::Coordinates) {
            let [x, y, z, ..] = &mut rooms.parts;
            let c = [
                self.coordinates[0].at(part, range.clone(), x),
                self.coordinates[1].at(part, range.clone(), y),
                self.coordinates[2].at(part, range.clone(), z),
            ];
            let coordinates = vectors(points, &mut rooms.coordinates, |i| [0, 1, 2].map(|k| value(&c[k], i)));
            builder = builder.field(Field::Coordinates, coordinates);
        }
        if wants(Field::ContactState) {
            rooms.contact.clear();
            rooms.contact.extend((0..points).map(|i| contact_state(value(&pressure, i), value(&speed, i))));
            builder = builder.indices(Field::ContactState, Indices::PerPoint(&rooms.contact));
        }
        if wants(Field::PointId) {
            rooms.ids.clear();
            rooms.ids.extend(range.clone().map(|i| site.id(i)));
            builder = builder.indices(Field::PointId, Indices::PerPoint(&rooms.ids));
        }
        if wants(Field::AccumulatedWear) {
            builder = builder.field(Field::AccumulatedWear, Values::PerPoint(remembered.wear));
        }
        if wants(Field::AccumulatedSlip) {
            builder = builder.field(Field::AccumulatedSlip, remembered.distance);
        }
        if !law.state.is_empty() {
            builder = builder.state(Values::PerPoint(remembered.state));
        }
        rooms.inputs.resize_with(self.inputs.len(), Vec::new);
        let inputs: Vec<Values<'_>> = self
            .inputs
            .iter()
            .zip(&mut rooms.inputs)
            .map(|(source, room)| source.at(part, range.clone(), room))
            .collect();
        let batch = builder.inputs(&inputs).build()?;
        call(&batch, &pressure, &normals)
    }
}
