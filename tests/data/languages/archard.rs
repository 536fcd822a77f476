//! Archard's law with exponents, in the order of operations that every language here writes.
use wearlaw_plugin_api::sdk::prelude::*;

struct Archard;

impl About for Archard {
    const NAME: &'static str = "archard-rust";
    const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_VELOCITY;
    const WRITES: i64 = WL_OUT_D_PRESSURE;
    const CLAIMS: i64 = WL_CLAIM_DETERMINISTIC | WL_CLAIM_NON_NEGATIVE | WL_CLAIM_LINEAR_IN_DT;
    const DEGREE: Degree = Degree::Constant(2);
    const CONSTANTS: &'static [Quantity] = &[
        Quantity::new("K", Unit::NUMBER).at_least(0.0).closes_units().about("wear coefficient"),
        Quantity::new("H", Unit::PASCAL).above(0.0).about("hardness"),
        Quantity::new("m", Unit::NUMBER).at_least(0.0).default(1.0).about("pressure exponent"),
        Quantity::new("n", Unit::NUMBER).at_least(0.0).default(1.0).about("velocity exponent"),
    ];
    const INSTANCE: Option<Self> = Some(Archard);
}

impl PointLaw for Archard {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let ([k, h, m, n], p) = (at.constants(), at.pressure);
        out.increment = if p <= 0.0 { 0.0 } else { k / h * p.powf(m) * at.velocity.powf(n) * at.dt };
        out.d_pressure = if p <= 0.0 { 0.0 } else { m * out.increment / p };
        if out.increment.is_finite() { Status::Ok } else { Status::OutOfDomain }
    }
}

export_laws!(Archard);
