//! What may be left of checks: processes, threads, descriptors, shared memory, and this process's own memory.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

/// What this process has.
#[derive(Debug)]
pub struct Own {
    pub children: usize,
    pub threads: usize,
    pub descriptors: usize,
    /// Mappings and descriptors of memory that it shares with workers.
    pub shared: usize,
    /// Resident memory, KiB.
    pub memory: i64,
}

impl Own {
    /// Counts it, once threads that were joined are gone.
    pub fn count() -> Self {
        std::thread::sleep(Duration::from_millis(100));
        let status = fs::read_to_string("/proc/self/status").expect("there is a /proc");
        let number = |key: &str| {
            let line = status.lines().find(|line| line.starts_with(key)).expect("the line is there");
            line.split_whitespace().nth(1).and_then(|word| word.parse::<i64>().ok()).expect("a number")
        };
        let maps = fs::read_to_string("/proc/self/maps").expect("there is a /proc");
        let descriptors = entries("/proc/self/fd");
        let links = descriptors.iter().filter_map(|path| fs::read_link(path).ok());
        let is_shared = |text: &str| text.contains("memfd:wearlaw");
        let shared = links.filter(|link| is_shared(&link.to_string_lossy())).count();
        Self {
            children: entries("/proc/self/task").iter().map(|task| children(task)).sum(),
            threads: number("Threads:") as usize,
            descriptors: descriptors.len(),
            shared: shared + maps.lines().filter(|line| is_shared(line)).count(),
            memory: number("VmRSS:"),
        }
    }
}

fn entries(folder: &str) -> Vec<std::path::PathBuf> {
    fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
}

fn children(task: &Path) -> usize {
    fs::read_to_string(task.join("children")).unwrap_or_default().split_whitespace().count()
}

/// Every process of the machine, by its folder in `/proc`.
fn processes(wanted: impl Fn(&Path) -> bool) -> Vec<String> {
    let is_process = |path: &std::path::PathBuf| {
        path.file_name().is_some_and(|name| name.to_string_lossy().bytes().all(|byte| byte.is_ascii_digit()))
    };
    let found = entries("/proc").into_iter().filter(is_process).filter(|path| wanted(path));
    found
        .map(|path| {
            let words = fs::read(path.join("cmdline")).unwrap_or_default();
            format!("{} {}", path.display(), String::from_utf8_lossy(&words).replace('\0', " "))
        })
        .collect()
}

fn holds(bytes: &[u8], word: &str) -> bool {
    bytes.windows(word.len()).any(|window| window == word.as_bytes())
}

/// Processes that carry the mark of workers of the checker `checker`.
pub fn of_worker(checker: u32) -> Vec<String> {
    let mark = format!("WEARLAW_CHECK_WORKER={checker}-");
    processes(|path| holds(&fs::read(path.join("environ")).unwrap_or_default(), &mark))
}

/// Processes of a checker that is gone: marked, with a law of this folder loaded, or run by such a law.
///
/// Those that were run sleep for `long` seconds.
pub fn escaped(checker: u32, folder: &Path, long: &str) -> Vec<String> {
    let laws = folder.display().to_string();
    let mut found = of_worker(checker);
    found.extend(processes(|path| {
        let file = |name: &str| fs::read(path.join(name)).unwrap_or_default();
        holds(&file("maps"), &laws) || holds(&file("cmdline"), &format!("sleep\0{long}\0"))
    }));
    found
}

/// What is still found after some seconds: the dying take a moment.
pub fn patiently_none(find: impl Fn() -> Vec<String>) -> Vec<String> {
    let end = Instant::now() + Duration::from_secs(5);
    loop {
        let found = find();
        if found.is_empty() || Instant::now() > end {
            return found;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}
