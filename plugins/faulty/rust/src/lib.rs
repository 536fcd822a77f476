//! The law of `sound_law.h` with the Rust helper; the faulty laws in `examples` are made from it, each with one fault.
//!
//! increment = K / H max(p, 0) |slip|, direction = -normal; the state variables are the sliding distance and the work.

use wearlaw_plugin_api::sdk::prelude::*;

/// Fields that the sound law reads.
pub const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_SLIP | WL_FIELD_NORMAL;
/// Outputs that it writes.
pub const WRITES: i64 = WL_OUT_D_PRESSURE | WL_OUT_DIRECTION | WL_OUT_STATE | WL_OUT_STATUS;
/// Everything that it claims.
pub const CLAIMS: i64 = WL_CLAIM_DETERMINISTIC
    | WL_CLAIM_NON_NEGATIVE
    | WL_CLAIM_LINEAR_IN_DT
    | WL_CLAIM_ZERO_WITHOUT_PRESSURE
    | WL_CLAIM_ZERO_WITHOUT_SLIP
    | WL_CLAIM_FRAME_INDIFFERENT;
/// Its constants.
pub const CONSTANTS: &[Quantity] = &[
    Quantity::new("K", Unit::NUMBER).at_least(0.0).default(1e-4).about("wear coefficient"),
    Quantity::new("H", Unit::PASCAL).above(0.0).default(2e9).about("hardness of the worn body"),
];
/// Its state variables.
pub const STATE: &[Quantity] = &[
    Quantity::new("distance", Unit::METRE).at_least(0.0).default(0.0).about("sliding distance so far"),
    Quantity::new("work", Unit::JOULE_PER_SQUARE_METRE).at_least(0.0).default(0.0).about("pressure times distance"),
];

/// The sound law at one point.
pub fn sound_point(at: &Point, out: &mut PointAnswer) -> Status {
    let [k, h] = at.constants();
    let [distance, work] = at.state();
    let (pressure, slip) = (if at.pressure < 0.0 { 0.0 } else { at.pressure }, at.slip.abs());
    out.increment = k / h * pressure * slip;
    out.d_pressure = if at.pressure < 0.0 { 0.0 } else { k / h * slip };
    (out.state[0], out.state[1]) = (distance + slip, work + pressure * slip);
    let all = out.increment + out.d_pressure + out.state[0] + out.state[1] + k + h + slip;
    let direction: f64 = out.direction.iter().sum();
    if all.is_finite() && direction.is_finite() && k >= 0.0 && h > 0.0 {
        return Status::Ok;
    }
    out.text = "an input is not finite or out of its bounds";
    Status::OutOfDomain
}

/// Makes a type a law of that name which is sound in all that it says of itself; an expression may replace its making.
#[macro_export]
macro_rules! sound_about {
    ($law:ident, $name:literal) => {
        $crate::sound_about!($law, $name, $law);
    };
    ($law:ident, $name:literal, $create:expr) => {
        impl About for $law {
            const NAME: &'static str = $name;
            const VERSION: &'static str = "1.0.0";
            const SUMMARY: &'static str = "wear proportional to pressure and slip";
            const READS: i64 = $crate::READS;
            const WRITES: i64 = $crate::WRITES;
            const CLAIMS: i64 = $crate::CLAIMS;
            const CONSTANTS: &'static [Quantity] = $crate::CONSTANTS;
            const STATE: &'static [Quantity] = $crate::STATE;
            const DEGREE: Degree = Degree::Value(1.0);

            fn create(options: Option<&str>) -> Result<Self, String> {
                match options {
                    None | Some("") => Ok($create),
                    Some(words) => Err(format!("this law has no options, and was given `{words}`")),
                }
            }
        }
    };
}
