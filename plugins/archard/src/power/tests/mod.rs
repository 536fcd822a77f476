//! Tests of the power kernel: against 128-bit integers and a table, at the edges, and bit by bit
//! between instructions, batch sizes and column steps.

mod accuracy;
mod edges;
mod known;
mod parity;
mod reference;
mod steady;

use super::{Column, Inputs, Instructions, increments_by};

/// A repeatable sequence of numbers (SplitMix64).
struct Sequence(u64);

impl Sequence {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `low..high`.
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A power of ten with its exponent uniform in `low..high`.
    fn decade(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.within(low, high))
    }
}

/// The constants of a batch of two columns.
#[derive(Clone, Copy, Debug)]
struct Law {
    m: f64,
    n: f64,
    k: f64,
    h: f64,
    dt: f64,
}

/// The bare power.
fn power(m: f64, n: f64) -> Law {
    Law { m, n, k: 1.0, h: 1.0, dt: 1.0 }
}

impl Law {
    fn inputs<'a>(&'a self, p: &'a [f64], v: &'a [f64]) -> Inputs<'a> {
        Inputs {
            pressure: Column::each(p),
            velocity: Column::each(v),
            m: Column::uniform(&self.m),
            n: Column::uniform(&self.n),
            coefficient: Column::uniform(&self.k),
            hardness: Column::uniform(&self.h),
            dt: self.dt,
        }
    }

    /// Increments and slopes of a batch.
    fn batch(&self, by: Instructions, p: &[f64], v: &[f64]) -> (Vec<f64>, Vec<f64>) {
        evaluate(by, &self.inputs(p, v), p.len())
    }

    /// The increment and slope of one point.
    fn point(&self, p: f64, v: f64) -> (f64, f64) {
        let (w, s) = self.batch(Instructions::Best, &[p], &[v]);
        (w[0], s[0])
    }
}

fn evaluate(by: Instructions, inputs: &Inputs, points: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut w, mut s) = (vec![f64::NAN; points], vec![f64::NAN; points]);
    increments_by(by, inputs, &mut w, Some(&mut s));
    let mut alone = vec![f64::NAN; points];
    increments_by(by, inputs, &mut alone, None);
    assert_eq!(bits(&alone), bits(&w), "asking for slopes changed the increments");
    (w, s)
}

/// Bits, with every NaN the same.
fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|x| if x.is_nan() { 1 } else { x.to_bits() }).collect()
}
