"""The equations of a system as LaTeX."""

from __future__ import annotations

from typing import Any

from ..formulas.expression import Expression, parse
from ..formulas.latex import latex_formula, latex_symbol

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
