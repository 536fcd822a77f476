//! Notes which array, or whether the stack, a fault touched, just before the process dies of it.
#![allow(unsafe_code)] // reason: a signal handler, and the addresses it compares with.

use std::cell::UnsafeCell;
use std::sync::atomic::{AtomicPtr, AtomicUsize, Ordering};

use super::super::slate::{Slate, Touched};

/// Arrays with guards at a time: fields, constants, inputs, state, outputs and the structs around them.
const MOST: usize = 512;

#[derive(Clone, Copy)]
struct Watched {
    first: usize,
    end: usize,
    data: usize,
    data_end: usize,
    name: *const u8,
    name_length: usize,
}

struct Table(UnsafeCell<[Watched; MOST]>);

// SAFETY: written by the one thread that builds calls, and read by the handler of a fault, after which nothing runs.
unsafe impl Sync for Table {}

const NONE: Watched = Watched { first: 0, end: 0, data: 0, data_end: 0, name: std::ptr::null(), name_length: 0 };
static TABLE: Table = Table(UnsafeCell::new([NONE; MOST]));
static COUNT: AtomicUsize = AtomicUsize::new(0);
static STACK_LOW: AtomicUsize = AtomicUsize::new(0);
static SLATE: AtomicPtr<Slate> = AtomicPtr::new(std::ptr::null_mut());

/// How far below its stack a frame may reach that overflows it, and how far above its end still counts as the end.
const STACK_REACH: usize = 1 << 20;
const STACK_END: usize = 1 << 14;

/// Watches the mapping `[first, end)` that holds the array `[data, data_end)`; `name` lives until [`forget_all`].
pub(super) fn watch(first: usize, end: usize, data: usize, data_end: usize, name: &str) {
    let count = COUNT.load(Ordering::Relaxed);
    if count < MOST {
        let entry = Watched { first, end, data, data_end, name: name.as_ptr(), name_length: name.len() };
        // SAFETY: only this thread writes, and the handler reads no entry at or above the count.
        unsafe { (*TABLE.0.get())[count] = entry };
        COUNT.store(count + 1, Ordering::Release);
    }
}

/// Forgets every array from the `keep`th on.
pub(super) fn forget_from(keep: usize) {
    COUNT.store(keep.min(COUNT.load(Ordering::Relaxed)), Ordering::Release);
}

/// How many arrays are watched.
pub(super) fn watched() -> usize {
    COUNT.load(Ordering::Relaxed)
}

/// Notes faults of this thread from now on; the process dies of them all the same.
pub(crate) fn note_faults(slate: &'static Slate) {
    SLATE.store(std::ptr::from_ref(slate).cast_mut(), Ordering::Release);
    // SAFETY: the attributes are initialised by the first call and freed by the last; the stack handed to
    // `sigaltstack` is never freed; the handler only does what a handler may.
    unsafe {
        let mut attributes: libc::pthread_attr_t = std::mem::zeroed();
        if libc::pthread_getattr_np(libc::pthread_self(), &mut attributes) == 0 {
            let (mut low, mut size) = (std::ptr::null_mut(), 0);
            libc::pthread_attr_getstack(&attributes, &mut low, &mut size);
            STACK_LOW.store(low as usize, Ordering::Release);
            libc::pthread_attr_destroy(&mut attributes);
        }
        let room: &'static mut [u8] = Box::leak(vec![0; 1 << 16].into_boxed_slice());
        let stack = libc::stack_t { ss_sp: room.as_mut_ptr().cast(), ss_flags: 0, ss_size: room.len() };
        libc::sigaltstack(&stack, std::ptr::null_mut());
        for signal in [libc::SIGSEGV, libc::SIGBUS] {
            let mut action: libc::sigaction = std::mem::zeroed();
            action.sa_sigaction = handler as *const () as usize;
            action.sa_flags = libc::SA_SIGINFO | libc::SA_ONSTACK | libc::SA_RESETHAND;
            libc::sigaction(signal, &action, std::ptr::null_mut());
        }
    }
}

extern "C" fn handler(signal: libc::c_int, info: *mut libc::siginfo_t, _context: *mut libc::c_void) {
    // SAFETY: the slate is never freed, the kernel hands over a valid `info`, and only stores and `raise` are made; the
    // default action is in place again, so the process ends by the signal.
    unsafe {
        if let Some(slate) = SLATE.load(Ordering::Acquire).as_ref() {
            // A signal that was sent has no address.
            if (*info).si_code > 0 {
                note(slate, (*info).si_addr() as usize);
            }
        }
        libc::raise(signal);
    }
}

fn note(slate: &Slate, address: usize) {
    if address < 4096 {
        return slate.fault(Touched::Null, b"", address as u64);
    }
    let count = COUNT.load(Ordering::Acquire).min(MOST);
    // SAFETY: the entries below the count were written before it, by the thread that is interrupted here or that waits.
    for entry in unsafe { &(&(*TABLE.0.get()))[..count] } {
        if !(entry.first..entry.end).contains(&address) {
            continue;
        }
        let (touched, offset) = if address >= entry.data_end {
            (Touched::Behind, address - entry.data_end)
        } else if address < entry.data {
            (Touched::Before, entry.data - address)
        } else {
            (Touched::ReadOnly, address - entry.data)
        };
        // SAFETY: the name lives as long as the entry.
        let name = unsafe { std::slice::from_raw_parts(entry.name, entry.name_length) };
        return slate.fault(touched, name, offset as u64);
    }
    let low = STACK_LOW.load(Ordering::Acquire);
    let stack = low != 0 && address.wrapping_add(STACK_REACH) >= low && address < low + STACK_END;
    slate.fault(if stack { Touched::Stack } else { Touched::Elsewhere }, b"", 0);
}
