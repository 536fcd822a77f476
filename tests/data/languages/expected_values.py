"""Writes plugins/example-{c,cpp,fortran}/expected.csv: the closed forms of their READMEs in 60-digit decimals.

Run from the root of the repository with any Python 3; nothing beyond its standard library is needed.
"""

import csv
from decimal import Decimal, getcontext
from pathlib import Path

getcontext().prec = 60
getcontext().Emin, getcontext().Emax = -9999, 9999
PLUGINS = Path(__file__).resolve().parents[3] / "plugins"


def exact(row):
    """The doubles of a row as the decimals that they are."""
    return {key: Decimal(value) for key, value in row.items()}


def write(folder, rows, answer):
    rows = [{**row, **{key: repr(float(value)) for key, value in answer(exact(row)).items()}} for row in rows]
    with open(PLUGINS / folder / "expected.csv", "w", newline="") as file:
        table = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def threshold(x):
    slope = x["K"] / x["H"] * abs(x["slip"])
    above = x["pressure"] > x["p0"]
    return {
        "increment": slope * (x["pressure"] - x["p0"]) if above else 0,
        "d_pressure": slope if above else 0,
    }


def running_in(x):
    start, end = x["distance_start"], x["distance_start"] + abs(x["slip"])
    slope = (
        x["K_inf"] * abs(x["slip"])
        + (x["K_0"] - x["K_inf"]) * x["s_0"] * ((-start / x["s_0"]).exp() - (-end / x["s_0"]).exp())
    ) / x["H"]
    return {"increment": slope * max(x["pressure"], Decimal(0)), "d_pressure": slope, "distance_end": end}


def dissipated_work(x):
    return {"increment": x["alpha"] * max(x["friction_work"], Decimal(0))}


def threshold_rows():
    for pressure in [-1e6, 0.0, 4e6, 5e6, 5.000001e6, 8e7, 1.3e9, 1e300]:
        for slip in [0.0, 1e-12, 3.7e-5, 2.5]:
            for p0 in [0.0, 5e6]:
                yield {"K": 1e-4, "H": 2.1e9, "p0": p0, "pressure": pressure, "slip": slip, "dt": 0.01}
    yield {"K": 0.0, "H": 2.1e9, "p0": 0.0, "pressure": 1e8, "slip": 1.0, "dt": 1.0}


def running_in_rows():
    for pressure in [-1.0, 0.0, 1e5, 7.3e7, 1e9]:
        for slip in [0.0, 1e-9, 2e-5, 0.4, 30.0]:
            for distance in [0.0, 0.05, 3.0, 1e4]:
                yield {
                    "K_0": 3e-4, "K_inf": 2e-5, "s_0": 1.5, "H": 1.9e9,
                    "pressure": pressure, "slip": slip, "dt": 0.5, "distance_start": distance,
                }  # fmt: skip


def dissipated_work_rows():
    for alpha in [0.0, 1e-14, 2.4e-13]:
        for work in [-3.0, 0.0, 5e-324, 1e-9, 0.17, 4.2e3, 8e8]:
            yield {"alpha": alpha, "friction_work": work, "dt": 1e-3}


write("example-c", list(threshold_rows()), threshold)
write("example-cpp", list(running_in_rows()), running_in)
write("example-fortran", list(dissipated_work_rows()), dissipated_work)
