//! What the exact answers to contact problems have in common: their indenters, what they say of a point, and how they
//! refuse a number.

/// A parabolic body pressed onto a plane, both of which may be elastic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Indenter {
    /// A cylinder in plane strain, gap = x^2 / 2R; loads are per length.
    Line,
    /// A sphere, gap = r^2 / 2R.
    Sphere,
}

/// What an exact answer says of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointAnswer {
    /// Accumulated wear depth; length.
    pub wear_depth: f64,
    /// Contact pressure.
    pub pressure: f64,
}

/// A number for which there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{name} is {found:e}, expected {expected}")]
pub struct QuantityError {
    /// What the number is.
    pub name: &'static str,
    /// The number.
    pub found: f64,
    /// What it should have been.
    pub expected: &'static str,
}

/// Passes a finite number above zero.
pub(super) fn positive(name: &'static str, found: f64) -> Result<f64, QuantityError> {
    if found > 0.0 && found.is_finite() {
        return Ok(found);
    }
    Err(QuantityError { name, found, expected: "a finite number above 0" })
}

/// Passes a finite number of zero or more.
pub(super) fn not_negative(name: &'static str, found: f64) -> Result<f64, QuantityError> {
    if found >= 0.0 && found.is_finite() {
        return Ok(found);
    }
    Err(QuantityError { name, found, expected: "a finite number of 0 or more" })
}
