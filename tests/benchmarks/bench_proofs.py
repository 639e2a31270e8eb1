"""Proofs of the count of limit cycles: how many random Case III systems are proved, in which time, and why not.

Run ``python -m tests.benchmarks.bench_proofs [--quick]``. Systems are drawn with a seed, and all families of Psi that a
certificate may have: coefficients a, b, d uniform, C uniform in the disc; none is left out that a theorem does not
decide. Nearly neutral ones have a trace at C of up to 1e-3 of its size, fast-turning ones b up to 100 times a and d.
Cubic ones are typed, and may have several critical sets. Times are of the processor, search and check together, without
the search for the cycles.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections import Counter
from collections.abc import Iterator
from itertools import islice

import numpy as np

import codim2_core as c2
from codim2_core.portrait.cycles.limit_cycles import closed_orbits, proof_of
from codim2_core.portrait.cycles.proof.prove import prove_layer_problem
from codim2_core.portrait.layer_problem.problem import LayerProblem

from ..words.recognition import recognise

FAMILIES = [c2.psi.constant(), c2.psi.rational(), c2.psi.exponential(), c2.psi.tanh()]
FAMILIES += [c2.psi.hill(n) for n in (2, 3, 4, 2.5)]
SEED = 20
COUNTS = {"with cycles": 40, "without cycles": 60, "nearly neutral": 15, "fast-turning": 15}
COUNTS |= {"cubic, with cycles": 40, "cubic, without cycles": 60}


def random_system(rng: np.random.Generator, psi: c2.Psi, kind: str) -> c2.ELinear:
    """Draw a system of Case III: ``a d < 0 < det A``, C anywhere in the disc."""
    while True:
        a, b, d = rng.uniform(-5.0, 5.0, 3)
        e1, e2 = math.sqrt(rng.uniform()) * np.array([math.cos(t := rng.uniform(0.0, math.tau)), math.sin(t)])
        if kind == "nearly neutral":  # trace (A D e_Psi) is a D11 + d D22
            beta = 1.0 + psi.derivative(psi.radius(math.hypot(e1, e2)) ** 2)
            d = -a * (1.0 - beta * e1**2) / (1.0 - beta * e2**2) * (1.0 + 1e-3 * rng.uniform(-1.0, 1.0))
        if kind == "fast-turning":
            b *= 10.0 ** rng.uniform(1.0, 2.0)
        if a * d < 0.0 < a * d + b * b:
            return c2.ELinear(a, b, d, (float(b * e2 - a * e1), float(-b * e1 - d * e2)))


def random_cubic(rng: np.random.Generator) -> c2.System:
    """Draw a typed system: cubic, with a focus near the middle of the disc, and up to eight more critical sets."""
    k, trace = rng.normal(size=20).round(2), rng.uniform(-0.5, 0.5)
    bends = ("c**2", "c*s", "s**2", "2*c**3", "c*s**2", "c**2*s", "2*s**3", "0.2")
    first, second = (
        " + ".join(f"{v}*{term}" for v, term in zip(row, bends, strict=True)) for row in k[2:18].reshape(2, 8)
    )
    turn, back = 1.0 + abs(k[:2])
    return c2.System(U=(f"{trace}*c + {turn}*s + {first}", f"{trace}*s - {back}*c + {second}"))


def drawn(kind: str, seed: int = SEED) -> Iterator[LayerProblem]:
    """Draw layer problems of one kind without end."""
    rng = np.random.default_rng([seed, list(COUNTS).index(kind)])
    while True:
        psi = FAMILIES[rng.integers(len(FAMILIES))]
        cubic = kind.startswith("cubic")
        problem = LayerProblem((random_cubic(rng) if cubic else random_system(rng, psi, kind)).at(), psi)
        if "with" not in kind or bool(closed_orbits(problem).cycles) == kind.endswith("with cycles"):
            yield problem


def overlooked(count: int) -> tuple[int, int]:
    """Return how many proofs that leave out the last cycle of a cubic system were asked for, and how many given."""
    asked = given = 0
    for problem in islice(drawn("cubic, with cycles"), count):
        asked += 1
        given += bool(prove_layer_problem(problem, closed_orbits(problem).cycles[:-1]))
    return asked, given


def report(quick: bool = False) -> str:
    """Return how many of each kind are proved, in which time, and the reasons of the others, as Markdown."""
    lines = ["| Case III, and cubic | proved | median, s | 90 %, s | not proved |", "|---|---|---|---|---|"]
    for kind, count in COUNTS.items():
        times, reasons = [], Counter[str]()
        for problem in islice(drawn(kind), count // 5 if quick else count):
            closed_orbits(problem)
            start = time.process_time()
            found = proof_of(problem)
            times.append(time.process_time() - start)
            if not found:
                reasons[recognise(found.reason)[0][0]] += 1
        said = ", ".join(f"{reason}: {n}" for reason, n in reasons.most_common())
        middle, most = np.quantile(times, [0.5, 0.9])
        done = len(times) - reasons.total()
        lines.append(f"| {kind} | {done} of {len(times)} | {middle:.2f} | {most:.2f} | {said} |")
    asked, given = overlooked(2 if quick else 10)
    lines += ["", f"Of {asked} counts that leave out a cycle, {given} were proved."]
    return "\n".join([*lines, "", f"Load of the machine then: {os.getloadavg()[0]:.1f}."])


if __name__ == "__main__":
    print(report("--quick" in sys.argv))
