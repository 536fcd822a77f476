//! One solve: units, window, search, and a look at what is outside of the window.

use super::contact_set::ContactSet;
use super::convolve::Dense;
use super::levels;
use super::mirror;
use super::passes::sum;
use super::patch::Patch;
use super::scaled::Scaled;
use super::search::{Accuracy, Outcome, search};
use super::window::{Extent, Window};
use super::{Boundary, HalfSpace, frozen};
use crate::{ContactError, Control, Problem, Solution};

/// Windows that are tried before all cells are taken.
const MOST_WINDOWS: usize = 6;

/// Solves a problem; see [`crate::ContactModel::solve`].
pub fn solve(model: &mut HalfSpace, problem: &Problem<'_>, pressure: &mut [f64]) -> Result<Solution, ContactError> {
    let scaled = Scaled::new(problem, &model.cells, model.modulus_unit / model.length)?;
    if scaled.idle || (problem.frozen.is_none() && scaled.sum.is_some_and(|sum| sum <= 0.0)) {
        pressure.fill(0.0);
        return Ok(Solution { approach: scaled.datum, ..Solution::default() });
    }
    if let Control::Approach(approach) = problem.control {
        determined(model, &scaled, problem, approach)?;
    }
    model.kernel.mirrored = if model.mirrors { mirror::of(model, problem, pressure) } else { [false; 2] };
    let mut job = Job { model, problem, scaled: &scaled, iterations: 0, pairs: 0 };
    let (window, values, outcome) = match problem.frozen {
        Some(set) => job.frozen(set, pressure),
        None => job.search(pressure).unwrap_or_else(|NoImage| {
            job.model.kernel.mirrored = [false; 2];
            job.search(pressure).unwrap_or_else(|NoImage| unreachable!("without a mirror every cell is its own image"))
        }),
    };
    let (iterations, fft_pairs) = (job.iterations, job.pairs);
    let total = window.sum(model.threads, &values);
    let (mut factor, mut load) = (scaled.units.pressure, total * scaled.units.pressure * model.cells.area());
    if let (Control::Load(wanted), Some(sum), None) = (problem.control, scaled.sum, problem.frozen) {
        factor *= sum / total;
        load = wanted;
    }
    put(&window, &values, factor, pressure);
    let approach = match problem.control {
        Control::Load(_) => scaled.datum + outcome.approach * scaled.units.gap,
        Control::Approach(approach) => approach,
    };
    if !outcome.converged {
        return Err(ContactError::NotConverged { iterations, error: outcome.error, tolerance: problem.tolerance });
    }
    Ok(Solution { approach, load, iterations, fft_pairs, error: outcome.error })
}

/// Refuses an approach that a periodic surface has no answer to: the mean gap of a surface in full contact, or more.
fn determined(
    model: &HalfSpace,
    scaled: &Scaled<'_>,
    problem: &Problem<'_>,
    approach: f64,
) -> Result<(), ContactError> {
    let all = problem.frozen.is_none_or(|set| set.iter().all(|on| *on));
    let soft = (0..problem.gap.len()).any(|cell| problem.diagonal.at(cell) > 0.0);
    if model.kernel.boundary == Boundary::Free || !all || soft {
        return Ok(());
    }
    let count = problem.gap.len();
    let mean = sum(1, count, |cell| scaled.gap(cell)) / count as f64;
    if mean == f64::INFINITY {
        // Where nothing can touch, contact is never full.
        return Ok(());
    }
    let largest = (0..count).fold(0.0, |most: f64, cell| most.max(scaled.gap(cell).abs()));
    let rounding = 8.0 * f64::EPSILON * largest;
    let refused = if problem.frozen.is_some() { mean.abs() > rounding } else { mean <= rounding };
    if refused {
        return Err(ContactError::NoSolution { approach, most: approach + mean * scaled.units.gap });
    }
    Ok(())
}

/// The contact comes to cells of a mirrored surface that have no image.
struct NoImage;

/// A solve under way.
struct Job<'a> {
    model: &'a mut HalfSpace,
    problem: &'a Problem<'a>,
    scaled: &'a Scaled<'a>,
    iterations: u64,
    pairs: u64,
}

