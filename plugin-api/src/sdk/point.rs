//! A law written for one point, and the loop over the batch that is made for it.
//!
//! Fields that lie side by side are read in place; uniform and strided ones go through blocks of [`BLOCK`] values, so
//! that one loop with unit steps serves all of them and the compiler can vectorise it. What a law did not declare is
//! never loaded: the masks are constants, so the tests on them vanish at compile time.

use core::mem::MaybeUninit;

use crate::abi::{
    WL_FIELD_ACCUMULATED_SLIP, WL_FIELD_ACCUMULATED_WEAR, WL_FIELD_AREA, WL_FIELD_CONTACT_STATE, WL_FIELD_COORDINATES,
    WL_FIELD_COUNTER_TEMPERATURE, WL_FIELD_ELEMENT_ID, WL_FIELD_FRICTION_COEFFICIENT, WL_FIELD_FRICTION_STRESS,
    WL_FIELD_FRICTION_WORK, WL_FIELD_GAP, WL_FIELD_NODAL_TRACTION, WL_FIELD_NORMAL, WL_FIELD_POINT_ID,
    WL_FIELD_PRESSURE, WL_FIELD_SLIP, WL_FIELD_SLIP_VECTOR, WL_FIELD_TANGENT, WL_FIELD_TEMPERATURE, WL_FIELD_VELOCITY,
    WL_OUT_DIRECTION,
};

use super::{About, Answer, Batch, Column, Law, Status};

/// Points that are handled between two looks at the columns.
const BLOCK: usize = 64;
/// A block of a field that the call does not give.
static ABSENT: [f64; BLOCK] = [f64::NAN; BLOCK];
/// Most constants, and most further inputs, of a law written for one point.
const MOST: usize = 16;
/// Most state variables of a law written for one point.
const MOST_STATE: usize = 8;

/// The inputs at one point. A field that the law did not declare, or that is absent, is NaN (index: -1).
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Contact pressure.
    pub pressure: f64,
    /// Slip increment.
    pub slip: f64,
    /// Sliding velocity.
    pub velocity: f64,
    /// Net slip displacement.
    pub slip_vector: [f64; 3],
    /// Outward unit normal of the worn body.
    pub normal: [f64; 3],
    /// Position.
    pub coordinates: [f64; 3],
    /// First unit tangent.
    pub tangent: [f64; 3],
    /// Temperature of the worn surface.
    pub temperature: f64,
    /// Temperature of the counter surface.
    pub counter_temperature: f64,
    /// Friction stress on the worn body.
    pub friction_stress: [f64; 3],
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Friction work per area over the substep.
    pub friction_work: f64,
    /// Wear depth at the start of the substep.
    pub accumulated_wear: f64,
    /// Sliding distance at the start of the substep.
    pub accumulated_slip: f64,
    /// Normal traction from nodal stresses.
    pub nodal_traction: f64,
    /// Gap between the surfaces.
    pub gap: f64,
    /// Area that belongs to the point.
    pub area: f64,
    /// Contact state, `WL_OPEN`, `WL_STICK` or `WL_SLIDING`.
    pub contact_state: i64,
    /// Number of the point in the host's numbering.
    pub point_id: i64,
    /// Number of the contact element.
    pub element_id: i64,
    /// Duration of the substep.
    pub dt: f64,
    /// Time at the start of the substep.
    pub time: f64,
    /// Temperature of absolute zero, in the scene's temperature scale.
    pub absolute_zero: f64,
    constants: [f64; MOST],
    inputs: [f64; MOST],
    state: [f64; MOST_STATE],
    counts: [usize; 3],
}

impl Point {
    /// The constants, in the declared order: `let [k, h] = at.constants();`
    ///
    /// # Panics
    /// If the law declares another number of them.
    #[inline(always)]
    pub fn constants<const N: usize>(&self) -> [f64; N] {
        assert!(N == self.counts[0], "{N} constants asked for, {} declared", self.counts[0]);
        first(&self.constants)
    }
    /// The further inputs, in the declared order.
    ///
    /// # Panics
    /// If the law declares another number of them.
    #[inline(always)]
    pub fn inputs<const N: usize>(&self) -> [f64; N] {
        assert!(N == self.counts[1], "{N} inputs asked for, {} declared", self.counts[1]);
        first(&self.inputs)
    }
    /// The state variables at the start of the substep, in the declared order.
    ///
    /// # Panics
    /// If the law declares another number of them.
    #[inline(always)]
    pub fn state<const N: usize>(&self) -> [f64; N] {
        assert!(N == self.counts[2], "{N} state variables asked for, {} declared", self.counts[2]);
        first(&self.state)
    }
}

