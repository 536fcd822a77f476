//! What crosses the boundary to C: structs with their size, texts, arrays, and the end of every function.
#![allow(unsafe_code)] // reason: reads and writes what a solver's pointers lead to.

use std::any::Any;
use std::ffi::{CStr, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use wearlaw_plugin_api::abi as law_abi;

use crate::abi::{Constants, Description, Outputs, Solver, Source, Step};
use crate::error::HostError;

/// A struct of the interface.
///
/// # Safety
/// It begins with its size as an `i64`, and any bits, all zeros too, are a value of it.
pub(crate) unsafe trait Sized64: Copy {
    /// Its name in C.
    const NAME: &'static str;
    /// Its size in version 1.0; less is refused.
    const LEAST: usize;
}

macro_rules! sized64 {
    ($($type:ty = $name:literal;)*) => {$(
        // SAFETY: a plain struct of numbers and pointers that begins with `struct_size`.
        unsafe impl Sized64 for $type {
            const NAME: &'static str = $name;
            const LEAST: usize = size_of::<$type>();
        }
    )*};
}

sized64! {
    Source = "wlh_source";
    Solver = "wlh_solver";
    Description = "wlh_description";
    Constants = "wlh_constants";
    Step = "wlh_step";
    Outputs = "wlh_outputs";
    law_abi::Quantity = "wl_quantity";
}

/// Larger than any struct of a later minor version: a size beyond it was never set.
const LARGEST: i64 = 4096;

/// The size that the solver has given a struct of its own.
///
/// # Safety
/// The pointer is NULL, misaligned, or leads to an `i64`.
unsafe fn size_of_struct<T: Sized64>(pointer: *const T) -> Result<usize, HostError> {
    if pointer.is_null() {
        return Err(HostError::Null(T::NAME));
    }
    aligned(pointer, T::NAME, "a struct")?;
    // SAFETY: the struct begins with its size.
    let found = unsafe { *pointer.cast::<i64>() };
    match usize::try_from(found) {
        Ok(size) if size >= T::LEAST && found <= LARGEST => Ok(size),
        _ => Err(HostError::StructSize { name: T::NAME, found, least: T::LEAST }),
    }
}

/// What the solver has filled of a struct; what it does not know is zero.
///
/// # Safety
/// The pointer is NULL or leads to as many bytes as its first member says.
pub(crate) unsafe fn read<T: Sized64>(pointer: *const T) -> Result<T, HostError> {
    // SAFETY: as the caller says.
    let size = unsafe { size_of_struct(pointer) }?;
    let known = size.min(size_of::<T>());
    let mut value = std::mem::MaybeUninit::<T>::zeroed();
    // SAFETY: `known` bytes are there on both sides.
    unsafe { std::ptr::copy_nonoverlapping(pointer.cast::<u8>(), value.as_mut_ptr().cast(), known) };
    // SAFETY: the bytes behind the known ones belong to the struct, too.
    let rest = unsafe { std::slice::from_raw_parts(pointer.cast::<u8>().add(known), size - known) };
    if rest.iter().any(|byte| *byte != 0) {
        return Err(HostError::UnknownMembers { name: T::NAME, known });
    }
    // SAFETY: any bits are a value of `T`.
    Ok(unsafe { value.assume_init() })
}

/// Fills a struct of the solver's as far as it reaches, but for its size.
///
/// # Safety
/// The pointer is NULL or leads to as many bytes as its first member says.
pub(crate) unsafe fn write<T: Sized64>(pointer: *mut T, value: &T) -> Result<(), HostError> {
    // SAFETY: as the caller says.
    let known = unsafe { size_of_struct(pointer) }?.min(size_of::<T>());
    let (from, to) = (std::ptr::from_ref(value).cast::<u8>(), pointer.cast::<u8>());
    let head = size_of::<i64>();
    // SAFETY: `known` bytes are there on both sides.
    unsafe { std::ptr::copy_nonoverlapping(from.add(head), to.add(head), known - head) };
    Ok(())
}

/// Refuses a pointer that no array or struct of this type can have.
pub(crate) fn aligned<T>(pointer: *const T, what: &str, kind: &'static str) -> Result<(), HostError> {
    if pointer.is_aligned() {
        return Ok(());
    }
    let (address, align) = (pointer.addr(), align_of::<T>());
    Err(HostError::Misaligned { what: what.to_owned(), address, align, kind })
}

/// A text that the solver may leave out.
///
/// # Safety
/// The pointer is NULL or leads to a text that a NUL ends.
pub(crate) unsafe fn text<'a>(pointer: *const c_char, what: &'static str) -> Result<Option<&'a str>, HostError> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: as the caller says.
    let found = unsafe { CStr::from_ptr(pointer) }.to_str();
    found.map(Some).map_err(|error| HostError::Text { what, position: error.valid_up_to() })
}

