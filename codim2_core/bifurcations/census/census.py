"""Count portraits by name among random systems, on any executor, with equal results.

What is counted so far is kept in a file, from which a census goes on. The result is a table: for each portrait a
count, a share, and examples.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...results.result import Result, Tabled, result_rows
from ...results.tables import paragraphs, point, table_number
from ...systems.arguments import psi as read_psi
from ...systems.kinds import PsiLike
from ...systems.psi.constructors import constant
from .tally import DRAWS, CensusPlan, Draw, NameCount, SampleLocation, Tally, tally

if TYPE_CHECKING:  # an import that takes as long as a tenth of this package
    from concurrent.futures import Executor, Future


NORMAL_95 = 1.959963984540054  # two-sided 95 % of the normal distribution


@dataclass(frozen=True, eq=False)
class CensusRow(Tabled):
    """One portrait.

    Attributes
    ----------
    name : str
        The case, if there is one, and the portrait's name: "I CM4".
    count : int
    share : float
    low, high : float
        The share's interval of 95 % confidence (Wilson).
    example : tuple of float, or System
        The system of this name that lies farthest from a border: a, b, d, f1, f2, or a general system.
    marginal : tuple of float, or System
        The one that lies nearest to a border.
    """

    _head_ = ("portrait", "count", "share", "95 % interval", "example")

    name: str
    count: int
    share: float
    low: float
    high: float
    example: Any
    marginal: Any

    def _row_(self) -> tuple[str, ...]:
        example = point(self.example) if isinstance(self.example, tuple) else repr(self.example)
        return (
            self.name,
            f"{self.count:,}",
            table_number(self.share),
            f"{table_number(self.low)} to {table_number(self.high)}",
            example,
        )


@dataclass(frozen=True, eq=False)
class Census(Result):
    """The portraits of many systems.

    Attributes
    ----------
    table : tuple of CensusRow
        The most frequent first.
    count : int
    seed : int
    contradictions : int
        Systems that are not degenerate and whose critical sets do not have the indices that U turns along the equator
        (Section 3.1): each would be an error of this software.
    """

    table: tuple[CensusRow, ...]
    count: int
    seed: int
    contradictions: int = 0

    def _tables_(self) -> str:
        return result_rows(self.table) + paragraphs([f"{self.count:,} systems, seed {self.seed}"])

    def _records(self) -> Iterator[dict[str, Any]]:
        return map(dict, map(vars, self.table))


def make_census(tally: Tally, plan: CensusPlan, chunk: int) -> Census:
    """Return the census of what is counted; its examples are drawn again, `chunk` systems at a time."""
    total = tally.systems
    places = {place for entry in tally.found.values() for place in (entry.typical, entry.marginal)}
    systems = _drawn_again(plan, places, chunk, total)
    rows = [
        CensusRow(name, entry.systems, entry.systems / total, *interval(entry.systems, total),
            systems[entry.typical], systems[entry.marginal])
        for name, entry in tally.found.items()
    ]  # fmt: skip
    ordered = sorted(rows, key=lambda row: (-row.count, row.name))
    return Census(tuple(ordered), total, plan.seed, tally.contradictions)


def _drawn_again(plan: CensusPlan, places: set[SampleLocation], chunk: int, total: int) -> dict[SampleLocation, Any]:
    found: dict[SampleLocation, Any] = {}
    for i in sorted({i for i, _ in places}):
        drawn = plan.drawn(i, min(chunk, total - i * chunk))
        for place in places:
            if place[0] == i:
                system = drawn[place[1]]
                found[place] = tuple(system.tolist()) if isinstance(system, np.ndarray) else system
    return found


def interval(count: int, total: int) -> tuple[float, float]:
    """Return Wilson's interval of 95 % confidence of a share."""
    share, z2 = count / total, NORMAL_95**2
    centre = share + z2 / (2 * total)
    half = NORMAL_95 * math.sqrt(share * (1 - share) / total + z2 / (4 * total * total))
    scale = 1 + z2 / total
    return max(0.0, (centre - half) / scale), min(1.0, (centre + half) / scale)


