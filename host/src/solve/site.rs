//! What one call of a law needs beside what drives the points: the piece, the moment, the memory and room to work in.

use crate::contact::prescribed::History;
use crate::law::{LawDescriptor, Values};
use crate::plan::Plan;
use crate::solve::schedule::Piece;

/// What does not change over a piece, for all of its points.
#[derive(Clone, Copy)]
pub(super) struct Site<'s> {
    pub(super) plan: &'s Plan,
    pub(super) law: &'s LawDescriptor,
    pub(super) piece: &'s Piece<'s>,
    pub(super) history: Option<&'s History>,
    /// Whether the law is called for whole substeps rather than as a rate.
    pub(super) whole: bool,
}

impl Site<'_> {
    /// Number of a point in the history's numbering.
    pub(super) fn id(&self, i: usize) -> i64 {
        self.history.map_or(i as i64, |history| history.point_ids().get(i))
    }
}

/// A moment of a piece at which the law is called for a duration.
pub(super) struct Moment {
    /// Fraction of the piece at which the inputs are taken.
    pub(super) at: f64,
    /// Fraction of the piece at which the call's time begins.
    pub(super) from: f64,
    /// Duration; time.
    pub(super) dt: f64,
}

/// What a law remembers, for laws that read it.
#[derive(Clone, Copy, Default)]
pub(super) struct Remembered<'m> {
    pub(super) wear: &'m [f64],
    pub(super) distance: Values<'m>,
    pub(super) state: &'m [f64],
}

/// Buffers of one thread.
#[derive(Default)]
pub(super) struct Rooms {
    pub(super) pressure: Vec<f64>,
    pub(super) traction: Vec<f64>,
    pub(super) parts: [Vec<f64>; 9],
    pub(super) normal: Vec<f64>,
    pub(super) tangent: Vec<f64>,
    pub(super) velocity: [Vec<f64>; 3],
    pub(super) speed: Vec<f64>,
    pub(super) slip: Vec<f64>,
    pub(super) slip_vector: Vec<f64>,
    pub(super) temperature: Vec<f64>,
    pub(super) constants: Vec<f64>,
    pub(super) shear: Vec<f64>,
    pub(super) work: Vec<f64>,
    pub(super) stress: Vec<f64>,
    pub(super) coefficient: Vec<f64>,
    pub(super) area: Vec<f64>,
    pub(super) coordinates: Vec<f64>,
    pub(super) inputs: Vec<Vec<f64>>,
    pub(super) contact: Vec<i64>,
    pub(super) ids: Vec<i64>,
}
