//! Convolution with an even kernel over a rectangle of cells, one pair of transforms each time.
//!
//! Rows are transformed first. Only rows with cells in them are: the rest of a padded grid is zero on the way in and
//! unused on the way out. The spectrum is kept in strips of a few columns `[strip][row][column]`, so that a strip fits
//! the cache while its columns are transformed, multiplied and transformed back in one pass.
//!
//! Cells on one side of a mirror are given with their images. Rows that are their own mirror image have real bins, two of
//! which go into one complex number; the columns of these are transformed together, and only half as many.

use std::sync::Arc;

use rayon::prelude::*;
use wearlaw_transforms::{Complex, Fft, FftDirection, Instructions, Real, complex};

use super::symbol::Quarter;

/// Columns in a strip: two lines of cache in each row.
const STRIP: usize = 8;
/// Rows that go into the strips and come out of them together.
const BLOCK: usize = 4;
/// Numbers between columns.
const APART: usize = 4;
/// Cells of padded rows from which threads pay for themselves.
const WORTH: usize = 1 << 15;
const ZERO: Complex<f64> = Complex { re: 0.0, im: 0.0 };

/// Memory that one thread works in.
#[derive(Clone, Debug, Default)]
struct Bench {
    row: Vec<f64>,
    bins: Vec<Complex<f64>>,
    columns: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

/// A convolution that is ready to be applied.
pub struct Convolution {
    /// Cells of the window.
    pub counts: [usize; 2],
    /// Cells of the grid that the transforms are made on.
    pub padded: [usize; 2],
    mirrored: [bool; 2],
    symbol: Quarter,
    threads: usize,
    /// `[strip][row][STRIP]`, the strips a little apart so that they do not fall on the same lines of cache.
    spectrum: Vec<Complex<f64>>,
    real: Real,
    forward_column: Arc<dyn Fft<f64>>,
    backward_column: Arc<dyn Fft<f64>>,
    benches: Vec<Bench>,
}

/// Where values come from and go to, row by row.
pub trait Rows: Sync {
    /// Where the values of row `row` begin in the output; of one past the last row: where they end.
    fn start(&self, row: usize) -> usize;
    /// Writes a row that holds zeros; false: it stays zero.
    fn read(&self, row: usize, values: &mut [f64]) -> bool;
    /// Takes what is wanted of a row.
    fn write(&self, row: usize, values: &[f64], out: &mut [f64]);
}

/// All cells, in the order of the grid.
pub struct Dense<'a> {
    /// Cells in a row.
    pub width: usize,
    /// Input `[rows * width]`.
    pub input: &'a [f64],
}

impl Rows for Dense<'_> {
    fn start(&self, row: usize) -> usize {
        row * self.width
    }

    fn read(&self, row: usize, values: &mut [f64]) -> bool {
        let input = &self.input[row * self.width..][..self.width];
        values[..self.width].copy_from_slice(input);
        input.iter().any(|value| *value != 0.0)
    }

    fn write(&self, _: usize, values: &[f64], out: &mut [f64]) {
        out.copy_from_slice(&values[..out.len()]);
    }
}

impl Convolution {
    /// Over `counts` cells with the transform of a kernel on a padded grid (or one of the same size: periodic); with the
    /// threads of rayon's current pool if `threads` is not 1. Along axes that are `mirrored` cell k has an image at -k.
    pub fn new(
        counts: [usize; 2],
        mirrored: [bool; 2],
        mut symbol: Quarter,
        set: Instructions,
        threads: usize,
    ) -> Convolution {
        let padded = symbol.periods;
        let normal = 1.0 / (padded[0] * padded[1]) as f64;
        symbol.values.iter_mut().for_each(|value| *value *= normal);
        let real = Real::new(set, padded[0]);
        let [forward_column, backward_column] =
            [FftDirection::Forward, FftDirection::Inverse].map(|direction| complex(set, padded[1], direction));
        let scratch = real.scratch().max(forward_column.get_inplace_scratch_len());
        let scratch = scratch.max(backward_column.get_inplace_scratch_len());
        let bench = Bench {
            row: vec![0.0; padded[0]],
            bins: vec![ZERO; BLOCK * in_strips(padded[0] / 2 + 1)],
            columns: vec![ZERO; STRIP * (padded[1] + APART)],
            scratch: vec![ZERO; scratch],
        };
        let mut convolution = Convolution {
            counts,
            padded,
            mirrored,
            symbol,
            threads,
            spectrum: Vec::new(),
            real,
            forward_column,
            backward_column,
            benches: vec![bench],
        };
        convolution.turn_to(counts);
        convolution
    }

