"""Error beside time for the equator: ``python -m tests.benchmarks.bench_equator [systems]`` (default 100 000).

Counts are held against integer Sturm sequences for every system; digits of the zeros against 50-digit Newton for
every tenth.
"""

import math
import random
import sys
import time

from codim2_core.numerics.trigonometric import tangential_zeros

from ..core.exact_trigonometric import count_equilibria, root_error, theta_coefficients

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


def report(total: int = 100_000) -> str:
    """Return counts, errors and times of every family of systems as Markdown."""
    lines = [
        "| equator equilibria: systems | how many | mean, µs | named degenerate | wrong counts | "
        "worst root error, ulp (1 + condition) |",
        "|---|---|---|---|---|---|",
    ]
    for name, (share, draw) in FAMILIES.items():
        systems = [draw() for _ in range(int(total * share))]
        start = time.perf_counter()
        results = [tangential_zeros(*q) for q in systems]
        mean = (time.perf_counter() - start) / len(systems)
        wrong = named = 0
        error = 0.0
        for k, (q, r) in enumerate(zip(systems, results, strict=True)):
            multiple = r.identically_zero or max(r.multiplicity, default=1) > 1
            named += multiple
            count = count_equilibria(*q)
            wrong += r.exact_count != count or (not multiple and len(r.theta) != count)
            if k % 10 == 0 or share < 0.05:
                q50, size = theta_coefficients(*q), max(map(abs, q))
                for theta, slope in zip(r.theta, r.slope, strict=True):
                    if abs(slope) > 1e-30 * size:
                        error = max(error, root_error(q50, theta)[0])
        lines.append(f"| {name} | {len(systems)} | {mean * 1e6:.0f} | {named} | {wrong} | {error:.1f} |")
    return "\n".join(lines)


if __name__ == "__main__":
    print(report(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000))
