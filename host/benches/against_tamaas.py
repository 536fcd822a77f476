#!/usr/bin/env python3
"""The contact solves of `cargo bench -p wearlaw --bench halfspace` beside the same ones by Tamaas, on one thread.

    python3 host/benches/against_tamaas.py PYTHON [CASE ...]

PYTHON is a Python that imports numpy and tamaas (pip install tamaas); a CASE begins like "hertz free" or
"rough periodic 512", and without one all up to 1024 cells a side run. Either program solves a case in a process of its
own, more than once; the least processor time and the peak of memory count. Both errors are
sum p (g - min g) / (sum p * std g0), measured by each program on its own answer, Tamaas' here once more.
"""
import json
import resource
import subprocess
import sys
import time

MODULUS = 110e9
CASES = [(shape, boundary, n) for n in (256, 512, 1024, 2048) for shape in ("hertz", "rough")
         for boundary in ("periodic", "free")]


def surface(shape, n):
    """Side, gap and mean pressure, as in halfspace.rs."""
    import numpy as np

    if shape == "hertz":
        radius, load = 10e-3, 20.0
        size = 10 * (3 * load * radius / (4 * MODULUS)) ** (1 / 3)
        x = (np.arange(n) - n // 2) * size / n
        return size, (x[None, :] ** 2 + x[:, None] ** 2) / (2 * radius), load / size**2
    size = 1e-3
    k = np.arange(n)
    k = np.where(k > n // 2, k - n, k).astype(float)
    q = np.hypot(k[None, :], k[:, None])
    inside = (q >= 1) & (q <= n / 8)
    amplitude = np.where(inside, np.maximum(q, 4.0) ** -1.8, 0.0)
    # x[k] = a^k x[0] + c (1 + a + ... + a^(k-1)), modulo 2^64.
    count = int(inside.sum())
    with np.errstate(over="ignore"):
        powers = np.cumprod(np.full(count, 6364136223846793005, dtype=np.uint64))
        sums = np.concatenate([[np.uint64(1)], np.uint64(1) + np.cumsum(powers[:-1])])
        state = powers * np.uint64(1234) + sums * np.uint64(1442695040888963407)
    phase = np.zeros((n, n))
    phase[inside] = 2 * np.pi * (state >> np.uint64(11)).astype(float) / 2.0**53
    slopes = 0.5 * ((amplitude * 2 * np.pi * q / size) ** 2).sum()
    height = np.fft.ifft2(amplitude * np.exp(1j * phase)).real * n * n
    return size, -height * 0.1 / np.sqrt(slopes), 0.004 * MODULUS


def tamaas(shape, boundary, n):
    """Solves one case with Tamaas and prints what it came to."""
    import numpy as np
    import tamaas as tm

    size, gap, mean = surface(shape, n)
    tm.set_log_level(tm.LogLevel.info)
    model = tm.Model(tm.model_type.basic_2d, [size, size], [n, n])
    model.E, model.nu = MODULUS, 0.0
    if boundary == "free":
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tm.PolonskyKeerRey(model, -gap, 1e-8)
    if boundary == "free":
        solver.setIntegralOperator("dcfft")
    solver.max_iter, solver.dump_freq = 3000, 10**9
    times = []
    for _ in range(3 if n <= 512 else 1):
        model.traction[...] = 0
        model.displacement[...] = 0
        begin = time.process_time()
        solver.solve(mean)
        times.append(time.process_time() - begin)
    pressure, open_by = np.array(model.traction), np.array(model.displacement) + gap
    open_by -= open_by.min()
    print("RESULT" + json.dumps({
        "cpu": min(times),
        "error": float((pressure * open_by).sum() / (pressure.sum() * gap.std())),
        "peak": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "largest": float(pressure.max()),
    }))


def by_tamaas(python, case):
    command = [python, __file__, "--one", *map(str, case)]
    one = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "PATH": "/usr/bin:/bin"}
    done = subprocess.run(command, env=one, capture_output=True, text=True)
    lines = done.stdout.splitlines() + done.stderr.splitlines()
    results = [line for line in lines if "RESULT" in line]
    if not results:
        sys.exit(f"Tamaas did not run with {python}:\n{done.stderr[-1000:]}")
    result = json.loads(results[0].split("RESULT", 1)[1])
    rows = [line.split() for line in lines]
    result["iterations"] = max((int(row[0]) for row in rows if len(row) > 1 and row[0].isdigit()), default=-1)
    return result


def by_wearlaw(case):
    name = " ".join(map(str, case))
    command = ["cargo", "bench", "-q", "-p", "wearlaw", "--bench", "halfspace", "--", name]
    done = subprocess.run(command, capture_output=True, text=True)
    for line in done.stdout.splitlines():
        if line.strip().startswith(name + " "):
            threads, iterations, _, error, _, cpu, _, peak = line.replace(name, "").split()
            if threads == "1":
                return {"cpu": float(cpu), "iterations": int(iterations), "error": float(error), "peak": float(peak)}
    sys.exit(f"no line of {name}:\n{done.stderr[-1000:]}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if sys.argv[1] == "--one":
        tamaas(sys.argv[2], sys.argv[3], int(sys.argv[4]))
        return
    python, words = sys.argv[1], sys.argv[2:]
    print(f"{'':>22} {'Tamaas':>32} {'wearlaw':>37}")
    print(f"{'case, n':>22} {'iterations':>10} {'error':>7} {'cpu, s':>7} {'MB':>5}"
          f" {'iterations':>11} {'error':>7} {'cpu, s':>8} {'MB':>8} {'cpu ratio':>10}")
    for case in CASES:
        name = " ".join(map(str, case))
        if not any(name.startswith(word) for word in words) and (words or case[2] > 1024):
            continue
        theirs, ours = by_tamaas(python, case), by_wearlaw(case)
        print(f"{name:>22} {theirs['iterations']:>10} {theirs['error']:>7.0e} {theirs['cpu']:>7.2f} {theirs['peak']:>5.0f}"
              f" {ours['iterations']:>11} {ours['error']:>7.0e} {ours['cpu']:>8.4f} {ours['peak']:>8.0f}"
              f" {theirs['cpu'] / ours['cpu']:>10.1f}", flush=True)


if __name__ == "__main__":
    main()
