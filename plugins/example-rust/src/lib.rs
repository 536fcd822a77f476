//! Archard's law with a hardness that falls as the surface warms, and a wear direction tilted by ploughing.
//!
//! [`SofteningPlough`] is the whole law; equation, constants, ranges and sources are in the README of this folder.

use wearlaw_plugin_api::sdk::prelude::*;

/// Part of the hardness H below which the straight line of softening stands for no metal any more: refused.
const LEAST_HARDNESS: f64 = 0.1;
/// Part of the hardness H below which the result is used with a warning.
const LOW_HARDNESS: f64 = 0.25;
/// Steepest tilt that is taken, as the tangent of its angle (84 degrees).
const MOST_TILT: f64 = 10.0;
/// Part of a slip vector that must lie in the surface; less is the rounding of a slip along the normal.
const LEAST_TANGENTIAL: f64 = 1e-8;

/// Wear increment = K p slip / (H [1 - softening (T - T0)]), direction = -(n + tilt s) / sqrt(1 + tilt^2).
///
/// p contact pressure, T temperature of the worn surface, n its outward normal, s the unit slip direction in the
/// surface (none, and so direction = -n, where there is no slip vector). Archard, J. Appl. Phys. 24 (1953) 981-988; a
/// hardness that depends on temperature as in Molinari, Ortiz, Radovitzky and Repetto, Eng. Comput. 18 (2001) 592-610.
pub struct SofteningPlough;

impl About for SofteningPlough {
    const NAME: &'static str = "softening-plough";
    const VERSION: &'static str = "1.0.0";
    const SUMMARY: &'static str = "Archard wear with a hardness that falls with temperature, tilted by ploughing";
    const SOURCE: &'static str = "J. F. Archard, J. Appl. Phys. 24 (1953) 981-988; hardness by temperature as in J. F. \
        Molinari et al., Eng. Comput. 18 (2001) 592-610";
    const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_SLIP | WL_FIELD_TEMPERATURE | WL_FIELD_NORMAL;
    const USES: i64 = WL_FIELD_SLIP_VECTOR;
    const WRITES: i64 = WL_OUT_DIRECTION | WL_OUT_D_PRESSURE;
    const CLAIMS: i64 = WL_CLAIM_DETERMINISTIC
        | WL_CLAIM_NON_NEGATIVE
        | WL_CLAIM_LINEAR_IN_DT
        | WL_CLAIM_ZERO_WITHOUT_PRESSURE
        | WL_CLAIM_ZERO_WITHOUT_SLIP
        | WL_CLAIM_FRAME_INDIFFERENT;
    const FLAGS: i64 = WL_FLAG_KINKS;
    const CONSTANTS: &'static [Quantity] = &[
        Quantity::new("K", Unit::NUMBER).at_least(0.0).about("wear coefficient"),
        Quantity::new("H", Unit::PASCAL).above(0.0).about("hardness at the temperature T0"),
        Quantity::new("softening", Unit::PER_KELVIN).at_least(0.0).default(0.0).about("part of H lost per degree"),
        Quantity::new("T0", Unit::KELVIN).about("temperature at which H holds, in the scene's temperature scale"),
        Quantity::new("tilt", Unit::NUMBER)
            .at_least(0.0)
            .at_most(MOST_TILT)
            .default(0.0)
            .about("tangent of the tilt angle"),
    ];
    const DEGREE: Degree = Degree::Value(1.0);
    const INSTANCE: Option<Self> = Some(SofteningPlough);
}

impl PointLaw for SofteningPlough {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let [k, h, softening, t0, tilt] = at.constants();
        let hardness = 1.0 - softening * (at.temperature - t0);
        // Both are true of numbers only: a NaN among the inputs fails one of them.
        let numbers = at.pressure.is_finite() && at.slip >= 0.0 && at.slip.is_finite() && hardness.is_finite();
        let material = k >= 0.0 && k.is_finite() && h > 0.0 && h.is_finite() && softening >= 0.0;
        if !(numbers && material && (0.0..=MOST_TILT).contains(&tilt)) {
            return refuse(out, "pressure, slip, temperature or a constant is out of its range or not a number");
        }
        // A slip vector that the scene does not have is not a number in all of its components.
        let known = at.slip_vector.iter().filter(|x| x.is_finite()).count();
        if known < 3 && !at.slip_vector.iter().all(|x| x.is_nan()) {
            return refuse(out, "a component of the slip vector is not a finite number");
        }
        if at.temperature < at.absolute_zero {
            return refuse(out, "the temperature is below absolute zero");
        }
        if hardness < LEAST_HARDNESS {
            return refuse(out, "the hardness has fallen below a tenth of H");
        }
        let slope = k / (h * hardness) * at.slip;
        if at.pressure > 0.0 {
            (out.increment, out.d_pressure) = (slope * at.pressure, slope);
        }
        out.direction = direction(at.normal, at.slip_vector, tilt);
        if !(out.increment.is_finite() && slope.is_finite() && out.direction.iter().all(|x| x.is_finite())) {
            return refuse(out, "the wear increment overflows, or the normal is no vector");
        }
        if hardness < LOW_HARDNESS {
            out.text = "the hardness has fallen below a quarter of H";
            return Status::Unreliable;
        }
        Status::Ok
    }
}

fn refuse(out: &mut PointAnswer, text: &'static str) -> Status {
    out.text = text;
    Status::OutOfDomain
}

/// The unit vector -(n + tilt s) / sqrt(1 + tilt^2), s the unit vector of `slip` in the surface with normal `normal`.
///
/// A slip vector that is absent (not a number), zero or along the normal leaves -n.
fn direction(normal: [f64; 3], slip: [f64; 3], tilt: f64) -> [f64; 3] {
    // Largest component 1, so that no square overflows or is lost.
    let scale = slip.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
    let mut sum = normal;
    if tilt > 0.0 && scale > 0.0 {
        let unit = slip.map(|x| x / scale);
        let along = dot(unit, normal) / dot(normal, normal);
        let tangential: [f64; 3] = core::array::from_fn(|i| unit[i] - along * normal[i]);
        let length = dot(tangential, tangential).sqrt();
        if length > LEAST_TANGENTIAL {
            sum = core::array::from_fn(|i| normal[i] + tilt * (tangential[i] / length));
        }
    }
    let length = dot(sum, sum).sqrt();
    sum.map(|x| -x / length)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

export_laws!(SofteningPlough);

#[cfg(test)]
mod tests;
