//! Rule broken: no call overflows the stack, whatever the input. Whole hardnesses in the pressure are counted down by a
//! recursion, which has no end where there are too many.

use wearlaw_faulty::{sound_about, sound_point};
use wearlaw_plugin_api::sdk::prelude::*;

struct RecursesDeeply;
sound_about!(RecursesDeeply, "recurses-deeply");

#[inline(never)]
fn whole(parts: f64, above: &[f64; 64]) -> f64 {
    let room = std::hint::black_box([above[63]; 64]);
    if parts >= 1.0 { whole(parts - 1.0, &room) + room[0] } else { room[1] }
}

impl PointLaw for RecursesDeeply {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let [_, h] = at.constants();
        let nothing = whole(at.pressure / h, &[0.0; 64]);
        let status = sound_point(at, out);
        out.increment += nothing;
        status
    }
}

export_laws!(RecursesDeeply);
