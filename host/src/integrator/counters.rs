//! What advancing has cost, and its estimated error.

use super::AdvanceError;

/// Work and error of one advance over one chunk of points; sums in a fixed order give sums in the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Accepted panels or substeps.
    pub accepted: u64,
    /// Rejected ones.
    pub rejected: u64,
    /// Calls of the law.
    pub law_calls: u64,
    /// Points at which the law was evaluated, summed over calls.
    pub points_evaluated: u64,
    /// Estimated error: L2 norm over the points of the wear depth's error; length.
    pub error: f64,
    /// Shortest accepted panel or substep; time. 0 where nothing was accepted.
    pub shortest: f64,
    /// Longest accepted panel or substep; time.
    pub longest: f64,
}

impl Tally {
    /// Notes an accepted panel or substep of length `step` with an estimated error.
    pub fn accept(&mut self, step: f64, error: f64) {
        self.shortest = if self.accepted == 0 { step } else { self.shortest.min(step) };
        self.longest = self.longest.max(step);
        self.accepted += 1;
        self.error += error;
    }

    /// Refuses more panels or substeps than `most`, tried ones counting, at `time`.
    pub(super) fn hold<E: std::error::Error + 'static>(&self, most: u64, time: f64) -> Result<(), AdvanceError<E>> {
        let substeps = self.accepted + self.rejected;
        if substeps > most { Err(AdvanceError::ManySubsteps { time, substeps, most }) } else { Ok(()) }
    }

    /// Adds the next piece of time over the same points: errors add up.
    pub fn then(&mut self, next: &Tally) {
        self.merge(next);
        self.error += next.error;
    }

    /// Adds the same piece of time over other points: errors are orthogonal.
    pub fn beside(&mut self, other: &Tally) {
        self.merge(other);
        self.error = self.error.hypot(other.error);
    }

    fn merge(&mut self, other: &Tally) {
        if other.accepted > 0 {
            self.shortest = if self.accepted == 0 { other.shortest } else { self.shortest.min(other.shortest) };
            self.longest = self.longest.max(other.longest);
        }
        self.accepted += other.accepted;
        self.rejected += other.rejected;
        self.law_calls += other.law_calls;
        self.points_evaluated += other.points_evaluated;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_add_along_time_and_square_across_points() {
        let mut a = Tally::default();
        a.accept(1.0, 3.0);
        let mut b = Tally::default();
        b.accept(0.5, 4.0);
        let (mut along, mut across) = (a, a);
        along.then(&b);
        across.beside(&b);
        assert_eq!((along.error, across.error), (7.0, 5.0));
        assert_eq!((along.shortest, along.longest, along.accepted), (0.5, 1.0, 2));
    }
}
