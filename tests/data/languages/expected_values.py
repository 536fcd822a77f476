"""Writes plugins/example-{c,cpp,fortran}/expected.csv: the closed forms of their READMEs in 60-digit decimals; and
everything.csv, for the laws `everything` beside this file.

Run from the root of the repository with any Python 3; nothing beyond its standard library is needed.
"""

import csv
from decimal import Decimal, getcontext
from pathlib import Path

getcontext().prec = 60
getcontext().Emin, getcontext().Emax = -9999, 9999
PLUGINS = Path(__file__).resolve().parents[3] / "plugins"


def exact(row):
    """The doubles of a row as the decimals that they are; what is not given as None."""
    return {key: None if value == "" else Decimal(value) for key, value in row.items()}


def text(value):
    return value if value == "" else repr(float(value))


def write(path, rows, answer):
    rows = [{**row, **{key: text(value) for key, value in answer(exact(row)).items()}} for row in rows]
    with open(path, "w", newline="") as file:
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
    worn = x["pressure"] >= 0
    return {"increment": slope * max(x["pressure"], Decimal(0)), "d_pressure": slope * worn, "distance_end": end}


def dissipated_work(x):
    return {"increment": x["alpha"] * max(x["friction_work"], Decimal(0))}


def everything(x):
    pressure = x["pressure"]
    status = 2 if pressure > 10**8 else 1 if pressure > 9 * 10**7 else 5 if pressure < -1 else 0
    names = ["increment", "d_pressure", "total_end", "calls_end", "direction_x", "direction_y", "direction_z"]
    if status > 1:
        return {"status": status, **{name: "" for name in names}}
    warm = x["temperature"]
    scale = 3 if warm is None else warm - x["absolute_zero"]
    slip = x["slip_vector_x"] + 2 * x["slip_vector_y"] + 3 * x["slip_vector_z"]
    twice = 2 if x["point_id"] is not None and x["point_id"] % 2 else 1
    slope = 0 if x["contact_state"] == 0 else x["k"] * slip * x["film"] * x["humidity"] * scale * twice
    turned = [x["tangent_z"], x["tangent_x"], x["tangent_y"]]
    if turned[0] is None:
        turned = [-x[f"normal_{axis}"] for axis in "xyz"]
    wear = slope * pressure
    answers = [wear, slope, x["total_start"] + wear, x["calls_start"] + 1, *turned]
    return {"status": status, **dict(zip(names, answers))}


def everything_rows():
    numbers = [0.37, 1.25, -0.81, 2.6, 0.055, 7.3, -1.9, 0.68, 3.1, -0.42, 5.7, 0.93, 1.61]
    pressures = [1.0, 3.5e6, 9.5e7, 2e8, -0.5, -2.0, 8.1e3]
    for row in range(28):
        x = [numbers[(3 * row + at) % 13] * (1 + row / 64) for at in range(13)]
        warm, turned, numbered = row % 2 == 0, row % 4 < 2, row % 3 != 2
        yield {
            "k": abs(x[0]) / 16, "film": abs(x[1]), "humidity": x[2], "total_start": x[3], "calls_start": float(row),
            "pressure": pressures[row % 7], "contact_state": row % 3,
            "slip_vector_x": x[4], "slip_vector_y": x[5], "slip_vector_z": x[6],
            "normal_x": x[7], "normal_y": x[8], "normal_z": x[9],
            "temperature": 20.0 + x[10] if warm else "",
            "tangent_x": x[11] if turned else "", "tangent_y": x[12] if turned else "", "tangent_z": x[0] if turned else "",
            "point_id": row if numbered else "", "absolute_zero": [0.0, -273.15][row % 4 // 2], "dt": 0.5,
        }  # fmt: skip


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


write(PLUGINS / "example-c/expected.csv", list(threshold_rows()), threshold)
write(PLUGINS / "example-cpp/expected.csv", list(running_in_rows()), running_in)
write(PLUGINS / "example-fortran/expected.csv", list(dissipated_work_rows()), dissipated_work)
write(Path(__file__).parent / "everything.csv", list(everything_rows()), everything)
