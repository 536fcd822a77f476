//! One worker: started, given its task, waited for, and ended with everything that it started.
#![allow(unsafe_code)] // reason: reaps processes that a worker left behind.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::os::fd::{AsFd, AsRawFd, RawFd};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::ExitStatus;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::WORKER_COMMAND;
use super::check::Check;
use super::message::{Answer, Task};
use super::slate::{Crumb, Slate, memory_file};
use wearlaw_law::isolate::process::{Event, FAMILY, Process, descendants, reap, signal, started};

/// How a worker ended.
#[derive(Debug)]
pub(super) enum Ended {
    /// It gave an answer.
    Answered(Box<Answer>),
    /// Its process ended without one.
    Gone(ExitStatus),
    /// It closed its channel, or sent what is no answer.
    Silent,
    /// Time was up.
    TimedOut,
    /// The user wants to end.
    Interrupted,
}

/// What became of a task.
#[derive(Debug)]
pub(super) struct Attempt {
    pub(super) ended: Ended,
    pub(super) crumb: Crumb,
    /// What was printed, by the law or by what it is written in.
    pub(super) printed: String,
}

/// Name of the memory that a worker shares with the checker, as the system lists it.
const MEMORY: &str = "memfd:wearlaw-check";
/// How often a wish to end is looked for.
const LOOK: Duration = Duration::from_millis(100);
/// How long a process may take to be gone once its channel is closed, or to end when it only has to write out.
const GOING: Duration = Duration::from_secs(2);
/// How long a process may have no environment yet while it is started.
const STARTING: Duration = Duration::from_millis(20);
/// Letters of a program's name that the system keeps.
const SHORT: usize = 15;
/// Most of what was printed that is kept.
const PRINTED: u64 = 1 << 16;

/// Runs a task in a worker of its own.
///
/// # Errors
/// The system gave no memory, pipe or process: a fault of the checker's surroundings, not of the law.
pub(super) fn attempt(program: &Path, task: &Task, timeout: Duration, stop: &AtomicBool) -> io::Result<Attempt> {
    let slate = Slate::create()?;
    if !slate.put_task(&serde_json::to_vec(task)?) {
        return Err(io::Error::other("the task is too long"));
    }
    let mut printed = memory_file()?;
    let (mut from, to_checker) = io::pipe()?;
    let arguments =
        [WORKER_COMMAND.to_owned(), slate.descriptor().to_string(), to_checker.as_raw_fd().to_string()].to_vec();
    let inherited = vec![slate.descriptor(), to_checker.as_raw_fd()];
    let mut process = Process::start(program, arguments, inherited, printed.as_fd())?;
    drop(to_checker);
    never_waits(from.as_raw_fd())?;
    let mut ended = waited(&process, from.as_raw_fd(), timeout, stop);
    if let Ok(Ended::Silent) = ended {
        let mut byte = [0];
        ended = match from.read(&mut byte) {
            Ok(1) => Ok(answered(&slate)),
            _ => Ok(process.ended(GOING).map_or(Ended::Silent, Ended::Gone)),
        };
    }
    if let Ok(Ended::Answered(_)) = ended
        && task.check == Check::LoadSilent
    {
        // It ends by itself, so that everything held back is written.
        let _ = process.ended(GOING);
    }
    let crumb = slate.crumb();
    process.end();
    sweep(&started(), &short_name(program));
    Ok(Attempt { ended: ended?, crumb, printed: read_printed(&mut printed) })
}

/// Waits until the worker's byte can be read ([`Ended::Silent`] until it has been), it is gone, or time is up.
fn waited(process: &Process, pipe: i32, timeout: Duration, stop: &AtomicBool) -> io::Result<Ended> {
    let end = Instant::now() + timeout;
    loop {
        let left = end.saturating_duration_since(Instant::now());
        match process.wait_for(pipe, left.min(LOOK))? {
            Event::Readable | Event::Ended => return Ok(Ended::Silent),
            Event::Deadline if stop.load(Ordering::Relaxed) => return Ok(Ended::Interrupted),
            Event::Deadline if left.is_zero() => return Ok(Ended::TimedOut),
            Event::Deadline => {}
        }
    }
}

