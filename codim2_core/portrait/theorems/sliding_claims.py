"""Certificates of Theorem 3.3: critical sets, their kind, the slow flow on them, and the slow manifolds nearby."""

from __future__ import annotations

import numpy as np

from ...results.words import say
from ...systems.psi.constructors import comparison_families
from ...systems.psi.function import Psi
from ..layer_problem.critical import CriticalSet, critical_sets
from ..layer_problem.linearisation import matrix_determinant
from .facts import Array, Certificate, Facts, not_applicable, verdict_of
from .psi_claims import e_psi

NO_SET = say("no isolated critical set")
FOLDED = ("saddle-node", "degenerate")
EPS_VALUES = (1e-3, 1e-4)  # eps times the way to the slow manifold, of hypot(1, |x2|)
Z_STEP = 1e-5  # step along z, of 1 + |z|


def sliding_claims(facts: Facts) -> tuple[Certificate, ...]:
    """Evaluate Theorem 3.3(a) to (d)."""
    return _stand_still(facts), _kinds_claim(facts), _slow_flow(facts), _slow_manifold(facts)


def _labels(facts: Facts) -> list[str]:
    return ["C"] if len(facts.critical) == 1 else [f"C{i + 1}" for i in range(len(facts.critical))]


def _e_of(C: CriticalSet, psi: Psi) -> Array:
    """e_Psi at the place of C in the scaling chart, by the formula (2.19)."""
    return e_psi(psi, C.x2[None], 1.0)[0]


def _stand_still(facts: Facts) -> Certificate:
    theorem = "thm:geneps1(a)"
    statement = say("stands still")
    if not facts.critical:
        return not_applicable(theorem, statement, NO_SET)
    numbers, holds = [], True
    for label, C in zip(_labels(facts), facts.critical, strict=True):
        residual = float(np.abs(facts.frozen_system.U(_e_of(C, facts.psi))).max())
        numbers.append((f"|U(e_Ψ)| at {label}", residual))
        holds &= residual <= (1e-6 if C.kind in FOLDED else 1e-8) * facts.size
    return Certificate(theorem, statement, verdict_of(holds), tuple(numbers), say("vanishes there"))


def _kinds_claim(facts: Facts) -> Certificate:
    theorem = "thm:geneps1(b)"
    statement = say("sign of the determinant")
    if not facts.critical:
        return not_applicable(theorem, statement, NO_SET)
    numbers: list[tuple[str, float]] = []
    holds, words = True, []
    for label, C in zip(_labels(facts), facts.critical, strict=True):
        (m11, m12), (m21, m22) = facts.frozen_system.DU(C.e).tolist()
        det, sign = matrix_determinant(m11, m12, m21, m22)
        numbers += [(f"det D U at {label}", det), (f"det J at {label}", C.determinant), (f"tr J at {label}", C.trace)]
        words.append(f"{label} is {'an' if C.kind.startswith('unstable') else 'a'} {C.kind}")
        if C.kind not in FOLDED:
            holds &= (C.kind == "saddle") == (sign < 0) and sign * C.determinant >= 0.0  # = 0.0: it has underflown
    sentence = say("one sign of two determinants", which="; ".join(words))
    return Certificate(theorem, statement, verdict_of(holds), tuple(numbers), sentence)


def _slow_flow(facts: Facts) -> Certificate:
    theorem, statement = "thm:geneps1(c)", say("independent of Ψ")
    if not facts.critical:
        return not_applicable(theorem, statement, NO_SET)
    if not facts.frozen_system.m:
        return not_applicable(theorem, statement, say("no slow variable"))
    numbers, holds = [], True
    for other in dict.fromkeys((facts.psi, *comparison_families(1))):
        found = facts.problem.with_psi(other).critical
        worst = 0.0
        for C, D in zip(facts.critical, found, strict=False):
            worst = max(worst, float(np.abs(facts.frozen_system.W(_e_of(D, other)) - C.slow_flow).max()))
        numbers.append((f"largest change of z′ with Ψ = {other.words}", worst))
        folded = any(C.kind in FOLDED for C in facts.critical)
        holds &= len(found) == len(facts.critical) and worst <= (1e-4 if folded else 1e-7) * facts.slow_size
    return Certificate(
        theorem, statement, verdict_of(holds), tuple(numbers),
        say("elsewhere in the chart"),
    )  # fmt: skip


