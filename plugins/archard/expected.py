#!/usr/bin/env python3
"""Prints expected.csv of the Archard law, computed with 60 digits and rounded once.

usage: python3 expected.py > expected.csv

Needs mpmath. Written from the equation in README.md, not from the law's code.
Columns: the constants by name, the inputs by field, dt, then the answers. Every input is a double and is taken
exactly as it is.
"""
from mpmath import mp, mpf, nstr

mp.dps = 60


def rounded(x):
    """The double nearest to x, also where it is subnormal (float() of a decimal text rounds once)."""
    return float(nstr(x, 45))


def archard(K, H, m, n, p, v, dt):
    K, H, m, n, p, v, dt = map(mpf, (K, H, m, n, p, v, dt))
    if p <= 0:
        return mpf(0), mpf(0)
    v = abs(v)
    speed = mpf(1) if n == 0 else (mpf(0) if v == 0 else v**n)
    rate = K / H * speed
    return rate * p**m * dt, rate * m * p ** (m - 1) * dt


ROWS = [
    # K, H, m, n, pressure, velocity, dt
    # The published linear law, and each input by itself.
    (1e-4, 2e9, 1.0, 1.0, 5e7, 0.2, 1.0),
    (1e-4, 2e9, 1.0, 1.0, 1e8, 0.2, 1.0),
    (1e-4, 2e9, 1.0, 1.0, 5e7, 0.4, 1.0),
    (1e-4, 2e9, 1.0, 1.0, 5e7, 0.2, 0.125),
    (3.3e-5, 7.7e8, 1.0, 1.0, 1.23456789e7, 0.0321, 0.7),
    (2.9e-17, 1.0, 1.0, 1.0, 3.284e8, 1e-3, 18000.0),
    # K holds the speed, as in published decks: n = 0.
    (1e-5, 1.5e3, 1.0, 0.0, 120.0, 0.0, 1.0),
    (1e-5, 1.5e3, 1.0, 0.0, 120.0, 3.7, 1.0),
    (1e-5, 1.5e3, 1.7, 0.0, 120.0, 0.0, 2.0),
    # General exponents.
    (3e-4, 1e3, 1.5, 0.8, 50.0, 0.2, 1.0),
    (2e-4, 1.5e3, 1.25, 0.9, 50.0, 0.2, 0.5),
    (1e-4, 2e9, 0.5, 1.0, 5e7, 0.2, 1.0),
    (1e-4, 2e9, 2.0, 1.0, 5e7, 0.2, 1.0),
    (1e-4, 2e9, 3.0, 2.0, 5e7, 0.2, 1.0),
    (1e-4, 2e9, 1.0, 0.5, 5e7, 0.2, 1.0),
    (1e-4, 2e9, 1.0, 3.3, 5e7, 0.2, 1.0),
    (4.4e-7, 9.1e8, 0.37, 4.9, 6.5e6, 12.5, 1e-3),
    (4.4e-7, 9.1e8, 4.9, 0.37, 6.5e6, 12.5, 1e-3),
    (1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0),
    (1.0, 1.0, 3.3, 2.2, 1.0, 1.0, 1.0),
    # Exponents below zero: falling with speed, and with pressure.
    (1e-4, 2e9, 1.0, -0.5, 5e7, 0.2, 1.0),
    (1e-4, 2e9, -0.5, 1.0, 5e7, 0.2, 1.0),
    # The ends of the range of pressure and velocity.
    (1e-4, 2e9, 0.1, 0.1, 1e-6, 1e-9, 1.0),
    (1e-4, 2e9, 5.0, 5.0, 1e12, 1e3, 1.0),
    (1e-4, 2e9, 5.0, 0.1, 1e-6, 1e3, 1.0),
    (1e-4, 2e9, 0.1, 5.0, 1e12, 1e-9, 1.0),
    (1e-4, 2e9, 2.5, 2.5, 1e-6, 1e-9, 1.0),
    # No contact, no slip, no wear coefficient, no time.
    (1e-4, 2e9, 0.5, 1.0, 0.0, 0.2, 1.0),
    (1e-4, 2e9, 0.0, 1.0, 0.0, 0.2, 1.0),
    (1e-4, 2e9, 2.0, 1.0, -5e7, 0.2, 1.0),
    (1e-4, 2e9, -1.0, 1.0, -5e7, 0.2, 1.0),
    (1e-4, 2e9, 1.5, 0.8, 5e7, 0.0, 1.0),
    (0.0, 2e9, 1.5, 0.8, 5e7, 0.2, 1.0),
    (0.0, 2e9, 40.0, 0.8, 1e30, 0.2, 1.0),
    (1e-4, 2e9, 1.5, 0.8, 5e7, 0.2, 0.0),
    # The sign of the velocity does not count; nor does pressure where m = 0.
    (1e-4, 2e9, 1.0, 1.0, 5e7, -0.2, 1.0),
    (1e-4, 2e9, 1.5, 0.8, 5e7, -0.2, 1.0),
    (1e-4, 2e9, 0.0, 1.0, 5e7, 0.2, 1.0),
    # Factors beyond all doubles, or close to it, with a result that is a double.
    (1e-300, 1.0, 40.0, 1.0, 1e9, 1.0, 1.0),
    (1e-200, 1e200, 20.0, 1.0, 1e9, 1.0, 1.0),
    (1e-320, 1.0, 34.0, 1.0, 1e9, 1.0, 1.0),
    (1e-250, 1e10, 30.0, -10.0, 1e9, 1e-3, 1.0),
    (1e200, 1e10, 20.0, 1.0, 1e-9, 1.0, 1.0),
    (1.0, 1.0, 20.0, 1.0, 1e-9, 1.0, 1e-130),
    (1e-300, 1e8, 1.0, 1.0, 3.0, 0.5, 1.0),
]

