"""The record of a family of Psi. To add one: its record in a file next to this one, and its name in `LISTED`.

The interface of the arithmetic of a family of Psi, Definition 2.3, for one float or for arrays.

Everything about ``|e_Psi|`` is written in zeta with two functions that neither overflow nor cancel,

    root(zeta) = sqrt(Psi(zeta^2)),    kappa(zeta) = -s Psi'(s)/Psi(s) at s = zeta^2,

because then, with ``w = zeta/root`` (the tangent of the angle whose sine is ``|e_Psi|``),

    |e_Psi| = zeta/hypot(zeta, root),    1 - |e_Psi|^2 = (root/hypot)^2,    d ln w/d ln zeta = 1 + kappa,

and R4 says kappa >= 0, so that ``ln w`` as a function of ``ln zeta`` has slope at least 1 and is inverted safely.
"""

from __future__ import annotations

import math
import re
import reprlib
from collections.abc import Callable
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

from ....formulas.expression import Expression, parse
from ....results.arrays import Array
from ..condition import Condition

UNDERFLOW_BOUND = 1e-300


def _power(base: float, exponent: float) -> float:
    try:
        return math.pow(base, exponent)
    except (OverflowError, ValueError):  # ValueError: 0 to a negative power
        return math.inf


def _scalar_log(x: float) -> float:
    return math.log(x) if x > 0.0 else -math.inf


# One formula serves floats (math.* is ten times faster there) and arrays.
SCALAR = SimpleNamespace(
    exp=math.exp, expm1=math.expm1, log=_scalar_log, log1p=math.log1p, sqrt=math.sqrt, asinh=math.asinh,
    hypot=math.hypot, power=_power, minimum=min, maximum=max, all=bool,
    where=lambda condition, yes, no: yes if condition else no,
)  # fmt: skip
VECTOR = SimpleNamespace(
    exp=np.exp, expm1=np.expm1, log=np.log, log1p=np.log1p, sqrt=np.sqrt, asinh=np.arcsinh,
    hypot=np.hypot, power=np.power, minimum=np.minimum, maximum=np.maximum, where=np.where, all=np.all,
)  # fmt: skip


class Kernel:
    """The interface of a family; `lib` is `SCALAR` or `VECTOR`, called inside ``np.errstate(all="ignore")``."""

    limit: float = 0.0  # Psi_1(0), R5
    saturation: float = math.inf  # the s from which Psi is 0, where R3 fails

    def value(self, lib: Any, s: Any) -> Any:
        """Psi(s)."""
        raise NotImplementedError

    def slope(self, lib: Any, s: Any) -> Any:
        """Psi'(s)."""
        raise NotImplementedError

    def root(self, lib: Any, zeta: Any) -> Any:
        """sqrt(Psi(zeta^2))."""
        raise NotImplementedError

    def kappa(self, lib: Any, zeta: Any) -> Any:
        """-s Psi'(s)/Psi(s) at s = zeta^2."""
        raise NotImplementedError

    def root_and_kappa(self, lib: Any, zeta: Any) -> tuple[Any, Any]:
        """Both at once, for a family in which they have a power in common."""
        return self.root(lib, zeta), self.kappa(lib, zeta)

    def inverse(self, lib: Any, w: Any) -> Any:
        """Find the zeta with ``zeta/root(zeta) = w``."""
        raise NotImplementedError

    def polish(self, lib: Any, zeta: Any, w: Any) -> Any:
        """One Newton step on ``zeta/(w root) = 1`` for d ln zeta: relative accuracy down to the smallest zeta."""
        root, kappa = self.root_and_kappa(lib, zeta)
        return zeta * (1.0 - (zeta / (w * root) - 1.0) / (1.0 + kappa))


class Each(Kernel):
    """One kernel a point, for a family whose own takes no array of parameters: for arrays of that length only."""

    def __init__(self, kernels: tuple[Kernel, ...]) -> None:
        self.kernels = kernels

    def root(self, lib: Any, zeta: Any) -> Any:
        """Return the same as `Kernel.root`, point by point."""
        return np.array([kernel.root(SCALAR, z) for kernel, z in zip(self.kernels, zeta.tolist(), strict=True)])

    def kappa(self, lib: Any, zeta: Any) -> Any:
        """Return the same as `Kernel.kappa`, point by point."""
        return np.array([kernel.kappa(SCALAR, z) for kernel, z in zip(self.kernels, zeta.tolist(), strict=True)])

    def inverse(self, lib: Any, w: Any) -> Any:
        """Return the same as `Kernel.inverse`, point by point."""
        pairs = zip(self.kernels, w.tolist(), strict=True)
        return np.array([kernel.inverse(SCALAR, v) if v > 0.0 else 0.0 for kernel, v in pairs])


