//! What drives the points over one piece: pressure, motion and whatever else the scene gives, at any moment of it.

use std::ops::Range;

use crate::contact::prescribed::{Column, History, Motion};
use crate::law::{Field, Values};
use crate::plan::{Linear, Plan};
use crate::scene::Basis;
use crate::solve::kinematics::{UP, normal_at, path, speeds};
use crate::solve::schedule::Piece;
use crate::solve::source::{Rate, Source, value, vectors, zip};

/// Everything that drives the points over one piece.
pub(super) struct Drive<'h> {
    pub(super) pressure: Source<'h>,
    pub(super) velocity: Source<'h>,
    pub(super) slip: [Rate<'h>; 3],
    pub(super) temperature: Source<'h>,
    pub(super) shear: Source<'h>,
    pub(super) friction: Source<'h>,
    normal: [Source<'h>; 3],
    stress: [Source<'h>; 6],
    area: Source<'h>,
    pub(super) coordinates: [Source<'h>; 3],
    pub(super) inputs: Vec<Source<'h>>,
    pub(super) motion: Motion,
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
    pub(super) fn traction<'b>(
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
}