SAVING_SECONDS = 2.0  # seconds between two savings


@dataclass
class CountedChunks:
    """Chunks counted so far: the first `upto` together, those that came before their turn apart."""

    plan: CensusPlan
    chunk: int
    path: Path | None
    whole: Tally = field(default_factory=lambda: Tally({}))
    upto: int = 0
    ahead: dict[int, Tally] = field(default_factory=dict)
    saved: float = 0.0

    def __post_init__(self) -> None:
        if self.path is not None and self.path.exists():
            self._read(self.path)

    def __contains__(self, chunk: int) -> bool:
        return chunk < self.upto or chunk in self.ahead

    @property
    def systems(self) -> int:
        """Return the number of systems counted."""
        return sum(tally.systems for tally in (self.whole, *self.ahead.values()))

    def add(self, chunk: int, tally: Tally) -> None:
        """Count one more chunk."""
        self.ahead[chunk] = tally
        while self.upto in self.ahead:
            if self.ahead[self.upto].systems < self.chunk:
                break
            self.whole = self.whole.merge(self.ahead.pop(self.upto))
            self.upto += 1
        if self.path is not None and time.monotonic() - self.saved > SAVING_SECONDS:
            self.save()

    def all(self) -> Tally:
        """Return all chunks together, in their order."""
        whole = self.whole
        for chunk in sorted(self.ahead):
            whole = whole.merge(self.ahead[chunk])
        return whole

    def save(self) -> None:
        """Write the file, whole or not at all."""
        if self.path is None:
            return
        full = {i: t for i, t in self.ahead.items() if t.systems == self.chunk}
        record = {
            "census": self._mark(),
            "chunks": self.upto,
            "whole": _tally_columns(self.whole),
            "ahead": {str(i): _tally_columns(t) for i, t in full.items()},
        }
        temporary = self.path.with_name(f"{self.path.name}.{os.getpid()}")
        temporary.write_text(json.dumps(record), encoding="utf-8")
        temporary.replace(self.path)
        self.saved = time.monotonic()

    def _mark(self) -> str:
        """Return a fingerprint of the census: the first system drawn, Psi, the seed, and what is named."""
        first = self.plan.drawn(0, 1)[0]
        parts = (repr(first), self.plan.psi.words, self.plan.seed, self.plan.outcomes, self.chunk)
        return hashlib.sha256(repr(parts).encode()).hexdigest()

    def _read(self, path: Path) -> None:
        try:
            record = json.loads(path.read_text(encoding="utf-8"))
            mark, upto, whole = record["census"], int(record["chunks"]), _tally(record["whole"])
            ahead = {int(i): _tally(columns) for i, columns in record["ahead"].items()}
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            raise ValueError(f"{path} keeps no census; give another file, or one that is not there yet.") from None
        if mark != self._mark():
            raise ValueError(f"{path} keeps a census of another draw, Ψ or seed; give another file.")
        self.upto, self.whole, self.ahead = upto, whole, ahead


def _tally_columns(tally: Tally) -> dict[str, Any]:
    return {"found": {name: list(entry) for name, entry in tally.found.items()}, "wrong": tally.contradictions}


def _tally(columns: dict[str, Any]) -> Tally:
    found = {
        name: NameCount(int(count), float(wide), _read_location(typical), float(narrow), _read_location(marginal))
        for name, (count, wide, typical, narrow, marginal) in columns["found"].items()
    }
    return Tally(found, int(columns["wrong"]))


def _read_location(pair: list[int]) -> SampleLocation:
    chunk, i = pair
    return int(chunk), int(i)


CHUNK_SYSTEMS, FEW = 100_000, 200  # systems in a chunk: of coefficients, and of systems that are classified one by one
CHUNKS_IN_FLIGHT = 64  # chunks handed to an executor at a time
MAX_SYSTEMS = 10**12


