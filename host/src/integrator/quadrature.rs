//! Quadrature of a wear rate that depends on time alone, over one chunk of points.
//!
//! A law without memory that is linear in `dt` is a rate, and under prescribed pressure its wear is an integral over
//! time. Smooth pieces (between break points) are integrated by a Kronrod rule that holds a Gauss rule; the difference
//! of the two is the error estimate, and a piece that misses its tolerance is halved (the adaptive scheme of QUADPACK,
//! Piessens et al., 1983, without its extrapolation).

use super::{AdvanceError, Reply, Rule, Tally, invisible, norm};

/// Halvings after which a piece is as short as doubles can tell times apart.
const MOST_HALVINGS: u32 = 48;
/// Part of the tolerance that a panel may have by itself; the rest is shared by those that cannot keep to it.
const OWN: f64 = 0.75;
/// Part of what is left to share that one panel may take, so that there is always some left.
const SHARE: f64 = 1.0 / 16.0;
/// Below this relative difference two sums differ by rounding alone.
const ROUNDING: f64 = 1e-14;

/// Something that gives wear increments at a moment of a piece of loading.
pub trait Rate {
    /// What the evaluation can fail with.
    type Error: std::error::Error + 'static;

    /// Number of points of the chunk.
    fn points(&self) -> usize;

    /// Writes into `out` `[points]` the increments that the inputs at the fraction `at` of the piece would give if they
    /// held for `dt`.
    ///
    /// # Errors
    /// Whatever the evaluation fails with.
    fn increments(&mut self, at: f64, dt: f64, out: &mut [f64]) -> Result<Reply, Self::Error>;
}

/// How a piece is integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quadrature {
    /// One evaluation, which the plan knows to be exact.
    Exact,
    /// Kronrod rules, halved until the relative L2 error is at most this.
    Adaptive(f64),
    /// Kronrod rule with 7 nodes, as it is.
    Fixed,
    /// A named rule, as it is.
    FixedRule(&'static Rule),
    /// A named rule, halved until the relative L2 difference from its two halves is at most this.
    AdaptiveRule(&'static Rule, f64),
}

/// A piece of loading in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Its start; time.
    pub start: f64,
    /// Its length; time.
    pub length: f64,
    /// A law's wish for less than this is an error; 0: no such limit.
    pub smallest: f64,
    /// Most panels or substeps that it may be cut into.
    pub most: u64,
}

/// Buffers of one chunk, kept from piece to piece.
#[derive(Debug, Default)]
pub struct Room {
    now: Vec<f64>,
    high: Vec<f64>,
    low: Vec<f64>,
}

impl Quadrature {
    /// Evaluations of a piece that meets its tolerance at once.
    pub fn least_evaluations(self) -> u64 {
        let nodes = match self {
            Quadrature::Exact => Rule::MIDPOINT.nodes.len(),
            Quadrature::Adaptive(_) | Quadrature::Fixed => Rule::KRONROD_7.nodes.len(),
            Quadrature::FixedRule(rule) => rule.nodes.len(),
            Quadrature::AdaptiveRule(rule, _) => 3 * rule.nodes.len(),
        };
        nodes as u64
    }

