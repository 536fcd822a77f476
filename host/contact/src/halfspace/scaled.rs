//! A problem in units in which its numbers are near one.
//!
//! The units are powers of two, so the bits of the answer do not depend on the units of the scene as long as those
//! differ by powers of two, and nothing overflows that does not overflow in the answer.

use crate::{Cells, ContactError, Control, Diagonal, Problem};

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
#[derive(Clone, Copy, Debug)]
pub struct Scaled<'a> {
    problem: &'a Problem<'a>,
    /// Units.
    pub units: Units,
    /// What is subtracted from all gaps; in the unit of the caller.
    pub datum: f64,
    /// Sum of the pressures of all cells, if the load is given; otherwise the approach is 0.
    pub sum: Option<f64>,
    /// Whether nothing presses: no pressure is the answer.
    pub idle: bool,
    /// The length that errors are measured with; 0 if it is not known.
    pub scale: f64,
    /// Unit of local compliances.
    compliance: f64,
}

impl<'a> Scaled<'a> {
    /// From a problem; `stiffness` is a power of two near E* over the unit of lengths along the surface.
    ///
    /// # Errors
    /// Numbers that are not finite, and no cell that could touch.
    pub fn new(problem: &'a Problem<'a>, cells: &Cells, stiffness: f64) -> Result<Scaled<'a>, ContactError> {
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut finite = true;
        for (cell, gap) in problem.gap.iter().enumerate() {
            // A gap without end is no contact, unless it is said to be one.
            let touches = problem.frozen.map_or(*gap != f64::INFINITY, |set| set[cell]);
            if touches {
                finite &= gap.is_finite();
                lowest = lowest.min(*gap);
                highest = highest.max(*gap);
            }
        }
        let (Control::Load(given) | Control::Approach(given)) = problem.control;
        let not_finite = |what| ContactError::NotFinite { what, gap: highest.abs().max(lowest.abs()), given };
        if !finite {
            return Err(not_finite("a gap"));
        }
        if !given.is_finite() {
            return Err(not_finite("a load or approach"));
        }
        let right = |b: f64| b.is_finite() && b >= 0.0;
        let diagonal = match problem.diagonal {
            Diagonal::Zero => true,
            Diagonal::Uniform(b) => right(b),
            Diagonal::PerPoint(values) => values.iter().all(|b| right(*b)),
        };
        if !diagonal {
            return Err(not_finite("a local compliance"));
        }
        let (datum, pressure) = match problem.control {
            Control::Load(load) if lowest == f64::INFINITY && (problem.frozen.is_none() || load != 0.0) => {
                return Err(ContactError::NowhereToTouch { load });
            }
            Control::Load(load) => (lowest, (load / cells.area() / cells.count() as f64).abs()),
            Control::Approach(approach) => (approach, 0.0),
        };
        let pressing = match (problem.frozen, problem.control) {
            (Some(_), Control::Load(_)) => highest - lowest,
            (Some(_), Control::Approach(approach)) => (highest - approach).abs().max((lowest - approach).abs()),
            (None, Control::Load(_)) => 0.0,
            (None, Control::Approach(approach)) => (approach - lowest).max(0.0),
        };
        let unit = power_of_two((pressure / stiffness).max(pressing));
        let idle = pressure == 0.0 && pressing <= 0.0;
        let units = Units { gap: unit, pressure: unit * stiffness };
        Ok(Scaled {
            problem,
            units,
            datum: if datum.is_finite() { datum } else { 0.0 },
            sum: match problem.control {
                Control::Load(load) => Some(load / cells.area() / units.pressure),
                Control::Approach(_) => None,
            },
            idle,
            scale: if problem.scale.is_finite() && problem.scale > 0.0 { problem.scale / unit } else { 0.0 },
            compliance: stiffness,
        })
    }

    /// Gap of a cell.
    #[inline]
    pub fn gap(&self, cell: usize) -> f64 {
        (self.problem.gap[cell] - self.datum) / self.units.gap
    }

    /// Local compliance of a cell where they differ.
    pub fn varying(&self) -> Option<impl Fn(usize) -> f64 + '_> {
        let Diagonal::PerPoint(b) = self.problem.diagonal else { return None };
        Some(|cell: usize| b[cell] * self.compliance)
    }

    /// Local compliance where it is the same everywhere; one, or none at all.
    pub fn uniform(&self) -> Vec<f64> {
        match self.problem.diagonal {
            Diagonal::Uniform(b) if b > 0.0 => vec![b * self.compliance],
            _ => Vec::new(),
        }
    }
}
