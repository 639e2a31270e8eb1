"""Events of a motion: zeros of functions of its time and state, found in the dense output of each step.

Every sign change of a typed event is found, by bounds. A callable is sampled at 8 places in each 64th of the span, and
more until a polynomial explains its variation: two zeros that are nearer than a 500th of the span may escape.
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...formulas.arrays import Program, path_program
from ...formulas.expression import Expression, parse
from ...formulas.names import FAST_NAMES, SLOW_NAMES, TIME
from ...numerics.along import MAX_ZEROS, zeros_along
from ...numerics.radau import Step, truncate_step
from ...numerics.sign_changes import root_between
from ...results.arrays import Array

DEGREES = (8, 16, 32, 64)  # of the polynomials tried for an event along a step
RESOLVED = 1e-7  # last coefficients, in units of the largest, from which on a polynomial is taken for the event
PIECES = 64  # of the span, in which a callable is sampled by itself
HALVINGS, HALF_DEGREES = 10, (8, 16)  # of a piece in which no polynomial explains it, and the degrees tried in these
TOUCH = 1e-13  # of the largest value along a step: an extremum that close to zero is one


@dataclass(frozen=True)
class Event:
    """Something to watch for.

    Attributes
    ----------
    function : callable, or text
        (t, state) to a number, whose zeros are the event; state is (x, y, z1, ..., zm). Or a formula in t, x, y, z1,
        ..., zm (z is z1), such as ``"sin(10*t)"``: none of its sign changes is missed.
    direction : int
        +1 counts rising zeros only, -1 falling ones, 0 both.
    terminal : bool
        Whether the motion stops there.
    reason : str
        Sentence that the status of a motion that stops there ends with.
    """

    function: Callable[[float, Array], float] | str
    direction: int = 0
    terminal: bool = False
    reason: str = ""

    def __post_init__(self) -> None:
        """Check what can be checked before a motion."""
        if isinstance(self.function, str):
            _event_formula(self.function)
        elif not callable(self.function):
            raise ValueError(
                f"an event's function is {reprlib.repr(self.function)}; give a formula, or a callable (t, state) to a "
                "number."
            )
        if self.direction not in (-1, 0, 1):
            raise ValueError(
                f"an event's direction is {reprlib.repr(self.direction)}; give +1 (rising), -1 (falling) or 0 (both)."
            )
        if not isinstance(self.terminal, bool | np.bool_):
            raise ValueError(f"an event's terminal is {reprlib.repr(self.terminal)}; give True or False.")


def _event_formula(text: str) -> Expression:
    """Read a typed event; its time is named c, the first variable of a path."""
    formula = parse(text, (TIME, "x", "y", "z", *SLOW_NAMES))
    return formula.substitute(TIME, parse("c", ("c",))).substitute("z", parse("z1", SLOW_NAMES))


def reverse_event(event: Event) -> Event:
    """Return the same event for a motion that runs backwards in time, by the time -t."""
    own = event.function
    if isinstance(own, str):
        function: Any = parse(own, (TIME, "x", "y", "z", *SLOW_NAMES)).substitute(TIME, parse("-t", ("t",))).text
    else:
        function = lambda t, state: own(-t, state)
    return Event(function, -event.direction, event.terminal, event.reason)


Events = Sequence[Event | str | Callable[[float, Array], float]]


def checked_events(events: Any) -> tuple[Event, ...]:
    """Check what was given as events: a sequence of `Event` or of callables; one alone counts as a sequence."""
    if isinstance(events, Event | str) or callable(events):
        events = (events,)
    try:
        given = tuple(events)
    except TypeError as error:
        raise ValueError(
            f"events is {reprlib.repr(events)}; give a sequence of Event, of formulas, or of callables (t, state)."
        ) from error
    return tuple(event if isinstance(event, Event) else Event(event) for event in given)


class EventWatch:
    """Events under watch along a motion."""

    def __init__(self, events: Sequence[Event], span: tuple[float, float], state: Array) -> None:
        self.events, self.span, t = events, abs(span[1] - span[0]), span[0]
        self.formulas = [self._formula(event, len(state)) for event in events]
        self.times: list[list[float]] = [[] for _ in events]
        self.reason = ""  # why it has stopped
        self.before = [self.value(i, t, state) for i in range(len(events))]

    def _formula(self, event: Event, n: int) -> Expression | None:
        """Return the formula of a typed event; None for a callable."""
        if not isinstance(event.function, str):
            return None
        formula = _event_formula(event.function)
        missing = [name for name in formula.names if name in SLOW_NAMES and SLOW_NAMES.index(name) >= n - 2]
        if missing:
            raise ValueError(f"the event {event.function!r} names {missing[0]}; this system has m = {n - 2}: z1 to zm.")
        return formula

    def value(self, i: int, t: float, state: Array) -> float:
        """Value of event i, which must be a finite number."""
        function, formula = self.events[i].function, self.formulas[i]
        if formula is not None or isinstance(function, str):
            found: Any = math.nan if formula is None else float(formula.evaluate(_event_values(t, state)))
        else:
            found = function(t, state)
        if isinstance(found, bool | np.bool_):
            raise ValueError(
                f"event {i + 1} returned the truth value {found}; return a number that changes its sign, such as "
                "s[2] - 30 for s[2] > 30."
            )
        if type(found) is not float:
            try:
                array = np.asarray(found, float)
            except (TypeError, ValueError) as error:
                raise ValueError(f"event {i + 1} returned {found!r} at t = {t:.6g}; return a number.") from error
            if array.shape not in ((), (1,)):
                raise ValueError(
                    f"event {i + 1} returned an array of shape {array.shape} at t = {t:.6g}; return one number, "
                    "and give an event for each."
                )
            found = float(array.reshape(()))
        if not math.isfinite(found):
            raise ValueError(
                f"event {i + 1} returned {found} at t = {t:.6g}, state {state.tolist()}; its zeros cannot be found "
                "from there: return a finite number at every state of the motion."
            )
        return found

    def step(self, step: Step) -> Step | None:
        """Look along one step; return its part up to the first terminal event, or None if there is none."""
        zeros: list[tuple[float, int]] = []
        for i, event in enumerate(self.events):
            zeros += [(u, i) for u, rises in self.zeros(i, step) if event.direction in (0, 1 if rises else -1)]
        end = min((u for u, i in zeros if self.events[i].terminal), default=None)
        for u, i in sorted(zeros):
            if end is None or u <= end:
                self.times[i].append(step.start + u * step.h)
        if end is None:
            return None
        last = [self.events[i].reason for u, i in zeros if u == end and self.events[i].terminal]
        self.reason = " ".join(filter(None, last))
        return step if end == 1.0 else truncate_step(step, end)

    def zeros(self, i: int, step: Step) -> list[tuple[float, bool]]:
        """Zeros of event i along a step: as fraction of the step, and whether it rises there."""
        along = lambda u: self.value(i, step.start + u * step.h, step.last if u == 1.0 else step.at(u))
        start, self.before[i] = self.before[i], along(1.0)
        formula = self.formulas[i]
        if formula is not None:
            return _formula_zeros(path_program((formula,)), step)
        pieces = max(1, math.ceil(PIECES * step.h / self.span))
        u, values = [0.0], [start]
        for k in range(pieces):
            low, high = k / pieces, (k + 1) / pieces
            end = self.before[i] if k + 1 == pieces else along(high)
            part, at = monotone_fractions(
                lambda v, low=low, high=high: along(low + v * (high - low)), values[-1], end, halvings=HALVINGS
            )
            u += [low + v * (high - low) for v in part[1:]]
            values += at[1:]
        u[-1] = 1.0
        found: list[tuple[float, bool]] = []
        for low, high, at_low, at_high in zip(u, u[1:], values, values[1:], strict=False):
            if at_low < 0.0 <= at_high or at_low > 0.0 >= at_high:
                found.append((_root(along, low, high, at_high), at_low < 0.0))
        return found


def _event_values(t: float, state: Array) -> dict[str, float]:
    return {"c": t, **dict(zip((*FAST_NAMES[2:], *SLOW_NAMES), state.tolist(), strict=False))}


def _formula_zeros(program: Program, step: Step) -> list[tuple[float, bool]]:
    """Return the fractions of a step at which a typed event changes its sign, and whether it rises there."""
    n, d = step.polynomial.shape
    path, found = np.zeros((2 + n, 1 + d)), np.empty((MAX_ZEROS, 2))
    path[0, 0], path[0, 1] = step.start, step.h
    path[2:, 0], path[2:, 1:] = step.first, step.polynomial
    count = zeros_along(*program.arrays, path, 0, False, found)
    if count < 0:
        raise ValueError("a typed event is 0 at too many times to be found; give one that is 0 at single times.")
    return [(u, rises > 0.0) for u, rises in found[:count].tolist()]


def monotone_fractions(
    along: Callable[[float], float], start: float, end: float, degrees: Sequence[int] = DEGREES, halvings: int = 0
) -> tuple[list[float], list[float]]:
    """Return fractions of a step between which a function is monotone, and its values there."""
    nodes, values, polynomial, size = np.empty(0), np.empty(0), np.empty(0), 0.0
    for degree in degrees:
        nodes = 0.5 - 0.5 * np.cos(math.pi * np.arange(degree + 1) / degree)
        values = np.array([start, *(along(u) for u in nodes[1:-1].tolist()), end])
        polynomial = chebyshev_coefficients(values)
        size = float(np.abs(values).max())
        if abs(polynomial[0]) > 2.0 * float(np.abs(polynomial[1:]).sum()):  # far from zero all along
            return [0.0, 1.0], [start, end]
        if np.abs(polynomial[-2:]).max() <= RESOLVED * size:
            break
    else:  # a corner, or a jump, or too many waves
        if not halvings:
            return nodes.tolist(), values.tolist()
        middle = along(0.5)
        first = monotone_fractions(lambda u: along(0.5 * u), start, middle, HALF_DEGREES, halvings - 1)
        last = monotone_fractions(lambda u: along(0.5 + 0.5 * u), middle, end, HALF_DEGREES, halvings - 1)
        return [0.5 * u for u in first[0]] + [0.5 + 0.5 * u for u in last[0][1:]], first[1] + last[1][1:]
    from numpy.polynomial import chebyshev  # imported late: most motions need none

    roots = chebyshev.chebroots(chebyshev.chebder(chebyshev.chebtrim(polynomial, 1e-15 * size)))
    inside = np.unique(0.5 + 0.5 * roots.real[(np.abs(roots.imag) < 1e-3) & (np.abs(roots.real) < 1.0)])
    u = [0.0, *inside.tolist(), 1.0]
    at = [start, *(along(x) for x in inside.tolist()), end]
    return u, [0.0 if abs(v) <= TOUCH * size and 0 < k < len(u) - 1 else v for k, v in enumerate(at)]


def chebyshev_coefficients(values: Array) -> Array:
    """Chebyshev coefficients of the polynomial through values at the nodes -cos(pi k/n)."""
    n = len(values) - 1
    k = np.arange(n + 1)
    weights = np.ones(n + 1)
    weights[[0, -1]] = 0.5
    cosines = np.cos(math.pi * np.outer(k, n - k) / n)
    found = 2.0 / n * (cosines @ (weights * values))
    found[[0, -1]] *= 0.5
    return found


def _root(along: Callable[[float], float], low: float, high: float, at_high: float) -> float:
    if at_high == 0.0 or along(high) == 0.0:
        return high
    return root_between(along, low, high, 1e-15)
