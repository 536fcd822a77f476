//! What is seen of a contact after some steps: roughness, sign, and how much of what there was to wear has been worn.
//!
//! Explicit steps beyond the limit do not end in infinities: pressures that cannot be negative and a load that is given
//! bound them, and what they leave is a chequerboard with a plausible volume. So a result is judged by its roughness and
//! by the pressure at the centre, never by finiteness alone.

use serde::Serialize;

use crate::contact::Cells;

/// Relative roughness from which a pressure is rough in any case; a chequerboard of amplitude a on the mean has 4 a in
/// 2-D and 8 a in 3-D.
pub const ROUGH: f64 = 0.5;
/// Amplitude of the ripple, over that at the start, from which it grows; the rest is what the filter leaves of the
/// smooth part.
pub const GROWS: f64 = 1.02;
/// Amplitude of the ripple in a pressure without it, over that at the start, up to which it says something.
const CLEAR: f64 = 0.1;
/// Part of the largest pressure below which a negative one is an error of the contact solve.
pub const NEGATIVE: f64 = 1e-4;
/// Wear over what can be reached, from which a point is over-worn: the rest is the tolerance of the contact solves.
pub const OVER_WORN: f64 = 1.0 + 1e-3;
/// Largest overlap, relative to the spread of the initial gap, that contact solves may leave.
pub const OVERLAP: f64 = 1e-4;

/// Cells of a set whose neighbours along every axis belong to it too.
#[must_use]
pub fn interior(cells: &Cells, set: &[bool]) -> Vec<u32> {
    let [nx, ny] = cells.counts;
    let inside = |cell: &usize| {
        let (i, j) = (cell % nx, cell / nx);
        let along_x = i > 0 && i + 1 < nx && set[cell - 1] && set[cell + 1];
        let along_y = cells.dimension == 2 || (j > 0 && j + 1 < ny && set[cell - nx] && set[cell + nx]);
        set[*cell] && along_x && along_y
    };
    (0..nx * ny).filter(inside).map(|cell| cell as u32).collect()
}

/// Sums over the axes of the second differences at these inner cells, zero elsewhere `[cells]`.
#[must_use]
pub fn bends(cells: &Cells, inner: &[u32], values: &[f64]) -> Vec<f64> {
    let nx = cells.counts[0];
    let mut bends = vec![0.0; values.len()];
    for cell in inner {
        let at = *cell as usize;
        bends[at] = values[at - 1] + values[at + 1] - 2.0 * values[at];
        if cells.dimension != 2 {
            bends[at] += values[at - nx] + values[at + nx] - 2.0 * values[at];
        }
    }
    bends
}

/// The amplitude of one mode in a pressure, smooth changes of the pressure filtered out: a mode that decays fast alternates
/// from cell to cell, and second differences of second differences leave next to nothing of what does not.
#[derive(Clone, Debug, Default)]
pub struct Ripple {
    inner: Vec<u32>,
    deep: Vec<u32>,
    weights: Vec<f64>,
}

impl Ripple {
    /// For the mode `pattern` `[cells]` on a contact set; its own amplitude is 1.
    #[must_use]
    pub fn new(cells: &Cells, set: &[bool], pattern: &[f64]) -> Ripple {
        let mask = |inner: &[u32]| {
            let mut mask = vec![false; set.len()];
            inner.iter().for_each(|cell| mask[*cell as usize] = true);
            mask
        };
        let inner = interior(cells, set);
        let deep = interior(cells, &mask(&interior(cells, &mask(&inner))));
        let mut ripple = Ripple { inner, deep, weights: Vec::new() };
        let weights = ripple.filtered(cells, pattern);
        let square: f64 = weights.iter().map(|weight| weight * weight).sum();
        if square > 0.0 {
            ripple.weights = weights.iter().map(|weight| weight / square).collect();
        }
        ripple
    }

    fn filtered(&self, cells: &Cells, values: &[f64]) -> Vec<f64> {
        bends(cells, &self.deep, &bends(cells, &self.inner, values))
    }

