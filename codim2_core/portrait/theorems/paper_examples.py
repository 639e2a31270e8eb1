"""Certificates of the paper's three examples (Section 5), for systems that are one of them at their z."""

from __future__ import annotations

import math

import numpy as np

from ...results.words import say
from ...systems.examples.attracting_repelling import attracting_repelling
from ...systems.examples.nonunique_sliding import nonunique_sliding
from ...systems.typed import System
from .facts import RAY_ANGLES, RELATIVE_TOLERANCE, Certificate, Claim, Facts

_DISC_NET = np.concatenate(
    [r * np.stack([np.cos(RAY_ANGLES), np.sin(RAY_ANGLES)], axis=-1) for r in (0.0, 0.4, 0.8, 1.0)]
)


def ball_in_pool(facts: Facts) -> Certificate:
    """Evaluate Section 5.1: a = d < 0, b = 0, f = g and B = 2/7 A."""
    claim = Claim("sec:ballpool", say("ball"))
    at, form = facts.problem.at, facts.form
    own = form is not None and at.m == 2 and form.a == form.d < 0.0 == form.b
    if own:
        assert form is not None
        zero = np.zeros(2)
        f, g = at.U(zero), at.W(zero)
        own = bool(np.abs(at.W(_DISC_NET) - (2.0 / 7.0 * form.a * _DISC_NET + f)).max() <= 1e-12 * facts.size)
        own = own and bool(np.abs(f - g).max() <= 1e-12 * facts.size)
    if not own or form is None:
        return claim.not_applicable(say("not the ball"))
    f = at.U(np.zeros(2))
    ratio = float(np.hypot(*f)) / abs(form.a)
    if abs(ratio - 1.0) <= 1e-12:
        return claim.not_applicable(say("ball, on the border"))
    sticks = bool(facts.critical) and facts.critical[0].kind == "stable node"
    gap = float(np.abs(facts.critical[0].slow_flow - 5.0 / 7.0 * f).max()) if facts.critical else 0.0
    count = len(facts.equator)
    holds = (
        sticks == (ratio < 1.0)
        and gap <= RELATIVE_TOLERANCE * facts.size
        and (count == 2 or facts.equator.all_directions)
    )
    words = say("ball sticks") if sticks else say("ball slips")
    numbers = (("|f|/|a|", ratio), ("limit directions", float(count)), ("|z′ − 5f/7|", gap))
    return claim.decided(holds, numbers, words)


def _is(facts: Facts, example: System) -> bool:
    """Whether U and W at this z are those of an example at that z."""
    at = facts.problem.at
    if at.m != example.m or not at.z:
        return False
    other = example.at(at.z)
    near = lambda u, v: bool(np.abs(u - v).max() <= 1e-12 * facts.size)
    return near(at.U(_DISC_NET), other.U(_DISC_NET)) and near(at.W(_DISC_NET), other.W(_DISC_NET))


def attracting_and_repelling(facts: Facts) -> Certificate:
    """Evaluate Section 5.2."""
    claim = Claim("sec:mateslidecross", say("attracting and repelling"))
    if not _is(facts, attracting_repelling()):
        return claim.not_applicable(say("not attracting and repelling"))
    equator = facts.equator
    worst = float(np.abs(equator.theta - np.arange(6) * math.pi / 3.0).max()) if len(equator) == 6 else math.pi
    signs = len(equator) == 6 and bool(
        equator.lambda_rho[0] > 0.0
        and (equator.lambda_rho[1:] < 0.0).all()
        and (equator.lambda_theta[::2] < 0.0).all()
        and (equator.lambda_theta[1::2] > 0.0).all()
    )
    kinds = [C.kind for C in facts.critical]
    places = [(1.0 - math.sqrt(5.0)) / 4.0, (1.0 + math.sqrt(5.0)) / 4.0]
    gap = max((abs(C.e[0] - c) for C, c in zip(facts.critical, places, strict=False)), default=math.inf)
    holds = worst <= RELATIVE_TOLERANCE and signs and kinds == ["stable node", "saddle"] and gap <= RELATIVE_TOLERANCE
    numbers = (("limit directions", float(len(equator))), ("largest |θ_i − (i − 1)π/3|", worst))
    numbers += (("critical sets", float(len(kinds))), ("largest |c − (1 ± √5)/4|", float(gap)))
    words = say("within a third")
    return claim.decided(holds, numbers, words)


def nonunique(facts: Facts) -> Certificate:
    """Evaluate Section 5.3 (8 limit directions only while chi(z)^2 < 2, see the errata)."""
    claim = Claim("sec:nonunique", say("non-unique"))
    if not _is(facts, nonunique_sliding()):
        return claim.not_applicable(say("not non-unique"))
    z = float(facts.problem.at.z[0])
    chi = (1.0 + 2.0 * z * z) / (1.0 + z * z)
    kinds = [C.kind for C in facts.critical]
    flows = [float(C.slow_flow[0]) for C in facts.critical]
    expected = [chi + 0.25, 0.25, -chi + 0.25]
    gap = max((abs(u - v) for u, v in zip(flows, expected, strict=False)), default=math.inf)
    count = 8 if chi**2 < 2.0 else 4
    firm = abs(chi**2 - 2.0) > 1e-9
    holds = kinds == ["stable node", "saddle", "stable node"] and gap <= RELATIVE_TOLERANCE
    holds = holds and (len(facts.equator) == count or not firm)
    numbers = (("χ(z)", chi), ("critical sets", float(len(kinds))), ("limit directions", float(len(facts.equator))))
    numbers += (("largest difference of slow flows from ±χ + 1/4, 1/4", gap),)
    words = say("two slow flows", first=expected[0], third=expected[2])
    return claim.decided(holds, numbers, words)
