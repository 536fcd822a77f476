//! What a caller hands to a batch: values of a field over the points, and the numbers that hold for all of them.

use serde::{Deserialize, Serialize};

/// Values of a real field, constant, further input or state over the points of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Values<'a> {
    /// Not there.
    #[default]
    Absent,
    /// One number for all points (all three components of a vector, all state variables).
    Uniform(f64),
    /// One vector for all points; of a vector field only.
    UniformVector([f64; 3]),
    /// Adjacent values: `[points]`, of a vector `[points][3]`, of the state `[points][variables]`.
    PerPoint(&'a [f64]),
    /// Values in another array: those of point i begin at `data[i * step]`.
    Strided {
        /// The array.
        data: &'a [f64],
        /// Doubles from one point to the next.
        step: usize,
    },
}

/// Values of an integer field over the points of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Indices<'a> {
    /// Not there.
    #[default]
    Absent,
    /// One number for all points.
    Uniform(i64),
    /// One number a point.
    PerPoint(&'a [i64]),
    /// Numbers in another array: that of point i is `data[i * step]`.
    Strided {
        /// The array.
        data: &'a [i64],
        /// Integers from one point to the next.
        step: usize,
    },
}

/// SI sizes of a scene's units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnitSizes {
    /// Metres in the unit of length.
    pub metre: f64,
    /// Kilograms in the unit of mass.
    pub kilogram: f64,
    /// Seconds in the unit of time.
    pub second: f64,
    /// Kelvin in the degree of temperature.
    pub kelvin: f64,
}

impl UnitSizes {
    /// SI units.
    pub const SI: Self = Self { metre: 1.0, kilogram: 1.0, second: 1.0, kelvin: 1.0 };

    /// What a number in the scene's units is multiplied with to be in SI units.
    pub fn factor(&self, exponents: [f64; 4]) -> f64 {
        [self.metre, self.kilogram, self.second, self.kelvin]
            .into_iter()
            .zip(exponents)
            .filter(|(size, exponent)| *exponent != 0.0 && *size != 1.0)
            .map(|(size, exponent)| size.powf(exponent))
            .product()
    }
}

impl Default for UnitSizes {
    fn default() -> Self {
        Self::SI
    }
}

/// The numbers of a call that hold for all of its points; times and temperatures in the scene's units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CallNumbers {
    /// Dimension of the scene, 2 or 3.
    pub dimension: i64,
    /// Time at the start of the substep.
    pub time: f64,
    /// Duration of the substep (represented time).
    pub dt: f64,
    /// Time since the start of the load step.
    pub step_time: f64,
    /// Number of the load step, from 1.
    pub load_step: i64,
    /// Number of the substep in its load step, from 1.
    pub substep: i64,
    /// Number of the cycle, from 1; 0 outside cycles.
    pub cycle: i64,
    /// Number of the wear material.
    pub material: i64,
    /// Number of the contact pair.
    pub pair: i64,
    /// Number of the worn body.
    pub body: i64,
    /// Number of the counter body.
    pub counter_body: i64,
    /// Reference temperature, in the scene's temperature scale.
    pub reference_temperature: f64,
    /// Temperature of absolute zero, in the scene's temperature scale.
    pub absolute_zero: f64,
    /// SI sizes of the scene's units.
    pub units: UnitSizes,
}

impl Default for CallNumbers {
    /// A first substep of no duration, in 3-D and SI units, in a temperature scale that begins at absolute zero.
    fn default() -> Self {
        Self {
            dimension: 3,
            time: 0.0,
            dt: 0.0,
            step_time: 0.0,
            load_step: 1,
            substep: 1,
            cycle: 0,
            material: 1,
            pair: 1,
            body: 1,
            counter_body: 2,
            reference_temperature: 0.0,
            absolute_zero: 0.0,
            units: UnitSizes::SI,
        }
    }
}
