//! A cheap near inverse of A + b: what a displacement of one cell does to the pressures around it.
//!
//! The inverse of the compliance falls off like 1/r^3 (1/r^2 in 2-D), so a few cells around hold nearly all of it. Cut
//! off there and confined to the cells in contact it is still positive definite: on the whole grid a uniform
//! displacement would need no pressure, so the entries off the diagonal are negative and those that are left out only
//! make the diagonal dominate.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::contact_set::{ContactSet, GROUP};
use super::neighbours::{Neighbours, RUN};
use super::passes::WORTH;
use super::patch::Patch;

/// Cells on either side.
const REACH_3D: usize = 3;
const REACH_2D: usize = 16;
/// Size of the periodic grid that the entries are computed on.
const GRID_3D: usize = 32;
const GRID_2D: usize = 128;
/// Numbers that are added side by side.
const LANES: usize = 8;
/// Runs that one thread does at a time.
const SHARE: usize = 2048;

/// A near inverse of A + b on a set, symmetric and positive definite.
pub struct Stencil {
    reach: [usize; 2],
    /// `[2 reach y + 1][2 reach x + 1]`, each row with zeros behind it up to whole lanes.
    entries: Vec<f64>,
    /// The quarter of them that tells all: `[reach y + 1][reach x + 1]`.
    quarter: Vec<f64>,
    /// What a cell alone would give without local compliance, and the stiffness that the entries are for.
    own: f64,
    mean: f64,
    /// Values around the window, `reach` cells beyond it on every side; zero off the set.
    field: Vec<f64>,
    /// Cells in a row of `field`.
    pitch: usize,
    /// Places of the cells of the set in `field`.
    places: Vec<u32>,
    /// Where runs of at most [`RUN`] neighbours begin in the set, and its end.
    runs: Vec<u32>,
    /// One for each cell of the set, or none.
    factors: Vec<f64>,
}

impl Stencil {
    /// For the local compliances of a set, about.
    pub fn new(patch: &mut Patch<'_>, set: &ContactSet) -> Stencil {
        let [nx, ny] = patch.counts;
        let (reach, size) = if patch.kernel.flat {
            ([REACH_2D.min(nx / 2), 0], [GRID_2D, 1])
        } else {
            ([REACH_3D.min(nx / 2), REACH_3D.min(ny / 2)], [GRID_3D; 2])
        };
        let mut entries = inverse(patch, size, reach, 0.0);
        let own = 1.0 / entries[entries.len() / 2];
        let stiffness = |cell: &u32| 1.0 / (own + patch.local(*cell as usize));
        let mean = match patch.varies() {
            true => set.cells.iter().map(stiffness).sum::<f64>() / set.len().max(1) as f64,
            false => 1.0 / (own + patch.local(0)),
        };
        let local = if patch.varies() { (1.0 / mean - own).max(0.0) } else { patch.local(0) };
        if local > 0.0 {
            entries = inverse(patch, size, reach, local);
        }
        let wide = 2 * reach[0] + 1;
        let quarter = (0..=reach[1]).flat_map(|y| (0..=reach[0]).map(move |x| [x, y]));
        let quarter = quarter.map(|[x, y]| entries[(reach[1] + y) * wide + reach[0] + x]).collect();
        let entries = spread(&entries, wide);
        let pitch = nx + 2 * reach[0];
        // The last rows are read a little beyond their end.
        let mut field = patch.room.take(pitch * (ny + 2 * reach[1]) + LANES);
        field.fill(0.0);
        let (places, runs, factors) = (Vec::new(), Vec::new(), Vec::new());
        Stencil { reach, entries, quarter, own, mean, field, pitch, places, runs, factors }
    }

