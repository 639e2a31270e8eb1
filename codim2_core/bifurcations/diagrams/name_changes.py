"""The names of what happens between two states next to each other.

Events at a single value of a parameter, with the same class on both sides of it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from ...formulas.switches import kinks
from ...numerics.sign_changes import roots
from ...portrait.layer_problem.critical import CriticalSet
from ...results.arrays import Array
from ...results.special_kinds import DETERMINANT, HOPF, SpecialKind, change_between
from ...results.words import say
from ..families import special_points
from ..families.family import AXES, SystemFamily
from ..families.first_lyapunov import lyapunov
from ..families.special_points import equator_numbers
from .changes import MAX_BLUR, Candidate, Change, portrait_place
from .result import SpecialValue
from .states import States

_TOUCH_REACH = 2e-3  # of the span: how far about a double zero its function is fitted
_TOUCH_TOLERANCE = 1e-9  # of 1 - |e|^2, and of tr J over the size of J: what touches zero
_ZERO_SHARE = 1e-12  # of |U|: Theta where every direction is a limit direction
SAME_PLACE = 0.05  # in the disc: of one point
_LINE_SHARE = 1e-9  # of adj(A) f, where f is in the range of A
_NEWTON_ROUNDS = 12


def single_values(
    family: SystemFamily, states: States, found: Sequence[Candidate], named: Sequence[SpecialValue], u: Array
) -> list[SpecialValue]:
    """Name crossings, touches, values with det A = 0 or with all directions, and what parts no names; u (n,)."""
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


_SAME_EVENT_DISTANCE = 0.05  # radians, or distance in p, within which lies what is one at the special value, next to it
_EQUATOR_DISTANCE = 1e-3  # 1 - |e| of a critical set that reaches the equator at the special value, next to it
_SYMMETRY_ANGLES, _SYMMETRY_TOLERANCE = np.linspace(0.1, 3.1, 16), 1e-6  # of Theta about a triple zero


def name_changes(family: SystemFamily, change: Change, points: Sequence[Candidate]) -> list[SpecialValue]:
    """Name all that happens between two states next to each other; `points` are those solved for at the value."""
    return [*_of_equator(family, change, points), *_of_sets(family, change, points)]


def _of_equator(family: SystemFamily, change: Change, points: Sequence[Candidate]) -> list[SpecialValue]:
    """Name what limit directions do, and the closed equator."""
    value, before, after = change
    out = []
    one, two = before.equator.theta, after.equator.theta
    met: list[tuple[int, float]] = []
    if len(one) != len(two):
        met = _merged_directions(*((one, two) if len(one) > len(two) else (two, one)))
    elif len(one):
        # as many on both sides: some may have gone while others came
        away = abs(np.angle(np.exp(1j * (one[:, None] - two))))
        gone, come = one[away.min(axis=1) > _SAME_EVENT_DISTANCE], two[away.min(axis=0) > _SAME_EVENT_DISTANCE]
        met = [pair for side in (gone, come) for pair in _merged_directions(side, side[:0])]
    turn = _axes_angle(family, change)
    for count, theta in met:
        theta = _solved_angle(theta, points, turn)
        if count == 2:
            at = f"θ = {theta:.4g}"
            out.append(SpecialValue("saddle-node", value, _on_equator(theta), say("meet at", at=at)))
        else:
            out.append(triple_zero(family, value, theta, turn))
    if before.exponent is not None and after.exponent is not None and before.parts[2] != after.parts[2]:
        out.append(SpecialValue("neutral equator", value, (0.0, 0.0), say("equator neutral, a cycle may leave")))
    return out


def _axes_angle(family: SystemFamily, change: Change) -> float:
    """Return the angle from the axes of the family to those of the system at a change."""
    before, after = change.before.turn, change.after.turn
    return before + 0.5 * math.remainder(after - before, math.tau) if family.turns else 0.0


def triple_zero(family: SystemFamily, value: float, theta: float, turn: float) -> SpecialValue:
    """Name a triple zero of Theta at an angle of axes that are turned from those of the family."""
    at = f"θ = {theta:.4g}"
    if _is_symmetric(family, value, theta - turn):
        sentence = say("splits, D2" if family.affine else "splits", at=at)
        return SpecialValue("pitchfork", value, _on_equator(theta), sentence)
    return SpecialValue("cusp", value, _on_equator(theta), say("passes a cusp", at=at))


def _on_equator(theta: float) -> tuple[float, float]:
    return math.cos(theta), math.sin(theta)


def _solved_angle(theta: float, points: Sequence[Candidate], turn: float) -> float:
    """Return the angle of the point on the equator that was solved for nearest to an angle, in [0, 2 pi)."""
    angles = [math.atan2(one.y[1], one.y[0]) if one.what == "equator" else float(one.y[0]) for one in points
              if len(one.y) == 2 or one.what == "equator"]  # fmt: skip
    away = [math.remainder(angle + turn - theta, math.tau) for angle in angles]
    nearest = min(away, key=abs, default=math.inf)
    return (theta + nearest if abs(nearest) < _SAME_EVENT_DISTANCE else theta) % math.tau


def _is_symmetric(family: SystemFamily, value: float, theta: float) -> bool:
    """Whether Theta is odd about an angle: a triple zero there is then a pitchfork."""
    angles = theta + np.stack([_SYMMETRY_ANGLES, -_SYMMETRY_ANGLES])
    there = equator_numbers(family, np.stack([angles, np.full(angles.shape, family.unit(value))]))[0]
    return bool(np.abs(there.sum(axis=0)).max() <= _SYMMETRY_TOLERANCE * np.abs(there).max())


def _of_sets(family: SystemFamily, change: Change, points: Sequence[Candidate]) -> list[SpecialValue]:
    """Name what critical sets do: meet, reach the equator, or change their kind."""
    value, before, after = change
    out = []
    pairs, gone, come = _match_states(before.critical, after.critical)
    for side, other in ((gone, after), (come, before)):
        inner = []
        for C in side:
            t = math.atan2(float(C.e[1]), float(C.e[0]))
            turn = _axes_angle(family, change)
            angles = [
                *other.equator.theta,
                *(math.atan2(*one.y[1::-1]) + turn for one in points if one.what == "equator"),
            ]
            away = min((abs(math.remainder(angle - t, math.tau)) for angle in angles), default=math.inf)
            if 1.0 - float(np.hypot(*C.e)) < _EQUATOR_DISTANCE and away < _SAME_EVENT_DISTANCE:
                t = _solved_angle(t, points, turn)
                sentence = say("set reaches the equator", theta=t)
                out.append(SpecialValue("transcritical", value, _on_equator(t), sentence))
            else:
                inner.append(C)
        while len(inner) > 1:
            near = min(combinations(inner, 2), key=lambda pair: math.dist(pair[0].p, pair[1].p))
            inner = [C for C in inner if C is not near[0] and C is not near[1]]
            third = _turned_set(near, pairs)
            if third is not None:  # it goes on, and turned where the two came to it
                pairs.remove(third)
                place = (float(third[1].p[0]), float(third[1].p[1]))
                out.append(SpecialValue(DETERMINANT.kind, value, place, say("set splits")))
                continue
            kinds = sorted("saddle" if C.kind == "saddle" else "node" for C in near)
            sentence = say("two sets meet", one=kinds[1], other=kinds[0])
            place = _solved_place(family, change, points, "fold", _midpoint(near))[0]
            out.append(SpecialValue("fold of critical sets", value, place, sentence))
        for C in inner:
            place = (float(C.p[0]), float(C.p[1]))
            out.append(SpecialValue("change of critical sets", value, place, say("one comes or goes")))
    for C, D in pairs:
        if C.kind == D.kind:
            continue
        kind = change_between(C.kind, D.kind)
        place, y = _solved_place(family, change, points, kind, (float(D.p[0]), float(D.p[1])))
        if kind is HOPF:
            out.append(_hopf(family, value, place, np.array([*D.e, family.unit(value)]) if y is None else y))
        elif not (kind is DETERMINANT and family.affine):  # which is on a line of equilibria
            out.append(SpecialValue(kind.kind, value, place, kind.says))
    return out


def _solved_place(
    family: SystemFamily,
    change: Change,
    points: Sequence[Candidate],
    what: str | SpecialKind,
    place: tuple[float, float],
) -> tuple[tuple[float, float], Array | None]:
    """Return the solved point of a kind nearest to a place, and its (c, s, u); if there is none, the place."""
    solved = [(portrait_place(family, one.y, _axes_angle(family, change)), one.y) for one in points if one.what == what]
    near = [pair for pair in solved if math.dist(pair[0], place) < _SAME_EVENT_DISTANCE]
    return min(near, key=lambda pair: math.dist(pair[0], place), default=(place, None))


def _hopf(family: SystemFamily, value: float, place: tuple[float, float], y: Array) -> SpecialValue:
    """Describe a Hopf point at (c, s, u) with its first Lyapunov coefficient."""
    number = math.nan if kinks(family.rows, ("c", "s")) else float(lyapunov(family, y[None])[0])
    if not math.isfinite(number):
        return SpecialValue(HOPF.kind, value, place, HOPF.says)
    born = "supercritical" if number < 0.0 else "subcritical" if number > 0.0 else "degenerate"
    return SpecialValue(HOPF.kind, value, place, say(f"Hopf, {born}", number=number), number)


def _match_states(
    before: Sequence[CriticalSet], after: Sequence[CriticalSet]
) -> tuple[list[tuple[CriticalSet, CriticalSet]], list[CriticalSet], list[CriticalSet]]:
    """Critical sets that go on from one state to the other, those that went, and those that came."""
    # the nearest first: at two values so close together what goes on has hardly moved
    near = sorted((math.dist(C.p, D.p), i, j) for i, C in enumerate(before) for j, D in enumerate(after))
    joined: list[tuple[int, int]] = []
    for gap, i, j in near:
        if gap < _SAME_EVENT_DISTANCE and not any(i == k or j == m for k, m in joined):
            joined.append((i, j))
    gone = [C for i, C in enumerate(before) if i not in {i for i, _ in joined}]
    come = [D for j, D in enumerate(after) if j not in {j for _, j in joined}]
    return [(before[i], after[j]) for i, j in joined], gone, come


def _merged_directions(more: Array, fewer: Array) -> list[tuple[int, float]]:
    """Return how many limit directions meet and where, by comparing the two sides."""
    away = np.abs(np.remainder(more[:, None] - fewer + math.pi, 2.0 * math.pi) - math.pi)
    own = away.argmin(axis=1) if len(fewer) else np.zeros(len(more), int)
    close = away.min(axis=1, initial=math.inf) < _SAME_EVENT_DISTANCE
    met = [(3, float(fewer[j])) for j in range(len(fewer)) if (close & (own == j)).sum() == 3]
    alone = more[~close]
    if len(alone):
        gaps = np.remainder(np.roll(alone, -1) - alone, 2.0 * math.pi)
        first = int(gaps.argmin())  # of a pair: from there on every second gap is one
        pairs = range(first, first + len(alone) - 1, 2)
        met += [(2, float((alone[i % len(alone)] + 0.5 * gaps[i % len(alone)]) % (2.0 * math.pi))) for i in pairs]
    return sorted(met, key=lambda m: m[1])


def _turned_set(
    near: tuple[CriticalSet, CriticalSet], pairs: Sequence[tuple[CriticalSet, CriticalSet]]
) -> tuple[CriticalSet, CriticalSet] | None:
    """Return the critical set that turned between two of the other kind, which came from it or went into it."""
    saddles = [C.kind == "saddle" for C in near]
    if saddles[0] != saddles[1]:
        return None
    middle, reach = _midpoint(near), _SAME_EVENT_DISTANCE + 0.5 * math.dist(near[0].p, near[1].p)
    turned = [pair for pair in pairs if sum(C.kind == "saddle" for C in pair) == 1]
    return next((pair for pair in turned if math.dist(pair[1].p, middle) < reach), None)


def _midpoint(pair: tuple[CriticalSet, CriticalSet]) -> tuple[float, float]:
    p = 0.5 * (pair[0].p + pair[1].p)
    return float(p[0]), float(p[1])
