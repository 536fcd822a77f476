//! Real builds of small Rust crates, without a network.

use super::tests::write;
use super::{BuildRequest, build};
use crate::file_facts::FileFacts;

const MANIFEST: &str = "[package]\nname = \"my-law\"\nversion = \"0.1.0\"\nedition = \"2021\"\n[workspace]\n[lib]\n";

#[test]
fn a_rust_crate_becomes_a_library() {
    let folder = tempfile::tempdir().unwrap();
    let krate = folder.path().join("krate");
    let code = "#[unsafe(no_mangle)]\npub extern \"C\" fn wearlaw_entry_1(i: i32) -> i32 { i }\nfn never() {}\n";
    write(&krate, "src/lib.rs", code);
    write(&krate, "Cargo.toml", &format!("{MANIFEST}crate-type = [\"cdylib\", \"rlib\"]\n"));
    for source in [krate.clone(), krate.join("Cargo.toml")] {
        let output = Some(folder.path().join("law.so"));
        let built = build(&BuildRequest { sources: vec![source], output, ..BuildRequest::default() }).unwrap();
        assert!(FileFacts::read(&built.library).unwrap().elf.has_entry);
        assert!(built.messages.contains("never"), "warnings are kept: {}", built.messages);
    }
    write(&krate, "src/lib.rs", "pub fn bad() -> i32 { no_such_name }\n");
    let request = BuildRequest { sources: vec![krate.clone()], ..BuildRequest::default() };
    assert!(build(&request).unwrap_err().messages().contains("no_such_name"));
    write(&krate, "src/lib.rs", "pub fn fine() {}\n");
    write(&krate, "Cargo.toml", MANIFEST);
    assert!(build(&request).unwrap_err().to_string().contains("crate-type = [\"cdylib\"]"));
}

#[test]
fn the_carried_rust_side_builds_without_its_workspace() {
    let folder = tempfile::tempdir().unwrap();
    super::headers::write_plugin_api(&folder.path().join("api")).unwrap();
    let krate = folder.path().join("krate");
    write(&krate, "src/lib.rs", "pub use wearlaw_plugin_api as api;\n");
    let dependency = "[dependencies]\nwearlaw-plugin-api = { path = \"../api\" }\n";
    write(&krate, "Cargo.toml", &format!("{MANIFEST}crate-type = [\"cdylib\"]\n{dependency}"));
    let output = Some(folder.path().join("law.so"));
    let extra_flags = vec!["--offline".into()];
    let built = build(&BuildRequest { sources: vec![krate], output, extra_flags, ..BuildRequest::default() });
    let built = built.unwrap_or_else(|error| panic!("{error}: {}", error.messages()));
    assert!(!built.messages.contains("warning"), "{}", built.messages);
}
