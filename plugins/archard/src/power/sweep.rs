//! The loops over adjacent points, compiled once for AVX2 and FMA and once for any processor.
#![allow(unsafe_code)] // One call of a function compiled for AVX2 and FMA, after asking for both.

use super::batch::Instructions;
use super::double::Double;
use super::exact;
use super::kernel::{ABSENT, GENERAL, LINEAR, conclude, kind, logarithm};
use super::linear;
use super::scale::Scale;

/// Points that go through the stages of a general power together.
const STRIP: usize = 64;

/// What a loop over points asks of its constants.
pub(super) trait Constants: Copy {
    /// Whether [`Constants::odd`] may hold anywhere.
    const VARY: bool;
    /// m, n and (K/H) dt at point `i` of the block.
    fn at(&self, i: usize) -> (f64, f64, Scale);
    /// The factor as a double, where only that is needed.
    fn value(&self, i: usize) -> f64;
    /// The kinds that stand for every m and every n; [`GENERAL`] if they vary.
    fn kinds(&self) -> (u8, u8);
    /// Whether [`Constants::kinds`] is wrong at point `i`.
    fn odd(&self, i: usize) -> bool;
    /// The constants of points `start..start + len`, so that the compiler sees the lengths agree.
    fn part(self, start: usize, len: usize) -> Self;
}

/// The same constants at every point.
#[derive(Clone, Copy)]
pub(super) struct Uniform {
    m: f64,
    n: f64,
    c: Scale,
    value: f64,
}

impl Uniform {
    pub(super) fn new(m: f64, n: f64, c: Scale) -> Self {
        let value = c.value();
        Self { m, n, c, value }
    }
}