def _slow_manifold(facts: Facts) -> Certificate:
    theorem = "thm:geneps1(d)"
    statement = say("slow manifold")
    if not facts.critical:
        return not_applicable(theorem, statement, NO_SET)
    if not facts.frozen_system.m:
        return not_applicable(theorem, statement, say("m = 0, an equilibrium"))
    if facts.system is None or len(facts.z) != facts.frozen_system.m:
        return not_applicable(theorem, statement, say("frozen"))
    numbers: list[tuple[str, float]] = []
    holds, skipped = True, []
    neighbours = _finite_difference(facts)
    for label, C in zip(_labels(facts), facts.critical, strict=True):
        rate, size = float(np.abs(C.eigenvalues.real).min()), float(np.abs(C.eigenvalues).max())
        moved = _set_derivative(neighbours, C)
        if C.kind in FOLDED or rate <= 1e-6 * size or moved is None:
            skipped.append(label)
            continue
        # x2 = x2* + eps s solves eps Dx2* W = U to first order: J s = Dx2* W
        drift = moved @ C.slow_flow
        shift = np.linalg.solve(C.jacobian, drift)
        length = float(np.hypot(*shift))
        unit = float(np.hypot(1.0, np.hypot(*C.x2))) / length if length else 1.0
        left = []
        for eps in (EPS_VALUES[0] * unit, EPS_VALUES[1] * unit):
            U = facts.frozen_system.U(e_psi(facts.psi, (C.x2 + eps * shift)[None], 1.0)[0])
            left.append(float(np.abs(U - eps * drift).max()))
        numbers += [(f"|x₂ − x₂*|/ε at {label}", length), (f"defect at {label}", left[0])]
        # what is left over is of second order: it falls by 100 where eps falls by 10
        numbers.append((f"and where ε is a tenth, at {label}", left[1]))
        holds &= left[1] <= 0.05 * left[0] + 1e-13 * facts.size
    if not numbers:
        why = say("not hyperbolic" if len(skipped) == 1 else "not hyperbolic, several", which=", ".join(skipped))
        return not_applicable(theorem, statement, why)
    return Certificate(
        theorem, statement, verdict_of(holds), tuple(numbers),
        say("up to second order"),
    )  # fmt: skip


SideSets = list[tuple[float, list[tuple[CriticalSet, ...]]]]


def _finite_difference(facts: Facts) -> SideSets | None:
    """Critical sets at z +- h in each slow variable, and h; None at the edge of where the formulas are defined."""
    found: SideSets = []
    for k, value in enumerate(facts.z):
        h = Z_STEP * (1.0 + abs(value))
        places = [(*facts.z[:k], value + side, *facts.z[k + 1 :]) for side in (h, -h)]
        try:
            found.append((h, [critical_sets(facts.system, facts.psi, z) for z in places]))
        except ValueError:
            return None
    return found


def _set_derivative(neighbours: SideSets | None, C: CriticalSet) -> Array | None:
    """Differentiate x2 of C by z, (2, m), from the critical sets on either side; None where they are not there."""
    columns = []
    for h, sides in neighbours or []:
        near = [[D.x2 for D in found if D.kind == C.kind] for found in sides]
        if not all(near):
            return None
        ends = [min(places, key=lambda x2: float(np.hypot(*(x2 - C.x2)))) for places in near]
        columns.append((ends[0] - ends[1]) / (2.0 * h))
    return np.stack(columns, axis=-1) if columns else None
