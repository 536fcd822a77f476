//! The claim that a run rests on, tried before it does: a law that is integrated as a rate must be linear in dt.

use crate::integrator::{AdvanceError, Tally};
use crate::law::{Evaluator, OutputItem, Outputs};
use crate::solve::PointError;
use crate::solve::inputs::Drive;
use crate::solve::site::{Moment, Remembered, Rooms, Site};
use crate::solve::source::value;

/// Points at which the claim is tried.
const TRIED: usize = 256;
/// Relative difference that rounding inside a law may make.
const ROUNDING: f64 = 1e-6;

/// Evaluates the first points in contact for the length of a piece and for half of it.
///
/// A law that fails here fails in the same way a moment later, in its place: only the claim is judged.
pub(super) fn linear_in_dt(
    site: &Site<'_>,
    drive: &Drive<'_>,
    evaluator: &dyn Evaluator,
    points: usize,
    tally: &mut Tally,
) -> Result<(), AdvanceError<PointError>> {
    let length = site.piece.end - site.piece.start;
    let mut rooms = Rooms::default();
    let mut increments = |dt: f64, tally: &mut Tally| {
        let moment = Moment { at: 0.5, from: 0.5, dt };
        let range = 0..points.min(TRIED);
        drive.with_batch(site, &moment, range.clone(), Remembered::default(), &mut rooms, |batch, pressure, _| {
            let first = range.clone().position(|i| value(pressure, i) > 0.0).unwrap_or(range.len());
            let closed = range.clone().skip(first).take_while(|i| value(pressure, *i) > 0.0).count();
            let mut increment = vec![0.0; closed];
            let mut direction = vec![0.0; 3 * closed];
            let mut outputs = Outputs::new(&mut increment);
            outputs.direction = site.law.writes(OutputItem::Direction).then_some(&mut direction[..]);
            let answer = match closed {
                0 => None,
                _ => Some(evaluator.evaluate(&batch.range(first..first + closed), &mut outputs)),
            };
            tally.law_calls += u64::from(closed > 0);
            tally.points_evaluated += closed as u64;
            let good = matches!(answer, Some(Ok(crate::law::Evaluation::Good)));
            Ok::<_, PointError>(good.then_some((first, increment)))
        })
    };
    let (Some((first, whole)), Some((_, half))) = (increments(length, tally)?, increments(0.5 * length, tally)?) else {
        return Ok(());
    };
    match whole.iter().zip(&half).position(|(whole, half)| (2.0 * half - whole).abs() > ROUNDING * whole.abs()) {
        None => Ok(()),
        Some(k) => Err(AdvanceError::Evaluate(PointError::NotLinear {
            law: site.law.name.clone(),
            point: site.id(first + k),
            dt: length,
            whole: whole[k],
            half: half[k],
        })),
    }
}
