//! Self-affine random roughness as a sum of waves with random phases.
//!
//! h(x, y) = sum over waves (kx, ky) of a(k) cos(2 pi (kx x / Lx + ky y / Ly) + phase), k = (kx^2 + (ky Lx / Ly)^2)^(1/2)
//! being the wave number in waves per size in x, one wave of each pair (kx, ky), (-kx, -ky). The power spectral density
//! is flat for 1 <= k <= roll-off, falls like k^-(2 + 2 H) up to the cut-off (k^-(1 + 2 H) for a profile, in 2-D) and is
//! zero beyond; so the amplitudes fall like k^-(1 + H) and k^-(1/2 + H). Source: B. N. J. Persson et al., J. Phys.:
//! Condens. Matter 17 (2005) R1, for the spectrum; amplitudes are those of the spectrum itself and only phases are
//! random, so that the root mean square slope, with <|grad h|^2> = sum a^2 |q|^2 / 2 and |q| = 2 pi k / Lx, is met to
//! rounding by every seed.
//!
//! The phase of a wave depends on the seed and on (kx, ky) alone: a finer grid or a higher cut-off keeps the waves that
//! there were.

use std::f64::consts::{PI, TAU};

use wearlaw_transforms::{Complex, FftDirection, Instructions, complex};

use super::super::Cells;
use super::SurfaceError;
use crate::splitmix::mixed;

/// What roughness there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// Hurst exponent H, above 0 and up to 1.
    pub hurst: f64,
    /// Root mean square of the slope, in 3-D of the gradient's length.
    pub rms_slope: f64,
    /// Wave number, in waves per size in x, up to which the spectrum is flat.
    pub roll_off: f64,
    /// Largest wave number, in waves per size in x.
    pub cut_off: f64,
    /// Seed of the phases.
    pub seed: u64,
}

/// Room for rounding where a wave number is compared with a bound: sizes come as cells times their length.
const ROUNDING: f64 = 1e-12;

/// A wave: its counts along x and y and its amplitude before scaling.
struct Wave {
    kx: u64,
    ky: i64,
    amplitude: f64,
}

impl Spectrum {
    /// Heights above the mean plane at the centres of the cells `[cells]`, x fastest; length.
    ///
    /// # Errors
    /// Numbers out of their bounds, a cut-off below 1, or one that the cells cannot show.
    pub fn heights(&self, cells: &Cells) -> Result<Vec<f64>, SurfaceError> {
        self.check(cells)?;
        let length = cells.counts[0] as f64 * cells.spacing[0];
        let waves = self.waves(cells);
        // In units of the largest amplitude, so that no sum leaves the range of doubles.
        let mut square = 0.0;
        for wave in &waves {
            square += (wave.amplitude * self.number(cells, wave.kx, wave.ky)).powi(2) / 2.0;
        }
        if square == 0.0 {
            return Err(SurfaceError::NoWave { cut_off: self.cut_off });
        }
        let scale = self.rms_slope * (length / TAU) / square.sqrt();
        Ok(self.sum(cells, &waves, scale))
    }

    fn check(&self, cells: &Cells) -> Result<(), SurfaceError> {
        let number = |key, found: f64, holds: bool, expected| {
            if holds { Ok(()) } else { Err(SurfaceError::Number { key, found, expected }) }
        };
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let Spectrum { hurst, rms_slope, roll_off, cut_off, .. } = *self;
        number("hurst", hurst, hurst > 0.0 && hurst <= 1.0, "above 0 and up to 1")?;
        number("rms_slope", rms_slope, positive(rms_slope), "a finite number above 0")?;
        number("roll_off", roll_off, positive(roll_off), "a finite number above 0")?;
        let ordered = cut_off >= roll_off && cut_off.is_finite();
        number("cut_off", cut_off, ordered, "a finite number not below `surface.roll_off`")?;
        for axis in 0..usize::from(cells.dimension - 1) {
            // Cells over which the longest size in x would count its waves.
            let count = cells.counts[axis];
            let most = count as f64 / 2.0 * if axis == 0 { 1.0 } else { aspect(cells) };
            if cut_off > most * (1.0 + ROUNDING) {
                let axis = ['x', 'y'][axis];
                return Err(SurfaceError::TooManyWaves { key: "cut_off", found: cut_off, axis, cells: count, most });
            }
        }
        Ok(())
    }

    /// The wave number of (kx, ky), in waves per size in x.
    fn number(&self, cells: &Cells, kx: u64, ky: i64) -> f64 {
        if ky == 0 { kx as f64 } else { (kx as f64).hypot(ky as f64 * aspect(cells)) }
    }

    /// The waves of the spectrum in an order that the grid does not change.
    fn waves(&self, cells: &Cells) -> Vec<Wave> {
        let most = self.cut_off * (1.0 + ROUNDING);
        let most_y = if cells.dimension == 2 { 0 } else { (most / aspect(cells)).floor() as i64 };
        let exponent = self.hurst + if cells.dimension == 2 { 0.5 } else { 1.0 };
        let mut waves = Vec::new();
        for kx in 0..=most.floor() as u64 {
            let first = if kx == 0 { 1 } else { -most_y };
            for ky in first..=most_y {
                let number = self.number(cells, kx, ky);
                if number <= most && number >= 1.0 - ROUNDING {
                    waves.push(Wave { kx, ky, amplitude: (number / self.roll_off).max(1.0).powf(-exponent) });
                }
            }
        }
        waves
    }

    /// The sum of the waves at the centres of the cells, by transforms along y and then along x.
    ///
    /// The transforms are the scalar ones, so that a surface does not depend on the processor's instruction set.
    fn sum(&self, cells: &Cells, waves: &[Wave], scale: f64) -> Vec<f64> {
        let [nx, ny] = cells.counts;
        let columns = waves.last().map_or(0, |wave| wave.kx as usize) + 1;
        let zero = Complex::new(0.0, 0.0);
        let mut spectrum = vec![zero; columns * ny];
        for wave in waves {
            let shift = PI * (wave.kx as f64 / nx as f64 + wave.ky as f64 / ny as f64);
            let phase = self.phase(wave.kx, wave.ky) + shift;
            let row = wave.ky.rem_euclid(ny as i64) as usize;
            spectrum[wave.kx as usize * ny + row] += Complex::from_polar(wave.amplitude * scale, phase);
        }
        let inverse = |length| complex(Instructions::Baseline, length, FftDirection::Inverse);
        if ny > 1 {
            inverse(ny).process(&mut spectrum);
        }
        let along_x = inverse(nx);
        let mut scratch = vec![zero; along_x.get_inplace_scratch_len()];
        let mut line = vec![zero; nx];
        let mut heights = Vec::with_capacity(nx * ny);
        for y in 0..ny {
            line.fill(zero);
            for kx in 0..columns {
                line[kx] = spectrum[kx * ny + y];
            }
            along_x.process_with_scratch(&mut line, &mut scratch);
            heights.extend(line.iter().map(|value| value.re));
        }
        heights
    }

    /// The phase of a wave, uniform in 0..2 pi.
    fn phase(&self, kx: u64, ky: i64) -> f64 {
        let bits = mixed(mixed(mixed(self.seed) ^ kx) ^ ky as u64);
        TAU * ((bits >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// Size in x over size in y.
fn aspect(cells: &Cells) -> f64 {
    (cells.counts[0] as f64 * cells.spacing[0]) / (cells.counts[1] as f64 * cells.spacing[1])
}