/// The first numbers of an array. A loop, as a closure is a call where a crate is compiled without inlining across its units.
#[inline(always)]
fn first<const N: usize>(all: &[f64]) -> [f64; N] {
    let mut some = [0.0; N];
    some.copy_from_slice(&all[..N]);
    some
}

/// What a law answers at one point; preset to no wear, against the normal, with the state as it was.
#[derive(Clone, Copy, Debug)]
pub struct PointAnswer {
    /// Wear increment over the substep; length.
    pub increment: f64,
    /// Wear direction, a unit vector.
    pub direction: [f64; 3],
    /// State variables at the end of the substep; the declared number of them counts.
    pub state: [f64; MOST_STATE],
    /// Derivative of the increment with respect to the pressure.
    pub d_pressure: f64,
    /// With [`Status::CutStep`]: factor in (0, 1) for the next try.
    pub dt_factor: f64,
    /// With a bad status: what is wrong.
    pub text: &'static str,
}

/// A law that takes a point at a time.
pub trait PointLaw: About {
    /// Evaluates the law at one point.
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status;
}

macro_rules! put_others {
    ($T:ident, $batch:ident, $i:expr, $at:ident; $($name:ident: $bit:ident $get:ident),*) => {
        $(if ($T::READS | $T::USES) & $bit != 0 {
            if let Some(column) = $batch.$name() { $at.$name = column.$get($i); }
        })*
    };
}

impl<T: PointLaw> Law for T {
    // Amid the guard against panics the loop is not vectorised.
    #[inline(never)]
    fn evaluate(&self, batch: &Batch<'_>, answer: &mut Answer<'_>) -> Status {
        const {
            assert!(T::CONSTANTS.len() <= MOST && T::INPUTS.len() <= MOST, "at most 16 constants and inputs");
            assert!(T::STATE.len() <= MOST_STATE, "at most 8 state variables");
        }
        let missing = batch.missing(T::READS);
        let constants = (0..T::CONSTANTS.len()).map(|k| batch.constant(k));
        let inputs = (0..T::INPUTS.len()).map(|k| batch.input(k));
        if missing != 0 || constants.clone().chain(inputs).any(|column| column.is_none()) {
            answer.miss(missing);
            return answer.worst();
        }
        if !T::STATE.is_empty() && batch.state().is_none() {
            answer.say(Status::MissingInput, format_args!("the call gives no state variables"));
            return answer.worst();
        }
        answer.all_good();
        if constants.flatten().all(|column| column.uniform().is_some()) {
            run::<T, true>(self, batch, answer);
        } else {
            run::<T, false>(self, batch, answer);
        }
        answer.worst()
    }

    #[inline]
    fn increments(&self, batch: &Batch<'_>, increment: &mut [f64]) -> bool {
        T::STATE.is_empty() && T::INPUTS.is_empty() && run_alone::<T>(self, batch, increment)
    }
}

/// Goes over fields that lie side by side with constants that are the same at all points, if they are and all is well.
#[inline(never)]
fn run_alone<T: PointLaw>(law: &T, batch: &Batch<'_>, increment: &mut [f64]) -> bool {
    let points = increment.len();
    if points == 0 || batch.missing(T::READS) != 0 || !Scalars::in_place::<T>(batch) {
        return not_alone();
    }
    let mut blank = blank::<T>(batch);
    for (k, constant) in blank.constants.iter_mut().enumerate().take(T::CONSTANTS.len()) {
        let Some(value) = batch.constant(k).and_then(|column| column.uniform()) else { return not_alone() };
        *constant = value;
    }
    let mut room = Block::empty();
    let scalars = Scalars::load::<T>(batch, 0, points, &mut room);
    let mut worst = Status::Ok;
    for (i, increment) in increment.iter_mut().enumerate() {
        let (status, out) = ask(law, batch, &scalars, i, i, blank);
        *increment = out.increment;
        worst = worst.max(status);
    }
    worst == Status::Ok
}

