//! What became of a call that did not end well: the point, its inputs and the law's own words.

use std::ffi::c_char;
use std::ops::Range;

use wearlaw_plugin_api::abi;

use super::super::batch::{Batch, Outputs};
use super::super::checks::{LENGTH_TOLERANCE, no_nan, unit_lengths};
use super::super::evaluation::{EvaluateError, Evaluation, Evaluator, NumberText, PointInputs};
use super::super::fields::{Claim, Fields, OutputItem};
use super::super::table::TEXT_SIZE;
use super::{Again, Guard, LawInstance, Raw, bit, request};

impl LawInstance {
    /// Asks the law again, for the status of every point and for its words, and says what the call comes to.
    #[cold]
    pub(super) fn diagnose(
        &self,
        batch: &Batch<'_>,
        piece: Range<usize>,
        outputs: &mut Outputs<'_>,
        raw: &Raw,
        guard: Guard<'_>,
    ) -> Result<Evaluation, EvaluateError> {
        let asks = self.descriptor().writes(OutputItem::Status) && outputs.status.is_none();
        let statuses = asks.then(|| vec![abi::WL_OK; piece.len()]);
        let mut again = Again { statuses, words: vec![0; TEXT_SIZE] };
        let wanted = request(self.descriptor(), outputs) | bit(asks, abi::WL_OUT_STATUS);
        let view = batch.range(piece.clone());
        let second = self.call(view.cursor(wanted).at(&(0..piece.len())), &piece, outputs, Some(&mut again), guard);
        let statuses = match (&again.statuses, &outputs.status) {
            (Some(statuses), _) => statuses.as_slice(),
            (None, Some(given)) => &given[piece.clone()],
            (None, None) => &[],
        };
        let text = text_of(&again.words);
        let point = first_bad(statuses, raw.status)
            .or_else(|| named(raw.first_bad, piece.len()))
            .or_else(|| named(second.first_bad, piece.len()))
            .or_else(|| self.search(batch, piece.clone(), outputs, raw.status, guard));
        let at = point.map(|point| batch.inputs_at(piece.start + point));
        self.verdict(raw, at, text)
    }

    /// Finds the point by asking for one point at a time: a law is pure, so each answers as it did in the batch.
    fn search(
        &self,
        batch: &Batch<'_>,
        piece: Range<usize>,
        outputs: &mut Outputs<'_>,
        status: i32,
        guard: Guard<'_>,
    ) -> Option<usize> {
        let mut cursor = batch.cursor(request(self.descriptor(), outputs));
        let found = piece.clone().find(|point| {
            let one = *point..point + 1;
            severity(self.call(cursor.at(&one), &one, outputs, None, guard).status) >= severity(status)
        })?;
        Some(found - piece.start)
    }

    fn verdict(&self, raw: &Raw, at: Option<PointInputs>, text: String) -> Result<Evaluation, EvaluateError> {
        let law = self.descriptor().name.clone();
        match raw.status {
            abi::WL_UNRELIABLE => Ok(Evaluation::Unreliable { at, text }),
            abi::WL_CUT_STEP if raw.dt_factor > 0.0 && raw.dt_factor < 1.0 => {
                Ok(Evaluation::CutStep { factor: raw.dt_factor, at, text })
            }
            abi::WL_CUT_STEP => Err(EvaluateError::BadFactor { law, factor: NumberText(raw.dt_factor), at, text }),
            abi::WL_OUT_OF_DOMAIN => Err(EvaluateError::OutOfDomain { law, at, text }),
            abi::WL_MISSING_INPUT => Err(EvaluateError::MissingInput {
                law,
                fields: Fields::from_bits(raw.missing & abi::WL_FIELDS_KNOWN),
                unknown: raw.missing & !abi::WL_FIELDS_KNOWN,
                at,
                text,
            }),
            abi::WL_FAILED => Err(EvaluateError::Failed { law, at, text }),
            status => Err(EvaluateError::UnknownStatus { law, status, at, text }),
        }
    }

    /// Finds the first number of a piece that breaks the contract.
    #[cold]
    pub(super) fn broken(&self, batch: &Batch<'_>, piece: Range<usize>, outputs: &Outputs<'_>) -> EvaluateError {
        let descriptor = self.descriptor();
        let law = descriptor.name.clone();
        let variables = descriptor.state.len();
        let not_finite = |output: &str, value: f64, point: usize| EvaluateError::NotFinite {
            law: law.clone(),
            output: output.to_owned(),
            value: NumberText(value),
            at: batch.inputs_at(point),
        };
        for point in piece.clone() {
            let increment = outputs.increment[point];
            if !increment.is_finite() {
                return not_finite("increment", increment, point);
            }
            if increment < 0.0 && descriptor.claims(Claim::NonNegative) {
                return EvaluateError::Negative { law, value: NumberText(increment), at: batch.inputs_at(point) };
            }
            if let Some(direction) = &outputs.direction {
                let vector = &direction[3 * point..3 * point + 3];
                if let Some(component) = vector.iter().find(|component| !component.is_finite()) {
                    return not_finite("direction", *component, point);
                }
                if !unit_lengths(vector) {
                    let length = vector.iter().map(|component| component * component).sum::<f64>().sqrt();
                    return EvaluateError::DirectionLength {
                        law,
                        length: NumberText(length),
                        tolerance: NumberText(LENGTH_TOLERANCE),
                        at: batch.inputs_at(point),
                    };
                }
            }
            if let Some(state) = &outputs.state {
                let values = &state[variables * point..variables * (point + 1)];
                if let Some(index) = values.iter().position(|value| !value.is_finite()) {
                    let name = format!("state variable `{}`", descriptor.state[index].name);
                    return not_finite(&name, values[index], point);
                }
            }
            if let Some(d_pressure) = &outputs.d_pressure
                && !no_nan(&d_pressure[point..=point])
            {
                return not_finite("d_pressure", d_pressure[point], point);
            }
        }
        // The sweep and this search look at the same numbers; a law that still writes to them is caught here.
        not_finite("increment", f64::NAN, piece.start)
    }
}

fn first_bad(statuses: &[i32], status: i32) -> Option<usize> {
    let same = statuses.iter().position(|one| *one == status);
    same.or_else(|| statuses.iter().position(|one| severity(*one) >= severity(status)))
}

fn named(first_bad: i64, points: usize) -> Option<usize> {
    usize::try_from(first_bad).ok().filter(|point| *point < points)
}

/// A status that does not exist means failed.
fn severity(status: i32) -> i32 {
    if (abi::WL_OK..=abi::WL_FAILED).contains(&status) { status } else { abi::WL_FAILED }
}

fn text_of(words: &[c_char]) -> String {
    let bytes: Vec<u8> = words.iter().map(|byte| byte.to_ne_bytes()[0]).take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&bytes).trim().replace(char::is_control, " ")
}
