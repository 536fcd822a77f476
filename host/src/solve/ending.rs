//! How runs end, whatever drives them.

use crate::record::HistoryRow;
use crate::scene::Stop;

/// Which limit of `[stop]` a row has reached, in words; `None`: neither.
pub(super) fn stop_reached(stop: &Stop, row: &HistoryRow) -> Option<String> {
    let reached = |name: &str, value: f64, limit: Option<f64>| {
        limit
            .filter(|limit| value >= *limit)
            .map(|limit| format!("{name} reached {value:e}, `stop.{name}` is {limit:e}, at time {}", row.time))
    };
    reached("wear_depth", row.max_wear_depth, stop.wear_depth)
        .or_else(|| reached("wear_volume", row.wear_volume.unwrap_or(0.0), stop.wear_volume))
}

/// Most memory that this process has held; 0 where the system does not tell.
pub(super) fn peak_memory() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) * 1024
}
