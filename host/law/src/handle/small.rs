//! A small batch of which the increments alone are wanted, called as it stands.
//!
//! What surrounds such a call takes longer than the law, so nothing is copied and nothing said here: whatever is not
//! plainly good is left to the general way, which asks the law once more.
#![allow(unsafe_code)] // reason: hands raw arrays to a law.

use std::ops::Range;
use std::sync::atomic::Ordering;

use wearlaw_plugin_api::abi;

use super::super::batch::{Batch, Outputs};
use super::super::checks::sweep;
use super::super::evaluation::Evaluator;
use super::super::float_env::FloatEnvChange;
use super::{LawInstance, PIECE};

/// What became of a batch.
pub(super) enum Small {
    /// The increments are good.
    Good,
    /// It is not for this way, or there is something to say of it.
    Open,
    /// The floating-point environment has changed, from what was read before the call or (true) behind an earlier one.
    Changed(FloatEnvChange, bool),
}

impl LawInstance {
    #[inline(always)]
    pub(super) fn evaluate_small(
        &self,
        batch: &Batch<'_>,
        outputs: &mut Outputs<'_>,
        watch: &impl Fn(Range<usize>),
    ) -> Small {
        let Some(view) = self.small_view(batch, outputs) else { return Small::Open };
        watch(0..batch.points());
        let null = std::ptr::null_mut();
        let mut output = abi::Output {
            struct_size: size_of::<abi::Output>() as i64,
            increment: outputs.increment.as_mut_ptr(),
            direction: null,
            state: null,
            status: std::ptr::null_mut(),
            first_bad: -1,
            dt_factor: 0.0,
            missing: 0,
            text: std::ptr::null_mut(),
            text_size: 0,
            d_pressure: null,
        };
        let before = self.floats_before();
        // SAFETY: `Batch` checked that every column reaches over its points, and `small_view` that the increments do; they
        // are borrowed as exclusive, so they overlap nothing.
        let status = unsafe { self.created.evaluate(view, &mut output) };
        if let Some(change) = self.floats_after(before) {
            return Small::Changed(change, before.is_assumed);
        }
        if status == abi::WL_OK && self.is_allowed(sweep(outputs.increment)) { Small::Good } else { Small::Open }
    }

    /// The ABI's view of a batch that is for this way.
    #[inline(always)]
    fn small_view<'b>(&self, batch: &'b Batch<'_>, outputs: &Outputs<'_>) -> Option<&'b abi::View> {
        let law = self.descriptor();
        let alone = outputs.direction.is_none()
            && outputs.state.is_none()
            && outputs.status.is_none()
            && outputs.d_pressure.is_none();
        let points = batch.points();
        let is_small = (1..=PIECE).contains(&points) && outputs.increment.len() == points;
        let is_mine = std::ptr::eq(batch.descriptor(), law) && law.state.is_empty() && self.turn.is_none();
        if alone && is_small && is_mine && !self.changes_floats.load(Ordering::Relaxed) {
            batch.whole_view()
        } else {
            None
        }
    }
}
