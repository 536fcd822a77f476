//! Random numbers that are the same on every machine for the same seed.

use wearlaw_contact::splitmix::{STEP, mixed};

/// SplitMix64: one word of state, good enough to pick inputs.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// Numbers of this seed, and of their own for every `stream`.
    pub fn new(seed: u64, stream: &str) -> Self {
        // FNV-1a, so that checks do not share their numbers.
        let hash = stream
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
        Self(seed.wrapping_mul(STEP) ^ hash)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        let bits = mixed(self.0);
        self.0 = self.0.wrapping_add(STEP);
        bits
    }

    /// A number from 0, below 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number between two.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A number between two positive ones, every decade as likely as any other.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        (self.between(low.log10(), high.log10()) * std::f64::consts::LN_10).exp()
    }

    /// A whole number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        (self.bits() % end.max(1) as u64) as usize
    }

    /// A unit vector, every direction as likely as any other.
    pub fn direction(&mut self) -> [f64; 3] {
        let height = self.between(-1.0, 1.0);
        let angle = self.between(0.0, std::f64::consts::TAU);
        let radius = (1.0 - height * height).sqrt();
        [radius * angle.cos(), radius * angle.sin(), height]
    }

    /// Puts a list into a random order.
    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        for end in (1..list.len()).rev() {
            list.swap(end, self.below(end + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_and_a_stream_give_the_same_numbers_and_another_gives_others() {
        let first = |seed, stream| Random::new(seed, stream).bits();
        assert_eq!(first(1, "a"), first(1, "a"));
        assert_ne!(first(1, "a"), first(2, "a"));
        assert_ne!(first(1, "a"), first(1, "b"));
    }

    #[test]
    fn numbers_stay_where_they_should() {
        let mut random = Random::new(1, "range");
        for _ in 0..1000 {
            assert!((2.0..3.0).contains(&random.between(2.0, 3.0)));
            assert!((0.99e-3..1.01e3).contains(&random.decades(1e-3, 1e3)));
            assert!(random.below(7) < 7);
            let [x, y, z] = random.direction();
            assert!((x * x + y * y + z * z - 1.0).abs() < 1e-12);
        }
        let mut list: Vec<usize> = (0..50).collect();
        random.shuffle(&mut list);
        assert!(!list.is_sorted());
        list.sort_unstable();
        assert_eq!(list, (0..50).collect::<Vec<_>>());
    }
}
