"""Hopf and node-focus curves of the critical set: where the trace of J (3.23) reaches a level.

Let ``e = m (cos t, sin t)`` be the critical set, ``f = -A e``, and sigma(m) the ratio of the radial to the tangential
eigenvalue of D e_Psi (Remark 3.2). Then, with p = a + d, k = a - d,

    tr J / tangential = (p (1 + sigma) - k (1 - sigma) cos 2t)/2,      det J / tangential^2 = sigma det A.

tr J = 2 tau sqrt(det J), with tau = 0 for Hopf and tau = +-1 for node-focus, is linear in cos 2t: for each modulus m
there are at most four angles, t, -t, pi - t and pi + t.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..layer_problem.linearisation import determinant_sign
from ..layer_problem.lyapunov import first_lyapunov
from ..numerics.root_between import root_between
from ..numerics.sign_changes import roots
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from ..systems.elinear import ELinear
from ..words import say
from .curve import Array, BifurcationCurve, SpecialPoint, matrix, plain_point, read_only_lines

_MODULUS_CELLS = 256  # moduli between which zeros are looked for
_MIN_POINTS = 160  # points along one piece, at least
_MAX_MODULUS = 1.0 - 2.0**-40  # the largest modulus followed; from there to the equator nothing can be seen
_ROUNDING = 4 * 2.0**-53
_MAX_STEP, MAX_HALVINGS = (
    0.04,
    60,
)  # the curve moves by at most this between points, unless its moduli agree to all digits


def _ratio(psi: Psi, m: Array) -> Array:
    """sigma(m) = radial/tangential eigenvalue of D e_Psi where e_Psi has modulus m."""
    radial, tangential = psi.jacobian_factors(psi.radius(m))
    return radial / tangential


@dataclass(frozen=True)
class _ModulusInterval:
    """An interval of moduli on which 0 <= t(m) <= pi/2 exists; at its ends cos 2t = 1, -1, or neither (0)."""

    low: float
    high: float
    at_low: int
    at_high: int


class _TraceLevel:
    """tr J = 2 tau sqrt(det J) as a curve t(m)."""

    def __init__(self, a: float, b: float, d: float, psi: Psi, tau: float) -> None:
        self.psi, self.tau = psi, tau
        self.p, self.k = a + d, a - d
        self.root = math.sqrt(a * d + b * b)
        self.A = np.array([[a, -b], [b, d]])
        self.scale = abs(self.p) + abs(self.k) + self.root

    @property
    def has_circle(self) -> bool:
        """Whether tr J has the level on the whole circle where sigma = 1: p = 2 tau sqrt(det A)."""
        return abs(self.p - 2.0 * self.tau * self.root) <= _ROUNDING * self.scale

    def sides(self, m: Array) -> tuple[Array, Array]:
        """(N, D) with ``cos 2t = N/D``; where they have a zero in common, sigma = 1, without it."""
        sigma = _ratio(self.psi, m)
        if self.has_circle and self.tau:
            root = np.sqrt(sigma)  # N = p (1 - root)^2, D = k (1 - root) (1 + root)
            return self.p * (1.0 - root), self.k * (1.0 + root)
        return self.p * (1.0 + sigma) - 4.0 * self.tau * self.root * np.sqrt(sigma), self.k * (1.0 - sigma)

    def angle(self, m: Array) -> Array:
        """t(m) in [0, pi/2]."""
        N, D = self.sides(m)
        return 0.5 * np.arctan2(np.sqrt(np.maximum((D - N) * (D + N), 0.0)), N * np.sign(D))

    def pieces(self, m: Array) -> list[_ModulusInterval]:
        """Intervals of moduli on which the curve exists, between the zeros of N - D and N + D.

        Where sigma passes 1, D changes its sign: there the curve stops at one angle and goes on from the other, however
        narrow the gap. Each of the two functions has but one zero there, so that no grid is too coarse for them.
        """
        N, D = self.sides(m)
        zeros: list[tuple[float, int]] = []
        for sign in (1, -1):
            found = roots(lambda v, sign=sign: _difference(self.sides(v), sign), [m], [N - sign * D]).zeros[0]
            zeros += [(v, sign) for v in found.tolist()]
        stops = [(float(m[0]), 0), *sorted(zeros), (float(m[-1]), 0)]
        pieces: list[_ModulusInterval] = []
        for (low, at_low), (high, at_high) in pairwise(stops):
            if high - low <= 4.0 * _ROUNDING:
                continue
            N, D = self.sides(np.array([0.5 * (low + high)]))
            if abs(N[0]) <= abs(D[0]):
                pieces.append(_ModulusInterval(low, high, at_low, at_high))
        return pieces

    def sampled(self, piece: _ModulusInterval) -> tuple[Array, Array]:
        """Moduli and angles along a piece, so close together that the curve moves little between them.

        Where |a + d| is much smaller than |a - d|, the angle turns within a very small part of the moduli.
        """
        u = 0.5 * (1.0 - np.cos(np.linspace(0.0, math.pi, _MIN_POINTS)))
        m = piece.low + (piece.high - piece.low) * u
        for _ in range(MAX_HALVINGS):
            t = self._angles(m, piece)
            far = np.flatnonzero(np.maximum(m[1:], m[:-1]) * np.abs(np.diff(t)) + np.diff(m) > _MAX_STEP)
            middle = 0.5 * (m[far] + m[far + 1])
            middle = middle[(middle > m[far]) & (middle < m[far + 1])]
            if not len(middle):
                break
            m = np.sort(np.concatenate([m, middle]))
        return m, self._angles(m, piece)

    def _angles(self, m: Array, piece: _ModulusInterval) -> Array:
        t = self.angle(m)
        for end, sign in ((0, piece.at_low), (-1, piece.at_high)):
            if sign:
                t[end] = 0.0 if sign > 0 else 0.5 * math.pi
        return t


def _difference(sides: tuple[Array, Array], sign: int) -> Array:
    return sides[0] - sign * sides[1]


def _chains(piece: _ModulusInterval, t: Array) -> list[tuple[NDArray[np.intp], Array]]:
    """Join the four mirror images of one piece where they meet: (index along the piece, angle) of each branch."""
    images = [t, -t, math.pi - t, math.pi + t]
    partner = {1: (1, 0, 3, 2), -1: (2, 3, 0, 1)}  # at t = 0: t with -t; at t = pi/2: t with pi - t
    forward = np.arange(len(t))
    ends = (piece.at_low, piece.at_high)
    out: list[tuple[NDArray[np.intp], Array]] = []
    left = {0, 1, 2, 3}
    while left:
        # an open chain is begun at a loose end; without one the chain closes
        image = min(left)
        side = 0 if ends[0] == 0 else 1 if ends[1] == 0 else 0
        index: list[NDArray[np.intp]] = []
        angle: list[Array] = []
        while image in left:
            left.discard(image)
            order = forward if side == 0 else forward[::-1]
            index.append(order if not index else order[1:])
            angle.append(images[image][order] if not angle else images[image][order][1:])
            side = 1 - side  # now at the other end
            if ends[side] == 0:
                break
            image = partner[ends[side]][image]
        out.append((np.concatenate(index), np.concatenate(angle)))
    return out


def _is_straight(e: Array) -> bool:
    """Whether a branch is one of the two diameters that belong to a + d = 0."""
    return bool((e[0] == -e[-1]).all() and (e[len(e) // 2] == 0.0).all())


def _trace_branches(level: _TraceLevel) -> list[Array]:
    """All branches as critical sets e, (m, 2) each."""
    # u -> sin^2 u crowds both ends: the curve starts at the centre or ends on the equator with any slope
    m = np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, _MODULUS_CELLS + 1)[1:-1])
    m = np.unique(
        np.concatenate([[1e-6, 1e-4, 1e-3], m, 1.0 - np.geomspace(1e-4, 1.0 - _MAX_MODULUS, 12), [_MAX_MODULUS]])
    )
    if abs(level.k) <= _ROUNDING * level.scale:
        return _circles(level, m, lambda v: level.sides(v)[0])
    found: list[Array] = []
    if level.has_circle:
        found += _circles(level, m, lambda v: _ratio(level.psi, v) - 1.0)
        if level.p == 0.0 and level.tau == 0.0:
            ends = np.array([0.25, 0.75]) * math.pi
            r = np.linspace(-1.0, 1.0, 2 * _MIN_POINTS + 1)[:, None]
            return found + [r * np.array([math.cos(t), math.sin(t)]) for t in ends]
    for piece in level.pieces(m):
        along, t = level.sampled(piece)
        for index, angle in _chains(piece, t):
            r = along[index][:, None]
            found.append(r * np.stack([np.cos(angle), np.sin(angle)], axis=-1))
    return found


def _circles(level: _TraceLevel, m: Array, function: Callable[[Array], Array]) -> list[Array]:
    """Circles |e| = m through the zeros of a function of m."""
    values = function(m)
    size = float(abs(values).max())
    if size <= 64 * _ROUNDING * (abs(level.p) + abs(level.root) + 1.0):
        return []
    t = np.linspace(0.0, 2.0 * math.pi, 2 * _MIN_POINTS + 1)
    ring = np.stack([np.cos(t), np.sin(t)], axis=-1)
    ring[-1] = ring[0]
    solid = abs(values) > 1e-9 * size
    return [v * ring for v in roots(function, [m[solid]], [values[solid]]).zeros[0].tolist()]


def hopf(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> BifurcationCurve:
    """Hopf curve of the layer problem in (f1, f2): tr J = 0 with det J > 0; Case III only (Section 4.3.3).

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    psi : Psi
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        `values` holds the first Lyapunov coefficient along each branch, and `special` the generalised Hopf (Bautin)
        points where it changes sign. For Psi = 1 the curve ends on the equator at the points where the saddle-node
        curve touches the ellipse.

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> curve = bifurcations.hopf("case3-n2")
    >>> curve.name, bifurcations.hopf("case1-cm4").name
    ('Hopf', 'Hopf: none')
    """
    a, b, d = matrix(system, z)
    _check_smooth(psi)
    label = "sec:case3"
    if a == d == 0.0 and b != 0.0:
        return BifurcationCurve(
            "hopf", "Hopf: everywhere", label, (),
            sentence=say("trace vanishes"),
        )  # fmt: skip
    if determinant_sign(a, b, d) <= 0 or a * d >= 0.0:
        return BifurcationCurve(
            "hopf", "Hopf: none", label, (),
            sentence=say("no Hopf outside Case III"),
        )  # fmt: skip
    level = _TraceLevel(a, b, d, psi, 0.0)
    branches, values, special = [], [], []
    for e in _trace_branches(level):
        branches.append(-e @ level.A.T)
        if level.p == 0.0 and _is_straight(e):
            # a = -d, e at 45 degrees: reflecting in e and reversing time leaves the layer problem as it is
            values.append(np.zeros(len(e)))
            continue
        values.append(_lyapunov(level, e))
        special += _bautin(level, e, values[-1])
    if not branches:
        sentence = say("no Hopf with this Ψ")
    elif level.p == 0.0:
        sentence = say("reversible lines")
    else:
        sentence = say("Hopf curve")
    name = "Hopf" if branches else "Hopf: none"
    return BifurcationCurve(
        "hopf", name, label, read_only_lines(branches), tuple(special), read_only_lines(values), sentence
    )


def _lyapunov(level: _TraceLevel, e: Array) -> Array:
    modulus = np.hypot(e[:, 0], e[:, 1])
    safe = np.clip(modulus, 1e-9, _MAX_MODULUS)
    with np.errstate(invalid="ignore", divide="ignore"):
        unit = np.where(modulus[:, None] > 0.0, e / modulus[:, None], np.array([math.sqrt(0.5), math.sqrt(0.5)]))
    x2 = level.psi.radius(safe)[:, None] * unit
    values = first_lyapunov(level.A, level.psi, x2)
    return np.where(np.isfinite(values), values, 0.0)


def _bautin(level: _TraceLevel, e: Array, values: Array) -> list[SpecialPoint]:
    """Find where the coefficient changes sign between neighbours, by the secant through the curve's own equation."""
    found = []
    # next to the equator, and where it underflows, its sign means nothing
    solid = (abs(values) > 1e-12 * abs(values).max()) & (np.hypot(e[:, 0], e[:, 1]) < 1.0 - 1e-6)
    for i in np.flatnonzero((np.sign(values[1:]) != np.sign(values[:-1])) & solid[1:] & solid[:-1]):
        m0, m1 = np.hypot(*e[i]), np.hypot(*e[i + 1])
        t0, t1 = math.atan2(e[i, 1], e[i, 0]), math.atan2(e[i + 1, 1], e[i + 1, 0])
        t1 = t0 + math.remainder(t1 - t0, 2.0 * math.pi)

        def on_curve(u: float, m0=m0, m1=m1, t0=t0, t1=t1) -> Array:
            m, t = m0 + u * (m1 - m0), t0 + u * (t1 - t0)
            N, D = level.sides(np.array([m]))
            if m0 != m1 and abs(N[0]) <= abs(D[0]) * (1.0 - 1e-9) and abs(level.k) > 0.0:
                near = float(level.angle(np.array([m]))[0])
                images = (near, -near, math.pi - near, math.pi + near)
                t = min((v for v in images), key=lambda v: abs(math.remainder(v - t, 2.0 * math.pi)))
            return m * np.array([[math.cos(t), math.sin(t)]])

        def coefficient(u: float, on_curve=on_curve) -> float:
            return float(_lyapunov(level, on_curve(u))[0])

        e0 = on_curve(root_between(coefficient, 0.0, 1.0, 1e-9))[0]
        found.append(
            SpecialPoint(
                "generalised Hopf", plain_point(-(level.A @ e0)),
                say("Bautin"),
            )
        )  # fmt: skip
    return found


