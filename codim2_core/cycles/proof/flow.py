"""The e-linear layer problem as numbers to prove things with, and orbits of it when it is turned by a fixed angle.

Time runs so that a cycle attracts, and the plane is mirrored where it then goes round clockwise: what is off a cycle
that repels strongly is never seen to close. Where no cycle is given, time runs so that orbits go round anticlockwise.
In kappa_2 the orbits of the turned field ``R(angle) U`` cross those of U at that angle everywhere. Which angle closes
the orbit through a place of the section says how U itself winds there: it is positive where orbits come back farther
out, and zero on a limit cycle. Angles and lengths are those of coordinates in which a cycle is as round as can be: in
x2 it may be a sliver.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ...layer_problem.problem import LayerProblem
from ...psi.kernel import SCALAR
from .fields import mean_divergence

Array = NDArray[np.float64]
Place = tuple[float, float]

STEEP = 1.45  # of an angle: at right angles to U nothing goes round
FAR = 1e5  # |x2|
SUNK = 1e-9  # of the distance from C
CLOSED = 1e-8  # in `height`
COARSE = 0.05  # turning of an edge, where only the end of the orbit is asked for


class Undecided(Exception):
    """Something is not proved; the text is the key of the sentence that says why."""


class Flow:
    """The velocity of an e-linear layer problem in kappa_2, anticlockwise, in units of its largest coefficient.

    Places are those of a plane that may be mirrored, (x, mirror y).

    Parameters
    ----------
    problem : LayerProblem
        With a critical set and ``a d < 0 < det A``.
    steps : int
        How many steps may be made.
    cycle : ndarray (m, 2), optional
        x2 on a cycle, which is to attract, and which lengths are to make round; by default, the orbits near a focus C.

    Attributes
    ----------
    frame : ndarray (2, 2)
        Of determinant 1: lengths are those of ``frame @ x2``.
    sense : int
        1, or -1 where time runs backward here.
    mirror : int
        1, or -1 where y is -y here.
    reach : float
        Length of the section in e, from C to the equator.
    """

    def __init__(self, problem: LayerProblem, steps: int, cycle: Array | None = None) -> None:
        affine = problem.at.affine
        assert affine is not None
        self.left, self.psi = steps, problem.psi
        turns = 1 if affine[2] > affine[1] else -1
        self.sense = turns if cycle is None else -1 if mean_divergence(problem.psi, affine, cycle) > 0.0 else 1
        self.mirror = turns * self.sense
        size = self.sense * max(map(abs, affine))
        a, b, c, d, f, g = (value / size for value in affine)
        self.numbers = (a, b, c, d, f, g) = a, self.mirror * b, self.mirror * c, d, f, self.mirror * g
        kernel = problem.psi.kernel
        self.value: Callable[[float], float] = partial(kernel.value, SCALAR)
        self.slope: Callable[[float], float] = partial(kernel.slope, SCALAR)
        det = a * d - b * c
        self.e_C = (b * g - d * f) / det, (c * f - a * g) / det
        self.u, self.reach = self._section()
        self.C = self.place(0.0)
        self.frame = np.linalg.cholesky(self._at_C() if cycle is None else _rounding(cycle * (1, self.mirror))).T
        self.metric: tuple[float, float, float] = tuple((self.frame.T @ self.frame).ravel()[[0, 1, 3]].tolist())

    def _at_C(self) -> Array:
        """Return the form that the linearisation at C turns, or that of x2 where it turns none."""
        p, q, size = self.scaled(*self.C)
        stretch = np.eye(2) - (1.0 + self.slope(self.C[0] ** 2 + self.C[1] ** 2)) * np.outer((p, q), (p, q))
        J = np.reshape(self.numbers[:4], (2, 2)) @ stretch / size
        K = J - 0.5 * np.trace(J) * np.eye(2)
        turning = float(np.linalg.det(K))
        if turning <= 1e-3 * float((K**2).sum()):
            return np.eye(2)
        return np.array([[K[1, 0], -K[0, 0]], [-K[0, 0], -K[0, 1]]]) / math.sqrt(turning)

    def _section(self) -> tuple[Place, float]:
        """Return the longest of the rays from C in e on which all velocities are parallel, see `limit_cycles`."""
        a, b, c, d, _, _ = self.numbers
        weights, axes = np.linalg.eigh([[a, 0.5 * (b + c)], [0.5 * (b + c), d]])
        first, second = math.sqrt(weights[1]), math.sqrt(-weights[0])
        found = []
        for sign in (1.0, -1.0):
            for u in (axes @ (first, sign * second), axes @ (-first, -sign * second)):
                u = u / math.hypot(*u)
                along = float(u @ self.e_C)
                rest = 1.0 - self.e_C[0] ** 2 - self.e_C[1] ** 2
                found.append((math.sqrt(along * along + rest) - along, (float(u[0]), float(u[1]))))
        reach, u = max(found)
        return u, reach

    def scaled(self, x: float, y: float) -> tuple[float, float, float]:
        """Return e_Psi and q, with ``x2 = q e_Psi``."""
        s = x * x + y * y
        q = math.sqrt(s + self.value(s))
        return x / q, y / q, q

    def velocity(self, x: float, y: float) -> Place:
        """Return U at x2."""
        a, b, c, d, f, g = self.numbers
        p, q, _ = self.scaled(x, y)
        return a * p + b * q + f, c * p + d * q + g

    def place(self, r: float) -> Place:
        """Return x2 on the section, at the distance r from C in e."""
        if not r < self.reach * (1.0 - 1e-12):
            raise Undecided("proof is too steep")
        x, y = self.e_C[0] + r * self.u[0], self.e_C[1] + r * self.u[1]
        modulus = math.hypot(x, y)
        zeta = self.psi.radius(modulus) / modulus if modulus else 0.0
        return zeta * x, zeta * y

    def beside(self, x: float, y: float) -> Place:
        """Return how far along the section x2 is, and how far beside it, in e."""
        p, q, _ = self.scaled(x, y)
        p, q, (u, v) = p - self.e_C[0], q - self.e_C[1], self.u
        return u * p + v * q, u * q - v * p

    def height(self, r: float) -> float:
        """Return the coordinate of the section that is -inf at C and inf on the equator."""
        return math.log(r / (self.reach - r))

    def at_height(self, height: float) -> float:
        """Return the distance from C, inverse of `height`."""
        return self.reach / (1.0 + math.exp(-height))

    def way(self, r: float, to: float) -> list[Place]:
        """Return places along the section, from the distance r to another, not the first."""
        start, end = self.height(r), self.height(to)
        count = max(2, math.ceil(4.0 * abs(end - start)))
        return [self.place(self.at_height(start + (end - start) * k / count)) for k in range(1, count + 1)]

    def product(self, p: Place, q: Place) -> float:
        """Return the inner product of two vectors."""
        first, both, last = self.metric
        return first * p[0] * q[0] + both * (p[0] * q[1] + p[1] * q[0]) + last * p[1] * q[1]

    def dist(self, p: Place, q: Place) -> float:
        """Return the distance of two places."""
        between = p[0] - q[0], p[1] - q[1]
        return math.sqrt(max(self.product(between, between), 0.0))

    def turn(
        self,
        r: float,
        angle: float,
        edge: float = COARSE,
        backward: bool = False,
        stop: Callable[[float, float], bool] | None = None,
    ) -> tuple[list[Place], float]:
        """Follow the field that is turned by an angle from the section once round C.

        Parameters
        ----------
        r : float
        angle : float
        edge : float
            How much the direction may change in a step.
        backward : bool
        stop : callable, optional
            Says at which place to stop before that.

        Returns
        -------
        list of places, float
            The distance from C on return: 0 at C, the reach far out, NaN where it was stopped.
        """
        way = -1.0 if backward else 1.0
        m11, m12, m22 = self.metric
        cosine, sine = way * math.cos(angle), way * math.sin(angle)

        def direction(x: float, y: float) -> Place:
            u, v = self.velocity(x, y)
            lower, upper = m11 * u + m12 * v, m12 * u + m22 * v
            size = math.sqrt(max(u * lower + v * upper, 0.0)) or 1e-300
            return (cosine * u - sine * upper) / size, (sine * lower + cosine * v) / size

        def step(place: Place, first: Place, h: float) -> Place:
            x, y = place
            second = direction(x + 0.5 * h * first[0], y + 0.5 * h * first[1])
            third = direction(x + 0.5 * h * second[0], y + 0.5 * h * second[1])
            last = direction(x + h * third[0], y + h * third[1])
            return (
                x + h / 6.0 * (first[0] + 2.0 * second[0] + 2.0 * third[0] + last[0]),
                y + h / 6.0 * (first[1] + 2.0 * second[1] + 2.0 * third[1] + last[1]),
            )

        here = self.place(r)
        start = self.dist(here, self.C)
        places, first, h, before, left = [here], direction(*here), edge * start, 0.0, False
        while True:
            self.left -= 1
            if self.left < 0:
                raise Undecided("proof is too long")
            while True:
                there = step(here, first, h)
                second = direction(*there)
                turned = abs(math.atan2(first[0] * second[1] - first[1] * second[0], self.product(first, second)))
                if turned <= 1.3 * edge or h < 1e-13 * start:
                    break
                h *= max(0.3, 0.9 * edge / turned)
            along, side = self.beside(*there)
            side *= way
            if left and along > 0.0 and before < 0.0 <= side:
                low, high = (0.0, before), (h, side)
                for _ in range(40):
                    middle = low[0] - low[1] * (high[0] - low[0]) / (high[1] - low[1])
                    room = 0.02 * (high[0] - low[0])
                    middle = min(max(middle, low[0] + room), high[0] - room)
                    there = step(here, first, middle)
                    along, side = self.beside(*there)
                    low, high = ((middle, way * side), high) if way * side < 0.0 else (low, (middle, way * side))
                    if abs(side) < 1e-15:
                        break
                if len(places) > 1 and self.dist(there, here) < 0.5 * self.dist(here, places[-2]):
                    places.pop()  # two short edges are one
                return [*places, there], along
            left, before = left or side < 0.0, side
            here, first = there, second
            places.append(here)
            if stop is not None and stop(*here):
                return places, math.nan
            radius = math.hypot(*here)
            if radius > FAR:
                return places, self.reach
            near = self.dist(here, self.C)
            if near < SUNK * start:
                return places, 0.0
            h = min(h * min(2.0, max(0.7, edge / max(turned, 1e-300))), 0.3 * near)

    def shift(self, r: float, angle: float) -> float:
        """Return by how much a turn of the turned field goes out, in `height`."""
        _, end = self.turn(r, angle)
        if not 0.0 < end < self.reach:
            return math.inf if end > 0.0 else -math.inf
        return self.height(end) - self.height(r)

    def closing(self, r: float, guess: float = 0.0, tolerance: float = CLOSED) -> float:
        """Find the angle at which the orbit of the turned field through a place of the section closes."""
        low, at_low = guess, self.shift(r, guess)
        way, size = (1.0 if at_low > 0.0 else -1.0), max(0.05, 0.3 * abs(guess))
        high, at_high = low, at_low
        while at_low * at_high > 0.0:
            low, at_low = high, at_high
            if abs(low) >= STEEP:
                raise Undecided("proof is too steep")
            high = min(max(high + way * size, -STEEP), STEEP)
            at_high, size = self.shift(r, high), 2.0 * size
        for k in range(60):
            finite = math.isfinite(at_low) and math.isfinite(at_high) and at_low != at_high and k % 4 < 3
            middle = (low * at_high - high * at_low) / (at_high - at_low) if finite else 0.5 * (low + high)
            at_middle = self.shift(r, middle)
            if abs(at_middle) < tolerance or abs(high - low) < 1e-12:
                return middle
            low, at_low, high, at_high = (
                (middle, at_middle, high, at_high) if at_middle * at_low > 0.0 else (low, at_low, middle, at_middle)
            )
        return 0.5 * (low + high)


def _rounding(cycle: Array) -> Array:
    """Return the form, of determinant 1, in which a closed polyline is as wide as it is long."""
    step = np.hypot(*np.diff(cycle, axis=0).T)
    middle = 0.5 * (cycle[1:] + cycle[:-1])
    spread = np.cov(middle.T, aweights=step)
    return np.asarray(np.linalg.inv(spread) * math.sqrt(np.linalg.det(spread)), float)
