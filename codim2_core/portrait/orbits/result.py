"""The result of integrating trajectories: lines of the picture, their times, and why each one ended."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...results.result import Pictured, column_rows
from ...results.tables import html_table
from ...results.words import say


class Status(Enum):
    """The reason why a trajectory ended; the value is the sentence shown."""

    T_MAX = say("reached t_max")
    EQUILIBRIUM = say("reached an equilibrium")
    LEFT_VIEW = say("left the view")
    ARRIVED = say("arrives")
    SPIRALLED = say("spirals")
    ON_EQUATOR = say("on the equator, from the start")
    STEP_LIMIT = say("too many steps")
    LENGTH = say("full length")


STATUSES = tuple(Status)  # in the order of the codes of `stepping`


@dataclass(frozen=True, eq=False)
class Trajectories(Pictured):
    """Trajectories as polylines of the picture. All arrays are read-only; the lists are views of `buffer` and `clock`.

    Attributes
    ----------
    buffer : ndarray (N, 2)
        Points of all trajectories, one after the other: p on the hemisphere, (1 + rho) p outside.
    clock : ndarray (N,)
        The time T (dT = dt/rho) at each point, 0 at the seed; decreasing along trajectories followed backward.
    offsets : ndarray (k + 1,) of int
        Trajectory i is ``buffer[offsets[i]:offsets[i + 1]]``.
    ends : ndarray (k, 3)
        The last state (p_x, p_y, w) to full relative accuracy: w = ebar on the hemisphere, rho outside.
    codes : ndarray (k,) of int
        Place in `STATUSES` of why each one ended.
    evaluations : int
        Evaluations of the field, over all trajectories.
    """

    buffer: Array = field(repr=False)
    clock: Array = field(repr=False)
    offsets: NDArray[np.int64] = field(repr=False)
    ends: Array = field(repr=False)
    codes: NDArray[np.int64] = field(repr=False)
    evaluations: int = 0

    def __post_init__(self) -> None:
        for array in (self.buffer, self.clock, self.offsets, self.ends, self.codes):
            array.flags.writeable = False

    def __repr__(self) -> str:
        ends = Counter(one.value for one in self.status)
        listed = "; ".join(f"{count}: {end}" for end, count in ends.most_common())
        return f"<{len(self)} trajectories, {self.evaluations} evaluations. {listed}>"

    def _tables_(self) -> str:
        ends = Counter(one.value for one in self.status)
        found = [(end, str(count)) for end, count in ends.most_common()]
        return html_table(("why it ended", "trajectories"), found)

    def _records(self) -> Iterator[dict[str, Any]]:
        which = np.repeat(np.arange(len(self)), np.diff(self.offsets))
        return column_rows({"trajectory": which, "T": self.clock, "x": self.buffer[:, 0], "y": self.buffer[:, 1]})

    def __iter__(self) -> Iterator[Array]:
        return iter(self.points)

    def __getitem__(self, i: int) -> Array:
        return self.points[i]

    def __len__(self) -> int:
        return len(self.codes)

    @cached_property
    def points(self) -> list[Array]:
        """One (m, 2) array a trajectory."""
        at = self.offsets.tolist()
        return [self.buffer[i:j] for i, j in itertools.pairwise(at)]

    @cached_property
    def times(self) -> list[Array]:
        """One (m,) array a trajectory."""
        at = self.offsets.tolist()
        return [self.clock[i:j] for i, j in itertools.pairwise(at)]

    @cached_property
    def status(self) -> tuple[Status, ...]:
        """Return the reason why each one ended."""
        return tuple(STATUSES[code] for code in self.codes.tolist())


def concatenate(parts: Sequence[Trajectories]) -> Trajectories:
    """Several results as one, in order."""
    if not parts:
        return Trajectories(
            np.empty((0, 2)), np.empty(0), np.zeros(1, np.int64), np.empty((0, 3)), np.empty(0, np.int64)
        )
    starts = np.cumsum([0] + [len(part.buffer) for part in parts])
    offsets = [part.offsets[:-1] + start for part, start in zip(parts, starts, strict=False)]
    return Trajectories(
        np.concatenate([part.buffer for part in parts]),
        np.concatenate([part.clock for part in parts]),
        np.concatenate([*offsets, starts[-1:]]),
        np.concatenate([part.ends for part in parts]),
        np.concatenate([part.codes for part in parts]),
        sum(part.evaluations for part in parts),
    )


def append_continuations(first: Trajectories, which: NDArray[np.int64], rest: Trajectories) -> Trajectories:
    """Return trajectories of which some, `which` of `first`, go on as `rest`, from where they ended there."""
    points, times = list(first.points), list(first.times)
    for i, more, later in zip(which.tolist(), rest.points, rest.times, strict=True):
        points[i] = np.concatenate([points[i], more[1:]])
        times[i] = np.concatenate([times[i], times[i][-1] + later[1:]])
    ends, codes = first.ends.copy(), first.codes.copy()
    ends[which], codes[which] = rest.ends, rest.codes
    offsets = np.concatenate([[0], np.cumsum([len(line) for line in points])])
    evaluations = first.evaluations + rest.evaluations
    return Trajectories(np.concatenate(points), np.concatenate(times), offsets, ends, codes, evaluations)
