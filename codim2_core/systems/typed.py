"""Any system of the paper's form, (2.7): ``(x, y)' = U(e, x, y, z)``, ``z' = W(e, x, y, z)``, typed as text.

The text is read by `expressions.expression.parse` against a whitelist and never evaluated as Python. The system is
immutable; `System.at` freezes it at one z, which is all that the hemisphere there depends on.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..formulas.expression import Expression
from ..formulas.names import SLOW_NAMES
from ..results.result import Listed
from .coefficients import Parameters
from .equations import Equations, Exchange, equations_latex, equations_text, with_left_sides
from .reading import parameter, slow_values
from .typed_at_z import Formulas, Frozen


class System(Listed, Formulas, Exchange):
    """A system ``(x, y)' = U(e, x, y, z)``, ``z' = W(e, x, y, z)`` with ``e = (c, s) = (x, y)/|(x, y)|``, (2.7).

    Parameters
    ----------
    U : (2,) text
        In c, s, x, y, the slow variables z1 … zm (z is z1), `parameters` and `definitions`.
    W : (m,) text, optional
        Likewise. Left out, W = 0 for as many slow variables as U names.
        Where a formula reads t, time is one more slow variable, the last, with the rate 1 (`clock` is its name): it
        needs no row, a motion that starts without it starts at the time where its span begins, and a portrait without
        it is that of t = 0. A parameter or a definition of the name t is that.
    parameters : mapping of str to float, optional
        `evolve` changes their values without reading or compiling anything again.
    definitions : mapping of str to text, optional
        Named sub-expressions, such as ``{"chi": "(1 + 2*z**2)/(1 + z**2)"}`` (the key may be ``"chi(z)"``); each may
        use the ones before it. In U, W both ``chi`` and ``chi(z)`` can be written.

    Notes
    -----
    Formulas may have kinks in e (abs, min, max, ``sqrt(c**2 + s**2)``): everything is found for them too, but for
    proofs that need smoothness, and where something lies on a kink, its derivatives are the mean of the two sides. A
    formula must not jump in e, x or y: sign of these is refused, since a jump is a discontinuity set of codimension 1,
    with a sliding flow of its own. sign of slow variables and parameters is a number like any other.

    Raises
    ------
    ValueError
        Text cannot be read (`ExpressionError`: with the column), or a shape or a value is wrong.

    Examples
    --------
    >>> System(U=("2*c**2 - c - 1/2", "-s"), W=("-z",)).at(0.5).U((1.0, 0.5)).tolist()
    [0.5, -0.5]

    A table that is shaken:

    >>> shaken = System(U=("-mu*c + F*cos(w*t)", "-mu*s"), parameters={"mu": 0.3, "F": 0.5, "w": 2.0})
    >>> shaken.m, shaken.clock, shaken.at(0.0).U((0.0, -1.0)).tolist()
    (1, 'z1', [0.5, 0.3])
    """

    _internal_: ClassVar[frozenset[str]] = frozenset(
        {
            "coefficients",
            "frozen",
            "is_affine",
            "jacobian",
            "meanings",
            "moves_with_z",
            "numbers",
            "reads_position",
            "rows",
            "typed",
            "value_of",
            "varied",
            "without_clock",
        }
    )
    frozen: ClassVar[bool] = False
    coefficients: ClassVar[tuple[str, ...]] = ()

    def evolve(self, **changes: Any) -> System:
        """Return the same system with some parameters (by name), or U, W, parameters, definitions, changed."""
        parameters = dict(self.parameters)
        fields: dict[str, Any] = {}
        for name, value in changes.items():
            if name in parameters:
                parameters[name] = parameter(name, value)
            elif name in ("U", "W", "parameters", "definitions"):
                fields[name] = value
            else:
                allowed = ", ".join([*parameters, "U", "W", "parameters", "definitions"])
                raise ValueError(f"{name!r} is no parameter of this system; it has {allowed}.")
        if fields:
            fields = dict(zip("UW", self.without_clock, strict=True)) | fields
            return replace(self, **{"parameters": parameters, **fields})
        copy = object.__new__(System)  # only numbers change: nothing is read again
        copy.__dict__.update(self.__dict__)
        copy.__dict__["parameters"] = Parameters(parameters)
        return copy

    @property
    def equations(self) -> Equations:
        """Left and right sides of (2.7), ("x", ...), ("y", ...), ("z1", ...): what is typed in t is written in t."""
        U, W = self.without_clock
        return with_left_sides((*U, *W))

    @property
    def meanings(self) -> dict[str, Expression]:
        """The definitions as formulas, by name."""
        given = {"parameters": self.parameters, "definitions": dict(self.definitions)}
        return {name: System(U=(name, "0"), **given).without_clock[0][0] for name in given["definitions"]}

    def _repr_latex_(self) -> str:
        return equations_latex(self)

    def __repr__(self) -> str:
        U, W = ([row.text for row in rows] for rows in self.without_clock)
        given = [f"U={tuple(U)}", *([f"W={tuple(W)}"] if W else [])]
        given += [f"parameters={dict(self.parameters)}"] if self.parameters else []
        return f"System({', '.join(given)})"

    def __str__(self) -> str:
        return equations_text(self.equations, self.parameters)

    @property
    def typed(self) -> System:
        """Itself."""
        return self

    @property
    def variable(self) -> tuple[str, ...]:
        """Names of what `varied` changes: the parameters."""
        return tuple(self.parameters)

    def varied(self, name: str, value: float) -> System:
        """Return the same system with one of `variable` changed."""
        return self.evolve(**{name: value})

    def value_of(self, name: str) -> float:
        """Present value of one of `variable`."""
        return self.parameters[name]

    def at(self, z: ArrayLike = ()) -> Frozen:
        """Freeze at z.

        Parameters
        ----------
        z : (m,) floats
            May be left out if no formula depends on it; t, the last where there is a `clock`, also else: it is 0 then.

        Raises
        ------
        ValueError
            z has the wrong length, or U is not finite somewhere on the hemisphere.
        """
        if self.clock and np.size(np.asarray(z, object)) == self.m - 1:
            z = (*np.ravel(z).tolist(), 0.0)
        used = any(name in SLOW_NAMES for row in (*self.U, *self.W) for name in row.names)
        frozen = Frozen(self, slow_values(z, self.m, needed=used))
        frozen.size  # noqa: B018 (raises where U is not finite)
        return frozen
