"""The interface of the arithmetic of a family of Psi, Definition 2.3, for one float or for arrays.

Everything about ``|e_Psi|`` is written in zeta with two functions that neither overflow nor cancel,

    root(zeta) = sqrt(Psi(zeta^2)),    kappa(zeta) = -s Psi'(s)/Psi(s) at s = zeta^2,

because then, with ``w = zeta/root`` (the tangent of the angle whose sine is ``|e_Psi|``),

    |e_Psi| = zeta/hypot(zeta, root),    1 - |e_Psi|^2 = (root/hypot)^2,    d ln w/d ln zeta = 1 + kappa,

and R4 says kappa >= 0, so that ``ln w`` as a function of ``ln zeta`` has slope at least 1 and is inverted safely.
"""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np

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

    def root(self, lib: Any, zeta: Any) -> Any:  # noqa: ARG002 (each takes one float)
        """Return the same as `Kernel.root`, point by point."""
        return np.array([kernel.root(SCALAR, z) for kernel, z in zip(self.kernels, zeta.tolist(), strict=True)])

    def kappa(self, lib: Any, zeta: Any) -> Any:  # noqa: ARG002
        """Return the same as `Kernel.kappa`, point by point."""
        return np.array([kernel.kappa(SCALAR, z) for kernel, z in zip(self.kernels, zeta.tolist(), strict=True)])

    def inverse(self, lib: Any, w: Any) -> Any:  # noqa: ARG002
        """Return the same as `Kernel.inverse`, point by point."""
        pairs = zip(self.kernels, w.tolist(), strict=True)
        return np.array([kernel.inverse(SCALAR, v) if v > 0.0 else 0.0 for kernel, v in pairs])
