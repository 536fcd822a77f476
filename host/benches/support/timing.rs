//! Interleaved timing, and the triad that speed of memory is measured by.

use std::hint::black_box;
use std::time::Instant;

/// One side of a comparison: does its work some number of times.
pub type Side<'a> = Box<dyn FnMut(usize) + 'a>;

/// Times of one side, s per call.
#[derive(Clone, Debug)]
pub struct Times {
    /// Sorted.
    pub all: Vec<f64>,
}

impl Times {
    /// Of times in any order.
    pub fn new(mut all: Vec<f64>) -> Times {
        all.sort_by(f64::total_cmp);
        Times { all }
    }

    /// The smallest.
    pub fn least(&self) -> f64 {
        self.all[0]
    }

    /// The one in the middle.
    pub fn median(&self) -> f64 {
        self.all[self.all.len() / 2]
    }
}

/// Whether the figures are wanted (`cargo bench`) or only that everything runs and agrees (`cargo test`).
pub fn is_measured() -> bool {
    std::env::args().any(|argument| argument == "--bench")
}

/// Runs the sides in turns, `calls` calls each, `rounds` times over.
pub fn in_turns(rounds: usize, calls: usize, sides: &mut [Side<'_>]) -> Vec<Times> {
    let mut all = vec![Vec::with_capacity(rounds); sides.len()];
    sides.iter_mut().for_each(|side| side(1));
    for round in 0..rounds {
        for place in 0..sides.len() {
            // Not always behind the same neighbour.
            let place = if round % 2 == 0 { place } else { sides.len() - 1 - place };
            let begin = Instant::now();
            sides[place](calls);
            all[place].push(begin.elapsed().as_secs_f64() / calls as f64);
        }
    }
    all.into_iter().map(Times::new).collect()
}

/// a = b + s c (McCalpin, STREAM): two numbers in and one out a point, 24 bytes.
pub fn triad(a: &mut [f64], b: &[f64], c: &[f64], s: f64) {
    for (a, (b, c)) in a.iter_mut().zip(b.iter().zip(c)) {
        *a = b + s * c;
    }
}

/// [`triad`] in as many parts as `pool` has threads.
pub fn triad_on(pool: &rayon::ThreadPool, a: &mut [f64], b: &[f64], c: &[f64], s: f64) {
    match pool.current_num_threads() {
        1 => triad(a, b, c, s),
        threads => {
            let part = a.len().div_ceil(threads);
            pool.scope(|scope| {
                for ((a, b), c) in a.chunks_mut(part).zip(b.chunks(part)).zip(c.chunks(part)) {
                    scope.spawn(move |_| triad(a, b, c, s));
                }
            });
        }
    }
    black_box(a);
}

/// A pool of `threads` threads.
pub fn pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started")
}

/// Pressures 1e6..2e8 and speeds 0.1..0.6, the same at every start.
pub fn columns(points: usize) -> (Vec<f64>, Vec<f64>) {
    let at = |i: usize, k: u64| (((i as u64).wrapping_mul(k) >> 7) % 1000) as f64 / 1000.0;
    let pressure = (0..points).map(|i| 1e6 + 2e8 * at(i, 2_654_435_761)).collect();
    let velocity = (0..points).map(|i| 0.1 + 0.5 * at(i, 40_503)).collect();
    (pressure, velocity)
}
