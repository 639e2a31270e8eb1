"""Along which directions of the picture orbits come to equilibria, and leave them: eigenvectors, projected.

At a critical set they are those of J (3.23) in kappa_2, carried to the disc by the differential of
``p = x2/sqrt(1 + |x2|^2)``. At a limit direction Q (Theorem 3.1) there are three: along the equator (lambda_theta), up
the hemisphere (-lambda_rho) and outwards (lambda_rho). On the hemisphere the one that goes up is vertical; what is seen
of it is the projection of its invariant curve ``theta = theta_0 + k w^2``, w = ebar (see `orbits.departures`): as
``|p| = 1 - w^2/2 + ...``, the curve comes in along ``-e + 2 k e_perp``, with

    2 k = Psi(inf) Theta_e/(lambda_theta + 2 lambda_rho),  Theta_e = e_perp.D_e U e,  e_perp = (-sin, cos).

Outside, ``theta = theta_0 + k_out rho`` with ``k_out = Theta_rho/(lambda_rho - lambda_theta)``, which is 0 unless U
reads x or y.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...numerics.trigonometric import INPUT_ROUNDING
from ...results.arrays import Array, join_columns
from .critical import CriticalSet
from .problem import LayerProblem

#: Of the size of J: both eigenvalues are one, and every direction is an eigenvector.
EQUAL_EIGENVALUES = 64 * INPUT_ROUNDING
RESONANCE = 1e-6  # of the eigenvalues: their curves meet in the end, and are tangent to the equator

Where = Literal["disc", "equator", "up", "outside"]


@dataclass(frozen=True, slots=True)
class Eigendirection:
    """A direction along which orbits come in or leave, as it is seen in the picture."""

    # unit vector of the picture. The line through the object runs both ways along it, but for "up" and "outside",
    # which are half-lines
    direction: tuple[float, float]
    # the eigenvalue: of J at a critical set; lambda_theta, -lambda_rho and lambda_rho at a limit direction
    value: float
    where: Where = "disc"  # "disc" of a critical set; "equator", "up" or "outside" of a limit direction


@dataclass(frozen=True, slots=True)
class Linearised:
    """Eigenvectors of the linearisation at one object, as lines of the picture."""

    # none of a complex pair, none where every direction is one, one where both eigenvalues have the same
    directions: tuple[Eigendirection, ...]
    # of a complex pair: 1 if orbits turn anticlockwise, -1 if clockwise; 0 where the eigenvalues are real
    turning: int = 0
    every: bool = False  # whether every direction is an eigenvector


def of_critical_set(C: CriticalSet) -> Linearised:
    """Return the eigendirections of a critical set by falling eigenvalue; none where it is degenerate."""
    if C.kind == "degenerate":
        return Linearised(())
    (j11, j12), (j21, j22) = C.jacobian.tolist()
    if C.eigenvalues[0].imag != 0.0:
        return Linearised((), 1 if j21 > j12 else -1)  # j12 j21 < 0
    size = abs(j11) + abs(j12) + abs(j21) + abs(j22)
    if max(abs(j11 - j22), abs(j12), abs(j21)) <= EQUAL_EIGENVALUES * size:
        return Linearised((), 0, True)
    values = [float(v.real) for v in C.eigenvalues]
    found = []
    for value in values[:1] if values[0] == values[1] else values:
        # the longer row of J - lambda has the eigenvector across it
        u, v = max((j11 - value, j12), (j21, j22 - value), key=lambda row: math.hypot(*row))
        found.append(Eigendirection(to_disc(C.x2, (-v, u)), value))
    return Linearised(tuple(found))


def to_disc(x2: Array, vector: tuple[float, float]) -> tuple[float, float]:
    """Carry a tangent at x2 (2,) of kappa_2 to the disc, ``p = x2/sqrt(1 + |x2|^2)``, with length 1."""
    (x, y), size = x2.tolist(), max(map(abs, vector))
    u, v = vector[0] / size, vector[1] / size  # the square of its length may underflow
    part = (x * u + y * v) / (1.0 + x * x + y * y)
    u, v = u - x * part, v - y * part
    length = math.hypot(u, v)
    return u / length, v / length


def of_limit_directions(problem: LayerProblem) -> tuple[Linearised, ...]:
    """Return the eigendirections of each limit direction, in order of theta.

    Of each "equator", then "up" and "outside". Where lambda_theta = -2 lambda_rho (outside lambda_theta = lambda_rho)
    or an infinite Psi(inf) meets a flow along the equator, orbits come in along the equator alone, and that half-line
    is left out.
    """
    on, at, psi = problem.equator, problem.at, problem.psi
    if not len(on):
        return ()
    e = join_columns(np.cos(on.theta), np.sin(on.theta))
    across = join_columns(-e[:, 1], e[:, 0])
    tilting = np.einsum("ki,kij,kj->k", across, at.DU(e), e)
    tilting[tilting != 0.0] *= psi.limit  # infinite of a Psi that grows for ever (R5)
    lifting = (across * at.U_rho(e)).sum(axis=-1)
    rows = zip(e.tolist(), across.tolist(), on.lambda_rho.tolist(), on.lambda_theta.tolist(), tilting.tolist(),
               lifting.tolist(), strict=True)  # fmt: skip
    found = []
    for (c, s), (u, v), rho, theta, tilt, lift in rows:
        directions = [Eigendirection((u, v), theta, "equator")]
        slope = _slope(tilt, theta + 2.0 * rho, abs(theta) + abs(rho))
        if slope is not None:
            directions.append(Eigendirection(_unit(slope * u - c, slope * v - s), 0.0 - rho, "up"))
        slope = _slope(lift, rho - theta, abs(theta) + abs(rho))
        if slope is not None:
            directions.append(Eigendirection(_unit(slope * u + c, slope * v + s), rho, "outside"))
        found.append(Linearised(tuple(directions)))
    return tuple(found)


def _slope(forcing: float, gap: float, size: float) -> float | None:
    """Return how far a curve leans along the equator; None where it is tangent to it, as at a resonance."""
    if forcing == 0.0:
        return 0.0
    return None if abs(gap) <= RESONANCE * size or not math.isfinite(forcing) else forcing / gap


def _unit(u: float, v: float) -> tuple[float, float]:
    length = math.hypot(u, v)
    return u / length, v / length


def find_eigendirections(problem: LayerProblem) -> tuple[tuple[Linearised, ...], tuple[Linearised, ...]]:
    """Return those of the limit directions, and those of the critical sets, in their orders."""
    return of_limit_directions(problem), tuple(map(of_critical_set, problem.critical))