/// Whole numbers of things: from 0 up.
pub(crate) fn count(what: &str, found: i64) -> Result<usize, HostError> {
    // Half of the address space, as no array is longer.
    let fits = usize::try_from(found).ok().filter(|count| *count <= isize::MAX as usize / size_of::<[f64; 3]>());
    fits.ok_or_else(|| HostError::Number {
        what: what.to_owned(),
        found: found.to_string(),
        expected: "a number of things, 0 or more".to_owned(),
    })
}

/// An array of the solver's, which may be NULL if it has nothing in it.
///
/// # Safety
/// The pointer is NULL or leads to `length` numbers that nobody writes while the slice lives.
pub(crate) unsafe fn array<'a, T>(pointer: *const T, length: i64, what: &'static str) -> Result<&'a [T], HostError> {
    let length = count(what, length)?;
    if length == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(HostError::Null(what));
    }
    aligned(pointer, what, "an array of its type")?;
    // SAFETY: as the caller says; NULL and misaligned pointers are gone.
    Ok(unsafe { std::slice::from_raw_parts(pointer, length) })
}

/// Writes a text and its NUL, cut where it does not fit, but never inside a character.
pub(crate) fn put(room: &mut [c_char], text: &str) {
    let Some(most) = room.len().checked_sub(1) else { return };
    let text = &text[..text.floor_char_boundary(most)];
    for (place, byte) in room.iter_mut().zip(text.bytes().filter(|byte| *byte != 0).chain([0])) {
        *place = c_char::from_ne_bytes([byte]);
    }
}

/// What a function comes to: a status and words on it.
pub(crate) type Answer = Result<(i32, String), HostError>;

/// The answer of a function that was done and has nothing to say.
pub(crate) fn done((): ()) -> Answer {
    Ok((law_abi::WL_OK, String::new()))
}

/// Runs the body of a function: its status, its words into the solver's room, and no panic beyond.
///
/// # Safety
/// `room` is NULL or leads to `size` bytes that can be written.
pub(crate) unsafe fn answer(room: *mut c_char, size: i64, body: impl FnOnce() -> Answer) -> i32 {
    let ended = catch_unwind(AssertUnwindSafe(body));
    let ended = ended.unwrap_or_else(|panic| Err(HostError::Internal(words(&*panic).to_owned())));
    let (status, said) = ended.unwrap_or_else(|error| (error.status(), error.to_string()));
    if let Ok(size) = usize::try_from(size)
        && !room.is_null()
    {
        // SAFETY: as the caller says.
        put(unsafe { std::slice::from_raw_parts_mut(room, size) }, &said);
    }
    status
}

fn words(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no words")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abi::WLH_INTERNAL;

    fn said(room: &[c_char]) -> String {
        let bytes: Vec<u8> = room.iter().take_while(|c| **c != 0).map(|c| c.to_ne_bytes()[0]).collect();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn a_panic_ends_as_a_status_with_its_words() {
        let mut room = [1; 64];
        // SAFETY: the room is as long as said.
        let status = unsafe { answer(room.as_mut_ptr(), 64, || panic!("no {}", "way")) };
        assert_eq!((status, said(&room)), (WLH_INTERNAL, "an internal error: no way".to_owned()));
    }

    #[test]
    fn words_are_cut_between_characters_and_ended() {
        let mut room = [1; 4];
        put(&mut room, "aäää");
        assert_eq!(said(&room), "aä");
        put(&mut room[..0], "x");
        // SAFETY: without a room nothing is written.
        assert_eq!(unsafe { answer(std::ptr::null_mut(), 64, || done(())) }, 0);
    }

    fn step() -> Step {
        // SAFETY: all zeros are a value.
        Step { struct_size: size_of::<Step>() as i64, dt: 2.0, ..unsafe { std::mem::zeroed() } }
    }

    #[test]
    fn a_longer_struct_is_read_if_what_is_not_known_is_zero() {
        #[repr(C)]
        struct Longer(Step, i64);
        let mut longer = Longer(Step { struct_size: size_of::<Longer>() as i64, ..step() }, 0);
        // SAFETY: the struct is as long as it says.
        let found = unsafe { read(std::ptr::from_ref(&longer).cast::<Step>()) };
        assert_eq!(found.map(|step| step.dt).unwrap(), 2.0);
        longer.1 = 1;
        // SAFETY: as above.
        let found = unsafe { read(std::ptr::from_ref(&longer).cast::<Step>()) };
        assert!(matches!(found, Err(HostError::UnknownMembers { .. })));
    }

    #[test]
    fn a_size_that_was_never_set_is_refused() {
        for size in [0, 8, -1, i64::MAX] {
            let step = Step { struct_size: size, ..step() };
            // SAFETY: the size is looked at before anything is read.
            let found = unsafe { read(&step) }.map(|step| step.dt);
            assert!(matches!(found, Err(HostError::StructSize { found, .. }) if found == size), "{found:?}");
        }
    }
}
