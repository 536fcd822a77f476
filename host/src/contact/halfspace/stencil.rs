//! A cheap near inverse of A + b: what a displacement of one cell does to the pressures around it.
//!
//! The inverse of the compliance falls off like 1/r^3 (1/r^2 in 2-D), so a few cells around hold nearly all of it. Cut
//! off there and confined to the cells in contact it is still positive definite: on the whole grid a uniform
//! displacement would need no pressure, so the entries off the diagonal are negative and those that are left out only
//! make the diagonal dominate.

use std::f64::consts::PI;

use super::contact_set::ContactSet;
use super::patch::Patch;

/// Cells on either side.
const REACH_3D: usize = 3;
const REACH_2D: usize = 16;
/// Size of the periodic grid that the entries are computed on.
const GRID_3D: usize = 32;
const GRID_2D: usize = 128;
/// Numbers that are added side by side.
const LANES: usize = 8;

/// A near inverse of A + b on a set, symmetric and positive definite.
pub struct Stencil {
    reach: [usize; 2],
    /// `[2 reach y + 1][2 reach x + 1]`, each row with zeros behind it up to whole lanes.
    entries: Vec<f64>,
    /// What a cell alone would give without local compliance, and the stiffness that the entries are for.
    own: f64,
    mean: f64,
    /// Values around the window, `reach` cells beyond it on every side; zero off the set.
    field: Vec<f64>,
    /// Cells in a row of `field`.
    pitch: usize,
    /// Places of the cells of the set in `field`.
    places: Vec<u32>,
    /// One for each cell of the set, or none.
    factors: Vec<f64>,
}

impl Stencil {
    /// For the local compliances of a set, about.
    pub fn new(patch: &Patch<'_>, set: &ContactSet) -> Stencil {
        let [nx, ny] = patch.counts;
        let (reach, size) = if patch.kernel.flat {
            ([REACH_2D.min(nx / 2), 0], [GRID_2D, 1])
        } else {
            ([REACH_3D.min(nx / 2), REACH_3D.min(ny / 2)], [GRID_3D; 2])
        };
        let mut entries = inverse(patch, size, reach, 0.0);
        let own = 1.0 / entries[entries.len() / 2];
        let stiffness = |cell: &u32| 1.0 / (own + patch.local(*cell as usize));
        let mean = set.cells.iter().map(stiffness).sum::<f64>() / set.len().max(1) as f64;
        let local = if patch.varies() { (1.0 / mean - own).max(0.0) } else { patch.local(0) };
        if local > 0.0 {
            entries = inverse(patch, size, reach, local);
        }
        let entries = spread(&entries, 2 * reach[0] + 1);
        let pitch = nx + 2 * reach[0];
        // The last rows are read a little beyond their end.
        let field = vec![0.0; pitch * (ny + 2 * reach[1]) + LANES];
        Stencil { reach, entries, own, mean, field, pitch, places: Vec::new(), factors: Vec::new() }
    }

    /// Confines it to a set.
    pub fn turn_to(&mut self, patch: &Patch<'_>, set: &ContactSet) {
        if patch.varies() {
            let stiffness = |cell: &u32| 1.0 / (self.own + patch.local(*cell as usize));
            self.factors = set.cells.iter().map(|cell| (stiffness(cell) / self.mean).sqrt()).collect();
        }
        self.places.iter().for_each(|place| self.field[*place as usize] = 0.0);
        let [nx, _] = patch.counts;
        let place = |cell: &u32| {
            let (x, y) = (*cell as usize % nx, *cell as usize / nx);
            ((y + self.reach[1]) * self.pitch + x + self.reach[0]) as u32
        };
        self.places = set.cells.iter().map(place).collect();
    }

    /// What a cell does to itself, about.
    pub fn own(&self) -> f64 {
        self.own
    }

