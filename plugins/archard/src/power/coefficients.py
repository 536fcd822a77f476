#!/usr/bin/env python3
"""Prints `coefficients.rs`: polynomials of the power kernel, and the table of known values.

    python3 coefficients.py > coefficients.rs
    python3 coefficients.py table > tests/known.rs

Needs mpmath. Every polynomial interpolates its function at Chebyshev nodes in 260-bit
arithmetic (near minimax); the printed largest error includes the rounding of the
coefficients to double.
"""
import struct
import sys

from mpmath import atanh, cos, log, lu_solve, matrix, mp, mpf, pi, sqrt

mp.prec = 260


def nodes(lo, hi, n):
    return [(lo + hi) / 2 + (hi - lo) / 2 * cos(pi * (2 * i + 1) / (2 * n)) for i in range(n)]


def fit(g, lo, hi, degree):
    """Coefficients, rounded to double, of the interpolant of g on [lo, hi]."""
    n = degree + 1
    xs = nodes(mpf(lo), mpf(hi), n)
    a = matrix(n, n)
    b = matrix(n, 1)
    for i, x in enumerate(xs):
        b[i] = g(x)
        for j in range(n):
            a[i, j] = x**j
    return [mpf(float(c)) for c in lu_solve(a, b)]


def worst(g, cs, lo, hi):
    err = mpf(0)
    for i in range(2001):
        x = mpf(lo) + (mpf(hi) - lo) * i / 2000
        if x != 0:
            err = max(err, abs(sum(c * x**i for i, c in enumerate(cs)) - g(x)))
    return err


def rust(x):
    return repr(float(x))


def dd(x):
    hi = mpf(float(x))
    return hi, mpf(float(x - hi))


LN2 = log(mpf(2))
C0 = 2 / LN2
C1 = C0 / 3


def log_tail(z):
    """(log2((1+s)/(1-s)) / s - C0 - C1 z) / z^2 with z = s^2."""
    if z < mpf(10) ** -12:
        return C0 / 5 + C0 / 7 * z + C0 / 9 * z * z
    s = sqrt(z)
    return (C0 * atanh(s) / s - C0 - C1 * z) / z**2


def exp_tail(f):
    """(2^f - 1 - f ln 2) / f^2."""
    if abs(f) < mpf(10) ** -15:
        return LN2**2 / 2 + LN2**3 / 6 * f + LN2**4 / 24 * f * f
    return (mpf(2) ** f - 1 - f * LN2) / f**2


def tables():
    zmax = ((sqrt(mpf(2)) - 1) / (sqrt(mpf(2)) + 1)) ** 2 * (1 + mpf(2) ** -40)
    lg = fit(log_tail, 0, zmax, 6)
    lw = worst(log_tail, lg, 0, zmax)
    half = mpf(1) / 2 * (1 + mpf(2) ** -40)
    ex = fit(exp_tail, -half, half, 9)
    ew = worst(exp_tail, ex, -half, half)
    out = ["//! Constants of the power kernel, written by `coefficients.py`; do not edit.",
           "",
           "// Each decimal is the shortest that reads back as the double meant.",
           "#![allow(clippy::excessive_precision, clippy::approx_constant)]", ""]

    def const(name, doc, x):
        hi, lo = dd(x)
        out.append(f"/// {doc}, rounded to double.")
        out.append(f"pub(super) const {name}_HI: f64 = {rust(hi)};")
        out.append(f"/// What `{name}_HI` leaves out.")
        out.append(f"pub(super) const {name}_LO: f64 = {rust(lo)};")

    const("C0", "2 / ln 2", C0)
    out.append("/// 2 / (3 ln 2), rounded to double.")
    out.append(f"pub(super) const C1: f64 = {rust(C1)};")
    const("LN2", "ln 2", LN2)

    def table(name, doc, cs):
        out.append("")
        for d in doc:
            out.append(f"/// {d}")
        out.append(f"pub(super) const {name}: [f64; {len(cs)}] = [")
        out.extend(f"    {rust(c)}," for c in cs)
        out.append("];")

    table("LOG_TAIL", ["`(log2((1 + s) / (1 - s)) / s - C0 - C1 z) / z^2` in `z = s^2`, for `|s| <= 3 - sqrt 8`;",
                       f"largest error 2^{float(log(lw, 2)):.1f}."], lg)
    table("EXP_TAIL", ["`(2^f - 1 - f ln 2) / f^2` for `|f| <= 1/2`;",
                       f"largest error 2^{float(log(ew, 2)):.1f}."], ex)
    print("\n".join(out))


