//! Interleaved timing, and the triad that speed of memory is measured by.

use std::hint::black_box;
use std::time::Instant;

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// One side of a comparison: does its work some number of times.
pub type Side<'a> = Box<dyn FnMut(usize) + 'a>;

/// Times of one side, s per call.
#[derive(Clone, Debug)]
pub struct Times {
    /// Sorted.
    all: Vec<f64>,
}

impl Times {
    /// Of times in any order.
    ///
    /// # Panics
    /// If there is none.
    pub fn new(mut all: Vec<f64>) -> Times {
        assert!(!all.is_empty(), "no times");
        all.sort_by(f64::total_cmp);
        Times { all }
    }

    /// The smallest: what the side takes undisturbed.
    pub fn least(&self) -> f64 {
        self.all[0]
    }

    /// The one in the middle.
    pub fn median(&self) -> f64 {
        self.all[self.all.len() / 2]
    }

    /// How many there are.
    pub fn rounds(&self) -> usize {
        self.all.len()
    }
}

/// Runs the sides in turns, `calls` calls each, `rounds` times over.
pub fn in_turns(rounds: usize, calls: usize, sides: &mut [Side<'_>]) -> Vec<Times> {
    sides.iter_mut().for_each(|side| side(1));
    let calls = vec![calls; sides.len()];
    in_turns_until(&calls, sides, |done| done == rounds)
}

/// Runs the sides in turns, `calls[k]` calls of side `k`, until `enough` of the rounds that are done; at least one.
///
/// # Panics
/// If there are fewer numbers of calls than sides.
pub fn in_turns_until(calls: &[usize], sides: &mut [Side<'_>], mut enough: impl FnMut(usize) -> bool) -> Vec<Times> {
    let mut all = vec![Vec::new(); sides.len()];
    for round in 0.. {
        for place in 0..sides.len() {
            // Not always behind the same neighbour.
            let place = if round % 2 == 0 { place } else { sides.len() - 1 - place };
            all[place].push(seconds(calls[place], &mut sides[place]));
        }
        if enough(round + 1) {
            break;
        }
    }
    all.into_iter().map(Times::new).collect()
}

/// Wall time of a call of a side, in the mean over `calls` of them, s.
pub fn seconds(calls: usize, side: &mut Side<'_>) -> f64 {
    let begin = Instant::now();
    side(calls);
    begin.elapsed().as_secs_f64() / calls as f64
}

/// Bytes that a triad moves at each point.
pub const TRIAD_BYTES: usize = 24;

/// a = b + s c (McCalpin, STREAM): two numbers in and one out a point.
pub fn triad(a: &mut [f64], b: &[f64], c: &[f64], s: f64) {
    for (a, (b, c)) in a.iter_mut().zip(b.iter().zip(c)) {
        *a = b + s * c;
    }
}

/// [`triad`] in as many parts as `pool` has threads.
pub fn triad_on(pool: &ThreadPool, a: &mut [f64], b: &[f64], c: &[f64], s: f64) {
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
///
/// # Errors
/// If the system gives no threads.
pub fn pool(threads: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    ThreadPoolBuilder::new().num_threads(threads).build()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_and_median_are_those_of_the_times() {
        let times = Times::new(vec![3.0, 1.0, 7.0]);
        assert_eq!((times.least(), times.median(), times.rounds()), (1.0, 3.0, 3));
    }

    #[test]
    fn sides_take_turns_with_their_own_numbers_of_calls() {
        let seen = std::cell::RefCell::new(Vec::new());
        let mut sides: Vec<Side<'_>> = vec![
            Box::new(|calls| seen.borrow_mut().push(("a", calls))),
            Box::new(|calls| seen.borrow_mut().push(("b", calls))),
        ];
        let times = in_turns_until(&[2, 5], &mut sides, |done| done == 3);
        drop(sides);
        assert!(times.iter().all(|times| times.rounds() == 3 && times.least() >= 0.0));
        assert_eq!(seen.into_inner(), [("a", 2), ("b", 5), ("b", 5), ("a", 2), ("a", 2), ("b", 5)]);
    }

    #[test]
    fn a_triad_in_parts_is_the_triad() {
        let (b, c): (Vec<f64>, Vec<f64>) = (0..1001).map(|i| (f64::from(i), 0.5 * f64::from(i))).unzip();
        let [mut one, mut two] = [0, 1].map(|_| vec![0.0; b.len()]);
        triad(&mut one, &b, &c, 3.0);
        triad_on(&pool(2).unwrap(), &mut two, &b, &c, 3.0);
        assert!(one == two && one[1000] == 2500.0);
    }
}