Gain = Callable[[Any, Any, Any], Any]
LARGEST_WHOLE = 255  # of a parameter for which `Family.gain_whole` is asked


@dataclass(frozen=True)
class Parameter:
    """The parameter of a family.

    Attributes
    ----------
    name : str
        As in the formula.
    low, high : float
        What is allowed.
    shown : (float, float)
        The range of a slider.
    default : float
    note : str
        For whoever gives a value that is not allowed.
    """

    name: str
    low: float
    high: float
    shown: tuple[float, float]
    default: float
    note: str = ""

    def check_value(self, value: Any) -> float:
        """Return a value that is allowed, as a float.

        Raises
        ------
        ValueError
            It is no number, or out of range.
        """
        try:
            number = float(value)
        except (TypeError, ValueError, OverflowError):
            raise ValueError(
                f"{self.name} is {reprlib.repr(value)}; give a number from {self.low:g} to {self.high:g}."
            ) from None
        if not self.low <= number <= self.high:
            note = f" ({self.note})" if self.note else ""
            allowed = f"{self.low:g} <= {self.name} <= {self.high:g}"
            raise ValueError(f"{self.name} is {number:g}; allowed is {allowed}{note}.")
        return number


@dataclass(frozen=True, eq=False)
class Family:
    """A family of Psi, Definition 2.3. Only name, title and formula are needed: the rest is derived.

    Attributes
    ----------
    name : str
        Its key, in links too; ``psi.make(name)`` and ``psi.NAME()`` make it.
    title : str
        The formula as a menu writes it.
    formula : str
        In s, and in the parameter's name if there is one; "" for the one family that is typed.
    parameter : Parameter or None
    kernel : callable or None
        From the parameter (none: from nothing) to the `Kernel`.
    batched : bool
        The kernel also takes an array of parameters, one for each point.
    gain : callable or None
        ``gain(r2, w, parameter) = 1/sqrt(r2 + w^2 Psi(r2/w^2))``, (2.19): an undecorated function of three floats,
        without branches, whose w may be 0. It is plain Python here; the stepping compiles it, with versions of
        ``expm1`` and ``log`` (imported from math under these names) that run in vector registers.
    gain_whole : callable or None
        The same, where the parameter is an int from 1 to `LARGEST_WHOLE`.
    derivatives : callable or None
        ``derivatives(s, parameter)``: the first three of Psi, arrays as s, for s > 0.
    broken : callable or None
        ``broken(parameter, text)``: the conditions R1 to R5 that fail. None: all hold, unless the kernel is derived
        from the formula, which is probed.
    compared : tuple of float
        The parameters (0 where there is none) of those members with which "whatever Psi" is asked.
    identity : bool
        e_Psi = p, the point of the projected hemisphere: true of Psi = 1 only.
    """

    name: str
    title: str
    formula: str
    parameter: Parameter | None = None
    kernel: Callable[..., Kernel] | None = None
    batched: bool = False
    gain: Gain | None = None
    gain_whole: Gain | None = None
    derivatives: Callable[[Array, float], tuple[Array, Array, Array]] | None = None
    broken: Callable[[float, str], tuple[Condition, ...]] | None = None
    compared: tuple[float, ...] = ()
    identity: bool = False

    def __repr__(self) -> str:
        return f"Family({self.name!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        from . import family_of_name  # a record stands for what is listed under its name, in another process too

        return family_of_name, (self.name,)

    @property
    def typed(self) -> bool:
        """Whether the formula is the user's."""
        return not self.formula

    @property
    def names(self) -> tuple[str, ...]:
        """The names in the formula: s, and that of the parameter."""
        return ("s",) if self.parameter is None else ("s", self.parameter.name)

    def expression(self) -> Expression:
        """Return the formula in s and the parameter."""
        return parse(self.formula, self.names)

    def text(self, parameter: float) -> str:
        """Return the formula in s, with the parameter's value."""
        if self.parameter is None:
            return self.formula
        shown = repr(float(parameter)).removesuffix(".0")
        shown = f"({shown})" if parameter < 0.0 else shown
        return re.sub(rf"\b{self.parameter.name}\b", shown, self.formula)

    def words(self, parameter: float) -> str:
        """Return the title, with the parameter's value."""
        return self.title if self.parameter is None else f"{self.title}, {self.parameter.name} = {parameter:g}"

    def uses_gain_whole(self, parameter: float) -> bool:
        """Whether `gain_whole` is to be used."""
        return self.gain_whole is not None and parameter in range(1, LARGEST_WHOLE + 1)
