//! The law that the faulty laws in Rust are made from, with no fault.

use wearlaw_faulty::{sound_about, sound_point};
use wearlaw_plugin_api::sdk::prelude::*;

struct SoundRust;
sound_about!(SoundRust, "sound-rust");

impl PointLaw for SoundRust {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        sound_point(at, out)
    }
}

export_laws!(SoundRust);
