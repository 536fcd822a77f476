#!/usr/bin/env python3
"""Writes the prescribed histories of host/scenes: Hertz line contact and partial slip.

usage: make_fretting_history.py [FOLDER]     (default: ../host/scenes beside this script)

Needs Python 3 and its standard library. The files are committed; a test runs this script and
compares them byte for byte. Numbers are written as an integer and a power of ten: that is few
digits, and the last one stands far from what a library's sine or logarithm may round differently.

Line contact of a cylinder (radius R) on a flat, load P per length, 1/E* = sum (1 - nu^2)/E:
  a = sqrt(4 P R / (pi E*)),  p0 = 2 P / (pi a),  p(x) = p0 sqrt(1 - x^2/a^2)
  (Johnson, Contact Mechanics, 1985, section 4.2 (c)).
Tangential load Q < mu P, first loading: stick in |x| < c, c = a sqrt(1 - Q/(mu P)),
  q(x) = mu p0 [ h(x; a) - h(x; c) ],  h(x; c) = (c/a) sqrt(1 - x^2/c^2) inside c, else 0
  (Cattaneo 1938, Mindlin 1949; Johnson section 7.2).
Slip of the cylinder over the flat, from du/dx = -(2 / (pi E*)) int q(s) / (x - s) ds (Johnson eq. 2.25a for both bodies):
  s(x) = f(x; c) - f(x; a),  f(x; c) = mu p0 / E* (c^2/a) [ X sqrt(X^2 - 1) - arcosh X ],
  X = |x|/c > 1, and f = 0 inside c.
The column `slip` is the motion of the wearing body, the flat, relative to the cylinder: -s.
The column `shear` is the friction stress on the flat: q. They oppose each other.
After a reversal at Q* the change is that of a first loading with twice the friction:
  q = q* -+ 2 mu p0 [ h(x; a) - h(x; c') ],  s = s* -+ 2 [ f(x; c') - f(x; a) ],
  c' = a sqrt(1 - |Q* - Q| / (2 mu P))  (Mindlin and Deresiewicz 1953; Johnson section 7.4).
"""
import math
import os
import sys

R = 6.0e-3           # m
P = 18.5e3           # N/m
E_STAR = 109.89011e9  # Pa
MU = 0.6
Q_RATIO = 0.8        # Q at its largest / (mu P)
NU = 0.3

A = math.sqrt(4.0 * P * R / (math.pi * E_STAR))
P0 = 2.0 * P / (math.pi * A)


def number(value, exponent):
    """value rounded to a multiple of 10^exponent."""
    count = round(value * 10.0 ** -exponent)
    if count == 0:
        return "0"
    digits = str(count)
    while digits.endswith("0"):
        digits = digits[:-1]
        exponent += 1
    return digits if exponent == 0 else f"{digits}e{exponent}"


def pressure(x, a=A, p0=P0):
    inside = 1.0 - (x / a) ** 2
    return p0 * math.sqrt(inside) if inside > 0.0 else 0.0


def ellipse(x, c):
    inside = 1.0 - (x / c) ** 2 if c > 0.0 else 0.0
    return c / A * math.sqrt(inside) if inside > 0.0 else 0.0


def branch(x, c):
    big = abs(x) / c
    if big <= 1.0:
        return 0.0
    return MU * P0 / E_STAR * c * c / A * (big * math.sqrt(big * big - 1.0) - math.acosh(big))


def first_loading(x, ratio):
    """Friction stress and slip after loading to Q = ratio mu P."""
    c = A * math.sqrt(1.0 - ratio)
    return MU * P0 * (ellipse(x, A) - ellipse(x, c)), branch(x, c) - branch(x, A)


def cycle(x, i, quarter):
    """Friction stress and slip at instant i: 0 -> Q -> -Q -> 0, Q = sine of the phase."""
    ratio = Q_RATIO * math.sin(0.5 * math.pi * i / quarter)
    if i <= quarter:
        return first_loading(x, ratio)
    top_q, top_s = first_loading(x, Q_RATIO)
    sign = 1.0
    if i > 3 * quarter:  # the second reversal, from -Q, mirrors the first
        sign = -1.0
    change_q, change_s = first_loading(x, 0.5 * (Q_RATIO - sign * ratio))
    return sign * (top_q - 2.0 * change_q), sign * (top_s - 2.0 * change_s)


