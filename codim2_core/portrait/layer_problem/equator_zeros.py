"""The equator of a general system: zeros of Theta, the degree of U on it, and the closed orbit where there is no zero.

Theta = (-sin, cos).U is resolved by a trigonometric polynomial to machine precision, all of whose zeros are found with
proof (`numerics.fourier_zeros`), and polished on Theta itself with its exact derivative.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...formulas.arrays import Program, polynomial_degree, program
from ...formulas.names import number_names
from ...formulas.switches import kinks
from ...numerics.fourier_zeros import UNIT, Series, series, turn, zeros
from ...numerics.sign_changes import refine_roots, roots
from ...results.arrays import Array
from ...results.words import say

MOST_ANGLES = 1024  # a Theta that needs more is not smooth: its zeros are then looked for between its kinks,
NET_ANGLES = 4096  # on a net of that many angles
KINK_DISTANCE = 1e-7  # so far from a kink the formula is taken to be smooth
MOST_OF_A_TURN = 65_536  # for the integrals over a closed equator close to a saddle-node
NEUTRAL_ROUNDING = 2.0**-49
ZERO_COMPONENT = 1e-13  # of |U|: a component that is smaller all along a piece vanishes there
POLE_DISTANCE, MAX_AT_ZERO = 1e-7, 1e-6  # to both sides of a change of sign; of |U|: what a component may be at a zero
NO_ARCS = np.zeros((0, 2))
MIN_SLOPE = 1e-9  # of |U|: a smaller slope at a sign change of a Theta that is not smooth counts as none


@dataclass(frozen=True, eq=False, slots=True)
class EquatorZeros:
    """Zeros of Theta and the eigenvalues there; as `EquatorEquilibria`, and how they were found."""

    theta: NDArray[np.float64]
    lambda_rho: NDArray[np.float64]
    lambda_theta: NDArray[np.float64]
    multiplicity: NDArray[np.int64]
    radially_degenerate: NDArray[np.bool_]
    all_directions: bool
    distance: float
    symmetric: bool
    certificate: str
    proven: bool
    # degree of theta -> U/|U|, which the indices of the critical sets add up to; None if U vanishes on the equator
    degree: int | None
    arcs: NDArray[np.float64]
    beyond: tuple[int, ...]  # as there


def directions(theta: Array) -> Array:
    """``(cos, sin)`` of each angle; (k, 2)."""
    return np.stack([np.cos(theta), np.sin(theta)], axis=-1)


def _components(run: Program, theta: Array) -> tuple[Array, Array, Array, Array, Array]:
    """Theta, its derivative, lambda_rho, its derivative, and (U1, U2), at each angle, by the chain rule."""
    e = directions(theta)
    c, s = e[:, 0], e[:, 1]
    rows = run.evaluate(e)
    u, v = rows[:, 0, 0], rows[:, 1, 0]
    with np.errstate(invalid="ignore"):  # at a pole
        du = c * rows[:, 0, 2] - s * rows[:, 0, 1]
        dv = c * rows[:, 1, 2] - s * rows[:, 1, 1]
    Theta, radial = c * v - s * u, c * u + s * v
    return Theta, c * dv - s * du - radial, radial, c * du + s * dv + Theta, rows[:, :, 0]


def _by_name(parts: tuple[Array, Array, Array, Array, Array], kind: str) -> Array:
    Theta, _, radial, _, U = parts
    return {"theta": Theta, "rho": radial, "U1": U[:, 0], "U2": U[:, 1]}[kind]


@lru_cache(maxsize=512)
def component_series(key: Hashable, kind: str) -> Series:
    """Resolve a component of U on the equator."""
    run, degree = program(key), polynomial_degree(key[0])  # type: ignore[index]
    n = 64 if degree is None else max(16, 1 << (2 * degree + 3).bit_length())
    if n > MOST_ANGLES:
        n, degree = 64, None
    while True:
        parts = _components(run, np.arange(float(n)) * (2.0 * math.pi / n))
        U = parts[-1]
        size = float(np.abs(U).sum(axis=1).max())
        found = series(_by_name(parts, kind), size, None if degree is None else degree + 1)
        if degree is not None:
            return found
        # a peak that Theta hides from the net, next to a zero of sin or cos, still shows in U
        if found.resolved and all(series(U[:, i], size).resolved for i in (0, 1)):
            between = (np.arange(float(n)) + 0.5) * (2.0 * math.pi / n)
            there = _by_name(_components(run, between), kind)
            if np.abs(found.derivatives(between, range(1))[0] - there).max() <= 1e-13 * size:
                return found
        if n >= MOST_ANGLES:
            return replace(found, resolved=False)
        n *= 2


@lru_cache(maxsize=128)
def equator_zeros(key: Hashable) -> EquatorZeros:
    """Zeros of Theta with eigenvalues; `key` is `Frozen.key`."""
    run, f = program(key), component_series(key, "theta")
    arcs: Array = NO_ARCS
    if f.vanishes:
        return _result(key, np.zeros((4, 0)), f, math.inf, all_directions=True)
    if not f.resolved:
        theta, multiplicity, arcs = _zeros_by_piece(key, "theta", f.size)
        proven, distance = False, math.inf
    else:
        found = zeros(f)
        theta, multiplicity, proven, distance = found.theta, found.multiplicity, found.proven, found.distance
    simple = multiplicity == 1
    for _ in range(2):
        Theta, rate, _, _, _ = _components(run, theta)
        step = np.where(simple & (rate != 0.0), Theta / np.where(rate == 0.0, 1.0, rate), 0.0)
        theta = np.where(np.abs(step) < 1e-6, theta - step, theta)
    theta = np.array([turn(t) for t in theta.tolist()])
    order = np.argsort(theta)
    theta, multiplicity = theta[order], multiplicity[order]
    Theta, rate, radial, radial_rate, _ = _components(run, theta)
    if not f.resolved:  # Theta = t |t| and its like change sign with no slope
        multiplicity = np.where((multiplicity == 1) & (np.abs(rate) <= MIN_SLOPE * f.size), 3, multiplicity)
    slope = np.where(multiplicity == 1, rate, 0.0)
    # a zero is known to within the rounding of Theta over its slope, which moves lambda_rho by so much
    blur = np.where(slope != 0.0, np.abs(radial_rate) / np.where(slope == 0.0, 1.0, np.abs(slope)), 4.0)
    flat = np.abs(radial) <= 16.0 * UNIT * f.size * (1.0 + np.minimum(blur, 1e6))
    rows = np.stack([theta, np.where(flat, 0.0, radial), slope, multiplicity.astype(float)])
    return _result(key, rows, f, distance, proven, arcs=arcs, beyond=_signs_after_zeros(run, theta, multiplicity, arcs))


def _signs_after_zeros(run: Program, theta: Array, multiplicity: NDArray[np.int64], arcs: Array) -> tuple[int, ...]:
    """Sign of Theta after each of its zeros, where some are odd and none is simple, so that no slope gives it."""
    if not (multiplicity % 2 == 1).any() or (multiplicity == 1).any():
        return ()
    stops = np.concatenate([theta, np.asarray(arcs, np.float64).reshape(-1, 2)[:, 0]])
    gaps = np.remainder(stops - theta[:, None], 2.0 * math.pi)
    gaps = np.where(gaps == 0.0, 2.0 * math.pi, gaps).min(axis=1)
    Theta = _components(run, theta + 0.5 * gaps)[0]
    return tuple(int(sign) for sign in np.sign(Theta))


def _result(
    key: Hashable,
    rows: Array,
    f: Series,
    distance: float,
    proven: bool = True,
    all_directions: bool = False,
    arcs: Array = NO_ARCS,
    beyond: tuple[int, ...] = (),
) -> EquatorZeros:
    theta, radial, slope = np.asarray(rows[:3], np.float64)
    multiplicity = rows[3].astype(np.int64)
    flat = radial == 0.0
    arrays = (theta, radial, slope, multiplicity, flat)
    for array in arrays:
        array.flags.writeable = False
    triples = theta[multiplicity == 3]
    symmetric = bool(len(triples)) and all(_odd_about(f, float(t)) for t in triples)
    return EquatorZeros(
        *arrays,
        all_directions,
        distance,
        symmetric,
        _certificate(f, proven),
        proven,
        _degree(key, rows, f, all_directions),
        np.remainder(np.asarray(arcs, np.float64), 2.0 * math.pi),
        beyond,
    )


def _certificate(f: Series, proven: bool) -> str:
    if not f.resolved:
        return say("on a net", net=NET_ANGLES)
    start = say("exact series" if f.exact else "series", degree=f.degree)
    return f"{start} {say('bounds' if proven else 'close to a multiple zero')}"


def _degree(key: Hashable, rows: Array, f: Series, all_directions: bool) -> int | None:
    """Degree of U on the equator: 1 and the turns of (lambda_rho, Theta), counted where Theta = 0 < lambda_rho."""
    _, radial, slope, multiplicity = rows
    if (radial == 0.0).any():
        return None
    if not f.resolved:  # Theta may vanish on arcs, and its series says no sign next to a zero
        return _equator_winding(key)
    if all_directions:
        radial_series = component_series(key, "rho")
        return None if radial_series.vanishes or _changes_sign(radial_series) else 1
    signs = np.sign(slope)
    if (multiplicity > 1).any():
        # across an odd zero the sign changes: from what lies between it and the next
        signs = _crossing_signs(f, rows[0], multiplicity)
    return 1 + int(signs[radial > 0.0].sum())


def _equator_winding(key: Hashable) -> int | None:
    """Count how often U turns along a net on the equator; None where it vanishes, or turns too fast to tell."""
    U = _components(program(key), (np.arange(float(NET_ANGLES)) + 0.5) * (2.0 * math.pi / NET_ANGLES))[-1]
    if not (np.isfinite(U).all() and U.any(axis=1).all()):
        return None
    angle = np.arctan2(U[:, 1], U[:, 0])
    step = np.remainder(np.diff(angle, append=angle[:1]) + math.pi, 2.0 * math.pi) - math.pi
    return None if np.abs(step).max() > 2.5 else round(float(step.sum()) / (2.0 * math.pi))


def _changes_sign(f: Series) -> bool:
    values = f.derivatives(np.arange(256.0) * (2 * math.pi / 256), range(1))[0]
    return bool(values.min() <= 0.0 <= values.max())


def _crossing_signs(f: Series, theta: Array, multiplicity: NDArray[np.int64]) -> Array:
    """+1, -1 where f rises or falls through a zero, 0 where it only touches."""
    gaps = np.remainder(np.roll(theta, -1) - theta, 2 * math.pi)
    gaps = np.where(gaps == 0.0, 2 * math.pi, gaps)
    after = np.sign(f.derivatives(theta + 0.5 * gaps, range(1))[0])
    return np.where(multiplicity % 2 == 1, after, 0.0)


def _odd_about(f: Series, theta: float) -> bool:
    """Whether f(theta + t) = -f(theta - t): a reflection symmetry, with which a triple zero splits evenly."""
    even = (f.c * np.exp(1j * theta * np.arange(len(f.c)))).real
    return bool(np.abs(even).sum() <= f.tolerance)


@lru_cache(maxsize=256)
def component_zeros(key: Hashable, kind: str) -> tuple[Array, NDArray[np.int64]]:
    """Angles at which a component of U vanishes on the equator, and multiplicities; where nullclines end."""
    if kind == "theta":
        found = equator_zeros(key)
        return found.theta, found.multiplicity
    f = component_series(key, kind)
    if f.vanishes or f.resolved:
        result = zeros(f)
        return result.theta, result.multiplicity
    return _zeros_by_piece(key, kind, f.size)[:2]


@lru_cache(maxsize=128)
def _kinks(key: Hashable) -> NDArray[np.float64]:
    """Angles at which U may have a kink on the equator."""
    rows, numbers = key  # type: ignore[misc]
    values = dict(zip(number_names(rows), numbers, strict=True))
    sources = kinks(rows, ("c", "s"))
    if not sources:
        return np.zeros(0)
    net = 1e-3 + np.linspace(0.0, 2.0 * math.pi, NET_ANGLES // 4 + 1)
    found: list[NDArray[np.float64]] = []
    for source in sources:  # each by itself: of all together the others would be evaluated with it
        run = program(((source,), tuple(values[name] for name in number_names((source,)))))

        def value(theta: NDArray[np.float64], run: Program = run) -> NDArray[np.float64]:
            return np.asarray(run.evaluate(directions(theta))[:, 0, 0], np.float64)

        at = roots(value, [net], [value(net)])
        found += [*at.zeros, *at.touches]
    return np.unique(np.concatenate(found) % (2.0 * math.pi))


def _zeros_by_piece(key: Hashable, kind: str, size: float) -> tuple[Array, NDArray[np.int64], Array]:
    """Zeros of a component that is not smooth, multiplicities (2 where it only touches), and arcs (k, 2) of zeros."""
    run, edges = program(key), _kinks(key)

    def value(theta: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(_by_name(_components(run, theta), kind), np.float64)

    if not len(edges):
        edges = np.array([1e-3])
    low, high = edges + KINK_DISTANCE, np.append(edges[1:], edges[0] + 2.0 * math.pi) - KINK_DISTANCE
    grids = [
        np.linspace(a, b, 33 + int(NET_ANGLES * (b - a) / (2.0 * math.pi)))
        for a, b in zip(low, high, strict=True)
        if a < b
    ]
    samples = [value(grid) for grid in grids]
    still = [bool((np.abs(sample) <= ZERO_COMPONENT * size).all()) for sample in samples]
    arcs = np.array([(grid[0], grid[-1]) for grid, none in zip(grids, still, strict=True) if none]).reshape(-1, 2)
    grids, samples = ([one for one, none in zip(each, still, strict=True) if not none] for each in (grids, samples))
    between = roots(value, grids, samples)
    left, at, right = value(edges - KINK_DISTANCE), value(edges), value(edges + KINK_DISTANCE)
    through = (left > 0.0) != (right > 0.0)
    across = refine_roots(value, edges[through] - KINK_DISTANCE, edges[through] + KINK_DISTANCE)[0]
    touches = [*between.touches, edges[~through & (abs(at) <= 1e-13 * size)]]
    theta = np.concatenate([*between.zeros, across, *touches]) % (2.0 * math.pi)
    multiplicity = np.ones(len(theta), np.int64)
    multiplicity[len(theta) - sum(map(len, touches)) :] = 2
    order = np.argsort(theta)
    order = order[~_lies_on_arcs(theta[order], arcs) & ~_are_poles(value, theta[order], size)]
    return theta[order], multiplicity[order], arcs


def _are_poles(value: Callable[[Array], Array], theta: Array, size: float) -> NDArray[np.bool_]:
    """Return at which angles a component changes its sign through infinity: it is larger there than on both sides."""
    here, before, after = (np.abs(value(theta + h)) for h in (0.0, -POLE_DISTANCE, POLE_DISTANCE))
    return ~(here <= np.maximum(np.minimum(before, after), MAX_AT_ZERO * size))


def _lies_on_arcs(theta: Array, arcs: Array) -> NDArray[np.bool_]:
    """Tell which angles lie on some arcs, ends included."""
    after = np.remainder(theta[:, None] - arcs[:, 0] + 1e-6, 2.0 * math.pi)
    return np.asarray((after <= arcs[:, 1] - arcs[:, 0] + 2e-6).any(axis=1))


@lru_cache(maxsize=128)
def equator_as_orbit(key: Hashable) -> tuple[int, float, float, bool] | None:
    """Direction, period, exponent and neutrality of the equator as a closed orbit; None where Theta has a zero."""
    on = equator_zeros(key)
    if on.all_directions or len(on.theta) or len(on.arcs):
        return None
    run = program(key)
    n, sums, last = 64, np.zeros(3), (math.inf, math.inf)
    theta = np.arange(float(n)) * (2.0 * math.pi / n)
    while True:
        Theta, _, radial, _, U = _components(run, theta)
        rows = np.stack([np.ones(len(theta)), radial, np.abs(U * directions(theta)).sum(axis=1)])
        sums += (rows / np.abs(Theta)).sum(axis=1)
        period, exponent, terms = (sums * (2.0 * math.pi / n)).tolist()
        close = abs(period - last[0]) <= 1e-15 * period and abs(exponent - last[1]) <= 1e-15 * max(terms, abs(exponent))
        if close or n >= MOST_OF_A_TURN:
            break
        theta = (np.arange(float(n)) + 0.5) * (2.0 * math.pi / n)  # what is new where n is doubled
        n, last = 2 * n, (period, exponent)
    neutral = abs(exponent) <= NEUTRAL_ROUNDING * terms
    return (1 if Theta[0] > 0.0 else -1), period, 0.0 if neutral else exponent, neutral