    /// Turns to a window of other counts, under the same transforms.
    pub fn turn_to(&mut self, counts: [usize; 2]) {
        self.counts = counts;
        let strips = stored(self.padded[0] / 2 + 1, self.mirrored[0]).div_ceil(STRIP);
        self.spectrum.resize(strips * STRIP * (counts[1] + 1), ZERO);
        if self.threads > 1 && self.padded[0] * counts[1] >= WORTH {
            while self.benches.len() < 2 * self.threads {
                self.benches.push(self.benches[0].clone());
            }
        } else {
            self.benches.truncate(1);
        }
    }

    /// Whether it is one over this padded grid, mirrored along these axes.
    pub fn is_over(&self, padded: [usize; 2], mirrored: [bool; 2]) -> bool {
        (self.padded, self.mirrored) == (padded, mirrored)
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let complex = size_of::<Complex<f64>>();
        let benches: usize = self
            .benches
            .iter()
            .map(|b| 8 * b.row.len() + complex * (b.bins.len() + b.columns.len() + b.scratch.len()))
            .sum();
        8 * self.symbol.values.len() + complex * self.spectrum.len() + benches
    }

    /// Bytes of one over `counts` cells with transforms on a padded grid, before it is made; without what the plans of the
    /// transforms hold.
    pub fn bytes_for(counts: [usize; 2], padded: [usize; 2], threads: usize) -> usize {
        let [half_x, half_y] = padded.map(|count| count / 2 + 1);
        let wide = in_strips(half_x);
        let complex = size_of::<Complex<f64>>();
        let bench = 8 * padded[0] + complex * (BLOCK * wide + STRIP * (padded[1] + APART) + padded[0].max(padded[1]));
        let benches = if threads > 1 && padded[0] * counts[1] >= WORTH { 2 * threads } else { 1 };
        8 * half_x * half_y + complex * wide * (counts[1] + 1) + benches * bench
    }

