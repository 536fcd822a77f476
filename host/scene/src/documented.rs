//! The documented constants C5 to C8 of the Archard wear table as settings of the host.
//!
//! C1 to C4 belong to the law; C5 to C8 say what the host does with it. An input deck and a scene's list of up
//! to eight constants for `archard` both come through here, so that they cannot mean different things.
//! Source: "Contact Surface Wear", 4.22.1, the tables of constants C1 to C8 and of the flag C5.

use thiserror::Error;

use super::{Basis, Mode};

/// How far the length of C6..C8 may be from 1 for the numbers to be kept to the bit.
///
/// Direction cosines are written with six or seven digits in practice; within their rounding the deck's own
/// numbers are worth more than a renormalised copy of them.
const UNIT_LENGTH_TOLERANCE: f64 = 1e-6;

/// Number of constants the Archard table documents.
pub const DOCUMENTED_CONSTANTS: usize = 8;

/// What C5 to C8 say about the host; `None` is "not stated", and a scene's own key or its default holds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Controls {
    /// C5 = 1 and 11: nodal stress; C5 = 10: contact pressure.
    pub basis: Option<Basis>,
    /// C5 = 10 and 11: the wear increment is averaged over the contact area; C5 = 1: it is not.
    pub average: Option<bool>,
    /// C5 = -99: wear is computed, the geometry never moves.
    pub mode: Option<Mode>,
    /// C6, C7, C8 as a vector of length 1 in the global axes; a blank cosine beside a given one is 0.
    pub direction: Option<[f64; 3]>,
    /// C6, C7, C8 as they were given, where their length was not 1 and `direction` is a scaled copy.
    pub direction_before_scaling: Option<[f64; 3]>,
}

impl Controls {
    /// Says whether two sets of controls mean the same once their defaults are filled in.
    ///
    /// Defaults: contact pressure, no averaging, the geometry moves, opposite to the contact normal.
    pub fn same_meaning(&self, other: &Controls) -> bool {
        let meaning = |c: &Controls| {
            (c.basis.unwrap_or(Basis::Pressure), c.average.unwrap_or(false), c.mode.unwrap_or(Mode::Apply), c.direction)
        };
        meaning(self) == meaning(other)
    }
}

/// Why constants C5 to C8 cannot be settings of the host.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ControlsError {
    /// C5 is not one of the documented values.
    #[error("C5 = {value} is not a documented flag: expected 0 or blank, 1, 10, 11 or -99")]
    UndocumentedFlag {
        /// The value of C5.
        value: f64,
    },
    /// C6, C7 and C8 are given and all zero.
    #[error("the wear direction C6, C7, C8 is zero: expected direction cosines, or nothing for the default")]
    ZeroDirection,
    /// A direction cosine is NaN or infinite.
    #[error("C{position} = {value} is not finite: expected a direction cosine")]
    NotFinite {
        /// Which constant, 6 to 8.
        position: usize,
        /// Its value.
        value: f64,
    },
    /// There are more constants than the table documents.
    #[error("found {count} constants: expected at most 8 (C1 to C8)")]
    TooMany {
        /// How many were given.
        count: usize,
    },
}

/// Reads C5 to C8 out of the full list C1, C2, ..; `None` in the list is a blank field.
///
/// A list shorter than eight leaves the rest blank. C5 = 0 states nothing, like a blank: a list without blanks
/// (TOML) needs a value to hold the place before C6. C5 = -99 states the mode only, so that a scene can still
/// say which traction to use; 1, 10 and 11 state the traction and whether to average. C6..C8 are kept to the
/// bit where their length is 1 within 1e-6 and scaled to length 1 otherwise.
///
/// # Errors
/// An undocumented C5, a zero or non-finite direction, more than eight constants.
pub fn controls(c: &[Option<f64>]) -> Result<Controls, ControlsError> {
    if c.len() > DOCUMENTED_CONSTANTS {
        return Err(ControlsError::TooMany { count: c.len() });
    }
    let constant = |number: usize| c.get(number - 1).copied().flatten();
    let mut controls = Controls::default();
    match constant(5) {
        None | Some(0.0) => {}
        Some(1.0) => state_traction(&mut controls, Basis::NodalStress, false),
        Some(10.0) => state_traction(&mut controls, Basis::Pressure, true),
        Some(11.0) => state_traction(&mut controls, Basis::NodalStress, true),
        Some(-99.0) => controls.mode = Some(Mode::Post),
        Some(value) => return Err(ControlsError::UndocumentedFlag { value }),
    }
    let cosines = [constant(6), constant(7), constant(8)];
    if cosines.iter().any(Option::is_some) {
        let given = cosines.map(Option::unwrap_or_default);
        if let Some(axis) = given.iter().position(|x| !x.is_finite()) {
            return Err(ControlsError::NotFinite { position: 6 + axis, value: given[axis] });
        }
        let direction = unit(given).ok_or(ControlsError::ZeroDirection)?;
        controls.direction = Some(direction);
        controls.direction_before_scaling = (direction != given).then_some(given);
    }
    Ok(controls)
}

