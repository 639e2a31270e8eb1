"""Formulas as mathematics: MathML that every present browser draws itself, with no script and no font to fetch."""

from __future__ import annotations

import re

from latex2mathml.converter import convert

from codim2_core.formulas.latex import GREEK
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.equations import latex_sides
from codim2_core.systems.typed import System

_CELL = '<mtd style="text-align:{}">{}</mtd>'


def plain_symbol(name: str) -> str:
    """Return a name as plain text: Greek letters, and digits at the end as an index."""
    match = re.fullmatch(r"([A-Za-z]+?)_?(\d*)", name)
    if match is None:
        return name
    return GREEK.get(match[1], match[1]) + match[2].translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))


def mathml(latex: str) -> str:
    """Return a formula as MathML, without the ``<math>`` around it."""
    return re.sub(r"^<math[^>]*>|</math>$", "", convert(latex))


def equations_mathml(system: ELinear | System) -> str:
    """Return a MathML table of a system's equations, and of its definitions."""
    rows = "".join(
        f"<mtr>{_CELL.format('right', mathml(left))}<mtd><mo>=</mo></mtd>{_CELL.format('left', mathml(right))}</mtr>"
        for left, right in latex_sides(system)
    )
    return f'<math display="block"><mtable displaystyle="true">{rows}</mtable></math>'
