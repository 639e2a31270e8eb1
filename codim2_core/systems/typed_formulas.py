"""The formulas of a typed system, read and checked: U, W, parameters and definitions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from ..formulas.expression import Expression, parse
from ..formulas.names import FAST_NAMES, MOST_SLOW_VARIABLES, SLOW_NAMES, TIME, number_names
from .bounds import slow_names
from .parameters import Parameters
from .reading import continuous, mapping, parameter, parse_formula, short_repr, texts
from .reading import definitions as read_definitions
from .rows import constant, with_numbers

MOST_NUMBERS = 32  # parameters and slow variables that one system may read
MOST_NAMES = 64  # parameters and definitions of one system


Rows = tuple[Expression, ...]
_T = parse(TIME, (TIME,))


def with_clock(U: Rows, W: Rows) -> tuple[Rows, Rows, str]:
    """Return U and W with one more slow variable for t, the last, whose rate is 1, and its name.

    Time is a slow variable like any other for all that is known of them: a portrait is that of an instant, sliding
    follows it, a periodic motion is forced by it.
    """
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


@dataclass(frozen=True)
class Formulas:
    """U and W of (2.7) as formulas with numbers for their parameters, the parameters of `System`."""

    U: Any
    W: Any = ()
    parameters: Any = ()
    definitions: Any = ()
    # the slow variable that is t, the last one, where formulas read t; else ""
    clock: str = field(default="", init=False)

    def __post_init__(self) -> None:
        fix = object.__setattr__
        given, meanings = mapping(self.parameters, "parameters"), mapping(self.definitions, "definitions")
        if len(given) + len(meanings) > MOST_NAMES:
            raise ValueError(
                f"there are {len(given)} parameters and {len(meanings)} definitions; at most {MOST_NAMES} are allowed."
            )
        parameters = {name: parameter(name, value) for name, value in given.items()}
        definitions = read_definitions(meanings, tuple(parameters))
        fix(self, "parameters", Parameters(parameters))
        fix(self, "definitions", tuple((name, text) for name, text, _, _ in definitions))
        U = texts(self.U, "U")
        if len(U) != 2:
            raise ValueError(f"U is {short_repr(self.U)}; give two formulas (U1, U2).")
        formula = lambda text, what: parse_formula(text, what, tuple(parameters), definitions)
        plane = tuple(formula(text, f"U{i + 1}") for i, text in enumerate(U))
        W = texts(self.W, "W")
        if len(W) > MOST_SLOW_VARIABLES:
            raise ValueError(f"W has {len(W)} rows; at most {MOST_SLOW_VARIABLES} slow variables are allowed.")
        slow = tuple(formula(text, f"W{i + 1}") for i, text in enumerate(W))
        if TIME not in parameters and any(TIME in row.names for row in (*plane, *slow)):
            plane, slow, clock = with_clock(plane, slow)
            fix(self, "clock", clock)
        fix(self, "U", plane)
        fix(self, "W", slow)
        for what, rows in (("U", self.U), ("W", self.W)):
            for i, row in enumerate(rows):
                continuous(row, f"{what}{i + 1}")
        if len(self.numbers) > MOST_NUMBERS:
            raise ValueError(
                f"the system reads {len(self.numbers)} parameters and slow variables; at most {MOST_NUMBERS}."
            )
        self.m  # noqa: B018 (raises where W has too few rows)

    @property
    def without_clock(self) -> tuple[Rows, Rows]:
        """U and W as they were given: in t, and without the row of its clock."""
        if not self.clock:
            return self.U, self.W
        U, W = (tuple(row.substitute(self.clock, _T) for row in rows) for rows in (self.U, self.W[:-1]))
        return U, W

    @cached_property
    def m(self) -> int:
        """The number of slow variables."""
        rows = [(f"{what}{i}", row) for what, own in (("U", self.U), ("W", self.W)) for i, row in enumerate(own, 1)]
        named, first = max(
            ((SLOW_NAMES.index(name) + 1, box) for box, row in rows for name in row.names if name in SLOW_NAMES),
            default=(0, ""),
        )
        if self.W and named > len(self.W):
            raise ValueError(
                f"{first} names z{named}, but {slow_names(len(self.W), 'W')}, or give W {named} row{'s' * (named > 1)}."
            )
        return len(self.W) or named

    @cached_property
    def numbers(self) -> tuple[str, ...]:
        """Names of the slow variables and parameters that U reads: the arguments of its compiled field, in order."""
        return number_names(self.U)

    @cached_property
    def jacobian(self) -> tuple[tuple[Expression, Expression], tuple[Expression, Expression]]:
        """``D_(c,s) U`` as formulas, rows first; exact derivatives, not differences."""
        first, second = ((u.derivative("c"), u.derivative("s")) for u in self.U)
        return first, second

    def rows(self, kept: Sequence[str] = ()) -> list[Expression]:
        """U and W as formulas, in which some of the parameters keep their names."""
        rows = [*self.U, *(self.W or [constant(0.0)] * self.m)]
        return with_numbers(rows, [pair for pair in self.parameters.items() if pair[0] not in kept])

    @cached_property
    def is_affine(self) -> bool:
        """Whether U is affine in (c, s) for all parameters and slow variables, and free of x and y."""
        named = {name for row in self.jacobian for entry in row for name in entry.names}
        return not self.reads_position and named.isdisjoint(FAST_NAMES)

    @cached_property
    def moves_with_z(self) -> bool:
        """Whether U, and with it the whole portrait, may depend on z."""
        return any(name in SLOW_NAMES for u in self.U for name in u.names)

    @cached_property
    def reads_position(self) -> bool:
        """Whether U depends on x or y: then the outside differs from the hemisphere's continuation."""
        return any(name in ("x", "y") for u in self.U for name in u.names)