    /// out = the near inverse of A + b, times values on the set.
    pub fn apply(&mut self, patch: &Patch<'_>, values: &[f64], out: &mut [f64]) {
        if self.factors.is_empty() {
            self.places.iter().zip(values).for_each(|(place, value)| self.field[*place as usize] = *value);
        } else {
            for ((place, value), factor) in self.places.iter().zip(values).zip(&self.factors) {
                self.field[*place as usize] = factor * value;
            }
        }
        self.wrap(patch);
        let [rx, ry] = self.reach;
        let (wide, high) = (in_lanes(2 * rx + 1), 2 * ry + 1);
        let before = ry * self.pitch + rx;
        let act = |at: usize, _: f64| {
            let first = self.places[at] as usize - before;
            // Side by side, so that additions do not wait for each other.
            let mut sums = [0.0; LANES];
            for row in 0..high {
                let values = &self.field[first + row * self.pitch..][..wide];
                let entries = &self.entries[row * wide..][..wide];
                for (values, entries) in values.chunks_exact(LANES).zip(entries.chunks_exact(LANES)) {
                    for lane in 0..LANES {
                        sums[lane] += values[lane] * entries[lane];
                    }
                }
            }
            sums.iter().sum::<f64>() * self.factors.get(at).copied().unwrap_or(1.0)
        };
        super::passes::change(patch.threads, out, act);
    }

    /// Repeats the field beyond the sides where the window is the whole of a periodic surface.
    fn wrap(&mut self, patch: &Patch<'_>) {
        let ([nx, ny], [rx, ry], pitch) = (patch.counts, self.reach, self.pitch);
        if patch.wraps[0] {
            for row in self.field.chunks_exact_mut(pitch).skip(ry).take(ny) {
                row.copy_within(nx..nx + rx, 0);
                row.copy_within(rx..2 * rx, nx + rx);
            }
        }
        if patch.wraps[1] {
            self.field.copy_within(ny * pitch..(ny + ry) * pitch, 0);
            self.field.copy_within(ry * pitch..2 * ry * pitch, (ny + ry) * pitch);
        }
    }
}

/// The entries: the inverse transform of 1 / (a + b m), a being the compliance of a mode and m what smoothing leaves of it.
fn inverse(patch: &Patch<'_>, size: [usize; 2], reach: [usize; 2], local: f64) -> Vec<f64> {
    let wave = |k: usize, axis: usize| 2.0 * PI * k as f64 / size[axis] as f64;
    let smooth = |k: usize, axis: usize| if patch.smoothed { (0.5 * wave(k, axis)).cos().powi(2) } else { 1.0 };
    // A uniform displacement needs no pressure, or far less than any other.
    let stiffness = |x: usize, y: usize| {
        let compliance = patch.kernel.mode([x, y], size);
        let all = compliance + local * smooth(x, 0) * smooth(y, 1);
        if compliance == 0.0 { 0.0 } else { 1.0 / all }
    };
    let cells = (size[0] * size[1]) as f64;
    let (wide, high) = (2 * reach[0] + 1, 2 * reach[1] + 1);
    let mut entries = vec![0.0; wide * high];
    // First over x for each wave in y, then over y.
    let mut along = vec![0.0; (reach[0] + 1) * size[1]];
    for y in 0..size[1] {
        for x in 0..=reach[0] {
            let terms = (0..size[0]).map(|k| stiffness(k, y) * (wave(k, 0) * x as f64).cos());
            along[x * size[1] + y] = terms.sum::<f64>() / cells;
        }
    }
    for y in 0..=reach[1] {
        for x in 0..=reach[0] {
            let value: f64 = (0..size[1]).map(|k| along[x * size[1] + k] * (wave(k, 1) * y as f64).cos()).sum();
            for (row, column) in [
                (reach[1] - y, reach[0] - x),
                (reach[1] - y, reach[0] + x),
                (reach[1] + y, reach[0] - x),
                (reach[1] + y, reach[0] + x),
            ] {
                entries[row * wide + column] = value;
            }
        }
    }
    if patch.smoothed {
        dominate(&mut entries);
    }
    entries
}

/// A number of entries in whole lanes.
fn in_lanes(count: usize) -> usize {
    count.div_ceil(LANES) * LANES
}

/// Entries with zeros behind each row.
fn spread(entries: &[f64], wide: usize) -> Vec<f64> {
    let mut spread = vec![0.0; entries.len() / wide * in_lanes(wide)];
    for (to, from) in spread.chunks_exact_mut(in_lanes(wide)).zip(entries.chunks_exact(wide)) {
        to[..wide].copy_from_slice(from);
    }
    spread
}

/// Raises the diagonal where it does not outweigh the rest, which smoothing can bring about.
fn dominate(entries: &mut [f64]) {
    let middle = entries.len() / 2;
    let all: f64 = entries.iter().map(|entry| entry.abs()).sum();
    entries[middle] = entries[middle].max(1.02 * (all - entries[middle].abs()));
}
