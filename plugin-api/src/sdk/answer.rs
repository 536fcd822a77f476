#![allow(unsafe_code)] // the boundary itself: raw output pointers become slices here and nowhere else
//! Where the answers of a call go, with bounds.

use core::fmt::{self, Write};
use core::mem::size_of;
use core::slice::from_raw_parts_mut;

use crate::abi::Output;

use super::Status;

/// The outputs of one call. What is `None` is not wanted.
pub struct Answer<'a> {
    /// Wear increment `[points]`; length.
    pub increment: &'a mut [f64],
    /// Wear direction `[points]`, unit vectors.
    pub direction: Option<&'a mut [[f64; 3]]>,
    /// State variables at the end of the substep `[points * state variables]`.
    pub state: Option<&'a mut [f64]>,
    /// Status of every point `[points]`, as the ABI's numbers.
    pub status: Option<&'a mut [i32]>,
    /// Derivative of the increment with respect to the pressure `[points]`.
    pub d_pressure: Option<&'a mut [f64]>,
    worst: Status,
    first_bad: i64,
    dt_factor: f64,
    missing: i64,
    text: &'a mut [u8],
}

impl<'a> Answer<'a> {
    /// Takes over the output of a call over `points` points with `state_count` state variables each.
    ///
    /// # Safety
    /// `output` is NULL or points to at least `struct_size` bytes of an output whose pointers are NULL or valid for
    /// writing the promised number of items for `'a`, without overlap.
    #[inline]
    pub(crate) unsafe fn new(output: *mut Output, points: usize, state_count: usize) -> Option<Answer<'a>> {
        if output.is_null() {
            return None;
        }
        // SAFETY: the caller promises `struct_size` bytes and the lengths of the arrays; an all-zero `Output` is valid
        // (nothing wanted), and a pointer that is NULL makes no slice.
        unsafe {
            let given = usize::try_from((*output).struct_size).unwrap_or(0);
            let copy = if given >= size_of::<Output>() { output.read() } else { widened(output, given) };
            if copy.increment.is_null() {
                return None;
            }
            let wanted = |ptr: *mut f64, count: usize| (!ptr.is_null()).then(|| from_raw_parts_mut(ptr, count));
            let text_size = usize::try_from(copy.text_size).unwrap_or(0);
            Some(Answer {
                increment: from_raw_parts_mut(copy.increment, points),
                direction: (!copy.direction.is_null())
                    .then(|| from_raw_parts_mut(copy.direction.cast::<[f64; 3]>(), points)),
                state: wanted(copy.state, points * state_count),
                status: (!copy.status.is_null()).then(|| from_raw_parts_mut(copy.status, points)),
                d_pressure: wanted(copy.d_pressure, points),
                worst: Status::Ok,
                first_bad: -1,
                dt_factor: 0.0,
                missing: 0,
                text: if copy.text.is_null() || text_size == 0 {
                    &mut []
                } else {
                    from_raw_parts_mut(copy.text.cast::<u8>(), text_size)
                },
            })
        }
    }

    /// The increments `[points]` of a call that wants nothing else.
    ///
    /// # Safety
    /// As for [`Answer::new`].
    #[inline(always)]
    pub(crate) unsafe fn increments_alone(output: *mut Output, points: usize) -> Option<&'a mut [f64]> {
        // SAFETY: the caller promises `struct_size` bytes, which hold every field that is read, and the length of the
        // increments.
        unsafe {
            let output = output.as_ref()?;
            let is_whole = usize::try_from(output.struct_size).is_ok_and(|size| size >= size_of::<Output>());
            let alone = is_whole
                && output.direction.is_null()
                && output.state.is_null()
                && output.status.is_null()
                && output.d_pressure.is_null();
            (alone && !output.increment.is_null()).then(|| from_raw_parts_mut(output.increment, points))
        }
    }

    /// Notes a status at point `i`; the first point of the worst status keeps its text.
    ///
    /// The array of statuses, where it is wanted, gets the number too.
    pub fn flag(&mut self, i: usize, status: Status, text: fmt::Arguments<'_>) {
        if let Some(all) = self.status.as_deref_mut() {
            all[i] = status as i32;
        }
        if status > self.worst {
            self.first_bad = i as i64;
            self.say(status, text);
        }
    }
    /// Notes a status of the whole call.
    pub fn say(&mut self, status: Status, text: fmt::Arguments<'_>) {
        self.worst = self.worst.max(status);
        let mut room = Room { bytes: self.text, used: 0 };
        // A text that does not fit is cut; the status stands.
        let _ = room.write_fmt(text);
        room.close();
    }
    /// Asks for a substep shorter by `factor` in (0, 1); the smallest wish wins.
    pub fn cut_step(&mut self, i: usize, factor: f64, text: fmt::Arguments<'_>) {
        if self.dt_factor == 0.0 || factor < self.dt_factor {
            self.dt_factor = factor;
        }
        self.flag(i, Status::CutStep, text);
    }
    /// Notes the field bits of inputs that are not there.
    pub fn miss(&mut self, fields: i64) {
        self.missing |= fields;
        self.say(Status::MissingInput, format_args!("a field that the law reads was not given"));
    }
    /// The worst status noted so far.
    #[inline]
    pub fn worst(&self) -> Status {
        self.worst
    }
    /// Says of every point that it is good, where statuses are wanted.
    #[inline]
    pub fn all_good(&mut self) {
        if let Some(all) = self.status.as_deref_mut() {
            all.fill(Status::Ok as i32);
        }
    }

    /// Writes what was noted back into the call's output.
    ///
    /// # Safety
    /// `output` is the one this answer was made from.
    #[inline]
    pub(crate) unsafe fn finish(&self, output: *mut Output) {
        // SAFETY: the output was read when this answer was made; these fields are part of its 1.0 size, which every
        // host has.
        unsafe {
            (*output).first_bad = self.first_bad;
            (*output).dt_factor = self.dt_factor;
            (*output).missing = self.missing;
        }
    }
}

/// A copy of a short output, in which nothing is wanted that it does not have.
///
/// # Safety
/// `output` points to at least `given` bytes, fewer than an `Output` has.
#[cold]
unsafe fn widened(output: *const Output, given: usize) -> Output {
    // SAFETY: the caller promises `given` bytes, and the copy has more; all-zero bytes are a valid `Output`.
    unsafe {
        let mut copy: Output = core::mem::zeroed();
        core::ptr::copy_nonoverlapping(output.cast::<u8>(), (&raw mut copy).cast::<u8>(), given);
        copy
    }
}

/// A buffer of the host's that always ends in NUL.
pub(crate) struct Room<'a> {
    pub(crate) bytes: &'a mut [u8],
    pub(crate) used: usize,
}

impl Room<'_> {
    pub(crate) fn close(self) {
        if let Some(end) = self.bytes.get_mut(self.used) {
            *end = 0;
        }
    }
}

impl Write for Room<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = self.bytes.len().saturating_sub(self.used + 1);
        let mut take = text.len().min(room);
        while !text.is_char_boundary(take) {
            take -= 1;
        }
        self.bytes[self.used..self.used + take].copy_from_slice(&text.as_bytes()[..take]);
        self.used += take;
        if take < text.len() { Err(fmt::Error) } else { Ok(()) }
    }
}
