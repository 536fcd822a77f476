//! The layout that laws in Rust export: a law that was built with other ABI structs than the host's is refused in a
//! few lines that name the field, one that was built with appended fields is not.
#![allow(unsafe_code)] // loads libraries

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use libloading::os::unix::Library;
use wearlaw::law::layout_check::{LayoutMismatch, check_library};
use wearlaw::law::{LoadError, LoadOptions, Plugin};

/// A change of the source: file under `plugin-api/src`, the words there, what takes their place.
type Change = (&'static str, &'static str, &'static str);

/// A workspace of a copy of `plugin-api` and one small law; the copies share one folder of built crates.
struct Workshop {
    folder: PathBuf,
}

const WORKSPACE: &str = r#"
[workspace]
resolver = "3"
members = ["plugin-api", "law"]
[workspace.package]
version = "0.1.0"
edition = "2024"
rust-version = "1.90"
license = "MIT OR Apache-2.0"
repository = ""
[workspace.lints.rust]
[profile.dev]
debug = false
"#;

const MANIFEST: &str = r#"
[package]
name = "law"
version = "0.1.0"
edition = "2024"
[lib]
crate-type = ["cdylib"]
[dependencies]
wearlaw-plugin-api = { path = "../plugin-api", features = ["layout"] }
"#;

const LAW: &str = r#"
use wearlaw_plugin_api::sdk::prelude::*;
struct Small;
impl About for Small {
    const NAME: &'static str = "small";
    const READS: i64 = WL_FIELD_SLIP;
    const INSTANCE: Option<Self> = Some(Small);
}
impl PointLaw for Small {
    fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
        out.increment = at.slip;
        Status::Ok
    }
}
export_laws!(Small);
"#;

impl Workshop {
    fn new() -> Workshop {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("layout_record");
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        fs::create_dir_all(folder.join("law/src")).expect("a folder can be made");
        write(&folder.join("Cargo.toml"), WORKSPACE);
        write(&folder.join("law/Cargo.toml"), MANIFEST);
        write(&folder.join("law/src/lib.rs"), LAW);
        // The versions that this program was built with are the ones at hand without a network.
        write(&folder.join("Cargo.lock"), &read(&root.join("Cargo.lock")));
        write(&folder.join("plugin-api/Cargo.toml"), &read(&root.join("plugin-api/Cargo.toml")));
        Workshop { folder }
    }

    /// Builds the law against the sources of today with some changes.
    fn cargo(&self, changes: &[Change]) -> Output {
        let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../plugin-api/src");
        copy(&sources, &self.folder.join("plugin-api/src"), &mut |relative, mut text| {
            for (_, from, to) in changes.iter().filter(|(file, ..)| Path::new(file) == relative) {
                assert!(text.contains(from), "`{from}` is in {}", relative.display());
                text = text.replacen(from, to, 1);
            }
            text
        });
        let mut command = Command::new(env!("CARGO"));
        command.args(["build", "--offline", "--quiet", "-p", "law"]).current_dir(&self.folder);
        command.env("CARGO_TARGET_DIR", self.folder.join("target"));
        command.output().expect("cargo runs")
    }

