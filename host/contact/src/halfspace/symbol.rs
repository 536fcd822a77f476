//! Real even kernels and their transforms, which are real and even too.

use wearlaw_transforms::{Complex, Instructions, Real};

/// A quarter of an even array with periods `periods`: `[x][y]`, x and y from 0 to half the period.
#[derive(Clone, Debug)]
pub struct Quarter {
    /// Cells in x and y after which it repeats.
    pub periods: [usize; 2],
    /// `[periods[0] / 2 + 1][periods[1] / 2 + 1]`, y fastest.
    pub values: Vec<f64>,
}

impl Quarter {
    /// From a function of the lags.
    pub fn from_lags(periods: [usize; 2], mut at: impl FnMut(usize, usize) -> f64) -> Quarter {
        let mut values = Vec::with_capacity((periods[0] / 2 + 1) * (periods[1] / 2 + 1));
        for x in 0..=periods[0] / 2 {
            values.extend((0..=periods[1] / 2).map(|y| at(x, y)));
        }
        Quarter { periods, values }
    }

    /// From a function of the lags that is the same with x and y exchanged; both periods are equal.
    pub fn from_equal_lags(period: usize, at: impl Fn(usize, usize) -> f64) -> Quarter {
        let count = period / 2 + 1;
        let mut values = vec![0.0; count * count];
        for x in 0..count {
            for y in 0..=x {
                let value = at(x, y);
                values[x * count + y] = value;
                values[y * count + x] = value;
            }
        }
        Quarter { periods: [period; 2], values }
    }

    /// The value at any lags.
    pub fn at(&self, x: usize, y: usize) -> f64 {
        let [nx, ny] = self.periods;
        let (x, y) = (x % nx, y % ny);
        self.values[x.min(nx - x) * (ny / 2 + 1) + y.min(ny - y)]
    }

    /// Its transform, the sum over a period of value times cos(2 pi k x / period).
    ///
    /// The inverse transform is the same over the number of cells.
    pub fn transformed(mut self, set: Instructions) -> Quarter {
        let [half_x, half_y] = self.periods.map(|period| period / 2 + 1);
        for (axis, (count, step, lines, apart)) in
            [(half_y, 1, half_x, half_y), (half_x, half_y, half_y, 1)].into_iter().enumerate()
        {
            let period = self.periods[1 - axis];
            let real = Real::new(set, period);
            let mut line = vec![0.0; period];
            let [mut out, mut scratch] = [real.bins(), real.scratch()].map(|count| vec![Complex::default(); count]);
            for first in (0..lines).map(|line| line * apart) {
                for k in 0..count {
                    let value = self.values[first + k * step];
                    line[k] = value;
                    line[(period - k) % period] = value;
                }
                real.forward(&line, &mut out, &mut scratch);
                for (k, value) in out.iter().take(count).enumerate() {
                    self.values[first + k * step] = value.re;
                }
            }
        }
        self
    }
}
