//! The worker: one check of one law in a process of its own, which the checker ends.
#![allow(unsafe_code)] // reason: resets signals and takes over inherited descriptors.

use std::fs::File;
use std::io::Write;
use std::mem::ManuallyDrop;
use std::os::fd::FromRawFd;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, PoisonError};

use super::bodies::{self, Bench};
use super::check::Check;
use super::harness::call;
use super::harness::fault_note::note_faults;
use super::keeper;
use super::message::{Answer, Task, Verdict};
use super::slate::Slate;

/// Exit code of a worker that was started by hand.
const WRONG_START: i32 = 2;
/// Bytes that a worker may write into a file, what it prints among them.
const PRINTED: u64 = 64 << 20;

/// Bytes that are kept when they are freed, and from how many on an array is mapped by itself (glibc's largest).
#[cfg(target_env = "gnu")]
const KEPT: libc::c_int = 256 << 20;
#[cfg(target_env = "gnu")]
const APART: libc::c_int = 32 << 20;

static PANIC: Mutex<Option<String>> = Mutex::new(None);

/// Runs a worker with the arguments behind [`super::WORKER_COMMAND`]; answers the exit code of the process, if it ends
/// by itself at all.
pub fn worker_main(arguments: &[String]) -> i32 {
    let numbers: Vec<i32> = arguments.iter().filter_map(|word| word.parse().ok()).filter(|n| *n > 2).collect();
    let &[memory, to_checker] = numbers.as_slice() else { return WRONG_START };
    keeper::split(to_checker);
    reset_signals();
    set_limits();
    for descriptor in [memory, to_checker] {
        // SAFETY: takes integers; the descriptors are this process's own.
        unsafe { libc::fcntl(descriptor, libc::F_SETFD, libc::FD_CLOEXEC) };
    }
    // Never freed: notes of faults are made there to the very end.
    let Ok(slate) = Slate::inherit(memory).map(|slate| &*Box::leak(Box::new(slate))) else { return WRONG_START };
    // SAFETY: the checker made this descriptor for this process; never dropped, since a law may have closed it, and Rust
    // aborts when it closes a descriptor that is closed already.
    let mut to_checker = ManuallyDrop::new(unsafe { File::from_raw_fd(to_checker) });
    let Ok(task) = serde_json::from_slice::<Task>(&slate.task()) else { return WRONG_START };
    std::panic::set_hook(Box::new(|panic| {
        let mut first = PANIC.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert_with(|| panic.to_string());
    }));
    if !matches!(task.check, Check::MemoryCalls | Check::MemoryInstances) {
        keep_freed_memory();
    }
    call::narrow(task.narrow);
    note_faults(slate);
    let prints = task.check == Check::LoadSilent;
    let answer = answer(task, slate);
    let sent = serde_json::to_vec(&answer).is_ok_and(|bytes| slate.put_answer(&bytes));
    if !sent || to_checker.write_all(&[1]).is_err() {
        return WRONG_START;
    }
    if prints {
        // What the C library or a Fortran runtime holds back is written when the process ends.
        return 0;
    }
    loop {
        // SAFETY: waits for a signal; the checker sends one that cannot be caught.
        unsafe { libc::pause() };
    }
}

fn answer(task: Task, slate: &'static Slate) -> Answer {
    let bench = Bench::new(task, slate);
    let verdict = catch_unwind(AssertUnwindSafe(|| bodies::run(bench.task.check, &bench)));
    let (laws, bits) = (std::mem::take(&mut *bench.laws()), std::mem::take(&mut *bench.bits()));
    let (verdict, fault) = match verdict {
        Ok(Ok(verdict)) => (verdict, None),
        Ok(Err(verdict)) => (*verdict, None),
        Err(_) => {
            let words = PANIC.lock().unwrap_or_else(PoisonError::into_inner).take();
            (Verdict::Pass(None), Some(words.unwrap_or_else(|| "a panic without words".to_owned())))
        }
    };
    Answer { verdict, laws, bits, fault }
}

/// Rust's runtime catches these to tell a stack overflow; a law's own fault must end the process at once. Two of them are
/// noted before they do.
fn reset_signals() {
    for signal in [libc::SIGSEGV, libc::SIGBUS, libc::SIGABRT, libc::SIGFPE, libc::SIGILL] {
        // SAFETY: setting the default action needs no handler and is allowed for all of these.
        unsafe { libc::signal(signal, libc::SIG_DFL) };
    }
}

/// Freed memory stays with the process: the arrays of a call come and go thousands of times, and to take them from the
/// system anew and hand them back each time took a fifth of all checks. Where memory itself is counted nothing is changed.
fn keep_freed_memory() {
    #[cfg(target_env = "gnu")]
    // SAFETY: takes integers; no other thread runs yet.
    unsafe {
        libc::mallopt(libc::M_TRIM_THRESHOLD, KEPT);
        libc::mallopt(libc::M_MMAP_THRESHOLD, APART);
    }
}

/// What a law may use up.
fn set_limits() {
    let none = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
    let little = libc::rlimit { rlim_cur: PRINTED, rlim_max: PRINTED };
    // SAFETY: the structs live through the calls; a crash that is looked for needs no dump of its memory, and a law that
    // prints without end would fill the machine's: past the limit its writes fail.
    unsafe {
        libc::setrlimit(libc::RLIMIT_CORE, &none);
        libc::signal(libc::SIGXFSZ, libc::SIG_IGN);
        libc::setrlimit(libc::RLIMIT_FSIZE, &little);
    }
}
