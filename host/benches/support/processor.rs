//! Processor time and peak of memory of this process.
#![allow(unsafe_code)] // reason: asks the system for its clock of this process.

/// Time that the processors spent on all threads of this process, s.
pub fn seconds() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the pointer is to a timespec of this function, which the call writes and does not keep.
    let status = unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut time) };
    assert_eq!(status, 0, "the clock of this process");
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// Largest memory of this process so far, MB, as Linux tells it.
pub fn peak_megabytes() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok()).map_or(f64::NAN, |kb| kb / 1024.0)
}
