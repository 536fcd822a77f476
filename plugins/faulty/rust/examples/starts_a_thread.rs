//! Rule broken: threads of an instance end with it. Create starts a thread that waits for ever, destroy does not end it.

use wearlaw_faulty::{sound_about, sound_point};
use wearlaw_plugin_api::sdk::prelude::*;

struct StartsAThread;
sound_about!(StartsAThread, "starts-a-thread", {
    std::thread::spawn(|| {
        loop {
            std::thread::park();
        }
    });
    StartsAThread
});

impl PointLaw for StartsAThread {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        sound_point(at, out)
    }
}

export_laws!(StartsAThread);