/// Reading from this pipe tells that there is nothing instead of waiting: what a dead worker has started may hold the
/// other end open for ever.
fn never_waits(pipe: RawFd) -> io::Result<()> {
    // SAFETY: takes integers; the descriptor is this process's own, and the other end has flags of its own.
    let set = unsafe { libc::fcntl(pipe, libc::F_SETFL, libc::O_NONBLOCK) };
    if set < 0 { Err(io::Error::last_os_error()) } else { Ok(()) }
}

fn answered(slate: &Slate) -> Ended {
    match serde_json::from_slice::<Answer>(&slate.answer()) {
        Ok(answer) => Ended::Answered(Box::new(answer)),
        Err(_) => Ended::Silent,
    }
}

fn read_printed(file: &mut File) -> String {
    let mut bytes = Vec::new();
    let length = file.metadata().map_or(0, |metadata| metadata.len());
    let start = SeekFrom::Start(length.saturating_sub(PRINTED));
    // What cannot be read was not worth more than a hint.
    let _ = file.seek(start).and_then(|_| file.take(PRINTED).read_to_end(&mut bytes));
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Ends what a worker left behind whose keeper was ended, too: it has become a child of this process, as the next
/// subreaper, and still carries the mark of a worker. What is on the list of the started is not left behind.
fn sweep(started: &BTreeSet<u32>, program: &str) {
    let mut family = Vec::new();
    for _ in 0..16 {
        let left: Vec<libc::pid_t> =
            children().into_iter().filter(|child| is_left_behind(*child, started, program)).collect();
        if left.is_empty() {
            break;
        }
        for child in left {
            // Stopped first, so that it starts nothing more meanwhile.
            signal(child, libc::SIGSTOP);
            let below = descendants(child);
            below.iter().for_each(|process| signal(*process, libc::SIGKILL));
            signal(child, libc::SIGKILL);
            // SAFETY: a null pointer means that the status is not wanted; the child was just killed.
            unsafe { libc::waitpid(child, std::ptr::null_mut(), 0) };
            family.extend(below);
        }
    }
    reap(family);
}

fn is_left_behind(child: libc::pid_t, started: &BTreeSet<u32>, program: &str) -> bool {
    if started.contains(&u32::try_from(child).unwrap_or_default()) {
        return false;
    }
    let read = |name: &str| std::fs::read(format!("/proc/{child}/{name}")).unwrap_or_default();
    let holds = |bytes: &[u8], word: &str| bytes.windows(word.len()).any(|window| window == word.as_bytes());
    for last in [false, true] {
        if is_zombie(child) {
            // It shows nothing but the name of its program, which other workers of this process have, too.
            return program_of(child) == program;
        }
        let environment = read("environ");
        // One that was forked and wiped its environment still has the memory that its worker shared.
        if holds(&environment, FAMILY) || holds(&read("maps"), MEMORY) {
            return true;
        }
        // A program that was started without any environment has no mark. One that is just ending has none to show,
        // nor has one that is just about to start.
        if !environment.is_empty() || last {
            return environment.is_empty();
        }
        std::thread::sleep(STARTING);
    }
    false
}

/// The short name of a process's program, also of one that has ended.
fn program_of(process: libc::pid_t) -> String {
    std::fs::read_to_string(format!("/proc/{process}/comm")).unwrap_or_default().trim_end().to_owned()
}

/// The short name that the system gives to processes of a program.
fn short_name(program: &Path) -> String {
    let name = program.file_name().unwrap_or_default().to_string_lossy().into_owned();
    name.chars().take(SHORT).collect()
}

fn is_zombie(process: libc::pid_t) -> bool {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    stat.rsplit(") ").next().is_none_or(|rest| rest.is_empty() || rest.starts_with('Z'))
}

fn children() -> Vec<libc::pid_t> {
    let own = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    own.flat_map(|thread| {
        let text = std::fs::read_to_string(thread.path().join("children")).unwrap_or_default();
        text.split_whitespace().filter_map(|child| child.parse().ok()).collect::<Vec<libc::pid_t>>()
    })
    .collect()
}

/// What kind of fault an ending is: the check that is named after it, and the words of a report.
pub(super) fn fault(attempt: &Attempt, timeout: Duration) -> Option<(Check, String)> {
    let printed = &attempt.printed;
    match &attempt.ended {
        Ended::Answered(_) | Ended::Interrupted => None,
        Ended::TimedOut => {
            Some((Check::FaultsHang, format!("it did not come back within {} s", timeout.as_secs_f64())))
        }
        Ended::Silent => {
            Some((Check::FaultsExit, "it closed the checker's channel, or wrote over its memory".to_owned()))
        }
        Ended::Gone(status) => Some(match (status.signal(), status.code()) {
            (Some(libc::SIGABRT), _) if thrown(printed) => {
                (Check::FaultsException, "an exception or a panic got out of it (SIGABRT)".to_owned())
            }
            (Some(libc::SIGABRT), _) => (Check::FaultsAbort, "it called abort (SIGABRT)".to_owned()),
            (Some(_), _) if attempt.crumb.touched == super::slate::Touched::Stack => {
                (Check::FaultsStack, "it overflowed the stack".to_owned())
            }
            (Some(number), _) => {
                let name = wearlaw_law::isolate::process::signal_name(number);
                (Check::FaultsSignal, format!("it ended by {name}"))
            }
            (None, code) => {
                let code = code.unwrap_or_default();
                (Check::FaultsExit, format!("it ended the program with exit code {code}"))
            }
        }),
    }
}

/// Whether the last words are those of a language's runtime that found nobody to catch what was thrown.
fn thrown(printed: &str) -> bool {
    let words = [
        "terminate called",
        "terminating due to uncaught exception",
        "terminating with uncaught",
        "cannot catch foreign exceptions",
        "panicked at",
        "in a function that cannot unwind",
    ];
    words.iter().any(|words| printed.contains(words))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_process_of_somebody_else_is_not_taken_for_one_that_was_left_behind() {
        let mut other = std::process::Command::new("sleep").arg("20").spawn().expect("sleep is everywhere");
        let id = other.id() as libc::pid_t;
        assert!(!is_left_behind(id, &BTreeSet::new(), "wearlaw"));
        other.kill().and_then(|()| other.wait()).expect("it is a child of this process");
    }

    #[test]
    fn a_marked_process_is_one_unless_it_runs_for_a_check() {
        let mut marked =
            std::process::Command::new("sleep").arg("20").env(FAMILY, "1").spawn().expect("sleep is there");
        let id = marked.id();
        // Between fork and exec it has this process's own environment.
        let patience = Instant::now() + Duration::from_secs(5);
        while !is_left_behind(id as libc::pid_t, &BTreeSet::new(), "wearlaw") && Instant::now() < patience {
            std::thread::sleep(Duration::from_millis(1));
        }
        assert!(is_left_behind(id as libc::pid_t, &BTreeSet::new(), "wearlaw"));
        assert!(!is_left_behind(id as libc::pid_t, &BTreeSet::from([id]), "wearlaw"));
        marked.kill().and_then(|()| marked.wait()).expect("it is a child of this process");
    }

    #[test]
    fn runtimes_say_when_something_was_thrown() {
        assert!(thrown("terminate called after throwing an instance of 'std::domain_error'"));
        assert!(thrown("thread 'main' panicked at src/lib.rs:3:5:"));
        assert!(!thrown("no such table"));
    }
}
