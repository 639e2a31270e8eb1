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

from ...formulas.expression import Expression
from ...formulas.functions import called, known
from ...formulas.names import FAST_NAMES, SLOW_NAMES
from ...formulas.switches import Branch, branch_at, has_switches
from ...formulas.tape import BESIDE_ZERO, BESIDE_ZERO_SOURCE, FUNCTIONS_OF_TWO, Builder, Node
from ...results.arrays import Array
from ...systems.equations import constant, fill_template
from ...systems.kinds import AnySystem
from ...systems.typed import System


def program(rows: Sequence[Expression]) -> tuple[list[str], list[str]]:
    """Return statements ``t7 = t3*t4``, one for each distinct operation, and a name or a number for each formula."""
    build = Builder()
    roots = [_entry_of(build, row) for row in rows]
    shown, statements = list[str](), list[str]()
    for k, (op, *args) in enumerate(build.nodes):
        if op == "num":
            shown.append(f"({args[0]!r})" if args[0] < 0.0 else repr(args[0]))
        elif op == "name":
            shown.append(args[0])
        else:
            exponent = _integer(build.nodes[args[1]]) if op == "**" else None
            statements.append(f"t{k} = {_operation(op, [shown[i] for i in args], exponent)}")
            shown.append(f"t{k}")
    return statements, [shown[i] for i in roots]


def _entry_of(build: Builder, row: Expression) -> int:
    """Entry of a formula among those already there."""
    at: list[int] = []
    for op, *args in row.tape:
        if op == "num":
            at.append(build.number(args[0]))
        elif op == "name":
            at.append(build.name(args[0]))
        else:
            at.append(build.apply(op, *(at[i] for i in args)))
    return at[-1]


def _integer(node: Node) -> int | None:
    return int(node[1]) if node[0] == "num" and float(node[1]).is_integer() else None


def _operation(op: str, args: list[str], exponent: int | None) -> str:
    if op == "neg":
        return f"-{args[0]}"
    if op in FUNCTIONS_OF_TWO:
        return f"{op}({args[0]}, {args[1]})"
    if op == BESIDE_ZERO:
        return BESIDE_ZERO_SOURCE.format(*args)
    if len(args) == 1:
        return known[op].python_source(args[0])
    if op != "**":
        return f"{args[0]}{op}{args[1]}"
    if exponent is None:
        return f"math.sqrt({args[0]})" if args[1] == "0.5" else f"math.pow({args[0]}, {args[1]})"
    if exponent == 0:
        return "1.0"
    # A literal integer exponent becomes multiplications when compiled.
    return f"{args[0]}**{exponent}" if exponent > 0 else f"1.0/{args[0]}**{-exponent}"


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
        rows, zero = list(self.rows[:2]), constant(0.0)
        for name in FAST_NAMES:
            rows = [row.substitute(name, zero) if name in row.names else row for row in rows]
        return all(row.constant == 0.0 for row in rows)

    @cached_property
    def system(self) -> System:
        """Its formulas as a system."""
        return System(U=self.rows[:2], W=self.rows[2:])

    @cached_property
    def is_affine(self) -> tuple[bool, ...]:
        """Whether each row is affine in e for what its formulas say."""
        return tuple(not any({"c", "s"} & set(row.derivative(by).names) for by in ("c", "s")) for row in self.rows)

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
def field(system: AnySystem) -> Field:
    """U and W of any system as functions of numbers, made once; ValueError where the normal form's axes turn with z."""
    return _make_field(system.rows(), system.m)


def backwards(formulas: Field) -> Field:
    """Return the field of the same motions run backwards: -U and -W."""
    return _reverse_field(formulas.rows, formulas.m)


@lru_cache(maxsize=64)
def _branch_field(branch: Branch, whole: Field) -> Field:
    return replace(_make_field(branch.rows, whole.m), branch=branch, whole=whole)


@lru_cache(maxsize=32)
def _reverse_field(rows: tuple[Expression, ...], m: int) -> Field:
    return _make_field([fill_template("-r", r=row) for row in rows], m)


def backwards_system(system: AnySystem) -> System:
    """Return a system whose motions are those of another one, run backwards."""
    return backwards(field(system)).system


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


@dataclass(frozen=True, eq=False)
class Slopes:
    """U and W of (2.7) and their exact derivatives as functions of arrays."""

    m: int  # the number of slow variables
    kept: tuple[tuple[str, float], ...]  # numbers of the system by which it is also differentiated, with their values
    rows: tuple[Expression, ...]  # the formulas of U and W, (2 + m,)
    derivatives: tuple[tuple[Expression, ...], ...]  # theirs by (c, s, x, y, z1, ..., zm, kept), (2 + m, 4 + m + q)

    def rates(self, e: Array, states: Array) -> Array:
        """(U, W) (k, 2 + m) at e (k, 2) and states (k, 2 + m)."""
        values = self._values(e, states)
        return np.stack([np.broadcast_to(row.evaluate(values), len(e)) for row in self.rows], axis=-1)

    def at(self, e: Array, states: Array) -> Array:
        """Their derivatives (k, 2 + m, 4 + m + q) at e (k, 2) and states (k, 2 + m)."""
        values = self._values(e, states)
        found = np.zeros((len(e), 2 + self.m, 4 + self.m + len(self.kept)))
        for i, row in enumerate(self.derivatives):
            for j, slope in enumerate(row):
                if slope.constant != 0.0:
                    found[:, i, j] = slope.evaluate(values)
        return found

    def of_state(self, e: Array, De: Array, states: Array) -> Array:
        """Differentiate them (k, 2 + m, 2 + m + q) by (x, y, z) and the kept numbers; (x, y) moves e as De says."""
        slopes = self.at(e, states)
        found = slopes[:, :, 2:].copy()
        found[:, :, :2] += slopes[:, :, :2] @ De
        return found

    def _values(self, e: Array, states: Array) -> dict[str, Array | float]:
        columns = (*e.T, *states.T)
        return dict(zip((*FAST_NAMES, *SLOW_NAMES[: self.m]), columns, strict=True)) | dict(self.kept)


def slopes_of(system: AnySystem, kept: Sequence[str] = ()) -> Slopes:
    """Return the derivatives of any system's field; ValueError where a name is none of the system's."""
    for name in kept:
        if name not in system.variable:
            own = ", ".join(system.variable) or "none"
            raise ValueError(f"{name!r} is no number of this system; it has {own}.")
    rows = system.rows(kept)
    m = len(rows) - 2
    by = (*FAST_NAMES, *SLOW_NAMES[:m], *kept)
    derivatives = tuple(tuple(row.derivative(name) for name in by) for row in rows)
    return Slopes(m, tuple((name, system.value_of(name)) for name in kept), tuple(rows), derivatives)
