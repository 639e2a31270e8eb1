"""Regularisation functions Psi, Definition 2.3, and the regularised direction ``e_Psi``, Definition 2.4.

With ``zeta^2 = x2^2 + y2^2`` in the scaling chart, ``|e_Psi| = zeta/sqrt(zeta^2 + Psi(zeta^2))``, (2.19) at eps = 1.

How far double precision reaches: ``1 - |e_Psi|^2 = Psi/(zeta^2 + Psi)`` falls as fast as Psi does. Written as
``|e_Psi|`` itself, it rounds to 1 from zeta of about 5.7 (exponential), 19 (tanh), 0.5 e^(18/(n+1)) (Hill, large n)
or 7e7 (constant) on. `Psi.complement` goes on until Psi underflows: zeta = 26 (exponential), 354 (tanh). Beyond
that |e_Psi| is 1 in every digit and no inverse exists.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar, overload

import numpy as np
from numpy.typing import NDArray

from ...formulas.expression import Expression, parse
from ...results import drawing
from ...results.arrays import Array
from ...results.result import Listed
from ...results.tables import paragraphs
from .condition import PsiCheck
from .conditions import check
from .families.record import SCALAR, VECTOR, Family, Kernel
from .families.without_parameter import CONSTANT, Constant

Vector = NDArray[Any] | Sequence[float]

MAX_FLOAT = np.finfo(float).max
LARGE = 1e20  # beyond this s, w^2 Psi(s) is lost next to |p|^2 = w^2 s


@dataclass(frozen=True)
class Psi(Listed):
    """A regularisation function, Definition 2.3. Made by `constant`, `rational`, ..., `custom`.

    Attributes
    ----------
    family : str
        One of `FAMILIES`.
    parameter : float
        That of the family, such as n of the Hill family; 0 if it has none.
    text : str
        The formula in s.
    expression : Expression or None
        The parsed formula, where it is all that is known: of a custom Psi, or of a family without a kernel of its own.
    record : Family
        What is known of the whole family.
    """

    _internal_: ClassVar[frozenset[str]] = frozenset(
        {"complement", "expression", "jacobian_factors", "kernel", "packed", "record", "steepness", "words"}
    )

    family: str
    parameter: float
    text: str
    expression: Expression | None = field(default=None, compare=False, repr=False)
    kernel: Kernel = field(default_factory=Constant, compare=False, repr=False)
    record: Family = field(default=CONSTANT, compare=False, repr=False)

    def _repr_svg_(self) -> str | None:
        return drawing.svg(self)

    def _repr_html_(self) -> str:
        return drawing.image(self) + paragraphs([f"Ψ(s) = {self.words}"])

    @property
    def words(self) -> str:
        """The formula as a menu writes it, with the parameter's value; of a typed one, the text."""
        return self.text if self.record.typed else self.record.words(self.parameter)

    @property
    def limit(self) -> float:
        """``Psi_1(0)``, the limit of Psi(s) as s grows (R5)."""
        return self.kernel.limit

    @property
    def saturation(self) -> float:
        """The zeta from which ``|e_Psi|`` is 1, where friction saturates at a finite slip; inf if R3 holds."""
        return math.sqrt(self.kernel.saturation)

    @cached_property
    def packed(self) -> Array:
        """The formula as compiled code interprets it at its address (`expressions.packed`), up to where it counts."""
        from ...formulas.arrays import path_program  # on first use: it loads the compiler
        from ...formulas.packed import pack

        formula = self.expression or parse(self.text, ("s",))
        row = formula.substitute("s", parse("c", ("c",)))
        return pack(path_program((row,)), 1, bound=min(LARGE, self.kernel.saturation))

    @overload
    def __call__(self, s: float) -> float: ...
    @overload
    def __call__(self, s: Vector) -> Array: ...
    def __call__(self, s: Any) -> Any:
        """Psi(s), Definition 2.3.

        As s. Raises ValueError: s is negative or NaN.
        """
        return _apply(self.kernel.value, s, "s", math.inf, "s >= 0")

    @overload
    def derivative(self, s: float) -> float: ...
    @overload
    def derivative(self, s: Vector) -> Array: ...
    def derivative(self, s: Any) -> Any:
        """Psi'(s); -inf at s = 0 for a Hill Psi with n < 1.

        Parameters
        ----------
        s : float or array
            ``0 <= s < inf``.

        Raises
        ------
        ValueError
            s is negative, infinite or NaN.
        """
        return _apply(self.kernel.slope, s, "s", MAX_FLOAT, "0 <= s < inf")

    @overload
    def modulus(self, zeta: float) -> float: ...
    @overload
    def modulus(self, zeta: Vector) -> Array: ...
    def modulus(self, zeta: Any) -> Any:
        """``|e_Psi| = zeta/sqrt(zeta^2 + Psi(zeta^2))``, (2.19), in [0, 1]; 1 only by rounding.

        Parameters
        ----------
        zeta : float or array
            Distance from the origin in the chart kappa_2, ``0 <= zeta < inf``.

        Raises
        ------
        ValueError
            zeta is negative, infinite or NaN.
        """
        return _apply(self._modulus, zeta, "zeta", MAX_FLOAT, "0 <= zeta < inf")

    def complement(self, zeta: Any) -> Any:
        """``1 - |e_Psi|^2 = Psi/(zeta^2 + Psi)`` to full relative accuracy, however near |e_Psi| is to 1."""
        return _apply(self._complement, zeta, "zeta", MAX_FLOAT, "0 <= zeta < inf")

    @overload
    def radius(self, modulus: float, complement: float | None = None) -> float: ...
    @overload
    def radius(self, modulus: Vector, complement: Vector | None = None) -> Array: ...
    def radius(self, modulus: Any, complement: Any = None) -> Any:
        """Find the zeta with ``|e_Psi| = modulus``: the inverse of `modulus`, one-to-one by Lemma 2.6(c).

        Parameters
        ----------
        modulus : float or array
            ``|e_Psi|`` in [0, 1); also 1 where `complement` says how far from it.
        complement : float or array, optional
            ``1 - |e_Psi|^2``, positive, of the same shape. Near 1 the modulus says little about its distance from 1;
            who knows that distance better (``1 - |A^-1 f|^2``, `complement`) gives it and loses nothing.

        Returns
        -------
        float or ndarray
            As modulus.

        Raises
        ------
        ValueError
            modulus is outside [0, 1), complement is outside (0, 1], or either is NaN.
        """
        if complement is None:
            return _apply(self._radius, modulus, _MODULUS, _BELOW_1, "0 <= |e_Psi| < 1")
        if not (isinstance(modulus, float) and isinstance(complement, float)):
            if np.shape(modulus) != np.shape(complement):
                raise ValueError(
                    f"modulus has shape {np.shape(modulus)} and complement {np.shape(complement)}; give equal shapes."
                )
            complement = np.asarray(complement, float) if np.ndim(complement) else float(complement)
        if isinstance(complement, float):
            inside = 0.0 < complement <= 1.0
        else:
            inside = complement.size == 0 or bool(complement.min() > 0.0 and complement.max() <= 1.0)
        if not inside:
            raise ValueError(
                f"the complement 1 - |e_Psi|^2 is {_culprit(complement, lambda c: (c > 0.0) & (c <= 1.0))}; "
                "allowed is 0 < complement <= 1. At 0 the point lies on the equator, infinitely far out."
            )
        return _apply(self._radius, modulus, _MODULUS, 1.0, "0 <= |e_Psi| <= 1", complement)

    def jacobian_factors(self, zeta: Any) -> Any:
        """Eigenvalues of ``D e_Psi(x2, y2; 1)``, Remark 3.2, along (x2, y2) and across it, at its distance zeta from 0.

        ``radial = (Psi - zeta^2 Psi')/(zeta^2 + Psi)^(3/2)`` and ``tangential = 1/sqrt(zeta^2 + Psi)``.
        """
        return _apply(self._jacobian_factors, zeta, "zeta", MAX_FLOAT, "0 <= zeta < inf")

    def steepness(self, zeta: Any) -> Any:
        """``-s Psi'(s)/Psi(s)`` at ``s = zeta^2``: ``radial = tangential (1 - |e_Psi|^2) (1 + steepness)`` above."""
        return _apply(self.kernel.kappa, zeta, "zeta", MAX_FLOAT, "0 <= zeta < inf")

    def check(self) -> PsiCheck:
        """Whether Psi meets R1 to R5 of Definition 2.3, and where it does not.

        Returns
        -------
        PsiCheck
            Attributes R1, ..., R5 (also by iteration), each with .holds, .where (an s, or None) and .sentence;
            and .holds for all of them. Built-in families are decided by mathematics, custom text by probing.
        """
        return check(self.record, self.parameter, self.text, self.expression, self.kernel)

    def _modulus(self, lib: Any, zeta: Any) -> Any:
        return zeta / lib.hypot(zeta, self.kernel.root(lib, zeta))

    def _complement(self, lib: Any, zeta: Any) -> Any:
        root = self.kernel.root(lib, zeta)
        u = root / lib.hypot(zeta, root)
        return u * u

    def _radius(self, lib: Any, modulus: Any, complement: Any = None) -> Any:
        if complement is None:
            complement = (1.0 - modulus) * (1.0 + modulus)
        w = modulus / lib.sqrt(complement)
        if w == 0.0 if lib is SCALAR else not w.size:
            return w
        zeta = self.kernel.inverse(lib, w)
        return lib.where(w > 0.0, zeta, 0.0)

    def _jacobian_factors(self, lib: Any, zeta: Any) -> Any:
        root, kappa = self.kernel.root_and_kappa(lib, zeta)
        tangential = 1.0 / lib.hypot(zeta, root)
        u = root * tangential
        return u * u * (1.0 + kappa) * tangential, tangential


