"""The global section of an e-linear layer problem, and its crossings."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from ..arrays import Array
from ..layer_problem.critical import CriticalSet
from ..layer_problem.location import Location, locate
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from .equator_pull import EQUATOR_CAPTURE_HEIGHT, MIN_HEIGHT, UNDERFLOW_HEIGHT, EquatorPull, equator_pull

FIRST_SAMPLES = 64  # so many that lanes are full to the last
INNER_RADIUS, OUTER_ZETA = 1e-4, 1e5  # of the reach R, and in zeta: how near C and the equator the section is sampled
LAST_XI = math.log(9.0)  # xi from which samples are even in ln |x2|
COARSE_RTOL, FINE_RTOL = 1e-9, 1e-13  # tolerances
MAX_FIRST_ZETA = 1e6  # zeta from which the outer samples begin, at most
MAX_STEPS, MAX_TURN_TIME = 2000, 1e6  # steps tried, and T in units of 1/|(a, b, d, f1, f2)|
INNER_CAPTURE_RATIO = 1e-3  # of the innermost sample: gone, within one turn


@dataclass(frozen=True)
class FixedPoint:
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


class AnySection(Protocol):
    """A curve that cycles cross, and the first return to it: what `periodic_orbit` needs of it.

    Attributes
    ----------
    psi : Psi
    rate : float
        The unit of speed in which `field` and `derivative` are given.
    kernel : (module, function)
        The compiled return, and what keeps its field alive, with its address.
    pull : EquatorPull
    """

    psi: Psi
    rate: float

    @property
    def kernel(self) -> Any: ...  # noqa: D102

    @property
    def pull(self) -> Any: ...  # noqa: D102

    def field_parameters(self, backward: bool) -> Array:
        """Parameters of the compiled field."""
        ...

    def field(self, e: Array) -> Array:
        """U (n, 2) in units of `rate`."""
        ...

    def derivative(self, e: Array) -> Array:
        """D_e U, (n, 2, 2) or the same (2, 2) everywhere, in units of `rate`."""
        ...

    def states(self, xi: Array) -> tuple[Array, Array]:
        """States (n, 3) = (p_x, p_y, ebar) and their coordinate q (n,), at parameters (n,)."""
        ...

    def coordinate(self, states: Array) -> Array:
        """Coordinate q (n,) of states (n, 3) on the section."""
        ...

    def turn(
        self, states: Array, rtol: float, backward: bool = False, record: int = 0, limit: int = 0
    ) -> tuple[Array, Array, Any, Any]:
        """Follow one turn: states (n, 3) on return, times, codes and recorded steps."""
        ...

    def displacement(self, xi: Array, rtol: float = 0.0, backward: bool = False) -> Array:
        """Displacement of q over a turn, (n,)."""
        ...

    def grid(self) -> Array:
        """Parameters at which the map is sampled first."""
        ...


def integrate_turn(
    section: AnySection, follow: Callable[..., Any], states: Array, backward: bool, recorded: bool
) -> tuple[Array, Array, Any, Any]:
    """Follow one turn; those that the equator may not draw in are followed on, however close they come to it."""
    lost = min(
        EQUATOR_CAPTURE_HEIGHT,
        max(UNDERFLOW_HEIGHT, MIN_HEIGHT / max(MIN_HEIGHT, float(states[:, 2].min(initial=1.0)))),
    )
    if recorded:
        return follow(states, lost)
    ends, times, codes, record = follow(states, EQUATOR_CAPTURE_HEIGHT)
    close = np.flatnonzero(codes == section.kernel[0].OUTWARD)
    if len(close):
        again = close[section.pull.may_return(ends[close], section.field, backward)]
        if len(again):
            ends[again], times[again], codes[again], _ = follow(states[again], lost)
    return ends, times, codes, record


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
    location : Location, optional
        That of `locate`, where it is known already.
    """

    def __init__(
        self,
        coefficients: Coefficients,
        psi: Psi,
        critical: CriticalSet,
        ray: int | None = None,
        location: Location | None = None,
    ) -> None:
        self.psi, self.critical, self.coefficients = psi, critical, coefficients
        plane = np.array(coefficients.plane)
        size = float(np.abs(plane).max())
        self.rate = size * math.hypot(*(plane / size).tolist())
        self.plane = plane / self.rate
        location = locate(coefficients) if location is None else location
        self.location = location
        if location.e is None:
            raise ValueError("there is no critical set, so no section starts from it.")
        found = rays(coefficients.a, coefficients.d, location.e, location.complement)
        self.ray = max(range(4), key=lambda i: found[i][0]) if ray is None else ray
        self.reach, self.other, u = found[self.ray]
        self.u = np.array(u)
        self.e = np.array(location.e)
        self._states: tuple[Array, Array, Array] | None = None  # of the parameters asked for last

    @cached_property
    def pull(self) -> EquatorPull:
        """Return the first-order return map of orbits close to the equator."""
        return equator_pull(self.coefficients, self.location)

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
    def kernel(self) -> Any:
        """The compiled return map: its module, and the function for this Psi."""
        from ..stepping import fields
        from . import global_section_kernel

        return global_section_kernel, fields.field(self.psi)

    @cached_property
    def last(self) -> tuple[float, float]:
        """Return where r ends as the measure of the section (inf if never): xi and |x2|; further out it is ln |x2|.

        Where ``|e_Psi|`` is 1 from a finite |x2| on, r = reach is a whole radius, along which the section goes on: U is
        constant there, across the ray and so across that radius, in one sense.
        """
        if self.psi.saturation == math.inf:
            return math.inf, math.inf
        return LAST_XI, float(self._on_ray(np.array([LAST_XI]))[1][0])

    def _on_ray(self, xi: Array) -> tuple[Array, Array]:
        """Return e (n, 2) and |x2| (n,) at parameters (n,) of the ray ``e_C + r u``."""
        inner = self.reach / (1.0 + np.exp(-xi))
        rest = self.reach / (1.0 + np.exp(xi))  # reach - inner, to all digits
        e = self.e + inner[:, None] * self.u
        modulus = np.minimum(np.hypot(e[:, 0], e[:, 1]), 1.0)
        return e, self.psi.radius(modulus, np.clip(rest * (inner + self.other), 1e-300, 1.0))

    def xi_at_radius(self, zeta: Array) -> Array:
        """Find the parameter, to first order, far out where |x2| = zeta."""
        xi, last = self.last
        if xi < math.inf:
            return xi + np.log(zeta / last)
        gap = np.maximum(self.psi.complement(zeta), 1e-290) / (self.reach + self.other)
        return np.log(self.reach) - np.log(np.minimum(gap, self.reach))

    def states(self, xi: Array) -> tuple[Array, Array]:
        """States (n, 3) = (p_x, p_y, ebar), and q (n,), at parameters (n,); those of the same array are found once."""
        if self._states is None or self._states[0] is not xi:
            self._states = (xi, *self._section_states(xi))
        return self._states[1:]

    def _section_states(self, xi: Array) -> tuple[Array, Array]:
        last_xi, last = self.last
        e, zeta = self._on_ray(np.minimum(xi, last_xi))
        further = np.flatnonzero(xi > last_xi)
        if len(further):
            zeta[further] = last * np.exp(xi[further] - last_xi)
            # (reach - r)(r + other) = 1 - |e|^2
            half, complement = 0.5 * (self.reach + self.other), self.psi.complement(zeta[further])
            rest = complement / (half + np.sqrt(half * half - complement))
            e[further] = self.e + (self.reach - rest)[:, None] * self.u
        x2 = zeta[:, None] * e / np.maximum(np.hypot(e[:, 0], e[:, 1]), 1e-300)[:, None]
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
        limit: int = MAX_STEPS,
        elsewhere: bool = False,
    ) -> tuple[Array, Array, Any, Any]:
        """Integrate one turn: states on return (n, 3), times, codes and recorded steps; `global_section_kernel`."""
        module, function = self.kernel
        away = states[:, :2] / states[:, 2:] - self.critical.x2
        nearest = min(self.inner, float(np.hypot(away[:, 0], away[:, 1]).min()))
        sense, centre = -self.plane[1] if backward else self.plane[1], np.array(self.critical.x2)[None]

        def follow(states: Array, sunk: float) -> tuple[Array, Array, Any, Any]:
            return module.returns(
                states,
                self.field_parameters(backward)[None],
                function.address,
                self.u[None],
                centre,
                np.array([sense]),
                np.array([INNER_CAPTURE_RATIO * nearest]),
                np.array([sunk]),
                MAX_TURN_TIME,
                np.array([rtol]),
                limit,
                record,
                elsewhere,
            )

        return integrate_turn(self, follow, states, backward, record > 0)

    def field_parameters(self, backward: bool) -> Array:
        """Parameters of the compiled field."""
        from ..stepping.layout import SHARED_SIZE
        from ..stepping.psi_gain import gain_parameter

        shared = np.zeros(SHARED_SIZE)
        shared[:5] = -self.plane if backward else self.plane
        shared[5] = gain_parameter(self.psi)
        return shared

    @cached_property
    def inner(self) -> float:
        """Distance from C in x2 of the innermost sample, to first order."""
        radial, tangential = self.psi.jacobian_factors(float(np.hypot(*self.critical.x2)))
        along = float(self.e @ self.u) / max(float(np.hypot(*self.e)), 1e-300)
        return INNER_RADIUS * self.reach * (1.0 / tangential + along * along * (1.0 / radial - 1.0 / tangential))

    def displacement(self, xi: Array, rtol: float = COARSE_RTOL, backward: bool = False) -> Array:
        """Displacement of q over a turn (n,): -inf to C, +inf to the equator, NaN undecided."""
        module, _ = self.kernel
        states, q = self.states(xi)
        ends, _, codes, _ = self.turn(states, rtol, backward)
        shift = self.coordinate(ends) - q
        shift[codes == module.TO_CRITICAL_SET] = -np.inf
        shift[codes == module.OUTWARD] = np.inf
        shift[codes == module.NO_RETURN_YET] = np.nan
        return shift

    def grid(self) -> Array:
        """Choose samples: even in ln r near C, in ln zeta near the equator."""
        inner = np.linspace(math.log(INNER_RADIUS), LAST_XI, FIRST_SAMPLES - 24)
        start = min(max(float(self._on_ray(inner[-1:])[1][0]), 1e-3), MAX_FIRST_ZETA)
        outer = self.xi_at_radius(np.geomspace(start, max(OUTER_ZETA, 10.0 * start), 25)[1:])
        xi = np.concatenate([inner, outer[outer > inner[-1] + 1e-3]])
        return np.unique(np.minimum(xi, 600.0))