    /// Confines it to a set.
    pub fn turn_to(&mut self, patch: &Patch<'_>, set: &ContactSet) {
        if patch.varies() {
            let stiffness = |cell: &u32| 1.0 / (self.own + patch.local(*cell as usize));
            self.factors.clear();
            self.factors.extend(set.cells.iter().map(|cell| (stiffness(cell) / self.mean).sqrt()));
        }
        if patch.threads > 1 && self.places.len() >= WORTH {
            self.field.par_chunks_mut(GROUP * self.pitch).for_each(|field| field.fill(0.0));
        } else {
            self.places.iter().for_each(|place| self.field[*place as usize] = 0.0);
        }
        let nx = patch.counts[0];
        let ([rx, ry], pitch) = (self.reach, self.pitch);
        self.places.resize(set.len(), 0);
        let runs = set.in_groups(patch.threads, &mut self.places, |group, places| {
            let (mut runs, mut rest) = (Vec::new(), places);
            for row in group.rows {
                let (begin, cells) = set.row(row);
                let (places, others) = rest.split_at_mut(cells.len());
                rest = others;
                // From places in the window to places in the field.
                let shift = ((row + ry) * pitch + rx - row * nx) as u32;
                places.iter_mut().zip(cells).for_each(|(place, cell)| *place = cell + shift);
                let (mut next, mut length) = (u32::MAX, 0);
                for (at, cell) in (begin..).zip(cells) {
                    if *cell != next || length == RUN {
                        runs.push(at as u32);
                        length = 0;
                    }
                    (next, length) = (cell + 1, length + 1);
                }
            }
            runs
        });
        self.runs = runs.concat();
        self.runs.push(self.places.len() as u32);
    }

    /// Gives its array back.
    pub fn end(self, patch: &mut Patch<'_>) {
        patch.room.give(self.field);
    }

    /// What a cell does to itself, about.
    pub fn own(&self) -> f64 {
        self.own
    }

    /// out = the near inverse of A + b, times values on the set that it is confined to.
    pub fn apply(&mut self, patch: &Patch<'_>, set: &ContactSet, values: &[f64], out: &mut [f64]) {
        let ([_, ny], [_, ry], pitch) = (patch.counts, self.reach, self.pitch);
        let (places, factors) = (&self.places, &self.factors);
        set.in_rows(patch.threads, pitch, &mut self.field[ry * pitch..][..ny * pitch], |group, field| {
            let first = (ry + group.rows.start) * pitch;
            let cells = places[group.cells.clone()].iter().zip(&values[group.cells.clone()]);
            if factors.is_empty() {
                cells.for_each(|(place, value)| field[*place as usize - first] = *value);
            } else {
                for ((place, value), factor) in cells.zip(&factors[group.cells]) {
                    field[*place as usize - first] = factor * value;
                }
            }
        });
        self.wrap(patch);
        if patch.threads > 1 && out.len() >= WORTH {
            let (mut shares, mut rest) = (Vec::new(), out);
            for first in (0..self.runs.len() - 1).step_by(SHARE) {
                let runs = &self.runs[first..self.runs.len().min(first + SHARE + 1)];
                let (own, others) = rest.split_at_mut((runs[runs.len() - 1] - runs[0]) as usize);
                shares.push((runs, own));
                rest = others;
            }
            shares.into_par_iter().for_each(|(runs, out)| self.act(runs, out));
        } else {
            self.act(&self.runs, out);
        }
    }

    /// What it does for the runs that begin here, but for the last.
    fn act(&self, runs: &[u32], out: &mut [f64]) {
        let near = Neighbours { field: &self.field, pitch: self.pitch, quarter: &self.quarter };
        let first = runs[0] as usize;
        match self.reach {
            [REACH_3D, REACH_3D] => near.sums::<REACH_3D>(&self.places, runs, out),
            [REACH_2D, 0] => near.sums::<REACH_2D>(&self.places, runs, out),
            _ => out.iter_mut().zip(&self.places[first..]).for_each(|(out, place)| *out = self.single(*place as usize)),
        }
        if !self.factors.is_empty() {
            out.iter_mut().zip(&self.factors[first..]).for_each(|(out, factor)| *out *= factor);
        }
    }