    /// Adds the wear of one piece to `wear` `[points]` and says what it took.
    ///
    /// # Errors
    /// What the evaluation fails with; a tolerance that cannot be met; a law that wants too short a substep.
    pub fn integrate<R: Rate>(
        self,
        rate: &mut R,
        span: Span,
        room: &mut Room,
        wear: &mut [f64],
    ) -> Result<Tally, AdvanceError<R::Error>> {
        let mut tally = Tally::default();
        if self == Quadrature::Exact && self.once(rate, span, room, wear, &mut tally)? {
            return Ok(tally);
        }
        let mut open = vec![(0.0, 1.0, 0)];
        // Where a rate starts or ends like a power of time, the relative error of the panel at that end is the same
        // however short it is; so panels may also share an error that is small against the piece, once its size is
        // known from the first try.
        let mut left = 0.0;
        while let Some((from, to, depth)) = open.pop() {
            let panel = Panel { span, from, to };
            let verdict = self.try_panel(rate, &panel, room, &mut tally, SHARE * left)?;
            let halve = match verdict.forgiving(wear) {
                Verdict::Good { error, shared } => {
                    tally.accept(panel.length(), error);
                    left -= if shared { error } else { 0.0 };
                    tally.hold(span.most, panel.time())?;
                    for (total, part) in wear.iter_mut().zip(&room.high) {
                        *total += part;
                    }
                    continue;
                }
                Verdict::Cut(factor) => {
                    let asked = factor * panel.length();
                    if asked < span.smallest {
                        let (time, smallest) = (panel.time(), span.smallest);
                        return Err(AdvanceError::SmallestStep { time, asked, smallest });
                    }
                    // A law that wants a tenth gets a sixteenth at once instead of four rejected tries.
                    (-factor.log2()).ceil().clamp(1.0, 20.0) as u32
                }
                Verdict::Miss { error, size, tolerance } => {
                    if depth >= MOST_HALVINGS {
                        let (time, step) = (panel.time(), panel.length());
                        return Err(AdvanceError::Tolerance { time, step, estimate: error / size, tolerance });
                    }
                    if depth == 0 {
                        left = (1.0 - OWN) * tolerance * size;
                    }
                    1
                }
            };
            tally.rejected += 1;
            tally.hold(span.most, panel.time())?;
            if depth + halve > MOST_HALVINGS {
                let asked = panel.length() * (-f64::from(halve)).exp2();
                return Err(AdvanceError::SmallestStep { time: panel.time(), asked, smallest: span.smallest });
            }
            let pieces = 1_u32 << halve;
            let at = |k: u32| from + (to - from) * (f64::from(k) / f64::from(pieces));
            // The first piece in time comes off the stack first.
            open.extend(
                (0..pieces).rev().map(|k| (at(k), if k + 1 == pieces { to } else { at(k + 1) }, depth + halve)),
            );
        }
        Ok(tally)
    }

    /// The one evaluation of an exact rule, added to the wear without a sum of its own; false if the law wants less.
    fn once<R: Rate>(
        self,
        rate: &mut R,
        span: Span,
        room: &mut Room,
        wear: &mut [f64],
        tally: &mut Tally,
    ) -> Result<bool, AdvanceError<R::Error>> {
        room.now.resize(wear.len(), 0.0);
        let reply = rate.increments(Rule::MIDPOINT.nodes[0], span.length, &mut room.now)?;
        if reply != Reply::Good {
            return Ok(false);
        }
        tally.law_calls += 1;
        tally.points_evaluated += wear.len() as u64;
        tally.accept(span.length, 0.0);
        for (total, part) in wear.iter_mut().zip(&room.now) {
            *total += part;
        }
        Ok(true)
    }

    fn try_panel<R: Rate>(
        self,
        rate: &mut R,
        panel: &Panel,
        room: &mut Room,
        tally: &mut Tally,
        share: f64,
    ) -> Result<Verdict, AdvanceError<R::Error>> {
        let mut work = Work { rate, panel, tally, share };
        match self {
            Quadrature::Exact => work.plain(&Rule::MIDPOINT, room),
            Quadrature::Fixed => work.embedded(&Rule::KRONROD_7, room, f64::INFINITY),
            Quadrature::FixedRule(rule) => work.plain(rule, room),
            Quadrature::Adaptive(tolerance) => match work.embedded(&Rule::KRONROD_7, room, tolerance)? {
                Verdict::Miss { .. } => work.embedded(&Rule::KRONROD_15, room, tolerance),
                other => Ok(other),
            },
            Quadrature::AdaptiveRule(rule, tolerance) => work.doubled(rule, room, tolerance),
        }
    }
}

enum Verdict {
    /// The error, and whether it was allowed only as a share of the piece's.
    Good {
        error: f64,
        shared: bool,
    },
    Cut(f64),
    /// Norms of the error and of the increment.
    Miss {
        error: f64,
        size: f64,
        tolerance: f64,
    },
}

impl Verdict {
    /// Good after all, if the error vanishes in the wear so far.
    fn forgiving(self, wear: &[f64]) -> Verdict {
        match self {
            Verdict::Miss { error, .. } if invisible(error, wear) => Verdict::Good { error, shared: false },
            other => other,
        }
    }
}

struct Panel {
    span: Span,
    from: f64,
    to: f64,
}

