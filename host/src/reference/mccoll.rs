//! Published depths of a fretted flat, to hold a whole model against.
//!
//! A steel cylinder of radius 6 mm frets on a flat under 18.5 N/mm. Source of the experiment and its constants: I. R.
//! McColl, J. Ding and S. B. Leen, Finite element simulation and experimental validation of fretting wear, Wear 256
//! (2004) 1114. Source of the computed depths: a two-dimensional finite element model of the same case by Llavori et al.,
//! published as LevelSetWear. A line model of two half-spaces in which the whole stroke slips everywhere comes out 9 to
//! 11 per cent deeper: it neither spreads the wear over the stroke nor knows stick.

/// The case, in newton, millimetre, megapascal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct McCollFretting {
    /// Radius of the cylinder; mm.
    pub radius: f64,
    /// Load per length; N/mm.
    pub load: f64,
    /// Young's modulus of both bodies; MPa.
    pub young: f64,
    /// Poisson's ratio of both bodies.
    pub poisson: f64,
    /// Amplitude of the slip: the flat travels four times as far in a cycle; mm.
    pub amplitude: f64,
    /// Wear per pressure and sliding distance of the flat; 1/MPa.
    pub flat_rate: f64,
    /// Wear per pressure and sliding distance of the cylinder; 1/MPa.
    pub cylinder_rate: f64,
}

/// The case.
pub const CASE: McCollFretting = McCollFretting {
    radius: 6.0,
    load: 18.5,
    young: 200e3,
    poisson: 0.3,
    amplitude: 25e-3,
    flat_rate: 2.9e-8,
    cylinder_rate: 1.9e-8,
};

/// Cycles, and largest wear depth of the flat after them by finite elements; micrometres.
pub const FLAT_DEPTHS: [(u64, f64); 4] = [(1000, 0.3784), (5000, 1.1311), (10_000, 1.8145), (18_000, 2.7130)];

/// Largest wear depth of the flat measured after 18 000 cycles; micrometres.
pub const MEASURED_DEPTH: f64 = 2.892;

impl McCollFretting {
    /// E* of the pair; MPa.
    #[must_use]
    pub fn modulus(&self) -> f64 {
        self.young / (2.0 * (1.0 - self.poisson * self.poisson))
    }

    /// Part of the total wear that is the flat's.
    #[must_use]
    pub fn flat_share(&self) -> f64 {
        self.flat_rate / (self.flat_rate + self.cylinder_rate)
    }

    /// Wear of both bodies per pressure after a number of cycles with full slip; mm/MPa.
    #[must_use]
    pub fn wear_per_pressure(&self, cycles: f64) -> f64 {
        (self.flat_rate + self.cylinder_rate) * 4.0 * self.amplitude * cycles
    }
}

/// Largest wear depth of the flat by finite elements after one of the published numbers of cycles; micrometres.
#[must_use]
pub fn flat_depth(cycles: u64) -> Option<f64> {
    FLAT_DEPTHS.iter().find(|(published, _)| *published == cycles).map(|(_, depth)| *depth)
}

#[cfg(test)]
mod tests {
    use super::super::answer::Indenter;
    use super::super::scar::Scar;
    use super::*;

    #[test]
    fn a_line_model_with_full_slip_is_nine_to_eleven_per_cent_deeper() {
        for (cycles, published) in FLAT_DEPTHS {
            let dose = CASE.wear_per_pressure(cycles as f64);
            let scar = Scar::new(Indenter::Line, CASE.radius, CASE.modulus(), CASE.load, dose).unwrap();
            let depth = scar.central_wear_depth * CASE.flat_share() * 1e3;
            let excess = depth / published - 1.0;
            assert!((0.08..0.12).contains(&excess), "{cycles}: {depth} um, {excess}");
        }
        assert!((CASE.modulus() / 109.89011e3 - 1.0).abs() < 1e-7);
        assert_eq!((flat_depth(10_000), flat_depth(10_001)), (Some(1.8145), None));
    }
}
