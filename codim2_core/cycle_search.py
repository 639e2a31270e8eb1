"""Fixed points of the return map on a global section; see `cycles` for the section.

The section is ``e = e_C + r u``, ``r = R/(1 + exp(-xi))`` with R where it meets the equator; xi is a parameter of
it that resolves both ends. A point is measured by ``q = ln u.(x2 - x2_C)``, which increases along the section, and
the displacement is ``q(after one turn) - q``: -inf where the orbit goes to C, +inf where it goes to the equator.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .critical import CriticalSet, locate
from .regularisation import Psi
from .systems import Coefficients

Array = NDArray[np.float64]

SAMPLES = 64
INNER, OUTER = 1e-4, 1e5  # of the reach R, and in zeta: how near C and the equator the section is sampled
COARSE, FINE = 1e-9, 1e-13  # tolerances
STEPS, LONGEST = 2000, 1e6  # steps tried, and T in units of 1/|(a, b, d, f1, f2)|
ROUNDS, POINTS = 8, 31  # of refinement
SUNK_INWARD, SUNK_OUTWARD = 1e-3, 1e-9  # of the innermost sample, of the first ebar: gone, within one turn
CLOSE = 1e-3  # width at which a jump from -inf to +inf is left to the map backward in time
MOST, UNDECIDED = 96, 0.25  # samples added in a round; share of undecided ones at which looking closer is in vain
NOISE = 1e-8  # displacement that COARSE cannot tell from zero
FINE_NOISE = 1e-11  # and FINE
NEAR_LOOP = 1e-3
MEASURED, SMALLEST = 2.0, 1e-8  # where the expansion at C is measured, in INNER; the smallest cycle, in r/R


@dataclass(frozen=True)
class Crossing:
    """A fixed point of the return map: its parameter, and how the displacement meets zero there.

    `born`: just born in a Hopf bifurcation, too small for the sampled map and placed by its expansion at C.
    """

    xi: float
    repelling: bool = False
    touching: bool = False
    born: bool = False


def rays(
    a: float, d: float, e: tuple[float, float], complement: float
) -> list[tuple[float, float, tuple[float, float]]]:
    """Find the four rays ``e + r u`` with ``a u1^2 + d u2^2 = 0``.

    Parameters
    ----------
    a, d : float
        Of opposite sign.
    e : (c, s)
        Where they start, in the open disc.
    complement : float
        ``1 - |e|^2``.

    Returns
    -------
    four (reach, other, u)
        ``|e + r u|^2 - 1 = (r - reach)(r + other)``.
    """
    a, d = abs(a), abs(d)
    u1, u2 = math.sqrt(d / (a + d)), math.sqrt(a / (a + d))
    found = []
    for s1, s2 in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        u = (s1 * u1, s2 * u2)
        along = u[0] * e[0] + u[1] * e[1]
        root = math.sqrt(along * along + complement)
        reach = complement / (root + along) if along > 0.0 else root - along
        found.append((reach, complement / reach, u))
    return found


class Section:
    """The section of one system, and its return map (forward, or backward in time).

    Parameters
    ----------
    coefficients : Coefficients
        With a d < 0 and a critical set.
    psi : Psi
    critical : CriticalSet
    ray : int, optional
        Which of the four rays; by default the one that is longest in e.
    """

    def __init__(self, coefficients: Coefficients, psi: Psi, critical: CriticalSet, ray: int | None = None) -> None:
        self.psi, self.critical, self.coefficients = psi, critical, coefficients
        plane = np.array(coefficients.plane)
        size = float(np.abs(plane).max())
        self.rate = size * math.hypot(*(plane / size).tolist())
        self.plane = plane / self.rate
        location = locate(coefficients)
        if location.e is None:
            raise ValueError("there is no critical set, so no section starts from it.")
        found = rays(coefficients.a, coefficients.d, location.e, location.complement)
        self.ray = max(range(4), key=lambda i: found[i][0]) if ray is None else ray
        self.reach, self._other, u = found[self.ray]
        self.u = np.array(u)
        self.e = np.array(location.e)

    @property
    def matrix(self) -> Array:
        """A in units of `rate`, (2, 2)."""
        a, b, d = self.plane[:3].tolist()
        return np.array([[a, -b], [b, d]])

    def field(self, e: Array) -> Array:
        """``U = A (e - e_C)`` in units of `rate`, (n, 2)."""
        return (e - self.e) @ self.matrix.T

    def derivative(self, e: Array) -> Array:  # noqa: ARG002 (the same everywhere)
        """D_e U = A in units of `rate`, (2, 2)."""
        return self.matrix

    @cached_property
    def inverse(self) -> Array:
        """Inverse of A in units of `rate`, transposed, (2, 2)."""
        a, b, d = self.plane[:3].tolist()
        return np.array([[d, -b], [b, a]]) / (a * d + b * b)

    @cached_property
    def _kernel(self) -> Any:
        from . import return_map, stepping_fields

        return return_map, stepping_fields.field(self.psi)

    def xi_at_radius(self, zeta: Array) -> Array:
        """Find the parameter, to first order, far out where |x2| = zeta."""
        gap = np.maximum(self.psi.complement(zeta), 1e-290) / (self.reach + self._other)
        return np.log(self.reach) - np.log(np.minimum(gap, self.reach))

    def states(self, xi: Array) -> tuple[Array, Array]:
        """States (n, 3) = (p_x, p_y, ebar), and q (n,), at parameters (n,)."""
        inner = self.reach / (1.0 + np.exp(-xi))
        rest = self.reach / (1.0 + np.exp(xi))  # reach - inner, to all digits
        e = self.e + inner[:, None] * self.u
        modulus = np.minimum(np.hypot(e[:, 0], e[:, 1]), 1.0)
        zeta = self.psi.radius(modulus, np.clip(rest * (inner + self._other), 1e-300, 1.0))
        x2 = zeta[:, None] * e / np.maximum(modulus, 1e-300)[:, None]
        height = 1.0 / np.hypot(1.0, zeta)
        states = np.column_stack([x2 * height[:, None], height])
        return states, self.coordinate(states)

    def coordinate(self, states: Array) -> Array:
        """``q = ln u.(x2 - x2_C)``, (n,)."""
        along = (states[:, :2] / states[:, 2:] - self.critical.x2) @ self.u
        return np.log(np.maximum(along, 1e-300))

    def turn(
        self,
        states: Array,
        rtol: float,
        backward: bool = False,
        record: int = 0,
        limit: int = STEPS,
        elsewhere: bool = False,
    ) -> tuple[Array, Array, Any, Any]:
        """Follow one turn: states on return (n, 3), times, codes and recorded steps of `return_map.returns`."""
        module, function = self._kernel
        away = states[:, :2] / states[:, 2:] - self.critical.x2
        nearest = min(self.inner, float(np.hypot(away[:, 0], away[:, 1]).min()))
        return module.returns(
            states,
            self.shared(backward),
            function.address,
            self.u,
            self.critical.x2,
            math.copysign(1.0, -self.plane[1] if backward else self.plane[1]),
            SUNK_INWARD * nearest,
            SUNK_OUTWARD,
            LONGEST,
            rtol,
            limit,
            record,
            elsewhere,
        )

    def shared(self, backward: bool = False) -> Array:
        """Parameters of the compiled field."""
        from .stepping_layout import SHARED

        shared = np.zeros(SHARED)
        shared[:5] = -self.plane if backward else self.plane
        shared[5] = self.psi.parameter
        return shared

    @cached_property
    def inner(self) -> float:
        """Distance from C in x2 of the innermost sample, to first order."""
        radial, tangential = self.psi.jacobian_factors(float(np.hypot(*self.critical.x2)))
        along = float(self.e @ self.u) / max(float(np.hypot(*self.e)), 1e-300)
        return INNER * self.reach * (1.0 / tangential + along * along * (1.0 / radial - 1.0 / tangential))

    def displacement(self, xi: Array, rtol: float = COARSE, backward: bool = False) -> Array:
        """Displacement of q over a turn (n,): -inf to C, +inf to the equator, NaN undecided."""
        module, _ = self._kernel
        states, q = self.states(xi)
        ends, _, codes, _ = self.turn(states, rtol, backward)
        shift = self.coordinate(ends) - q
        shift[codes == module.INWARD] = -np.inf
        shift[codes == module.OUTWARD] = np.inf
        shift[codes == module.UNDECIDED] = np.nan
        return shift

    def grid(self) -> Array:
        """Choose samples: even in ln r near C, in ln zeta near the equator."""
        inner = np.linspace(math.log(INNER), math.log(9.0), SAMPLES - 24)
        start = float(np.linalg.norm(self.states(inner[-1:])[0][0, :2]))
        start = max(start / math.sqrt(max(1.0 - start * start, 1e-12)), 1e-3)
        outer = self.xi_at_radius(np.geomspace(start, max(OUTER, 10.0 * start), 26)[1:])
        xi = np.concatenate([inner, outer[outer > inner[-1] + 1e-3]])
        return np.unique(np.minimum(xi, 600.0))


def _between(low: float, high: float, count: int) -> Array:
    return low + (high - low) * np.arange(1, count + 1) / (count + 1)


def _settled(shift: Array, inner: int, step: int) -> bool:
    """Whether the displacement has all but reached its limit where orbits stop returning, well away from zero.

    Past a saddle it converges like a power of the distance; over the last samples that distance fell fourfold.
    """
    last = 3 * step + inner
    if not 0 <= last < len(shift):
        return False
    y, before = shift[inner], shift[last]
    return bool(np.isfinite(before) and abs(y) > 8.0 * abs(y - before))


def _wanted(xi: Array, shift: Array) -> list[Array]:
    """Where to look closer: ends of the interval that returns, and places where the displacement nearly vanishes."""
    new = []
    finite = np.isfinite(shift)
    for i in range(len(xi) - 1):
        width = xi[i + 1] - xi[i]
        if width <= 1e-12 * max(1.0, abs(xi[i])):
            continue
        if finite[i] != finite[i + 1]:
            # Where it returns next to where it leaves: a fixed point may hide in the gap, before the displacement
            # jumps to +inf; to -inf, on C, it goes continuously.
            inner, outer, step = (i, i + 1, -1) if finite[i] else (i + 1, i, 1)
            hidden = shift[outer] > 0.0 or (np.isinf(shift[outer]) and shift[inner] > 0.0)
            if hidden and not (width < 0.05 and _settled(shift, inner, step)):
                new.append(_between(xi[i], xi[i + 1], POINTS))
        elif width > CLOSE and np.isinf(shift[i]) and shift[i + 1] == -shift[i]:
            new.append(_between(xi[i], xi[i + 1], POINTS))
    for i in range(1, len(xi) - 1):
        y0, y1, y2 = shift[i - 1 : i + 2]
        if not (finite[i - 1] and finite[i] and finite[i + 1]) or y1 == 0.0:
            continue
        s = math.copysign(1.0, y1)
        y0, y1, y2 = s * y0, s * y1, s * y2
        if not (0.0 < y1 <= y0 and y1 <= y2):
            continue
        # An extremum towards zero: could it reach zero between the samples?
        depth = max(y0, y2) - y1
        if y1 < depth + NOISE and xi[i + 1] - xi[i - 1] > 1e-6:
            new += [_between(xi[i - 1], xi[i], 5), _between(xi[i], xi[i + 1], 5)]
    return new


def _sampled(section: Section, backward: bool) -> tuple[Array, Array]:
    xi = section.grid()
    shift = section.displacement(xi, backward=backward)
    for _ in range(ROUNDS):
        new = _wanted(xi, shift)
        if not new or np.isnan(shift).mean() > UNDECIDED:
            break
        more = np.concatenate(new)[:MOST]
        xi = np.concatenate([xi, more])
        shift = np.concatenate([shift, section.displacement(more, backward=backward)])
        order = np.argsort(xi, kind="stable")
        xi, shift = xi[order], shift[order]
    return xi, shift


def _polished(section: Section, low: float, high: float, backward: bool) -> float:
    """Find the fixed point between two samples of opposite sign: rounds of samples, then interpolation."""
    for _ in range(8):
        xi = np.concatenate([[low], _between(low, high, 30), [high]])
        shift = section.displacement(xi, COARSE, backward)
        changes = np.flatnonzero((shift[1:] < 0.0) != (shift[:-1] < 0.0))
        i = int(changes[0]) if len(changes) else len(xi) // 2
        low, high = float(xi[i]), float(xi[i + 1])
        if high - low < 1e-3 and np.isfinite(shift[max(i - 2, 0) : i + 4]).all():
            break
    width = high - low
    x = low + width * np.array([-2.0, -1.0, 0.0, 1.0, 2.0, 3.0])
    y = section.displacement(x, FINE, backward)
    if not np.isfinite(y).all() or len(np.unique(y)) < len(y):
        return 0.5 * (low + high)
    # Lagrange's polynomial for the parameter as a function of the displacement, at zero.
    guess = sum(
        float(x[j]) * math.prod(float(-y[k] / (y[j] - y[k])) for k in range(len(y)) if k != j) for j in range(len(y))
    )
    return guess if low - width <= guess <= high + width else 0.5 * (low + high)


def _newborn(section: Section) -> Crossing | None:
    """Place a cycle below the innermost sample: ``displacement = 2 pi mu/omega + c r^2``, its first term exact.

    c is measured well outside the cycle, where rounding (1e-16/r) does not matter yet; what is left is of order r^2.
    None below `SMALLEST`, where the trace of J has lost its digits.
    """
    C = section.critical
    linear = 2.0 * math.pi * C.trace / math.sqrt(-C.discriminant)
    r = INNER * MEASURED * np.array([1.0, 2.0, 4.0])
    parts = (section.displacement(np.log(r / (1.0 - r)), FINE) - linear) / r**2
    square = float(parts @ (8.0, -6.0, 1.0)) / 3.0  # takes out the next two powers of r
    if not square * linear < 0.0:
        return None
    size = math.sqrt(-linear / square)
    if not SMALLEST <= size < 2.0 * INNER:
        return None
    return Crossing(math.log(size / (1.0 - size)), square > 0.0, born=True)


def search(section: Section) -> tuple[tuple[Crossing, ...], tuple[str, ...]]:
    """All fixed points, innermost first, and notes on what is nearly degenerate.

    Parameters
    ----------
    section : Section
    """
    found: list[Crossing] = []
    notes: list[str] = []
    xi, shift = _sampled(section, backward=False)
    finite = np.isfinite(shift)
    if finite.sum() >= 8 and np.abs(shift[finite]).max() < NOISE:
        return (), ("The return map is the identity within resolution: closed orbits fill a band (a centre).",)
    if np.isnan(shift).any():
        notes.append("Some orbits were not followed to a decision: they pass an equilibrium too slowly.")
    known = ~np.isnan(shift)
    xi, shift, finite = xi[known], shift[known], finite[known]
    doubtful = finite & (np.abs(shift) < NOISE)
    if doubtful.any():
        shift[doubtful] = section.displacement(xi[doubtful], FINE)
    for i in range(len(xi) - 1):
        y, after = float(shift[i]), float(shift[i + 1])
        if (y < 0.0) == (after < 0.0):
            continue
        low, high = float(xi[i]), float(xi[i + 1])
        repelling = y < 0.0  # then it attracts backward, and is found and followed backward
        both = finite[i] and finite[i + 1]
        if not both and repelling:
            # It may be so repelling that forward no sample beside it returns.
            back = section.displacement(np.array([low, high]), backward=True)
            both = bool(back[0] > 0.0 > back[1])
        if both:
            found.append(Crossing(_polished(section, low, high, repelling), repelling))
    last = shift[:-1][finite[:-1] & (shift[1:] == np.inf)]
    notes += [
        f"Near a loop through the equator: the last orbit that returns misses its start by {y:.1e} in ln|x₂ − C|; "
        "beyond it orbits go to the equator."
        for y in last.tolist()
        if abs(y) < NEAR_LOOP
    ]
    for i in range(1, len(xi) - 1):
        y0, y1, y2 = (float(v) for v in shift[i - 1 : i + 2])
        if not np.isfinite([y0, y1, y2]).all() or (y0 < 0.0) != (y1 < 0.0) or (y1 < 0.0) != (y2 < 0.0):
            continue
        if abs(y1) <= min(abs(y0), abs(y2)) and abs(y1) < FINE_NOISE and float(xi[i]) > math.log(100.0 * INNER):
            found.append(Crossing(float(xi[i]), touching=True))
    trace = section.critical.trace
    if finite.any() and finite[0] and section.critical.discriminant < 0.0 and shift[0] * trace < 0.0:
        newborn = _newborn(section)
        if newborn is not None:
            found.append(newborn)
        else:
            notes.append("A cycle too small to resolve surrounds C: it was just born in a Hopf bifurcation.")
    return tuple(sorted(found, key=lambda crossing: crossing.xi)), tuple(notes)
