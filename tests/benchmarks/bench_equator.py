"""Error beside time for the equator: `python tests/benchmarks/bench_equator.py [systems]` (default 100 000).

Counts are held against integer Sturm sequences for every system; digits of the zeros against 50-digit Newton for
every tenth. A disagreement is printed and makes the exit status 1.
"""

import math
import random
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "core"))

from exact_trigonometric import count_equilibria, root_error, theta_coefficients

from codim2_core.equator import equator_cycle, equator_equilibria
from codim2_core.systems import ELinear
from codim2_core.trigonometric import tangential_zeros

rng = random.Random(20)


def stratum(side=0.0):
    """A point of eq:tangencies, with b moved by `side`."""
    a, b, d = (rng.uniform(-2, 2) for _ in range(3))
    c, s = math.cos(theta := rng.uniform(0, 2 * math.pi)), math.sin(theta)
    f1, f2 = b * s - (a - d) * c**3, (a - d) * s**3 - b * c
    return a, b * (1 + rng.choice((1, -1)) * side), d, f1, f2


def near(power):
    return lambda: stratum(10.0**-power)


FAMILIES = {
    "uniform": (1.0, lambda: tuple(rng.uniform(-2, 2) for _ in range(5))),
    "sliders (0.1)": (0.3, lambda: tuple(round(rng.uniform(-2, 2), 1) for _ in range(5))),
    "small integers": (0.1, lambda: tuple(float(rng.randint(-2, 2)) for _ in range(5))),
    "a = d": (0.1, lambda: (a := rng.uniform(-2, 2), rng.uniform(-2, 2), a, rng.random(), rng.random())),
    "1e-149..1e149": (0.01, lambda: tuple(rng.choice((-1, 1)) * 10 ** rng.uniform(-149, 149) for _ in range(5))),
    "on saddle-nodes": (0.02, stratum),
    **{f"saddle-node +-1e-{k}": (0.02, near(k)) for k in (3, 6, 9, 12, 15)},
}


def main(total):
    wrong = 0
    print(f"{'family':22s}{'systems':>8s}{'us':>8s}{'worst us':>10s}{'named':>7s}{'wrong':>7s}{'ulps*(1+cond)':>15s}")
    for name, (share, draw) in FAMILIES.items():
        systems = [draw() for _ in range(int(total * share))]
        results, slowest = [], 0.0
        start = time.perf_counter()
        for q in systems:
            before = time.perf_counter()
            results.append(tangential_zeros(*q))
            slowest = max(slowest, time.perf_counter() - before)
        mean = (time.perf_counter() - start) / len(systems)
        bad = named = 0
        error = 0.0
        for k, (q, r) in enumerate(zip(systems, results, strict=True)):
            multiple = r.identically_zero or max(r.multiplicity, default=1) > 1
            named += multiple
            count = count_equilibria(*q)
            if r.exact_count != count or (not multiple and len(r.theta) != count):
                bad += 1
                print("  wrong:", q, r, count)
            if k % 10 == 0 or share < 0.05:
                q50, size = theta_coefficients(*q), max(map(abs, q))
                for theta, slope in zip(r.theta, r.slope, strict=True):
                    if abs(slope) > 1e-30 * size:
                        error = max(error, root_error(q50, theta)[0])
        wrong += bad
        print(f"{name:22s}{len(systems):8d}{mean * 1e6:8.1f}{slowest * 1e6:10.0f}{named:7d}{bad:7d}{error:15.2f}")
    systems = [ELinear(a, b, d, f=(f1, f2)) for a, b, d, f1, f2 in (FAMILIES["uniform"][1]() for _ in range(5000))]
    for function in (equator_equilibria, equator_cycle):
        start = time.perf_counter()
        for system in systems:
            function(system)
        print(f"{function.__name__}: {(time.perf_counter() - start) / len(systems) * 1e6:.1f} us")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000))
