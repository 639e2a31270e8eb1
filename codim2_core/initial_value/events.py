"""Events of a motion: zeros of functions of its time and state, found in the dense output of each step."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Array
from ..numerics.radau import Step, truncate_step
from ..numerics.root_between import root_between

DEGREES = (8, 16, 32, 64)  # of the polynomials tried for an event along a step
RESOLVED = 1e-7  # last coefficients, in units of the largest, from which on a polynomial is taken for the event
TOUCH = 1e-13  # of the largest value along a step: an extremum that close to zero is one


@dataclass(frozen=True)
class Event:
    """Something to watch for.

    Attributes
    ----------
    function : callable
        (t, state) to a number, whose zeros are the event; state is (x, y, z1, ..., zm).
    direction : int
        +1 counts rising zeros only, -1 falling ones, 0 both.
    terminal : bool
        Whether the motion stops there.
    reason : str
        Sentence that the status of a motion that stops there ends with.
    """

    function: Callable[[float, Array], float]
    direction: int = 0
    terminal: bool = False
    reason: str = ""

    def __post_init__(self) -> None:
        """Check what can be checked before a motion."""
        if not callable(self.function):
            raise ValueError(
                f"an event's function is {reprlib.repr(self.function)}; give a callable (t, state) to a number."
            )
        if self.direction not in (-1, 0, 1):
            raise ValueError(
                f"an event's direction is {reprlib.repr(self.direction)}; give +1 (rising), -1 (falling) or 0 (both)."
            )
        if not isinstance(self.terminal, bool | np.bool_):
            raise ValueError(f"an event's terminal is {reprlib.repr(self.terminal)}; give True or False.")


def reverse_event(event: Event) -> Event:
    """Return the same event for a motion that runs backwards in time, by the time -t."""
    return Event(lambda t, state: event.function(-t, state), -event.direction, event.terminal, event.reason)


Events = Sequence[Event | Callable[[float, Array], float]]


def checked_events(events: Any) -> tuple[Event, ...]:
    """Check what was given as events: a sequence of `Event` or of callables; one alone counts as a sequence."""
    if isinstance(events, Event) or callable(events):
        events = (events,)
    try:
        given = tuple(events)
    except TypeError as error:
        raise ValueError(
            f"events is {reprlib.repr(events)}; give a sequence of Event, or of callables (t, state)."
        ) from error
    return tuple(event if isinstance(event, Event) else Event(event) for event in given)


class EventWatch:
    """Events under watch along a motion.

    Parameters
    ----------
    events : sequence of Event
    t : float
    state : ndarray (2 + m,)
        Where it starts; an event that is zero there does not count.
    """

    def __init__(self, events: Sequence[Event], t: float, state: Array) -> None:
        self.events = events
        self.times: list[list[float]] = [[] for _ in events]
        self.reason = ""  # why it has stopped
        self.before = [self.value(i, t, state) for i in range(len(events))]

    def value(self, i: int, t: float, state: Array) -> float:
        """Value of event i, which must be a finite number."""
        found = self.events[i].function(t, state)
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
        u, values = monotone_fractions(along, start, self.before[i])
        found: list[tuple[float, bool]] = []
        for low, high, at_low, at_high in zip(u, u[1:], values, values[1:], strict=False):
            if at_low < 0.0 <= at_high or at_low > 0.0 >= at_high:
                found.append((_root(along, low, high, at_high), at_low < 0.0))
        return found


def monotone_fractions(
    along: Callable[[float], float], start: float, end: float, degrees: Sequence[int] = DEGREES
) -> tuple[list[float], list[float]]:
    """Return fractions of a step, between which a function along it is monotone, and its values there."""
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
    else:  # a corner, or a jump: the nodes themselves
        return nodes.tolist(), values.tolist()
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
