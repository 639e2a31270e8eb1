"""Turns of the return map of the layer problem with their exact derivatives, many at once, for continuation of cycles.

The section is the ray ``e = e_C + r u`` of `cycles.global_section`, ``r = R/(1 + exp(-xi))``; all of it depends
on the value mu of the parameter that varies. With ``F = x2'``, ``D = D e_Psi`` and ``F x v = F1 v2 - F2 v1``, a
deviation obeys

    F x delta(end) = exp(E) F x delta(0) + M,    E = int div dtau,    M = int exp(E(tau, end)) F x U_mu dtau

(Liouville's formula, Melnikov's integral), and both ends lie on the section: along ``t = D^-1 u`` when r changes, along
``s = D^-1 (e_C' + r u') (and Psi')`` when mu changes at fixed r. Hence ``dr(end)/dr = exp(E)`` where the map has a
fixed point, and ``dr(end)/dmu = ((exp(E) - 1) F x s + M)/(F x t)`` at fixed r.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..cycles.periodic_orbit import MOST_STEPS, gauss
from ..cycles.section_batch.sections import STEP_NODES, Indices, Sections
from .turn_columns import PARAMETERS, SHIFT

RTOL = 1e-12  # of one turn


@dataclass(frozen=True)
class ReturnMapPoint:
    """One turn from the section, at parameter value `value`; times in tau.

    Attributes
    ----------
    xi, value : float
        Where on the section, and the parameter's value.
    shift : float
        ``ln u.(x2 - C)`` after the turn minus before it; zero on a cycle.
    by_xi, by_value : float
        Derivatives of `shift`, at fixed value and at fixed xi.
    exponent : float
        ln of the Floquet multiplier.
    period : float
    amplitude : float
        Largest ``|p - p_C|`` on it in the projected disc.
    height : float
        Smallest ebar on it: how near to the equator it comes.
    rate : float
        d chi/d xi, where chi = y/(1 + y) is the place on the section, in [0, 1), ``y = u.(x2 - C)``.
    drift : float
        d chi/d value at fixed xi.
    chi : float
    p : (float, float)
        Where it crosses the section, in the projected disc.
    steps : int
        Of the integration: what it has cost.
    """

    xi: float
    value: float
    shift: float
    by_xi: float
    by_value: float
    exponent: float
    period: float
    amplitude: float
    height: float
    rate: float
    drift: float
    chi: float
    p: tuple[float, float]
    steps: int = 0


@dataclass(frozen=True)
class ReturnMapPoints:
    """Turns side by side, see `ReturnMapPoint`, of those asked for that return.

    Attributes
    ----------
    rows : ndarray of int (k,)
        Which these are.
    xi : ndarray (k,)
    numbers : ndarray (k, PARAMETERS + 2 q)
        Those of `turn_columns`.
    p : ndarray (k, 2)
    steps : ndarray of int (k,)
    """

    rows: Indices
    xi: Array
    numbers: Array
    p: Array
    steps: Indices

    def each(self, values: list[float]) -> list[ReturnMapPoint | None]:
        """One by one, given the value of every turn asked for: None for those that do not return."""
        found: list[ReturnMapPoint | None] = [None] * len(values)
        columns = (self.rows, self.xi, self.numbers, self.p, self.steps)
        for i, xi, row, p, steps in zip(*(v.tolist() for v in columns), strict=True):
            shift, by_xi, exponent, period, amplitude, height, rate, chi, *more = row
            by_value, drift = more[0], more[len(more) // 2]
            found[i] = ReturnMapPoint(
                xi, values[i], shift, by_xi, by_value, exponent, period, amplitude, height, rate, drift, chi,
                (p[0], p[1]), steps,
            )  # fmt: skip
        return found


#: Change of |e_Psi| with a parameter, at given zeta (k,) of systems (k,).
Swelling = Callable[[Array, Indices], Array]


def integrate_turns(
    sections: Sections,
    xi: Array,
    backward: NDArray[np.bool_],
    changes: Array,
    swelling: Swelling | None = None,
    limit: int = MOST_STEPS,
) -> ReturnMapPoints:
    """Follow one turn from each of n sections.

    Parameters
    ----------
    sections : Sections
    xi : ndarray (n,)
    backward : ndarray of bool (n,)
        Followed backward in time, which is accurate where the cycle repels. The result is the same.
    changes : ndarray (q, n, 5)
        d/dmu of (a, b, d, f1, f2) for the parameters by which turns are differentiated.
    swelling : callable, optional
        That of the one parameter, where Psi changes with it.
    limit : int
        Steps after which a turn is given up.
    """
    from ..cycles.section_batch import geometry
    from .turn_quadratures import turn_quadratures

    start, x2 = sections.starts(xi)
    states = geometry.hemisphere(x2)
    rows, ways = sections.integrate_turns(states, RTOL, backward, limit)
    if ways is None:
        return ReturnMapPoints(rows, np.zeros(0), np.zeros((0, PARAMETERS + 2 * len(changes))), np.zeros((0, 2)), rows)
    if len(rows) < len(sections):
        sections, start, x2, changes = sections.select(rows), start[rows], x2[rows], changes[:, rows]
    every = np.arange(len(rows))
    places = geometry.distances(ways.inner, states[rows], ways.ends, sections.zeta)
    whose = np.concatenate([ways.whose, every, every, every])
    radial, tangential = sections.psi_at(whose).jacobian_factors(places)
    swell = np.zeros((len(changes), 0))
    if swelling is not None:
        swell = swelling(places, rows[whose])[None]
    _, weights, matrix = gauss(STEP_NODES)
    rates = np.ascontiguousarray(changes / sections.rate[:, None])
    numbers = turn_quadratures(
        sections.plane, rates, sections.rate, sections.e, sections.u, sections.room,
        sections.x2, x2, start, ways.ends, ways.first, ways.h, ways.inner, radial, tangential, swell,
        np.where(backward[rows], -1.0, 1.0), weights, matrix,
    )  # fmt: skip
    good = np.flatnonzero(~np.isnan(numbers[:, SHIFT]))
    steps = np.diff(ways.first) // STEP_NODES
    return ReturnMapPoints(rows[good], xi[rows[good]], numbers[good], states[rows[good], :2], steps[good])