    /// Where the library of a name is kept.
    fn kept(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{}{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX))
    }

    /// Opens a kept library as the program does.
    fn plugin(&self, name: &str) -> Result<Plugin, LoadError> {
        Plugin::open(self.kept(name), &LoadOptions::default())
    }

    /// Builds the law and opens it under a name of its own.
    fn law(&self, name: &str, changes: &[Change]) -> Library {
        let output = self.cargo(changes);
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
        let built = self.folder.join(format!("target/debug/{prefix}law{suffix}"));
        let kept = self.kept(name);
        // Another file, not the one that an earlier library was loaded from.
        let _ = fs::remove_file(&kept);
        fs::copy(&built, &kept).expect("the library can be copied");
        // SAFETY: the library is the law above, which does nothing when it is loaded.
        unsafe { Library::new(&kept) }.expect("the law loads")
    }
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Writes a file if its text changes, so that cargo does not build it anew for nothing.
fn write(path: &Path, text: &str) {
    if fs::read_to_string(path).is_ok_and(|there| there == text) {
        return;
    }
    fs::create_dir_all(path.parent().expect("a file lies in a folder")).expect("a folder can be made");
    fs::write(path, text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

/// Copies a tree of sources, each text changed by `edit`, which is told its path from the top.
fn copy(from: &Path, to: &Path, edit: &mut dyn FnMut(&Path, String) -> String) {
    fn walk(top: &Path, from: &Path, to: &Path, edit: &mut dyn FnMut(&Path, String) -> String) {
        for entry in fs::read_dir(from).expect("a folder can be read") {
            let path = entry.expect("an entry can be read").path();
            let target = to.join(path.file_name().expect("an entry has a name"));
            if path.is_dir() {
                walk(top, &path, &target, edit);
            } else {
                let relative = path.strip_prefix(top).expect("the path is below its top");
                write(&target, &edit(relative, read(&path)));
            }
        }
    }
    walk(from, from, to, edit);
}

const VIEWS: &str = "abi/views.rs";
const DESCRIPTOR: &str = "abi/descriptor.rs";
const EXPORT: &str = "sdk/export.rs";
const FROZEN: &str = "layout.rs";

fn refusal(name: &str, library: &Library) -> String {
    let refused = check_library(library).expect_err(name);
    assert!(matches!(refused, LayoutMismatch::Differs { .. }), "{name}: {refused}");
    let text = refused.to_string();
    println!("{name}: {text}");
    assert!(text.lines().count() <= 5, "{name}: {text}");
    text
}

#[test]
fn a_law_built_with_other_structs_is_refused_and_one_built_with_longer_structs_is_not() {
    let workshop = Workshop::new();

    let same = workshop.law("same", &[]);
    assert_eq!(check_library(&same), Ok(()));
    // SAFETY: only whether the symbol is there is asked.
    let exported = unsafe { same.get::<*const u8>(b"wearlaw_layout_1\0").is_ok() };
    assert!(exported, "the law has no layout to check");

    let view_end = "    pub element_id: IndexColumn,\n";
    let output_end = "    pub d_pressure: *mut f64,\n";
    let appended = workshop.law(
        "appended",
        &[
            (VIEWS, view_end, "    pub element_id: IndexColumn,\n    /// New.\n    pub film: Column,\n"),
            (VIEWS, output_end, "    pub d_pressure: *mut f64,\n    /// New.\n    pub d_slip: *mut f64,\n"),
            (DESCRIPTOR, "    pub flags: i64,\n}", "    pub flags: i64,\n    /// New.\n    pub order: i64,\n}"),
        ],
    );
    assert_eq!(check_library(&appended), Ok(()));
    for name in ["same", "appended"] {
        let law = workshop.plugin(name).expect("the law loads").law(None).expect("it is the only one").clone();
        assert_eq!(law.descriptor().name, "small");
        assert!(law.create(None).is_ok());
    }

    let (live, swapped) = ("pub pressure: Column,", "pub slip: Column,");
    let (first, second) = ("        pressure: Column,\n", "        slip: Column,\n");
    let swapped = workshop.law(
        "swapped",
        &[
            (VIEWS, live, "pub __first: Column,"),
            (VIEWS, swapped, live),
            (VIEWS, "pub __first: Column,", swapped),
            (FROZEN, first, "        __first: Column,\n"),
            (FROZEN, second, first),
            (FROZEN, "        __first: Column,\n", second),
        ],
    );
    let text = refusal("swapped", &swapped);
    assert!(text.contains("Frozen10.view: found field `slip`"), "{text}");
    assert!(text.contains("expected field `pressure`"), "{text}");

    let retyped = workshop.law(
        "retyped",
        &[(VIEWS, "pub cycle: i64,", "pub cycle: f64,"), (FROZEN, "        cycle: i64,", "        cycle: f64,")],
    );
    let text = refusal("retyped", &retyped);
    assert!(text.contains("Frozen10.view.cycle: found type f64, expected type i64"), "{text}");

    let shortened = workshop.law(
        "shortened",
        &[
            (DESCRIPTOR, "pub version: [c_char; WL_VERSION_SIZE]", "pub version: [c_char; 24]"),
            (FROZEN, "        version: [c_char; 32],", "        version: [c_char; 24],"),
        ],
    );
    let text = refusal("shortened", &shortened);
    assert!(text.contains("Frozen10.host.version") && text.contains("24") && text.contains("32"), "{text}");

    let recalled = workshop.law(
        "recalled",
        &[
            (DESCRIPTOR, "fn(id: *const c_char) ->", "fn(id: *const c_char, size: i64) ->"),
            (FROZEN, "fn(id: *const c_char) ->", "fn(id: *const c_char, size: i64) ->"),
            (EXPORT, "(id: *const c_char) ->", "(id: *const c_char, _size: i64) ->"),
        ],
    );
    let text = refusal("recalled", &recalled);
    assert!(text.contains("Frozen10.law.extension"), "{text}");

    // The loader refuses it in the same words.
    let refused = workshop.plugin("retyped").expect_err("a law with other structs loads");
    assert!(matches!(&refused, LoadError::Layout { .. }) && refused.code_has_run(), "{refused}");
    let text = refused.to_string();
    assert!(text.lines().count() <= 5 && text.contains("Frozen10.view.cycle"), "{text}");

    // A struct that is changed without its frozen copy does not compile, and the compiler names the field.
    for (name, change, words) in [
        ("renamed", (VIEWS, "pub cycle: i64,", "pub cycles: i64,"), "no field `cycle`"),
        ("typed anew", (VIEWS, "pub cycle: i64,", "pub cycle: f64,"), "expected `&i64`, found `&f64`"),
        ("inserted", (VIEWS, live, "pub film: Column, pub pressure: Column,"), "frozen field `pressure` of `View`"),
    ] {
        let output = workshop.cargo(&[change]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success(), "{name}: a changed struct compiles");
        assert!(said.contains(words), "{name}: {said}");
    }
}
