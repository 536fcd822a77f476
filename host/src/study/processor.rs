//! The clock of the processors.
#![allow(unsafe_code)] // reason: asks the system for its clock of this process.

/// Time that the processors spent on all threads of this process; s. NaN where the system has no such clock.
pub(super) fn seconds() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the pointer is to a timespec of this function, which the call writes and does not keep.
    let status = unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut time) };
    if status == 0 { time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64 } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::seconds;

    #[test]
    fn it_runs_while_something_is_done() {
        let begin = seconds();
        let mut sum = 0_u64;
        // Ends only if the clock goes on.
        while seconds() - begin < 1e-3 {
            sum = std::hint::black_box(sum + 1);
        }
        assert!(begin > 0.0 && seconds() >= begin + 1e-3);
    }
}
