//! The increment `w = (K/H) dt p^m v^n` and its derivative `m w / p`, over batches.
//!
//! Here are the arithmetic and the loops; columns come in as slices, increments go out. What a zero
//! or an infinity means to a law, and every check of constants, is left to the law. Nothing here
//! fails: what has no answer comes out as infinite or as not a number.
//!
//! # What comes out
//!
//! | input | increment |
//! | --- | --- |
//! | `p <= 0` | 0 (and slope 0) whatever the exponents, 0^0 included |
//! | `v = 0` | 0 for `n > 0`, the rate without `v` for `n = 0`, infinite for `n < 0` |
//! | `v < 0` | that of `|v|` |
//! | `n = 0` | `v` is not looked at, not even whether it is a number |
//! | K = 0 or `dt` = 0 | 0 |
//! | anything else not finite; H = 0 | not a number |
//! | a result beyond the range of doubles | infinite, or 0 |
//!
//! So with `n != 0` an increment that is finite proves inputs that are.
//!
//! # Method
//!
//! One fused evaluation in place of two powers and a product, rounded once:
//!
//! ```text
//! p = f 2^k,  sqrt(1/2) <= f < sqrt(2)
//! s = (f - 1) / (f + 1),  z = s^2 <= 0.0295
//! log2 p = k + s (C0 + z (C1 + z T(z))),       C0 = 2 / ln 2,  C1 = C0 / 3
//! t = m log2 p + n log2 v = j + g,             j an integer, |g| <= 1/2
//! w = c 2^g 2^(j + e),                         (K/H) dt = c 2^e
//! 2^g = 1 + q,  q = g ln 2 + g^2 E(g);         c 2^g = c_hi + (c_hi q + c_lo)
//! ```
//!
//! Logarithms and `t` are sums of two doubles, since an error of `t` is one of `ln w`. The
//! factor (K/H) dt is a sum of two doubles with an exponent of its own ([`Scale`]), so that nothing
//! overflows only in between. An exponent of 1 multiplies its base into the factor and takes no logarithm;
//! if both are 1 or 0 the increment is the product `(c p) |v|` in doubles. Method: Tang, ACM TOMS 16
//! (1990) 378, and Muller et al., Handbook of Floating-Point Arithmetic (2nd ed.), ch. 11, for the
//! logarithm by `atanh` and the exponential; Dekker and Knuth for the sums of two doubles.
//! `coefficients.py` computes the polynomials T and E.
//!
//! # Errors
//!
//! Bounds in units of 2^-53, relative:
//!
//! | source | bound |
//! | --- | --- |
//! | `z (C1 + ..)` in double: 2^-59.3 in `log2 p`, hence 2^-59.8 (m + n) in `w` | 0.09 at m + n = 10, 0.28 at 32 |
//! | truncated T: 2^-63.8 in `log2 p` | 0.005 at m + n = 10 |
//! | truncated and rounded E: g^2 2^-53.8 | 0.2 |
//! | `q` rounded | 0.25 to 0.35 |
//! | `c_hi q + c_lo` rounded (exact for c = 1) | 0 to 0.35 |
//! | the one rounding of the result | 0.5 to 1 |
//!
//! Measured over 120 000 random points in the range p = 1e-6..1e12, v = 1e-9..1e3, m, n = 0.1..5:
//! 0.93 ulp for the power, 1.3 ulp for the increment, 2.7 ulp for its slope; 2.1 ulp for the increment at
//! m = n = 1, which is three products in doubles.
//!
//! Beyond `|m| + |n| = 32`, `|m log2 p| + |n log2 v| = 1024`, or an increment outside 2^-960..2^960, and
//! for subnormal bases, single points take logarithms of 100 bits instead (about a
//! hundred times slower), so that even opposite powers of 2^1000000 leave all digits.
//!
//! # The same bits everywhere
//!
//! The formulas are written once, for one point and without a branch. The loops over them
//! are compiled for AVX2 and FMA, where the compiler evaluates four points at a time, and once more for
//! any processor; fused multiply-adds are demanded by name and are correctly rounded in
//! hardware and library alike, and nothing else may be fused or reordered. Which path a point
//! takes depends on that point alone. So bits depend neither on the instructions, nor on the
//! batch, its remainder or a thread.

mod batch;
mod coefficients;
mod constants;
mod double;
mod exact;
mod kernel;
mod linear;
mod scale;
mod steady;
mod sweep;
#[cfg(test)]
mod tests;

pub use batch::{Column, Inputs, Instructions, increments, increments_by};
pub use scale::Scale;
pub use steady::{Wide, steady};
