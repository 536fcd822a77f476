//! {{name}}: Archard's law with a pressure that levels off.
//!
//! wear increment = k * q * slip,  q = p / (1 + p / p_half)
//!
//! At low contact pressure p this is Archard's law with the specific wear rate k; at p = p_half it gives half of it, and
//! beyond that more pressure hardly wears more. Put your own equation in its place.

use wearlaw_plugin_api::sdk::prelude::*;

/// The law; it has no memory and no options, so the type is empty.
struct TheLaw;

/// What the law is.
impl About for TheLaw {
    const NAME: &'static str = "{{name}}";
    const VERSION: &'static str = env!("CARGO_PKG_VERSION");
    const SUMMARY: &'static str = "Archard wear that levels off at high pressure";
    /// Fields that the law must be given.
    const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_SLIP;
    /// What the law promises; leave out what your equation does not keep.
    const CLAIMS: i64 = WL_CLAIM_DETERMINISTIC
        | WL_CLAIM_NON_NEGATIVE
        | WL_CLAIM_LINEAR_IN_DT
        | WL_CLAIM_ZERO_WITHOUT_PRESSURE
        | WL_CLAIM_ZERO_WITHOUT_SLIP
        | WL_CLAIM_FRAME_INDIFFERENT;
    /// The derivative branches at p = 0.
    const FLAGS: i64 = WL_FLAG_KINKS;
    const CONSTANTS: &'static [Quantity] = &[
        Quantity::new("k", Unit::PER_PASCAL).at_least(0.0).about("specific wear rate"),
        Quantity::new("p_half", Unit::PASCAL)
            .above(0.0)
            .default(1e9)
            .about("pressure at which the wear is half Archard's"),
    ];

    const INSTANCE: Option<Self> = Some(TheLaw);
}

/// What the law does at one point; the loop over the points is made for it.
impl PointLaw for TheLaw {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let [k, p_half] = at.constants();
        if at.pressure > 0.0 || at.pressure.is_nan() {
            let q = at.pressure / (1.0 + at.pressure / p_half);
            out.increment = k * q * at.slip;
        } // else: no pressure, no wear; the increment is preset to 0
        // What has no answer gets a status, never a silent NaN or infinity.
        if out.increment.is_finite() { Status::Ok } else { Status::OutOfDomain }
    }
}

export_laws!(TheLaw);