def bits(x):
    return "0x%016x" % struct.unpack("<Q", struct.pack("<d", x))[0]


def known():
    """Increments c p^m v^n as the nearest double, exact to 260 bits before rounding."""
    import random
    r = random.Random(20240607)
    rows = []

    def row(k, h, dt, p, v, m, n):
        k, h, dt, p, v, m, n = map(float, (k, h, dt, p, v, m, n))
        mp.prec = 3000
        w = mpf(k) / mpf(h) * mpf(dt) * mpf(p) ** mpf(m) * mpf(v) ** mpf(n)
        g = float(w)
        mp.prec = 260
        rows.append(f"    [{', '.join(bits(x) for x in (k, h, dt, p, v, m, n, g))}],")

    row(1e-300, 1, 1, 1e9, 1, 40, 1)
    row(1e-200, 1e200, 1, 1e9, 1, 20, 1)
    row(1e-320, 1, 1, 1e9, 1, 34, 1)
    row(5e-324, 1, 1, 1e300, 1e20, 1, 1)
    row(1e300, 1e-300, 1e-300, 1e-200, 1e-100, 1, 1)
    row(1e-300, 1e300, 1, 1e300, 1e300, 1, 1)
    row(1e-300, 1e10, 1, 1e300, 1e-20, 1, 1)
    row(1, 1, 1, 1e300, 1e-300, 400, 400)
    row(1, 1, 1, 1e300, 1.0000001e-300, 401, 401)
    row(1e-100, 3, 1e-200, 1e300, 1e-200, 3, 1.5)
    row(1, 1, 1, 1 + 2.0**-52, 1 - 2.0**-53, 1e18, 1e18)
    row(1, 1, 1, 1 + 2.0**-30, 1, 1e11, 2)
    row(1, 1, 1, 5e-324, 1, 0.5, 1)
    row(1, 1, 1, 5e-324, 3e-310, 0.3, -0.7)
    row(1, 1, 1, 1e-310, 1e5, 1, 0.3)
    row(1e-300, 1, 1, 1e-20, 1, 1, 1)
    row(1e-300, 1, 1, 1e-20, 1.7, 1.1, 1)
    row(1, 1, 1, 2, 1, -1073.5, 1)
    row(1, 1, 1, 2, 1, 1023.9999999, 1)
    row(1, 1, 1, 2, 3, 0, 1000.5 / 1.6)
    row(1, 1, 1, 1.7e308, 2e-308, -3.25, -3.2)
    row(1e-310, 2e-310, 3, 1e5, 1e-3, 1.2, 0.8)
    for _ in range(150):
        u = r.uniform
        row(10 ** u(-300, 300), 10 ** u(-5, 15), 10 ** u(-9, 9), 10 ** u(-60, 60),
            10 ** u(-60, 60), u(-6, 6), u(-6, 6))
    for _ in range(150):
        m = 10 ** r.uniform(0.5, 6)
        n = 10 ** r.uniform(0.5, 6)
        t = r.uniform(-900, 900)
        a = r.uniform(-1.5e3, 1.5e3)
        row(1, 1, 1, 2 ** max(-1020, min(1020, a / m)), 2 ** max(-1020, min(1020, (t - a) / n)), m, n)
    print("//! Increments known to the last bit, written by `coefficients.py table`; do not edit.\n")
    print("/// Bits of K, H, dt, p, v, m, n and of the double nearest to (K/H) dt p^m v^n.")
    print("#[rustfmt::skip]")
    print(f"pub(super) static KNOWN: [[u64; 8]; {len(rows)}] = [")
    print("\n".join(rows))
    print("];")


if __name__ == "__main__":
    known() if sys.argv[1:] == ["table"] else tables()
