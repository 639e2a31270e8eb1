"""All sign changes of smooth functions of one variable, by sampling finer and finer, all of them at once."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..results.arrays import Array


def root_between(function: Callable[[float], float], low: float, high: float, tolerance: float = 1e-300) -> float:
    """Find a root in an interval by Chandrupatla's method; its better end if there is no change of sign to be seen.

    It does what Brent's method does, and importing SciPy's optimisers would cost more than all curves together.
    """
    x1, x2 = high, low
    f1, f2 = function(x1), function(x2)
    if f1 == 0.0 or f2 == 0.0 or (f1 > 0.0) == (f2 > 0.0):
        return x2 if abs(f2) <= abs(f1) else x1
    t, best = 0.5, x1
    for _ in range(200):
        x = x1 + t * (x2 - x1)
        f = function(x)
        if (f > 0.0) == (f1 > 0.0):
            x3, f3 = x1, f1
        else:
            x3, f3, x2, f2 = x2, f2, x1, f1
        x1, f1 = x, f
        best, least = (x1, f1) if abs(f1) < abs(f2) else (x2, f2)
        part = (5e-16 * abs(best) + 0.5 * tolerance) / abs(x2 - x1) if x2 != x1 else 1.0
        if least == 0.0 or part >= 0.5:
            return best
        xi, phi = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2)
        t = 0.5
        if phi * phi < xi and (1.0 - phi) ** 2 < 1.0 - xi:  # inverse quadratic interpolation is safe
            t = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
        t = min(max(t, part), 1.0 - part)
    return best


def root_through(x: Sequence[float] | Array, y: Sequence[float] | Array) -> float:
    """Lagrange's polynomial for the place x as a function of the value y, all different, at zero."""
    return sum(
        float(x[j]) * math.prod(float(-y[k] / (y[j] - y[k])) for k in range(len(y)) if k != j) for j in range(len(y))
    )


Function = Callable[[Array], Array]

_UNIT = np.linspace(0.0, 1.0, 17)
_OFFSETS = 10.0 ** -np.arange(1.0, 17.0, 1.5)
_BRACKET_OFFSETS = np.concatenate([-_OFFSETS, _OFFSETS[::-1]])
_ROUNDS = 40
_NOTHING = 1e-13  # of the largest size of a function: below it, its sign is rounding


def sign_changes(values: Array) -> NDArray[np.intp]:
    """Find the i with a change of sign between values[i] and values[i + 1]; a zero counts as positive."""
    positive = values >= 0.0
    return np.flatnonzero(positive[1:] != positive[:-1])


def refine_roots(function: Function, low: Array, high: Array) -> tuple[Array, NDArray[np.bool_]]:
    """One sign change in each interval, to the last digits."""
    place, pole = 0.5 * (low + high), np.zeros(len(low), bool)
    first = np.zeros(len(low))
    todo = np.arange(len(low))
    low, high = low.copy(), high.copy()
    guess = place.copy()
    for i in range(_ROUNDS):
        if not len(todo):
            break
        width = (high - low)[:, None]
        near = guess[:, None] + width * _BRACKET_OFFSETS
        x = np.sort(np.concatenate([low[:, None] + width * _UNIT, np.clip(near, low[:, None], high[:, None])], axis=1))
        x[:, -1] = high
        y = function(x.ravel()).reshape(x.shape)
        positive = y >= 0.0
        rows = np.arange(len(todo))
        at = (positive[:, 1:] != positive[:, :-1]).argmax(axis=1)  # the first, if there are several
        low, high, y0, y1 = x[rows, at], x[rows, at + 1], y[rows, at], y[rows, at + 1]
        if i == 0:
            first = np.maximum(abs(y[:, 0]), abs(y[:, -1]))
        total = abs(y0) + abs(y1)
        part = np.where(total > 0.0, abs(y0) / np.where(total > 0.0, total, 1.0), 0.5)
        guess = low + part * (high - low)
        done = high - low <= 4e-16 * np.maximum(np.maximum(abs(low), abs(high)), 1e-300)
        place[todo] = guess
        pole[todo] = np.minimum(abs(y0), abs(y1)) > first[todo]
        keep = ~done & (total > 0.0)
        todo, low, high, guess = todo[keep], low[keep], high[keep], guess[keep]
    return place, pole


class Roots(NamedTuple):
    """The roots found on each grid, increasing."""

    zeros: list[Array]
    poles: list[Array]
    touches: list[Array]


