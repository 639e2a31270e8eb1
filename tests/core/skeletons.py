"""Whether the skeleton of a portrait is consistent with itself, with the index and with the theorems."""

from __future__ import annotations

import math

import numpy as np

import codim2_core as c2
from codim2_core.portrait.layer_problem.equator import EquatorEquilibria
from codim2_core.portrait.theorems.facts import Verdict
from codim2_core.systems.coefficients import Coefficients
from codim2_core.systems.psi.function import Psi


def random_system(rng: np.random.Generator, case: str) -> Coefficients:
    """A system of the case "I", "II" or "III", about half of them with a critical set."""
    while True:
        a, d = rng.uniform(0.2, 2.0, 2)
        b = rng.uniform(-2.0, 2.0)
        if case == "I":
            sign = rng.choice([-1.0, 1.0])
            a, d = sign * a, sign * d
        else:
            a, d = (a, -d) if rng.random() < 0.5 else (-a, d)
            if (a * d + b * b > 0.0) != (case == "III"):
                continue
        radius, angle = rng.uniform(0.0, 1.6), rng.uniform(0.0, 2.0 * math.pi)
        e = radius * np.array([math.cos(angle), math.sin(angle)])
        f1, f2 = -(np.array([[a, -b], [b, d]]) @ e)
        return c2.ELinear(a, b, d, (f1, f2)).at()


def random_psi(rng: np.random.Generator) -> Psi:
    """One of the built-in families."""
    return [c2.psi.constant, c2.psi.rational, c2.psi.exponential, c2.psi.tanh, lambda: c2.psi.hill(rng.integers(1, 9))][
        rng.integers(5)
    ]()


def _is_saddle(Q: EquatorEquilibria, i: int) -> bool:
    """On the hemisphere, with eigenvalues lambda_theta and -lambda_rho (thm:geneps0)."""
    return bool(Q.lambda_theta[i] * Q.lambda_rho[i] > 0.0)


def contradictions(at: Coefficients, psi: Psi) -> list[str]:
    """Everything about the skeleton that contradicts something else; a degenerate setting has none to offer."""
    named = c2.classify(at, psi)
    if named.degeneracies:
        return []
    wrong: list[str] = []
    Q, critical, cycles = c2.equator_equilibria(at), c2.critical_sets(at, psi), c2.limit_cycles(at, psi)
    # Poincaré-Hopf on the sphere that two copies of the hemisphere make: twice the inside, once the equator
    inside = sum(-1 if C.kind == "saddle" else 1 for C in critical)
    around = sum(-1 if _is_saddle(Q, i) else 1 for i in range(len(Q)))
    if 2 * inside + around != 2:
        wrong.append(f"indices: 2 * {inside} + {around} is not 2")
    wrong += [f"{c.theorem} fails: {c.sentence}" for c in c2.certificates(at, psi) if c.verdict is Verdict.FAILS]
    wrong += _cycles(at, critical, cycles, Q)
    wrong += _branches(at, psi, Q, critical, cycles)
    return wrong


def _cycles(at: Coefficients, critical: tuple, cycles: c2.LimitCycles, Q: EquatorEquilibria) -> list[str]:
    wrong = []
    if len(cycles) and not critical:
        wrong.append("a cycle without a critical set inside")
    if any(cycle.kind == "semistable" for cycle in cycles) or cycles.notes:
        return wrong  # named as near a fold, a Hopf bifurcation or a connection
    # the innermost cycle attracts from inside iff C repels, and from there on they alternate
    attracts = bool(critical) and critical[0].kind.startswith("unstable")
    for i, cycle in enumerate(cycles):
        if cycle.stable != attracts:
            wrong.append(f"cycle {i + 1} is {cycle.kind}, which its neighbour inside is not opposite to")
        attracts = not attracts
        e = -np.linalg.solve(at.A, at.f)
        if np.abs(cycle.mean_e - e).max() > 1e-6:
            wrong.append(f"prop:LC: the mean of e is {cycle.mean_e}, not {e}")
        if abs(math.log(cycle.multiplier / cycle.divergence_multiplier)) > 1e-5:
            wrong.append("the two multipliers differ")
    exponent = c2.equator_cycle(at)
    if critical and not len(Q) and exponent is not None:
        # the outermost invariant curve and the closed equator, which repels on the hemisphere iff it attracts outside
        outer = cycles[-1].stable if len(cycles) else critical[0].kind.startswith("stable")
        if outer != (exponent.exponent < 0.0):
            wrong.append("the closed equator and what is next to it attract both, or repel both")
    return wrong


def _branches(at: Coefficients, psi: Psi, Q: EquatorEquilibria, critical: tuple, cycles: c2.LimitCycles) -> list[str]:
    found = c2.separatrices(at, psi, cycles=cycles)
    wrong = []
    expected = 4 * sum(C.kind == "saddle" for C in critical) + sum(_is_saddle(Q, i) for i in range(len(Q)))
    inside = [branch for branch in found if branch.inside]
    if len(inside) != expected:
        wrong.append(f"{len(inside)} branches on the hemisphere, not {expected}")
    for branch in inside:
        if branch.connection or branch.end == "undecided":
            if not found.notes:
                wrong.append(f"the branch of {branch.origin} ends at {branch.end} and nothing says why")
            continue
        forward = branch.direction == "unstable"
        if branch.end.startswith("Q"):
            i = int(branch.end[1:]) - 1
            attracts = Q.lambda_theta[i] < 0.0 < Q.lambda_rho[i]
            repels = Q.lambda_rho[i] < 0.0 < Q.lambda_theta[i]
        elif branch.end.startswith("cycle"):
            cycle = cycles[int(branch.end.split()[1]) - 1]
            attracts, repels = cycle.kind != "unstable", cycle.kind != "stable"
        elif branch.end == "C":
            attracts = critical[0].kind.startswith("stable")
            repels = critical[0].kind.startswith("unstable")
        else:
            attracts = repels = branch.end == "equator"
        if not (attracts if forward else repels):
            wrong.append(f"the {branch.direction} branch of {branch.origin} ends at {branch.end}, which cannot be")
    return wrong
