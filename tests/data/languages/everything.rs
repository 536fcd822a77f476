//! A law that touches every part of the helper; its siblings in C, C++ and Fortran compute the same.
use wearlaw_plugin_api::sdk::prelude::*;

struct Everything;

impl About for Everything {
    const NAME: &'static str = "everything-rust";
    const VERSION: &'static str = "1.2.3";
    const SUMMARY: &'static str = "every part of the helper";
    const SOURCE: &'static str = "none";
    const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_NORMAL | WL_FIELD_CONTACT_STATE | WL_FIELD_SLIP_VECTOR;
    const USES: i64 = WL_FIELD_TEMPERATURE | WL_FIELD_TANGENT | WL_FIELD_POINT_ID;
    const WRITES: i64 = WL_OUT_D_PRESSURE | WL_OUT_DIRECTION;
    const FLAGS: i64 = WL_FLAG_OPEN_POINTS;
    const INPUTS: &'static [Quantity] = &[
        Quantity::new("film", Unit::METRE).above(0.0).default(2.0).about("film thickness"),
        Quantity::new("humidity", Unit::NUMBER).default(0.5).about("humidity"),
    ];
    const CONSTANTS: &'static [Quantity] =
        &[Quantity::new("k", Unit::PER_PASCAL).at_least(0.0).at_most(1.0).about("specific wear rate")];
    const STATE: &'static [Quantity] = &[
        Quantity::new("total", Unit::METRE).default(0.0).about("wear so far"),
        Quantity::new("calls", Unit::NUMBER).default(1.0).about("substeps so far"),
    ];
    const DEGREE: Degree = Degree::Value(1.0);
    const INSTANCE: Option<Self> = Some(Everything);
}

impl PointLaw for Everything {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let ([k], [film, humidity], [total, calls]) = (at.constants(), at.inputs(), at.state());
        let scale = if at.temperature.is_nan() { 3.0 } else { at.temperature - at.absolute_zero };
        let slip = at.slip_vector[0] + 2.0 * at.slip_vector[1] + 3.0 * at.slip_vector[2];
        let twice = if at.point_id >= 0 && at.point_id % 2 != 0 { 2.0 } else { 1.0 };
        let slope = k * slip * film * humidity * scale * twice;
        out.d_pressure = if at.contact_state == WL_OPEN { 0.0 } else { slope };
        out.increment = out.d_pressure * at.pressure;
        if !at.tangent[0].is_nan() {
            out.direction = [at.tangent[2], at.tangent[0], at.tangent[1]];
        }
        out.state[0] = total + out.increment;
        out.state[1] = calls + 1.0;
        out.dt_factor = 0.25;
        if at.pressure > 1e8 {
            out.text = if at.point_id < 0 { "a point" } else { "a point with a number" };
            return Status::CutStep;
        }
        if at.pressure < -1.0 {
            return Status::Failed;
        }
        if at.pressure > 9e7 { Status::Unreliable } else { Status::Ok }
    }
}

export_laws!(Everything);
