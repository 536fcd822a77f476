//! The arrays of a run, and what they add up to.

use rayon::prelude::*;

use crate::integrator::{AdvanceError, Tally};
use crate::law::Evaluator;
use crate::record::{Checkpoint, CheckpointError};
use crate::solve::PointError;
use crate::solve::chunk::{self, CHUNK, Done, Scratch, Slices};
use crate::solve::inputs::Drive;
use crate::solve::site::Site;
use crate::solve::sums::Sums;
use std::time::Duration;

/// The arrays of a run.
pub(super) struct Arrays {
    /// Wear depth `[points]`.
    pub(super) wear: Vec<f64>,
    /// State variables `[points][variables]`.
    pub(super) state: Vec<f64>,
    /// Sliding distances `[points]`; empty where all points slide alike.
    pub(super) distance: Vec<f64>,
    /// The sliding distance where all points slide alike.
    pub(super) uniform_distance: f64,
    /// Wear directions `[points][3]`; empty where nobody wants them.
    pub(super) direction: Vec<f64>,
    /// Wear depth after the piece, before averaging; empty without averaging.
    averaged: Vec<f64>,
    hints: Vec<f64>,
    states: usize,
    /// Whether a piece has been gone through; before, wear and distances are zero.
    worn: bool,
    /// All of it before the last piece, where that is little.
    spare: Vec<f64>,
}

/// Numbers up to which a run keeps its arrays twice, so that a piece that fails can be undone.
const MOST_SPARE: usize = 400_000;

/// What one piece came to.
pub(super) struct PieceDone {
    pub(super) tally: Tally,
    pub(super) law_time: Duration,
    pub(super) warnings: Vec<String>,
    pub(super) sums: Sums,
}

impl Arrays {
    pub(super) fn new(
        points: usize,
        initial_state: &[f64],
        distances: bool,
        directions: bool,
        average: bool,
    ) -> Arrays {
        Arrays {
            wear: vec![0.0; points],
            state: initial_state.repeat(points),
            distance: if distances { vec![0.0; points] } else { Vec::new() },
            uniform_distance: 0.0,
            direction: if directions { vec![0.0; 3 * points] } else { Vec::new() },
            averaged: if average { vec![0.0; points] } else { Vec::new() },
            hints: vec![f64::INFINITY; points.div_ceil(CHUNK)],
            states: initial_state.len(),
            worn: false,
            spare: Vec::new(),
        }
    }

    fn chunks(&mut self) -> Vec<(usize, Slices<'_>)> {
        let wear = if self.averaged.is_empty() { &mut self.wear } else { &mut self.averaged };
        let points = wear.len();
        let mut rest = (
            wear.as_mut_slice(),
            self.state.as_mut_slice(),
            self.distance.as_mut_slice(),
            self.direction.as_mut_slice(),
        );
        let mut hints = self.hints.as_mut_slice();
        let mut chunks = Vec::with_capacity(points.div_ceil(CHUNK));
        let mut start = 0;
        while start < points {
            let len = CHUNK.min(points - start);
            let cut = |slice: &mut [f64], per_point: usize| if slice.is_empty() { 0 } else { len * per_point };
            let (wear, a) = rest.0.split_at_mut(len);
            let at = cut(rest.1, self.states);
            let (state, b) = rest.1.split_at_mut(at);
            let at = cut(rest.2, 1);
            let (distance, c) = rest.2.split_at_mut(at);
            let at = cut(rest.3, 3);
            let (direction, d) = rest.3.split_at_mut(at);
            let Some((hint, more)) = hints.split_first_mut() else { break };
            (rest, hints) = ((a, b, c, d), more);
            chunks.push((start, Slices { wear, state, distance, direction, hint }));
            start += len;
        }
        chunks
    }

