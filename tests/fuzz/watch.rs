//! Watches over what an input may cost: an input that takes longer or makes the program larger ends it with a message.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Longest time of one input.
const LONGEST: Duration = Duration::from_secs(5);
/// Most memory of the program, in KiB.
const MOST: u64 = 1 << 20;

/// What the thread that watches shares with the one that is watched; times in milliseconds since the beginning.
#[derive(Debug)]
struct Shared {
    begin: Instant,
    /// When the input that is being tried was begun, plus one; 0: none is.
    since: AtomicU64,
    slowest: AtomicU64,
    largest: AtomicU64,
    done: AtomicBool,
}

/// Looks at one target while it lives.
#[derive(Debug)]
pub struct Watch(Arc<Shared>);

/// Memory that the program holds, in KiB; 0 where nobody says.
fn resident() -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or(0)
}

impl Watch {
    /// Begins to watch the target `name`.
    pub fn new(name: &str) -> Self {
        let shared = Arc::new(Shared {
            begin: Instant::now(),
            since: AtomicU64::new(0),
            slowest: AtomicU64::new(0),
            largest: AtomicU64::new(resident()),
            done: AtomicBool::new(false),
        });
        let (seen, name) = (shared.clone(), name.to_owned());
        std::thread::spawn(move || {
            while !seen.done.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(50));
                let size = resident();
                seen.largest.fetch_max(size, Ordering::Relaxed);
                let since = seen.since.load(Ordering::Relaxed);
                let now = seen.begin.elapsed().as_millis() as u64;
                let late = since > 0 && now + 1 > since + LONGEST.as_millis() as u64;
                if late || size > MOST {
                    eprintln!("target {name}: an input takes over {LONGEST:?}, or over 1 GiB: {size} KiB are held");
                    std::process::abort();
                }
            }
        });
        Self(shared)
    }

    /// Does `work` under watch.
    pub fn over<A>(&self, work: impl FnOnce() -> A) -> A {
        let begin = Instant::now();
        self.0.since.store(self.0.begin.elapsed().as_millis() as u64 + 1, Ordering::Relaxed);
        let answer = work();
        self.0.since.store(0, Ordering::Relaxed);
        self.0.slowest.fetch_max(begin.elapsed().as_millis() as u64, Ordering::Relaxed);
        answer
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.0.done.store(true, Ordering::Relaxed);
    }
}

impl fmt::Display for Watch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |number: &AtomicU64| number.load(Ordering::Relaxed);
        write!(
            f,
            "the slowest took {} ms, at most {} MiB were held",
            number(&self.0.slowest),
            number(&self.0.largest) >> 10
        )
    }
}
