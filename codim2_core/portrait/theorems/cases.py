"""Certificates of Theorem 4.3 and Theorem 4.4."""

from __future__ import annotations

import math

import numpy as np

from ...results.words import say
from ...systems.examples.paper import attracting_repelling, nonunique_sliding
from ...systems.psi.constructors import comparison_families
from ...systems.typed import System
from ..layer_problem.linearisation import Existence
from .facts import RAY_ANGLES, RELATIVE_TOLERANCE, Certificate, Claim, Facts

ANGLE_ROUNDING = 4.0 * np.finfo(float).eps
NOT_LINEAR = say("U not e-linear")


def normal_form(facts: Facts) -> Certificate:
    """Evaluate Lemma B.1."""
    claim = Claim("lem:normalform", say("rotation"))
    affine, form = facts.problem.at.affine, facts.form
    if affine is None or form is None:
        return claim.not_applicable(NOT_LINEAR)
    phi = form.rotation if form.given is not None else 0.0
    c, s = math.cos(phi), math.sin(phi)
    R = np.array([[c, -s], [s, c]])
    A, f = np.array(affine[:4]).reshape(2, 2), np.array(affine[4:])
    worst = max(float(np.abs(R @ A @ R.T - form.A).max()), float(np.abs(R @ f - form.f).max()))
    return claim.decided(
        worst <= 1e-14 * max(facts.size, 1e-300) * 8.0,
        (("φ", phi), ("a", form.a), ("b", form.b), ("d", form.d), ("largest |R A Rᵀ − [[a, −b], [b, d]]|", worst)),
        say("no rotation") if phi == 0.0 else say("rotated", phi=phi),
    )


def _compare_angles(facts: Facts, claim: Claim, expected: list[float], sentence: str) -> Certificate:
    """Hold angles in the normal form's axes against the limit directions found."""
    form = facts.form
    assert form is not None
    found = facts.equator.theta + (0.0 if facts.problem.at.as_given is not None else form.rotation)
    worst = 0.0
    for theta in expected:
        gaps = [abs(math.remainder(theta - float(other), 2.0 * math.pi)) for other in found]
        worst = max(worst, min(gaps, default=math.pi))
    distinct = len(facts.equator)
    # next to a saddle-node or pitchfork angles are known to the root of the rounding
    close = 1e-5 if facts.generic else 1e-4
    holds = worst <= close and (distinct == len(expected) or not facts.generic)
    numbers = tuple((f"θ* {i + 1}", math.remainder(theta, 2.0 * math.pi)) for i, theta in enumerate(expected))
    numbers += (("limit directions found", float(distinct)), ("largest difference", worst))
    return claim.decided(holds, numbers, sentence)


def equal_diagonal(facts: Facts) -> Certificate:
    """Evaluate D1, a = d."""
    claim = Claim("sec:lin, D1", say("D1"))
    form = facts.form
    if form is None:
        return claim.not_applicable(NOT_LINEAR)
    if form.a != form.d:
        return claim.not_applicable(say("a and d differ"))
    length = math.hypot(form.f1, form.f2)
    # turning a matrix leaves a rounding of its entries, and with b = f = 0 nothing else
    least = 0.0 if form.given is None else ANGLE_ROUNDING * max(abs(form.a), abs(form.d))
    if max(length, abs(form.b)) <= least:
        return claim.not_applicable(say("every direction, b = 0"))
    expected: list[float] = []
    if abs(form.b) <= length:
        turn, half = math.atan2(form.f2, form.f1), math.asin(form.b / length)
        expected = [turn + half] if abs(form.b) == length else [turn + half, turn + math.pi - half]
    return _compare_angles(facts, claim, expected, say("D1, here", b=abs(form.b), f=length))


def symmetric(facts: Facts) -> Certificate:
    """Evaluate D2, b = 0 and a component of f zero (its printed sign is a slip, see the errata)."""
    claim = Claim("sec:lin, D2", say("D2"))
    form = facts.form
    if form is None:
        return claim.not_applicable(NOT_LINEAR)
    if form.b != 0.0 or form.f1 * form.f2 != 0.0 or (form.f1 != 0.0 and form.f2 != 0.0):
        return claim.not_applicable(say("not D2"))
    if facts.equator.all_directions or (form.f1 == form.f2 == 0.0 and form.a == form.d):  # or all but for rounding
        return claim.not_applicable(say("nothing turns at f = 0, D2"))
    spread = form.d - form.a
    if form.f2 == 0.0:
        expected, force = [0.0, math.pi], form.f1
        if abs(force) < abs(spread):
            half = math.acos(force / spread)
            expected += [half, -half]
    else:
        expected, force = [0.5 * math.pi, -0.5 * math.pi], form.f2
        if abs(force) < abs(spread):
            half = math.asin(-force / spread)
            expected += [half, math.pi - half]
    key = "D2, at the pitchfork" if abs(force) == abs(spread) else "D2, here"
    return _compare_angles(facts, claim, expected, say(key, f=abs(force), spread=abs(spread)))


def _reason(facts: Facts) -> str:
    return NOT_LINEAR if facts.location is None else facts.location.existence.value


