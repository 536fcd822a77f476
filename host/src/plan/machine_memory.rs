//! How much memory the machine has, so that a scene that cannot fit is refused before it takes any.

/// Bytes of memory and swap space of this machine; `None` where the system does not tell.
pub(super) fn machine_memory() -> Option<u64> {
    std::fs::read_to_string("/proc/meminfo").ok().as_deref().and_then(total)
}

/// Memory and swap space in the system's table, whose lines give kibibytes.
fn total(table: &str) -> Option<u64> {
    let entry = |name: &str| {
        let line = table.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'))?;
        line.split_whitespace().next()?.parse::<u64>().ok()
    };
    entry("MemTotal")?.checked_add(entry("SwapTotal").unwrap_or(0))?.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_and_swap_space_are_added() {
        assert_eq!(total("MemTotal:  100 kB\nMemFree: 1 kB\nSwapTotal: 20 kB\n"), Some(120 * 1024));
        assert_eq!(total("MemTotal:  100 kB\n"), Some(100 * 1024));
        assert_eq!(total("MemTotal: much\n"), None);
        assert_eq!(total("SwapTotal: 20 kB\n"), None);
    }
}