def roots(function: Function, grids: Sequence[Array], values: Sequence[Array]) -> Roots:
    """Every sign change of a function on some intervals, each known on a grid.

    Pairs of zeros between neighbouring grid points are found too: where the size of the function has a local minimum
    on the grid, finer and finer grids are laid around it. A pair is missed if the function stays below 1e-13 of its
    largest size between the two, or if it varies over less than a grid step, so that the size has no minimum there.

    Changes of sign with a zero, and with a pole; and where the function touches zero without a change of sign.
    Shapes: grids, values (k,).
    """
    low: list[float] = []
    high: list[float] = []
    owner: list[int] = []
    tips: list[tuple[int, int]] = []
    for k, (grid, y) in enumerate(zip(grids, values, strict=True)):
        changes = sign_changes(y)
        low += grid[changes].tolist()
        high += grid[changes + 1].tolist()
        owner += [k] * len(changes)
        tips += [(k, i) for i in lowest(grid, y)]
    hidden, touching = _hidden_pairs(function, grids, values, tips)
    for k, u, v in hidden:
        low.append(u)
        high.append(v)
        owner.append(k)
    place, pole = refine_roots(function, np.array(low), np.array(high)) if low else (np.zeros(0), np.zeros(0, bool))
    of = np.array(owner, int)
    each = range(len(grids))
    return Roots(
        [np.unique(place[(of == k) & ~pole]) for k in each],
        [np.unique(place[(of == k) & pole]) for k in each],
        [np.array(sorted(v for j, v in touching if j == k)) for k in each],
    )


def lowest(grid: Array, y: Array) -> list[int]:
    """Grid points at which the size has a minimum that could hide two zeros: the parabola there comes near zero."""
    if len(grid) < 3:
        return []
    size, positive = abs(y), y >= 0.0
    low = (size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:]) & (size[:-2] > 0.0) & (size[2:] > 0.0)
    low &= (positive[1:-1] == positive[:-2]) & (positive[1:-1] == positive[2:])
    within = (1 + np.flatnonzero(low)).tolist()
    return [i for i in within if _near_zero(grid[i - 1 : i + 2] - grid[i], size[i - 1 : i + 2])]


def _near_zero(offsets: Array, sizes: Array) -> bool:
    """Whether the parabola through three points, the middle one at offset 0, comes near zero."""
    (u, _, w), (p, q, r) = offsets.tolist(), sizes.tolist()
    if u == 0.0 or w == 0.0:  # no double lies between: there is nothing left to hide
        return False
    left, right = (p - q) / u, (r - q) / w
    bend, slope = (right - left) / (w - u), (left * w - right * u) / (w - u)
    lowest = q - slope * slope / (4.0 * bend) if bend > 0.0 else q
    # the parabola is trusted to within a part of its rise over the interval
    return lowest <= 0.3 * (max(p, r) - q)


def _hidden_pairs(
    function: Function, grids: Sequence[Array], values: Sequence[Array], tips: list[tuple[int, int]]
) -> tuple[list[tuple[int, float, float]], list[tuple[int, float]]]:
    """Brackets (grid, low, high) of the zeros that minima of the size hide, two for each pair; and (grid, touch)."""
    if not tips:
        return [], []
    owner = [k for k, _ in tips]
    low = np.array([grids[k][i - 1] for k, i in tips])
    high = np.array([grids[k][i + 1] for k, i in tips])
    best = np.array([abs(values[k][i]) for k, i in tips])
    floor = np.array([_NOTHING * abs(values[k]).max() for k, _ in tips])
    found: list[tuple[int, float, float]] = []
    touching: list[tuple[int, float]] = []
    for _ in range(12):
        x = low[:, None] + (high - low)[:, None] * _UNIT
        y = function(x.ravel()).reshape(x.shape)
        positive = y >= 0.0
        at = abs(y).argmin(axis=1)
        go_on = []
        for j in range(len(low)):
            change = np.flatnonzero(positive[j, 1:] != positive[j, :-1])
            if len(change):
                deep = abs(y[j, change[0] + 1 : change[-1] + 1]).max()
                if deep > floor[j]:  # else it touches zero, and rounding makes two zeros of one
                    found += [(owner[j], float(x[j, i]), float(x[j, i + 1])) for i in change]
                    continue
            if abs(y[j, at[j]]) <= floor[j]:
                touching.append((owner[j], _lowest(function, float(x[j, at[j]]), grids[owner[j]])))
            elif 0 < at[j] < len(_UNIT) - 1 and (
                # a minimum falls by more than half only if it comes near zero; or it lay next to a grid point before
                abs(y[j, at[j]]) < 0.5 * best[j]
                or _near_zero(x[j, at[j] - 1 : at[j] + 2] - x[j, at[j]], abs(y[j, at[j] - 1 : at[j] + 2]))
            ):
                go_on.append(j)
        if not go_on:
            break
        owner = [owner[j] for j in go_on]
        best = abs(y[go_on, at[go_on]])
        low, high, floor = x[go_on, at[go_on] - 1], x[go_on, at[go_on] + 1], floor[go_on]
    return found, touching


def _lowest(function: Function, near: float, grid: Array) -> float:
    """Return the minimum of the size at a touch, where the function itself is lost in rounding: of a fit around it."""
    step = min(1e-3 * float(grid[-1] - grid[0]), near - float(grid[0]), float(grid[-1]) - near)
    if step <= 0.0:
        return near
    fit = np.polynomial.Polynomial.fit(_UNIT * 2.0 - 1.0, function(near + step * (_UNIT * 2.0 - 1.0)), 6, [-1.0, 1.0])
    first, second = fit.deriv(1), fit.deriv(2)
    u = 0.0
    for _ in range(4):
        bend = float(second(u))
        u -= min(max(float(first(u)) / bend, -0.5), 0.5) if bend else 0.0
    return near + step * u
