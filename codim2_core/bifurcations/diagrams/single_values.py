"""Events at a single value of a parameter, with the same class on both sides of it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ...numerics.sign_changes import roots
from ...results.arrays import Array
from ...results.special_kinds import HOPF, SpecialKind
from ...results.words import say
from ..families import special_points
from ..families.family import AXES, SystemFamily
from .candidates import MAX_BLUR, Candidate, portrait_place
from .name_changes import triple_zero
from .result import SpecialValue
from .states import States

__all__ = ["single_values"]

_TOUCH_REACH = 2e-3  # of the span: how far about a double zero its function is fitted
_TOUCH_TOLERANCE = 1e-9  # of 1 - |e|^2, and of tr J over the size of J: what touches zero
_ZERO_SHARE = 1e-12  # of |U|: Theta where every direction is a limit direction
SAME_PLACE = 0.05  # in the disc: of one point
_LINE_SHARE = 1e-9  # of adj(A) f, where f is in the range of A
_NEWTON_ROUNDS = 12


def single_values(
    family: SystemFamily, states: States, found: Sequence[Candidate], named: Sequence[SpecialValue], u: Array
) -> list[SpecialValue]:
    """Name crossings, touches, values with det A = 0 or with all directions, and what parts no names.

    Shapes: u (n,).
    """
    everywhere = _all_directions(family, u)
    out = [_special(family, "all directions", v, (0.0, 0.0), say("nothing turns at f = 0")) for v in everywhere]
    known = [*out, *named]
    for one in found:
        if isinstance(one.what, SpecialKind) and not one.what.parts:
            if one.regular and one.what.holds(special_points.set_numbers(family, one.y[:, None])[2][0]):
                out.append(_special(family, one.what.kind, one.u, _portrait_place(family, states, one), one.what.says))
        elif not any(_same_point(family, other, one.u, _portrait_place(family, states, one)) for other in known):
            out += _touches(family, states, one)
    return out + (list(_singular_values(family, u)) if family.affine else [])


def _special(family: SystemFamily, kind: str, u: float, place: tuple[float, float], sentence: str) -> SpecialValue:
    return SpecialValue(kind, family.value(u), place, sentence)


def _same_point(family: SystemFamily, other: SpecialValue, u: float, place: tuple[float, float]) -> bool:
    near = abs(family.unit(other.value) - u) <= MAX_BLUR
    return near and (other.kind == "all directions" or math.dist(other.place, place) < SAME_PLACE)


def _portrait_place(family: SystemFamily, states: States, one: Candidate) -> tuple[float, float]:
    """Return the place in the disc, in the axes of the system at that value."""
    state = states(family.value(one.u)) if family.turns else None
    return portrait_place(family, one.y, state.turn if state else 0.0)


def _touches(family: SystemFamily, states: States, one: Candidate) -> Iterator[SpecialValue]:
    """Yield what a candidate is at which no class changes: a crossing, or a function that only touches zero."""
    if one.what == "crossing":
        theta, place = float(one.y[0]), _portrait_place(family, states, one)
        at = f"θ = {math.atan2(place[1], place[0]) % math.tau:.4g}"
        h = np.array([[1e-3, 0.0], [0.0, 1e-3]])
        by_theta, by_u = (
            (special_points.equator_numbers(family, (one.y + way)[:, None])[2],
             special_points.theta_by_parameter(family, (one.y + way)[:, None])) for way in h
        )  # fmt: skip
        crossing = float(by_theta[0][0] * by_u[1][0] - by_theta[1][0] * by_u[0][0]) <= 0.0
        kind = "exchange of limit directions" if crossing else "saddle-node"
        yield _special(family, kind, one.u, place, say("pass through" if crossing else "touch", at=at))
    elif one.what == "triple":
        place, theta = _portrait_place(family, states, one), float(one.y[0])
        turned = math.atan2(place[1], place[0])
        yield triple_zero(family, family.value(one.u), turned % math.tau, turned - theta)
    elif (one.what == "equator" or one.what is HOPF) and not one.regular:
        u = one.u + _TOUCH_REACH * np.linspace(-1.0, 1.0, 17)
        u = u[(u > 0.0) & (u < 1.0)]

        def function(u: Array) -> Array:
            e = _sets_at(family, one.y[:2], u)
            if one.what == "equator":
                return 1.0 - e[0] ** 2 - e[1] ** 2
            _, trace, determinant, _ = special_points.set_numbers(family, np.stack([*e, u]))
            return trace / np.sqrt(trace**2 + np.abs(determinant))

        values = function(u)
        leaves = values[0] * values[-1] > 0.0 and np.abs(values[[0, -1]]).min() > 10.0 * _TOUCH_TOLERANCE
        if not (np.isfinite(values).all() and leaves and np.abs(function(np.array([one.u]))[0]) <= _TOUCH_TOLERANCE):
            return
        fit = np.polynomial.Polynomial.fit(u, values, 6)
        slope, bend, v = fit.deriv(1), fit.deriv(2), one.u
        for _ in range(_NEWTON_ROUNDS if bend(v) else 0):
            v -= min(max(float(slope(v) / bend(v)), -_TOUCH_REACH), _TOUCH_REACH)
        if abs(v - one.u) <= MAX_BLUR:
            there = Candidate(one.what, v, np.array([*_sets_at(family, one.y[:2], np.array([v]))[:, 0], v]), False)
            place = _portrait_place(family, states, there)
            theta = math.atan2(place[1], place[0]) % math.tau
            if one.what == "equator":
                kind, sentence = "touching the equator", say("border, turns back", theta=theta)
                place = (math.cos(theta), math.sin(theta))
            else:
                kind, sentence = "tr J = 0", say("trace touches zero")
            yield _special(family, kind, v, place, sentence)


def _sets_at(family: SystemFamily, start: Array, u: Array) -> Array:
    """Follow a critical set to some values (n,) by Newton's method: (2, n)."""
    e = np.repeat(start[:, None], len(u), axis=1)
    with np.errstate(all="ignore"):
        for _ in range(_NEWTON_ROUNDS):
            (U, V), ((a, b), (p, q)) = family.on_net(e[0], e[1], u)
            det = a * q - b * p
            e = e - np.stack([(q * U - b * V) / det, (a * V - p * U) / det])
    return e


