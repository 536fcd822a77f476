//! Weighted sums over the neighbours of cells, side by side for cells that are neighbours themselves.
#![allow(unsafe_code)] // reason: calls a function that is compiled for wider registers, where the processor has them.

/// Most cells of a row that are done at once.
pub const RUN: usize = 4;

/// Values on a grid and the weights of neighbours.
pub struct Neighbours<'a> {
    /// Values, rows of `pitch`.
    pub field: &'a [f64],
    /// Numbers in a row of `field`.
    pub pitch: usize,
    /// Weights at distances `[rows][REACH + 1]`, the same on all sides.
    pub quarter: &'a [f64],
}

impl<'a> Neighbours<'a> {
    /// The sums at runs of at most [`RUN`] neighbours: those from `runs[k]` up to `runs[k + 1]`, at these places in the
    /// field; `out` begins with the first of them. The bits do not depend on the processor.
    pub fn sums<const REACH: usize>(&self, places: &[u32], runs: &[u32], out: &mut [f64]) {
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has what the function is compiled for.
            unsafe { self.sums_wide::<REACH>(places, runs, out) };
            return;
        }
        self.sums_anywhere::<REACH>(places, runs, out);
    }

    /// The same with registers of four numbers. Multiplications and additions stay apart, so the bits are the same.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn sums_wide<const REACH: usize>(&self, places: &[u32], runs: &[u32], out: &mut [f64]) {
        self.sums_anywhere::<REACH>(places, runs, out);
    }

    #[inline(always)]
    fn sums_anywhere<const REACH: usize>(&self, places: &[u32], runs: &[u32], mut out: &mut [f64]) {
        for bounds in runs.windows(2) {
            let (from, to) = (bounds[0] as usize, bounds[1] as usize);
            let (own, rest) = out.split_at_mut(to - from);
            out = rest;
            let sums = self.run::<REACH>(places[from] as usize);
            own.copy_from_slice(&sums[..to - from]);
        }
    }

    /// The sums at a place and the next ones: equal weights share a multiplication.
    #[inline(always)]
    fn run<const REACH: usize>(&self, first: usize) -> [f64; RUN] {
        let mut sums = [0.0; RUN];
        for (y, weights) in self.quarter.chunks_exact(REACH + 1).enumerate() {
            let below = &self.field[first + y * self.pitch - REACH..][..2 * REACH + RUN];
            let part = match y {
                0 => across::<REACH>(weights, |x| four(below, x)),
                _ => {
                    let above = &self.field[first - y * self.pitch - REACH..][..2 * REACH + RUN];
                    across::<REACH>(weights, |x| plus(four(below, x), four(above, x)))
                }
            };
            sums = plus(sums, part);
        }
        sums
    }
}

/// What a row gives, `at` being its values from a place on.
#[inline(always)]
fn across<const REACH: usize>(weights: &[f64], at: impl Fn(usize) -> [f64; RUN]) -> [f64; RUN] {
    let mut sums = at(REACH).map(|value| weights[0] * value);
    #[allow(clippy::needless_range_loop)] // reason: a count that the compiler knows leaves no loop
    for x in 1..=REACH {
        let both = plus(at(REACH - x), at(REACH + x));
        sums = plus(sums, both.map(|value| weights[x] * value));
    }
    sums
}

#[inline(always)]
fn four(values: &[f64], first: usize) -> [f64; RUN] {
    std::array::from_fn(|lane| values[first + lane])
}

#[inline(always)]
fn plus(a: [f64; RUN], b: [f64; RUN]) -> [f64; RUN] {
    std::array::from_fn(|lane| a[lane] + b[lane])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every cell's sum over its neighbours, one after the other.
    fn one_by_one(near: &Neighbours<'_>, reach: usize, place: usize) -> f64 {
        let reach = reach as isize;
        let high = near.quarter.len() as isize / (reach + 1) - 1;
        let at = |x: isize, y: isize| near.field[(place as isize + y * near.pitch as isize + x) as usize];
        let weight = |x: isize, y: isize| near.quarter[(y.abs() * (reach + 1) + x.abs()) as usize];
        (-high..=high).flat_map(|y| (-reach..=reach).map(move |x| weight(x, y) * at(x, y))).sum()
    }

    #[test]
    fn sums_are_those_over_all_neighbours_with_the_same_bits_on_any_processor() {
        let (pitch, rows) = (40, 20);
        let field: Vec<f64> = (0..pitch * rows).map(|i| ((i * 7919) % 1013) as f64 - 500.0).collect();
        let quarter: Vec<f64> = (0..16).map(|i| 1.0 / (1.0 + i as f64)).collect();
        let near = Neighbours { field: &field, pitch, quarter: &quarter };
        // Runs of four, of one and of three, apart from each other.
        let (places, runs) = ([125, 126, 127, 128, 301, 333, 334, 335], [0, 4, 5, 8]);
        let mut out = [0.0; 8];
        near.sums::<3>(&places, &runs, &mut out);
        let mut plain = [0.0; 8];
        near.sums_anywhere::<3>(&places, &runs, &mut plain);
        assert_eq!(out.map(f64::to_bits), plain.map(f64::to_bits));
        for (sum, place) in out.iter().zip(places) {
            let wanted = one_by_one(&near, 3, place as usize);
            assert!((sum - wanted).abs() < 1e-9 * wanted.abs().max(1.0), "{place}: {sum} {wanted}");
        }
    }
}
