//! Large batches whose increments leave the caches before anyone reads them.
//!
//! The law writes each piece to the same few pages, which stay in the nearest cache; from there the increments go
//! straight to the memory while they are checked. A plain store would have the memory read what it overwrites: 32 bytes
//! a point for two columns and an answer, where 24 do.

use std::ops::Range;
use std::sync::OnceLock;

use wearlaw_plugin_api::abi;

use super::super::batch::{Batch, Outputs};
use super::super::evaluation::{EvaluateError, Evaluation};
use super::super::streaming::{Ahead, InOrder, is_possible as streaming_is_possible, sweep_past_caches};
use super::LawInstance;
use super::float_guard::Guard;

/// Points in a piece: with so few the law is read from and written to the nearest cache, into which what the law reads
/// next is fetched while the increments are stored. On a linear law of two columns 512 is faster than 256 and 1024, by
/// some twentieth to a fifth, and than any without fetching ahead, by a sixth to a third.
const PIECE: usize = 512;

/// Bytes of the last cache where the system does not tell.
const USUAL_CACHE: usize = 32 << 20;

/// Whether the increments of this batch are better written past the caches.
pub(super) fn pays(batch: &Batch<'_>) -> bool {
    batch.points() > PIECE
        && streaming_is_possible()
        && leaves(last_cache(), batch.bytes_moved(), batch.bytes_of_points(), batch.points() * size_of::<f64>())
}

/// Whether so many bytes of a whole batch, and of the call's own part of it, leave a cache before the increments of this
/// call, so many bytes, are read.
///
/// From half the cache on one thread reads them from the memory as fast as it would have kept them. Threads that share a
/// batch keep what the whole cache holds: there two of them are twice as fast as the memory. Increments of less than a
/// thirty-second part are taken to be read at once.
fn leaves(cache: usize, batch: usize, own: usize, increments: usize) -> bool {
    (batch >= cache || own >= cache / 2) && increments >= cache / 32
}

/// Bytes of the last cache.
fn last_cache() -> usize {
    static BYTES: OnceLock<usize> = OnceLock::new();
    *BYTES.get_or_init(|| {
        let size =
            |level: &str| std::fs::read_to_string(format!("/sys/devices/system/cpu/cpu0/cache/index{level}/size")).ok();
        size("3").or_else(|| size("2")).and_then(|text| bytes_of(&text)).unwrap_or(USUAL_CACHE)
    })
}

/// Bytes that a text such as `32768K` means.
fn bytes_of(text: &str) -> Option<usize> {
    let text = text.trim();
    let (number, unit) = match text.strip_suffix(['K', 'M']) {
        Some(number) if text.ends_with('K') => (number, 1 << 10),
        Some(number) => (number, 1 << 20),
        None => (text, 1),
    };
    number.parse::<usize>().ok()?.checked_mul(unit).filter(|bytes| *bytes > 0)
}

/// Where a law writes a piece.
#[repr(align(64))]
struct Scratch([f64; PIECE]);

impl LawInstance {
    /// Evaluates a batch of which the increments alone are wanted, and writes them past the caches.
    pub(super) fn evaluate_streamed(
        &self,
        batch: &Batch<'_>,
        increment: &mut [f64],
        watch: &impl Fn(Range<usize>),
        guard: Guard<'_>,
    ) -> Result<Evaluation, EvaluateError> {
        // What a law leaves unwritten is found out as not a number.
        let mut scratch = Scratch([f64::NAN; PIECE]);
        let mut cursor = batch.cursor(0);
        let mut worst = Evaluation::Good;
        let _in_order = InOrder;
        let mut start = 0;
        while start < batch.points() {
            let piece = start..batch.points().min(start + PIECE);
            start = piece.end;
            watch(piece.clone());
            let answers = &mut scratch.0[..piece.len()];
            let all = 0..piece.len();
            let raw = self.call(cursor.at(&piece), &all, &mut Outputs::new(answers), None, guard);
            let ahead = Ahead::new(cursor.behind());
            if raw.values_are_meant()
                && !self.is_allowed(sweep_past_caches(answers, &mut increment[piece.clone()], &ahead))
            {
                return Err(self.broken(batch, piece, &Outputs::new(increment)));
            }
            if raw.status != abi::WL_OK {
                worst = self.worse(worst, batch, piece, &mut Outputs::new(increment), &raw, guard)?;
            }
        }
        Ok(worst)
    }
}

#[cfg(test)]
mod tests;
