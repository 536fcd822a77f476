//! Where the points of a case lie, and the named norms of how far its fields are off.

use std::collections::BTreeMap;

use crate::integrator::norm;
use crate::record::{Errors, Geometry, Record};
use crate::scene::{Boundary, Model, Scene, Shape};
use crate::solve::{Expected, SolveError};

/// L2 of the wear depth over the points.
pub(super) const WEAR: &str = "wear_l2_relative";
/// L2 of the contact pressure.
pub(super) const PRESSURE: &str = "pressure_l2_relative";
/// Radius of the scar, counted in cells.
pub(super) const RADIUS: &str = "scar_radius_relative";
/// Part of the largest depth from which on a point counts as worn.
const WORN: f64 = 1e-9;

/// The norms by name, and what each is; all are relative.
const NORMS: [(&str, &str); 6] = [
    (WEAR, "difference of the wear depth over the wear depth, L2 over the points"),
    ("wear_max_relative", "largest difference of the wear depth over the largest wear depth"),
    (PRESSURE, "difference of the contact pressure over the contact pressure, L2 over the contact (of both)"),
    ("volume_relative", "worn volume; under a given load and linear Archard exact at any step, stable or not"),
    ("centre_depth_relative", "wear depth at the apex, or at the deepest point where there is no apex"),
    (RADIUS, "radius of a circle of the worn area (2-D: half its length), a cell at a time"),
];

/// What every norm is.
pub(super) fn norms() -> BTreeMap<String, String> {
    NORMS.iter().map(|(name, what)| ((*name).to_owned(), (*what).to_owned())).collect()
}

/// Wear and pressure at the end of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Fields {
    /// Wear depth `[points]`.
    pub(super) wear: Vec<f64>,
    /// Contact pressure `[points]`; empty where it is not known.
    pub(super) pressure: Vec<f64>,
    /// Worn volume, where there is one.
    pub(super) volume: Option<f64>,
}

impl Fields {
    /// Those of a run.
    pub(super) fn of(record: &Record<SolveError>) -> Self {
        let volume = record.history.last().and_then(|row| row.wear_volume);
        Self { wear: record.wear.clone(), pressure: record.pressure.clone(), volume }
    }
}

/// Where the points lie.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Frame {
    /// Cells along x and y, where there is a grid.
    pub(super) counts: Option<[usize; 2]>,
    spacing: [f64; 2],
    dimension: u8,
    /// The apex, in cells from the centre of the first one.
    apex: [f64; 2],
    has_apex: bool,
    periodic: bool,
}

impl Frame {
    /// The frame of a scene's points.
    pub(super) fn of(scene: &Scene, record: &Record<SolveError>) -> Self {
        let Geometry::Grid(grid) = &record.geometry else { return Self::default() };
        let surface = scene.surface.as_ref();
        let has_apex = !matches!(surface.map(|s| &s.shape), Some(Shape::Rough { .. } | Shape::File { .. }) | None);
        let center = surface.and_then(|surface| surface.center.as_ref());
        let spacing = grid.spacing();
        let apex = [0, 1].map(|axis| match center.and_then(|center| center.get(axis)) {
            Some(center) => center / spacing[axis] - 0.5,
            None => (grid.cells[axis] / 2) as f64,
        });
        let periodic = matches!(&scene.contact.model, Model::HalfSpace(half) if half.boundary == Boundary::Periodic);
        Self { counts: Some(grid.cells), spacing, dimension: scene.contact.dimension, apex, has_apex, periodic }
    }

    /// Area of a cell, or its length in 2-D.
    fn area(&self) -> f64 {
        if self.dimension == 2 { self.spacing[0] } else { self.spacing[0] * self.spacing[1] }
    }

    fn volume(&self, fields: &Fields) -> Option<f64> {
        fields.volume.or_else(|| self.counts.map(|_| fields.wear.iter().sum::<f64>() * self.area()))
    }

    /// The cell nearest to the apex, or the deepest point.
    fn center(&self, wear: &[f64]) -> Option<usize> {
        match self.counts {
            Some(counts) if self.has_apex => {
                let [x, y] = [0, 1].map(|axis| (self.apex[axis].round().max(0.0) as usize).min(counts[axis] - 1));
                Some(y * counts[0] + x)
            }
            _ => (0..wear.len()).max_by(|a, b| wear[*a].total_cmp(&wear[*b])),
        }
    }

