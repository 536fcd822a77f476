//! An instance of a law in this process: calls it piece by piece and checks what it answers.
#![allow(unsafe_code)] // reason: hands raw arrays to a law.

use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use wearlaw_plugin_api::abi;

use super::batch::{Batch, Outputs};
use super::checks::{Sweep, no_nan, sweep, unit_lengths};
use super::descriptor::LawDescriptor;
use super::evaluation::{EvaluateError, Evaluation, Evaluator};
use super::fields::{Claim, OutputItem};
use super::table::Created;

mod diagnosis;
mod float_guard;
mod small;
mod streamed;

use float_guard::Guard;
use small::Small;

/// Points in a piece: its columns and outputs stay in the second-level cache between the law and the checks. Of 256, 512,
/// .. 8192 this was the fastest for a linear law of two columns, whose every call takes as long as 50 of its points.
pub const PIECE: usize = 8192;

/// A law that has been created; dropping it destroys the instance, then lets go of the library.
pub struct LawInstance {
    created: Created,
    turn: Option<Mutex<()>>,
    /// Of all instances that this program ever made, which one.
    number: u64,
    /// Whether it has been found to change the floating-point environment.
    changes_floats: AtomicBool,
    warnings: Mutex<Vec<String>>,
}

impl std::fmt::Debug for LawInstance {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("LawInstance").field("name", &self.descriptor().name).finish_non_exhaustive()
    }
}

/// What one raw call came to.
struct Raw {
    status: i32,
    first_bad: i64,
    dt_factor: f64,
    missing: i64,
}

impl Raw {
    fn values_are_meant(&self) -> bool {
        (abi::WL_OK..=abi::WL_UNRELIABLE).contains(&self.status)
    }
}

/// What a law is asked for when it is asked again.
struct Again {
    /// A status for each point, unless the caller has given an array of its own.
    statuses: Option<Vec<i32>>,
    words: Vec<std::ffi::c_char>,
}

impl LawInstance {
    pub(super) fn new(created: Created, warnings: Vec<String>) -> Self {
        let turn = created.law.descriptor.is_serial().then(Mutex::default);
        Self {
            created,
            turn,
            number: float_guard::next_number(),
            changes_floats: AtomicBool::new(false),
            warnings: Mutex::new(warnings),
        }
    }

    /// As [`Evaluator::evaluate`]; `watch` is told of every piece before the law sees it.
    ///
    /// # Errors
    /// As [`Evaluator::evaluate`].
    #[inline]
    pub(super) fn evaluate_watched(
        &self,
        batch: &Batch<'_>,
        outputs: &mut Outputs<'_>,
        watch: impl Fn(Range<usize>),
    ) -> Result<Evaluation, EvaluateError> {
        match self.evaluate_small(batch, outputs, &watch) {
            Small::Good => Ok(Evaluation::Good),
            other => self.evaluate_any(batch, outputs, &watch, other),
        }
    }

    /// Evaluates any batch; `small` is what became of it as a small one.
    #[inline(never)]
    fn evaluate_any(
        &self,
        batch: &Batch<'_>,
        outputs: &mut Outputs<'_>,
        watch: &impl Fn(Range<usize>),
        small: Small,
    ) -> Result<Evaluation, EvaluateError> {
        fits(self.descriptor(), batch, outputs)?;
        let _turn = self.turn.as_ref().map(|turn| turn.lock().unwrap_or_else(PoisonError::into_inner));
        let pieces = |guard: Guard<'_>| self.evaluate_pieces(batch, outputs, watch, guard);
        match small {
            Small::Changed(change, is_assumed) => self.again(change, is_assumed, pieces),
            _ => self.guarded(pieces),
        }
    }

    fn evaluate_pieces(
        &self,
        batch: &Batch<'_>,
        outputs: &mut Outputs<'_>,
        watch: &impl Fn(Range<usize>),
        guard: Guard<'_>,
    ) -> Result<Evaluation, EvaluateError> {
        let request = request(self.descriptor(), outputs);
        if request == 0 && streamed::pays(batch) {
            return self.evaluate_streamed(batch, outputs.increment, watch, guard);
        }
        let mut cursor = batch.cursor(request);
        let mut worst = Evaluation::Good;
        let mut start = 0;
        while start < batch.points() {
            let piece = start..batch.points().min(start + PIECE);
            start = piece.end;
            watch(piece.clone());
            let raw = self.call(cursor.at(&piece), &piece, outputs, None, guard);
            if raw.values_are_meant() {
                self.check(batch, piece.clone(), outputs)?;
            }
            if raw.status != abi::WL_OK {
                worst = self.worse(worst, batch, piece, outputs, &raw, guard)?;
            }
        }
        Ok(worst)
    }

    /// What a call comes to when a piece of it did not end well.
    #[cold]
    fn worse(
        &self,
        worst: Evaluation,
        batch: &Batch<'_>,
        piece: Range<usize>,
        outputs: &mut Outputs<'_>,
        raw: &Raw,
        guard: Guard<'_>,
    ) -> Result<Evaluation, EvaluateError> {
        // The first warning of a call is told in full; to ask the law again for each piece would cost as much.
        if raw.status == abi::WL_UNRELIABLE && worst != Evaluation::Good {
            return Ok(worst);
        }
        Ok(worst.worse(self.diagnose(batch, piece, outputs, raw, guard)?))
    }