_BELOW_1 = math.nextafter(1.0, 0.0)
_MODULUS = "the modulus |e_Psi|"


def _culprit(values: Any, allowed: Any) -> str:
    if isinstance(values, float):
        return f"{values!r}"
    wrong = ~allowed(values)
    return f"{float(values[wrong][0])!r} (one of {int(wrong.sum())} such values)"


def _apply(function: Any, x: Any, what: str, most: float, rule: str, *more: Any) -> Any:
    """Call a kernel on a float or on an array after checking ``0 <= x <= most``, which refuses NaN too."""
    if type(x) is not float:
        try:
            x = np.asarray(x, float)
        except (TypeError, ValueError, OverflowError) as error:
            raise ValueError(f"{what} is {repr(x)[:60]}; give numbers, {rule}.") from error
        if x.ndim:
            if x.size and not (x.min() >= 0.0 and x.max() <= most):
                found = _culprit(x, lambda v: (v >= 0.0) & (v <= most))
                raise ValueError(f"{what} is {found}; allowed is {rule}.")
            with np.errstate(all="ignore"):
                return function(VECTOR, x, *more)
        x = float(x)
    if not 0.0 <= x <= most:
        raise ValueError(f"{what} is {x!r}; allowed is {rule}.")
    return function(SCALAR, x, *more)


