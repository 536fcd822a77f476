//! What a law is given at one moment of a piece: every field it declared, and nothing else.

use std::ops::Range;

use crate::contact::prescribed::Motion;
use crate::law::{Batch, BatchBuilder, BatchError, CallNumbers, Field, Indices, Values};
use crate::solve::inputs::Drive;
use crate::solve::kinematics::{ALONG, contact_state, speed_of, tangent};
use crate::solve::site::{Moment, Remembered, Rooms, Site};
use crate::solve::source::{map, value, vector, vectors, zip};
use crate::solve::sweeps::no_sign;

/// A call in the making.
struct Call<'c, 'h> {
    drive: &'c Drive<'h>,
    site: &'c Site<'c>,
    moment: &'c Moment,
    range: Range<usize>,
}

/// How the points move at the moment of a call.
struct Movement<'v> {
    /// Along the first tangent, or the components of a vector.
    velocity: [Values<'v>; 3],
    /// Its size, where a field depends on it.
    speed: Values<'v>,
    /// Length of the path over the call's duration, where a field depends on it.
    slip: Values<'v>,
    /// First tangents, where a field depends on them.
    tangents: Values<'v>,
    motion: Motion,
}

impl Movement<'_> {
    /// The velocity of a point as a vector.
    fn vector(&self, i: usize) -> [f64; 3] {
        match self.motion {
            Motion::SlipVector => [0, 1, 2].map(|k| value(&self.velocity[k], i)),
            _ => vector(&self.tangents, i).map(|along| along * value(&self.velocity[0], i)),
        }
    }
}

impl Drive<'_> {
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
        let Rooms { parts, .. } = rooms;
        let pressure = self.driving_pressure(site.plan, moment.at, range.clone(), (&mut rooms.pressure, parts));
        let normals = self.normals(moment.at, range.clone(), &mut rooms.normal, parts);
        let making = Call { drive: self, site, moment, range };
        let temperature = match site.plan.temperature {
            true => self.temperature.at(moment.at, making.range.clone(), &mut rooms.temperature),
            false => Values::Absent,
        };
        let at = making.start() + (moment.at - moment.from) * making.length();
        let constants = site.plan.material.constants.at(at, &temperature, making.points(), &mut rooms.constants);
        let tangents = making.tangents(&normals, &mut rooms.tangent);
        let velocity = making.velocity(&mut rooms.velocity);
        let speed = making.speed(&velocity, &mut rooms.speed);
        let slip = making.slip(&speed, &mut rooms.slip, parts);
        let movement = Movement { velocity, speed, slip, tangents, motion: self.motion };

        let mut builder = Batch::builder(site.law, making.points())
            .numbers(making.numbers())
            .constant_values(&constants)
            .field(Field::Pressure, pressure)
            .field(Field::Temperature, temperature)
            .field(Field::Velocity, movement.speed)
            .field(Field::Slip, movement.slip);
        if making.wants(Field::NodalTraction) {
            let traction = self.traction(moment.at, making.range.clone(), &mut rooms.traction, parts);
            builder = builder.field(Field::NodalTraction, traction);
        }
        if making.wants(Field::Normal) {
            builder = builder.field(Field::Normal, normals);
        }
        if making.wants(Field::Tangent) {
            builder = builder.field(Field::Tangent, movement.tangents);
        }
        if making.wants(Field::SlipVector) {
            let dt = moment.dt;
            let vectors = vectors(making.points(), &mut rooms.slip_vector, |i| {
                movement.vector(i).map(|component| component * dt)
            });
            builder = builder.field(Field::SlipVector, vectors);
        }
        let Rooms { coefficient, shear, work, stress, .. } = rooms;
        builder = making.with_friction(builder, &pressure, &movement, (coefficient, shear), (work, stress));
        builder = making.with_places(builder, &mut rooms.area, &mut rooms.coordinates, &mut rooms.parts);
        if making.wants(Field::ContactState) {
            let states = (0..making.points()).map(|i| contact_state(value(&pressure, i), value(&movement.speed, i)));
            builder = builder.indices(Field::ContactState, indices(&mut rooms.contact, states));
        }
        if making.wants(Field::PointId) {
            let ids = making.range.clone().map(|i| site.id(i));
            builder = builder.indices(Field::PointId, indices(&mut rooms.ids, ids));
        }
        if making.wants(Field::AccumulatedWear) {
            builder = builder.field(Field::AccumulatedWear, Values::PerPoint(remembered.wear));
        }
        if making.wants(Field::AccumulatedSlip) {
            builder = builder.field(Field::AccumulatedSlip, remembered.distance);
        }
        if !site.law.state.is_empty() {
            builder = builder.state(Values::PerPoint(remembered.state));
        }
        let inputs = making.inputs(&mut rooms.inputs);
        let batch = builder.inputs(&inputs).build()?;
        call(&batch, &pressure, &normals)
    }
}