    /// Convolves; `out` gets what `rows` wants of the result.
    pub fn apply(&mut self, rows: &impl Rows, out: &mut [f64]) {
        let [nx, ny] = self.counts;
        let bins = self.padded[0] / 2 + 1;
        let apart = STRIP * (ny + 1);
        let groups = self.benches.len().min(ny);
        let group = ny.div_ceil(groups);
        let real = &self.real;
        let wide = in_strips(bins);
        let mirrored = self.mirrored[0];
        each(&mut self.benches, split_rows(&mut self.spectrum, apart, ny, group), |bench, index, mut strips| {
            let (begin, end) = (index * group, ny.min((index + 1) * group));
            for block in (begin..end).step_by(BLOCK) {
                let block = block..end.min(block + BLOCK);
                for (row, spectrum) in block.clone().zip(bench.bins.chunks_exact_mut(wide)) {
                    bench.row.fill(0.0);
                    if rows.read(row, &mut bench.row[..nx]) {
                        if mirrored {
                            mirror(&mut bench.row, nx);
                        }
                        real.forward(&bench.row, &mut spectrum[..bins], &mut bench.scratch);
                        if mirrored {
                            pack(&mut spectrum[..bins]);
                        }
                    } else {
                        spectrum.fill(ZERO);
                    }
                }
                let place = STRIP * (block.start - begin);
                for (strip, data) in strips.iter_mut().enumerate() {
                    let to = &mut data[place..][..STRIP * block.len()];
                    for (to, from) in to.chunks_exact_mut(STRIP).zip(bench.bins.chunks_exact(wide)) {
                        to.copy_from_slice(&from[strip * STRIP..][..STRIP]);
                    }
                }
            }
        });
        let columns =
            Columns { forward: &*self.forward_column, backward: &*self.backward_column, mirrored: self.mirrored };
        let symbol = &self.symbol;
        if ny == 1 && self.padded[1] == 1 {
            for x in 0..stored(bins, mirrored) {
                let value = &mut self.spectrum[x / STRIP * apart + x % STRIP];
                if mirrored {
                    *value = scaled(*value, symbol.values[2 * x], symbol.values.get(2 * x + 1).copied().unwrap_or(0.0));
                } else {
                    *value *= symbol.values[x];
                }
            }
        } else {
            let strips = self.spectrum.chunks_exact_mut(apart);
            let work: Vec<_> = strips.enumerate().collect();
            let per = work.len().div_ceil(self.benches.len());
            let mut work = work.into_iter();
            let parts: Vec<Vec<_>> = (0..self.benches.len()).map(|_| work.by_ref().take(per).collect()).collect();
            each(&mut self.benches, parts, |bench, _, strips| {
                for (strip, data) in strips {
                    columns.convolve(symbol, strip * STRIP, &mut data[..STRIP * ny], bench);
                }
            });
        }
        let mut rest = out;
        let mut outs = Vec::with_capacity(groups);
        for index in 0..groups {
            let ends = [index * group, (index + 1) * group].map(|row| rows.start(row.min(ny)));
            let (own, others) = rest.split_at_mut(ends[1] - ends[0]);
            outs.push(own);
            rest = others;
        }
        let strips = split_rows(&mut self.spectrum, apart, ny, group);
        each(&mut self.benches, strips.into_iter().zip(outs).collect(), |bench, index, (strips, out)| {
            let (begin, end) = ((index * group).min(ny), ny.min((index + 1) * group));
            let first = rows.start(begin);
            for block in (begin..end).step_by(BLOCK) {
                let block = block..end.min(block + BLOCK);
                if rows.start(block.start) == rows.start(block.end) {
                    continue;
                }
                let place = STRIP * (block.start - begin);
                for (strip, data) in strips.iter().enumerate() {
                    let from = &data[place..][..STRIP * block.len()];
                    for (from, to) in from.chunks_exact(STRIP).zip(bench.bins.chunks_exact_mut(wide)) {
                        to[strip * STRIP..][..STRIP].copy_from_slice(from);
                    }
                }
                for (row, spectrum) in block.zip(bench.bins.chunks_exact_mut(wide)) {
                    let (from, to) = (rows.start(row) - first, rows.start(row + 1) - first);
                    if from == to {
                        continue;
                    }
                    if mirrored {
                        unpack(&mut spectrum[..bins]);
                    }
                    real.backward(&mut spectrum[..bins], &mut bench.row, &mut bench.scratch);
                    rows.write(row, &bench.row[..nx], &mut out[from..to]);
                }
            }
        });
    }
}

/// Complex numbers that hold the bins of a row: half as many where these are real.
fn stored(bins: usize, mirrored: bool) -> usize {
    if mirrored { bins.div_ceil(2) } else { bins }
}

/// Writes the images of the numbers 1 .. `count` of a period.
fn mirror<T: Copy>(values: &mut [T], count: usize) {
    let period = values.len();
    (1..count).for_each(|at| values[period - at] = values[at]);
}

/// Real bins, two in a number, the rest being zero.
fn pack(bins: &mut [Complex<f64>]) {
    let held = bins.len().div_ceil(2);
    for at in 0..held {
        bins[at] = Complex { re: bins[2 * at].re, im: bins.get(2 * at + 1).map_or(0.0, |bin| bin.re) };
    }
    bins[held..].fill(ZERO);
}

/// Back from [`pack`].
fn unpack(bins: &mut [Complex<f64>]) {
    for at in (0..bins.len().div_ceil(2)).rev() {
        let both = bins[at];
        if let Some(odd) = bins.get_mut(2 * at + 1) {
            *odd = Complex { re: both.im, im: 0.0 };
        }
        bins[2 * at] = Complex { re: both.re, im: 0.0 };
    }
}

/// Each part of a number times its own factor.
fn scaled(value: Complex<f64>, re: f64, im: f64) -> Complex<f64> {
    Complex { re: value.re * re, im: value.im * im }
}

/// Bins of a row, in whole strips.
fn in_strips(bins: usize) -> usize {
    bins.div_ceil(STRIP) * STRIP
}

/// The plans for columns.
struct Columns<'a> {
    forward: &'a dyn Fft<f64>,
    backward: &'a dyn Fft<f64>,
    mirrored: [bool; 2],
}

