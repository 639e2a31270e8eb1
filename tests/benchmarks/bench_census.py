"""Naming many e-linear systems: the filter beside `classify`, wrong names beside systems a second.

Run ``python -m tests.benchmarks census [--quick]``. "Wrong" counts names that differ from those of `classify`
among the systems that both have named; "by the exact path" is the share that the filter does not decide.
"""

from __future__ import annotations

import time

import numpy as np

from codim2_core import ELinear, classify, psi
from codim2_core.bifurcations.census.draws import normal
from codim2_core.bifurcations.census.names import PORTRAIT_NAMES, names

#: How far from the saddle-node curve systems are drawn: as they come, and 10^-k of a coefficient from it.
GAPS = (0, 3, 6, 9, 12)


def near_the_saddle_node(rng: np.random.Generator, count: int, digits: int) -> np.ndarray:
    """Systems within 10^-digits of a saddle-node of limit directions; with 0 digits as they come."""
    plane = normal(rng, count)
    if not digits:
        return plane
    t, k = plane[:, 4] * 7.0, plane[:, 0] - plane[:, 2]
    off = 1.0 + 10.0**-digits * rng.choice((-1.0, 1.0), count)
    plane[:, 3] = (plane[:, 1] * np.sin(t) - k * np.cos(t) ** 3) * off
    plane[:, 4] = k * np.sin(t) ** 3 - plane[:, 1] * np.cos(t)
    return plane


def one_by_one(plane: np.ndarray) -> list[tuple[str | None, str]]:
    """Name systems by `classify`."""
    one = psi.constant()
    found = [classify(ELinear(a, b, d, (f1, f2)), one) for a, b, d, f1, f2 in plane.tolist()]
    return [(each.case, each.name) for each in found]


def report(quick: bool = False) -> str:
    """Return the table."""
    rng = np.random.default_rng(0)
    many, few = (100_000, 300) if quick else (1_000_000, 3_000)
    names(normal(rng, 10))
    rows = [
        "| systems | named a second | `classify` a second | ratio | by the exact path | wrong |",
        "|---|---|---|---|---|---|",
    ]
    for digits in GAPS:
        plane = near_the_saddle_node(rng, many, digits)
        start = time.process_time()
        codes, margins, others = names(plane)
        fast = many / (time.process_time() - start)
        start = time.process_time()
        known = one_by_one(plane[:few])
        slow = few / (time.process_time() - start)
        said = [others[i] if code == 0 else PORTRAIT_NAMES[code - 1] for i, code in enumerate(codes[:few].tolist())]
        wrong = sum(one != other for one, other in zip(said, known, strict=True))
        exact = np.count_nonzero(margins == 0.0) / many
        where = f"within 1e-{digits} of a saddle-node" if digits else "standard normal"
        rows.append(f"| {where} | {fast:.3g} | {slow:.3g} | {fast / slow:.0f} | {exact:.1e} | {wrong} of {few} |")
    return "\n".join(rows)
