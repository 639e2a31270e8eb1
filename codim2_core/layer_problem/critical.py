"""Critical sets: the equilibria of the layer problem, thm:lineps1 for the e-linear system.

``A e + f = 0`` has the solution ``e = -A^-1 f = -n/det A`` with ``n = adj(A) f``, and a critical set exists iff
``|n| < |det A|``. That form never divides by det A. Signs that rounding could blur are decided in exact rational
arithmetic of the given doubles; within the rounding of the inputs the border itself is the (named) answer.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..expressions.arrays import AROUND, BESIDE
from ..expressions.kinks import kinks
from ..expressions.names import PLANE
from ..numerics.trigonometric import ROUNDING
from ..psi.function import Psi
from ..systems.coefficients import Affine
from ..systems.frozen import AtZ
from ..systems.kinds import AnySystem
from ..tables import number, point, table
from .border import CANCELS, to_all_digits
from .disc_zeros import disc_zeros
from .linearisation import (
    CANCELLATION,
    NEUTRAL_TRACE,
    Parts,
    determinant_sign,
    linearisation,
    linearisation_of,
    matrix_determinant,
    scaled,
    spectrum,
)

__all__ = ["NEUTRAL_TRACE", "CriticalSet", "Existence", "Location", "critical_sets", "determinant_sign", "locate"]


class Existence(Enum):
    """How many critical sets there are, and why; the value is the sentence shown."""

    INSIDE = "One critical set: |A⁻¹f| < 1 (Theorem 4.1)."
    NONE = "No critical set: |A⁻¹f| > 1 (Theorem 4.1)."
    EQUATOR = "|A⁻¹f| = 1 within rounding: the critical set lies on the equator (transcritical, Figure 19)."
    SINGULAR_NONE = "det A = 0 within rounding, and f is not in the range of A: no critical set."
    SINGULAR_LINE = "det A = 0 within rounding, and f is in the range of A: a whole line A e = −f of critical points."
    SINGULAR_OUTSIDE = "det A = 0 within rounding; the line A e = −f misses the hemisphere: no critical set."
    EVERYTHING = "A = 0 and f = 0: every point of the hemisphere is an equilibrium of the layer problem."


@dataclass(frozen=True, slots=True)
class Location:
    """Where ``A e = -f`` holds.

    Attributes
    ----------
    existence : Existence
    e : (c, s), or None
        The solution, when it lies in the open disc.
    complement : float
        ``1 - |e|^2`` to full relative accuracy.
    direction : float, or None
        The angle of the solution when it lies on |e| = 1 within rounding.
    line : ((c, s), (c, s)), or None
        Ends on |e| = 1 of the line of solutions when det A = 0.
    """

    existence: Existence
    e: tuple[float, float] | None = None
    complement: float = 1.0
    direction: float | None = None
    line: tuple[tuple[float, float], tuple[float, float]] | None = None

    @property
    def singular(self) -> bool:
        """Whether det A = 0 within the rounding of a, b, d."""
        return self.existence not in (Existence.INSIDE, Existence.NONE, Existence.EQUATOR)


@dataclass(frozen=True, slots=True)
class CriticalSet:
    """A critical set C of the layer problem, eq:critical_set, with its linearisation eq:scjaco.

    Attributes
    ----------
    e : ndarray (2,)
        (c, s) with U((c, s), 0, 0, z) = 0; independent of Psi.
    x2 : ndarray (2,)
        Its place in the scaling chart kappa_2.
    p : ndarray (2,)
        Its place in the projected disc.
    jacobian : ndarray (2, 2)
        ``J = D_e U . D e_Psi`` in (x2, y2) and the fast time tau.
    trace, determinant, discriminant : float
        Of J; the discriminant is trace^2 - 4 determinant.
    eigenvalues : ndarray (2,), complex
        By falling real part.
    kind : str
        "stable node", "stable focus", "unstable node", "unstable focus", "saddle", or "centre (linear)"; in general
        systems also "saddle-node" (det J = 0: two critical sets have just met) and "degenerate" (more than two).
    slow_flow : ndarray (m,)
        z' on it, eq:linslowflow; independent of Psi.
    """

    e: NDArray[np.float64]
    x2: NDArray[np.float64]
    p: NDArray[np.float64]
    jacobian: NDArray[np.float64]
    trace: float
    determinant: float
    discriminant: float
    eigenvalues: NDArray[np.complex128]
    kind: str
    slow_flow: NDArray[np.float64]

    def _repr_html_(self) -> str:
        return shown([self])


def shown(sets: Sequence[CriticalSet]) -> str:
    """Return critical sets as an HTML table."""
    head = ("critical set", "e", "kind", "tr J", "det J", "slow flow z′")
    names = ["C"] if len(sets) == 1 else [f"C{i + 1}" for i in range(len(sets))]
    rows = [
        (
            name,
            point(C.e),
            C.kind,
            number(C.trace),
            number(C.determinant),
            point(C.slow_flow) if len(C.slow_flow) else "–",
        )
        for name, C in zip(names, sets, strict=True)
    ]
    return table(head, rows)


def locate(at: AtZ) -> Location:
    """Decide whether, and where, ``A e + f = 0`` in the disc |e| < 1 (thm:lineps1(a)), without dividing by det A.

    Parameters
    ----------
    at : Coefficients or Frozen
        E-linear. What was brought into the normal form by a rotation is decided before it, where nothing is rounded.

    Returns
    -------
    Location
        In the axes of `at`.
    """
    coefficients = at.as_given
    if coefficients is None or coefficients.given is not None:
        if at.affine is None:
            raise ValueError("U is not e-linear; give a system whose U is affine in (c, s).")
        return turned(locate_affine(at.affine), at.turn)
    a, b, d, f1, f2 = scaled(coefficients.plane)
    if determinant_sign(a, b, d) == 0:
        return _locate_singular(a, b, d, f1, f2)
    det = a * d + b * b
    n1, n2 = d * f1 + b * f2, a * f2 - b * f1
    w0 = abs(a * d) + b * b
    w1, w2 = abs(d * f1) + abs(b * f2), abs(a * f2) + abs(b * f1)
    gap, size = det * det - n1 * n1 - n2 * n2, det * det + n1 * n1 + n2 * n2
    blurred = (
        abs(gap) < CANCELLATION * size
        or abs(det) < CANCELLATION * w0
        or (0.0 < abs(n1) < CANCELLATION * w1)
        or (0.0 < abs(n2) < CANCELLATION * w2)
        or size < 1e-280
    )
    if blurred:
        return _locate_exactly(a, b, d, f1, f2)
    if gap < 0.0:
        return Location(Existence.NONE)
    if gap < CANCELS * size:
        gap, det, n1, n2 = to_all_digits(a, -b, b, d, f1, f2)
    return Location(Existence.INSIDE, (-n1 / det + 0.0, -n2 / det + 0.0), gap / (det * det))


def _locate_exactly(a: float, b: float, d: float, f1: float, f2: float) -> Location:
    A, B, D, F1, F2 = map(Fraction, (a, b, d, f1, f2))
    det, n1, n2 = A * D + B * B, D * F1 + B * F2, A * F2 - B * F1
    gap = det * det - n1 * n1 - n2 * n2
    # Half the first-order change of the gap when each coefficient is off by a relative 1.
    change = (
        abs(n2 * A * F2 - det * A * D)
        + abs(n1 * B * F2 - n2 * B * F1 - 2 * det * B * B)
        + abs(n1 * D * F1 - det * A * D)
        + abs(n1 * D * F1 - n2 * B * F1)
        + abs(n1 * B * F2 + n2 * A * F2)
    )
    off = 2 * Fraction(ROUNDING)
    # Near det A = 0 first order is not enough: |adj(A) f| and |det A| must be able to meet.
    parts = ((n1, abs(D * F1) + abs(B * F2)), (n2, abs(A * F2) + abs(B * F1)))
    least = sum(max(abs(n) - off * size, 0) ** 2 for n, size in parts)
    if abs(gap) <= off * change and least <= (abs(det) + off * (abs(A * D) + B * B)) ** 2:
        return Location(Existence.EQUATOR, direction=math.atan2(-n2 / det, -n1 / det))
    if gap < 0:
        return Location(Existence.NONE)
    return Location(Existence.INSIDE, (float(-n1 / det), float(-n2 / det)), float(gap / det**2))


def _locate_singular(a: float, b: float, d: float, f1: float, f2: float) -> Location:
    if a == b == d == 0.0:
        return Location(Existence.EVERYTHING if f1 == f2 == 0.0 else Existence.SINGULAR_NONE)
    A, B, D, F1, F2 = map(Fraction, (a, b, d, f1, f2))
    n1, n2 = D * F1 + B * F2, A * F2 - B * F1
    rounding = 2 * Fraction(ROUNDING)
    solvable = abs(n1) <= rounding * (abs(D * F1) + abs(B * F2)) and abs(n2) <= rounding * (abs(A * F2) + abs(B * F1))
    if not solvable:
        return Location(Existence.SINGULAR_NONE)
    return _line((A, -B, B, D, F1, F2))


def locate_affine(affine: Affine) -> Location:
    """Decide as `locate` for any matrix, ``affine = (A11, A12, A21, A22, f1, f2)``, exactly."""
    M = tuple(map(Fraction, scaled(affine)))
    m11, m12, m21, m22, f1, f2 = M
    det, n1, n2 = m11 * m22 - m12 * m21, m22 * f1 - m12 * f2, m11 * f2 - m21 * f1
    off = 2 * Fraction(ROUNDING)
    w0 = abs(m11 * m22) + abs(m12 * m21)
    w1, w2 = abs(m22 * f1) + abs(m12 * f2), abs(m11 * f2) + abs(m21 * f1)
    if not any(M):
        return Location(Existence.EVERYTHING)
    if abs(det) <= off * w0:
        solvable = any(M[:4]) and abs(n1) <= off * w1 and abs(n2) <= off * w2
        return _line(M) if solvable else Location(Existence.SINGULAR_NONE)
    gap = det * det - n1 * n1 - n2 * n2
    # Half the first-order change of the gap when each entry is off by a relative 1.
    change = (
        abs(det * m11 * m22 - n2 * m11 * f2)
        + abs(n1 * m12 * f2 - det * m12 * m21)
        + abs(n2 * m21 * f1 - det * m12 * m21)
        + abs(det * m11 * m22 - n1 * m22 * f1)
        + abs(n2 * m21 * f1 - n1 * m22 * f1)
        + abs(n1 * m12 * f2 - n2 * m11 * f2)
    )
    # Near det A = 0 first order is not enough: |adj(A) f| and |det A| must be able to meet.
    least = sum(max(abs(n) - off * w, 0) ** 2 for n, w in ((n1, w1), (n2, w2)))
    if abs(gap) <= off * change and least <= (abs(det) + off * w0) ** 2:
        return Location(Existence.EQUATOR, direction=math.atan2(-n2 / det, -n1 / det))
    if gap < 0:
        return Location(Existence.NONE)
    return Location(Existence.INSIDE, (float(-n1 / det), float(-n2 / det)), float(gap / det**2))


def _line(M: tuple[Fraction, ...]) -> Location:
    """Line of solutions of a singular matrix: of its larger row."""
    m11, m12, m21, m22, f1, f2 = map(float, M)
    r1, r2, f = (m11, m12, f1) if math.hypot(m11, m12) >= math.hypot(m21, m22) else (m21, m22, f2)
    length = math.hypot(r1, r2)
    u1, u2, k = r1 / length, r2 / length, -f / length
    if abs(k) >= 1.0:
        return Location(Existence.SINGULAR_OUTSIDE)
    half = math.sqrt((1.0 - k) * (1.0 + k))
    return Location(
        Existence.SINGULAR_LINE,
        line=((k * u1 + half * u2, k * u2 - half * u1), (k * u1 - half * u2, k * u2 + half * u1)),
    )


def turned(location: Location, angle: float) -> Location:
    """Rotate a location by an angle."""
    if angle == 0.0:
        return location
    c, s = math.cos(angle), math.sin(angle)

    def turn(e: tuple[float, float]) -> tuple[float, float]:
        return c * e[0] - s * e[1], s * e[0] + c * e[1]

    return replace(
        location,
        e=None if location.e is None else turn(location.e),
        direction=None if location.direction is None else location.direction + angle,
        line=None if location.line is None else (turn(location.line[0]), turn(location.line[1])),
    )


def critical_sets(system: AnySystem, psi: Psi, z: ArrayLike = ()) -> tuple[CriticalSet, ...]:
    """All isolated critical sets at z, eq:critical_set.

    For an e-linear system none or one (thm:lineps1(a), eq:lincriticalset), in closed form. For a general system all
    zeros of U in the open disc, by increasing c, then s, from a search that proves them complete (`disc_zeros`).

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats

    Returns
    -------
    tuple of CriticalSet
        Without zeros on |e| = 1, and empty when det A = 0, within the rounding of the coefficients; `classify` names
        these.
    """
    at = system.at(z)
    return sets_at(at, psi, None if at.affine is None else locate(at))


def sets_at(at: AtZ, psi: Psi, location: Location | None) -> tuple[CriticalSet, ...]:
    """All isolated critical sets of a frozen system; `location` is that of `locate`, None if U is not e-linear."""
    if at.affine is None or location is None:
        return _general_sets(at, psi)
    if location.e is None:
        return ()
    form, sign = at.as_given, matrix_determinant(*at.affine[:4])[1]
    if form is None or form.given is not None:  # by the matrix as given, whatever the rotation has rounded
        shift = math.frexp(max(map(abs, at.affine[:4])))[1]
        m11, m12, m21, m22 = (math.ldexp(v, -shift) for v in at.affine[:4])
        e = turned(location, -at.turn).e or location.e
        parts = linearisation_of((m11, m12, m21, m22), psi, e, location.complement, sign)
        return (_critical_set(location.e, _turned_parts(parts, at.turn), shift, at.W(location.e)),)
    # Time in a unit that makes the largest coefficient about 1, so that no product under- or overflows.
    shift = math.frexp(max(map(abs, form.plane[:3])))[1]
    a, b, d = (math.ldexp(v, -shift) for v in form.plane[:3])
    parts = linearisation((a, b, d), psi, location.e, location.complement, sign)
    return (_critical_set(location.e, parts, shift, at.W(location.e)),)


def _turned_parts(parts: Parts, angle: float) -> Parts:
    """Rotate the place and the Jacobian by an angle; what they decide stays."""
    if angle == 0.0:
        return parts
    x2, p, (j11, j12, j21, j22), frame = parts
    c, s = math.cos(angle), math.sin(angle)
    R = np.array([[c, -s], [s, c]])
    (k11, k12), (k21, k22) = (R @ np.array([[j11, j12], [j21, j22]]) @ R.T).tolist()
    x, y = R @ x2
    px, py = R @ p
    return (float(x), float(y)), (float(px), float(py)), (k11, k12, k21, k22), frame


def _general_sets(at: AtZ, psi: Psi) -> tuple[CriticalSet, ...]:
    found = disc_zeros(at.key)
    sets = []
    counted = found.degree is not None and found.degenerate.sum() == 1  # then the degree gives it its index
    columns = (found.e, found.DU, found.degenerate, found.rough, found.index)
    for e, DU, degenerate, rough, index in zip(*columns, strict=True):
        c, s = float(e[0]), float(e[1])
        modulus = math.hypot(c, s)
        m11, m12, m21, m22 = DU.ravel().tolist()
        shift = math.frexp(max(abs(m11), abs(m12), abs(m21), abs(m22), 1e-290))[1]
        M = (math.ldexp(m11, -shift), math.ldexp(m12, -shift), math.ldexp(m21, -shift), math.ldexp(m22, -shift))
        parts = linearisation_of(M, psi, (c, s), (1.0 - modulus) * (1.0 + modulus), int(index))
        C = _critical_set((c, s), parts, shift, at.W((c, s)))
        if degenerate and (not rough or (counted and index == 0)):
            # index 0: a saddle and a node have just met; +1 or -1: three critical sets have
            C = replace(C, determinant=0.0, kind="saddle-node" if index == 0 else "degenerate")
        elif rough or not _sides_agree(at, psi, C):
            C = replace(C, kind="degenerate")
        sets.append(C)
    return tuple(sets)


def _sides_agree(at: AtZ, psi: Psi, C: CriticalSet) -> bool:
    """Whether C attracts, repels or is a saddle by the linearisation on every side of a kink that it may lie on."""
    system = at.typed
    if system is None or not kinks(system.U, PLANE):
        return True
    sides = at.DU(C.e + BESIDE * AROUND)
    middle = at.DU(C.e)
    if abs(sides - middle).max() <= 1e-3 * abs(middle).max():
        return True
    c, s = C.e.tolist()
    complement = (1.0 - math.hypot(c, s)) * (1.0 + math.hypot(c, s))
    for side in sides:
        index = int(np.sign(side[0, 0] * side[1, 1] - side[0, 1] * side[1, 0]))
        kind = spectrum(linearisation_of(_rows(side), psi, (c, s), complement, index)[3])[3]
        if kind.split()[0] != C.kind.split()[0]:
            return False
    return True


def _rows(M: NDArray[np.float64]) -> tuple[float, float, float, float]:
    (m11, m12), (m21, m22) = M.tolist()
    return m11, m12, m21, m22


def _critical_set(e: tuple[float, float], parts: Parts, shift: int, slow: NDArray[np.float64]) -> CriticalSet:
    """Put the parts together; the linearisation is in a unit of time that is 2^-shift of the system's."""
    x2, p, jacobian, frame = parts
    trace, determinant, discriminant, kind, eigenvalues = spectrum(frame)
    trace = math.ldexp(trace, shift)
    determinant, discriminant = math.ldexp(determinant, 2 * shift), math.ldexp(discriminant, 2 * shift)
    arrays = [
        np.array(e),
        np.array(x2),
        np.array(p),
        np.ldexp(np.array(jacobian).reshape(2, 2), shift),
        np.array([complex(math.ldexp(v.real, shift), math.ldexp(v.imag, shift)) for v in eigenvalues]),
        np.array(slow),
    ]
    for array in arrays:
        array.flags.writeable = False
    e_, x2_, p_, J, values, slow_ = arrays
    return CriticalSet(e_, x2_, p_, J, trace, determinant, discriminant, values, kind, slow_)