impl Columns<'_> {
    /// Transforms the columns from `first` on, multiplies and transforms back; `data` is `[row][STRIP]`.
    fn convolve(&self, symbol: &Quarter, first: usize, data: &mut [Complex<f64>], bench: &mut Bench) {
        let length = self.forward.len();
        let (half, bins) = (length / 2 + 1, symbol.values.len() / (length / 2 + 1));
        let packed = self.mirrored[0];
        let wide = STRIP.min(stored(bins, packed) - first);
        // A little apart, so that writing them side by side does not fall on the same lines of cache.
        let pitch = length + APART;
        let rows = data.len() / STRIP;
        for column in bench.columns.chunks_exact_mut(pitch).take(wide) {
            column[rows..length].fill(ZERO);
        }
        for (y, row) in data.chunks_exact(STRIP).enumerate() {
            for (x, value) in row.iter().take(wide).enumerate() {
                bench.columns[x * pitch + y] = *value;
            }
        }
        let bin = |bin: usize| &symbol.values[bin.min(bins - 1) * half..][..half];
        for (at, column) in (first..first + wide).zip(bench.columns.chunks_exact_mut(pitch)) {
            let column = &mut column[..length];
            if self.mirrored[1] {
                mirror(column, rows);
            }
            self.forward.process_with_scratch(column, &mut bench.scratch[..self.forward.get_inplace_scratch_len()]);
            match (packed, self.mirrored[1]) {
                (false, _) => multiply_each(column, bin(at), bin(at)),
                (true, true) => multiply_each(column, bin(2 * at), bin(2 * at + 1)),
                (true, false) => multiply_both(column, bin(2 * at), bin(2 * at + 1)),
            }
            self.backward.process_with_scratch(column, &mut bench.scratch[..self.backward.get_inplace_scratch_len()]);
        }
        for (y, row) in data.chunks_exact_mut(STRIP).enumerate() {
            for (x, value) in row.iter_mut().take(wide).enumerate() {
                *value = bench.columns[x * pitch + y];
            }
        }
    }
}

/// Times an even symbol for each part: the same, or those of two even real columns, whose transforms are real.
fn multiply_each(column: &mut [Complex<f64>], re: &[f64], im: &[f64]) {
    let (low, high) = column.split_at_mut(re.len());
    let each = |(value, (re, im)): (&mut Complex<f64>, (&f64, &f64))| *value = scaled(*value, *re, *im);
    low.iter_mut().zip(re.iter().zip(im)).for_each(each);
    high.iter_mut().rev().zip(re[1..].iter().zip(&im[1..])).for_each(each);
}

/// Times an even symbol for each of two real columns, whose transforms are mixed: z = a + ib with a(-k) = conj a(k).
fn multiply_both(column: &mut [Complex<f64>], one: &[f64], other: &[f64]) {
    let length = column.len();
    for (k, (one, other)) in one.iter().zip(other).enumerate() {
        let (sum, difference) = (0.5 * (one + other), 0.5 * (one - other));
        let back = (length - k) % length;
        let (a, b) = (column[k], column[back]);
        column[k] = a * sum + b.conj() * difference;
        if back != k {
            column[back] = b * sum + a.conj() * difference;
        }
    }
}

/// The rows of each group in all strips, one list of slices for each group of `group` rows.
fn split_rows(spectrum: &mut [Complex<f64>], apart: usize, rows: usize, group: usize) -> Vec<Vec<&mut [Complex<f64>]>> {
    let mut groups: Vec<Vec<_>> = (0..rows.div_ceil(group)).map(|_| Vec::new()).collect();
    for strip in spectrum.chunks_exact_mut(apart) {
        for (group, part) in groups.iter_mut().zip(strip[..STRIP * rows].chunks_mut(STRIP * group)) {
            group.push(part);
        }
    }
    groups
}

/// Does one piece of work on each bench, at the same time if there are several.
fn each<T: Send>(benches: &mut [Bench], work: Vec<T>, act: impl Fn(&mut Bench, usize, T) + Sync) {
    if benches.len() > 1 {
        let work = benches.par_iter_mut().zip(work).enumerate();
        work.for_each(|(index, (bench, piece))| act(bench, index, piece));
    } else if let Some(bench) = benches.first_mut() {
        work.into_iter().enumerate().for_each(|(index, piece)| act(bench, index, piece));
    }
}