impl Call<'_, '_> {
    fn wants(&self, field: Field) -> bool {
        self.site.plan.fields.contains(field)
    }

    fn wants_any(&self, fields: &[Field]) -> bool {
        fields.iter().any(|field| self.wants(*field))
    }

    fn points(&self) -> usize {
        self.range.len()
    }

    /// Length of the piece; time.
    fn length(&self) -> f64 {
        self.site.piece.end - self.site.piece.start
    }

    /// When the call's time begins.
    fn start(&self) -> f64 {
        self.site.piece.start + self.moment.from * self.length()
    }

    fn numbers(&self) -> CallNumbers {
        let Site { plan, piece, .. } = *self.site;
        CallNumbers {
            dimension: i64::from(plan.dimension),
            time: self.start(),
            dt: self.moment.dt,
            step_time: self.start() - piece.placed.start,
            load_step: piece.placed.number,
            substep: piece.substep,
            cycle: piece.placed.cycle,
            material: plan.material.number,
            reference_temperature: plan.units.reference_temperature.unwrap_or(0.0),
            absolute_zero: plan.units.absolute_zero(),
            units: plan.sizes,
            ..CallNumbers::default()
        }
    }

    fn tangents<'b>(&self, normals: &Values<'_>, room: &'b mut Vec<f64>) -> Values<'b> {
        match normals {
            _ if !self.wants_any(&[Field::Tangent, Field::SlipVector, Field::FrictionStress]) => Values::Absent,
            Values::UniformVector(_) => Values::UniformVector(ALONG),
            _ => vectors(self.points(), room, |i| tangent(vector(normals, i))),
        }
    }

