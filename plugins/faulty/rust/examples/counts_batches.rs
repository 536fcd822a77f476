//! Rule broken: pure: no memory between calls but the state variables. A static counter of points grows and flows into
//! the answer.

use std::sync::atomic::{AtomicU64, Ordering};

use wearlaw_faulty::{sound_about, sound_point};
use wearlaw_plugin_api::sdk::prelude::*;

static POINTS: AtomicU64 = AtomicU64::new(0);

struct CountsBatches;
sound_about!(CountsBatches, "counts-batches");

impl PointLaw for CountsBatches {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let status = sound_point(at, out);
        out.increment *= 1.0 + 1e-12 * (POINTS.fetch_add(1, Ordering::Relaxed) % 1000) as f64;
        status
    }
}

export_laws!(CountsBatches);
