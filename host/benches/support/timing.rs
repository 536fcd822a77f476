//! The program's own timing, and the numbers that are timed.

pub use wearlaw::bench::placed::Placed;
#[allow(unused_imports)] // no benchmark uses all of it
pub use wearlaw::bench::timing::{Side, Times, in_turns, triad, triad_on};

/// Whether the figures are wanted (`cargo bench`) or only that everything runs and agrees (`cargo test`).
pub fn is_measured() -> bool {
    std::env::args().any(|argument| argument == "--bench")
}

/// A pool of `threads` threads.
pub fn pool(threads: usize) -> rayon::ThreadPool {
    wearlaw::bench::timing::pool(threads).expect("threads can be started")
}

/// Pressures 1e6..2e8 and speeds 0.1..0.6, the same at every start.
pub fn columns(points: usize) -> (Vec<f64>, Vec<f64>) {
    let at = |i: usize, k: u64| (((i as u64).wrapping_mul(k) >> 7) % 1000) as f64 / 1000.0;
    let pressure = (0..points).map(|i| 1e6 + 2e8 * at(i, 2_654_435_761)).collect();
    let velocity = (0..points).map(|i| 0.1 + 0.5 * at(i, 40_503)).collect();
    (pressure, velocity)
}

/// The [`columns`] in a room for three, and the third, for answers.
pub fn filled(place: &mut Placed) -> [&mut [f64]; 3] {
    let places: [&mut [f64]; 3] = place.columns().try_into().expect("room for three columns");
    let (pressure, velocity) = columns(places[0].len());
    places[0].copy_from_slice(&pressure);
    places[1].copy_from_slice(&velocity);
    places
}
