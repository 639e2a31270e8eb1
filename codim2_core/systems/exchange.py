"""A system for other programs: its right-hand side as a function, its formulas in SymPy."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from ..formulas.names import SLOW_NAMES
from ..results.arrays import Array
from .equations import Equations

Regularisation = Callable[[Any], Any]


class Exchange:
    """A system as other programs take it."""

    def rhs(self, psi: Regularisation | None = None, eps: float = 0.0) -> Callable[[float, ArrayLike], Array]:
        """Return ``f(t, state)``, the right-hand side of (2.7) with e_Psi (2.19), for `scipy.integrate.solve_ivp`.

        Parameters
        ----------
        psi : Psi, optional
            Left out, with eps = 0: the nonsmooth system, NaN where x = y = 0.
        eps : float

        Returns
        -------
        callable
            state is (x, y, z1, ..., zm), (2 + m,) or, for k at once, (2 + m, k); time as a slow variable may be left
            out.

        Raises
        ------
        ValueError
            eps is negative or psi is missing, and of the function: a state has the wrong length.
        """
        if not eps >= 0.0 or (eps > 0.0 and not callable(psi)):
            raise ValueError(f"eps is {eps!r} and psi is {psi!r}; give eps > 0 with a Psi, or neither for the limit.")
        own: Any = self
        rows, numbers, n = [right for _, right in own.equations], dict(own.parameters), 2 + own.m
        least = n - bool(own.clock)

        def f(t: float, state: ArrayLike) -> Array:
            y = np.asarray(state, float)
            if len(y) not in (n, least):
                raise ValueError(f"state has {len(y)} numbers; give (x, y, z1, ..., zm), {n} of them.")
            squared = y[0] ** 2 + y[1] ** 2
            smoothed = eps * eps * np.asarray(psi(squared / eps**2)) if psi is not None and eps > 0.0 else 0.0
            with np.errstate(invalid="ignore", divide="ignore"):
                c, s = y[:2] / np.sqrt(squared + smoothed)
            values = {**numbers, "c": c, "s": s, "x": y[0], "y": y[1], "t": y[-1] if own.clock and len(y) == n else t}
            values |= dict(zip(SLOW_NAMES, y[2:], strict=False)) | ({"z": y[2]} if len(y) > 2 else {})
            moves = [row.evaluate({name: values[name] for name in row.names}) for row in rows]
            moves += [1.0] * (len(y) - len(moves))  # the clock
            return np.array(np.broadcast_arrays(*moves, y[0])[:-1], float)

        return f

    def to_sympy(self) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Return U and W as SymPy expressions of c, s, x, y, z1, ..., t and the parameters.

        Raises
        ------
        ValueError
            SymPy is not installed.
        """
        try:
            sympy: Any = import_module("sympy")
        except ImportError:
            raise ValueError("to_sympy needs SymPy, which is missing: pip install sympy.") from None
        rows: Equations = cast("Any", self).equations
        known = {name: sympy.Symbol(name, real=True) for _, row in rows for name in row.names}
        known |= {"abs": sympy.Abs, "max": sympy.Max, "min": sympy.Min}
        found = [sympy.sympify(row.text.replace("^", "**"), locals=known) for _, row in rows]
        return tuple(found[:2]), tuple(found[2:])
