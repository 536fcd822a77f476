//! Ranges of numbers.

use std::fmt;

/// The largest count: whole numbers up to here are exact as floats.
pub(super) const LARGEST_COUNT: u64 = 1 << 53;

/// The range a number must lie in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// Any finite number.
    Finite,
    /// The number or more.
    AtLeast(f64),
    /// More than the number.
    Above(f64),
    /// Between the numbers, both excluded.
    Between(f64, f64),
    /// From the first to the second, both included.
    FromTo(f64, f64),
    /// Above the first and up to the second.
    AboveUpTo(f64, f64),
}

impl Bound {
    /// Whether a number lies in the range; NaN and the infinities never do.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::AtLeast(least) => value >= least,
                Self::Above(least) => value > least,
                Self::Between(low, high) => value > low && value < high,
                Self::FromTo(low, high) => value >= low && value <= high,
                Self::AboveUpTo(low, high) => value > low && value <= high,
            }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite => write!(f, "a finite number"),
            Self::AtLeast(least) => write!(f, "a number not below {least}"),
            Self::Above(least) => write!(f, "a number above {least}"),
            Self::Between(low, high) => write!(f, "a number above {low} and below {high}"),
            Self::FromTo(low, high) => write!(f, "a number from {low} to {high}"),
            Self::AboveUpTo(low, high) => write!(f, "a number above {low} and not above {high}"),
        }
    }
}
