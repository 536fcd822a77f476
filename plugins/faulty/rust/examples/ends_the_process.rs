//! Rule broken: no exit. Where the increment overflows, the law ends the program.

use wearlaw_faulty::{sound_about, sound_point};
use wearlaw_plugin_api::sdk::prelude::*;

struct EndsTheProcess;
sound_about!(EndsTheProcess, "ends-the-process");

impl PointLaw for EndsTheProcess {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let status = sound_point(at, out);
        if out.increment.is_infinite() {
            std::process::exit(7);
        }
        status
    }
}

export_laws!(EndsTheProcess);
