//! The constants of a batch as its loops see them: one for all points, or one each.

use super::kernel::{GENERAL, kind};
use super::scale::Scale;

/// What a loop over points asks of its constants.
pub(super) trait Constants: Copy {
    /// m, n and (K/H) dt at point `i` of the block.
    fn at(&self, i: usize) -> (f64, f64, Scale);
    /// The factor as a double, where only that is needed.
    fn value(&self, i: usize) -> f64;
    /// The kinds that stand for every m and every n; [`GENERAL`] if they vary.
    fn kinds(&self) -> (u8, u8);
    /// Whether [`Constants::kinds`] is wrong at point `i`.
    fn odd(&self, i: usize) -> bool;
    /// Computes what all points share; called where fused multiply-adds are fast.
    fn ready(self) -> Self;
    /// The constants of points `start..start + len`, so that the compiler sees the lengths agree.
    fn part(self, start: usize, len: usize) -> Self;
}

/// The same constants at every point.
#[derive(Clone, Copy)]
pub(super) struct Uniform {
    m: f64,
    n: f64,
    parts: (f64, f64, f64),
    c: Scale,
    value: f64,
}

impl Uniform {
    /// Constants whose factor is still to be computed from K, H and dt.
    pub(super) fn new(m: f64, n: f64, parts: (f64, f64, f64)) -> Self {
        let (c, value) = (Scale::ONE, 1.0);
        Self { m, n, parts, c, value }
    }
}

impl Constants for Uniform {
    #[inline(always)]
    fn at(&self, _: usize) -> (f64, f64, Scale) {
        (self.m, self.n, self.c)
    }
    #[inline(always)]
    fn value(&self, _: usize) -> f64 {
        self.value
    }
    fn kinds(&self) -> (u8, u8) {
        (kind(self.m), kind(self.n))
    }
    #[inline(always)]
    fn odd(&self, _: usize) -> bool {
        false
    }
    #[inline(always)]
    fn ready(self) -> Self {
        let (k, h, dt) = self.parts;
        let c = Scale::from_parts(k, h, dt);
        let value = c.value();
        Self { c, value, ..self }
    }
    #[inline(always)]
    fn part(self, _: usize, _: usize) -> Self {
        self
    }
}

/// Constants of one point each.
#[derive(Clone, Copy)]
pub(super) struct Each<'a> {
    pub(super) kinds: (u8, u8),
    pub(super) m: &'a [f64],
    pub(super) n: &'a [f64],
    pub(super) k: &'a [f64],
    pub(super) h: &'a [f64],
    pub(super) dt: f64,
}

impl Constants for Each<'_> {
    #[inline(always)]
    fn at(&self, i: usize) -> (f64, f64, Scale) {
        let c = Scale::from_parts(self.k[i], self.h[i], self.dt);
        (self.m[i], self.n[i], c)
    }
    #[inline(always)]
    fn value(&self, i: usize) -> f64 {
        Scale::from_parts(self.k[i], self.h[i], self.dt).value()
    }
    fn kinds(&self) -> (u8, u8) {
        self.kinds
    }
    #[inline(always)]
    fn odd(&self, i: usize) -> bool {
        let (m, n) = (self.m[i], self.n[i]);
        let odd_m = (self.kinds.0 == GENERAL) & ((m == 0.0) | (m == 1.0));
        let odd_n = (self.kinds.1 == GENERAL) & ((n == 0.0) | (n == 1.0));
        odd_m | odd_n
    }
    #[inline(always)]
    fn ready(self) -> Self {
        self
    }
    #[inline(always)]
    fn part(self, start: usize, len: usize) -> Self {
        Self {
            m: &self.m[start..start + len],
            n: &self.n[start..start + len],
            k: &self.k[start..start + len],
            h: &self.h[start..start + len],
            ..self
        }
    }
}