    /// One call of the law on `piece`, which is what `view` shows.
    #[inline]
    fn call(
        &self,
        view: &abi::View,
        piece: &Range<usize>,
        outputs: &mut Outputs<'_>,
        again: Option<&mut Again>,
        guard: Guard<'_>,
    ) -> Raw {
        let variables = self.descriptor().state.len();
        let null = std::ptr::null_mut();
        let mut output = abi::Output {
            struct_size: size_of::<abi::Output>() as i64,
            increment: outputs.increment[piece.clone()].as_mut_ptr(),
            direction: at(&mut outputs.direction, piece, 3),
            state: if variables == 0 { null } else { at(&mut outputs.state, piece, variables) },
            status: at(&mut outputs.status, piece, 1),
            first_bad: -1,
            dt_factor: 0.0,
            missing: 0,
            text: std::ptr::null_mut(),
            text_size: 0,
            d_pressure: at(&mut outputs.d_pressure, piece, 1),
        };
        if let Some(again) = again {
            output.text = again.words.as_mut_ptr();
            output.text_size = again.words.len() as i64;
            if let Some(statuses) = &mut again.statuses {
                output.status = statuses.as_mut_ptr();
            }
        }
        // SAFETY: `Batch` checked that every column reaches over its points, `fits` that every output does (or the caller
        // that made one of its own), and `Again` has a status for each; outputs are borrowed as exclusive, so they
        // overlap nothing.
        let status = guard.around(self, || unsafe { self.created.evaluate(view, &mut output) });
        Raw { status, first_bad: output.first_bad, dt_factor: output.dt_factor, missing: output.missing }
    }

    /// Checks the answers of one piece, while they are in cache.
    #[inline]
    fn check(&self, batch: &Batch<'_>, piece: Range<usize>, outputs: &Outputs<'_>) -> Result<(), EvaluateError> {
        let law = self.descriptor();
        let mut good = self.is_allowed(sweep(&outputs.increment[piece.clone()]));
        if let Some(direction) = &outputs.direction {
            good &= unit_lengths(&direction[3 * piece.start..3 * piece.end]);
        }
        if let Some(state) = &outputs.state {
            let variables = law.state.len();
            good &= sweep(&state[variables * piece.start..variables * piece.end]).finite;
        }
        if let Some(d_pressure) = &outputs.d_pressure {
            good &= no_nan(&d_pressure[piece.clone()]);
        }
        if good { Ok(()) } else { Err(self.broken(batch, piece, outputs)) }
    }

    /// Whether increments with these properties keep the contract.
    #[inline]
    fn is_allowed(&self, found: Sweep) -> bool {
        found.finite && (found.non_negative || !self.descriptor().claims(Claim::NonNegative))
    }
}

impl Evaluator for LawInstance {
    fn descriptor(&self) -> &LawDescriptor {
        &self.created.law.descriptor
    }

    fn evaluate(&self, batch: &Batch<'_>, outputs: &mut Outputs<'_>) -> Result<Evaluation, EvaluateError> {
        self.evaluate_watched(batch, outputs, |_| {})
    }

    fn take_warnings(&self) -> Vec<String> {
        std::mem::take(&mut self.warnings.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// The output bits that a call asks for.
fn request(law: &LawDescriptor, outputs: &Outputs<'_>) -> i64 {
    bit(outputs.direction.is_some(), abi::WL_OUT_DIRECTION)
        | bit(!law.state.is_empty() && outputs.state.is_some(), abi::WL_OUT_STATE)
        | bit(outputs.status.is_some(), abi::WL_OUT_STATUS)
        | bit(outputs.d_pressure.is_some(), abi::WL_OUT_D_PRESSURE)
}

fn bit(set: bool, bit: i64) -> i64 {
    if set { bit } else { 0 }
}

fn at<T>(array: &mut Option<&mut [T]>, piece: &Range<usize>, width: usize) -> *mut T {
    match array {
        Some(array) => array[width * piece.start..width * piece.end].as_mut_ptr(),
        None => std::ptr::null_mut(),
    }
}

/// Checks that batch and outputs are made for this law and for each other.
pub(super) fn fits(law: &LawDescriptor, batch: &Batch<'_>, outputs: &Outputs<'_>) -> Result<(), EvaluateError> {
    if !std::ptr::eq(batch.descriptor(), law) && batch.descriptor() != law {
        return Err(EvaluateError::OtherLaw { law: law.name.clone(), found: batch.descriptor().name.clone() });
    }
    let points = batch.points();
    let variables = law.state.len();
    let length = |output: &str, found: usize, expected: usize| {
        if found == expected {
            return Ok(());
        }
        Err(EvaluateError::OutputLength { law: law.name.clone(), output: output.to_owned(), found, expected })
    };
    let written = |item: OutputItem| {
        if law.writes(item) {
            return Ok(());
        }
        Err(EvaluateError::NotWritten { law: law.name.clone(), output: item.name().to_owned() })
    };
    length("increment", outputs.increment.len(), points)?;
    if let Some(direction) = &outputs.direction {
        written(OutputItem::Direction)?;
        length("direction", direction.len(), 3 * points)?;
    }
    match &outputs.state {
        Some(state) => length("state", state.len(), variables * points)?,
        None if variables > 0 => length("state", 0, variables * points)?,
        None => {}
    }
    if let Some(status) = &outputs.status {
        written(OutputItem::Status)?;
        length("status", status.len(), points)?;
    }
    if let Some(d_pressure) = &outputs.d_pressure {
        written(OutputItem::DPressure)?;
        length("d_pressure", d_pressure.len(), points)?;
    }
    Ok(())
}
