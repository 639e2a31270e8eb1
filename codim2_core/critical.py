"""Critical sets of the e-linear system: the equilibria of the layer problem, thm:lineps1.

``A e + f = 0`` has the solution ``e = -A^-1 f = -n/det A`` with ``n = adj(A) f``, and a critical set exists iff
``|n| < |det A|``. That form never divides by det A. Signs that rounding could blur are decided in exact rational
arithmetic of the given doubles; within the rounding of the inputs the border itself is the (named) answer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .regularisation import Psi
from .systems import Coefficients, ELinear
from .trigonometric import ROUNDING

# Below this fraction of its terms a sum of products is recomputed exactly (double rounding stays below 1e-15).
CANCELLATION = 1e-9


class Existence(Enum):
    """How many critical sets there are, and why; the value is the sentence shown."""

    INSIDE = "One critical set: |A⁻¹f| < 1 (thm:lineps1)."
    NONE = "No critical set: |A⁻¹f| > 1 (thm:lineps1)."
    EQUATOR = "|A⁻¹f| = 1 within rounding: the critical set lies on the equator (transcritical, fig:transcrit)."
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
        "stable node", "stable focus", "unstable node", "unstable focus", "saddle", or "centre (linear)".
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


def _scaled(values: tuple[float, ...]) -> tuple[float, ...]:
    """Values times one power of two that brings the largest near 1: exact, and no product over- or underflows."""
    size = max(map(abs, values))
    if size == 0.0:
        return values
    shift = -math.frexp(size)[1]
    return tuple(math.ldexp(v, shift) for v in values)


def determinant_sign(a: float, b: float, d: float) -> int:
    """Sign of ``det A = a d + b^2``, 0 when it vanishes within the rounding of a, b, d."""
    a, b, d = _scaled((a, b, d))
    size = abs(a * d) + b * b
    det = a * d + b * b
    if size == 0.0:
        return 0
    if abs(det) < CANCELLATION * size or size < 1e-280:
        exact = Fraction(a) * Fraction(d) + Fraction(b) ** 2
        weight = abs(Fraction(a) * Fraction(d)) + Fraction(b) ** 2
        if abs(exact) <= 2 * Fraction(ROUNDING) * weight:
            return 0
        return 1 if exact > 0 else -1
    return 1 if det > 0 else -1


def locate(coefficients: Coefficients) -> Location:
    """Decide whether, and where, ``A e + f = 0`` in the disc |e| < 1 (thm:lineps1(a)), without dividing by det A."""
    a, b, d, f1, f2 = _scaled(coefficients.plane)
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
    if abs(gap) <= 2 * Fraction(ROUNDING) * change:
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
    # The larger row r of A gives the line r.e = -f_r; its distance from the origin is |f_r|/|r|.
    (r1, r2), f = ((a, -b), f1) if math.hypot(a, b) >= math.hypot(b, d) else ((b, d), f2)
    length = math.hypot(r1, r2)
    u1, u2, k = r1 / length, r2 / length, -f / length
    if abs(k) >= 1.0:
        return Location(Existence.SINGULAR_OUTSIDE)
    half = math.sqrt((1.0 - k) * (1.0 + k))
    return Location(
        Existence.SINGULAR_LINE,
        line=((k * u1 + half * u2, k * u2 - half * u1), (k * u1 - half * u2, k * u2 + half * u1)),
    )


def linearisation(
    coefficients: Coefficients, psi: Psi, e: tuple[float, float], complement: float
) -> tuple[tuple[float, float], tuple[float, float], tuple[float, float, float, float]]:
    """Place and Jacobian of the critical set with ``e_Psi = e``.

    Returns
    -------
    x2, p : (float, float)
    J : (J11, J12, J21, J22)
        eq:scjaco, ``A . D e_Psi``; D e_Psi has eigenvalue `radial` along e and `tangential` across it.
    """
    modulus = math.hypot(*e)
    zeta = float(psi.radius(modulus, complement)) if modulus > 0.0 else 0.0
    radial, tangential = psi.jacobian_factors(zeta)
    c, s = (e[0] / modulus, e[1] / modulus) if modulus > 0.0 else (1.0, 0.0)
    spread = radial - tangential
    D11, D12, D22 = tangential + spread * c * c, spread * c * s, tangential + spread * s * s
    a, b, d = coefficients.a, coefficients.b, coefficients.d
    r = zeta / math.hypot(1.0, zeta)
    jacobian = (a * D11 - b * D12, a * D12 - b * D22, b * D11 + d * D12, b * D12 + d * D22)
    return (zeta * c, zeta * s), (r * c, r * s), tuple(map(float, jacobian))  # type: ignore[return-value]


def spectrum(jacobian: tuple[float, float, float, float]) -> tuple[float, float, float, str, tuple[complex, complex]]:
    """Trace, determinant, discriminant, kind and eigenvalues of a 2x2 matrix (rows first).

    The trace counts as zero, and the kind as "centre (linear)", when it is below the rounding of its two terms.
    """
    j11, j12, j21, j22 = jacobian
    trace, determinant = j11 + j22, j11 * j22 - j12 * j21
    half, difference = 0.5 * trace, 0.5 * (j11 - j22)
    quarter = difference * difference + j12 * j21  # discriminant / 4, without the cancellation in tr^2 - 4 det
    neutral = abs(trace) <= 16 * 2.0**-53 * (abs(j11) + abs(j22))
    if quarter >= 0.0:
        root = math.sqrt(quarter)
        large = half + math.copysign(root, half)
        small = determinant / large if large != 0.0 else 0.0
        pair = (complex(max(large, small)), complex(min(large, small)))
    else:
        root = math.sqrt(-quarter)
        pair = (complex(half, root), complex(half, -root))
    if determinant < 0.0:
        kind = "saddle"
    elif neutral:
        kind = "centre (linear)"
    else:
        kind = ("stable " if trace < 0.0 else "unstable ") + ("node" if quarter >= 0.0 else "focus")
    return trace, determinant, 4.0 * quarter, kind, pair


def critical_sets(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> tuple[CriticalSet, ...]:
    """All isolated critical sets at z: for the e-linear system none or one (thm:lineps1(a), eq:lincriticalset).

    Parameters
    ----------
    system : ELinear, or Coefficients
    psi : Psi
    z : (m,) floats

    Returns
    -------
    tuple of CriticalSet
        Empty also when |A^-1 f| = 1 or det A = 0 within the rounding of the coefficients; `classify` names these.
    """
    coefficients = system.at(z)
    location = locate(coefficients)
    if location.e is None:
        return ()
    x2, p, jacobian = linearisation(coefficients, psi, location.e, location.complement)
    trace, determinant, discriminant, kind, eigenvalues = spectrum(jacobian)
    arrays = [
        np.array(location.e),
        np.array(x2),
        np.array(p),
        np.array(jacobian).reshape(2, 2),
        np.array(eigenvalues),
        coefficients.W(location.e),
    ]
    for array in arrays:
        array.flags.writeable = False
    e, x2_, p_, J, values, slow = arrays
    return (CriticalSet(e, x2_, p_, J, trace, determinant, discriminant, values, kind, slow),)
