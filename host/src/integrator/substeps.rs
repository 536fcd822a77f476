//! Advance by whole substeps, for laws that have a memory or are not linear in `dt`, over one chunk of points.
//!
//! One call of the law is one whole substep from the committed memory. The error of a substep is the difference
//! between taking it whole and taking it in two halves (step doubling; Hairer, Norsett and Wanner, 1993, II.4); the
//! halves are what is kept. The memory is committed only with an accepted substep.

use super::{AdvanceError, Reply, Tally, invisible, norm};
use crate::integrator::quadrature::Span;

/// Relative length below which a piece cannot be cut further.
const SHORTEST: f64 = 1e-13;
/// Part of the tolerance that a substep may have by itself; the rest is shared by those that cannot keep to it.
const OWN: f64 = 0.75;
/// Part of what is left to share that one substep may take, so that there is always some left.
const SHARE: f64 = 1.0 / 16.0;
/// Below this relative difference two increments differ by rounding alone.
const ROUNDING: f64 = 1e-14;

/// What a law remembers over one chunk of points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Memory {
    /// Wear depth `[points]`; length.
    pub wear: Vec<f64>,
    /// State variables `[points * state variables]`.
    pub state: Vec<f64>,
}

/// Something that gives wear increments over parts of a piece of loading.
pub trait Substep {
    /// What the evaluation can fail with.
    type Error: std::error::Error + 'static;

    /// Evaluates the part from the fraction `from` to the fraction `to` of the piece, starting with memory `start`;
    /// writes the increments `[points]` and the state at the end.
    ///
    /// # Errors
    /// Whatever the evaluation fails with.
    fn evaluate(
        &mut self,
        from: f64,
        to: f64,
        start: &Memory,
        increment: &mut [f64],
        end: &mut [f64],
    ) -> Result<Reply, Self::Error>;
}

/// How a piece is cut into substeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// Taken whole, unless the law wants it shorter.
    Fixed,
    /// Cut until the relative L2 error of every substep's increment is at most this.
    Tolerance(f64),
}

/// Buffers of one chunk, kept from piece to piece.
#[derive(Debug, Default)]
pub struct Room {
    whole: Trial,
    first: Trial,
    second: Trial,
    halfway: Memory,
    sum: Vec<f64>,
}

#[derive(Debug, Default)]
struct Trial {
    increment: Vec<f64>,
    end: Vec<f64>,
}

impl Trial {
    fn take<S: Substep>(
        &mut self,
        law: &mut S,
        (from, to): (f64, f64),
        start: &Memory,
        tally: &mut Tally,
    ) -> Result<Reply, S::Error> {
        self.increment.resize(start.wear.len(), 0.0);
        self.end.resize(start.state.len(), 0.0);
        tally.law_calls += 1;
        tally.points_evaluated += start.wear.len() as u64;
        law.evaluate(from, to, start, &mut self.increment, &mut self.end)
    }
}

enum Step {
    /// Norms of the error and of the increment.
    Good {
        error: f64,
        size: f64,
    },
    Cut(f64),
}

impl Control {
    /// Advances `memory` over one piece and says what it took; `hint` is the substep to try first and is updated
    /// (infinity: the whole piece).
    ///
    /// # Errors
    /// What the evaluation fails with; a tolerance that cannot be met; a law that wants too short a substep.
    pub fn advance<S: Substep>(
        self,
        law: &mut S,
        span: Span,
        hint: &mut f64,
        room: &mut Room,
        memory: &mut Memory,
    ) -> Result<Tally, AdvanceError<S::Error>> {
        let mut tally = Tally::default();
        let mut at = 0.0;
        // Fixed substeps are the pieces; only within a piece does a cut live on.
        let mut wish = if self == Control::Fixed { f64::INFINITY } else { *hint };
        let mut budget = Budget::default();
        while at < 1.0 {
            let asked = if span.length > 0.0 { wish / span.length } else { 1.0 };
            // A sliver at the end is not worth a substep of its own.
            let to = if at + asked > 1.0 - 0.01 * asked.min(1.0) { 1.0 } else { at + asked };
            let step = (to - at) * span.length;
            let time = span.start + at * span.length;
            let factor = match self.try_step(law, (at, to), room, memory, &mut tally)? {
                Step::Good { error, size } => {
                    let (allowed, growth) = self.judge(error, size, budget.allowance(self, size, (at, to)));
                    if allowed || invisible(error, &memory.wear) {
                        room.commit(self, memory);
                        tally.accept(step, error);
                        budget.spend(self, error, size);
                        let next = growth * step;
                        // A piece that ends early says nothing against the longer substep of before.
                        let cut_short = to == 1.0 && wish.is_finite() && growth >= 1.0;
                        wish = if cut_short { next.max(wish) } else { next };
                        at = to;
                        *hint = wish;
                        tally.hold(span.most, time)?;
                        continue;
                    }
                    if to - at < SHORTEST {
                        let tolerance = if let Control::Tolerance(tolerance) = self { tolerance } else { 0.0 };
                        let estimate = error / size;
                        return Err(AdvanceError::Tolerance { time, step, estimate, tolerance });
                    }
                    growth
                }
                Step::Cut(factor) => {
                    let asked = factor * step;
                    if asked < span.smallest || to - at < SHORTEST {
                        return Err(AdvanceError::SmallestStep { time, asked, smallest: span.smallest });
                    }
                    factor
                }
            };
            tally.rejected += 1;
            tally.hold(span.most, time)?;
            wish = step * factor;
        }
        Ok(tally)
    }