def case1(facts: Facts) -> tuple[Certificate, ...]:
    """Evaluate Theorem 4.3."""
    with_set, without, five = (Claim(f"thm:{part}", say(part)) for part in ("case1(a)", "case1(b)", "case1(c)"))
    if facts.portrait.case != "I":
        why = say("not Case I") if facts.form is not None else NOT_LINEAR
        return tuple(claim.not_applicable(why) for claim in (with_set, without, five))
    return _case1a(facts, with_set), _without_set(facts, without), _five(facts, five)


def _case1a(facts: Facts, claim: Claim) -> Certificate:
    if not facts.critical:
        return claim.not_applicable(_reason(facts))
    assert facts.form is not None
    a, d = facts.form.a, facts.form.d
    backwards = a > 0.0
    # div = tangential (beta + alpha sigma), alpha and beta between a and d, sigma > 0: it has the sign of a and d.
    # (The paper prints the denominator zeta^2 + Psi; it is (zeta^2 + Psi)^(3/2).)
    zeta = np.geomspace(1e-4, 1e4, 81)
    s = zeta**2
    P, slope = facts.psi(s), facts.psi.derivative(s)
    x, y = zeta[:, None] * np.cos(RAY_ANGLES), zeta[:, None] * np.sin(RAY_ANGLES)
    weight = (s + P)[:, None]
    top = (a + d) * P[:, None] - (a * x**2 + d * y**2) * slope[:, None] + a * y**2 + d * x**2
    divergence = top / weight**1.5
    # scaled by 1/sqrt(zeta^2 + Psi): between the bound and its double or more, all over the plane
    scaled = divergence * np.sqrt(weight) * (-1.0 if backwards else 1.0)
    bound = -min(abs(a), abs(d))
    one_sign = float(scaled.max()) <= bound * (1.0 - 1e-9)
    count = len(facts.equator)
    towards = facts.equator.lambda_rho * (-1.0 if backwards else 1.0)
    arriving = bool((towards[~facts.equator.radially_degenerate] < 0.0).all())
    kind = facts.critical[0].kind
    stable = kind.startswith("unstable" if backwards else "stable")
    holds = len(facts.critical) == 1 and one_sign and stable and arriving and (count in (0, 2, 4) or not facts.generic)
    what = "largest √(ζ²+Ψ) div" + (" (time reversed)" if backwards else "")
    numbers = (("critical sets", 1.0), (what, float(scaled.max())), ("its bound −min(|a|, |d|)", bound),
               ("tr J", facts.critical[0].trace), ("limit directions", float(count)))  # fmt: skip
    kind = f"{'an' if kind.startswith('unstable') else 'a'} {kind}"
    sentence = say("one sign", sign="positive" if backwards else "negative", kind=kind)
    if not facts.generic:
        sentence += " " + say("count not generic")
    return claim.decided(holds, numbers, sentence)


def _without_set(facts: Facts, claim: Claim) -> Certificate:
    if facts.location is None or facts.location.existence is not Existence.NONE:
        return claim.not_applicable(_reason(facts))
    count = len(facts.equator)
    numbers = (("critical sets", float(len(facts.critical))), ("limit directions", float(count)))
    if not facts.generic:
        holds = not facts.critical and count >= 1
        return claim.decided(holds, numbers, say("none, on a border", count=count))
    return claim.decided(not facts.critical and count in (2, 4), numbers, say("none, generic", count=count))


def _five(facts: Facts, claim: Claim) -> Certificate:
    if facts.portrait.degeneracies:
        names = ", ".join(d.name for d in facts.portrait.degeneracies)
        return claim.not_applicable(say("portrait not generic", names=names))
    name = facts.portrait.name
    return claim.decided(
        name in ("CM0", "CM2", "CM4", "NCM2", "NCM4"),
        (("limit directions", float(len(facts.equator))), ("critical sets", float(len(facts.critical)))),
        say("this one", name=name),
    )


def case2(facts: Facts) -> tuple[Certificate, ...]:
    """Evaluate Theorem 4.4."""
    with_set, without = (Claim(f"thm:{part}", say(part)) for part in ("case2(a)", "case2(b)"))
    if facts.portrait.case != "II":
        why = NOT_LINEAR if facts.form is None else say("not Case II")
        return with_set.not_applicable(why), without.not_applicable(why)
    second = _without_set(facts, without)
    if not facts.critical:
        return with_set.not_applicable(_reason(facts)), second
    equator = facts.equator
    products = (equator.lambda_rho * equator.lambda_theta).tolist()
    saddles = all(
        C.kind == "saddle" for psi in (facts.psi, *comparison_families(1)) for C in facts.problem.with_psi(psi).critical
    )
    holds = saddles and len(products) == 4 and all(v < 0.0 for v in products)
    numbers = (("det J", facts.critical[0].determinant), ("limit directions", float(len(products))),
               *((f"λ_ρ λ_θ at {label}", v) for label, v in zip(equator.labels, products, strict=True)))  # fmt: skip
    first = with_set.decided(holds, numbers, say("one for each separatrix"))
    return first, second


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
