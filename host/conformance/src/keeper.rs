//! The keeper: a process between the checker and the worker that runs none of the law's code.
//!
//! What a law starts becomes the keeper's child once the worker is gone, whatever session, group or environment it has
//! put itself into, so the keeper can end it all. It then ends as the worker did, so that the checker sees that.
#![allow(unsafe_code)] // reason: fork, waitpid and signals.

use std::os::fd::RawFd;

use wearlaw_law::isolate::process::{descendants, signal};

/// Times that the family is looked through before the keeper gives up; the checker ends what is left then.
const ROUNDS: usize = 10_000;

/// Splits the process: answers in the new one, the worker, while the old one keeps it and never comes back.
///
/// `channel` is the worker's: the keeper closes its own copy, so that the checker notices when the worker's is closed.
/// If no process can be made this one is the worker.
pub(super) fn split(channel: RawFd) {
    // SAFETY: the program has just started and has one thread, so that the copy is whole; all else takes integers, and
    // sets that live through the calls.
    unsafe {
        let mut waited: libc::sigset_t = std::mem::zeroed();
        let mut before: libc::sigset_t = std::mem::zeroed();
        libc::sigemptyset(&mut waited);
        libc::sigaddset(&mut waited, libc::SIGCHLD);
        libc::sigaddset(&mut waited, libc::SIGTERM);
        libc::sigprocmask(libc::SIG_BLOCK, &waited, &mut before);
        let keeper = libc::getpid();
        let worker = libc::fork();
        if worker <= 0 {
            libc::sigprocmask(libc::SIG_SETMASK, &before, std::ptr::null_mut());
        }
        if worker == 0 {
            // A group of its own: a law that signals its group does not reach the keeper.
            libc::setpgid(0, 0);
            libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGKILL);
            libc::prctl(libc::PR_SET_CHILD_SUBREAPER, 1);
            if libc::getppid() != keeper {
                libc::_exit(1);
            }
        }
        if worker > 0 {
            libc::close(channel);
            keep(worker, &waited);
        }
    }
}

/// Waits for the worker to end, or for word that the checker is gone; ends everything and then itself.
fn keep(worker: libc::pid_t, waited: &libc::sigset_t) -> ! {
    // SAFETY: takes integers. The checker's end comes as a signal that can be waited for, to tidy up first.
    unsafe { libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGTERM) };
    let status = loop {
        if let Some(status) = reaped(worker) {
            break Some(status);
        }
        let mut number = 0;
        // SAFETY: the set and the number live through the call.
        unsafe { libc::sigwait(waited, &mut number) };
        if number == libc::SIGTERM {
            break None;
        }
    };
    end_family();
    match status {
        Some(status) if libc::WIFSIGNALED(status) => end_by(libc::WTERMSIG(status)),
        Some(status) => exit(libc::WEXITSTATUS(status)),
        None => exit(1),
    }
}

/// Takes every ended child off the list; the worker's status if it was among them.
fn reaped(worker: libc::pid_t) -> Option<libc::c_int> {
    loop {
        let mut status = 0;
        // SAFETY: the status lives through the call.
        let child = unsafe { libc::waitpid(-1, &mut status, libc::WNOHANG) };
        if child == worker {
            return Some(status);
        }
        if child <= 0 {
            return None;
        }
    }
}

/// Ends all that is below this process, until there is none.
fn end_family() {
    let own = std::process::id().cast_signed();
    for _ in 0..ROUNDS {
        let family = descendants(own);
        // Stopped first, so that none starts another meanwhile.
        family.iter().for_each(|process| signal(*process, libc::SIGSTOP));
        family.iter().for_each(|process| signal(*process, libc::SIGKILL));
        // SAFETY: a null pointer means that the status is not wanted.
        let answer =
            unsafe { libc::waitpid(-1, std::ptr::null_mut(), if family.is_empty() { libc::WNOHANG } else { 0 }) };
        if answer < 0 {
            return;
        }
    }
}

/// Ends by a signal, as the worker did.
fn end_by(number: libc::c_int) -> ! {
    let none = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
    // SAFETY: takes integers, and structs that live through the calls; the signal's default action ends the process.
    unsafe {
        libc::setrlimit(libc::RLIMIT_CORE, &none);
        libc::signal(number, libc::SIG_DFL);
        let mut set: libc::sigset_t = std::mem::zeroed();
        libc::sigemptyset(&mut set);
        libc::sigaddset(&mut set, number);
        libc::sigprocmask(libc::SIG_UNBLOCK, &set, std::ptr::null_mut());
        libc::raise(number);
    }
    exit(1)
}

fn exit(code: libc::c_int) -> ! {
    // SAFETY: takes an integer; nothing of this process has to be written out.
    unsafe { libc::_exit(code) }
}
