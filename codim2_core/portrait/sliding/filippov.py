"""The Filippov convention on a codimension-2 set: all candidates for the sliding vector field.

Filippov's sliding vectors are the convex combinations of the limit vectors ``(U, W)(e)``, |e| = 1, that are tangent
to Sigma: the means of W over those probability measures on the circle whose mean of U vanishes. They form a convex
set, in general more than one point (Figure 3); the regularisation selects W at a zero of
U in the disc, which need not even be among them. For an e-linear system both are ``-B A^-1 f + g``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...results.arrays import Array, read_only
from ...results.result import Result, column_rows
from ...results.tables import html_table, paragraphs, point
from ...results.words import say
from ...systems.frozen import FrozenSystem
from ...systems.kinds import AnySystem, takes_names
from ..layer_problem.critical import CriticalSet
from ..layer_problem.disc_zeros import disc_zeros
from ..layer_problem.linearisation import Existence, locate


@takes_names
def sliding_flow(system: AnySystem, z: ArrayLike = ()) -> NDArray[np.float64] | None:
    """Z' along the critical sets, (2.30): W at the zeros of U, whatever Psi is.

    For an e-linear system, which has at most one, it is ``-B A^-1 f + g`` (4.17): the Filippov convention,
    and the mean of z' over a limit cycle of the layer problem (Proposition 4.2).

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    z : (m,) floats

    Returns
    -------
    ndarray (m,), or (k, m) for a general system, or None
        A general system has a row for each critical set, in the order of `critical_sets`: where rows differ, sliding
        is not unique (Section 5.3). None where there is no critical set: nothing slides there.

    Examples
    --------
    It is -B A^-1 f + g:

    >>> from codim2_core import ELinear, sliding_flow
    >>> sliding_flow(ELinear(-2, 0, -1, (-0.5, 0), B=((4, 0),), g=(0.5,)), (0.0,)).tolist()
    [-0.5]
    """
    at = system.at(z)
    points = disc_zeros(at.key).e if at.affine is None else [e] if (e := locate(at).e) else []
    return at.of_critical_sets(read_only(np.stack([at.W(e) for e in points]))) if len(points) else None


def flow_on(at: FrozenSystem, critical: Sequence[CriticalSet]) -> NDArray[np.float64] | None:
    """Return what `sliding_flow` does of a frozen system whose critical sets are known."""
    return at.of_critical_sets(read_only(np.stack([C.slow_flow for C in critical]))) if critical else None


SEARCH_DIRECTIONS = 512  # directions among which maxima are looked for, then refined
FIRST_DIRECTIONS = 48  # directions of the first linear programme
MAX_ROUNDS = 60
SUPPORT_TOLERANCE = (
    5e-10  # of the largest |(U, W)|: how far the curve may stick out of a face, so the error of a vertex along n
)
SUPPORTS = 32  # faces from which a polygon of candidates is made (m = 2)
UNIQUE = 1e-9  # of the largest |W|: candidates this near are one
WEIGHTLESS = 1e-9  # weights below this are the linear programme's rounding
SAME_DIRECTION = 1e-3  # directions nearer than this stand for one
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


@dataclass(frozen=True, eq=False, slots=True)
class FilippovSliding(Result):
    """The Filippov candidates at one z.

    Attributes
    ----------
    vertices : ndarray (k, m)
        Extreme candidates: the two ends (m = 1), the corners of the polygon (m = 2), the extremes along each axis
        (m > 2). Empty: no convex combination of limit vectors is tangent to Sigma.
    directions : tuple of ndarray (j,)
        For each vertex the directions theta that are combined ...
    weights : tuple of ndarray (j,)
        ... and with which weights.
    unique : bool
        One candidate only, as in the e-linear system.
    sentence : str
    """

    vertices: Array
    directions: tuple[Array, ...]
    weights: tuple[Array, ...]
    unique: bool
    sentence: str

    def _tables_(self) -> str:
        combined = zip(self.vertices, self.directions, self.weights, strict=True)
        found = [tuple(map(point, one)) for one in combined]
        return paragraphs([self.sentence]) + html_table(("candidate z′", "combines U, W at θ", "with weights"), found)

    def _records(self) -> Iterator[dict[str, Any]]:
        return column_rows({f"flow_{k + 1}": column for k, column in enumerate(self.vertices.T)})

    def __len__(self) -> int:
        return len(self.vertices)


@takes_names
def filippov_sliding(system: AnySystem, z: ArrayLike = ()) -> FilippovSliding:
    """All candidates of the Filippov convention for z' on Sigma, Figure 3.

    The convention is that of Section 2.1.

    Parameters
    ----------
    system : ELinear, System, Coefficients or Frozen
    z : (m,) floats

    Returns
    -------
    FilippovSliding

    Notes
    -----
    For each direction n of R^m the extreme candidate solves a semi-infinite linear programme, whose dual is
    ``min over lambda in R^2 of max over theta of n.W + lambda.U``; it is solved by exchange: a linear programme over a
    few directions, to which the maxima of that function are added until none exceeds the face.

    Examples
    --------
    >>> from codim2_core import ELinear, filippov_sliding
    >>> found = filippov_sliding(ELinear(-2, 0, -1, (-0.5, 0), B=((1, 0),)), (0.0,))
    >>> found.unique, [v.round(9).tolist() for v in found.vertices]
    (True, [[-0.25]])
    """
    at = system.at(z)
    field = _Field(at)
    m = field.W.shape[1]
    none, theta = _separating_line(field)
    if none:
        return FilippovSliding(read_only(np.zeros((0, m))), (), (), False, _NONE)
    vertices: list[Array] = []
    combinations: list[tuple[Array, Array]] = []
    for count, n in enumerate(_normals(m)):
        if count == 2 * m > 0 and len(vertices) == 1:
            break  # all axes agree: one point
        found = _extreme(field, theta, n)
        if found is None:
            return FilippovSliding(read_only(np.zeros((0, m))), (), (), False, _TOUCHES)
        vertex, directions, weight = found
        if not any(np.abs(vertex - other).max() <= UNIQUE * field.size for other in vertices):
            vertices.append(vertex)
            combinations.append((directions, weight))
    unique = len(vertices) <= 1
    sentence = say("Filippov: unique") if unique else say("Filippov: not unique")
    if m == 2:  # corners in order around the polygon
        centre = np.mean(vertices, axis=0)
        order = sorted(range(len(vertices)), key=lambda i: math.atan2(*(vertices[i] - centre)[::-1]))
        vertices, combinations = [vertices[i] for i in order], [combinations[i] for i in order]
    return FilippovSliding(
        read_only(np.array(vertices)),
        tuple(read_only(directions) for directions, _ in combinations),
        tuple(read_only(weight) for _, weight in combinations),
        unique,
        sentence,
    )


_TOUCHES = say("Filippov: touches")
_NONE = say("Filippov: none")


def _normals(m: int) -> Iterator[Array]:
    """Directions of R^m in which extremes are looked for: along the axes, then (m = 2) all around."""
    if m == 0:
        yield np.zeros(0)
    for i in range(m):
        yield from (np.eye(m)[i], -np.eye(m)[i])
    if m == 2:
        angles = 2.0 * math.pi * (np.arange(SUPPORTS) + 0.5) / SUPPORTS
        yield from np.stack([np.cos(angles), np.sin(angles)], axis=-1)


class _Field:
    """(U, W) on the circle: at any direction, and on a dense grid."""

    def __init__(self, at: FrozenSystem) -> None:
        self._at = at
        self.theta = np.linspace(0.0, 2.0 * math.pi, SEARCH_DIRECTIONS, endpoint=False)
        self.U, self.W = self(self.theta)
        self.size = float(max(np.abs(self.U).max(), np.abs(self.W).max(initial=0.0))) or 1.0

        both = np.concatenate([self.U, self.W], axis=1) / self.size
        self._spectrum = np.fft.rfft(both, axis=0, norm="forward")
        self._spectrum[1:] *= 2.0
        self._waves = np.arange(len(self._spectrum))

    def series(self, theta: Array, order: int) -> tuple[Array, Array]:
        """Return the derivative of (U, W), over `size`, by theta, from the Fourier series on the grid."""
        waves = np.exp(1j * np.outer(theta, self._waves)) * (1j * self._waves) ** order
        values = (waves @ self._spectrum).real
        return values[:, :2], values[:, 2:]

    def __call__(self, theta: Array) -> tuple[Array, Array]:
        e = np.stack([np.cos(theta), np.sin(theta)], axis=-1)
        return self._at.U(e), self._at.W(e)


def _separating_line(field: _Field) -> tuple[bool, Array]:
    """Whether a line through 0 has all of U on one side, and directions whose U otherwise has 0 in its hull."""
    from scipy.optimize import linprog  # imported late: it takes longer than all of this package

    theta = field.theta[:: SEARCH_DIRECTIONS // FIRST_DIRECTIONS]
    for _ in range(MAX_ROUNDS):
        U, _ = field(theta)
        # the least s with nu.U <= s at these directions, |nu| <= 1
        result = linprog(
            [0.0, 0.0, 1.0],
            A_ub=np.column_stack([U / field.size, -np.ones(len(theta))]),
            b_ub=np.zeros(len(theta)),
            bounds=[(-1.0, 1.0), (-1.0, 1.0), (-3.0, 3.0)],
            method="highs",
        )
        nu, s = result.x[:2], result.x[2]
        if s >= -SUPPORT_TOLERANCE:
            return False, theta
        peaks = _maxima(lambda t, nu=nu: field(t)[0] @ nu / field.size, field.theta)
        heights = field(peaks)[0] @ nu / field.size
        if heights.max() < s + 0.5 * abs(s):
            return True, theta
        theta = np.concatenate([theta, peaks[heights > s]])
    return True, theta  # closer than rounding can tell: no combination was found


def _extreme(field: _Field, theta: Array, n: Array) -> tuple[Array, Array, Array] | None:
    """Return the candidate that is farthest along n, its directions and weights; None if rounding leaves none."""
    from scipy.optimize import linprog

    weights, slope = np.zeros(0), np.zeros(2)
    for _ in range(MAX_ROUNDS):
        U, W = field(theta)
        # primal: weights; its dual variables give a face n.W + slope.U <= level
        result = linprog(
            -(W @ n) / field.size,
            A_eq=np.column_stack([U / field.size, np.ones(len(theta))]).T,
            b_eq=[0.0, 0.0, 1.0],
            method="highs",
            options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
        )
        if not result.success:  # 0 is on the border of the hull of U
            return None
        slope, level = result.eqlin.marginals[:2], -result.eqlin.marginals[2]
        weights = result.x

        def height(t: Array, slope: Array = slope, level: float = level) -> Array:
            u, w = field(t)
            return (w @ n + u @ slope) / field.size - level

        peaks = _maxima(height, field.theta)
        peaks = peaks[height(peaks) > SUPPORT_TOLERANCE]
        fresh = np.abs(np.exp(1j * peaks)[:, None] - np.exp(1j * theta)).min(axis=1, initial=2.0) > 1e-7
        if not fresh.any():
            break
        theta = np.concatenate([theta, peaks[fresh]])
        weights = np.append(weights, np.zeros(int(fresh.sum())))
    # Newton's method may creep where the whole curve lies in the face: balancing afterwards leaves rounding only
    theta, weights = _balance(
        field, *(_polish_support(field, n, *_merge_directions(theta, weights), slope) or (theta, weights))
    )
    used = weights > WEIGHTLESS  # balancing and polishing may leave one that combines nothing
    return weights @ field(theta)[1], theta[used], weights[used]


def _balance(field: _Field, theta: Array, weights: Array) -> tuple[Array, Array]:
    """Remove what the linear programme's tolerance left of the mean of U, by the least change of the weights used."""
    used = weights > WEIGHTLESS
    theta, weights = theta[used] % (2.0 * math.pi), weights[used]
    rows = np.vstack([field(theta)[0].T / field.size, np.ones(len(theta))])
    weights = weights + np.linalg.lstsq(rows, np.array([0.0, 0.0, 1.0]) - rows @ weights, rcond=1e-12)[0]
    return theta, np.maximum(weights, 0.0)