    /// Runs `work` on every chunk, on as many threads as there are; the results come in the order of the points.
    fn each<T: Send>(&mut self, work: impl Fn(usize, &mut Slices<'_>, &mut Scratch) -> T + Sync) -> Vec<T> {
        let mut chunks = self.chunks();
        if let [(start, slices)] = chunks.as_mut_slice() {
            return vec![work(*start, slices, &mut Scratch::default())];
        }
        let mut results = Vec::new();
        chunks
            .into_par_iter()
            .map_init(Scratch::default, |scratch, (start, mut slices)| work(start, &mut slices, scratch))
            .collect_into_vec(&mut results);
        results
    }

    /// Advances all points over one piece and sums up what they are at its end.
    pub(super) fn advance(
        &mut self,
        site: &Site<'_>,
        drive: &Drive<'_>,
        evaluator: &dyn Evaluator,
    ) -> Result<PieceDone, AdvanceError<PointError>> {
        let average = !self.averaged.is_empty();
        if average {
            self.averaged.copy_from_slice(&self.wear);
        }
        self.worn = true;
        let points = self.wear.len();
        let rule = chunk::rule(site, drive, points);
        let length = site.piece.end - site.piece.start;
        let before = self.uniform_distance;
        let results = self.each(|start, slices, scratch| {
            let range = start..start + slices.wear.len();
            let mut done = chunk::advance(site, drive, evaluator, range.clone(), slices, (rule, before), scratch)?;
            chunk::slide(drive, length, range.clone(), slices.distance, scratch);
            if !average {
                done.sums = chunk::measure(site, drive, (1.0, true), range, slices, scratch);
            }
            Ok::<Done, AdvanceError<PointError>>(done)
        });
        if self.distance.is_empty() {
            let (mut room, mut parts) = (Vec::new(), Default::default());
            let path = drive.paths((0.0, 1.0), length, 0..1, &mut room, &mut parts);
            self.uniform_distance += crate::solve::source::value(&path, 0);
        }
        let mut whole = PieceDone {
            tally: Tally::default(),
            law_time: Duration::ZERO,
            warnings: Vec::new(),
            sums: Sums::default(),
        };
        for result in results {
            let done = result?;
            whole.tally.beside(&done.tally);
            whole.law_time += done.law_time;
            whole.warnings.extend(done.warnings);
            whole.sums.add(&done.sums);
        }
        if average {
            self.average(site, drive);
            whole.sums = self.measure(site, drive, 1.0);
        }
        Ok(whole)
    }

    /// Replaces the increments of a piece by their mean over the contact.
    fn average(&mut self, site: &Site<'_>, drive: &Drive<'_>) {
        let wear = std::mem::take(&mut self.wear);
        let sums = self.each(|start, slices, scratch| {
            let range = start..start + slices.wear.len();
            for (increment, before) in slices.wear.iter_mut().zip(&wear[range.clone()]) {
                *increment -= before;
            }
            chunk::contact_sums(site, drive, range, slices.wear, scratch)
        });
        let (total, weight) = sums.iter().fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
        let mean = if weight > 0.0 { total / weight } else { 0.0 };
        self.each(|start, slices, scratch| {
            chunk::spread(site, drive, start..start + slices.wear.len(), mean, slices.wear, scratch);
        });
        self.wear = wear;
        for (wear, increment) in self.wear.iter_mut().zip(&self.averaged) {
            *wear += increment;
        }
    }

    fn all(&mut self) -> [&mut [f64]; 6] {
        let uniform = std::slice::from_mut(&mut self.uniform_distance);
        [uniform, &mut self.wear, &mut self.state, &mut self.distance, &mut self.direction, &mut self.hints]
    }

    /// Keeps what the arrays hold, for [`Arrays::go_back`].
    pub(super) fn remember(&mut self) {
        let mut spare = std::mem::take(&mut self.spare);
        spare.clear();
        let all = self.all();
        if all.iter().map(|data| data.len()).sum::<usize>() <= MOST_SPARE {
            all.into_iter().for_each(|data| spare.extend_from_slice(data));
        }
        self.spare = spare;
    }

    /// Takes up what was kept; false: it was too much to be kept.
    pub(super) fn go_back(&mut self) -> bool {
        let spare = std::mem::take(&mut self.spare);
        let mut rest = &spare[..];
        for data in self.all() {
            let Some((kept, more)) = rest.split_at_checked(data.len()) else { return false };
            data.copy_from_slice(kept);
            rest = more;
        }
        true
    }

    /// Saves all that the next piece depends on.
    pub(super) fn save<'a>(&'a self, to: &mut Checkpoint<'a>) {
        to.set("uniform_distance", self.uniform_distance);
        for (name, data) in [
            ("wear", &self.wear),
            ("state", &self.state),
            ("distance", &self.distance),
            ("direction", &self.direction),
            ("hints", &self.hints),
        ] {
            to.put(name, &data[..]);
        }
    }

    /// Takes up what was saved; `worn`: a piece has been gone through.
    ///
    /// # Errors
    /// Arrays that are not there, or are not as long as these.
    pub(super) fn take_up(&mut self, from: &Checkpoint<'_>, worn: bool) -> Result<(), CheckpointError> {
        self.uniform_distance = from.number("uniform_distance")?;
        from.copy("wear", &mut self.wear)?;
        from.copy("state", &mut self.state)?;
        from.copy("distance", &mut self.distance)?;
        from.copy("direction", &mut self.direction)?;
        from.copy("hints", &mut self.hints)?;
        self.worn = worn;
        Ok(())
    }

    /// Sums over all points at a fraction of a piece.
    pub(super) fn measure(&mut self, site: &Site<'_>, drive: &Drive<'_>, part: f64) -> Sums {
        let averaged = std::mem::take(&mut self.averaged);
        let worn = self.worn;
        let sums = self.each(|start, slices, scratch| {
            chunk::measure(site, drive, (part, worn), start..start + slices.wear.len(), slices, scratch)
        });
        self.averaged = averaged;
        let mut whole = Sums::default();
        sums.iter().for_each(|part| whole.add(part));
        whole
    }

    /// Bytes of the arrays of a run, before it is allocated.
    pub(super) fn bytes(
        points: usize,
        states: usize,
        distances: bool,
        directions: bool,
        average: bool,
    ) -> Vec<(&'static str, usize)> {
        let doubles = |count: usize| 8 * points * count;
        let mut lines = vec![("wear depth", doubles(1))];
        lines.extend((states > 0).then(|| ("state variables", doubles(states))));
        lines.extend(distances.then(|| ("sliding distances", doubles(1))));
        lines.extend(directions.then(|| ("wear directions", doubles(3))));
        lines.extend(average.then(|| ("increments to average", doubles(1))));
        lines
    }
}
