"""What decides the portrait of the e-linear system, for many parameter values at once.

Signs of five smooth functions do it: the discriminant of Theta and the sign of a resolvent (how many equilibria there
are on the equator), ``det(A)^2 - |adj(A) f|^2`` (whether there is a critical set, thm:lineps1(a)), det A, tr J and the
discriminant of J (its kind). They are plain NumPy; `classify` is the exact answer for one system.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .critical import locate
from .expressions import Expression
from .regularisation import LARGEST_N, SMALLEST_N, Psi
from .regularisation_families import Hill
from .systems import LARGEST, Coefficients, ELinear
from .trigonometric import tangential_zeros
from .vary import limits, names

__all__ = [
    "KINDS",
    "UNDEFINED",
    "Family",
    "Line",
    "Linearisation",
    "Plane",
    "border_functions",
    "class_name",
    "classes",
    "family",
    "linearise",
]

Array = NDArray[np.float64]

KINDS = ("", "saddle", "stable node", "stable focus", "unstable node", "unstable focus", "centre (linear)")
UNDEFINED = -1  # a coefficient is not finite there


@dataclass(frozen=True, eq=False)
class Plane:
    """Coefficients and Psi at k parameter values.

    Attributes
    ----------
    a, b, d, f1, f2 : ndarray (k,)
        Zero where `defined` is not.
    psi : Psi
    n : ndarray (k,) or None
        n of the Hill Psi, where it varies; `psi` is then not to be used.
    defined : ndarray of bool (k,)
        Every coefficient is finite there.
    """

    a: Array
    b: Array
    d: Array
    f1: Array
    f2: Array
    psi: Psi
    n: Array | None
    defined: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.a)

    @property
    def arrays(self) -> tuple[Array, Array, Array, Array, Array]:
        """``(a, b, d, f1, f2)``."""
        return self.a, self.b, self.d, self.f1, self.f2

    @property
    def rigid(self) -> bool:
        """Whether a, b, d, f1, f2 are the same everywhere."""
        return bool(self.defined.all()) and all(bool((v == v[:1]).all()) for v in self.arrays)

    def coefficients(self, i: int) -> Coefficients:
        """Return the system at value i, without its slow part."""
        a, b, d, f1, f2 = (float(v[i]) for v in self.arrays)
        return Coefficients(a, b, d, f1, f2, np.zeros((0, 2)), np.zeros(0))


_NAMES = ("a", "b", "d", "f1", "f2")


@dataclass(frozen=True, eq=False)
class Family:
    """A system in which some names vary, prepared for many evaluations. Made by `family`.

    Attributes
    ----------
    names : tuple of str
    system : ELinear or Coefficients
    psi : Psi
    z : (m,) floats
    fixed : tuple of float or None
        a, b, d, f1, f2, where they vary by name only and in no formula.
    hill : bool
        n is among the names, and is that of the Hill Psi.
    """

    names: tuple[str, ...]
    system: ELinear | Coefficients
    psi: Psi
    z: ArrayLike
    fixed: tuple[float, ...] | None
    hill: bool

    def __call__(self, **values: Array) -> Plane:
        """Coefficients at k values of every name, each of shape (k,) and within `vary.limits` (not checked here)."""
        k = len(values[self.names[0]])
        n = values["n"] if self.hill else None
        if self.fixed is not None:
            a, b, d, f1, f2 = (
                values[name] if name in values else np.full(k, v) for name, v in zip(_NAMES, self.fixed, strict=True)
            )
            return Plane(a, b, d, f1, f2, self.psi, n, np.ones(k, bool))
        assert isinstance(self.system, ELinear)
        a, b, d, f1, f2 = (
            v if isinstance(v, np.ndarray) and v.shape == (k,) else np.full(k, v)
            for v in _rows(self.system, self.z, values)
        )
        defined = np.ones(k, bool)
        with np.errstate(invalid="ignore"):
            for v in (a, b, d, f1, f2):
                defined &= abs(v) <= LARGEST
        if not defined.all():
            a, b, d, f1, f2 = (np.where(defined, v, 0.0) for v in (a, b, d, f1, f2))
        return Plane(a, b, d, f1, f2, self.psi, n, defined)


def family(system: Any, psi: Psi, z: ArrayLike, *varying: str, spans: Sequence[ArrayLike] = ()) -> Family:
    """Prepare an e-linear system in which some names vary (see `vary.names`).

    Parameters
    ----------
    system : ELinear or Coefficients
    psi : Psi
    z : (m,) floats
    *varying : str
        Different names.
    spans : sequence of arrays
        For each name, values to be checked against its limits.

    Returns
    -------
    Family

    Raises
    ------
    ValueError
        A name cannot be varied, a value is beyond what it may be, z does not fit, or the system is not e-linear.
    """
    if not isinstance(system, (ELinear, Coefficients)):
        raise ValueError(f"the system is of type {type(system).__name__}; give an e-linear one (ELinear).")
    varying = tuple("z1" if name == "z" else name for name in varying)
    known = names(system, psi, z)
    for i, name in enumerate(varying):
        if name not in known:
            raise ValueError(f"{name!r} cannot be varied here; choose one of {', '.join(known)}.")
        if name in varying[:i]:
            raise ValueError(f"{name!r} is given twice; choose two different names.")
    for name, given in zip(varying, spans, strict=False):
        low, high = limits(system, psi, name)
        values = np.asarray(given, float)
        if not (np.isfinite(values).all() and (values >= low).all() and (values <= high).all()):
            raise ValueError(f"values of {name} are beyond {low:g} to {high:g}; give values between these.")
    own = dict(getattr(system, "parameters", ()))
    fixed = None if isinstance(system, ELinear) and _needs(system, varying) else system.at(z).plane
    return Family(varying, system, psi, z, fixed, "n" in varying and "n" not in own)


@dataclass(frozen=True, eq=False)
class Line:
    """A family with one name: a path of systems."""

    family: Family

    @property
    def names(self) -> tuple[str, ...]:
        """The one name."""
        return self.family.names

    @property
    def affine(self) -> bool:
        """Whether a, b, d, f1, f2 are constant, but for one that is the parameter itself."""
        return self.family.fixed is not None

    def __call__(self, values: Array) -> Plane:
        """Coefficients at k values, (k,)."""
        return self.family(**{self.family.names[0]: values})


def _needs(system: ELinear, varying: tuple[str, ...]) -> bool:
    """Whether a, b, d, f1, f2 are more than the numbers given and the values themselves."""
    if system._matrix is not None:
        return True
    used = {name for what, e in system._expressions if what in _NAMES for name in e.names}
    return bool(used & {*varying, "z" if "z1" in varying else ""})


def _rows(system: ELinear, z: ArrayLike, values: Mapping[str, Array]) -> list[Any]:
    held: dict[str, Any] = dict(system.parameters)
    for i, value in enumerate(np.atleast_1d(np.asarray(z, float))):
        held[f"z{i + 1}"] = float(value)
    held |= {name: v for name, v in values.items() if name in held}
    if "z1" in held:
        held["z"] = held["z1"]

    def number(name: str, value: Any) -> Any:
        return (
            value.evaluate({n: held[n] for n in value.names})
            if isinstance(value, Expression)
            else values.get(name, value)
        )

    f1, f2 = number("f1", system.f[0]), number("f2", system.f[1])
    if system._matrix is None:
        return [number(name, getattr(system, name)) for name in "abd"] + [f1, f2]
    (a11, a12), (a21, a22) = (tuple(np.asarray(number("", v), float) for v in row) for row in system._matrix)
    shear, stretch = a12 + a21 + 0.0, a22 - a11  # lem:normalform, as in `ELinear.from_matrix`
    phi = 0.5 * np.arctan2(shear, stretch)
    mean, half = 0.5 * a11 + 0.5 * a22, 0.5 * np.hypot(shear, stretch)
    c, s = np.cos(phi), np.sin(phi)
    return [mean - half, 0.5 * a21 - 0.5 * a12, mean + half, c * f1 - s * f2, s * f1 + c * f2]


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
    a, b, d, f1, f2 = (np.ldexp(v, exponent) for v in plane.arrays) if exponent else plane.arrays
    det = a * d + b * b
    n1, n2 = d * f1 + b * f2, a * f2 - b * f1
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
        a, b, d, f1, f2 = (np.ldexp(v[inside], exponent) for v in plane.arrays)
        det, gap = det[inside], gap[inside]
        e1, e2 = -(d * f1 + b * f2) / det, (b * f1 - a * f2) / det
        modulus = np.hypot(e1, e2)
        complement = np.clip(gap / (det * det), 1e-300, 1.0)
        psi = plane.psi if plane.n is None else _hills(plane.n[inside])
        zeta = psi.radius(np.minimum(modulus, 1.0), complement)
        radial, tangential = psi.jacobian_factors(zeta)
        away = modulus > 0.0
        size = np.where(away, modulus, 1.0)
        c, s = np.where(away, e1 / size, 1.0), e2 / size
        r = zeta / np.hypot(1.0, zeta)
        pair[:, inside] = np.stack([[e1, e2], [zeta * c, zeta * s], [r * c, r * s]]).transpose(0, 2, 1)
        # in the axes along e and across it: J = [[alpha radial, (g - b) tangential], [(g + b) radial, beta tangential]]
        unit = 2.0**-exponent
        along = unit * radial * (a * c * c + d * s * s)
        across = unit * tangential * (a * s * s + d * c * c)
        shear = (d - a) * c * s
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


def _hills(n: Array) -> Psi:
    """One Hill Psi a value; it works on arrays of that length only."""
    assert n.min(initial=SMALLEST_N) >= SMALLEST_N
    assert n.max(initial=LARGEST_N) <= LARGEST_N
    return Psi("hill", float("nan"), "3/(3+(4*s)**n)", None, Hill(n=n))  # type: ignore[arg-type]


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