# Every pair of exponents at points of every size, under constants of every size in turn.
CONSTANTS = [(1e-4, 2e9, 1.0), (3.7e-5, 1.3e9, 0.0625), (1e-170, 7e-150, 2.5e20), (1e130, 3e12, 1e-140)]  # K, H, dt
POINTS = [  # pressure, velocity
    (5.1e7, 0.23),
    (3.3e-5, -0.31),
    (2e-310, 0.7),
    (6e120, 1.3),
    (1.7e8, 6e-130),
    (0.0, 0.2),
    (-4e6, 0.2),
    (9.1e6, 4e-311),
    (0.6, 0.45),
]
EXPONENTS = [(m, n) for m in (1.0, 0.0, 0.5, 2.37, -0.75) for n in (1.0, 0.0, 0.8, -0.6)]

# Factors and products below the normal range, and the whole numbers among the exponents once more.
MORE = [
    (1e-200, 1e100, 1.0, 1.0, 3.7e-12, 1.3e100, 1.0),
    (1e-200, 1e100, 0.0, 1.0, 3.7e-12, 1.3e100, 1.0),
    (2.3e-120, 7e130, 1.0, 1.0, 0.41, 1.7e110, 0.3),
    (2.3e-120, 7e130, 1.0, 0.0, 0.41, 1.7e110, 0.3),
    (2.3e-120, 7e130, 0.0, 1.0, 0.41, 1.7e110, 0.3),
    (1e-4, 2e9, 1.0, 1.0, 0.37, 0.2, 1.0),
    (1e-4, 2e9, 1.0, 0.0, 0.37, 0.2, 1.0),
    (1e-4, 2e9, 0.0, 1.0, 0.37, 0.2, 1.0),
    (1e-4, 2e9, 1.0, 1.0, 0.81, -3.1, 0.5),
    (1e-4, 2e9, 1.0, 0.0, 0.81, -3.1, 0.5),
    (1e-4, 2e9, 0.0, 1.0, 0.81, -3.1, 0.5),
    (1.0, 3.0, 1.0, 1.0, 0.77, 0.9, 1.0),
    (1.0, 3.0, 1.0, 0.0, 0.77, 0.9, 1.0),
    (1.0, 3.0, 0.0, 1.0, 0.77, 0.9, 1.0),
    (1e-200, 1e100, 1.0, 1.0, 3.7e-18, 1.3e100, 1.0),
    (3e-210, 7e107, 1.0, 1.0, 3.3e100, 1.7e60, 1.0),
    # The linear law has a way of its own for the increment alone: constants that it must leave to the general one.
    (1e-200, 1e150, 1.0, 1.0, 1e200, 1e20, 1.0),
    (1e200, 1e-150, 1.0, 1.0, 1e-90, 1e-60, 1e-120),
    (1e-120, 1e-120, 1.0, 1.0, 1e8, 0.1, 1e-120),
    (1e-150, 1e8, 1.0, 1.0, 1e150, 1e8, 1e-160),
]


def grid():
    """The rows of every pair of exponents whose answers are 0 or lie in the normal range."""
    turn = 0
    for m, n in EXPONENTS:
        for p, v in POINTS:
            K, H, dt = CONSTANTS[turn % len(CONSTANTS)]
            turn += 1
            row = (K, H, m, n, p, v, dt)
            if all(x == 0 or 1e-300 < abs(x) < 1e300 for x in archard(*row)):
                yield row


def main():
    print("K,H,m,n,pressure,velocity,dt,increment,d_pressure")
    for row in (*ROWS, *grid(), *MORE):
        answers = [rounded(x) for x in archard(*row)]
        print(",".join(repr(x) for x in (*row, *answers)))


main()
