"""U, W and their derivatives as plain Python functions of numbers, generated from a system's formulas.

A simulation calls them some thousand times at one point each: straight-line code takes a microsecond, and costs a
millisecond to make, so that no compiler has to be waited for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from dataclasses import field as made_with
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from ...formulas.expression import Expression, parse
from ...formulas.functions import called
from ...formulas.names import FAST_NAMES, SLOW_NAMES
from ...formulas.source import program
from ...formulas.switches import Branch, branch_at, has_switches
from ...results.arrays import Array
from ...systems.coefficients import Coefficients
from ...systems.elinear import ELinear
from ...systems.kinds import AnySystem
from ...systems.typed import System
from ...systems.typed_at_z import Frozen
from ...systems.typed_formulas import Formulas

ONE_SIDED_DISTANCE = 1e-9


def _state_names(m: int) -> tuple[str, ...]:
    return (*FAST_NAMES[2:], *SLOW_NAMES[:m])


@dataclass(frozen=True, eq=False)
class Field:
    """U and W of (2.7) as functions of numbers."""

    m: int  # the number of slow variables
    rows: tuple[Expression, ...]  # the formulas of U and W
    # ``value(c, s, x, y, *z)`` is the tuple (U1, U2, W1, ..., Wm); NaNs where a formula has a pole
    value: Callable[..., tuple[float, ...]]
    # ``slope(c, s, x, y, *z)`` is the flat tuple of its exact derivatives by all arguments, row by row
    slope: Callable[..., tuple[float, ...]]
    branch: Branch = made_with(default_factory=Branch)  # its guards are positive as long as the rows hold
    whole: Field | None = None  # the field that this is a branch of

    def __reduce__(self) -> tuple[Any, ...]:
        """Be pickled by the formulas, of which the functions are made again."""
        return _make_field, (self.rows, self.m)

    @cached_property
    def switches(self) -> bool:
        """Whether its formulas have kinks or jumps in the state: each branch is then followed by itself."""
        return has_switches(self.rows, _state_names(self.m))

    def on_branch(self, e: Sequence[float], state: Sequence[float], known: Sequence[int] = ()) -> Field:
        """Return the smooth branch of the formulas at e (2,) and a state (2 + m,); on a border the one ahead."""
        if not self.switches:
            return self
        names, rates = _state_names(self.m), self.value(*e, *state)
        found = branch_at(self.rows, names, self.values(e, state), dict(zip(names, rates, strict=True)), known)
        return _branch_field(found, self)

    def values(self, e: Sequence[float], state: Sequence[float]) -> dict[str, float]:
        """Return the values of all names at e and a state."""
        return dict(zip((*FAST_NAMES[:2], *_state_names(self.m)), (*e, *state), strict=True))

    def jumps_by_time(self, switch: int) -> bool:
        """Whether a switch of this branch depends on slow variables of constant rate alone."""
        rates = dict(zip(SLOW_NAMES, self.rows[2:], strict=False))
        guard = self.branch.guards[switch]
        return all(name in rates and rates[name].constant is not None for name in guard.names)

    def past_switch(self, switch: int, e: Sequence[float], state: Sequence[float]) -> Field | None:
        """Return the branch that follows this one of a field past a switch; None if that leads back at once."""
        before, whole = self.branch, self.whole
        assert whole is not None
        after = whole.on_branch(e, state)
        if after.branch.choices[: switch + 1] == before.choices[: switch + 1]:
            # Rounding hides that it has changed, or the guard touches 0 with a rate of 0.
            other = before.next_choice(switch, self.values(e, state))
            after = whole.on_branch(e, state, (*before.choices[:switch], other))
        rates = dict(zip(_state_names(self.m), after.value(*e, *state), strict=True))
        return None if after.branch.returns_to(before, switch, self.values(e, state), rates) else after

    @cached_property
    def rests(self) -> bool:
        """Whether U = 0 at x = y = 0 and e = 0 for every z, as its formulas say."""
        rows, zero = list(self.rows[:2]), _constant(0.0)
        for name in FAST_NAMES:
            rows = [row.substitute(name, zero) if name in row.names else row for row in rows]
        return all(row.constant == 0.0 for row in rows)

    @cached_property
    def system(self) -> System:
        """Its formulas as a system."""
        return System(U=self.rows[:2], W=self.rows[2:])

    @cached_property
    def is_affine(self) -> bool:
        """Whether U is affine in e for what its formulas say."""
        return not any({"c", "s"} & set(row.derivative(name).names) for row in self.rows[:2] for name in ("c", "s"))

    def jacobian(self, c: float, s: float, x: float, y: float, z: Sequence[float]) -> Array:
        """``D (U, W)`` by (c, s, x, y, z), of shape (2 + m, 4 + m).

        Where it is undefined, as that of abs(c) at 0, it is taken a rounding away; and as zero where that is no better.
        """
        arguments = (c, s, x, y, *z)
        slopes = np.array(self.slope(*arguments))
        if not np.isfinite(slopes).all():
            slopes = np.array(self.slope(*(value + ONE_SIDED_DISTANCE * (1.0 + abs(value)) for value in arguments)))
            slopes = np.nan_to_num(slopes, posinf=0.0, neginf=0.0)
        return slopes.reshape(2 + self.m, 4 + self.m)


@lru_cache(maxsize=32)
def _of_hashable(system: ELinear | System | Frozen) -> Field:
    return _make_field(rows_of(system), system.m)


def _coefficients_rows(system: Coefficients, kept: Sequence[str] = ()) -> list[Expression]:
    a, b, d, f1, f2 = (
        parse(name, (name,)) if name in kept else value
        for name, value in zip(Coefficients.variable, (system.a, system.b, system.d, system.f1, system.f2), strict=True)
    )
    return _affine_rows((a, b, d), (f1, f2), system.B.tolist(), system.g.tolist(), (1.0, 0.0))


def field(system: AnySystem) -> Field:
    """U and W of any system as functions of numbers; made once for each system.

    Raises ValueError: An ELinear made `from_matrix` whose rotation into the normal form depends on z: its axes turn
    with z.
    """
    if isinstance(system, Coefficients):
        return _make_field(_coefficients_rows(system), len(system.g))
    return _of_hashable(system)


def backwards(formulas: Field) -> Field:
    """Return the field of the same motions run backwards: -U and -W."""
    return _reverse_field(formulas.rows, formulas.m)


@lru_cache(maxsize=64)
def _branch_field(branch: Branch, whole: Field) -> Field:
    return replace(_make_field(branch.rows, whole.m), branch=branch, whole=whole)


@lru_cache(maxsize=32)
def _reverse_field(rows: tuple[Expression, ...], m: int) -> Field:
    return _make_field([_fill_template("-r", r=row) for row in rows], m)


def backwards_system(system: AnySystem) -> System:
    """Return a system whose motions are those of another one, run backwards."""
    return backwards(field(system)).system


def rows_of(system: AnySystem, kept: Sequence[str] = ()) -> list[Expression]:
    """Return the formulas of U and W, in which some of the system's numbers keep their names.

    Raises ValueError: As `field`; also where A is given as a matrix and a name is kept of which it is made.
    """
    if isinstance(system, Coefficients):
        return _coefficients_rows(system, kept)
    if isinstance(system, ELinear):
        return _elinear_rows(system, kept)
    rows = _system_rows(system.typed, kept)
    for name, value in zip(SLOW_NAMES, getattr(system, "z", ()), strict=False):  # of one that is frozen
        rows = [row.substitute(name, _constant(value)) for row in rows]
    return rows


def _constant(value: float) -> Expression:
    return parse(repr(float(value)), ())


def _system_rows(system: Formulas, kept: Sequence[str] = ()) -> list[Expression]:
    rows = [*system.U, *(system.W or [_constant(0.0)] * system.m)]
    return _with_parameters(rows, [pair for pair in system.parameters.items() if pair[0] not in kept])


def _with_parameters(rows: Sequence[Expression], parameters: Sequence[tuple[str, float]]) -> list[Expression]:
    values = [(name, _constant(value)) for name, value in parameters]
    found = []
    for row in rows:
        for name, value in values:
            row = row.substitute(name, value) if name in row.names else row
        found.append(row)
    return found


def _elinear_rows(system: ELinear, kept: Sequence[str] = ()) -> list[Expression]:
    values = [pair for pair in system.parameters.items() if pair[0] not in kept]

    def as_expression(value: Any, name: str = "") -> Expression:
        if name in kept:
            return parse(name, (name,))
        expression = value if isinstance(value, Expression) else _constant(value)
        expression = _with_parameters([expression], values)[0]
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
        still = ELinear.from_matrix(np.array(entries, float)).at()
        abd, axes = [still.a, still.b, still.d], (math.cos(still.rotation), math.sin(still.rotation))
    return _affine_rows(abd, f, B, g, axes)


def _affine_rows(
    abd: Sequence[Any], f: Sequence[Any], B: Sequence[Any], g: Sequence[Any], axes: Any
) -> list[Expression]:
    """Rows of ``A e + R f`` and ``B R^T e + g``, R the rotation by the angle whose cosine and sine are `axes`."""
    a, b, d = abd
    k, n = axes
    rows = [
        _fill_template("a*c - b*s + (k*u - n*v)", a=a, b=b, k=k, n=n, u=f[0], v=f[1]),
        _fill_template("b*c + d*s + (n*u + k*v)", b=b, d=d, k=k, n=n, u=f[0], v=f[1]),
    ]
    rows += [
        _fill_template("(k*u - n*v)*c + (n*u + k*v)*s + w", k=k, n=n, u=row[0], v=row[1], w=last)
        for row, last in zip(B, g, strict=True)
    ]
    return rows


def _fill_template(template: str, **values: Any) -> Expression:
    # Capitals: the values' own names c, s, z1 … must not be taken for placeholders.
    for name in values:
        template = template.replace(name, name.upper())
    row = parse(template, (*FAST_NAMES, *(name.upper() for name in values)))
    for name, value in values.items():
        row = row.substitute(name.upper(), value if isinstance(value, Expression) else _constant(value))
    return row


def _make_field(rows: Sequence[Expression], m: int) -> Field:
    names = (*FAST_NAMES, *SLOW_NAMES[:m])
    slopes = [row.derivative(name) for row in rows for name in names]
    return Field(m, tuple(rows), function_of(rows, names), function_of(slopes, names))


def function_of(rows: Sequence[Expression], names: Sequence[str]) -> Callable[..., tuple[float, ...]]:
    """Return formulas as one function of numbers, in the order of their names; NaNs where one has a pole."""
    statements, results = program(rows)
    body = "\n        ".join([*statements, f"return ({', '.join(results)},)"])
    source = (
        f"def function({', '.join(names)}):\n    try:\n        {body}\n"
        f"    except (ArithmeticError, ValueError):\n        return beyond({', '.join(names)})\n"
    )

    def ieee_values(*values: float) -> tuple[float, ...]:
        """Return what IEEE arithmetic, which goes on past inf, makes of them, as in machine code."""
        known = dict(zip(names, values, strict=True))
        found = (float(row.evaluate({name: known[name] for name in row.names})) for row in rows)
        return tuple(value if math.isfinite(value) else math.nan for value in found)

    scope: dict[str, Any] = {"math": math, "beyond": ieee_values, **called}
    exec(source, scope)  # written by `program`: its own names, numbers and math.* only
    return scope["function"]
