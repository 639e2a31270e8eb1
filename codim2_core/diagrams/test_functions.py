"""Quantities that decide the portrait of the e-linear system, for many parameter values at once.

Signs of five smooth functions do it: the discriminant of Theta and the sign of a resolvent (how many equilibria there
are on the equator), ``det(A)^2 - |adj(A) f|^2`` (whether there is a critical set, thm:lineps1(a)), det A, tr J and the
discriminant of J (its kind). They are plain NumPy; `classify` is the exact answer for one system.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..layer_problem.border import CANCELS, to_all_digits
from ..layer_problem.location import locate
from ..numerics.trigonometric import tangential_zeros
from ..psi.constructors import many
from .family import FamilySweep, Plane, SystemPath, family

__all__ = [
    "KINDS",
    "UNDEFINED",
    "FamilySweep",
    "Linearisation",
    "Plane",
    "SystemPath",
    "border_functions",
    "class_name",
    "classes",
    "family",
    "linearise",
]


KINDS = ("", "saddle", "stable node", "stable focus", "unstable node", "unstable focus", "centre (linear)")
UNDEFINED = -1  # a coefficient is not finite there


def scale(plane: Plane) -> int:
    """Return the power of two that brings the largest coefficient of all to [1/2, 1): products cannot overflow."""
    return -int(np.frexp(max(float(abs(v).max(initial=0.0)) for v in plane.arrays))[1])


def discriminant(plane: Plane, exponent: int = 0) -> Array:
    """Discriminant of Theta (eq:equator_zeros): negative where it has two zeros, positive where four or none.

    Parameters
    ----------
    plane : Plane
    exponent : int
        Coefficients are multiplied by 2 to this power first, see `scale`; the result is of degree 6 in them.

    Returns
    -------
    ndarray (k,)
        ``I^3 - J^2`` with the invariants of Theta as a quartic. Zero at multiple zeros.
    """
    a, b, d, f1, f2 = (np.ldexp(v, exponent) for v in plane.arrays)
    k = d - a
    r1 = f1 * f1 + f2 * f2
    i = 3.0 * k * k - 3.0 * r1 + 4.0 * b * b
    j = b * (18.0 * k * k + 9.0 * r1 - 8.0 * b * b) + 27.0 * k * f1 * f2
    return i * i * i - j * j


def equator_counts(plane: Plane, exponent: int = 0, known: Array | None = None) -> NDArray[np.int64]:
    """Count the equilibria on the equator: 0, 2 or 4 beside a saddle-node, whose two sides rounding may exchange.

    A quartic with positive discriminant has four real zeros iff its Hessian's leading coefficient H is positive and
    ``12 H^2 > (leading coefficient)^2 I``. `known` is the discriminant, where it has been computed already.
    """
    a, b, d, f1, f2 = (np.ldexp(v, exponent) for v in plane.arrays)
    k = d - a
    # Theta = (A t^4 + 4 B t^3 + 6 C t^2 + ...)/(1 + t^2)^2 with t = tan(theta/2)
    lead, cubic = b - f2, -0.5 * (f1 + k)
    hessian = cubic * cubic - lead * b / 3.0
    i = k * k - f1 * f1 - f2 * f2 + 4.0 / 3.0 * b * b
    four = (hessian > 0.0) & (12.0 * hessian * hessian > lead * lead * i)
    known = discriminant(plane, exponent) if known is None else known
    found = np.where(known < 0.0, 2, np.where(four, 4, 0))
    # b outweighs all else: none, where double complex zeros (a = d, f = 0) leave the discriminant to rounding
    found[abs(b) > 0.5 * abs(k) + np.hypot(f1, f2)] = 0
    if len(plane) and plane.rigid:  # one system: it may well lie on a border, where only the exact answer will do
        zeros = tangential_zeros(*(float(v[0]) for v in plane.arrays))
        found[:] = len(zeros.theta)
    return found


@dataclass(frozen=True, eq=False)
class Linearisation:
    """The critical set at k parameter values (thm:lineps1(a)); arrays are 0 where it does not exist.

    Attributes
    ----------
    exists : ndarray of bool (k,)
        |A^-1 f| < 1.
    e, x2, p : ndarray (k, 2)
        Its place: (c, s), in the scaling chart, in the projected disc.
    trace, determinant, discriminant : ndarray (k,)
        Of J, eq:scjaco, in (x2, y2) and the fast time tau; the discriminant is trace^2 - 4 determinant.
    share : ndarray (k,)
        ``trace`` divided by the sum of the sizes of its two terms.
    """

    exists: NDArray[np.bool_]
    e: Array
    x2: Array
    p: Array
    trace: Array
    determinant: Array
    discriminant: Array
    share: Array

    @property
    def kind(self) -> NDArray[np.int64]:
        """Index in `KINDS` of its kind, 0 where there is none."""
        node = self.discriminant >= 0.0
        plain = np.where(self.trace < 0.0, np.where(node, 2, 3), np.where(node, 4, 5))
        plain = np.where(abs(self.share) <= 16 * 2.0**-53, 6, plain)
        return np.where(self.exists, np.where(self.determinant < 0.0, 1, plain), 0)


def border_functions(plane: Plane, exponent: int = 0) -> tuple[Array, Array]:
    """``det(A)^2 - |adj(A) f|^2``, which is zero where |A^-1 f| = 1 (fig:transcrit), and det A.

    Parameters
    ----------
    plane : Plane
    exponent : int
        Coefficients are multiplied by 2 to this power first, see `scale`.

    Returns
    -------
    gap, det_A : ndarray (k,)
    """
    m11, m12, m21, m22, f1, f2 = (np.ldexp(v, exponent) for v in plane.affine) if exponent else plane.affine
    det = m11 * m22 - m12 * m21
    n1, n2 = m22 * f1 - m12 * f2, m11 * f2 - m21 * f1
    return det * det - n1 * n1 - n2 * n2, det


def linearise(plane: Plane, exponent: int | None = None) -> Linearisation:
    """Critical set and its Jacobian ``J = A D e_Psi`` (eq:scjaco) at all values.

    Parameters
    ----------
    plane : Plane
    exponent : int, optional
        `scale` of the plane or of a larger one.

    Returns
    -------
    Linearisation
    """
    exponent = scale(plane) if exponent is None else exponent
    gap, det = border_functions(plane, exponent)
    exists = gap > 0.0
    if len(plane) and plane.rigid:
        exists = np.full(len(plane), locate(plane.coefficients(0)).e is not None)
    inside = np.flatnonzero(exists)
    pair = np.zeros((3, len(plane), 2))
    numbers = np.zeros((4, len(plane)))
    if len(inside):
        affine = tuple(np.ldexp(v[inside], exponent) for v in plane.affine)
        m11, m12, m21, m22, f1, f2 = affine
        det, gap = det[inside], gap[inside]
        n1, n2 = m22 * f1 - m12 * f2, m11 * f2 - m21 * f1
        # where a difference has lost digits, which J would show
        near = (gap < CANCELS * det * det) | (abs(det) < CANCELS * (abs(m11 * m22) + abs(m12 * m21)))
        if near.any():
            gap, det = gap.copy(), det.copy()
            gap[near], det[near], n1[near], n2[near] = to_all_digits(*(v[near] for v in affine))
        e1, e2 = -n1 / det, -n2 / det
        modulus = np.hypot(e1, e2)
        complement = np.clip(gap / (det * det), 1e-300, 1.0)
        psi = plane.psi if plane.n is None else many(plane.psi, plane.n[inside])
        zeta = psi.radius(np.minimum(modulus, 1.0), complement)
        radial, tangential = psi.jacobian_factors(zeta)
        away = modulus > 0.0
        size = np.where(away, modulus, 1.0)
        c, s = np.where(away, e1 / size, 1.0), e2 / size
        r = zeta / np.hypot(1.0, zeta)
        places = np.stack([[e1, e2], [zeta * c, zeta * s], [r * c, r * s]])
        if plane.told is not None:
            turn = np.exp(1j * plane.told[inside])
            turned = (places[:, 0] + 1j * places[:, 1]) * turn
            places = np.stack([turned.real, turned.imag], axis=1)
        pair[:, inside] = places.transpose(0, 2, 1)
        # in the axes along e and across it J = [[alpha radial, (g - b) tangential], [(g + b) radial, beta tangential]],
        # b and sigma the antisymmetric and the symmetric half of what stands beside the diagonal of A
        unit = 2.0**-exponent
        b, sigma = 0.5 * m21 - 0.5 * m12, 0.5 * m21 + 0.5 * m12
        mixed = 2.0 * sigma * (c * s)
        along = unit * radial * (m11 * c * c + m22 * s * s + mixed)
        across = unit * tangential * (m11 * s * s + m22 * c * c - mixed)
        shear = (m22 - m11) * c * s + sigma * (c - s) * (c + s)
        half = 0.5 * (along - across)
        quarter = half * half + unit * unit * radial * tangential * (shear * shear - b * b)
        total = abs(along) + abs(across)
        numbers[:, inside] = (
            along + across,
            unit * unit * radial * tangential * det,
            4.0 * quarter,
            (along + across) / np.where(total > 0.0, total, 1.0),
        )
    return Linearisation(exists, *pair, *numbers)


def classes(plane: Plane, found: Linearisation | None = None, known: Array | None = None) -> NDArray[np.int64]:
    """Class of the portrait at all values: name (`Classification.name`) and kind of the critical set.

    Parameters
    ----------
    plane : Plane
    found : Linearisation, optional
    known : ndarray (k,), optional
        Its linearisation and `discriminant`, with the `scale` of the plane, where these have been computed already.

    Returns
    -------
    ndarray of int (k,)
        8 times the number of equilibria on the equator plus the index of the kind in `KINDS`; `UNDEFINED` where a
        coefficient is not finite. See `class_name`. Beside a border, where rounding decides, either side's.
    """
    exponent = scale(plane)
    found = linearise(plane, exponent) if found is None else found
    code = 8 * equator_counts(plane, exponent, known) + found.kind
    return np.where(plane.defined, code, UNDEFINED)


def class_name(code: int) -> str:
    """Name of a class, such as "CM4, saddle" or "NCM2"."""
    if code == UNDEFINED:
        return "undefined"
    count, kind = divmod(int(code), 8)
    return f"CM{count}, {KINDS[kind]}" if kind else f"NCM{count}"