fn state_traction(controls: &mut Controls, basis: Basis, average: bool) {
    controls.basis = Some(basis);
    controls.average = Some(average);
}

/// The vector at length 1, or `None` for the zero vector; divided by its largest entry first, so that no square overflows.
fn unit(given: [f64; 3]) -> Option<[f64; 3]> {
    let largest = given.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    if largest == 0.0 {
        return None;
    }
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (length(given) - 1.0).abs() <= UNIT_LENGTH_TOLERANCE {
        return Some(given);
    }
    let scaled = given.map(|x| x / largest);
    let scaled_length = length(scaled);
    Some(scaled.map(|x| x / scaled_length))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flag(c5: f64) -> Controls {
        controls(&[None, None, None, None, Some(c5)]).unwrap()
    }

    fn direction(given: [Option<f64>; 3]) -> Result<Controls, ControlsError> {
        let mut c = vec![None; 5];
        c.extend(given);
        controls(&c)
    }

    #[test]
    fn the_flag_states_what_the_page_says() {
        let stated = |c: Controls| (c.basis, c.average, c.mode);
        assert_eq!(stated(flag(1.0)), (Some(Basis::NodalStress), Some(false), None));
        assert_eq!(stated(flag(10.0)), (Some(Basis::Pressure), Some(true), None));
        assert_eq!(stated(flag(11.0)), (Some(Basis::NodalStress), Some(true), None));
        assert_eq!(stated(flag(-99.0)), (None, None, Some(Mode::Post)));
        assert_eq!(flag(0.0), Controls::default());
        assert_eq!(controls(&[]).unwrap(), Controls::default());
        assert_eq!(controls(&[None; 8]).unwrap(), Controls::default());
    }

    #[test]
    fn other_flags_and_long_lists_are_refused() {
        for value in [2.0, -1.0, 9.999, 1.0 + 1e-12, 99.0, f64::INFINITY] {
            let found = controls(&[None, None, None, None, Some(value)]);
            assert_eq!(found, Err(ControlsError::UndocumentedFlag { value }));
        }
        let nan = controls(&[None, None, None, None, Some(f64::NAN)]);
        assert!(matches!(nan, Err(ControlsError::UndocumentedFlag { .. })));
        assert_eq!(controls(&[None; 9]), Err(ControlsError::TooMany { count: 9 }));
    }

    #[test]
    fn a_direction_near_length_one_keeps_its_bits() {
        let given = [0.0, 0.866_025_4, -0.5];
        let c = direction(given.map(Some)).unwrap();
        assert_eq!(c.direction, Some(given));
        assert_eq!(c.direction_before_scaling, None);
    }

    #[test]
    fn another_length_is_scaled_without_overflow() {
        let c = direction([Some(3.0), None, Some(4.0)]).unwrap();
        let found = c.direction.unwrap();
        for (found, exact) in found.iter().zip([0.6, 0.0, 0.8]) {
            assert!((found - exact).abs() <= f64::EPSILON);
        }
        assert_eq!(c.direction_before_scaling, Some([3.0, 0.0, 4.0]));
        for far in [f64::MAX, f64::MIN_POSITIVE / 8.0] {
            let c = direction([None, None, Some(-far)]).unwrap();
            assert_eq!(c.direction, Some([0.0, 0.0, -1.0]));
        }
    }

    #[test]
    fn no_direction_in_the_cosines_is_an_error() {
        assert_eq!(direction([Some(0.0), None, Some(-0.0)]), Err(ControlsError::ZeroDirection));
        assert!(matches!(direction([None, Some(f64::NAN), None]), Err(ControlsError::NotFinite { position: 7, .. })));
    }

    #[test]
    fn defaults_mean_the_same_as_their_statement() {
        assert!(flag(0.0).same_meaning(&Controls {
            basis: Some(Basis::Pressure),
            average: Some(false),
            mode: Some(Mode::Apply),
            ..Controls::default()
        }));
        assert!(!flag(1.0).same_meaning(&flag(11.0)));
    }
}
