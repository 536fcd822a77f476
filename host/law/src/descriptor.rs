//! What a law says of itself, owned and validated.

use serde::{Deserialize, Serialize};

use super::fields::{Claim, Claims, Fields, Flag, Flags, OutputItem, OutputItems};
use super::number_text;

/// A constant, state variable or further input of a law; bounds and default in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// Name: a letter, then letters, digits and underscores.
    pub name: String,
    /// One line on what it is.
    pub summary: String,
    /// SI exponents of metre, kilogram, second and kelvin.
    pub exponents: [f64; 4],
    /// Smallest value allowed; minus infinity: none.
    #[serde(with = "number_text")]
    pub minimum: f64,
    /// Largest value allowed; infinity: none.
    #[serde(with = "number_text")]
    pub maximum: f64,
    /// Default of a constant or input, initial value of a state variable; none: it must be given.
    pub default: Option<f64>,
    /// The unit of this constant follows from the others.
    pub closes_units: bool,
    /// The minimum itself is excluded.
    pub above_minimum: bool,
    /// The maximum itself is excluded.
    pub below_maximum: bool,
}

impl Quantity {
    /// True if a value in SI units keeps the bounds; NaN never does.
    pub fn allows(&self, value: f64) -> bool {
        let low = if self.above_minimum { value > self.minimum } else { value >= self.minimum };
        let high = if self.below_maximum { value < self.maximum } else { value <= self.maximum };
        low && high && value.is_finite()
    }

    /// The bounds as an interval, `[0, inf)` or `(0, 5]`.
    pub fn interval(&self) -> String {
        let open = self.above_minimum || self.minimum == f64::NEG_INFINITY;
        let close = self.below_maximum || self.maximum == f64::INFINITY;
        format!("{}{}, {}{}", if open { '(' } else { '[' }, self.minimum, self.maximum, if close { ')' } else { ']' })
    }
}

/// The claimed degree of homogeneity of the wear increment in the contact pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Degree {
    /// No claim.
    Unclaimed,
    /// This number.
    Value(f64),
    /// The value of the constant with this index (from 0).
    Constant(usize),
}

impl Degree {
    /// The degree for these values of the constants, if one is claimed.
    pub fn value(self, constants: &[f64]) -> Option<f64> {
        match self {
            Degree::Unclaimed => None,
            Degree::Value(value) => Some(value),
            Degree::Constant(index) => constants.get(index).copied(),
        }
    }
}

/// What a law is: its name, what it reads and writes, what it claims, its constants and its memory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LawDescriptor {
    /// Name: letters, digits, `-` and `_`.
    pub name: String,
    /// Version of the law.
    pub version: String,
    /// One line on what the law does.
    pub summary: String,
    /// Where its equation comes from; may be empty.
    pub source: String,
    /// Minor version of the ABI that the law was built for.
    pub abi_minor: i64,
    /// Fields that the law must have.
    pub reads: Fields,
    /// Fields that the law uses if they are there.
    pub uses: Fields,
    /// Outputs that the law can write beside the wear increment.
    pub writes: OutputItems,
    /// What the law claims of itself.
    pub claims: Claims,
    /// What the host must mind.
    pub flags: Flags,
    /// Constants, in the order of their positions.
    pub constants: Vec<Quantity>,
    /// State variables at a point.
    pub state: Vec<Quantity>,
    /// Further inputs that the law declares by name.
    pub inputs: Vec<Quantity>,
    /// Claimed degree of homogeneity in the pressure.
    pub pressure_degree: Degree,
}

impl LawDescriptor {
    /// Fields that the law reads or uses; a host passes no others.
    pub fn fields(&self) -> Fields {
        self.reads.union(self.uses)
    }

    /// True if the law claims it.
    pub fn claims(&self, claim: Claim) -> bool {
        self.claims.contains(claim)
    }

    /// True if the law can write it.
    pub fn writes(&self, item: OutputItem) -> bool {
        self.writes.contains(item)
    }

    /// True if one instance must not be evaluated from several threads at once.
    pub fn is_serial(&self) -> bool {
        self.flags.contains(Flag::Serial)
    }

    /// True if the law wants points out of contact too.
    pub fn wants_open_points(&self) -> bool {
        self.flags.contains(Flag::OpenPoints)
    }

    /// Initial values of the state variables at a point, in SI units; none for one that must be given.
    pub fn initial_state(&self) -> Vec<Option<f64>> {
        self.state.iter().map(|variable| variable.default).collect()
    }
}