/// What is seldom so: known to the compiler as that, it lets the loop begin where the processor reads it fastest.
#[cold]
fn not_alone() -> bool {
    false
}

/// Asks the law at point `i`, the `k`th of its block, with what `here` holds already and the fields.
#[inline(always)]
fn ask<T: PointLaw>(
    law: &T,
    batch: &Batch<'_>,
    scalars: &Scalars<'_>,
    k: usize,
    i: usize,
    mut here: Point,
) -> (Status, PointAnswer) {
    scalars.put::<T>(k, &mut here);
    put_others!(T, batch, i, here; slip_vector: WL_FIELD_SLIP_VECTOR vector, normal: WL_FIELD_NORMAL vector,
        coordinates: WL_FIELD_COORDINATES vector, tangent: WL_FIELD_TANGENT vector,
        friction_stress: WL_FIELD_FRICTION_STRESS vector, contact_state: WL_FIELD_CONTACT_STATE get,
        point_id: WL_FIELD_POINT_ID get, element_id: WL_FIELD_ELEMENT_ID get);
    let mut out = PointAnswer {
        increment: 0.0,
        direction: [-here.normal[0], -here.normal[1], -here.normal[2]],
        state: here.state,
        d_pressure: 0.0,
        dt_factor: 0.0,
        text: "",
    };
    (law.point(&here, &mut out), out)
}

/// Value of a constant or an input at point `i`.
#[inline(always)]
fn value_of(column: Option<Column<'_>>, i: usize) -> f64 {
    column.map_or(f64::NAN, |column| column.get(i))
}

macro_rules! scalars {
    ($($name:ident: $bit:ident),*) => {
        /// Room for the scalar fields of one block; only those that do not lie side by side are ever written.
        struct Block { $($name: MaybeUninit<[f64; BLOCK]>,)* }
        impl Block {
            fn empty() -> Block { Block { $($name: MaybeUninit::uninit(),)* } }
        }
        /// The scalar fields of one block, side by side.
        struct Scalars<'b> { $($name: &'b [f64],)* }
        impl<'b> Scalars<'b> {
            /// Whether all of the law's scalar fields lie side by side, so that one block holds any number of points.
            #[inline(always)]
            fn in_place<T: About>(batch: &Batch<'_>) -> bool {
                true $(&& ((T::READS | T::USES) & $bit == 0 || batch.$name().is_some_and(|c| c.slice().is_some())))*
            }
            #[inline(always)]
            fn load<T: About>(batch: &'b Batch<'_>, start: usize, len: usize, room: &'b mut Block) -> Scalars<'b> {
                Scalars { $($name: match batch.$name() {
                    _ if (T::READS | T::USES) & $bit == 0 => &[],
                    None => &ABSENT[..len],
                    Some(column) => match column.slice() {
                        Some(all) => &all[start..start + len],
                        None => column.gather(start, &mut room.$name.write(ABSENT)[..len]),
                    },
                },)* }
            }
            #[inline(always)]
            fn put<T: About>(&self, k: usize, at: &mut Point) {
                $(if (T::READS | T::USES) & $bit != 0 { at.$name = self.$name[k]; })*
            }
        }
    };
}

scalars!(
    pressure: WL_FIELD_PRESSURE, slip: WL_FIELD_SLIP, velocity: WL_FIELD_VELOCITY,
    temperature: WL_FIELD_TEMPERATURE, counter_temperature: WL_FIELD_COUNTER_TEMPERATURE,
    friction_coefficient: WL_FIELD_FRICTION_COEFFICIENT, friction_work: WL_FIELD_FRICTION_WORK,
    accumulated_wear: WL_FIELD_ACCUMULATED_WEAR, accumulated_slip: WL_FIELD_ACCUMULATED_SLIP,
    nodal_traction: WL_FIELD_NODAL_TRACTION, gap: WL_FIELD_GAP, area: WL_FIELD_AREA
);