impl Constants for Uniform {
    const VARY: bool = false;

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
    fn odd(&self, _: usize) -> bool {
        false
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
    const VARY: bool = true;

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
    fn odd(&self, i: usize) -> bool {
        let (m, n) = self.kinds;
        kind(self.m[i]) != m || kind(self.n[i]) != n
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

/// Evaluates adjacent points; all slices have the length of `out`.
pub(super) fn run<C: Constants>(
    instructions: Instructions,
    p: &[f64],
    v: &[f64],
    constants: C,
    out: &mut [f64],
    slope: Option<&mut [f64]>,
) {
    #[cfg(target_arch = "x86_64")]
    {
        let fused = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        if instructions == Instructions::Best && fused {
            // SAFETY: `run_avx2` demands AVX2 and FMA; the processor was asked for both just above.
            unsafe { run_avx2(p, v, constants, out, slope) }
        } else {
            run_any(p, v, constants, out, slope);
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        let _ = instructions;
        choose(p, v, constants, out, slope);
    }
}

/// [`choose`] compiled for AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn run_avx2<C: Constants>(
    p: &[f64],
    v: &[f64],
    constants: C,
    out: &mut [f64],
    slope: Option<&mut [f64]>,
) {
    choose(p, v, constants, out, slope);
}

/// Without fused multiply-add in hardware a loop has nothing to gain over single points, which the
/// mathematics library's `fma` bounds; so these loops are not compiled a second time.
#[cfg(target_arch = "x86_64")]
fn run_any<C: Constants>(
    p: &[f64],
    v: &[f64],
    constants: C,
    out: &mut [f64],
    slope: Option<&mut [f64]>,
) {
    if constants.kinds() == (LINEAR, LINEAR) && slope.is_none() {
        if products::<C, LINEAR, LINEAR, false>(p, v, constants, out, &mut []) {
            finish(p, v, constants, out, slope);
        }
    } else {
        out.fill(f64::NAN);
        finish(p, v, constants, out, slope);
    }
}

#[inline(always)]
fn choose<C: Constants>(
    p: &[f64],
    v: &[f64],
    constants: C,
    out: &mut [f64],
    mut slope: Option<&mut [f64]>,
) {
    macro_rules! by_kind {
        ($($by:ident $m:ident $n:ident),*) => {
            match (constants.kinds(), slope.as_deref_mut()) {
                $((($m, $n), None) => $by::<C, $m, $n, false>(p, v, constants, out, &mut []),
                (($m, $n), Some(slope)) => $by::<C, $m, $n, true>(p, v, constants, out, slope),)*
                _ => unreachable!("kind() knows no other kinds"),
            }
        };
    }
    let left = by_kind!(
        sweep GENERAL GENERAL, sweep GENERAL LINEAR, sweep LINEAR GENERAL, sweep GENERAL ABSENT,
        sweep ABSENT GENERAL, products LINEAR LINEAR, products LINEAR ABSENT,
        products ABSENT LINEAR, products ABSENT ABSENT
    );
    if left || C::VARY {
        finish(p, v, constants, out, slope);
    }
}

/// Evaluates every point by the kernel of one pair of kinds; whether some are left unanswered.
///
/// The chain from a pressure to its increment is longer than a processor looks ahead, so a strip of
/// points goes through it in three short loops, each with many points under way.
#[inline(always)]
fn sweep<C: Constants, const M: u8, const N: u8, const SLOPE: bool>(
    p: &[f64],
    v: &[f64],
    constants: C,
    out: &mut [f64],
    slope: &mut [f64],
) -> bool {
    let mut left = 0u64;
    let [mut ah, mut al, mut bh, mut bl] = [[0.0; STRIP]; 4];
    for start in (0..out.len()).step_by(STRIP) {
        let len = STRIP.min(out.len() - start);
        let (p, v) = (&p[start..start + len], &v[start..start + len]);
        let out = &mut out[start..start + len];
        let slope = if SLOPE {
            &mut slope[start..start + len]
        } else {
            &mut []
        };
        let constants = constants.part(start, len);
        if M == GENERAL {
            logarithms(|i| constants.at(i).0, p, &mut ah[..len], &mut al[..len]);
        }
        if N == GENERAL {
            logarithms(|i| constants.at(i).1, v, &mut bh[..len], &mut bl[..len]);
        }
        let (ah, al, bh, bl) = (&ah[..len], &al[..len], &bh[..len], &bl[..len]);
        for i in 0..len {
            let (m, n, c) = constants.at(i);
            let a = Double {
                hi: ah[i],
                lo: al[i],
            };
            let b = Double {
                hi: bh[i],
                lo: bl[i],
            };
            let o = conclude::<M, N>(p[i], v[i], a, b, m, n, c);
            out[i] = o.wear;
            if SLOPE {
                slope[i] = o.slope;
            }
            left |= u64::from(o.wear.is_nan());
        }
    }
    left != 0
}

#[inline(always)]
fn logarithms(exponent: impl Fn(usize) -> f64, x: &[f64], hi: &mut [f64], lo: &mut [f64]) {
    let len = x.len();
    let (hi, lo) = (&mut hi[..len], &mut lo[..len]);
    for i in 0..len {
        let t = logarithm(exponent(i), x[i]);
        hi[i] = t.hi;
        lo[i] = t.lo;
    }
}

/// [`sweep`] for kinds without a logarithm.
#[inline(always)]
fn products<C: Constants, const M: u8, const N: u8, const SLOPE: bool>(
    p: &[f64],
    v: &[f64],
    constants: C,
    out: &mut [f64],
    slope: &mut [f64],
) -> bool {
    let len = out.len();
    let (p, v, constants) = (&p[..len], &v[..len], constants.part(0, len));
    let slope = &mut slope[..if SLOPE { len } else { 0 }];
    let mut left = 0u64;
    for i in 0..len {
        let o = linear::lane::<M, N>(p[i], v[i], constants.value(i));
        out[i] = o.wear;
        if SLOPE {
            slope[i] = o.slope;
        }
        left |= u64::from(o.wear.is_nan());
    }
    left != 0
}

/// Evaluates the points that a sweep left unanswered, and those whose kind it did not serve.
#[inline(always)]
fn finish<C: Constants>(
    p: &[f64],
    v: &[f64],
    constants: C,
    out: &mut [f64],
    mut slope: Option<&mut [f64]>,
) {
    for i in 0..out.len() {
        if out[i].is_nan() || constants.odd(i) {
            let (m, n, c) = constants.at(i);
            let o = exact::point(p[i], v[i], m, n, c);
            out[i] = o.wear;
            if let Some(slope) = &mut slope {
                slope[i] = o.slope;
            }
        }
    }
}
