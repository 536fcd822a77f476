//! Unevaluated sums of two doubles ("double-double") and the error-free steps under them.
//!
//! Every function is branch-free and made of IEEE additions, products and fused
//! multiply-adds, so that the compiler may evaluate lanes side by side without a changed bit.
//! Sources: Dekker, Numer. Math. 18 (1971) 224; Knuth, TAOCP 2, 4.2.2; Joldes, Muller and
//! Popescu, ACM TOMS 44 (2017) 15.

/// `a + b` and its rounding error, exactly, if `|a| >= |b|` or `a = 0` (Dekker).
#[inline(always)]
pub(super) fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// `a + b` and its rounding error, exactly (Knuth).
#[inline(always)]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let c = s - a;
    (s, (a - (s - c)) + (b - c))
}

/// `a b` and its rounding error, exactly unless the error is below the smallest double.
#[inline(always)]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let h = a * b;
    (h, a.mul_add(b, -h))
}

/// 0 if `x` is finite, else not a number: a condition that costs one subtraction.
#[allow(clippy::eq_op)] // The point of it.
#[inline(always)]
pub(super) fn doubt(x: f64) -> f64 {
    x - x
}

/// `hi + lo` with `|lo| <= ulp(hi) / 2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Double {
    /// The sum rounded to double.
    pub(super) hi: f64,
    /// What `hi` leaves out.
    pub(super) lo: f64,
}

impl Double {
    /// The double `x`.
    #[inline(always)]
    pub(super) const fn from(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// Sum, relative error below 3 * 2^-106.
    #[inline(always)]
    pub(super) fn plus(self, b: Self) -> Self {
        let (s, e) = two_sum(self.hi, b.hi);
        let (t, f) = two_sum(self.lo, b.lo);
        let (s, e) = fast_two_sum(s, e + t);
        let (hi, lo) = fast_two_sum(s, e + f);
        Self { hi, lo }
    }

    /// Product, relative error below 5 * 2^-106.
    #[inline(always)]
    pub(super) fn times(self, b: Self) -> Self {
        let (h, e) = two_product(self.hi, b.hi);
        let cross = self.hi.mul_add(b.lo, self.lo * b.hi);
        let (hi, lo) = fast_two_sum(h, e + cross);
        Self { hi, lo }
    }

    /// Product with a double, relative error below 2 * 2^-106.
    #[inline(always)]
    pub(super) fn scaled(self, b: f64) -> Self {
        let (h, e) = two_product(self.hi, b);
        let (hi, lo) = fast_two_sum(h, self.lo.mul_add(b, e));
        Self { hi, lo }
    }

    /// Quotient, relative error below 10 * 2^-106.
    #[inline(always)]
    pub(super) fn over(self, b: Self) -> Self {
        let q = self.hi / b.hi;
        let r = (-q).mul_add(b.hi, self.hi);
        let r = (-q).mul_add(b.lo, r + self.lo);
        let (hi, lo) = fast_two_sum(q, r / b.hi);
        Self { hi, lo }
    }
}
