"""A census under way: what is counted so far, and the file from which it goes on."""

from __future__ import annotations

import hashlib
import json
import os
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .tally import CensusPlan, NameCount, SampleLocation, Tally

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
        """Return what tells a census from another one: the first system drawn, Psi, the seed, and what is named."""
        first = self.plan.drawn(0, 1)[0]
        told = (repr(first), self.plan.psi.words, self.plan.seed, self.plan.outcomes, self.chunk)
        return hashlib.sha256(repr(told).encode()).hexdigest()

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
