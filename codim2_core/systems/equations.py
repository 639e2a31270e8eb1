"""The equations of a system as formulas, with numbers put in, and as text."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib import import_module
from typing import Any, Self, cast

import numpy as np
from numpy.typing import ArrayLike

from ..formulas.expression import Expression, parse
from ..formulas.latex import latex_formula, latex_symbol
from ..formulas.names import FAST_NAMES, MOST_SLOW_VARIABLES, SLOW_NAMES, TIME
from ..results.arrays import Array

Rows = tuple[Expression, ...]
Sides = tuple[tuple[str, str], ...]


def latex_sides(system: Any) -> Sides:
    """Return left and right sides of a system's equations, and then of its definitions, as LaTeX."""
    alone = system.m - bool(system.clock) == 1  # no other slow variable but t

    def plain(formula: Expression) -> Expression:
        return formula.substitute("z1", parse("z", ("z",))) if alone and "z1" in formula.names else formula

    meanings = {plain(meaning): name for name, meaning in system.meanings.items()}
    rows = [
        (latex_symbol("z" if alone and left == "z1" else left, dot=True), latex_formula(plain(right), meanings))
        for left, right in system.equations
    ]
    for k, (meaning, name) in enumerate(meanings.items()):
        rows.append((latex_symbol(name), latex_formula(meaning, dict(list(meanings.items())[:k]))))
    return tuple(rows)


def equations_latex(system: Any) -> str:
    """Return a system's equations as aligned lines of LaTeX, as a notebook shows them."""
    lines = r" \\ ".join(f"{left} &= {right}" for left, right in latex_sides(system))
    return rf"$\begin{{aligned}} {lines} \end{{aligned}}$"


Equations = tuple[tuple[str, Expression], ...]


def with_left_sides(rows: Sequence[Expression]) -> Equations:
    """Return right-hand sides with their left sides: "x", "y", "z1", ..."""
    return tuple(zip(("x", "y", *SLOW_NAMES), rows, strict=False))


def with_clock(U: Rows, W: Rows) -> tuple[Rows, Rows, str]:
    """Return U and W with one more slow variable for t, the last, whose rate is 1, and its name."""
    named = max((SLOW_NAMES.index(name) + 1 for row in (*U, *W) for name in row.names if name in SLOW_NAMES), default=0)
    others = len(W) or named
    if others >= MOST_SLOW_VARIABLES:
        raise ValueError(f"t is one more slow variable; at most {MOST_SLOW_VARIABLES - 1} are allowed next to it.")
    if named > others:  # to be refused for that
        return U, W, ""
    clock = SLOW_NAMES[others]
    rows = W or (parse("0", ()),) * others
    U, W = (tuple(row.substitute(TIME, parse(clock, SLOW_NAMES)) for row in part) for part in (U, rows))
    return U, (*W, parse("1", ())), clock


def linear_rows(coefficients: Sequence[Sequence[Any]], parameters: Sequence[str], m: int) -> list[Expression]:
    """Return ``p c + q s + r`` for each (p, q, r), numbers or formulas; z is written z1 where there are several."""
    names = (*FAST_NAMES, "z", *SLOW_NAMES, *parameters, "A_", "B_", "C_")
    template = parse("A_*c + B_*s + C_", names)
    rows = []
    for row in coefficients:
        result = template
        for name, value in zip(("A_", "B_", "C_"), row, strict=True):
            part = value if isinstance(value, Expression) else parse(repr(value), names)
            result = result.substitute(name, part)
        rows.append(result.substitute("z", parse("z1", names)) if "z" in result.names and m > 1 else result)
    return rows


def negative(value: Any) -> Any:
    """Return -value, of a number or a formula."""
    return parse("-B_", ("B_", *value.names)).substitute("B_", value) if isinstance(value, Expression) else -value


def equations_text(equations: Equations, parameters: Mapping[str, float]) -> str:
    """Return equations as lines of text, and the values of their parameters."""
    lines = [f"{left}′ = {_without_brackets(right.text)}" for left, right in equations]
    return "\n".join([*lines, ", ".join(f"{name} = {value:g}" for name, value in parameters.items())]).rstrip()


def _without_brackets(text: str) -> str:
    """Return a sum without the brackets about its negative numbers."""
    return re.sub(r"\+ \((-[\d.e+-]+)\)", r"+ \1", re.sub(r"^\((-[\d.e+-]+)\)", r"\1", text)).replace("+ -", "- ")


def constant(value: float) -> Expression:
    """Return a number as a formula."""
    return parse(repr(float(value)), ())


def with_numbers(rows: Sequence[Expression], numbers: Iterable[tuple[str, float]]) -> list[Expression]:
    """Return formulas with numbers in the place of names."""
    values = [(name, constant(value)) for name, value in numbers]
    found = []
    for row in rows:
        for name, value in values:
            row = row.substitute(name, value) if name in row.names else row
        found.append(row)
    return found


def affine_rows(
    abd: Sequence[Any], f: Sequence[Any], B: Sequence[Any], g: Sequence[Any], axes: tuple[float, float] = (1.0, 0.0)
) -> list[Expression]:
    """Rows of ``A e + R f`` and ``B R^T e + g``, R the rotation by the angle whose cosine and sine are `axes`."""
    a, b, d = abd
    k, n = axes
    rows = [
        fill_template("a*c - b*s + (k*u - n*v)", a=a, b=b, k=k, n=n, u=f[0], v=f[1]),
        fill_template("b*c + d*s + (n*u + k*v)", b=b, d=d, k=k, n=n, u=f[0], v=f[1]),
    ]
    rows += [
        fill_template("(k*u - n*v)*c + (n*u + k*v)*s + w", k=k, n=n, u=row[0], v=row[1], w=last)
        for row, last in zip(B, g, strict=True)
    ]
    return rows


def fill_template(template: str, **values: Any) -> Expression:
    """Return a formula with formulas or numbers in the places of single letters."""
    # Capitals: the values' own names c, s, z1 … must not be taken for placeholders.
    for name in values:
        template = template.replace(name, name.upper())
    row = parse(template, (*FAST_NAMES, *(name.upper() for name in values)))
    for name, value in values.items():
        row = row.substitute(name.upper(), value if isinstance(value, Expression) else constant(value))
    return row


Regularisation = Callable[[Any], Any]


class Exchange:
    """A system as it is shown, and as other programs take it."""

    def _repr_latex_(self) -> str:
        return equations_latex(self)

    def __str__(self) -> str:
        own: Any = self
        return equations_text(own.equations, own.parameters)

    def varied(self, name: str, value: float) -> Self:
        """Return the same system with one of `variable` changed."""
        own: Any = self
        return own.evolve(**{name: value})

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
