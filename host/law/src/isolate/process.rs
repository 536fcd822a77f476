//! Worker processes: started so that they end with the parent, watched, and ended with all that they started.
#![allow(unsafe_code)] // reason: prctl, pidfd, poll and kill have no safe wrapper in the standard library.

use std::collections::BTreeSet;
use std::io;
use std::os::fd::{AsRawFd, BorrowedFd, FromRawFd, OwnedFd, RawFd};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// A worker process; dropping it ends it and everything that it started.
pub struct Process {
    child: Child,
    /// Becomes readable when the process ends, even if a process that it started holds its pipes open.
    ended: Option<OwnedFd>,
    status: Option<ExitStatus>,
    /// The variable that it and all that it starts bear, as it stands in their environment.
    mark: String,
}

/// Name of the variable that a worker and all that it starts bear; its value tells the worker.
pub const FAMILY: &str = "WEARLAW_FAMILY";

/// What came first.
pub enum Event {
    /// There is something to read.
    Readable,
    /// The process ended.
    Ended,
    /// The time was up.
    Deadline,
}

impl Process {
    /// Starts `program` with inherited descriptors; what a law prints goes to `printed`.
    pub fn start(
        program: &Path,
        arguments: Vec<String>,
        inherited: Vec<RawFd>,
        printed: BorrowedFd<'_>,
    ) -> io::Result<Self> {
        let mut command = Command::new(program);
        command.args(arguments).stdin(Stdio::null());
        command.stdout(printed.try_clone_to_owned()?).stderr(printed.try_clone_to_owned()?);
        let parent = std::process::id();
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let family = format!("{parent}-{}", NEXT.fetch_add(1, Ordering::Relaxed));
        command.env(FAMILY, &family);
        // SAFETY: between fork and exec only async-signal-safe calls are made, and nothing is allocated.
        unsafe { command.pre_exec(move || before_exec(parent, &inherited)) };
        let child = {
            // Nobody is to find it before it is on the list.
            let mut started = started();
            let child = spawn_from_lasting_thread(command)?;
            started.insert(child.id());
            child
        };
        // SAFETY: the call takes two integers and touches no memory.
        let ended = unsafe { libc::syscall(libc::SYS_pidfd_open, child.id() as libc::pid_t, 0) };
        let ended = (ended >= 0).then(|| {
            // SAFETY: the descriptor was just made and belongs to nobody else.
            unsafe { OwnedFd::from_raw_fd(ended as RawFd) }
        });
        Ok(Self { child, ended, status: None, mark: format!("{FAMILY}={family}") })
    }

    /// Waits until `pipe` can be read, the process ends or time is up.
    pub fn wait_for(&self, pipe: RawFd, deadline: Duration) -> io::Result<Event> {
        let end = Instant::now().checked_add(deadline);
        let watched = self.ended.as_ref().map_or(-1, AsRawFd::as_raw_fd);
        loop {
            let left = end.map_or(Duration::MAX, |end| end.saturating_duration_since(Instant::now()));
            // Rounded up, so that a millisecond's rest is not spent in a busy loop.
            let milliseconds = i32::try_from(left.as_nanos().div_ceil(1_000_000)).unwrap_or(i32::MAX);
            let mut wanted = [pipe, watched].map(|fd| libc::pollfd { fd, events: libc::POLLIN, revents: 0 });
            // SAFETY: the array holds two entries and lives through the call.
            let ready = unsafe { libc::poll(wanted.as_mut_ptr(), 2, milliseconds) };
            if ready < 0 {
                let error = io::Error::last_os_error();
                if error.kind() == io::ErrorKind::Interrupted {
                    continue;
                }
                return Err(error);
            }
            return Ok(match (wanted[0].revents, wanted[1].revents) {
                (pipe, _) if pipe & libc::POLLIN != 0 => Event::Readable,
                (0, 0) if left.is_zero() => Event::Deadline,
                (0, 0) => continue,
                _ => Event::Ended,
            });
        }
    }

