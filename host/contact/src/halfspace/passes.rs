//! Passes over long arrays, in chunks whose bounds do not depend on the number of threads: so sums have the same bits.
//!
//! Threads share chunks through `dyn Fn`: one call for 8192 numbers, and the joining of threads is compiled once.

use std::ops::Range;

use rayon::prelude::*;

/// Numbers in a chunk.
const CHUNK: usize = 8192;
/// Sums side by side, so that additions do not wait for each other.
const LANES: usize = 8;
/// Length from which threads pay for themselves.
pub const WORTH: usize = 1 << 15;

/// What a function makes of each chunk of 0..count, in order.
pub fn each_chunk<T: Send>(threads: usize, count: usize, of: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    let chunks = count.div_ceil(CHUNK);
    let one = |chunk: usize| of(chunk * CHUNK..count.min((chunk + 1) * CHUNK));
    if threads > 1 && count >= WORTH { shared(chunks, &one) } else { (0..chunks).map(one).collect() }
}

/// What a function makes of each of 0..chunks, in order, by the threads of the pool.
fn shared<T: Send>(chunks: usize, one: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let mut made = Vec::new();
    (0..chunks).into_par_iter().map(one).collect_into_vec(&mut made);
    made
}

/// Sum of a function over 0..count.
pub fn sum(threads: usize, count: usize, of: impl Fn(usize) -> f64 + Sync) -> f64 {
    let part = |range: Range<usize>| {
        // Four at a time, so that additions do not wait for each other.
        let mut lanes = [0.0; 4];
        let whole = range.start + range.len() / 4 * 4;
        for at in (range.start..whole).step_by(4) {
            for (lane, sum) in lanes.iter_mut().enumerate() {
                *sum += of(at + lane);
            }
        }
        (whole..range.end).fold((lanes[0] + lanes[1]) + (lanes[2] + lanes[3]), |sum, at| sum + of(at))
    };
    if count <= CHUNK { part(0..count) } else { each_chunk(threads, count, part).into_iter().sum() }
}

/// Sum of products.
pub fn dot(threads: usize, a: &[f64], b: &[f64]) -> f64 {
    let part = |range: Range<usize>| {
        let (a, b) = (a[range.clone()].chunks_exact(LANES), b[range].chunks_exact(LANES));
        let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
        let mut lanes = [0.0; LANES];
        for (a, b) in a.zip(b) {
            for lane in 0..LANES {
                lanes[lane] += a[lane] * b[lane];
            }
        }
        lanes.into_iter().sum::<f64>() + rest
    };
    each_chunk(threads, a.len().min(b.len()), part).into_iter().sum()
}

/// to += factor * other.
pub fn add(threads: usize, to: &mut [f64], factor: f64, other: &[f64]) {
    let one = |to: &mut [f64], other: &[f64]| to.iter_mut().zip(other).for_each(|(to, other)| *to += factor * other);
    if threads > 1 && to.len() >= WORTH {
        to.par_chunks_mut(CHUNK).zip(other.par_chunks(CHUNK)).for_each(|(to, other)| one(to, other));
    } else {
        one(to, other);
    }
}

/// Changes every number of an array, knowing its place.
pub fn change(threads: usize, values: &mut [f64], to: impl Fn(usize, f64) -> f64 + Sync) {
    let one = |first: usize, values: &mut [f64]| {
        values.iter_mut().enumerate().for_each(|(at, value)| *value = to(first + at, *value));
    };
    if threads > 1 && values.len() >= WORTH {
        shared_out(values, &one);
    } else {
        one(0, values);
    }
}

/// Gives each chunk of an array and its first place to a function, by the threads of the pool.
fn shared_out(values: &mut [f64], one: &(dyn Fn(usize, &mut [f64]) + Sync)) {
    values.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, values)| one(chunk * CHUNK, values));
}
