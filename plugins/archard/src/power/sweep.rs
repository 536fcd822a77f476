//! The loops over adjacent points, compiled once for AVX2 and FMA and once for any processor.
#![allow(unsafe_code)] // One call of a function compiled for AVX2 and FMA, after asking for both.

use super::batch::Instructions;
use super::constants::Constants;
use super::double::Double;
use super::exact;
use super::kernel::{ABSENT, GENERAL, LINEAR, conclude, logarithm};
use super::linear;

/// Points that go through the stages of a general power together.
const STRIP: usize = 32;

/// Evaluates adjacent points; all slices have the length of `out`. True if the kernel for these exponents has answered
/// at every point: finite increments from inputs that are finite, a base with exponent 0 aside.
pub(super) fn run<C: Constants>(
    instructions: Instructions,
    p: &[f64],
    v: &[f64],
    constants: C,
    out: &mut [f64],
    slope: Option<&mut [f64]>,
) -> bool {
    #[cfg(target_arch = "x86_64")]
    {
        let fused = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        if instructions == Instructions::Best && fused {
            // SAFETY: `run_avx2` demands AVX2 and FMA; the processor was asked for both just above.
            unsafe { run_avx2(p, v, constants, out, slope) }
        } else {
            run_any(p, v, constants, out, slope)
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        let _ = instructions;
        choose(p, v, constants, out, slope)
    }
}

/// [`choose`] compiled for AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn run_avx2<C: Constants>(p: &[f64], v: &[f64], constants: C, out: &mut [f64], slope: Option<&mut [f64]>) -> bool {
    choose(p, v, constants, out, slope)
}

/// Without fused multiply-add in hardware a loop has nothing to gain over single points, which the
/// mathematics library's `fma` bounds; so these loops are not compiled a second time.
#[cfg(target_arch = "x86_64")]
fn run_any<C: Constants>(p: &[f64], v: &[f64], constants: C, out: &mut [f64], slope: Option<&mut [f64]>) -> bool {
    let constants = constants.ready();
    if constants.kinds() == (LINEAR, LINEAR) && slope.is_none() {
        if !products::<C, LINEAR, LINEAR, false>(p, v, constants, out, &mut []) {
            return true;
        }
    } else {
        out.fill(f64::NAN);
    }
    finish(p, v, constants, out, slope);
    false
}

#[inline(always)]
fn choose<C: Constants>(p: &[f64], v: &[f64], constants: C, out: &mut [f64], mut slope: Option<&mut [f64]>) -> bool {
    let constants = constants.ready();
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
    if left {
        finish(p, v, constants, out, slope);
    }
    !left
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
        let slope = if SLOPE { &mut slope[start..start + len] } else { &mut [] };
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
            let a = Double { hi: ah[i], lo: al[i] };
            let b = Double { hi: bh[i], lo: bl[i] };
            let o = conclude::<M, N>(p[i], v[i], a, b, m, n, c);
            out[i] = o.wear;
            if SLOPE {
                slope[i] = o.slope;
            }
            left |= u64::from(o.wear.is_nan() | constants.odd(i));
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
        let (o, doubtful) = linear::products::<M, N>(p[i], v[i], constants.value(i));
        out[i] = o.wear;
        if SLOPE {
            slope[i] = o.slope;
        }
        left |= u64::from(doubtful);
    }
    if left != 0 {
        for i in 0..len {
            out[i] = linear::lane::<M, N>(p[i], v[i], constants.value(i)).wear;
        }
    }
    left != 0
}

/// Evaluates the points that a sweep left unanswered, and those whose kind it did not serve.
#[inline(always)]
fn finish<C: Constants>(p: &[f64], v: &[f64], constants: C, out: &mut [f64], mut slope: Option<&mut [f64]>) {
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
