//! Listens to a run: shows its progress, writes its fields and checkpoints, hears Ctrl-C.

use super::console::Console;
use super::interrupt::Interrupt;
use super::progress::{Progress, Stage};
use crate::output::{FieldSeries, Keeper, OutputError};
use crate::record::{Event, Geometry, HistoryRow, Observer, Wish};

/// What `run` hears while the solver works.
pub(super) struct Listener<'a> {
    pub(super) console: &'a Console,
    pub(super) interrupt: &'a Interrupt,
    pub(super) progress: Progress,
    pub(super) fields: Option<FieldSeries>,
    pub(super) keeper: Keeper,
    pub(super) geometry: Geometry<'static>,
    /// The first file that could not be written; it ends the run.
    pub(super) trouble: Option<OutputError>,
}

fn stage(row: &HistoryRow, step: u64, fraction: f64) -> Stage {
    Stage { fraction, time: row.time, step, contact_area: row.contact_area, max_wear_depth: row.max_wear_depth }
}

/// Listens to the refined run that a record is compared with: writes nothing, and warns of nothing again.
pub(super) struct Comparison<'a> {
    pub(super) interrupt: &'a Interrupt,
    pub(super) progress: Progress,
}

impl Observer for Comparison<'_> {
    fn observe(&mut self, event: Event<'_>) -> Wish {
        match event {
            Event::Step { row, steps, done } => self.progress.show_reference(&stage(row, steps, done)),
            Event::Trial { time, done } => self.progress.try_at(time, done),
            _ => {}
        }
        if self.interrupt.asked() { Wish::Stop } else { Wish::GoOn }
    }
}

impl Observer for Listener<'_> {
    fn observe(&mut self, event: Event<'_>) -> Wish {
        match event {
            Event::Step { row, steps, done } => self.progress.show(&stage(row, steps, done)),
            Event::Trial { time, done } => self.progress.try_at(time, done),
            Event::Warning(text) => self.console.note(&format!("warning: {text}")),
            Event::Snapshot(snapshot) => {
                if let Some(series) = &mut self.fields
                    && let Err(error) = series.write(snapshot, &self.geometry)
                {
                    self.trouble.get_or_insert(error);
                }
            }
            Event::Checkpoint { checkpoint, last } => {
                if let Err(error) = self.keeper.write(checkpoint, self.fields.as_ref(), last) {
                    self.trouble.get_or_insert(error);
                }
            }
        }
        if self.interrupt.asked() || self.trouble.is_some() { Wish::Stop } else { Wish::GoOn }
    }

    fn wants_checkpoint(&mut self, last: bool) -> bool {
        self.trouble.is_none() && self.keeper.is_due(last)
    }
}
