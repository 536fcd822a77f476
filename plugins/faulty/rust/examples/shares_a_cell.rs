//! Rule broken: one instance may be evaluated from several threads at once. Slips pass through one static cell that is
//! said to be safe to share, and is not; a pause at one pressure in 64 makes sure that a busy machine shows it.
#![allow(unsafe_code)] // reason: the fault is a promise to the compiler that does not hold.

use std::cell::UnsafeCell;

use wearlaw_faulty::{sound_about, sound_point};
use wearlaw_plugin_api::sdk::prelude::*;

struct Shared(UnsafeCell<f64>);

// SAFETY: none; this is the fault.
unsafe impl Sync for Shared {}

static SCRATCH: Shared = Shared(UnsafeCell::new(0.0));

struct SharesACell;
sound_about!(SharesACell, "shares-a-cell");

impl PointLaw for SharesACell {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        // SAFETY: right in one thread; volatile, so that the compiler does not take the detour away.
        let slip = unsafe {
            SCRATCH.0.get().write_volatile(at.slip);
            if at.pressure.to_bits() % 64 == 7 {
                std::thread::sleep(std::time::Duration::from_micros(30));
            }
            SCRATCH.0.get().read_volatile()
        };
        let mut through = *at;
        through.slip = slip;
        sound_point(&through, out)
    }
}

export_laws!(SharesACell);