def _merge_directions(theta: Array, weights: Array) -> tuple[Array, Array]:
    """Return the combined directions; neighbours that stand for one maximum between them become one."""
    used = weights > WEIGHTLESS
    theta, weights = theta[used] % (2.0 * math.pi), weights[used]
    order = np.argsort(theta)
    theta, weights = theta[order], weights[order]
    new = np.append(True, np.diff(theta) > SAME_DIRECTION)
    group = np.cumsum(new) - 1
    if theta[0] + 2.0 * math.pi - theta[-1] <= SAME_DIRECTION:
        theta, group = (
            np.where(group == group[-1], theta - 2.0 * math.pi, theta),
            np.where(group == group[-1], 0, group),
        )
    total = np.bincount(group, weights)
    return np.bincount(group, weights * theta) / total, total / total.sum()


def _polish_support(field: _Field, n: Array, theta: Array, weights: Array, slope: Array) -> tuple[Array, Array] | None:
    """Newton's method on the conditions of optimality, past the tolerance of the linear programme (1e-10).

    Unknown are the directions, their weights and the face ``n.W + slope.U = level``; the height of the curve over the
    face and its derivative vanish at each direction, the mean of U vanishes, and the weights sum to 1. None if it
    does not converge (an e-linear curve is plane: all of it lies in the face).
    """
    k = len(theta)
    slope = np.append(slope, 0.0)  # linear in the level: the first step finds it
    residual = np.ones(1)
    for _ in range(6):
        (U, W), (dU, dW), (ddU, ddW) = (field.series(theta, order) for order in range(3))
        height, tilt = W @ n + U @ slope[:2] - slope[2], dW @ n + dU @ slope[:2]
        bend = ddW @ n + ddU @ slope[:2]
        residual = np.concatenate([height, tilt, U.T @ weights, [weights.sum() - 1.0]])
        matrix = np.zeros((2 * k + 3, 2 * k + 3))
        matrix[:k, :k], matrix[k : 2 * k, :k] = np.diag(tilt), np.diag(bend)
        matrix[:k, 2 * k : 2 * k + 2], matrix[:k, 2 * k + 2] = U, -1.0
        matrix[k : 2 * k, 2 * k : 2 * k + 2] = dU
        matrix[2 * k : 2 * k + 2, :k] = (dU * weights[:, None]).T
        matrix[2 * k : 2 * k + 2, k : 2 * k] = U.T
        matrix[2 * k + 2, k : 2 * k] = 1.0
        step = np.linalg.lstsq(matrix, -residual, rcond=1e-12)[0]
        moved, weighed = theta + step[:k], weights + step[k : 2 * k]
        if np.abs(step[:k]).max() > SAME_DIRECTION:
            return None
        theta, weights, slope = moved, np.maximum(weighed, 0.0), slope + step[2 * k :]
    return (theta % (2.0 * math.pi), weights) if np.abs(residual).max() < 1e-12 else None


