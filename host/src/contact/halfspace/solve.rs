//! One solve: units, window, search, and a look at what is outside of the window.

use super::contact_set::ContactSet;
use super::convolve::Dense;
use super::levels;
use super::patch::Patch;
use super::scaled::Scaled;
use super::search::{Accuracy, Outcome, search};
use super::window::Window;
use super::{Boundary, HalfSpace, frozen};
use crate::contact::{ContactError, Control, Problem, Solution};

/// Windows that are tried before all cells are taken.
const MOST_WINDOWS: usize = 6;

/// Solves a problem; see [`crate::contact::ContactModel::solve`].
pub fn solve(model: &mut HalfSpace, problem: &Problem<'_>, pressure: &mut [f64]) -> Result<Solution, ContactError> {
    let scaled = Scaled::new(problem, &model.cells, model.modulus_unit / model.length)?;
    if problem.frozen.is_none() && scaled.sum.is_some_and(|sum| sum <= 0.0) {
        pressure.fill(0.0);
        return Ok(Solution { approach: scaled.datum, ..Solution::default() });
    }
    if let Control::Approach(approach) = problem.control {
        determined(model, &scaled, problem, approach)?;
    }
    let mut job = Job { model, problem, scaled: &scaled, iterations: 0, pairs: 0 };
    let outcome = match problem.frozen {
        Some(set) => job.frozen(set, pressure),
        None => job.search(pressure),
    };
    let (iterations, fft_pairs) = (job.iterations, job.pairs);
    let total = super::passes::sum(model.threads, pressure.len(), |cell| pressure[cell]);
    let (mut factor, mut load) = (scaled.units.pressure, total * scaled.units.pressure * model.cells.area());
    if let (Control::Load(wanted), Some(sum), None) = (problem.control, scaled.sum, problem.frozen) {
        factor *= sum / total;
        load = wanted;
    }
    super::passes::change(model.threads, pressure, |_, p| p * factor);
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
    let soft = scaled.local(0..problem.gap.len()).iter().any(|b| *b > 0.0);
    if model.kernel.boundary == Boundary::Free || !all || soft {
        return Ok(());
    }
    let count = problem.gap.len();
    let mean = super::passes::sum(1, count, |cell| scaled.gap(cell)) / count as f64;
    let largest = (0..count).fold(0.0, |most: f64, cell| most.max(scaled.gap(cell).abs()));
    let rounding = 8.0 * f64::EPSILON * largest;
    let refused = if problem.frozen.is_some() { mean.abs() > rounding } else { mean <= rounding };
    if refused {
        return Err(ContactError::NoSolution { approach, most: approach + mean * scaled.units.gap });
    }
    Ok(())
}

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
        let mut patch = Patch {
            kernel: &self.model.kernel,
            convolution: &mut convolution,
            counts: window.sizes.0,
            wraps: window.wraps(self.model.kernel.boundary),
            gap: window.cells().map(|cell| self.scaled.gap(cell)).collect(),
            local: self.scaled.local(window.cells()),
            smoothed: self.problem.smoothed,
            sum: self.scaled.sum,
            threads: self.model.threads,
            pairs: 0,
        };
        let result = act(&mut patch);
        self.pairs += patch.pairs;
        self.model.keep(window.sizes, convolution);
        result
    }

    /// Solves on a set that is given.
    fn frozen(&mut self, set: &[bool], pressure: &mut [f64]) -> Outcome {
        let Some(window) = Window::around(&self.model.kernel, [0, 0], |cell| set[cell]) else {
            pressure.fill(0.0);
            return Outcome { approach: 0.0, iterations: 0, error: 0.0, bar: 0.0, converged: true };
        };
        let unit = self.scaled.units.pressure;
        let mut values: Vec<f64> = window.cells().map(|cell| pressure[cell] / unit).collect();
        let inside: Vec<usize> = window.cells().collect();
        let cells = ContactSet::of(window.sizes.0, |place| set[inside[place]]);
        let tolerance = self.problem.tolerance;
        let outcome = self.on(&window, |patch| frozen::close(patch, &cells, tolerance, &mut values));
        self.iterations += outcome.iterations;
        put(&window, &values, pressure);
        outcome
    }

    /// Finds the contact. `pressure` is in the unit of the problem on entry, in its own unit on return.
    fn search(&mut self, pressure: &mut [f64]) -> Outcome {
        let (mut window, mut values) = self.begin(pressure);
        let accuracy = Accuracy { tolerance: self.problem.tolerance, scale: self.scaled.scale, rough: 0.0 };
        for tried in 0.. {
            let mut outcome = self.on(&window, |patch| search(patch, accuracy, &mut values));
            self.iterations += outcome.iterations;
            put(&window, &values, pressure);
            if window.is_whole() {
                return outcome;
            }
            let Some(overlapping) = self.overlapping(&window, &values, &mut outcome) else { return outcome };
            let is_low = |cell: usize| overlapping.binary_search(&cell).is_ok();
            let margin = margin(&self.model.kernel.counts, &window);
            let larger = Window::around(&self.model.kernel, margin, |cell| pressure[cell] > 0.0 || is_low(cell));
            window = match larger {
                Some(larger) if tried < MOST_WINDOWS => larger,
                _ => Window::whole(&self.model.kernel),
            };
            values = window.cells().map(|cell| pressure[cell]).collect();
        }
        unreachable!("the last window is everything")
    }

    /// The first window and the pressures to start from on it.
    fn begin(&mut self, pressure: &[f64]) -> (Window, Vec<f64>) {
        let unit = self.scaled.units.pressure;
        let kernel = &self.model.kernel;
        if let Some(around) = Window::around(kernel, [2, 2], |cell| pressure[cell] > 0.0) {
            let values = around.cells().map(|cell| pressure[cell] / unit).collect();
            return (around, values);
        }
        let count = self.problem.gap.len();
        if !levels::worthwhile(kernel) {
            return (Window::whole(kernel), vec![0.0; count]);
        }
        let local = self.scaled.local(0..count);
        let level = levels::coarser(kernel, self.scaled.sum, |cell| self.scaled.gap(cell), &local);
        let guess = levels::guess(level, self.model.threads);
        (self.iterations, self.pairs) = (guess.iterations, guess.pairs);
        let kernel = &self.model.kernel;
        let window = guess.window(kernel).unwrap_or_else(|| Window::lowest(kernel, |cell| self.scaled.gap(cell)));
        let values = guess.on(&window);
        (window, values)
    }

    /// Cells outside of the window that overlap by more than is allowed, in order; `None`: none does, and the outcome's
    /// error counts them in.
    fn overlapping(&mut self, window: &Window, values: &[f64], outcome: &mut Outcome) -> Option<Vec<usize>> {
        let least = self.model.kernel.least() * values.iter().sum::<f64>();
        // A cell is pushed away at least that far.
        let bound = outcome.approach - least;
        let [nx, _] = self.model.cells.counts;
        let outside = |cell: usize| window.place([cell % nx, cell / nx]).is_none();
        let doubtful = |cell: usize| self.scaled.gap(cell) < bound && outside(cell);
        let all = self.model.cells.count();
        let inside: Vec<usize> = window.cells().collect();
        if !(0..all).any(doubtful) {
            return None;
        }
        let mut looked_at = ContactSet::of([all, 1], doubtful).cells;
        looked_at.sort_unstable();
        let is_loaded = ContactSet::of([values.len(), 1], |place| values[place] > 0.0);
        let mut pressing: Vec<(usize, f64)> =
            is_loaded.cells.iter().map(|place| (inside[*place as usize], values[*place as usize])).collect();
        pressing.sort_unstable_by_key(|(cell, _)| *cell);
        let is_in = |cell: usize| {
            looked_at.binary_search(&(cell as u32)).is_ok()
                || pressing.binary_search_by_key(&cell, |(cell, _)| *cell).is_ok()
        };
        let view = Window::around(&self.model.kernel, [0, 0], is_in)?;
        let mut field = vec![0.0; view.sizes.0[0] * view.sizes.0[1]];
        for (cell, p) in &pressing {
            if let Some(place) = view.place([cell % nx, cell / nx]) {
                field[place] = *p;
            }
        }
        let mut u = vec![0.0; field.len()];
        let mut convolution = self.model.convolution(view.sizes);
        convolution.apply(&Dense { width: view.sizes.0[0], input: &field }, &mut u);
        self.model.keep(view.sizes, convolution);
        self.pairs += 1;
        let mut low = Vec::new();
        let (mut error, scale) = (0.0_f64, if outcome.error > 0.0 { 1.0 } else { 0.0 });
        let _ = scale;
        for cell in looked_at.iter().map(|cell| *cell as usize) {
            let Some(place) = view.place([cell % nx, cell / nx]) else { continue };
            let overlap = outcome.approach - self.scaled.gap(cell) - u[place];
            error = error.max(overlap);
            if overlap > outcome.bar {
                low.push(cell);
            }
        }
        if self.scaled.scale > 0.0 {
            outcome.error = outcome.error.max(error / self.scaled.scale);
        }
        (!low.is_empty()).then_some(low)
    }
}

/// Margin around the contact when a window turned out too small.
fn margin(counts: &[usize; 2], window: &Window) -> [usize; 2] {
    [0, 1].map(|axis| if counts[axis] > 1 { 2 + window.sizes.0[axis] / 8 } else { 0 })
}

/// Writes the pressures of a window to the surface, and zero elsewhere.
fn put(window: &Window, values: &[f64], pressure: &mut [f64]) {
    pressure.fill(0.0);
    for (cell, value) in window.cells().zip(values) {
        pressure[cell] = *value;
    }
}
