//! The only loop over the time of a prescribed run: rounds of the loading, load steps, pieces.

use super::place::Place;
use super::{Going, Prescribed};
use crate::plan::Advance;
use crate::record::{self, End, Event, HistoryRow, Observer, Wish};
use crate::scene::Every;
use crate::solve::ending::stop_reached;
use crate::solve::inputs::Drive;
use crate::solve::progress::Arrays;
use crate::solve::schedule::{self, Piece, Schedule};
use crate::solve::sums::Sums;
use crate::solve::{SolveError, claims, fields};

impl<'p> Prescribed<'p> {
    pub(super) fn steps(
        &self,
        going: &mut Going,
        observer: &mut (dyn Observer + Send),
        profiled: bool,
    ) -> End<SolveError> {
        let schedule = match Schedule::new(self.plan, self.history.as_ref()) {
            Ok(schedule) => schedule,
            Err(error) => return End::Failed(error),
        };
        let mut last = None;
        let end = self.rounds(going, observer, schedule, &mut last, profiled);
        if going.place.is_some() {
            self.offer(going, observer, true);
        }
        self.finish(going, last.as_ref(), observer, &fields::units(self.plan), profiled);
        end.unwrap_or(End::Done)
    }

    /// Goes through the loading round by round, because a scene may have more cycles than a list of them has room for;
    /// `None`: to its end. `last` is the last piece that was gone through.
    fn rounds(
        &self,
        going: &mut Going,
        observer: &mut (dyn Observer + Send),
        schedule: Schedule<'p>,
        last: &mut Option<Piece<'p>>,
        profiled: bool,
    ) -> Option<End<SolveError>> {
        let mut from = going.place;
        let mut round = from.map_or(schedule.start(), |place| place.round);
        loop {
            let steps = schedule.steps(&round);
            let first = from.map_or(0, |place| place.step);
            for (index, placed) in steps.iter().enumerate().skip(first) {
                let mut pieces = self.pieces(*placed);
                let mut place = Place { step: index, time: placed.start, end: placed.end, ..Place::at(round) };
                if let Some(earlier) = from.take() {
                    let (done, left) = earlier.left(placed, pieces);
                    (*last, pieces) = (done, left);
                    place.pieces = earlier.pieces;
                    place.time = earlier.time;
                    if earlier.pieces > 0 {
                        // Another end than the step's own says for good that its pieces do not count any more.
                        place.end = earlier.end;
                    }
                    // A run that was stopped has reached its limit already, unless the limit is another now.
                    let stop = going.history.last().and_then(|row| stop_reached(&self.plan.stop, row));
                    if let Some(reason) = stop.filter(|_| going.steps > 0) {
                        return Some(End::Stopped(reason));
                    }
                }
                going.place = Some(place);
                for piece in pieces {
                    going.arrays.remember();
                    if let Err(end) = self.piece(going, observer, &piece, profiled) {
                        if !going.arrays.go_back() {
                            // Some points are behind the piece and some before it: nothing to go on from.
                            going.place = None;
                        }
                        return Some(end);
                    }
                    place.pieces += 1;
                    place.time = piece.end;
                    going.place = Some(place);
                    *last = Some(piece);
                    let stop = going.history.last().and_then(|row| stop_reached(&self.plan.stop, row));
                    if going.wish == Wish::Stop || stop.is_some() {
                        return Some(stop.map_or(End::Interrupted, End::Stopped));
                    }
                    self.offer(going, observer, false);
                }
            }
            round = schedule.next(&round, &steps)?;
        }
    }

    /// Goes through one piece and tells of it.
    fn piece(
        &self,
        going: &mut Going,
        observer: &mut (dyn Observer + Send),
        piece: &Piece<'p>,
        profiled: bool,
    ) -> Result<(), End<SolveError>> {
        let (start, end) = schedule::span(self.plan, self.history.as_ref());
        let site = self.site(piece);
        let drive = Drive::new(self.plan, self.history.as_ref(), piece);
        if going.history.rows.is_empty() {
            let sums = going.arrays.measure(&site, &drive, 0.0);
            going.history.rows.push(self.row(piece, 0.0, &sums, &going.arrays));
            if profiled {
                going.start_pressure = fields::pressure(&site, &drive, 0.0, self.points);
            }
        }
        let tried = match self.plan.advance {
            Advance::Rate(_) if going.steps == 0 => {
                claims::linear_in_dt(&site, &drive, self.evaluator, self.points, &mut going.tally)
            }
            _ => Ok(()),
        };
        let done = tried.and_then(|()| going.arrays.advance(&site, &drive, self.evaluator)).map_err(|source| {
            let (load_step, substep, time) = (piece.placed.number, piece.substep, piece.start);
            End::Failed(SolveError::Advance { load_step, substep, time, source: Box::new(source) })
        })?;
        going.tally.then(&done.tally);
        going.law_time += done.law_time;
        going.steps += 1;
        for warning in done.warnings {
            if !going.warnings.contains(&warning) {
                observer.observe(Event::Warning(&warning));
                going.warnings.push(warning);
            }
        }
        let row = self.row(piece, piece.end - piece.start, &done.sums, &going.arrays);
        let part = if end > start { (piece.end - start) / (end - start) } else { 1.0 };
        going.wish = observer.observe(Event::Step { row: &row, steps: going.steps, done: part });
        going.history.rows.push(row);
        if self.wants_snapshot(piece, going.steps) {
            let snapshot = fields::snapshot(&site, &drive, &going.arrays, going.steps, &fields::units(self.plan));
            observer.observe(Event::Snapshot(&snapshot));
        }
        Ok(())
    }

    /// What is left to tell when a run ends, for whatever reason: the fields and the pressure at its last step.
    fn finish(
        &self,
        going: &mut Going,
        last: Option<&Piece<'_>>,
        observer: &mut (dyn Observer + Send),
        units: &record::Units,
        profiled: bool,
    ) {
        let Some(piece) = last else { return };
        let site = self.site(piece);
        let drive = Drive::new(self.plan, self.history.as_ref(), piece);
        if profiled {
            going.end_pressure = fields::pressure(&site, &drive, 1.0, self.points);
        }
        if !self.plan.output.fields.is_empty() && !self.wants_snapshot(piece, going.steps) {
            let snapshot = fields::snapshot(&site, &drive, &going.arrays, going.steps, units);
            observer.observe(Event::Snapshot(&snapshot));
        }
    }

    fn wants_snapshot(&self, piece: &Piece<'_>, steps: u64) -> bool {
        let asked = match &self.plan.output.every {
            Every::End => false,
            Every::Steps(every) => steps.is_multiple_of(*every),
            Every::Times(_) => piece.output,
        };
        asked && !self.plan.output.fields.is_empty()
    }

    /// The row at the end of a piece, or (`dt` = 0) at its start.
    fn row(&self, piece: &Piece<'_>, dt: f64, sums: &Sums, arrays: &Arrays) -> HistoryRow {
        let areas = self.plan.columns.has(crate::contact::prescribed::Column::Area);
        let time = if dt > 0.0 { piece.end } else { piece.start };
        HistoryRow {
            time,
            dt,
            sliding_distance: if self.distances { sums.max_distance } else { arrays.uniform_distance },
            load: areas.then_some(sums.load),
            approach: None,
            max_pressure: sums.max_pressure,
            contact_area: areas.then_some(sums.area),
            max_wear_depth: sums.max_wear,
            wear_volume: areas.then_some(sums.volume),
            scale: piece.placed.scale,
            simulated_time: piece.placed.simulated_at(time),
            cycle: piece.placed.cycles_at(time),
        }
    }
}