def _all_directions(family: SystemFamily, u: Array) -> list[float]:
    """Find where Theta vanishes in every direction, by Gauss and Newton's method."""
    theta = 2.0 * np.pi * (np.arange(16) + 0.3) / 16
    c, s = np.cos(theta), np.sin(theta)

    def turning(u: Array, by: str = "") -> Array:
        U, V = family.speed_on_net(c, s, u[:, None], by=by)
        return c * V - s * U

    size = np.linalg.norm(turning(u), axis=1)
    found = u[np.r_[True, size[1:] <= size[:-1]] & np.r_[size[:-1] <= size[1:], True]]
    if len(found) > len(u) // 2:  # all along, or never
        return []
    for _ in range(_NEWTON_ROUNDS):
        here, slope = turning(found), turning(found, AXES[0])
        square = (slope * slope).sum(axis=1)
        found = np.clip(found - (here * slope).sum(axis=1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    return np.unique(found[np.abs(turning(found)).max(axis=1) <= _ZERO_SHARE].round(14)).tolist()


def _singular_values(family: SystemFamily, u: Array) -> Iterator[SpecialValue]:
    """Yield where det A = 0, of a U that is affine in e: A e = -f has no solution there, or a line of them."""

    def numbers(u: Array) -> Array:
        """Return det A, and adj(A) f."""
        (U, V), ((a, b), (c, d)) = family.on_net(0.0 * u, 0.0 * u, u)
        return np.stack([a * d - b * c, d * U - b * V, a * V - c * U])

    sizes = np.abs(numbers(u)).max(axis=1)
    which = 0 if sizes[0] > _ZERO_SHARE else 1 + int(sizes[1:].argmax())
    if sizes[which] <= _ZERO_SHARE:
        return
    function = lambda u: numbers(u)[which]
    found = roots(function, [u], [function(u)])
    for v in [*found.zeros[0].tolist(), *found.touches[0].tolist()]:
        there = np.abs(numbers(np.array([v]))[1:]).max()
        if there <= _LINE_SHARE:
            yield _special(family, "line of equilibria", v, (0.0, 0.0), say("line at one value"))
        elif which == 0:
            yield _special(family, "det A = 0", v, (0.0, 0.0), say("through infinity"))
