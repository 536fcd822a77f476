//! Linear Archard in three forms, each a library: `archard`, a law in C through the point-wise helper, and one in Rust
//! through the point-wise helper.

use std::path::{Path, PathBuf};

use wearlaw::law::build::{BuildRequest, build};
use wearlaw::law::{LawInstance, LoadOptions, Plugin};

use super::rust_law;

const C_LAW: &str = r#"
#define LAW_NAME "linear-c"
#define LAW_VERSION "1.0.0"
#define LAW_SUMMARY "(K / H) dt p v"
#define LAW_READS(F) F(pressure) F(velocity)
#define LAW_CONSTANTS(C) C(K, WL_NUMBER, WL_FROM(0), WL_REQUIRED, "") C(H, WL_PASCAL, WL_ABOVE(0), WL_REQUIRED, "")
#include "wearlaw_point.h"
WL_POINT {
    out->increment = c->K / c->H * in->dt * in->pressure * in->velocity;
    return WL_OK;
}
"#;

const RUST_LAW: &str = r#"
use wearlaw_plugin_api::sdk::prelude::*;

struct Linear;

impl About for Linear {
    const NAME: &'static str = "linear-rust";
    const VERSION: &'static str = "1.0.0";
    const SUMMARY: &'static str = "(K / H) dt p v";
    const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_VELOCITY;
    const CONSTANTS: &'static [Quantity] =
        &[Quantity::new("K", Unit::NUMBER).at_least(0.0), Quantity::new("H", Unit::PASCAL).above(0.0)];
    const INSTANCE: Option<Self> = Some(Linear);
}

impl PointLaw for Linear {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        let [k, h] = at.constants();
        out.increment = k / h * at.dt * at.pressure * at.velocity;
        Status::Ok
    }
}

export_laws!(Linear);
"#;

/// The library `archard`, built beside this program.
pub fn archard() -> PathBuf {
    let program = std::env::current_exe().expect("the path of this program");
    let folder = program.parent().expect("a program lies in a folder");
    let name = format!("{}wearlaw_archard{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    folder.join(name)
}

/// Compiles the law in C to a library in `folder`.
pub fn in_c(folder: &Path) -> PathBuf {
    let source = folder.join("linear.c");
    std::fs::write(&source, C_LAW).expect("a temporary folder can be written");
    let request =
        BuildRequest { sources: vec![source], output: Some(folder.join("linear.so")), ..BuildRequest::default() };
    build(&request).expect("a C compiler").library
}

/// Compiles the law in Rust to a library in `folder`.
pub fn in_rust(folder: &Path) -> PathBuf {
    rust_law::try_build(RUST_LAW, &folder.join("rust")).expect("the law compiles")
}

/// Opens the only law of a library.
pub fn load(path: &Path) -> LawInstance {
    let plugin = Plugin::open(path, &LoadOptions::default()).expect("a law that was just built");
    plugin.laws()[0].create(None).expect("it has no objections")
}