def fretting(points=201, quarter=60, step=1.0e-3):
    yield "# One fretting cycle of a cylinder on a flat: Hertz line contact with Cattaneo-Mindlin partial slip."
    yield "# Made by tests/make_fretting_history.py from theory (equations and sources are cited there), not measured."
    yield f"# R = {R} m, P = {P} N/m, E* = {E_STAR} Pa, mu = {MU}, Q = {Q_RATIO} mu P sin(2 pi t / {4 * quarter * step:g} s); a = {A:.9e} m, p0 = {P0:.9e} Pa."
    yield "# p = p0 sqrt(1 - x^2/a^2) (Johnson 1985, section 4.2 (c)); shear = friction stress on the flat by Mindlin's superposition (7.2), through both reversals (7.4);"
    yield "# slip = motion of the flat relative to the cylinder since the first row (it opposes shear), by integrating eq. 2.25a from the edge of the stick zone."
    yield "time,point,x,pressure,slip,shear"
    half = (points - 1) // 2
    grid = [1.2 * A * (i - half) / half for i in range(points)]
    fixed = [(number(x, -10), number(pressure(x), 3)) for x in grid]
    for i in range(4 * quarter + 1):
        time = number(i * step, -3)
        for point, x in enumerate(grid):
            shear, slip = cycle(x, i, quarter)
            place, p = fixed[point]
            yield f"{time},{point},{place},{p},{number(-slip, -13)},{number(shear, 3)}"


def nodal(points=21, rows=41, step=0.025, speed=0.05):
    yield "# Nodal stresses of a flat that slides in +x under a cylinder while the load grows: Hertz line contact, full sliding."
    yield "# Made by tests/make_fretting_history.py from theory (equations and sources are cited there), not measured."
    yield f"# R = {R} m, E* = {E_STAR} Pa, mu = {MU}, nu = {NU}, load per length from {P / 4:g} to {P:g} N/m, linear in time; speed {speed} m/s."
    yield "# Surface stresses, tension positive, friction mu p on the flat in -x: szz = -p, sxz = -mu p, sxx = -p + 2 mu p0 x/a inside and"
    yield "# sxx = 2 mu p0 (x/a - sign(x) sqrt(x^2/a^2 - 1)) outside the contact (Johnson 1985, sections 4.2 (c) and 7.1), syy = nu (sxx + szz), sxy = syz = 0."
    yield "# The normal is that of the flat, so that the traction -n.s.n equals the pressure; area is the spacing times a unit of length."
    yield "time,point,x,pressure,velocity,nx,ny,nz,sxx,syy,szz,sxy,syz,sxz,area"
    half = (points - 1) // 2
    spacing = 1.2 * A / half
    for i in range(rows):
        load = P * (0.25 + 0.75 * i / (rows - 1))
        a = math.sqrt(4.0 * load * R / (math.pi * E_STAR))
        p0 = 2.0 * load / (math.pi * a)
        for point in range(points):
            x = spacing * (point - half)
            p = pressure(x, a, p0)
            big = x / a
            beyond = math.sqrt(big * big - 1.0) if abs(big) > 1.0 else 0.0
            sxx = -p + 2.0 * MU * p0 * (big - math.copysign(beyond, big))
            row = [
                number(i * step, -3), str(point), number(x, -10), number(p, 2), number(speed, -3), "0", "0", "1",
                number(sxx, 2), number(NU * (sxx - p), 2), number(-p, 2), "0", "0", number(-MU * p, 2), number(spacing, -10),
            ]
            yield ",".join(row)


def write(path, lines):
    with open(path, "w", encoding="ascii", newline="\n") as file:
        for line in lines:
            file.write(line + "\n")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, os.pardir, "host", "scenes")
    write(os.path.join(folder, "fretting_history.csv"), fretting())
    write(os.path.join(folder, "nodal_stress_history.csv"), nodal())


if __name__ == "__main__":
    main()