    /// Whether the error of an increment of `size` is allowed, by itself or by the piece's `allowance`, and the factor
    /// for the next substep (first-order control: what is compared falls with the square of the substep).
    fn judge(self, error: f64, size: f64, allowance: f64) -> (bool, f64) {
        let Control::Tolerance(tolerance) = self else { return (true, 1.0) };
        let most = ((OWN * tolerance).max(ROUNDING) * size).max(allowance);
        let wish = if error > 0.0 { 0.9 * (most / error).sqrt() } else { 4.0 };
        if error <= most { (true, wish.clamp(0.5, 4.0)) } else { (false, wish.clamp(0.1, 0.7)) }
    }

    fn try_step<S: Substep>(
        self,
        law: &mut S,
        (from, to): (f64, f64),
        room: &mut Room,
        memory: &Memory,
        tally: &mut Tally,
    ) -> Result<Step, S::Error> {
        let Room { whole, first, second, halfway, sum } = room;
        if let Reply::Cut(factor) = whole.take(law, (from, to), memory, tally)? {
            return Ok(Step::Cut(factor));
        }
        if self == Control::Fixed {
            return Ok(Step::Good { error: 0.0, size: 0.0 });
        }
        let middle = from + 0.5 * (to - from);
        if let Reply::Cut(factor) = first.take(law, (from, middle), memory, tally)? {
            return Ok(Step::Cut(0.5 * factor));
        }
        halfway.wear.clear();
        halfway.wear.extend(memory.wear.iter().zip(&first.increment).map(|(w, dw)| w + dw));
        halfway.state.clone_from(&first.end);
        if let Reply::Cut(factor) = second.take(law, (middle, to), halfway, tally)? {
            return Ok(Step::Cut(0.5 * factor));
        }
        sum.clear();
        sum.extend(first.increment.iter().zip(&second.increment).map(|(a, b)| a + b));
        let size = norm(sum.iter().copied());
        let error = norm(sum.iter().zip(&whole.increment).map(|(a, b)| a - b));
        Ok(Step::Good { error, size })
    }
}

/// The error that a piece may have as a whole, beside what its substeps may have by themselves.
///
/// Where a rate starts or ends like a power of time, the relative error of the substep at that end is the same however
/// short it is; what counts is its size against the piece.
#[derive(Default)]
struct Budget {
    /// Largest increment that was tried.
    tried: f64,
    /// Sum of the increments that were accepted.
    done: f64,
    spent: f64,
}

impl Budget {
    /// What the substep from `from` to `to` with an increment of `size` may take: a part of what is left, so that
    /// there is always some left.
    fn allowance(&mut self, control: Control, size: f64, (from, to): (f64, f64)) -> f64 {
        self.tried = self.tried.max(size);
        let Control::Tolerance(tolerance) = control else { return 0.0 };
        let at_this_rate = self.done + size * (1.0 - from) / (to - from);
        SHARE * ((1.0 - OWN) * tolerance * self.tried.min(at_this_rate) - self.spent)
    }

    fn spend(&mut self, control: Control, error: f64, size: f64) {
        self.done += size;
        if let Control::Tolerance(tolerance) = control
            && error > (OWN * tolerance).max(ROUNDING) * size
        {
            self.spent += error;
        }
    }
}