    /// Whether the amplitude says anything: a pressure without the mode has next to none of it.
    #[must_use]
    pub fn is_clear(&self, cells: &Cells, smooth: &[f64]) -> bool {
        !self.weights.is_empty() && self.amplitude(cells, smooth).abs() <= CLEAR
    }

    /// The amplitude in a pressure; 0 where the contact is too small to tell a mode from its edge.
    #[must_use]
    pub fn amplitude(&self, cells: &Cells, pressure: &[f64]) -> f64 {
        self.filtered(cells, pressure).iter().zip(&self.weights).map(|(bend, weight)| bend * weight).sum()
    }
}

/// Second differences of the pressure at these inner cells, over the pressure there, both as L2 norms; `floor` is a
/// pressure that stands in for the mean square where there is less, so that what is all but gone is not called rough.
#[must_use]
pub fn roughness(cells: &Cells, inner: &[u32], pressure: &[f64], floor: f64) -> f64 {
    let unit = inner.iter().fold(floor.abs(), |most: f64, cell| most.max(pressure[*cell as usize].abs()));
    if unit == 0.0 || inner.is_empty() {
        return 0.0;
    }
    let square = |values: &[f64]| inner.iter().map(|cell| (values[*cell as usize] / unit).powi(2)).sum::<f64>();
    let least = (floor / unit).powi(2) * inner.len() as f64;
    (square(&bends(cells, inner, pressure)) / square(pressure).max(least)).sqrt()
}

/// What was seen after the steps; pressures relative to the largest at their start.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Seen {
    /// Largest roughness of any step beyond that of the refined run and of the ripple that the steps began with.
    pub roughness: f64,
    /// Amplitude of the mode that decays fastest, over that at the start: above 1 it grows. The largest after any step;
    /// `None`: the contact is too small to tell it from the edge.
    pub ripple: Option<f64>,
    /// Pressure at the cell that carries most at the start, over that of the refined run.
    pub center_pressure: f64,
    /// Lowest pressure.
    pub lowest_pressure: f64,
    /// Deepest overlap over the spread of the initial gap.
    pub overlap: f64,
    /// Largest wear over what could be reached at any point.
    pub wear_over_reach: f64,
    /// Relative L2 distance of the new wear depths from those of the refined run.
    pub error: f64,
    /// Steps in which the second-order method was replaced by backward Euler.
    pub replaced: u64,
}

/// What is wrong with a result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// Not numbers, or pressures beyond all bounds.
    Diverged,
    /// A chequerboard, or unevenness that grows.
    Rough,
    /// Surfaces that pull at each other.
    Pulls,
    /// Wear beyond what could be reached.
    OverWorn,
    /// Surfaces that overlap.
    Overlaps,
}

impl Fault {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Fault::Diverged => "diverges",
            Fault::Rough => "rough",
            Fault::Pulls => "negative pressure",
            Fault::OverWorn => "over-worn",
            Fault::Overlaps => "overlaps",
        }
    }
}