impl Panel {
    fn length(&self) -> f64 {
        (self.to - self.from) * self.span.length
    }
    fn time(&self) -> f64 {
        self.span.start + self.from * self.span.length
    }
    fn part(&self, from: f64, to: f64) -> Panel {
        let at = |x: f64| self.from + x * (self.to - self.from);
        Panel { span: self.span, from: at(from), to: at(to) }
    }
}

struct Work<'w, R> {
    rate: &'w mut R,
    panel: &'w Panel,
    tally: &'w mut Tally,
    /// Error that this panel may have of the piece's, whatever its own size.
    share: f64,
}

impl<R: Rate> Work<'_, R> {
    /// Sums a rule over `panel` into `high` and, with its own weights, into `low`.
    fn sum(
        &mut self,
        rule: &Rule,
        panel: &Panel,
        now: &mut Vec<f64>,
        high: &mut Vec<f64>,
        mut low: Option<(&mut Vec<f64>, &[f64])>,
    ) -> Result<Reply, R::Error> {
        let points = self.rate.points();
        now.resize(points, 0.0);
        for (node, at) in rule.nodes.iter().enumerate() {
            let fraction = panel.from + at * (panel.to - panel.from);
            self.tally.law_calls += 1;
            self.tally.points_evaluated += points as u64;
            if let Reply::Cut(factor) = self.rate.increments(fraction, panel.length(), now)? {
                return Ok(Reply::Cut(factor));
            }
            add(high, now, rule.weights[node], node == 0);
            if let Some((low, weights)) = low.as_mut() {
                add(low, now, weights[node], node == 0);
            }
        }
        Ok(Reply::Good)
    }

    fn plain(&mut self, rule: &Rule, room: &mut Room) -> Result<Verdict, AdvanceError<R::Error>> {
        let reply = self.sum(rule, self.panel, &mut room.now, &mut room.high, None)?;
        Ok(match reply {
            Reply::Good => Verdict::Good { error: 0.0, shared: false },
            Reply::Cut(factor) => Verdict::Cut(factor),
        })
    }

    fn embedded(&mut self, rule: &Rule, room: &mut Room, tolerance: f64) -> Result<Verdict, AdvanceError<R::Error>> {
        let Room { now, high, low } = room;
        let weights = rule.embedded.unwrap_or(rule.weights);
        if let Reply::Cut(factor) = self.sum(rule, self.panel, now, high, Some((low, weights)))? {
            return Ok(Verdict::Cut(factor));
        }
        Ok(judge(high, low, tolerance, self.share))
    }

    fn doubled(&mut self, rule: &Rule, room: &mut Room, tolerance: f64) -> Result<Verdict, AdvanceError<R::Error>> {
        let Room { now, high, low } = room;
        if let Reply::Cut(factor) = self.sum(rule, self.panel, now, low, None)? {
            return Ok(Verdict::Cut(factor));
        }
        let mut total = vec![0.0; self.rate.points()];
        for (from, to) in [(0.0, 0.5), (0.5, 1.0)] {
            if let Reply::Cut(factor) = self.sum(rule, &self.panel.part(from, to), now, high, None)? {
                return Ok(Verdict::Cut(factor));
            }
            add(&mut total, high, 1.0, false);
        }
        high.copy_from_slice(&total);
        Ok(judge(high, low, tolerance, self.share))
    }
}

fn add(total: &mut Vec<f64>, part: &[f64], weight: f64, first: bool) {
    if first {
        total.clear();
        total.extend(part.iter().map(|x| weight * x));
    } else {
        for (sum, x) in total.iter_mut().zip(part) {
            *sum += weight * x;
        }
    }
}

fn judge(high: &[f64], low: &[f64], tolerance: f64, share: f64) -> Verdict {
    let size = norm(high.iter().copied());
    let difference = norm(high.iter().zip(low).map(|(a, b)| a - b));
    // Sums that differ by rounding alone say nothing about the rule.
    let allowed = (OWN * tolerance).max(ROUNDING) * size;
    // Without a tolerance anything will do, also where nothing wears and infinity times zero is no number.
    if tolerance == f64::INFINITY || difference <= allowed.max(share) {
        Verdict::Good { error: difference, shared: tolerance.is_finite() && difference > allowed }
    } else {
        Verdict::Miss { error: difference, size, tolerance }
    }
}

#[cfg(test)]
mod tests;
