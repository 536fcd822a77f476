//! How a call is laid out: which fields are given and how they lie, what is asked for, and what is around the arrays.

use super::arrays::Room;
use wearlaw_law::{Field, Fields, LawDescriptor, OutputItem};

/// How the values of a column lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spread {
    /// One after the other.
    PerPoint,
    /// One for all.
    Uniform,
    /// With so many times the room of one between them.
    Strided(usize),
}

/// Which fields are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Given {
    /// All, also those that the law does not declare: then only one check finds a law that reads them.
    All,
    /// What the law reads or uses, as a host does it.
    Declared,
}

/// Which outputs are asked for beside the increment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Asked {
    pub(crate) direction: bool,
    pub(crate) state: bool,
    pub(crate) d_pressure: bool,
    pub(crate) status: bool,
}

impl Asked {
    /// The increment alone.
    pub(crate) const NOTHING: Self = Self { direction: false, state: false, d_pressure: false, status: false };

    /// Everything that the law can write, without statuses.
    pub(crate) fn values(law: &LawDescriptor) -> Self {
        Self {
            direction: law.writes(OutputItem::Direction),
            state: !law.state.is_empty(),
            d_pressure: law.writes(OutputItem::DPressure),
            status: false,
        }
    }

    /// Everything that the law can write, and statuses: no pointer is NULL.
    pub(crate) fn everything(law: &LawDescriptor) -> Self {
        Self { status: true, ..Self::values(law) }
    }

    /// Every way of asking that hosts use: with and without derivative, with and without statuses, the increment alone.
    pub(crate) fn ways(law: &LawDescriptor) -> Vec<Self> {
        let all = Self::values(law);
        let mut ways = vec![all, Self { status: true, ..all }];
        if all.d_pressure {
            ways.push(Self { d_pressure: false, ..all });
        }
        if all.direction || all.state {
            ways.push(Self::NOTHING);
        }
        ways
    }
}

/// How a case is laid out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layout {
    pub(crate) given: Given,
    pub(crate) asked: Asked,
    pub(crate) room: Room,
    /// Inputs cannot be written; needs a room with guards.
    pub(crate) sealed: bool,
    /// The state at the start cannot be written either.
    pub(crate) state_sealed: bool,
    /// Fields that are not given, whatever `given` says.
    pub(crate) absent: Fields,
    /// Fields that are given once for all points.
    pub(crate) uniform: Fields,
    /// Fields that lie as `fields` says; the others that are not given once lie side by side.
    pub(crate) spread: Fields,
    pub(crate) fields: Spread,
    pub(crate) inputs: Spread,
    /// How the state at the start lies; never once for all points.
    pub(crate) state: Spread,
    pub(crate) constants: Spread,
    /// The only constant that lies as `constants` says; the others are given once.
    pub(crate) constant_alone: Option<usize>,
    /// Every column lies in a way of its own by these bits: given once where its values are the same at all points, side by
    /// side, or with gaps; those that are given once anyway stay so.
    pub(crate) mixed: Option<u64>,
    /// Which arrays, in the order in which they are made, begin eight bytes later.
    pub(crate) skews: u64,
    /// Doubles by which every array of doubles is moved away from an even address.
    pub(crate) skew: usize,
    /// Bytes of the buffer for a text; none: NULL.
    pub(crate) text: Option<usize>,
    /// What the outputs hold before the call.
    pub(crate) filling: u64,
}

impl Layout {
    /// Columns per point, constants given once, room all around, every value that the law can write.
    pub(crate) fn plain(law: &LawDescriptor) -> Self {
        Self {
            given: Given::All,
            asked: Asked::values(law),
            room: Room::Plain,
            sealed: false,
            state_sealed: false,
            absent: Fields::EMPTY,
            uniform: Fields::EMPTY,
            spread: Field::ALL.iter().copied().collect(),
            fields: Spread::PerPoint,
            inputs: Spread::PerPoint,
            state: Spread::PerPoint,
            constants: Spread::Uniform,
            constant_alone: None,
            mixed: None,
            skews: 0,
            skew: 0,
            text: None,
            filling: 0,
        }
    }

    /// As [`Layout::plain`], with everything asked for.
    pub(crate) fn everything(law: &LawDescriptor) -> Self {
        Self { asked: Asked::everything(law), ..Self::plain(law) }
    }
}
