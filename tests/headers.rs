//! The committed headers: `wearlaw.h` is what cbindgen makes of the ABI today, and every header stands alone.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn generated() -> String {
    let api = root().join("plugin-api");
    let config = cbindgen::Config::from_file(api.join("cbindgen.toml")).expect("cbindgen.toml is readable");
    let bindings = cbindgen::Builder::new()
        .with_config(config)
        .with_src(api.join("src/abi/version.rs"))
        .with_src(api.join("src/abi/status.rs"))
        .with_src(api.join("src/abi/masks.rs"))
        .with_src(api.join("src/abi/views.rs"))
        .with_src(api.join("src/abi/descriptor.rs"))
        .generate()
        .expect("cbindgen reads the ABI");
    let mut text = Vec::new();
    bindings.write(&mut text);
    String::from_utf8(text).expect("a header is text")
}

#[test]
fn wearlaw_h_is_what_cbindgen_generates() {
    let path = root().join("include/wearlaw.h");
    let now = generated();
    if std::env::var_os("WEARLAW_REGENERATE").is_some() {
        std::fs::write(&path, &now).expect("the header can be written");
    }
    let committed = std::fs::read_to_string(&path).expect("include/wearlaw.h is committed");
    assert!(
        committed == now,
        "include/wearlaw.h is out of step with plugin-api; run WEARLAW_REGENERATE=1 cargo test --test headers"
    );
}
