"""The equations of a system as formulas, and as text."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from ..formulas.expression import Expression, parse
from ..formulas.latex import latex_formula, latex_symbol
from ..formulas.names import FAST_NAMES, SLOW_NAMES

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