impl Job<'_> {
    /// Does something with the problem on a window.
    fn on<R>(&mut self, window: &Window, act: impl FnOnce(&mut Patch<'_>) -> R) -> R {
        let mut convolution = self.model.convolution(window.sizes);
        let mut gap = self.model.room.take(window.sizes.0[0] * window.sizes.0[1]);
        window.gather_into(|cell| self.scaled.gap(cell), &mut gap);
        let mut patch = Patch {
            kernel: &self.model.kernel,
            convolution: &mut convolution,
            counts: window.sizes.0,
            wraps: window.wraps(self.model.kernel.boundary),
            gap,
            weights: window.weights(&mut self.model.room),
            local: self.scaled.varying().map_or_else(|| self.scaled.uniform(), |local| window.gather(local)),
            smoothed: self.problem.smoothed,
            sum: self.scaled.sum,
            cut: window.cut(self.model.kernel.boundary),
            room: std::mem::take(&mut self.model.room),
            threads: self.model.threads,
            pairs: 0,
        };
        let result = act(&mut patch);
        self.pairs += patch.pairs;
        let Patch { gap, local, weights, mut room, .. } = patch;
        room.give(gap);
        room.give(weights);
        room.give(local);
        self.model.room = room;
        self.model.keep(convolution);
        result
    }

    /// Solves on a set that is given: the window around it, the pressures there in the unit of the problem, and how it
    /// went.
    fn frozen(&mut self, set: &[bool], pressure: &[f64]) -> (Window, Vec<f64>, Outcome) {
        let kernel = &self.model.kernel;
        let window = Window::around(kernel, [0, 0], &Extent::of(&kernel.half(), |cell| set[cell]));
        let window = window.unwrap_or_else(|| Window::over(kernel, [0, 0], [1, 1], [0, 0]));
        let unit = self.scaled.units.pressure;
        let mut values = window.gather(|cell| pressure[cell] / unit);
        let inside = window.gather(|cell| set[cell]);
        let cells = ContactSet::of(window.sizes.0, |place| inside[place]);
        let tolerance = self.problem.tolerance;
        let outcome = self.on(&window, |patch| frozen::close(patch, &cells, tolerance, &mut values));
        self.iterations += outcome.iterations;
        (window, values, outcome)
    }

    /// Finds the contact: a window with all of it, the pressures there in the unit of the problem, and how it went.
    fn search(&mut self, pressure: &[f64]) -> Result<(Window, Vec<f64>, Outcome), NoImage> {
        let (mut window, mut values) = self.begin(pressure);
        let accuracy = Accuracy { tolerance: self.problem.tolerance, scale: self.scaled.scale, rough: 0.0 };
        for tried in 0.. {
            let mut outcome = self.on(&window, |patch| search(patch, accuracy, &mut values));
            self.iterations += outcome.iterations;
            if window.is_whole() {
                return Ok((window, values, outcome));
            }
            let low = if outcome.outgrown { Vec::new() } else { self.overlapping(&window, &values, &mut outcome)? };
            if low.is_empty() && !outcome.outgrown {
                return Ok((window, values, outcome));
            }
            if window.covers_half() {
                return Err(NoImage);
            }
            let kernel = &self.model.kernel;
            let mut extent = Extent::empty(&window.half);
            extent.mark_loaded(&window, &values);
            low.into_iter().for_each(|at| extent.mark(at));
            // A contact that was not finished may grow far beyond.
            let part = if outcome.outgrown { 3 } else { 8 };
            let margin = [0, 1].map(|axis| {
                let beside = if kernel.mirrored[axis] { 2 } else { 1 };
                if kernel.counts[axis] > 1 { 2 + beside * window.sizes.0[axis] / part } else { 0 }
            });
            let larger = Window::around(kernel, margin, &extent).filter(|_| tried < MOST_WINDOWS);
            let larger = larger.unwrap_or_else(|| Window::whole(kernel));
            values = moved(&window, &values, &larger);
            window = larger;
        }
        unreachable!("the last window is everything")
    }

    /// The first window and the pressures to start from on it.
    fn begin(&mut self, pressure: &[f64]) -> (Window, Vec<f64>) {
        let unit = self.scaled.units.pressure;
        let kernel = &self.model.kernel;
        let loaded = Extent::of(&kernel.half(), |cell| pressure[cell] > 0.0);
        if let Some(around) = Window::around(kernel, [2, 2], &loaded) {
            let values = around.gather(|cell| pressure[cell] / unit);
            return (around, values);
        }
        let count = self.problem.gap.len();
        if !levels::worthwhile(kernel) {
            let window = Window::whole(kernel);
            let values = vec![0.0; window.sizes.0[0] * window.sizes.0[1]];
            return (window, values);
        }
        let varying = self.scaled.varying();
        let local = varying.map_or_else(|| self.scaled.uniform(), |local| (0..count).map(local).collect());
        let level = levels::coarser(kernel, self.scaled.sum, |cell| self.scaled.gap(cell), &local);
        let guess = levels::guess(level, self.model.threads);
        self.iterations += guess.iterations;
        self.pairs += guess.pairs;
        let kernel = &self.model.kernel;
        let window = guess.window(kernel).unwrap_or_else(|| Window::lowest(kernel, |cell| self.scaled.gap(cell)));
        let values = guess.on(&window);
        (window, values)
    }

    /// The displacement of all cells by the pressures of a mirrored window and their images.
    fn everywhere(&mut self, window: &Window, values: &[f64]) -> Vec<f64> {
        let mirrored = std::mem::take(&mut self.model.kernel.mirrored);
        let whole = Window::whole(&self.model.kernel);
        let (mut pressure, mut u) = (vec![0.0; self.problem.gap.len()], vec![0.0; self.problem.gap.len()]);
        put(window, values, 1.0, &mut pressure);
        let mut convolution = self.model.convolution(whole.sizes);
        convolution.apply(&Dense { width: whole.sizes.0[0], input: &pressure }, &mut u);
        self.model.keep(convolution);
        self.model.kernel.mirrored = mirrored;
        self.pairs += 1;
        u
    }

    /// Columns and rows of the cells outside of the window that overlap by more than is allowed. If none does, the
    /// outcome's error counts them in.
    ///
    /// # Errors
    /// One that overlaps has no image among the cells that are solved for.
    fn overlapping(
        &mut self,
        window: &Window,
        values: &[f64],
        outcome: &mut Outcome,
    ) -> Result<Vec<[usize; 2]>, NoImage> {
        let total = window.sum(self.model.threads, values);
        // A cell is pushed away at least that far.
        let bound = outcome.approach - self.model.kernel.least() * total;
        let [nx, ny] = self.model.cells.counts;
        let half = window.half;
        let mut extent = Extent::empty(&half);
        let (mut doubtful, mut without) = (Vec::new(), Vec::new());
        for y in 0..ny {
            for x in 0..nx {
                let gap = self.scaled.gap(y * nx + x);
                if gap < bound {
                    match half.fold([x, y]) {
                        Some(at) if window.place(at).is_none() && half.unfold(at) == [x, y] => {
                            extent.mark(at);
                            doubtful.push((at, gap));
                        }
                        Some(_) => {}
                        None => without.push((y * nx + x, gap)),
                    }
                }
            }
        }
        if !without.is_empty() {
            let u = self.everywhere(window, values);
            if without.into_iter().any(|(cell, gap)| outcome.approach - gap - u[cell] > outcome.bar) {
                return Err(NoImage);
            }
        }
        if doubtful.is_empty() {
            return Ok(Vec::new());
        }
        extent.mark_loaded(window, values);
        let Some(view) = Window::around(&self.model.kernel, [0, 0], &extent) else { return Ok(Vec::new()) };
        let field = moved(window, values, &view);
        let mut u = vec![0.0; field.len()];
        let mut convolution = self.model.convolution(view.sizes);
        convolution.apply(&Dense { width: view.sizes.0[0], input: &field }, &mut u);
        self.model.keep(convolution);
        self.pairs += 1;
        let overlap = |at: [usize; 2], gap: f64| view.place(at).map_or(0.0, |place| outcome.approach - gap - u[place]);
        let most = doubtful.iter().map(|(at, gap)| overlap(*at, *gap)).fold(0.0, f64::max);
        let low = doubtful.iter().filter(|(at, gap)| overlap(*at, *gap) > outcome.bar).map(|(at, _)| *at).collect();
        if self.scaled.scale > 0.0 {
            outcome.error = outcome.error.max(most / self.scaled.scale);
        }
        Ok(low)
    }
}