def direction(psi: Psi | None, eps: float, xy: Array, along: Array | None = None) -> Array:
    """Return e (k, 2) at (x, y): regularised, or, for eps = 0, outside Sigma."""
    if psi is None or eps == 0.0:
        r = np.hypot(*xy.T)[:, None]
        e = np.divide(xy, r, out=np.zeros_like(xy), where=r > 0.0)
        return e if along is None else np.sign(e @ along)[:, None] * along
    return xy / (eps * np.sqrt((zeta := np.hypot(*xy.T) / eps) ** 2 + psi(zeta**2)))[:, None]


def outside(xy: Array, along: Array | None = None) -> tuple[Array, Array]:
    """Return e = (x, y)/|(x, y)| (k, 2) of the nonsmooth system and its derivative (k, 2, 2); 0 on Sigma itself."""
    r, e = np.hypot(*xy.T)[:, None], direction(None, 0.0, xy, along)
    if along is not None:
        return e, np.zeros((len(e), 2, 2))
    across = np.eye(2) - e[:, :, None] * e[:, None, :]
    return e, np.divide(across, r[:, :, None], out=np.zeros_like(across), where=r[:, :, None] > 0.0)


def smoothed_direction(psi: Psi, eps: float, xy: Array) -> tuple[Array, Array]:
    """Return e_Psi (k, 2), (2.19), at xy (k, 2), and its derivative (k, 2, 2), Remark 3.2."""
    r = np.hypot(*xy.T)
    radial, tangential = (factor / eps for factor in psi.jacobian_factors(r / eps))
    n = np.divide(xy, r[:, None], out=np.zeros_like(xy), where=r[:, None] > 0.0)
    De = tangential[:, None, None] * np.eye(2) + (radial - tangential)[:, None, None] * n[:, :, None] * n[:, None, :]
    return tangential[:, None] * xy, De
