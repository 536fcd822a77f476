//! A first guess from coarser cells, each level started from the one with cells twice as large.

use super::Boundary;
use super::kernel::Kernel;
use super::patch::Patch;
use super::room::Room;
use super::search::{Accuracy, search};
use super::window::{Extent, Window};

/// Cells up to which a grid is not made coarser.
const ENOUGH_3D: usize = 40 * 40;
const ENOUGH_2D: usize = 100;
/// Fewest cells along an axis that is made coarser.
const FEWEST: usize = 16;
/// Error of a guess, over the largest displacement.
const ROUGH: f64 = 1e-3;

/// A problem on all cells of a level, in scaled units.
pub struct Level {
    /// Compliance.
    pub kernel: Kernel,
    /// Gap `[cells]`.
    pub gap: Vec<f64>,
    /// Local compliance `[cells]`, or one for all, or none.
    pub local: Vec<f64>,
    /// Sum of all pressures, or the approach is 0.
    pub sum: Option<f64>,
    /// Fine cells in one of these, in x and y.
    factor: [usize; 2],
}

/// Pressures on a window of a level.
pub struct Guess {
    window: Window,
    pressure: Vec<f64>,
    /// The first column and row of its contact, and the size of that.
    contact: Option<([usize; 2], [usize; 2])>,
    /// Cells of the finer level in one of these.
    factor: [usize; 2],
    /// Iterations and pairs of transforms that it cost.
    pub iterations: u64,
    /// Pairs of transforms that it cost.
    pub pairs: u64,
}

impl Guess {
    /// The window of the finer level around its contact; `None`: there is no contact.
    pub fn window(&self, finer: &Kernel) -> Option<Window> {
        let (first, counts) = self.contact?;
        let (axes, half) = ([0, 1], finer.half());
        let margin = axes.map(|axis| if finer.counts[axis] > 1 { 2 + counts[axis] / 16 } else { 0 });
        let first = axes.map(|axis| first[axis] * self.factor[axis]);
        let counts = axes.map(|axis| {
            let count = counts[axis] * self.factor[axis];
            if half.mirrored[axis] {
                let from = |at: usize| half.base(axis).abs_diff(at);
                from(first[axis]).max(from(first[axis] + count - 1)) + 1 + margin[axis]
            } else {
                count + 2 * margin[axis]
            }
        });
        Some(Window::over(finer, first, counts, margin))
    }

    /// The pressures on a window of the finer level: those of the cells that its cells are parts of.
    pub fn on(&self, window: &Window) -> Vec<f64> {
        let mut values = Vec::with_capacity(window.sizes.0[0] * window.sizes.0[1]);
        for place in 0..window.sizes.0[0] * window.sizes.0[1] {
            let [x, y] = window.half.unfold(window.at(place));
            let coarse = self.window.place([x / self.factor[0], y / self.factor[1]]);
            values.push(coarse.map_or(0.0, |place| self.pressure[place]));
        }
        values
    }
}

/// Whether a level is worth a guess.
pub fn worthwhile(kernel: &Kernel) -> bool {
    factors(kernel) != [1, 1]
}

/// Which axes can be halved.
fn factors(kernel: &Kernel) -> [usize; 2] {
    let [nx, ny] = kernel.counts;
    let enough = if kernel.flat { ENOUGH_2D } else { ENOUGH_3D };
    let halves = |count: usize| {
        let fits = kernel.boundary == Boundary::Free || count.is_multiple_of(2);
        if nx * ny > enough && count >= FEWEST && fits { 2 } else { 1 }
    };
    [halves(nx), halves(ny)]
}

/// The next coarser level of cells whose gap and local compliance are given; finite gaps are averaged.
pub fn coarser(kernel: &Kernel, sum: Option<f64>, gap: impl Fn(usize) -> f64, local: &[f64]) -> Level {
    let factor = factors(kernel);
    let [nx, ny] = kernel.counts;
    let counts = [nx.div_ceil(factor[0]), ny.div_ceil(factor[1])];
    let mut spacing = kernel.spacing;
    spacing.iter_mut().zip(factor).for_each(|(spacing, factor)| *spacing *= factor as f64);
    let local = if local.len() > 1 { averaged([nx, ny], factor, |cell| local[cell]) } else { local.to_vec() };
    let mut coarse = Kernel::new(kernel.flat, kernel.boundary, counts, spacing, kernel.soft, kernel.datum);
    coarse.instructions = kernel.instructions;
    Level {
        kernel: coarse,
        gap: averaged([nx, ny], factor, gap),
        local,
        sum: sum.map(|sum| sum / (factor[0] * factor[1]) as f64),
        factor,
    }
}

/// Means of the finite values over blocks of cells; infinity where there are none.
fn averaged(counts: [usize; 2], factor: [usize; 2], of: impl Fn(usize) -> f64) -> Vec<f64> {
    let [nx, ny] = counts;
    let mut means = Vec::with_capacity(nx.div_ceil(factor[0]) * ny.div_ceil(factor[1]));
    for y in (0..ny).step_by(factor[1]) {
        for x in (0..nx).step_by(factor[0]) {
            let (mut sum, mut count) = (0.0, 0.0);
            for row in y..ny.min(y + factor[1]) {
                for value in (x..nx.min(x + factor[0])).map(|x| of(row * nx + x)).filter(|value| value.is_finite()) {
                    sum += value;
                    count += 1.0;
                }
            }
            means.push(if count > 0.0 { sum / count } else { f64::INFINITY });
        }
    }
    means
}

/// Guesses the pressures of a level, from coarser ones.
pub fn guess(mut level: Level, threads: usize) -> Guess {
    let (window, mut pressure, mut iterations, mut pairs) = if worthwhile(&level.kernel) {
        let guess = guess(coarser(&level.kernel, level.sum, |cell| level.gap[cell], &level.local), threads);
        let window =
            guess.window(&level.kernel).unwrap_or_else(|| Window::lowest(&level.kernel, |cell| level.gap[cell]));
        (window, guess.on(&window), guess.iterations, guess.pairs)
    } else {
        let window = Window::whole(&level.kernel);
        (window, vec![0.0; level.gap.len()], 0, 0)
    };
    let mut convolution = level.kernel.convolution(window.sizes, threads);
    let mut patch = Patch {
        wraps: window.wraps(level.kernel.boundary),
        kernel: &level.kernel,
        convolution: &mut convolution,
        counts: window.sizes.0,
        gap: window.gather(|cell| level.gap[cell]),
        local: if level.local.len() > 1 { window.gather(|cell| level.local[cell]) } else { level.local.clone() },
        weights: Vec::new(),
        smoothed: false,
        sum: level.sum,
        cut: [[false; 2]; 2],
        room: Room::default(),
        threads,
        pairs: 0,
    };
    let outcome = search(&mut patch, Accuracy { tolerance: 0.0, scale: 0.0, rough: ROUGH }, &mut pressure);
    iterations += outcome.iterations;
    pairs += patch.pairs;
    let mut extent = Extent::empty(&level.kernel.half());
    extent.mark_loaded(&window, &pressure);
    let contact = extent.range(level.kernel.boundary);
    Guess { window, pressure, contact, factor: level.factor, iterations, pairs }
}