    fn velocity<'b>(&'b self, [u, v, w]: &'b mut [Vec<f64>; 3]) -> [Values<'b>; 3] {
        let (drive, still) = (self.drive, Values::Uniform(0.0));
        match drive.motion {
            Motion::None => [still; 3],
            Motion::Velocity => [drive.velocity.at(self.moment.at, self.range.clone(), u), still, still],
            Motion::Slip => [drive.slip[0].at(self.range.clone(), u), still, still],
            Motion::SlipVector => [
                drive.slip[0].at(self.range.clone(), u),
                drive.slip[1].at(self.range.clone(), v),
                drive.slip[2].at(self.range.clone(), w),
            ],
        }
    }

    fn speed<'b>(&self, velocity: &[Values<'b>; 3], room: &'b mut Vec<f64>) -> Values<'b> {
        let moved = [Field::Velocity, Field::Slip, Field::FrictionWork, Field::FrictionStress, Field::ContactState];
        match self.drive.motion {
            _ if !self.wants_any(&moved) => Values::Absent,
            Motion::SlipVector => speed_of(velocity, self.points(), room),
            _ => match velocity[0] {
                Values::PerPoint(all) if no_sign(all) => velocity[0],
                _ => map(&velocity[0], room, f64::abs),
            },
        }
    }

    fn slip<'b>(&self, speed: &Values<'_>, room: &'b mut Vec<f64>, parts: &mut [Vec<f64>; 9]) -> Values<'b> {
        if !self.wants_any(&[Field::Slip, Field::FrictionWork]) {
            return Values::Absent;
        }
        let (drive, moment, length) = (self.drive, self.moment, self.length());
        let exact = moment.at != moment.from && drive.motion == Motion::Velocity && !drive.velocity.is_constant();
        let to = moment.from + if length > 0.0 { moment.dt / length } else { 0.0 };
        match self.site.whole && exact {
            true => drive.paths((moment.from, to), length, self.range.clone(), room, parts),
            false => map(speed, room, |speed| speed * moment.dt),
        }
    }

    /// Adds what comes of friction: the coefficient, and work and stress by it or by a shear stress that is given.
    fn with_friction<'b>(
        &'b self,
        mut builder: BatchBuilder<'b>,
        pressure: &Values<'_>,
        movement: &Movement<'_>,
        (coefficient, shear): (&'b mut Vec<f64>, &mut Vec<f64>),
        (work, stress): (&'b mut Vec<f64>, &'b mut Vec<f64>),
    ) -> BatchBuilder<'b> {
        if !self.wants_any(&[Field::FrictionWork, Field::FrictionStress, Field::FrictionCoefficient]) {
            return builder;
        }
        let (drive, points) = (self.drive, self.points());
        let friction = drive.friction.at(self.moment.at, self.range.clone(), coefficient);
        let is_given = !drive.shear.is_absent();
        let shear = match is_given {
            true => drive.shear.at(self.moment.at, self.range.clone(), shear),
            false => zip(&friction, pressure, points, shear, |mu, p| mu * p.max(0.0)),
        };
        if self.wants(Field::FrictionWork) {
            let work = zip(&shear, &movement.slip, points, work, |shear, slip| shear.abs() * slip);
            builder = builder.field(Field::FrictionWork, work);
        }
        if self.wants(Field::FrictionStress) {
            let stress = vectors(points, stress, |i| match (is_given, value(&movement.speed, i)) {
                (true, _) => vector(&movement.tangents, i).map(|along| along * value(&shear, i)),
                (false, 0.0) => [0.0; 3],
                // Friction on the worn body opposes its own motion.
                (false, speed) => movement.vector(i).map(|v| -value(&shear, i) * v / speed),
            });
            builder = builder.field(Field::FrictionStress, stress);
        }
        builder.field(Field::FrictionCoefficient, friction)
    }

    /// Adds how large the points are and where they lie.
    fn with_places<'b>(
        &'b self,
        mut builder: BatchBuilder<'b>,
        area: &'b mut Vec<f64>,
        coordinates: &'b mut Vec<f64>,
        [x, y, z, ..]: &mut [Vec<f64>; 9],
    ) -> BatchBuilder<'b> {
        if self.wants(Field::Area) {
            builder = builder.field(Field::Area, self.drive.areas(self.moment.at, self.range.clone(), area));
        }
        if self.wants(Field::Coordinates) {
            let [first, second, third] = &self.drive.coordinates;
            let along = [(first, x), (second, y), (third, z)];
            let c = along.map(|(source, room)| source.at(self.moment.at, self.range.clone(), room));
            let places = vectors(self.points(), coordinates, |i| [0, 1, 2].map(|k| value(&c[k], i)));
            builder = builder.field(Field::Coordinates, places);
        }
        builder
    }

    fn inputs<'b>(&'b self, rooms: &'b mut Vec<Vec<f64>>) -> Vec<Values<'b>> {
        rooms.resize_with(self.drive.inputs.len(), Vec::new);
        let sources = self.drive.inputs.iter().zip(rooms);
        sources.map(|(source, room)| source.at(self.moment.at, self.range.clone(), room)).collect()
    }
}

/// Numbers for every point, kept in `room`.
fn indices(room: &mut Vec<i64>, numbers: impl Iterator<Item = i64>) -> Indices<'_> {
    room.clear();
    room.extend(numbers);
    Indices::PerPoint(room)
}
