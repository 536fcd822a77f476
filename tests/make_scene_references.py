#!/usr/bin/env python3
"""Writes the reference depths of the scenes in host/scenes whose answer is a file.

usage: make_scene_references.py [FOLDER]     (default: ../host/scenes beside this script)

Needs Python 3 and its standard library. Every answer is a closed form or a quadrature of its own, in 40-digit decimals,
from the histories as they are committed (linear between rows), and shares no code with the program. Depths are written
with 15 digits.
"""
import csv
import os
import sys
from decimal import Decimal as D, getcontext

getcontext().prec = 40


def rows(path):
    """Times, and for every column the values [time][point]."""
    with open(path, encoding="ascii") as file:
        lines = list(csv.DictReader(line for line in file if not line.startswith("#")))
    times = []
    columns = {name: [] for name in lines[0] if name not in ("time", "point")}
    for line in lines:
        time = D(line["time"])
        if not times or times[-1] != time:
            times.append(time)
            for values in columns.values():
                values.append([])
        for name, values in columns.items():
            values[-1].append(D(line[name]))
    return times, columns


def write(folder, name, what, depths):
    with open(os.path.join(folder, name), "w", encoding="ascii", newline="\n") as file:
        file.write(f"# {what}\n# Made by tests/make_scene_references.py.\npoint,wear\n")
        for point, depth in enumerate(depths):
            file.write(f"{point},{depth:.14e}\n" if depth else f"{point},0\n")


def power(base, exponent):
    return (exponent * base.ln()).exp()