    /// The number of the process.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// How a process ended whose channel was closed; none if it still runs after `patience`. It is not ended here.
    pub fn ended(&mut self, patience: Duration) -> Option<ExitStatus> {
        // A process that dies closes its pipes a moment before it can be waited for.
        let patience = Instant::now() + patience;
        loop {
            if self.status.is_none() {
                self.status = self.child.try_wait().ok().flatten();
            }
            if self.status.is_some() || Instant::now() >= patience {
                return self.status;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// Says what became of a process whose channel was closed, and ends it if it still runs.
    pub(super) fn fate(&mut self) -> String {
        let Some(status) = self.ended(Duration::from_millis(500)) else {
            self.end();
            return "closed the channel of its worker process".to_owned();
        };
        self.end();
        match (status.signal(), status.code()) {
            (Some(signal), _) => format!("crashed ({})", signal_name(signal)),
            (_, Some(code)) => format!("ended its worker process with exit code {code}"),
            (None, None) => format!("ended its worker process ({status})"),
        }
    }

    /// Ends the process and everything that it started, and reaps what can be reaped.
    pub fn end(&mut self) {
        let group = self.child.id() as libc::pid_t;
        let mut family = Vec::new();
        if self.status.is_none() {
            self.status = self.child.try_wait().ok().flatten();
        }
        if self.status.is_none() {
            signal(group, libc::SIGSTOP);
            // Its children may have children of their own meanwhile: once more, until no new one is found.
            for _ in 0..16 {
                let fresh: Vec<libc::pid_t> =
                    descendants(group).into_iter().filter(|process| !family.contains(process)).collect();
                if fresh.is_empty() {
                    break;
                }
                fresh.iter().for_each(|process| signal(*process, libc::SIGKILL));
                family.extend(fresh);
            }
            signal(group, libc::SIGKILL);
            self.status = self.child.wait().ok();
        }
        // What a crashed worker left behind is still in its process group.
        signal(-group, libc::SIGKILL);
        family.push(-group);
        reap(family);
        self.end_strays();
        started().remove(&self.id());
    }

    /// Ends what had left the worker's group: with the worker gone it is a child of this process, and bears the mark.
    fn end_strays(&self) {
        for _ in 0..16 {
            let mut strays = descendants(std::process::id() as libc::pid_t);
            strays.retain(|process| bears(*process, &self.mark));
            if strays.is_empty() {
                break;
            }
            strays.iter().for_each(|process| signal(*process, libc::SIGKILL));
            reap(strays);
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.end();
    }
}

/// Numbers of the processes that were started here and not yet ended; none is started while this is held.
pub fn started() -> MutexGuard<'static, BTreeSet<u32>> {
    static STARTED: Mutex<BTreeSet<u32>> = Mutex::new(BTreeSet::new());
    STARTED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Sends a signal to a process of a worker's family, or with a negative number to a group.
pub fn signal(process: libc::pid_t, number: i32) {
    // SAFETY: the call takes two integers; the process is a child that has not been waited for, one below it, or the
    // group that this module made for it.
    unsafe { libc::kill(process, number) };
}

/// Whether a process was started with this variable, or by a process that was.
fn bears(process: libc::pid_t, mark: &str) -> bool {
    let environment = std::fs::read(format!("/proc/{process}/environ")).unwrap_or_default();
    environment.split(|byte| *byte == 0).any(|variable| variable == mark.as_bytes())
}

/// How long processes that were killed may take to be gone.
const REAPING: Duration = Duration::from_secs(2);

/// Takes the ended processes of a worker's family off the list: they are this process's children once it is gone.
///
/// A negative number stands for a group.
pub fn reap(mut left: Vec<libc::pid_t>) {
    let patience = Instant::now() + REAPING;
    while !left.is_empty() && Instant::now() < patience {
        left.retain(|process| {
            // SAFETY: a null pointer means that the status is not wanted.
            let answer = unsafe { libc::waitpid(*process, std::ptr::null_mut(), libc::WNOHANG) };
            // Of a group there may be more; an error means that there is none, or one whose parent is only just dying.
            let dying = || *process > 0 && Path::new(&format!("/proc/{process}")).exists();
            answer == 0 || (answer > 0 && *process < 0) || (answer < 0 && dying())
        });
        if !left.is_empty() {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

/// The processes below one, the nearest first, as far as they can be seen.
pub fn descendants(process: libc::pid_t) -> Vec<libc::pid_t> {
    let mut found = Vec::new();
    let mut open = vec![process];
    while let Some(parent) = open.pop() {
        let Ok(threads) = std::fs::read_dir(format!("/proc/{parent}/task")) else {
            continue;
        };
        for thread in threads.flatten() {
            let children = std::fs::read_to_string(thread.path().join("children")).unwrap_or_default();
            for child in children.split_whitespace().filter_map(|child| child.parse().ok()) {
                if !found.contains(&child) {
                    found.push(child);
                    open.push(child);
                }
            }
        }
    }
    found
}

/// Runs in the child between fork and exec.
fn before_exec(parent: u32, inherited: &[RawFd]) -> io::Result<()> {
    let check = |answer: libc::c_int| {
        if answer < 0 { Err(io::Error::last_os_error()) } else { Ok(()) }
    };
    // SAFETY: async-signal-safe calls with integers only.
    unsafe {
        // A group of its own: an interrupt from the terminal is the parent's to handle, and the group can be ended.
        check(libc::setpgid(0, 0))?;
        check(libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGKILL))?;
        check(libc::prctl(libc::PR_SET_CHILD_SUBREAPER, 1))?;
        if libc::getppid() as u32 != parent {
            // The parent died before it could be asked to send the signal.
            libc::_exit(1);
        }
        for descriptor in inherited {
            check(libc::fcntl(*descriptor, libc::F_SETFD, 0))?;
        }
    }
    Ok(())
}

type Job = (Command, Sender<io::Result<Child>>);

/// The death signal comes when the thread that started the child ends, so one thread that never ends starts them all.
fn spawn_from_lasting_thread(command: Command) -> io::Result<Child> {
    static SPAWNER: OnceLock<Mutex<Sender<Job>>> = OnceLock::new();
    let spawner = SPAWNER.get_or_init(|| {
        let (jobs, queue) = channel::<Job>();
        // SAFETY: takes integers; what a worker leaves behind becomes a child of this process, which reaps it.
        unsafe { libc::prctl(libc::PR_SET_CHILD_SUBREAPER, 1) };
        std::thread::spawn(move || {
            for (mut command, answer) in queue {
                // Nobody waits any more: the child is dropped, and its closed channel ends it.
                let _ = answer.send(command.spawn());
            }
        });
        Mutex::new(jobs)
    });
    let (answer, answered) = channel();
    let gone = || io::Error::other("the thread that starts workers is gone");
    spawner.lock().unwrap_or_else(PoisonError::into_inner).send((command, answer)).map_err(|_| gone())?;
    answered.recv().map_err(|_| gone())?
}

/// A signal by its number and name, with what it tells.
pub fn signal_name(number: i32) -> String {
    let name = match number {
        libc::SIGSEGV => "SIGSEGV, it touched memory that is not its own",
        libc::SIGBUS => "SIGBUS",
        libc::SIGABRT => "SIGABRT, it aborted",
        libc::SIGFPE => "SIGFPE",
        libc::SIGILL => "SIGILL",
        libc::SIGKILL => "SIGKILL, it was killed",
        libc::SIGTERM => "SIGTERM",
        libc::SIGTRAP => "SIGTRAP",
        _ => return format!("signal {number}"),
    };
    format!("signal {number}, {name}")
}
