//! Asks the dynamic linker for its words about a library that it refuses.
#![allow(unsafe_code)] // dlopen

use std::path::Path;

use libloading::os::unix::{Library, RTLD_LOCAL, RTLD_NOW};

/// The error of a refused `dlopen`.
pub(super) fn refusal_of(library: &Path) -> libloading::Error {
    // SAFETY: the libraries are those that the tests compile; the linker refuses them before running their code,
    // and what ran by mistake would write a file, which the tests look for.
    match unsafe { Library::open(Some(library), RTLD_NOW | RTLD_LOCAL) } {
        Ok(_) => panic!("{} was loaded", library.display()),
        Err(error) => error,
    }
}
