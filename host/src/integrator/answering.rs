//! One step of wear that changes the contact it comes from: the formulas of the integrators.

use super::Reply;

/// Wear rates of a contact that answers back.
///
/// `at` is simulated time; wear and rates are arrays over the cells, rates in length per represented time.
pub trait Answering {
    /// What a stage fails with.
    type Error;

    /// The rate at a time on a surface worn by `wear`: one contact solve.
    ///
    /// # Errors
    /// Contact that cannot be solved, or a law that fails.
    fn explicit(&mut self, at: f64, wear: &[f64], rate: &mut [f64]) -> Result<Reply, Self::Error>;

    /// The rate at a time on the surface that it leads to: `base + weight * rate`, `weight` in represented time.
    ///
    /// # Errors
    /// Contact that cannot be solved, or a law that fails.
    fn implicit(&mut self, at: f64, weight: f64, base: &[f64], rate: &mut [f64]) -> Result<Reply, Self::Error>;
}

/// The formulas by which a step is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formula {
    /// Forward Euler.
    ExplicitEuler,
    /// Backward Euler.
    ImplicitEuler,
    /// TR-BDF2 in its DIRK form with gamma = 2 - sqrt 2 (Hosea and Shampine, Appl. Numer. Math. 20, 1996).
    TrBdf2,
    /// Two-stage SDIRK of order 2 with gamma = 1 - 1/sqrt 2 (Alexander, SIAM J. Numer. Anal. 14, 1977).
    Sdirk2,
}

impl Formula {
    /// Its name in scenes and reports.
    pub fn name(self) -> &'static str {
        match self {
            Formula::ExplicitEuler => "explicit-euler",
            Formula::ImplicitEuler => "implicit-euler",
            Formula::TrBdf2 => "tr-bdf2",
            Formula::Sdirk2 => "sdirk2",
        }
    }

    /// Order of convergence where the solution is smooth.
    pub fn order(self) -> u32 {
        match self {
            Formula::ExplicitEuler | Formula::ImplicitEuler => 1,
            Formula::TrBdf2 | Formula::Sdirk2 => 2,
        }
    }
}

/// A step in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Simulated time at its start.
    pub start: f64,
    /// Its length; simulated time.
    pub length: f64,
    /// Represented time per simulated time.
    pub scale: f64,
}

/// What a step came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tried {
    /// It was taken.
    Taken,
    /// The law wants a step shorter by this factor.
    Cut(f64),
}

/// Rates of the stages `[cells]` each, kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Stages {
    /// Rate at the start of the step.
    pub start: Vec<f64>,
    /// Rate at the end of the step.
    pub end: Vec<f64>,
    middle: Vec<f64>,
    base: Vec<f64>,
}

/// Solves a stage, or ends the step with the law's wish for a shorter one.
macro_rules! stage {
    ($reply:expr) => {
        match $reply? {
            Reply::Good => {}
            Reply::Cut(factor) => return Ok(Tried::Cut(factor)),
        }
    };
}

impl Stages {
    /// Room for `cells` cells.
    pub fn new(cells: usize) -> Stages {
        Stages { start: vec![0.0; cells], end: vec![0.0; cells], middle: Vec::new(), base: vec![0.0; cells] }
    }

    /// Bytes that a formula needs for this many cells.
    pub fn bytes(formula: Formula, cells: usize) -> usize {
        let arrays = if formula == Formula::TrBdf2 || formula == Formula::Sdirk2 { 4 } else { 3 };
        8 * cells * arrays
    }

    /// Takes one step from `wear`, whose rate is `self.start`; the wear at its end goes to `end`, its rate to `self.end`.
    ///
    /// # Errors
    /// As the stages.
    pub fn step<C: Answering>(
        &mut self,
        contact: &mut C,
        formula: Formula,
        span: Span,
        wear: &[f64],
        end: &mut [f64],
    ) -> Result<Tried, C::Error> {
        match formula {
            Formula::ExplicitEuler => self.explicit_euler(contact, span, wear, end),
            Formula::ImplicitEuler => self.implicit_euler(contact, span, wear, end),
            Formula::TrBdf2 => self.tr_bdf2(contact, span, wear, end),
            Formula::Sdirk2 => self.sdirk2(contact, span, wear, end),
        }
    }

    /// w1 = w0 + h k0.
    fn explicit_euler<C: Answering>(
        &mut self,
        contact: &mut C,
        span: Span,
        wear: &[f64],
        end: &mut [f64],
    ) -> Result<Tried, C::Error> {
        let h = span.length * span.scale;
        add(end, wear, &[(h, &self.start)]);
        stage!(contact.explicit(span.start + span.length, end, &mut self.end));
        Ok(Tried::Taken)
    }

    /// w1 = w0 + h k1.
    fn implicit_euler<C: Answering>(
        &mut self,
        contact: &mut C,
        span: Span,
        wear: &[f64],
        end: &mut [f64],
    ) -> Result<Tried, C::Error> {
        let h = span.length * span.scale;
        stage!(contact.implicit(span.start + span.length, h, wear, &mut self.end));
        add(end, wear, &[(h, &self.end)]);
        Ok(Tried::Taken)
    }

    /// Stages at 0, gamma and 1; d = gamma / 2, w = sqrt 2 / 4: w1 = w0 + h (w k0 + w k1 + d k2), all weights positive.
    fn tr_bdf2<C: Answering>(
        &mut self,
        contact: &mut C,
        span: Span,
        wear: &[f64],
        end: &mut [f64],
    ) -> Result<Tried, C::Error> {
        let gamma = 2.0 - std::f64::consts::SQRT_2;
        let (d, w) = (0.5 * gamma, 0.5 * std::f64::consts::FRAC_1_SQRT_2);
        let h = span.length * span.scale;
        self.middle.resize(wear.len(), 0.0);
        add(&mut self.base, wear, &[(d * h, &self.start)]);
        stage!(contact.implicit(span.start + gamma * span.length, d * h, &self.base, &mut self.middle));
        add(&mut self.base, wear, &[(w * h, &self.start), (w * h, &self.middle)]);
        stage!(contact.implicit(span.start + span.length, d * h, &self.base, &mut self.end));
        add(end, &self.base, &[(d * h, &self.end)]);
        Ok(Tried::Taken)
    }

    /// Stages at gamma and 1: w1 = w0 + h ((1 - gamma) k1 + gamma k2).
    fn sdirk2<C: Answering>(
        &mut self,
        contact: &mut C,
        span: Span,
        wear: &[f64],
        end: &mut [f64],
    ) -> Result<Tried, C::Error> {
        let gamma = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
        let h = span.length * span.scale;
        self.middle.resize(wear.len(), 0.0);
        stage!(contact.implicit(span.start + gamma * span.length, gamma * h, wear, &mut self.middle));
        add(&mut self.base, wear, &[((1.0 - gamma) * h, &self.middle)]);
        stage!(contact.implicit(span.start + span.length, gamma * h, &self.base, &mut self.end));
        add(end, &self.base, &[(gamma * h, &self.end)]);
        Ok(Tried::Taken)
    }
}

/// `out = from + sum of weight * rate`.
fn add(out: &mut [f64], from: &[f64], terms: &[(f64, &Vec<f64>)]) {
    match terms {
        [(h, rate)] => {
            for ((out, from), rate) in out.iter_mut().zip(from).zip(rate.iter()) {
                *out = from + h * rate;
            }
        }
        _ => {
            out.copy_from_slice(from);
            for (h, rate) in terms {
                for (out, rate) in out.iter_mut().zip(rate.iter()) {
                    *out += h * rate;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
