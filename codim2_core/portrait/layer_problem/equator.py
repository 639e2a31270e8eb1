"""The equator of the blown-up hemisphere: its equilibria (limit directions), or its closed orbit.

On the equator theta' = Theta (4.9); an equilibrium Q there has the eigenvalues lambda_theta =
dTheta/dtheta along the equator, lambda_rho outwards and -lambda_rho up the hemisphere (Theorem 3.1).

Names of limit directions that follow by continuity while a system changes.

Q1, Q2, ... stand in order of theta, counted from a cut. A direction that passes the cut would change all names; so the
cut is moved away before it, to the middle of the gap between the last direction and the first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...numerics.fourier_zeros import turn as turned_angle
from ...numerics.trigonometric import (
    GENERAL_PATTERNS,
    INPUT_ROUNDING,
    THETA_PATTERNS,
    TrigonometricZeros,
    real_zeros,
    tangential_zeros,
)
from ...numerics.trigonometric_exact import quotient, solve_exactly, to_integers
from ...results.result import Result, column_rows
from ...results.tables import html_table, paragraphs, table_number
from ...results.words import say
from ...systems.coefficients import Affine
from ...systems.frozen import FrozenSystem
from ...systems.kinds import AnySystem, takes_names
from .equator_zeros import equator_zeros
from .linearisation import Location, locate

#: Of the terms of lambda_rho: zero, where det A = 0 leaves no isolated critical set to ask.
SINGULAR_ROUNDING = 8 * INPUT_ROUNDING


@dataclass(frozen=True, eq=False)
class EquatorEquilibria(Result):
    """Equilibria on the equator, Q1, Q2, ... in increasing theta (Theorem 3.1, (2.15)).

    Attributes
    ----------
    theta : ndarray (k,)
        Directions in [0, 2 pi), increasing from 0, or once around from where `counted_from` begins.
    lambda_rho : ndarray (k,)
        Radial eigenvalue; exactly 0 where `radially_degenerate`. Negative: orbits arrive from outside.
    lambda_theta : ndarray (k,)
        Angular eigenvalue; exactly 0 where multiplicity >= 2, alternating in sign between simple ones.
    multiplicity : ndarray of int (k,)
        Multiplicity of the zero of Theta, within the rounding of a, b, d, f1, f2 (of the terms of U in general).
    radially_degenerate : ndarray of bool (k,)
        lambda_rho = 0 within that rounding: the critical set reaches the equator there, |A^-1 f| = 1.
    all_directions : bool
        Theta vanishes identically (a = d, b = 0, f = 0); the arrays are then empty.
    exact_count : int
        Distinct zeros of Theta for the doubles exactly as given (-1: all directions). It differs from k only
        where a multiplicity is 2 or more. For a general system it is k.
    distance : float
        Estimated relative change of the coefficients (of U in general) to the nearest multiple zero; 0.0 on such a
        stratum, inf where there is no such change or no estimate.
    symmetric : bool
        b = 0 and f1 = 0 or f2 = 0: a triple zero is then a pitchfork, otherwise a cusp. For a general system: Theta is
        odd about every triple zero.
    proven : bool
        No equilibrium is missing.
    certificate : str
        The sentence that says why, or why that is not certain.
    arcs : ndarray (j, 2)
        First and last angle of the arcs on which every direction is a limit direction: of a Theta with kinks only, and
        not among the k.
    beyond : tuple of int
        Sign of Theta between each direction and the next, where some multiplicity is odd and none is 1; else empty.
    """

    theta: NDArray[np.float64]
    lambda_rho: NDArray[np.float64]
    lambda_theta: NDArray[np.float64]
    multiplicity: NDArray[np.int64]
    radially_degenerate: NDArray[np.bool_]
    all_directions: bool
    exact_count: int
    distance: float
    symmetric: bool
    proven: bool = True
    certificate: str = say("at most four")
    arcs: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 2)))
    beyond: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        self.arcs.flags.writeable = False  # the others come read-only

    def __len__(self) -> int:
        return len(self.theta)

    def _tables_(self) -> str:
        head = ("limit direction", "θ", "λ_ρ", "λ_θ", "kind")
        values = zip(self.theta.tolist(), self.lambda_rho.tolist(), self.lambda_theta.tolist(), strict=True)
        rows = [(self.labels[i], *map(table_number, row), self.kind(i)) for i, row in enumerate(values)]
        return paragraphs([self.summary]) + html_table(head, rows)

    def _records(self) -> Iterator[dict[str, Any]]:
        columns = {"label": self.labels, "theta": self.theta, "lambda_rho": self.lambda_rho}
        columns |= {"lambda_theta": self.lambda_theta, "multiplicity": self.multiplicity}
        return column_rows(columns | {"kind": [self.kind(i) for i in range(len(self))]})

    @property
    def labels(self) -> tuple[str, ...]:
        """Q1, Q2, ... in order of theta."""
        return tuple(f"Q{i + 1}" for i in range(len(self)))

    def counted_from(self, angle: float) -> EquatorEquilibria:
        """Return the same equilibria with Q1 the first at or after an angle (radians)."""
        if not len(self):
            return self
        order = np.argsort(np.mod(self.theta - angle, 2.0 * math.pi), kind="stable")
        if order[0] == 0:
            return self
        arrays = [values[order] for values in (self.theta, self.lambda_rho, self.lambda_theta)]
        arrays += [self.multiplicity[order], self.radially_degenerate[order]]
        for array in arrays:
            array.flags.writeable = False
        names = ("theta", "lambda_rho", "lambda_theta", "multiplicity", "radially_degenerate")
        beyond = tuple(self.beyond[i] for i in order.tolist()) if self.beyond else ()
        return replace(self, **dict(zip(names, arrays, strict=True)), beyond=beyond)

    @property
    def exact(self) -> bool:
        """Whether their number is decided in closed form, for the doubles as they are given: of an e-linear system."""
        decided = self.certificate == say("at most four") and not self.all_directions
        return decided and self.exact_count == len(self) and bool((self.multiplicity == 1).all())

    def kind(self, i: int) -> str:
        """Describe the type of equilibrium i (from 0), such as "radially attracting, angularly repelling"."""
        if self.radially_degenerate[i]:
            radial = "radially non-hyperbolic"
        else:
            radial = "radially attracting" if self.lambda_rho[i] < 0 else "radially repelling"
        return f"{radial}, {self._angular(i)}"

    def _angular(self, i: int) -> str:
        m = int(self.multiplicity[i])
        if m == 1:
            return "angularly attracting" if self.lambda_theta[i] < 0 else "angularly repelling"
        if m == 2:
            return "angularly non-hyperbolic: saddle-node"
        if m == 4:
            return "angularly non-hyperbolic: fourfold zero"
        if m > 4:
            return f"angularly non-hyperbolic: zero of multiplicity {m}"
        name = "pitchfork" if self.symmetric else "cusp"
        return f"angularly non-hyperbolic: triple zero ({name}){self._weakly(i)}"

    def _weakly(self, i: int) -> str:
        """Theta rises and falls in turn through its odd zeros: the next simple one shows how it passes zero i."""
        if self.beyond:
            return ", weakly " + ("repelling" if self.beyond[i] > 0 else "attracting")
        rises = True
        for j in (*range(i + 1, len(self)), *range(i)):
            rises = rises != bool(self.multiplicity[j] % 2)
            if self.multiplicity[j] == 1:
                return ", weakly " + ("repelling" if rises == bool(self.lambda_theta[j] > 0.0) else "attracting")
        return ""

    @cached_property
    def turns(self) -> int | None:
        """Return the index of U along the equator, read from lambda_rho and Theta: the sum of the indices within.

        Seen from the turning frame U is (lambda_rho, Theta): it crosses the radial axis where Theta changes sign. None
        where U vanishes on the equator, or every direction is a limit direction.
        """
        if self.all_directions or len(self.arcs) or self.radially_degenerate.any():
            return None
        odd = self.multiplicity % 2 == 1
        slopes, rates = np.sign(self.lambda_theta[odd]), np.sign(self.lambda_rho[odd])
        if (slopes == 0.0).any():  # a triple zero: crossings alternate
            slopes = np.where(slopes == 0.0, -slopes.sum(), slopes)
        return round(1 + 0.5 * float((slopes * rates).sum()))

    def sentence(self, i: int) -> str:
        """One sentence for people on equilibrium i (from 0)."""
        return say("Q at", Q=f"Q{i + 1}", theta=float(self.theta[i]), kind=self.kind(i))

    @cached_property
    def summary(self) -> str:
        """One sentence for people on the whole equator."""
        if self.all_directions:
            return say("every direction of the equator")
        if len(self.arcs):
            return " ".join(arcs_of(self.arcs))
        if not len(self):
            return say("no equilibria" if self.proven else "no equilibria found")
        noun = "equilibrium" if len(self) == 1 else "equilibria"
        multiple = int((self.multiplicity > 1).sum())
        key = "equilibria, some degenerate" if multiple else "equilibria"
        summary = say(key, count=len(self), noun=noun, some=multiple)
        return summary if self.proven else f"{summary} {say('no more proved')}"


def arcs_of(arcs: NDArray[np.float64]) -> list[str]:
    """Say of each arc that every direction on it is a limit direction."""
    return [say("arc of directions", first=float(first), last=float(last)) for first, last in arcs]


@takes_names
def equator_equilibria(system: AnySystem, z: ArrayLike = ()) -> EquatorEquilibria:
    """Equilibria on the equator at z (4.9), with multiplicity; of an e-linear system at most 4.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    z : (m,) floats
        Slow variables; may be left out if no coefficient uses them.

    Returns
    -------
    EquatorEquilibria

    Raises
    ------
    ValueError
        If z does not fit the system or a coefficient is not finite.

    Examples
    --------
    Without f they are the eigendirections of A, both ways:

    >>> from codim2_core import ELinear, equator_equilibria
    >>> found = equator_equilibria(ELinear(-2, 0, -1))
    >>> found.theta.round(6).tolist(), found.lambda_rho.tolist()
    ([0.0, 1.570796, 3.141593, 4.712389], [-2.0, -1.0, -2.0, -1.0])
    """
    at = system.at(z)
    return equilibria_at(at, None if at.affine is None else locate(at))


def equilibria_at(at: FrozenSystem, location: Location | None) -> EquatorEquilibria:
    """Equilibria on the equator of a frozen system; `location` is that of `locate`, None if U is not e-linear."""
    if at.affine is None or location is None:
        return _general(at)
    q = at.as_given
    if q is None or q.given is not None:
        return _of_matrix(at.affine, at.turn, location)
    a, b, d, f1, f2 = q.a, q.b, q.d, q.f1, q.f2
    zeros = tangential_zeros(a, b, d, f1, f2)

    def radial(theta: float) -> float:
        c, s = math.cos(theta), math.sin(theta)
        value = a * c * c + d * s * s + f1 * c + f2 * s
        return _radial_exactly(a, b, d, f1, f2, theta) if abs(value) <= 1e-3 * size else value

    size = abs(a) + abs(d) + abs(f1) + abs(f2)
    return _collect_equilibria(zeros, radial, size, location, b == 0.0 and (f1 == 0.0 or f2 == 0.0))


def _harmonics(affine: Affine) -> tuple[float, float, float, float, float]:
    """Theta as a trigonometric polynomial: its mean, and the coefficients of cos, sin, cos 2 and sin 2."""
    a11, a12, a21, a22, f1, f2 = affine
    return 0.5 * a21 - 0.5 * a12, f2, -f1, 0.5 * a21 + 0.5 * a12, 0.5 * a22 - 0.5 * a11


def _of_matrix(affine: Affine, turn: float, location: Location) -> EquatorEquilibria:
    """Equilibria for any matrix, decided in the axes in which it is given, then turned by an angle."""
    a11, a12, a21, a22, f1, f2 = affine
    harmonics = _harmonics(affine)

    def radial(theta: float) -> float:
        c, s = math.cos(theta - turn), math.sin(theta - turn)
        value = a11 * c * c + (a12 + a21) * c * s + a22 * s * s + f1 * c + f2 * s
        return _radial_of_matrix(affine, harmonics, theta - turn) if abs(value) <= 1e-3 * size else value

    size = abs(a11) + abs(a12 + a21) + abs(a22) + abs(f1) + abs(f2)
    zeros = real_zeros(*harmonics)
    angles = [turned_angle(theta + turn) for theta in zeros.theta]
    order = sorted(range(len(angles)), key=angles.__getitem__)
    zeros = zeros._replace(
        theta=tuple(angles[i] for i in order),
        slope=tuple(zeros.slope[i] for i in order),
        multiplicity=tuple(zeros.multiplicity[i] for i in order),
    )
    F11, F12, F21, F22, G1, G2 = map(Fraction, affine)
    shear = (F12 + F21) / 2
    along_axis = G1 * (shear * G1 + F22 * G2) == G2 * (F11 * G1 + shear * G2)  # f is an eigenvector
    return _collect_equilibria(zeros, radial, size, location, a12 == a21 and along_axis)


def _collect_equilibria(
    zeros: TrigonometricZeros, radial: Callable[[float], float], size: float, location: Location, symmetric: bool
) -> EquatorEquilibria:
    """Put the equilibria together: zeros of Theta, lambda_rho there, and where it vanishes within rounding."""
    reached, nearest = location.direction, None
    if reached is not None and zeros.theta:
        nearest = min(zeros.theta, key=lambda t: abs(math.remainder(t - reached, 2.0 * math.pi)))
    rho: list[float] = []
    flat: list[bool] = []
    for theta in zeros.theta:
        value = radial(theta)
        degenerate = False
        if abs(value) <= 1e-3 * size:
            if reached is not None:  # U(e) = 0 on the equator, within rounding: at the nearest zero of Theta
                degenerate = theta == nearest
            elif location.singular:
                degenerate = abs(value) <= SINGULAR_ROUNDING * size
        rho.append(0.0 if degenerate else value)
        flat.append(degenerate)
    arrays = (
        np.array(zeros.theta, float),
        np.array(rho, float),
        np.array(zeros.slope, float),
        np.array(zeros.multiplicity, np.int64),
        np.array(flat, bool),
    )
    for array in arrays:
        array.flags.writeable = False
    return EquatorEquilibria(*arrays, zeros.identically_zero, zeros.exact_count, zeros.distance, symmetric)


def _general(at: FrozenSystem) -> EquatorEquilibria:
    found = equator_zeros(at.key)
    return EquatorEquilibria(
        found.theta,
        found.lambda_rho,
        found.lambda_theta,
        found.multiplicity,
        found.radially_degenerate,
        found.all_directions,
        -1 if found.all_directions else len(found.theta),
        found.distance,
        found.symmetric,
        found.proven,
        found.certificate,
        found.arcs,
        found.beyond,
    )


def _radial_exactly(a: float, b: float, d: float, f1: float, f2: float, theta: float) -> float:
    """lambda_rho at the zero of Theta that theta is the rounding of, to full relative accuracy."""
    found = solve_exactly((b, f2, f1, a, d), THETA_PATTERNS).zeros
    if not found:
        return a
    x, y, n = min(found, key=lambda q: abs(math.remainder(q.theta - theta, 2.0 * math.pi)))[:3]
    (ia, id_, i1, i2), exponent = to_integers((a, d, f1, f2))
    value = ia * x * x + id_ * y * y + (i1 * x + i2 * y) * n
    return quotient(value, n * n, exponent)


def _radial_of_matrix(affine: Affine, harmonics: tuple[float, ...], theta: float) -> float:
    """Return the sign of lambda_rho as `_radial_exactly` does, for any matrix."""
    found = solve_exactly(harmonics, GENERAL_PATTERNS).zeros
    (m11, m12, m21, m22, i1, i2), exponent = to_integers(affine)
    if not found:
        return affine[0]
    x, y, n = min(found, key=lambda q: abs(math.remainder(q.theta - theta, 2.0 * math.pi)))[:3]
    value = m11 * x * x + (m12 + m21) * x * y + m22 * y * y + (i1 * x + i2 * y) * n
    return quotient(value, n * n, exponent)


def cut_that_keeps_names(before: EquatorEquilibria, after: EquatorEquilibria, cut: float = 0.0) -> float:
    """Return the angle from which limit directions are counted after a change, so that each keeps its name."""
    if not len(before) or not len(after):
        return cut
    theta = np.sort(after.theta)
    first = _first_index(before.theta, theta)
    for kept in (0.0, cut):
        if int(np.argmin(np.mod(theta - kept, math.tau))) == first:
            return kept
    gap = float(np.mod(theta[first] - theta[first - 1], math.tau)) or math.tau
    middle = float(np.mod(theta[first] - 0.5 * gap, math.tau))
    return round(middle, 2) if gap > 0.1 else middle  # short in a link


def _first_index(before: NDArray[np.float64], theta: NDArray[np.float64]) -> int:
    """Index in `theta`, increasing from 0, of the direction that is the first one before."""
    if len(before) != len(theta):
        return int(np.argmin(np.abs(_wrap_angle(theta - before[0]))))
    one = np.arange(len(theta))
    turned = theta[(one[:, None] + one) % len(theta)]  # row k begins with direction k
    return int((_wrap_angle(turned - before) ** 2).sum(axis=1).argmin())


def _wrap_angle(angle: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles in [-pi, pi)."""
    return np.mod(angle + math.pi, math.tau) - math.pi
