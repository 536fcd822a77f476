//! Increments in 128-bit integers, by none of the formulas of the kernel: logarithms one bit at a
//! time by squaring, exponentials by the series of e^x.

/// `mantissa / 2^127` times `2^exponent`, the mantissa with its top bit set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wide {
    mantissa: u128,
    exponent: i64,
}

/// High half of the product of two 128-bit numbers.
fn high(a: u128, b: u128) -> u128 {
    const LOW: u128 = u64::MAX as u128;
    let (a1, a0, b1, b0) = (a >> 64, a & LOW, b >> 64, b & LOW);
    let mid = a1 * b0 + ((a0 * b0) >> 64);
    let mid2 = a0 * b1 + (mid & LOW);
    a1 * b1 + (mid >> 64) + (mid2 >> 64)
}

/// Binary places of a fixed-point logarithm.
const PLACES: u32 = 112;
/// ln 2 in units of 2^-128.
const LN2: u128 = 0xb172_17f7_d1cf_79ab_c9e3_b398_03f2_f6af;

impl Wide {
    pub(super) fn new(x: f64) -> Self {
        assert!(x > 0.0 && x.is_finite());
        let bits = x.to_bits();
        let (mantissa, exponent) = match bits >> 52 {
            0 => (bits, -1022),
            e => ((bits & ((1 << 52) - 1)) | (1 << 52), e as i64 - 1023),
        };
        let shift = mantissa.leading_zeros() - 11;
        Self { mantissa: u128::from(mantissa) << (75 + shift), exponent: exponent - i64::from(shift) }
    }

    pub(super) fn times(self, b: Self) -> Self {
        let product = high(self.mantissa, b.mantissa);
        let exponent = self.exponent + b.exponent;
        if product >> 127 == 1 {
            Self { mantissa: product, exponent: exponent + 1 }
        } else {
            Self { mantissa: product << 1, exponent }
        }
    }

    /// Quotient by a double.
    pub(super) fn over(self, b: f64) -> Self {
        let b = Self::new(b);
        let divisor = b.mantissa >> 75;
        let (q, r) = (self.mantissa / divisor, self.mantissa % divisor);
        let q = (q << 52) + ((r << 52) / divisor);
        let shift = q.leading_zeros();
        // q is 2^127 times the quotient of the mantissas before the shift.
        Self { mantissa: q << shift, exponent: self.exponent - b.exponent - i64::from(shift) }
    }

    /// log2 in units of 2^-112.
    fn log2(self) -> i128 {
        let mut fraction = 0i128;
        let mut x = self.mantissa;
        for _ in 0..PLACES {
            let square = high(x, x);
            fraction <<= 1;
            if square >> 127 == 1 {
                fraction |= 1;
                x = square;
            } else {
                x = square << 1;
            }
        }
        (i128::from(self.exponent) << PLACES) + fraction
    }

    /// `self^m` by its logarithm; good to about 2^-100 m log2(self).
    fn log2_power(self, m: f64) -> i128 {
        let log = self.log2();
        let magnitude = log.unsigned_abs();
        let w = Self::new(m.abs());
        // magnitude * mantissa of m / 2^127 * 2^exponent
        let product = high(magnitude << 1, w.mantissa);
        let product = if w.exponent >= 0 {
            product << w.exponent
        } else {
            product.checked_shr((-w.exponent) as u32).unwrap_or(0)
        } as i128;
        if (log < 0) == (m < 0.0) { product } else { -product }
    }

    fn exp2(t: i128) -> Self {
        let exponent = (t >> PLACES) as i64;
        let fraction = (t & ((1 << PLACES) - 1)) as u128;
        // x = f ln 2 in units of 2^-127; e^x = sum of x^i / i!.
        let x = high(fraction << (128 - PLACES), LN2) >> 1;
        let (mut term, mut sum) = (1u128 << 127, 1u128 << 127);
        for i in 1..40 {
            term = (high(term, x) << 1) / i;
            sum += term;
        }
        Self { mantissa: sum, exponent }
    }

    /// `self p^m v^n`, `|m log2 p|` and `|n log2 v|` below 16384.
    pub(super) fn by_powers(self, p: f64, v: f64, m: f64, n: f64) -> Self {
        let t = Self::new(p).log2_power(m) + Self::new(v).log2_power(n);
        self.times(Self::exp2(t))
    }

    /// How far `x` is off, in units of the last place of a double of this size.
    pub(super) fn ulps(self, x: f64) -> f64 {
        assert!(x.is_finite() && x > 0.0, "{x:e} for {self:?}");
        let w = Self::new(x);
        let place = (self.exponent - 52).max(-1074);
        // Both in units of 2^-50 of a last place.
        let count = |w: Self| {
            let shift = w.exponent - 127 - place + 50;
            if shift >= 0 { w.mantissa << shift } else { w.mantissa >> -shift }
        };
        count(self).abs_diff(count(w)) as f64 / (1u64 << 50) as f64
    }
}

#[test]
fn knows_roots_and_powers() {
    let one = Wide::new(1.0);
    assert!(one.by_powers(2.0, 1.0, 0.5, 1.0).ulps(2f64.sqrt()) <= 0.5);
    assert!(one.by_powers(9.0, 4.0, 0.5, -0.5).ulps(1.5) < 1e-12);
    assert!(one.by_powers(10.0, 1.0, 22.0, 1.0).ulps(1e22) < 1e-12);
    assert!(Wide::new(1e-9).over(7.0).ulps(1e-9 / 7.0) <= 0.5);
    assert!(Wide::new(5e-324).over(3e-310).ulps(5e-324 / 3e-310) <= 0.5);
    assert!(one.by_powers(3.0, 1.0, 5.0, 1.0).ulps(243.0 * (1.0 + f64::EPSILON)) > 0.99);
}