impl Room {
    fn commit(&self, control: Control, memory: &mut Memory) {
        let (increment, end) = match control {
            Control::Fixed => (&self.whole.increment, &self.whole.end),
            Control::Tolerance(_) => (&self.sum, &self.second.end),
        };
        for (wear, part) in memory.wear.iter_mut().zip(increment) {
            *wear += part;
        }
        memory.state.copy_from_slice(end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// w' = s, s' = -s from s = 1, taken by backward Euler; wants at most `longest`.
    struct Decay {
        length: f64,
        longest: f64,
    }

    impl Substep for Decay {
        type Error = Infallible;
        fn evaluate(
            &mut self,
            from: f64,
            to: f64,
            start: &Memory,
            increment: &mut [f64],
            end: &mut [f64],
        ) -> Result<Reply, Infallible> {
            let dt = (to - from) * self.length;
            if dt > self.longest * (1.0 + 1e-12) {
                return Ok(Reply::Cut((self.longest / dt).min(0.9)));
            }
            for i in 0..start.wear.len() {
                end[i] = start.state[i] / (1.0 + dt);
                increment[i] = dt * end[i];
            }
            Ok(Reply::Good)
        }
    }

    fn run(control: Control, longest: f64, smallest: f64) -> Result<(f64, Tally), AdvanceError<Infallible>> {
        run_within(u64::MAX, control, longest, smallest)
    }

    fn run_within(
        most: u64,
        control: Control,
        longest: f64,
        smallest: f64,
    ) -> Result<(f64, Tally), AdvanceError<Infallible>> {
        let mut law = Decay { length: 2.0, longest };
        let mut memory = Memory { wear: vec![0.0; 3], state: vec![1.0; 3] };
        let span = Span { start: 0.0, length: 2.0, smallest, most };
        let mut hint = f64::INFINITY;
        let tally = control.advance(&mut law, span, &mut hint, &mut Room::default(), &mut memory)?;
        assert!(memory.wear.iter().zip(&memory.state).all(|(w, s)| (w + s - 1.0).abs() < 1e-12));
        Ok((memory.wear[1], tally))
    }

    #[test]
    fn a_piece_takes_no_more_substeps_than_are_allowed() {
        let substeps = |most| run_within(most, Control::Fixed, 1e-2, 0.0).map(|(_, tally)| tally.accepted);
        let taken = substeps(u64::MAX).expect("no limit");
        assert!(taken >= 200, "{taken}");
        assert!(matches!(substeps(50), Err(AdvanceError::ManySubsteps { substeps: 51, most: 50, .. })));
        assert_eq!(substeps(2 * taken).expect("a limit that is kept"), taken);
    }

    #[test]
    fn the_error_falls_with_the_tolerance_and_is_estimated() {
        let exact = 1.0 - (-2.0_f64).exp();
        let mut last = f64::INFINITY;
        for tolerance in [1e-2, 1e-4, 1e-6] {
            let (wear, tally) = run(Control::Tolerance(tolerance), 10.0, 0.0).expect("it converges");
            let error = (wear - exact).abs();
            assert!(error < 0.2 * last && error <= tally.error && tally.accepted > 1, "{error:e} {tally:?}");
            last = error;
        }
    }

    #[test]
    fn a_wish_for_a_shorter_substep_is_honoured() {
        let (_, tally) = run(Control::Fixed, 0.25, 0.1).expect("it is allowed");
        assert!(tally.longest <= 0.25 * (1.0 + 1e-9) && tally.accepted >= 8 && tally.rejected > 0, "{tally:?}");
        let error = run(Control::Fixed, 0.25, 0.5).expect_err("a quarter is shorter than a half");
        assert!(matches!(error, AdvanceError::SmallestStep { .. }), "{error}");
    }

    /// w' = t^0.6: the relative error of the first substep does not fall with its length.
    struct Root;

    impl Substep for Root {
        type Error = Infallible;
        fn evaluate(
            &mut self,
            from: f64,
            to: f64,
            _: &Memory,
            increment: &mut [f64],
            _: &mut [f64],
        ) -> Result<Reply, Infallible> {
            increment.fill((to - from) * (0.5 * (from + to)).powf(0.6));
            Ok(Reply::Good)
        }
    }

    #[test]
    fn a_rate_that_starts_like_a_power_of_time_meets_its_tolerance() {
        for tolerance in [1e-3, 1e-6, 1e-8] {
            let mut memory = Memory { wear: vec![0.0; 2], state: Vec::new() };
            let span = Span { start: 0.0, length: 1.0, smallest: 0.0, most: u64::MAX };
            let (mut hint, mut room) = (f64::INFINITY, Room::default());
            let control = Control::Tolerance(tolerance);
            let tally = control.advance(&mut Root, span, &mut hint, &mut room, &mut memory).expect("it converges");
            let error = (1.6 * memory.wear[0] - 1.0).abs();
            assert!(error < tolerance && tally.error < 1.5 * tolerance, "{tolerance:e}: {error:e} {tally:?}");
        }
    }

    #[test]
    fn a_short_piece_does_not_shorten_the_substeps_after_it() {
        let mut memory = Memory { wear: vec![0.0; 2], state: vec![1.0; 2] };
        let (mut hint, mut room) = (f64::INFINITY, Room::default());
        let mut calls = |control: Control, length: f64| {
            let span = Span { start: 0.0, length, smallest: 0.0, most: u64::MAX };
            let mut law = Decay { length, longest: 10.0 };
            let tally = control.advance(&mut law, span, &mut hint, &mut room, &mut memory);
            tally.expect("it converges").law_calls
        };
        assert_eq!([1.0, 1e-6, 1.0].map(|length| calls(Control::Fixed, length)), [1, 1, 1]);
        let [long, short, again] = [1.0, 1e-9, 1.0].map(|length| calls(Control::Tolerance(1e-2), length));
        assert!(short == 3 && again <= long, "{long} {short} {again}");
    }

    #[test]
    fn one_fixed_substep_is_one_call() {
        let (wear, tally) = run(Control::Fixed, 10.0, 0.0).expect("it converges");
        assert_eq!((wear, tally.law_calls, tally.points_evaluated), (2.0 / 3.0, 1, 3));
    }
}
