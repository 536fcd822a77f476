//! A problem in units in which its numbers are near one.
//!
//! The units are powers of two, so the bits of the answer do not depend on the units of the scene as long as those
//! differ by powers of two, and nothing overflows that does not overflow in the answer.

use crate::contact::{Cells, ContactError, Control, Problem};

/// The largest power of two that is not above a positive number.
pub fn power_of_two(value: f64) -> f64 {
    f64::from_bits(value.clamp(f64::MIN_POSITIVE, f64::MAX).to_bits() & 0x7ff0_0000_0000_0000)
}

/// Units of a problem.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// Of gaps and approaches.
    pub gap: f64,
    /// Of pressures.
    pub pressure: f64,
}

/// A problem in its own units, gaps counted from `datum`.
#[derive(Clone, Debug)]
pub struct Scaled {
    /// Units.
    pub units: Units,
    /// What was subtracted from all gaps; in the unit of the caller.
    pub datum: f64,
    /// Gap `[cells]`, infinite where the bodies never touch.
    pub gap: Vec<f64>,
    /// Local compliance `[cells]`, or one for all, or none.
    pub local: Vec<f64>,
    /// Sum of the pressures of all cells, if the load is given; otherwise the approach is 0.
    pub sum: Option<f64>,
    /// Largest error, times the length it is measured with; 0 if that is not known.
    pub bar: f64,
    /// The length that errors are measured with; 0 if it is not known.
    pub scale: f64,
}

impl Scaled {
    /// From a problem; `stiffness` is a power of two near E* over the unit of lengths along the surface.
    ///
    /// # Errors
    /// Numbers that are not finite, and no cell that could touch.
    pub fn new(problem: &Problem<'_>, cells: &Cells, stiffness: f64) -> Result<Scaled, ContactError> {
        let among = |cell: usize| problem.frozen.is_none_or(|set| set[cell]);
        let touching = || problem.gap.iter().enumerate().filter(|(cell, gap)| among(*cell) && **gap != f64::INFINITY);
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut finite = true;
        for (_, gap) in touching() {
            finite &= gap.is_finite();
            lowest = lowest.min(*gap);
            highest = highest.max(*gap);
        }
        let (Control::Load(given) | Control::Approach(given)) = problem.control;
        let largest = highest.abs().max(lowest.abs());
        let not_finite = |what| ContactError::NotFinite { what, gap: largest, given };
        if !finite {
            return Err(not_finite("a gap"));
        }
        if !given.is_finite() {
            return Err(not_finite("a load or approach"));
        }
        let diagonal = (0..problem.gap.len()).map(|cell| problem.diagonal.at(cell));
        if !diagonal.clone().all(|b| b.is_finite() && b >= 0.0) {
            return Err(not_finite("a local compliance"));
        }
        let (datum, pressure) = match problem.control {
            Control::Load(load) if lowest == f64::INFINITY => return Err(ContactError::NowhereToTouch { load }),
            Control::Load(load) => (lowest, (load / cells.area() / cells.count() as f64).abs()),
            Control::Approach(approach) => (approach, 0.0),
        };
        let pressing = match (problem.frozen, problem.control) {
            (Some(_), Control::Load(_)) => highest - lowest,
            (Some(_), Control::Approach(approach)) => (highest - approach).abs().max((lowest - approach).abs()),
            (None, Control::Load(_)) => 0.0,
            (None, Control::Approach(approach)) => (approach - lowest).max(0.0),
        };
        let size = (pressure / stiffness).max(pressing);
        // Where the approach leaves everything open, the gaps themselves give the unit.
        let unit = power_of_two(if size > 0.0 || !largest.is_finite() { size } else { largest });
        let units = Units { gap: unit, pressure: unit * stiffness };
        let scale = if problem.scale.is_finite() && problem.scale > 0.0 { problem.scale / unit } else { 0.0 };
        let local = match problem.diagonal {
            crate::contact::Diagonal::Zero => Vec::new(),
            crate::contact::Diagonal::Uniform(b) if b == 0.0 => Vec::new(),
            crate::contact::Diagonal::Uniform(b) => vec![b * stiffness],
            crate::contact::Diagonal::PerPoint(b) => b.iter().map(|b| b * stiffness).collect(),
        };
        Ok(Scaled {
            units,
            datum,
            gap: problem.gap.iter().map(|gap| (gap - datum) / unit).collect(),
            local,
            sum: match problem.control {
                Control::Load(load) => Some(load / cells.area() / units.pressure),
                Control::Approach(_) => None,
            },
            bar: problem.tolerance * scale,
            scale,
        })
    }

    /// Local compliance of a cell.
    #[inline]
    pub fn local(&self, cell: usize) -> f64 {
        match self.local.len() {
            0 => 0.0,
            1 => self.local[0],
            _ => self.local[cell],
        }
    }
}