#[inline(always)]
fn run<T: PointLaw, const UNIFORM: bool>(law: &T, batch: &Batch<'_>, answer: &mut Answer<'_>) {
    let points = batch.points();
    let mut blank = blank::<T>(batch);
    if UNIFORM && points > 0 {
        for (k, constant) in blank.constants.iter_mut().enumerate().take(T::CONSTANTS.len()) {
            *constant = value_of(batch.constant(k), 0);
        }
    }
    let turns = T::WRITES & WL_OUT_DIRECTION != 0;
    let mut room = Block::empty();
    let block = if Scalars::in_place::<T>(batch) { points } else { BLOCK };
    let mut start = 0;
    while start < points {
        let len = block.min(points - start);
        let scalars = Scalars::load::<T>(batch, start, len, &mut room);
        let one = |k: usize| {
            let i = start + k;
            let mut here = blank;
            if !UNIFORM {
                for (k, constant) in here.constants.iter_mut().enumerate().take(T::CONSTANTS.len()) {
                    *constant = value_of(batch.constant(k), i);
                }
            }
            if !T::INPUTS.is_empty() {
                for (k, input) in here.inputs.iter_mut().enumerate().take(T::INPUTS.len()) {
                    *input = value_of(batch.input(k), i);
                }
            }
            if let (false, Some(state)) = (T::STATE.is_empty(), batch.state()) {
                for k in 0..T::STATE.len() {
                    here.state[k] = state.adjacent(i, k);
                }
            }
            ask(law, batch, &scalars, k, i, here)
        };
        let increments = &mut answer.increment[start..start + len];
        let mut derivatives = answer.d_pressure.as_deref_mut().map(|d| &mut d[start..start + len]);
        let mut worst = Status::Ok;
        for (k, increment) in increments.iter_mut().enumerate() {
            let (status, out) = one(k);
            *increment = out.increment;
            if let Some(d) = derivatives.as_deref_mut() {
                d[k] = out.d_pressure;
            }
            if let (true, Some(all)) = (turns, answer.direction.as_deref_mut()) {
                all[start + k] = out.direction;
            }
            if let (false, Some(all)) = (T::STATE.is_empty(), answer.state.as_deref_mut()) {
                let count = T::STATE.len();
                all[(start + k) * count..(start + k + 1) * count].copy_from_slice(&out.state[..count]);
            }
            worst = worst.max(status);
        }
        if worst != Status::Ok {
            note(answer, start, len, one);
        }
        start += len;
    }
}

/// Evaluates a block with bad points once more (laws are pure) to hand their statuses on, off the path of good ones.
#[cold]
fn note(answer: &mut Answer<'_>, start: usize, len: usize, one: impl Fn(usize) -> (Status, PointAnswer)) {
    for k in 0..len {
        match one(k) {
            (Status::Ok, _) => {}
            (Status::CutStep, out) => answer.cut_step(start + k, out.dt_factor, format_args!("{}", out.text)),
            (status, out) => answer.flag(start + k, status, format_args!("{}", out.text)),
        }
    }
}

/// A point at which nothing is known yet but what the whole call shares.
fn blank<T: About>(batch: &Batch<'_>) -> Point {
    let none = [f64::NAN; 3];
    Point {
        pressure: f64::NAN,
        slip: f64::NAN,
        velocity: f64::NAN,
        slip_vector: none,
        normal: none,
        coordinates: none,
        tangent: none,
        temperature: f64::NAN,
        counter_temperature: f64::NAN,
        friction_stress: none,
        friction_coefficient: f64::NAN,
        friction_work: f64::NAN,
        accumulated_wear: f64::NAN,
        accumulated_slip: f64::NAN,
        nodal_traction: f64::NAN,
        gap: f64::NAN,
        area: f64::NAN,
        contact_state: -1,
        point_id: -1,
        element_id: -1,
        dt: batch.dt(),
        time: batch.view().time,
        absolute_zero: batch.view().absolute_zero,
        constants: [f64::NAN; MOST],
        inputs: [f64::NAN; MOST],
        state: [0.0; MOST_STATE],
        counts: [T::CONSTANTS.len(), T::INPUTS.len(), T::STATE.len()],
    }
}