impl Seen {
    /// Everything that is wrong; nothing: positive, smooth and bounded.
    #[must_use]
    pub fn faults(&self) -> Vec<Fault> {
        let ripple = self.ripple.unwrap_or(0.0);
        let numbers = [self.roughness, ripple, self.center_pressure, self.wear_over_reach, self.error];
        if numbers.iter().any(|number| !number.is_finite()) {
            return vec![Fault::Diverged];
        }
        let mut faults = Vec::new();
        if self.roughness > ROUGH || ripple > GROWS {
            faults.push(Fault::Rough);
        }
        if self.lowest_pressure < -NEGATIVE {
            faults.push(Fault::Pulls);
        }
        if self.wear_over_reach > OVER_WORN {
            faults.push(Fault::OverWorn);
        }
        if self.overlap > OVERLAP {
            faults.push(Fault::Overlaps);
        }
        faults
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chequerboard_is_rough_and_a_parabola_is_not() {
        for (dimension, counts, factor) in [(3, [8, 8], 8.0), (2, [64, 1], 4.0)] {
            let cells = Cells { dimension, counts, spacing: [1.0, 1.0] };
            let inner = interior(&cells, &[true; 64]);
            assert_eq!(inner.len(), if dimension == 3 { 36 } else { 62 });
            let sign = |k: usize| if (k % counts[0] + k / counts[0]).is_multiple_of(2) { 1.0 } else { -1.0 };
            let chequered: Vec<f64> = (0..64).map(|k| 1e9 * (1.0 + 0.01 * sign(k))).collect();
            let found = roughness(&cells, &inner, &chequered, 0.0);
            assert!((found - 0.01 * factor).abs() < 1e-3 * factor, "{found}");
            let sloping: Vec<f64> = (0..64).map(|k| 1e-9 * (10.0 + (k % counts[0]) as f64)).collect();
            assert!(roughness(&cells, &inner, &sloping, 0.0) < 1e-12);
            // What is all but gone is measured with what there was.
            assert!(roughness(&cells, &inner, &chequered, 1e13) < 1e-4);
        }
    }

    #[test]
    fn a_ripple_is_seen_on_a_pressure_that_changes() {
        let cells = Cells { dimension: 3, counts: [24, 24], spacing: [1.0, 1.0] };
        let square = |k: usize| ((k % 24) as f64 - 11.5).powi(2) + ((k / 24) as f64 - 11.5).powi(2);
        let set: Vec<bool> = (0..576).map(|k| square(k) < 100.0).collect();
        let sign = |k: usize| if (k % 24 + k / 24).is_multiple_of(2) { 1.0 } else { -1.0 };
        let mode: Vec<f64> =
            (0..576).map(|k| if set[k] { 0.01 * sign(k) * (1.0 - square(k) / 120.0) } else { 0.0 }).collect();
        let ripple = Ripple::new(&cells, &set, &mode);
        for (height, amplitude) in [(1.0, 1.0), (0.7, 0.3), (0.0, -2.0), (1.0, 0.0)] {
            let hertz = |k: usize| height * (1.0 - square(k) / 100.0).max(0.0).sqrt();
            let pressure: Vec<f64> = (0..576).map(|k| hertz(k) + amplitude * mode[k]).collect();
            let found = ripple.amplitude(&cells, &pressure);
            assert!((found - amplitude).abs() < 0.01, "{found} against {amplitude}");
            assert_eq!(ripple.is_clear(&cells, &pressure), amplitude == 0.0);
        }
        let cells = Cells { dimension: 2, counts: [4, 1], spacing: [1.0, 1.0] };
        let tiny = Ripple::new(&cells, &[true, true, true, false], &[1.0, -1.0, 1.0, 0.0]);
        assert!(!tiny.is_clear(&cells, &[0.0; 4]));
        assert_eq!(tiny.amplitude(&cells, &[1.0, -1.0, 1.0, 0.0]), 0.0);
    }

    #[test]
    fn inner_cells_have_all_their_neighbours() {
        let cells = Cells { dimension: 3, counts: [4, 3], spacing: [1.0, 1.0] };
        let mut set = [true; 12];
        assert_eq!(interior(&cells, &set), [5, 6]);
        set[9] = false;
        assert_eq!(interior(&cells, &set), [6]);
        assert_eq!(roughness(&cells, &[], &[0.0; 12], 1.0), 0.0);
    }

    #[test]
    fn each_fault_has_its_bar() {
        let fine = Seen { center_pressure: 1.0, wear_over_reach: 1.0, ..Seen::default() };
        assert_eq!(fine.faults(), []);
        let with = |seen: Seen| seen.faults();
        assert_eq!(with(Seen { ripple: Some(1.1), ..fine.clone() }), [Fault::Rough]);
        assert_eq!(with(Seen { roughness: 2.0, ..fine.clone() }), [Fault::Rough]);
        assert_eq!(with(Seen { lowest_pressure: -0.01, ..fine.clone() }), [Fault::Pulls]);
        assert_eq!(with(Seen { wear_over_reach: 2.4, ..fine.clone() }), [Fault::OverWorn]);
        assert_eq!(with(Seen { overlap: 0.1, ..fine.clone() }), [Fault::Overlaps]);
        assert_eq!(with(Seen { ripple: Some(f64::NAN), ..fine }), [Fault::Diverged]);
    }
}