def legendre(n):
    """Gauss nodes and weights on 0..1, by Newton from the Chebyshev guess."""
    from math import cos, pi
    nodes = []
    for i in range(n):
        x = D(cos(pi * (i + 0.75) / (n + 0.5)))
        for _ in range(8):
            below, p = D(1), x
            for k in range(2, n + 1):
                below, p = p, ((2 * k - 1) * x * p - (k - 1) * below) / k
            slope = n * (x * p - below) / (x * x - 1)
            x -= p / slope
        nodes.append(((1 + x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return nodes


def deck_temperature(folder):
    """K, H, m, n go linearly from 100 to 200 degrees and are held outside; pressure 50, velocity 0.2, unit time."""
    low, high = [D("1e-4"), D("2e3"), D(1), D(1)], [D("3e-4"), D("1e3"), D("1.5"), D("0.8")]
    gauss = legendre(24)

    def rate(part):
        part = min(max(part, D(0)), D(1))
        k, h, m, n = [a + part * (b - a) for a, b in zip(low, high)]
        return k / h * power(D(50), m) * power(D("0.2"), n)

    def mean(start, end):
        return sum(weight * rate(start + node * (end - start)) for node, weight in gauss)

    half = D("0.5")
    crossing = mean(D(0), D(1))
    depths = [rate(D(0)), rate(half), rate(D(1)), crossing, crossing, half * mean(half, D(1)) + half * rate(D(1))]
    what = "K/H p^m v^n with constants linear in temperature, integrated over time by a Gauss rule with 24 nodes."
    write(folder, "deck_temperature_reference.csv", what, depths)


def running_in(k0, kinf, s0, h):
    """Integral of K(x) dx / H from distance a to b."""
    return lambda a, b: (kinf * (b - a) + (k0 - kinf) * s0 * ((-a / s0).exp() - (-b / s0).exp())) / h


def deck_user(folder):
    """Pressure up in 1, 20 at 1e7, down in 1; velocity 0.2: the integral of p(x) K(x) dx / H, by Gauss rules."""
    k0, kinf, s0, h, p, v = D("1e-3"), D("1e-4"), D("0.5"), D("1e9"), D("1e7"), D("0.2")
    gauss = legendre(24)
    coefficient = lambda t: (kinf + (k0 - kinf) * (-v * t / s0).exp()) / h
    up = sum(w * p * x * coefficient(x) * v for x, w in gauss)
    down = sum(w * p * (1 - x) * coefficient(21 + x) * v for x, w in gauss)
    steady = p * running_in(k0, kinf, s0, h)(v, 21 * v)
    what = "The integral of p K(x) / H over the sliding distance x, K falling exponentially from K_0 to K_inf."
    write(folder, "deck_user_reference.csv", what, [up + steady + down])


def fretting(folder):
    times, columns = rows(os.path.join(folder, "fretting_history.csv"))
    slip, shear, pressure = columns["slip"], columns["shear"], columns["pressure"]
    work, distance = [], []
    for i in range(len(slip[0])):
        total, path = D(0), D(0)
        for k in range(len(times) - 1):
            step = abs(slip[k + 1][i] - slip[k][i])
            a, b = shear[k][i], shear[k + 1][i]
            # Mean of |q| while q goes linearly from a to b.
            mean = (abs(a) + abs(b)) / 2 if a * b >= 0 else (a * a + b * b) / (2 * abs(b - a))
            total += mean * step
            path += step
        work.append(D("5e-14") * total)
        distance.append(path)
    what = "alpha times the integral of |shear| over the slip path, both linear between rows."
    write(folder, "fretting_work_reference.csv", what, work)
    integral = running_in(D("1e-3"), D("1e-4"), D("2e-6"), D("2e9"))
    depths = [pressure[0][i] * integral(D(0), 5 * distance[i]) for i in range(len(distance))]
    what = "Running-in law, its exact integral over five cycles of slip at the constant pressure of each point."
    write(folder, "fretting_running_in_reference.csv", what, depths)


def nodal(folder):
    times, columns = rows(os.path.join(folder, "nodal_stress_history.csv"))
    k_over_h = D("1e-4") / D("2e9")
    points = len(columns["x"][0])

    def increments(k, traction):
        v = columns["velocity"][k][0]
        mean = [(traction(k, i) + traction(k + 1, i)) / 2 for i in range(points)]
        return [k_over_h * v * p * (times[k + 1] - times[k]) for p in mean]

    wear, averaged = [D(0)] * points, [D(0)] * points
    for k in range(len(times) - 1):
        # The normal is +z, so the traction -n.s.n is -szz, which is nowhere negative here.
        by_stress = increments(k, lambda k, i: -columns["szz"][k][i])
        wear = [w + dw for w, dw in zip(wear, by_stress)]
        by_pressure = increments(k, lambda k, i: columns["pressure"][k][i])
        touching = [i for i in range(points) if by_pressure[i] > 0]
        area = sum(columns["area"][k][i] for i in touching)
        mean = sum(by_pressure[i] * columns["area"][k][i] for i in touching) / area
        averaged = [w + (mean if i in touching else 0) for i, w in enumerate(averaged)]
    what = "K/H v times the integral of the traction -szz over time, linear between rows."
    write(folder, "nodal_stress_reference.csv", what, wear)
    what = "K/H v times the integral of the pressure over time, its mean over the area in contact between each two rows."
    write(folder, "averaged_reference.csv", what, averaged)


def softening(folder):
    """K p v / H times the integral of 1 / (1 - b (T - T0)), T linear; the depth is that along the direction times -d.n."""
    k, h, b, tilt, p, v, duration = D("1e-5"), D("2e9"), D("8e-4"), D("0.3"), D("2e7"), D("0.3"), D(10)
    start, end = 1 - b * (D(20) - 20), 1 - b * (D(420) - 20)
    slope = (end - start) / duration
    rising = (end / start).ln() / slope
    steady = duration / (1 - b * 200)
    factor = k * p * v / h / (1 + tilt * tilt).sqrt()
    what = "K p v / H times the integral of 1 / (1 - b (T - T0)), T linear in time, times -d.n = 1 / sqrt(1 + tilt^2)."
    write(folder, "softening_reference.csv", what, [factor * rising, factor * steady, factor * rising])


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, os.pardir, "host", "scenes")
    for make in (deck_temperature, deck_user, fretting, nodal, softening):
        make(folder)


if __name__ == "__main__":
    main()
