//! Rule broken: destroy frees what create has taken. A table of 4 KiB is leaked with every instance.

use wearlaw_faulty::{sound_about, sound_point};
use wearlaw_plugin_api::sdk::prelude::*;

struct LeaksBoxes {
    table: &'static [f64],
}
sound_about!(LeaksBoxes, "leaks-boxes", LeaksBoxes { table: Box::leak(vec![1.0; 512].into_boxed_slice()) });

impl PointLaw for LeaksBoxes {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let status = sound_point(at, out);
        out.increment *= self.table[0];
        status
    }
}

export_laws!(LeaksBoxes);