def node_focus(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> BifurcationCurve:
    """Node-focus curve in (f1, f2): the discriminant tr(J)^2 - 4 det J = 0 with det J > 0 (Figure 17).

    It is no bifurcation (both sides are topologically the same), but the picture changes its looks.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    psi : Psi
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        First the branches where both eigenvalues are negative, then those where both are positive.

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> bifurcations.node_focus("case3-n2").name
    'node-focus'
    """
    a, b, d = matrix(system, z)
    _check_smooth(psi)
    label = "fig:bads"
    if determinant_sign(a, b, d) <= 0:
        return BifurcationCurve(
            "node-focus", "node-focus: none", label, (),
            sentence=say("saddle or none"),
        )  # fmt: skip
    branches = []
    special: tuple[SpecialPoint, ...] = ()
    if a == d and b == 0.0:
        special = (SpecialPoint("star node", (0.0, 0.0), say("both eigenvalues agree")),)
    else:
        for tau in (-1.0, 1.0):
            level = _TraceLevel(a, b, d, psi, tau)
            branches += [-e @ level.A.T for e in _trace_branches(level)]
    sentence = say("node-focus curve") if branches or special else say("one kind")
    name = "node-focus" if branches or special else "node-focus: none"
    return BifurcationCurve("node-focus", name, label, read_only_lines(branches), special, (), sentence)


def _check_smooth(psi: object) -> None:
    if not isinstance(psi, Psi):
        raise ValueError(f"psi is {psi!r}; give a regularisation function such as psi.rational().")
