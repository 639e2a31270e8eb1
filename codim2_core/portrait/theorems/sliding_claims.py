"""Certificates of Theorem 3.3: critical sets, their kind, the slow flow on them, and the slow manifolds nearby."""

from __future__ import annotations

import math

import numpy as np

from ...results.arrays import Array
from ...results.words import say
from ...systems.psi.constructors import comparison_families
from ...systems.psi.function import Psi
from ..layer_problem.critical import CriticalSet, critical_sets
from ..layer_problem.linearisation import matrix_determinant
from .facts import RAY_ANGLES, Certificate, Claim, Facts

ZETA = np.geomspace(1e-3, 1e3, 49)
CLAIM_ROUNDING = 1e-12


def e_psi(psi: Psi, xy: Array, eps: float) -> Array:
    """(2.19) as it is written, ``(x, y)/sqrt(x^2 + y^2 + eps^2 Psi((x^2 + y^2)/eps^2))``; (k, 2)."""
    s = (xy**2).sum(axis=-1)
    return xy / np.sqrt(s + eps**2 * psi(s / eps**2))[..., None]


def psi_claims(psi: Psi) -> tuple[Certificate, ...]:
    """Evaluate Lemma 2.6 and Remark 3.2; a Psi outside the class of Definition 2.3 need not meet them."""
    return _equivariant(psi), _homogeneous(psi), _one_to_one(psi), _shorter(psi), _positivity_claim(psi)


def _points() -> Array:
    return ZETA[:, None] * np.stack([np.cos(1.0 + ZETA), np.sin(1.0 + ZETA)], axis=-1)


def _equivariant(psi: Psi) -> Certificate:
    points, angles = _points(), RAY_ANGLES[1::5]
    c, s = np.cos(angles), np.sin(angles)
    turns = np.stack([np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)], axis=-2)  # from the right
    turned, here = points @ turns, e_psi(psi, points, 1.0)
    worst = float(np.abs(e_psi(psi, turned.reshape(-1, 2), 1.0).reshape(turned.shape) - here @ turns).max())
    return Claim("lem:ePsi(a)", say("lem:ePsi(a)")).decided(
        worst <= CLAIM_ROUNDING, (("largest difference", worst),), say("through the square")
    )


def _homogeneous(psi: Psi) -> Certificate:
    points, worst = _points(), 0.0
    here = e_psi(psi, points, 1.0)
    for k in (0.01, 0.3, 7.0, 1000.0):
        worst = max(worst, float(np.abs(e_psi(psi, k * points, k) - here).max()))
    return Claim("lem:ePsi(b)", say("lem:ePsi(b)")).decided(
        worst <= CLAIM_ROUNDING, (("largest difference", worst),), say("one scale")
    )


def _one_to_one(psi: Psi) -> Certificate:
    modulus = np.array([float(v) for v in psi.modulus(ZETA)])
    rises = bool((np.diff(modulus) >= 0.0).all() and (np.diff(modulus[modulus < 1.0 - 1e-12]) > 0.0).all())
    inner = ZETA[modulus < 0.999]
    back = np.array([float(psi.radius(float(psi.modulus(float(zeta))))) for zeta in inner])
    worst = float(np.abs(back / inner - 1.0).max(initial=0.0))
    return Claim("lem:ePsi(c)", say("lem:ePsi(c)")).decided(
        rises and worst <= 1e-9 and psi.saturation == math.inf,
        (("least increase of |e_Ψ| sampled", float(np.diff(modulus).min())), ("largest |ζ(|e_Ψ|)/ζ − 1|", worst)),
        say("one place"),
    )


def _shorter(psi: Psi) -> Certificate:
    s = ZETA**2
    # 1 - |e|^2 = Psi/(s + Psi), without cancellation
    values = psi(s)
    least = float((values / (s + values)).min())
    return Claim("lem:ePsi(d)", say("lem:ePsi(d)")).decided(
        psi.saturation == math.inf and least >= 0.0, (("least 1 − |e_Ψ|² sampled", least),), say("complement")
    )


def _positivity_claim(psi: Psi) -> Certificate:
    s = ZETA[ZETA < 30.0] ** 2
    P, slope = psi(s), psi.derivative(s)
    weight = s + P
    trace, determinant = (s * (1.0 - slope) + 2.0 * P) / weight**1.5, (P - slope * s) / weight**2
    least = min(float((trace * np.sqrt(weight)).min()), float((determinant * weight).min()))
    # against differences of e_Psi itself
    zeta, h = 0.7, 1e-5
    e = lambda x, y: e_psi(psi, np.array([[x, y]]), 1.0)[0]
    D = np.stack([(e(zeta + h, 0.0) - e(zeta - h, 0.0)), (e(zeta, h) - e(zeta, -h))], axis=-1) / (2.0 * h)
    radial, tangential = psi.jacobian_factors(zeta)
    gap = float(np.abs(D - np.diag([radial, tangential])).max())
    return Claim("rem:jaco_properties", say("lem:ePsi(e)")).decided(
        least >= 0.0 and gap <= 1e-7 and psi.saturation == math.inf,
        (("least of tr·|(ζ, √Ψ)| and det·(ζ² + Ψ)", least), ("difference from differences of e_Ψ", gap)),
        say("saddle stays"),
    )


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
    claim = Claim("thm:geneps1(a)", say("stands still"))
    if not facts.critical:
        return claim.not_applicable(NO_SET)
    numbers, holds = [], True
    for label, C in zip(_labels(facts), facts.critical, strict=True):
        residual = float(np.abs(facts.frozen_system.U(_e_of(C, facts.psi))).max())
        numbers.append((f"|U(e_Ψ)| at {label}", residual))
        holds &= residual <= (1e-6 if C.kind in FOLDED else 1e-8) * facts.size
    return claim.decided(holds, numbers, say("vanishes there"))


def _kinds_claim(facts: Facts) -> Certificate:
    claim = Claim("thm:geneps1(b)", say("sign of the determinant"))
    if not facts.critical:
        return claim.not_applicable(NO_SET)
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
    return claim.decided(holds, numbers, sentence)


def _slow_flow(facts: Facts) -> Certificate:
    claim = Claim("thm:geneps1(c)", say("independent of Ψ"))
    if not facts.critical:
        return claim.not_applicable(NO_SET)
    if not facts.frozen_system.m:
        return claim.not_applicable(say("no slow variable"))
    numbers, holds = [], True
    for other in dict.fromkeys((facts.psi, *comparison_families(1))):
        found = facts.problem.with_psi(other).critical
        worst = 0.0
        for C, D in zip(facts.critical, found, strict=False):
            worst = max(worst, float(np.abs(facts.frozen_system.W(_e_of(D, other)) - C.slow_flow).max()))
        numbers.append((f"largest change of z′ with Ψ = {other.words}", worst))
        folded = any(C.kind in FOLDED for C in facts.critical)
        holds &= len(found) == len(facts.critical) and worst <= (1e-4 if folded else 1e-7) * facts.slow_size
    return claim.decided(holds, numbers, say("elsewhere in the chart"))


def _slow_manifold(facts: Facts) -> Certificate:
    claim = Claim("thm:geneps1(d)", say("slow manifold"))
    if not facts.critical:
        return claim.not_applicable(NO_SET)
    if not facts.frozen_system.m:
        return claim.not_applicable(say("m = 0, an equilibrium"))
    if facts.system is None or len(facts.z) != facts.frozen_system.m:
        return claim.not_applicable(say("frozen"))
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
        return claim.not_applicable(why)
    return claim.decided(holds, numbers, say("up to second order"))


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
