"""Certificates of Lemma B.1 and of the degenerate equators D1 and D2, which have closed forms."""

from __future__ import annotations

import math

import numpy as np

from ...results.words import say
from .facts import Certificate, Facts, not_applicable, verdict_of

ANGLE_ROUNDING = 4.0 * np.finfo(float).eps
NOT_LINEAR = say("U not e-linear")


def normal_form(facts: Facts) -> Certificate:
    """Evaluate Lemma B.1."""
    theorem, statement = "lem:normalform", say("rotation")
    affine, form = facts.problem.at.affine, facts.form
    if affine is None or form is None:
        return not_applicable(theorem, statement, NOT_LINEAR)
    phi = form.rotation if form.given is not None else 0.0
    c, s = math.cos(phi), math.sin(phi)
    R = np.array([[c, -s], [s, c]])
    A, f = np.array(affine[:4]).reshape(2, 2), np.array(affine[4:])
    worst = max(float(np.abs(R @ A @ R.T - form.A).max()), float(np.abs(R @ f - form.f).max()))
    return Certificate(
        theorem, statement, verdict_of(worst <= 1e-14 * max(facts.size, 1e-300) * 8.0),
        (("φ", phi), ("a", form.a), ("b", form.b), ("d", form.d), ("largest |R A Rᵀ − [[a, −b], [b, d]]|", worst)),
        say("no rotation") if phi == 0.0 else say("rotated", phi=phi),
    )  # fmt: skip


def _compare_angles(facts: Facts, theorem: str, statement: str, expected: list[float], sentence: str) -> Certificate:
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
    return Certificate(theorem, statement, verdict_of(holds), numbers, sentence)


def equal_diagonal(facts: Facts) -> Certificate:
    """Evaluate D1, a = d."""
    theorem = "sec:lin, D1"
    statement = say("D1")
    form = facts.form
    if form is None:
        return not_applicable(theorem, statement, NOT_LINEAR)
    if form.a != form.d:
        return not_applicable(theorem, statement, say("a and d differ"))
    length = math.hypot(form.f1, form.f2)
    # turning a matrix leaves a rounding of its entries, and with b = f = 0 nothing else
    least = 0.0 if form.given is None else ANGLE_ROUNDING * max(abs(form.a), abs(form.d))
    if max(length, abs(form.b)) <= least:
        return not_applicable(theorem, statement, say("every direction, b = 0"))
    expected: list[float] = []
    if abs(form.b) <= length:
        turn, half = math.atan2(form.f2, form.f1), math.asin(form.b / length)
        expected = [turn + half] if abs(form.b) == length else [turn + half, turn + math.pi - half]
    return _compare_angles(facts, theorem, statement, expected, say("D1, here", b=abs(form.b), f=length))


def symmetric(facts: Facts) -> Certificate:
    """Evaluate D2, b = 0 and a component of f zero (its printed sign is a slip, see the errata)."""
    theorem = "sec:lin, D2"
    statement = say("D2")
    form = facts.form
    if form is None:
        return not_applicable(theorem, statement, NOT_LINEAR)
    if form.b != 0.0 or form.f1 * form.f2 != 0.0 or (form.f1 != 0.0 and form.f2 != 0.0):
        return not_applicable(theorem, statement, say("not D2"))
    if facts.equator.all_directions or (form.f1 == form.f2 == 0.0 and form.a == form.d):  # or all but for rounding
        return not_applicable(theorem, statement, say("nothing turns at f = 0, D2"))
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
    return _compare_angles(facts, theorem, statement, expected, say(key, f=abs(force), spread=abs(spread)))