def census(
    draw: Draw | str = "normal",
    psi: PsiLike | None = None,
    count: int = 1_000_000,
    *,
    seed: int = 0,
    outcomes: bool = False,
    resume: str | Path | None = None,
    executor: Executor | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Census:
    """Name many systems, and count the names.

    The same arguments give the same table, whatever the executor: chunk i draws from a generator of its own, seeded by
    (seed, i).

    Parameters
    ----------
    draw : "normal", "quadratic", or callable
        Default "normal": e-linear systems with standard normal a, b, d, f1, f2. "quadratic": systems quadratic in e,
        with twelve standard normal coefficients. Or (generator, n) to n systems: coefficients (n, 5) a, b, d, f1, f2 of
        e-linear ones, which a filter names, or a sequence of systems, which `classify` names one by one (at
        z = 0, in some milliseconds each). It must give the same for the same generator; for processes it must be
        picklable. It is first called for one system, which is not counted and shows which of the two it returns.
    psi : Psi, optional
        Read by systems that are not e-linear, and for outcomes; default Psi = 1.
    count : int
        1 to 1e12.
    seed : int
    outcomes : bool
        Whether names tell as well what becomes of orbits that arrive along open sets, or along one side of a
        direction: "I CM4, slides". Each system then takes some milliseconds.
    resume : path, optional
        A file in which what is counted is kept, every two seconds. If it is there, the census goes on from it: after it
        was stopped, or with a larger count.
    executor : concurrent.futures.Executor, optional
        Threads, processes, or a cluster's; by default all is done here.
    progress : callable, optional
        Called with (systems named, count).

    Returns
    -------
    Census

    Raises
    ------
    ValueError
        An argument is invalid, `draw` does not return what it should, or the file to resume is another census's.

    Examples
    --------
    >>> census(count=10_000).table[0].name
    'I NCM2'
    """
    draw = DRAWS.get(draw, draw) if isinstance(draw, str) else draw
    if not callable(draw):
        raise ValueError(f"draw is {draw!r:.80}; give {', '.join(DRAWS)}, or a function (generator, n) to n systems.")
    if not isinstance(count, (int, np.integer)) or not 1 <= count <= MAX_SYSTEMS:
        raise ValueError(f"count is {count!r}; give a whole number from 1 to 1e12.")
    if not isinstance(seed, (int, np.integer)) or seed < 0:
        raise ValueError(f"seed is {seed!r}; give a whole number, 0 or larger.")
    plan = CensusPlan(draw, constant() if psi is None else read_psi("psi", psi), int(seed), bool(outcomes))
    chunk = _chunk_size(plan)
    kept = CountedChunks(plan, chunk, None if resume is None else Path(resume))
    last = -(-count // chunk)
    if kept.systems > count:
        raise ValueError(f"{resume} keeps {kept.systems} systems; give a count of at least that.")
    waiting = ((i, min(chunk, count - i * chunk)) for i in range(last) if i not in kept)
    try:
        for i, found in _run_chunks(executor, plan, waiting):
            kept.add(i, found)
            if progress is not None:
                progress(kept.systems, count)
    finally:
        kept.save()
    return make_census(kept.all(), plan, chunk)


def _chunk_size(plan: CensusPlan) -> int:
    """Return how many systems go into a chunk; it follows from what is asked alone, so that tables agree."""
    return CHUNK_SYSTEMS if isinstance(plan.drawn(0, 1), np.ndarray) and not plan.outcomes else FEW


def _run_chunks(
    executor: Executor | None, plan: CensusPlan, chunks: Iterator[tuple[int, int]]
) -> Iterator[tuple[int, Tally]]:
    if executor is None:
        for i, size in chunks:
            yield i, tally(plan, i, size)
        return
    waiting: dict[Future[Tally], int] = {}
    try:
        for i, size in chunks:
            if len(waiting) >= CHUNKS_IN_FLIGHT:
                yield from _as_completed(waiting)
            waiting[executor.submit(tally, plan, i, size)] = i
        while waiting:
            yield from _as_completed(waiting)
    finally:
        for future in waiting:
            future.cancel()


def _as_completed(waiting: dict[Future[Tally], int]) -> Iterator[tuple[int, Tally]]:
    from concurrent.futures import FIRST_COMPLETED, wait

    ready, _ = wait(waiting, return_when=FIRST_COMPLETED)
    for future in ready:
        yield waiting.pop(future), future.result()
