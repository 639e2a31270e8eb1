"""U and W of a system as formulas in c, s, x, y and its slow variables, its numbers put in."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ..formulas.expression import Expression, parse
from ..formulas.names import FAST_NAMES, SLOW_NAMES


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


def elinear_rows(system: Any, kept: Sequence[str]) -> list[Expression]:
    """Return the rows of an `ELinear`, as `ELinear.rows` says."""
    values = [pair for pair in system.parameters.items() if pair[0] not in kept]

    def as_expression(value: Any, name: str = "") -> Expression:
        if name in kept:
            return parse(name, (name,))
        expression = value if isinstance(value, Expression) else constant(value)
        expression = with_numbers([expression], values)[0]
        return expression.substitute("z", parse("z1", SLOW_NAMES)) if "z" in expression.names else expression

    f = [as_expression(value, name) for name, value in zip(("f1", "f2"), system.f, strict=True)]
    B = [[as_expression(value) for value in row] for row in system.B or [(0.0, 0.0)] * system.m]
    g = [as_expression(value) for value in system.g or [0.0] * system.m]
    abd: list[Any] = [
        as_expression(value, name) for name, value in zip("abd", (system.a, system.b, system.d), strict=True)
    ]
    axes = (1.0, 0.0)
    if system.given_matrix is not None:
        entries = [[as_expression(value).constant for value in row] for row in system.given_matrix]
        if any(entry is None for row in entries for entry in row):
            if any(name in kept for row in system.given_matrix for value in row for name in as_expression(value).names):
                raise ValueError(
                    "A is made of the parameters named, and its rotation into the normal form turns with them: "
                    "give the system as System(U=..., W=...) in fixed axes."
                )
            raise ValueError(
                "A depends on z, and its rotation into the normal form would turn the axes of (x, y) with it: "
                "nothing to simulate in. Give the system as System(U=..., W=...) in fixed axes."
            )
        still = system.from_matrix(np.array(entries, float)).at()
        abd, axes = [still.a, still.b, still.d], (math.cos(still.rotation), math.sin(still.rotation))
    return affine_rows(abd, f, B, g, axes)


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
