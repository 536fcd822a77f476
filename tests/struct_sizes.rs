//! Laws and hosts whose structs are shorter or longer than each other's, as later minor versions make them.

#![allow(unsafe_code)] // host structs of other sizes are made from plain bytes; each block says what holds

#[path = "support/native.rs"]
mod native;

use std::ptr::null_mut;

use native::{Native, column, output, view};
use wearlaw_plugin_api::abi::*;

/// A header with one text replaced, in a folder with the rest of `include/`.
fn edited_headers(edits: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for entry in std::fs::read_dir(native::include()).expect("include/ is there") {
        let path = entry.expect("an entry").path();
        let mut text = std::fs::read_to_string(&path).expect("a text");
        if path.ends_with("wearlaw.h") {
            for (old, new) in edits {
                assert_eq!(text.matches(old).count(), 1, "{old}");
                text = text.replace(old, new);
            }
        }
        std::fs::write(folder.path().join(path.file_name().expect("a name")), text).expect("a writable folder");
    }
    folder
}

#[test]
fn laws_built_for_shorter_and_longer_structs_evaluate() {
    let shorter = [("  struct wl_index_column element_id;\n", ""), ("  double *d_pressure;\n", "")];
    let longer = [
        ("  struct wl_index_column element_id;\n", "  struct wl_index_column element_id;\n  struct wl_column film;\n"),
        ("  double *d_pressure;\n", "  double *d_pressure;\n  double *d_slip;\n"),
    ];
    let plain = std::fs::read_to_string(native::data("archard.c")).expect("the source is there");
    let without_slope = plain
        .replace("#define LAW_WRITES WL_OUT_D_PRESSURE\n", "")
        .replace("    out->d_pressure = p <= 0 ? 0 : c->m * wear / p;\n", "");
    for (edits, source) in [(&shorter, &without_slope), (&longer, &plain)] {
        let headers = edited_headers(edits);
        let path = headers.path().join("law.c");
        std::fs::write(&path, source).expect("a writable folder");
        let out = headers.path().join("law.so");
        native::try_compile(&path, headers.path(), &out, &[]).expect("it compiles");
        check_at_three_points(&Native::open(&out, 0), size_of::<View>(), size_of::<Output>());
    }
}

#[test]
fn a_host_with_shorter_structs_is_served() {
    let mut names = vec!["archard.c", "archard.cpp"];
    if native::fortran("a_host_with_shorter_structs_is_served") {
        names.push("archard.f90");
    }
    for name in names {
        let law = native::build(&native::data(name));
        check_at_three_points(&law, size_of::<View>(), size_of::<Output>());
        check_at_three_points(&law, size_of::<View>() - 16, size_of::<Output>() - 8);
        check_at_three_points(&law, size_of::<View>() + 16, size_of::<Output>() + 8);
        // A view that ends before the velocity has none: nothing behind its end may be read.
        let mut v = view(1, 1.0);
        let constants = [1.0; 4].map(|_| column(&[1.0], 0));
        v.constants = constants.as_ptr();
        v.constant_count = 4;
        v.pressure = column(&[1.0], 0);
        v.velocity = column(&[1.0], 0);
        v.struct_size = std::mem::offset_of!(View, velocity) as i64;
        let mut increment = [0.0];
        let mut o = output(&mut increment);
        assert_eq!(law.call(null_mut(), &v, &mut o), WL_MISSING_INPUT, "{name}");
        assert_eq!(o.missing, WL_FIELD_VELOCITY, "{name}");
    }
}

/// Evaluates from structs of the sizes given, which end where the page of their buffer is no longer theirs to touch.
fn check_at_three_points(law: &Native, view_size: usize, output_size: usize) {
    let constants = [2e-4, 1e9, 1.0, 1.0];
    let columns: Vec<Column> = constants.iter().map(|c| Column { ptr: c, step: 0 }).collect();
    let (pressure, velocity) = ([1e6, 0.0, 3e6], [0.5, 1.0, 2.0]);
    let mut v = view(3, 0.1);
    v.struct_size = view_size as i64;
    v.constants = columns.as_ptr();
    v.constant_count = 4;
    v.pressure = column(&pressure, 1);
    v.velocity = column(&velocity, 1);
    let mut increment = [f64::NAN; 3];
    let mut o = output(&mut increment);
    o.struct_size = output_size as i64;
    // Words that are all ones stand behind what is the host's: read as a pointer, they crash the law.
    let mut view_words = [-1i64; 128];
    let mut output_words = [-1i64; 32];
    // SAFETY: both structs are made of whole 8-byte words, and the buffers are larger than they are.
    unsafe {
        copy_words(&raw const v, &mut view_words, view_size.min(size_of::<View>()));
        copy_words(&raw const o, &mut output_words, output_size.min(size_of::<Output>()));
    }
    let evaluate = law.law.evaluate.expect("a law evaluates");
    // SAFETY: the buffers begin with structs of the size they state, and the columns outlive the call.
    let status = unsafe { evaluate(null_mut(), view_words.as_ptr().cast(), output_words.as_mut_ptr().cast()) };
    assert_eq!(status, WL_OK);
    for i in 0..3 {
        let right = constants[0] / constants[1] * pressure[i] * velocity[i] * 0.1;
        assert!((increment[i] - right).abs() <= 1e-15 * right, "{increment:?}");
    }
    assert!(output_words[output_size / 8..].iter().all(|w| *w == -1), "wrote behind the output");
}

/// Copies the first `bytes` bytes of a struct to the front of a buffer.
///
/// # Safety
/// `from` must be made of whole words, and the buffer at least `bytes` long.
unsafe fn copy_words<T>(from: *const T, to: &mut [i64], bytes: usize) {
    // SAFETY: the caller promises the lengths; words have no invalid values.
    unsafe { std::ptr::copy_nonoverlapping(from.cast::<i64>(), to.as_mut_ptr(), bytes / 8) };
}
