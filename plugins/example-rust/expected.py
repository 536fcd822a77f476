#!/usr/bin/env python3
"""Prints expected.csv of the law of this folder, computed with 60 digits and rounded once.

usage: python3 expected.py > expected.csv

Needs mpmath. Written from the equation in README.md, not from the law's code.
Columns: the constants by name, the inputs by field (vectors with _x, _y, _z; an empty cell: not given), dt, then the
answers. Every input is a double and is taken exactly as it is; a normal is a unit vector to a double's rounding.
"""
from mpmath import mp, mpf, nstr, sqrt

mp.dps = 60


def rounded(x):
    """The double nearest to x, also where it is subnormal (float() of a decimal text rounds once)."""
    return float(nstr(x, 45))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def scaled(a, factor):
    return [x * factor for x in a]


def law(K, H, softening, T0, tilt, p, slip, T, normal, slip_vector):
    K, H, softening, T0, tilt, p, slip, T = map(mpf, (K, H, softening, T0, tilt, p, slip, T))
    slope = K * slip / (H * (1 - softening * (T - T0)))
    normal = [mpf(x) for x in normal]
    normal = scaled(normal, 1 / sqrt(dot(normal, normal)))
    direction = scaled(normal, -1)
    if slip_vector is not None:
        vector = [mpf(x) for x in slip_vector]
        in_surface = [x - dot(vector, normal) * n for x, n in zip(vector, normal)]
        length = sqrt(dot(in_surface, in_surface))
        if length > 0:
            turned = [n + tilt * s / length for n, s in zip(normal, in_surface)]
            direction = scaled(turned, -1 / sqrt(1 + tilt**2))
    if p <= 0:
        return mpf(0), direction, mpf(0)
    return slope * p, direction, slope


STEEL = (1e-4, 2e9, 5e-4, 293.15)  # K, H, softening, T0
BRASS = (6e-4, 1.1e9, 9.765625e-4, 300.0)
UP, OBLIQUE, ASLANT = (0.0, 0.0, 1.0), (0.6, 0.0, 0.8), (0.36, 0.48, -0.8)
ALONG_X, ALONG_Y = (1e-3, 0.0, 0.0), (0.0, -2e-5, 0.0)

ROWS = [
    # constants, tilt, pressure, slip, temperature, normal, slip_vector
    (STEEL, 0.0, 5e7, 1e-3, 293.15, UP, ALONG_X),
    (STEEL, 0.0, 5e7, 1e-3, 373.15, UP, ALONG_X),
    (STEEL, 0.0, 5e7, 1e-3, 573.15, UP, ALONG_X),
    (STEEL, 0.0, 5e7, 1e-3, 873.15, UP, ALONG_X),
    (STEEL, 0.0, 5e7, 1e-3, 1293.15, UP, ALONG_X),
    (STEEL, 0.0, 5e7, 1e-3, 77.0, UP, ALONG_X),
    (STEEL, 0.0, 5e7, 1e-3, 0.0, UP, ALONG_X),
    (STEEL, 0.0, 1.7e8, 2e-5, 611.7, UP, ALONG_Y),
    # Tilted against the slip.
    (STEEL, 0.1, 5e7, 1e-3, 293.15, UP, ALONG_X),
    (STEEL, 0.1, 5e7, 1e-3, 473.15, UP, (-1e-3, 0.0, 0.0)),
    (STEEL, 0.3, 5e7, 2e-5, 473.15, UP, ALONG_Y),
    (STEEL, 1.0, 5e7, 5e-3, 473.15, UP, (3e-3, -4e-3, 0.0)),
    (STEEL, 10.0, 5e7, 5e-3, 473.15, UP, (3e-3, -4e-3, 0.0)),
    (BRASS, 0.25, 3.3e6, 1e-3, 400.0, OBLIQUE, (0.8e-3, 0.0, -0.6e-3)),
    (BRASS, 0.25, 3.3e6, 1e-3, 400.0, OBLIQUE, (0.0, 1e-3, 0.0)),
    (BRASS, 0.25, 3.3e6, 7e-3, 812.0, ASLANT, (0.8e-3, -0.6e-3, 0.0)),
    (BRASS, 0.7, 3.3e6, 7e-3, 812.0, ASLANT, (4e-9, 3e-9, 3.6e-9)),
    # A net slip shorter than its path, and one that is not quite in the surface.
    (STEEL, 0.3, 5e7, 1e-3, 473.15, UP, (1e-6, 2e-6, 0.0)),
    (STEEL, 0.3, 5e7, 1e-3, 473.15, UP, (1e-4, 2e-4, 5e-6)),
    (STEEL, 0.3, 5e7, 1e-3, 473.15, OBLIQUE, (1e-4, 2e-4, 5e-6)),
    # No net slip, none given, none in the surface: against the normal.
    (STEEL, 0.3, 5e7, 1e-3, 473.15, UP, (0.0, 0.0, 0.0)),
    (STEEL, 0.3, 5e7, 1e-3, 473.15, ASLANT, None),
    (STEEL, 0.3, 5e7, 1e-3, 473.15, UP, (0.0, 0.0, 2e-4)),
    # No contact, no slip, no wear coefficient.
    (STEEL, 0.3, 0.0, 1e-3, 473.15, UP, ALONG_X),
    (STEEL, 0.3, -5e7, 1e-3, 473.15, UP, ALONG_X),
    (STEEL, 0.3, 5e7, 0.0, 473.15, UP, (0.0, 0.0, 0.0)),
    ((0.0, 2e9, 5e-4, 293.15), 0.3, 5e7, 1e-3, 473.15, UP, ALONG_X),
    # No softening; other units (megapascals and millimetres); sizes far apart.
    ((1e-4, 2e9, 0.0, 293.15), 0.3, 5e7, 1e-3, 2000.0, UP, ALONG_X),
    ((1e-4, 2e3, 5e-4, 293.15), 0.3, 50.0, 1.0, 473.15, UP, (1.0, 0.0, 0.0)),
    (STEEL, 0.3, 5e7, 1e-150, 473.15, UP, (6e-151, 8e-151, 0.0)),
    (STEEL, 0.3, 5e7, 1e150, 473.15, UP, (6e149, 8e149, 0.0)),
    ((1e-200, 1e9, 5e-4, 293.15), 0.3, 1e200, 1e-3, 473.15, UP, ALONG_X),
]

VECTOR = ("_x", "_y", "_z")


def main():
    names = ["K", "H", "softening", "T0", "tilt", "pressure", "slip", "temperature"]
    names += ["normal" + c for c in VECTOR] + ["slip_vector" + c for c in VECTOR] + ["dt", "increment"]
    names += ["direction" + c for c in VECTOR] + ["d_pressure"]
    print(",".join(names))
    for constants, tilt, p, slip, T, normal, vector in ROWS:
        increment, direction, slope = law(*constants, tilt, p, slip, T, normal, vector)
        numbers = [*constants, tilt, p, slip, T, *normal]
        numbers += [None] * 3 if vector is None else list(vector)
        numbers += [0.5] + [rounded(x) for x in (increment, *direction, slope)]
        print(",".join("" if x is None else repr(x) for x in numbers))


main()
