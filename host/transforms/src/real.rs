//! Transforms of real lines, made of complex ones.
//!
//! A real line of even length is transformed as a complex one of half the length (Press et al., Numerical Recipes, 3rd ed.,
//! section 12.3), one of odd length as a complex one. Planners that look for the best instructions themselves, as those of
//! crates for real transforms do, cannot be told to take others.

use std::f64::consts::PI;
use std::sync::Arc;

use crate::{Complex, Fft, FftDirection, Instructions, complex};

const ZERO: Complex<f64> = Complex { re: 0.0, im: 0.0 };

/// Transforms of real lines of one length to their bins and back; not normalised.
pub struct Real {
    length: usize,
    forward: Arc<dyn Fft<f64>>,
    backward: Arc<dyn Fft<f64>>,
    /// exp(-2 pi i k / length) for k up to a quarter of the length; empty where it is odd.
    turns: Vec<Complex<f64>>,
}

impl Real {
    /// Of lines of this length, not 0.
    #[must_use]
    pub fn new(set: Instructions, length: usize) -> Real {
        let even = length.is_multiple_of(2);
        let inner = if even { length / 2 } else { length };
        let [forward, backward] =
            [FftDirection::Forward, FftDirection::Inverse].map(|direction| complex(set, inner, direction));
        let turn = |k: usize| Complex::from_polar(1.0, -2.0 * PI * k as f64 / length as f64);
        let turns = if even { (0..=inner / 2).map(turn).collect() } else { Vec::new() };
        Real { length, forward, backward, turns }
    }

    /// Bins of a line.
    #[must_use]
    pub fn bins(&self) -> usize {
        self.length / 2 + 1
    }

    /// Complex numbers that a transform works in.
    #[must_use]
    pub fn scratch(&self) -> usize {
        let inner = self.forward.get_inplace_scratch_len().max(self.backward.get_inplace_scratch_len());
        inner + if self.turns.is_empty() { self.length } else { 0 }
    }

    /// The bins of a line, `length / 2 + 1` of them.
    pub fn forward(&self, line: &[f64], bins: &mut [Complex<f64>], scratch: &mut [Complex<f64>]) {
        if self.turns.is_empty() {
            let (whole, scratch) = scratch.split_at_mut(self.length);
            whole.iter_mut().zip(line).for_each(|(to, from)| *to = Complex { re: *from, im: 0.0 });
            self.forward.process_with_scratch(whole, &mut scratch[..self.forward.get_inplace_scratch_len()]);
            bins.copy_from_slice(&whole[..bins.len()]);
            return;
        }
        let half = self.length / 2;
        let (packed, last) = bins.split_at_mut(half);
        for (to, pair) in packed.iter_mut().zip(line.chunks_exact(2)) {
            *to = Complex { re: pair[0], im: pair[1] };
        }
        self.forward.process_with_scratch(packed, &mut scratch[..self.forward.get_inplace_scratch_len()]);
        let first = packed[0];
        packed[0] = Complex { re: first.re + first.im, im: 0.0 };
        last[0] = Complex { re: first.re - first.im, im: 0.0 };
        let (low, high) = packed[1..].split_at_mut((half - 1) / 2);
        let middle = (half - 1) % 2;
        if middle == 1 {
            // Of its own mirror image the turn is -i.
            high[0] = high[0].conj();
        }
        for ((a, b), turn) in low.iter_mut().zip(high[middle..].iter_mut().rev()).zip(&self.turns[1..]) {
            // Of the even numbers, and of the odd ones turned.
            let (sum, difference) = (*a + b.conj(), *a - b.conj());
            let odd = Complex { re: difference.im, im: -difference.re } * turn;
            *a = (sum + odd) * 0.5;
            *b = (sum - odd).conj() * 0.5;
        }
    }

    /// The line of some bins, times `length`; the bins are lost.
    pub fn backward(&self, bins: &mut [Complex<f64>], line: &mut [f64], scratch: &mut [Complex<f64>]) {
        if self.turns.is_empty() {
            let (whole, scratch) = scratch.split_at_mut(self.length);
            whole.fill(ZERO);
            whole[..bins.len()].copy_from_slice(bins);
            for (k, bin) in bins.iter().enumerate().skip(1) {
                whole[self.length - k] = bin.conj();
            }
            self.backward.process_with_scratch(whole, &mut scratch[..self.backward.get_inplace_scratch_len()]);
            line.iter_mut().zip(whole.iter()).for_each(|(to, from)| *to = from.re);
            return;
        }
        let half = self.length / 2;
        let (packed, last) = bins.split_at_mut(half);
        let (first, last) = (packed[0].re, last[0].re);
        packed[0] = Complex { re: first + last, im: first - last };
        let (low, high) = packed[1..].split_at_mut((half - 1) / 2);
        let middle = (half - 1) % 2;
        if middle == 1 {
            high[0] = high[0].conj() * 2.0;
        }
        for ((a, b), turn) in low.iter_mut().zip(high[middle..].iter_mut().rev()).zip(&self.turns[1..]) {
            let (sum, difference) = (*a + b.conj(), *a - b.conj());
            let odd = difference * turn.conj();
            let odd = Complex { re: -odd.im, im: odd.re };
            *a = sum + odd;
            *b = (sum - odd).conj();
        }
        self.backward.process_with_scratch(packed, &mut scratch[..self.backward.get_inplace_scratch_len()]);
        for (pair, from) in line.chunks_exact_mut(2).zip(packed.iter()) {
            (pair[0], pair[1]) = (from.re, from.im);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_are_the_sums_and_lines_come_back_under_every_set() {
        for set in Instructions::here() {
            for length in [1, 2, 3, 4, 5, 6, 8, 9, 10, 16, 30, 45, 64, 90, 128] {
                let line: Vec<f64> = (0..length).map(|i| ((i * 37 + 11) % 23) as f64 - 9.0).collect();
                let real = Real::new(set, length);
                let (mut bins, mut scratch) = (vec![ZERO; real.bins()], vec![ZERO; real.scratch()]);
                real.forward(&line, &mut bins, &mut scratch);
                for (k, bin) in bins.iter().enumerate() {
                    let term = |(j, x): (usize, &f64)| {
                        Complex::from_polar(*x, -2.0 * PI * (j * k % length) as f64 / length as f64)
                    };
                    let sum: Complex<f64> = line.iter().enumerate().map(term).sum();
                    assert!((bin - sum).norm() < 1e-11, "{set:?} {length}, bin {k}: {bin} {sum}");
                }
                let mut back = vec![0.0; length];
                real.backward(&mut bins, &mut back, &mut scratch);
                for (found, wanted) in back.iter().zip(&line) {
                    assert!((found / length as f64 - wanted).abs() < 1e-12, "{set:?} {length}: {found}");
                }
            }
        }
    }
}