    /// Radius or half-width of the worn part; `None`: no grid, or nothing is worn.
    fn radius(&self, wear: &[f64]) -> Option<f64> {
        self.counts?;
        let least = WORN * wear.iter().fold(0.0, |most: f64, depth| most.max(*depth));
        let area = wear.iter().filter(|depth| **depth > least).count() as f64 * self.area();
        let radius = if self.dimension == 2 { area / 2.0 } else { (area / std::f64::consts::PI).sqrt() };
        (radius > 0.0).then_some(radius)
    }

    /// A cell over the radius of the worn part: what counting cells can tell apart.
    pub(super) fn cell_of_radius(&self, wear: &[f64]) -> Option<f64> {
        self.radius(wear).map(|radius| self.spacing[0] / radius)
    }

    /// How far `found` is from `wanted` in every norm that both have.
    pub(super) fn errors(&self, found: &Fields, wanted: &Fields) -> Errors {
        let mut errors = Errors::new();
        let mut also = |index: usize, value: f64| errors.insert(NORMS[index].0.to_owned(), value);
        let largest = wanted.wear.iter().fold(0.0, |most: f64, depth| most.max(depth.abs()));
        let off = found.wear.iter().zip(&wanted.wear).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        also(0, relative_l2(&found.wear, &wanted.wear));
        also(1, relative(off, largest));
        if !found.pressure.is_empty() && !wanted.pressure.is_empty() {
            also(2, relative_l2(&found.pressure, &wanted.pressure));
        }
        if let (Some(a), Some(b)) = (self.volume(found), self.volume(wanted)) {
            also(3, relative((a - b).abs(), b.abs()));
        }
        if let Some(center) = self.center(&wanted.wear) {
            let (a, b) = (found.wear[center], wanted.wear[center]);
            also(4, relative((a - b).abs(), b.abs()));
        }
        if let (Some(a), Some(b)) = (self.radius(&found.wear), self.radius(&wanted.wear)) {
            also(5, relative((a - b).abs(), b));
        }
        errors
    }

    /// Fields on these cells as they are at the centres of the cells of another grid over the same surface, linear in
    /// between, both counted from the apex.
    pub(super) fn onto(&self, fields: &Fields, other: &Frame) -> Option<Fields> {
        let (mine, theirs) = (self.counts?, other.counts?);
        let axes = [0, 1].map(|axis| {
            let places = (0..theirs[axis]).map(|cell| {
                let at = (cell as f64 - other.apex[axis]) * other.spacing[axis] / self.spacing[axis] + self.apex[axis];
                self.between(at, mine[axis])
            });
            places.collect::<Vec<_>>()
        });
        let moved = |field: &[f64]| {
            let mut on = Vec::with_capacity(theirs[0] * theirs[1]);
            for (low, high, part) in &axes[1] {
                for (left, right, along) in &axes[0] {
                    let row = |y: usize| {
                        let (a, b) = (field[y * mine[0] + left], field[y * mine[0] + right]);
                        a + along * (b - a)
                    };
                    on.push(row(*low) + part * (row(*high) - row(*low)));
                }
            }
            on
        };
        let pressure = if fields.pressure.is_empty() { Vec::new() } else { moved(&fields.pressure) };
        Some(Fields { wear: moved(&fields.wear), pressure, volume: self.volume(fields) })
    }

    /// The two cells around a place, and how far it lies behind the first.
    fn between(&self, at: f64, count: usize) -> (usize, usize, f64) {
        if count == 1 {
            return (0, 0, 0.0);
        }
        if self.periodic {
            let at = at.rem_euclid(count as f64);
            let first = (at.floor() as usize).min(count - 1);
            return (first, (first + 1) % count, at - first as f64);
        }
        let at = at.clamp(0.0, (count - 1) as f64);
        let first = (at.floor() as usize).min(count - 2);
        (first, first + 1, at - first as f64)
    }
}

impl From<Expected> for Fields {
    fn from(expected: Expected) -> Self {
        let Expected { wear, pressure, volume, .. } = expected;
        Self { wear, pressure, volume }
    }
}

fn relative_l2(found: &[f64], wanted: &[f64]) -> f64 {
    relative(norm(found.iter().zip(wanted).map(|(a, b)| a - b)), norm(wanted.iter().copied()))
}

fn relative(off: f64, size: f64) -> f64 {
    if off == 0.0 { 0.0 } else { off / size }
}