def _maxima(height: Callable[[Array], Array], theta: Array) -> Array:
    """Directions of the local maxima, by golden section from an even grid of directions."""
    values = height(theta)
    peaks = np.flatnonzero((values >= np.roll(values, 1)) & (values > np.roll(values, -1)))
    step = theta[1] - theta[0]
    low, high = theta[peaks] - step, theta[peaks] + step
    for _ in range(40):  # to a relative 1e-8, where maxima are flat
        a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        left, right = height(np.concatenate([a, b])).reshape(2, -1)
        low, high = np.where(left < right, a, low), np.where(left < right, high, b)
    return 0.5 * (low + high)


@dataclass(frozen=True, eq=False)
class AffinePlane:
    """The plane of affine combinations of limit vectors, (4.4), and its point on Sigma, (4.5)."""

    # (2 + m, 2) A over B: the combination with (l1, l2) is ``matrix @ (l1, l2) + offset``; it is convex for |(l1,
    # l2)| <= 1
    matrix: Array
    offset: Array  # (2 + m,) f over g
    # (2,) The (l1, l2) of the point on Sigma, -A^-1 f; None where det A = 0, and so no or many points
    place: Array | None
    point: Array | None  # (m,) What the plane has on Sigma: -B A^-1 f + g
    convex: bool  # whether it is a convex combination, |A^-1 f| <= 1: then there is sliding, else crossing
    sentence: str


_SENTENCES = {
    Existence.INSIDE: say("affine: convex"),
    Existence.NONE: say("affine: not convex"),
    Existence.EQUATOR: say("affine: limit vector"),
}
_SINGULAR = say("affine: none single")


def affine_plane(system: AnySystem, z: ArrayLike = ()) -> AffinePlane | None:
    """Return the plane F_C of the e-linear system at z (m,) and where it meets Sigma; None if it is not affine."""
    at = system.at(z).as_given
    if at is None or at.m != system.m:
        return None
    matrix, offset = read_only(np.concatenate([at.A, at.B])), read_only(np.concatenate([at.f, at.g]))
    location = locate(at)
    if location.singular:
        return AffinePlane(matrix, offset, None, None, False, _SINGULAR)
    size = at.size
    place = np.linalg.solve(at.A / size, -at.f / size).astype(float)
    sentence = _SENTENCES[location.existence]
    point = at.B @ place + at.g
    return AffinePlane(
        matrix, offset, read_only(place), read_only(point), location.existence is not Existence.NONE, sentence
    )