    /// What it does for one cell.
    fn single(&self, place: usize) -> f64 {
        let [rx, ry] = self.reach;
        let (wide, high) = (in_lanes(2 * rx + 1), 2 * ry + 1);
        let first = place - ry * self.pitch - rx;
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
        sums.iter().sum()
    }

    /// Repeats the field beyond the sides where the window is the whole of a periodic surface, and its mirror image beyond
    /// a mirror: that through the first cells, and that through the last ones where it is half of a period.
    fn wrap(&mut self, patch: &Patch<'_>) {
        let ([nx, ny], [rx, ry], pitch) = (patch.counts, self.reach, self.pitch);
        let mirrored = patch.kernel.mirrored;
        if mirrored[0] {
            for row in self.field.chunks_exact_mut(pitch).skip(ry).take(ny) {
                (1..=rx).for_each(|away| row[rx - away] = row[rx + away]);
                if patch.wraps[0] {
                    let last = rx + nx - 1;
                    (1..=rx).for_each(|away| row[last + away] = row[last - away]);
                }
            }
        } else if patch.wraps[0] {
            for row in self.field.chunks_exact_mut(pitch).skip(ry).take(ny) {
                row.copy_within(nx..nx + rx, 0);
                row.copy_within(rx..2 * rx, nx + rx);
            }
        }
        if mirrored[1] {
            let mut copy =
                |from: usize, to: usize| self.field.copy_within(from * pitch..(from + 1) * pitch, to * pitch);
            (1..=ry).for_each(|away| copy(ry + away, ry - away));
            if patch.wraps[1] {
                let last = ry + ny - 1;
                (1..=ry).for_each(|away| copy(last - away, last + away));
            }
        } else if patch.wraps[1] {
            self.field.copy_within(ny * pitch..(ny + ry) * pitch, 0);
            self.field.copy_within(ry * pitch..2 * ry * pitch, (ny + ry) * pitch);
        }
    }
}

/// The entries: the inverse transform of 1 / (a + b m), a being the compliance of a mode and m what smoothing leaves of it.
fn inverse(patch: &Patch<'_>, size: [usize; 2], reach: [usize; 2], local: f64) -> Vec<f64> {
    let cosines = size.map(|size| (0..size).map(|k| (2.0 * PI * k as f64 / size as f64).cos()).collect::<Vec<_>>());
    let half = size.map(|size| size / 2 + 1);
    // Waves k and size - k are the same.
    let twice = |k: usize, axis: usize| if k == 0 || 2 * k == size[axis] { 1.0 } else { 2.0 };
    let smooth = |k: usize, axis: usize| if patch.smoothed { 0.5 + 0.5 * cosines[axis][k] } else { 1.0 };
    // A uniform displacement needs no pressure, or far less than any other.
    let stiffness = |x: usize, y: usize| {
        let compliance = patch.kernel.mode([x, y], size);
        let all = compliance + local * smooth(x, 0) * smooth(y, 1);
        if compliance == 0.0 { 0.0 } else { twice(x, 0) * twice(y, 1) / all }
    };
    let cells = (size[0] * size[1]) as f64;
    let (wide, high) = (2 * reach[0] + 1, 2 * reach[1] + 1);
    let mut entries = vec![0.0; wide * high];
    // First over x for each wave in y, then over y.
    let mut along = vec![0.0; (reach[0] + 1) * half[1]];
    for y in 0..half[1] {
        for k in 0..half[0] {
            let stiffness = stiffness(k, y) / cells;
            for x in 0..=reach[0] {
                along[x * half[1] + y] += stiffness * cosines[0][k * x % size[0]];
            }
        }
    }
    for y in 0..=reach[1] {
        for x in 0..=reach[0] {
            let value: f64 = (0..half[1]).map(|k| along[x * half[1] + k] * cosines[1][k * y % size[1]]).sum();
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