/// The pressures of a window on another one that holds all that are not zero.
fn moved(window: &Window, values: &[f64], to: &Window) -> Vec<f64> {
    let mut moved = vec![0.0; to.sizes.0[0] * to.sizes.0[1]];
    for (place, value) in values.iter().enumerate().filter(|(_, value)| **value != 0.0) {
        if let Some(place) = to.place(window.at(place)) {
            moved[place] = *value;
        }
    }
    moved
}

/// Writes the pressures of a window times a factor to the surface, their images as well, and zero elsewhere.
fn put(window: &Window, values: &[f64], factor: f64, pressure: &mut [f64]) {
    if !window.is_whole() {
        pressure.fill(0.0);
    }
    if window.half.is_part() {
        let (half, width) = (&window.half, window.sizes.0[0]);
        for (y, row) in values.chunks_exact(width).enumerate() {
            let [_, up] = half.unfold(window.at(y * width));
            for row_of in [up, half.image(1, up)] {
                let to = &mut pressure[row_of * half.full[0]..][..half.full[0]];
                for (x, value) in row.iter().enumerate() {
                    let [right, _] = half.unfold(window.at(x));
                    to[right] = value * factor;
                    to[half.image(0, right)] = value * factor;
                }
            }
        }
        return;
    }
    let mut values = values.iter();
    for range in window.ranges() {
        for (to, from) in pressure[range].iter_mut().zip(&mut values) {
            *to = from * factor;
        }
    }
}
