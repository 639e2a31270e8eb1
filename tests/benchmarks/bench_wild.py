"""Visitors ask for what is wild while another drags: how long the one who drags waits; and how soon work is ended.

``python -m tests.benchmarks wild [--quick]``. Each request comes from two visitors, who open a page with it, move z and
leave; beside them one drags, who is compared with one who drags beside nobody: what a frame takes there is the
machine's. Time for which a thread waits for a processor, because other programs have it, is taken from all that is
told; that for which it waits for the interpreter's lock is not.
"""

from __future__ import annotations

import asyncio
import os
import time
from concurrent.futures import CancelledError
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from .app_load import at_rest, serving, value
from .app_servers import queued
from .bokeh_wire import Wire
from .held import Held, held

PLAIN = {"W": "0", "where": ""}
ALL = ["inside", "outside", "continuations", "separatrices", "cycles", "lines", "critical", "equator"]
STEEP, LONG, MANY = (
    {"system": "own", "layers": ALL, "texts": {**PLAIN, "U1": first, "U2": second}}
    for first, second in (
        ("sin(1000000*c)-c", "s"),
        ("sin(100*c+z)-s", "cos(100*s)+c"),
        ("sin(30*c)*c-s+z", "cos(30*s)+c"),
    )
)
#: Of a third visitor, for this time.
WILD: dict[str, dict[str, Any]] = {
    "an ordinary portrait": {"b": 0.5},
    "b = 1e12": {"b": 1e12},
    "b = 1e12, all layers": {"b": 1e12, "layers": ALL},
    "sin(1000000 c)": STEEP,
    "sin(100 c + z), separatrices": LONG,
    "sin(30 c) c": MANY,
    "Ψ = 1 + sin(1000 s)/2": {"b": 0.0, "psi": "custom", "psi_text": "1+sin(1000*s)/2"},
    "Ψ = exp(−1e6 s²)": {"psi": "custom", "psi_text": "exp(-1e6*s^2)+1e-9"},
    "3-D": {**MANY, "panel": "solid"},
    "Diagram": {**MANY, "panel": "diagram"},
    "Along z": {**MANY, "panel": "along"},
    "Theorems": {**MANY, "panel": "theorems"},
    "Atlas": {**MANY, "panel": "atlas"},
}
SECONDS = 6.0  # for which each is there
LIVING = (20, 50)  # pages that are open beside the one who drags
APART = 1 / 60


@dataclass(frozen=True)
class Frame:
    """One frame of the one who drags: when it was asked for, its seconds, and those without waiting for a processor."""

    began: float
    took: float
    own: float


@dataclass(frozen=True)
class Beside:
    """The frames of the one who drags beside others, and what had the server's loop meanwhile."""

    frames: list[Frame]
    held: list[Held]

    def worst(self) -> tuple[Frame, list[Held]]:
        """Return the longest frame, and what had the loop while it was waited for."""
        frame = max(self.frames, key=lambda each: each.own)
        end = frame.began + frame.took
        return frame, [each for each in self.held if each.began < end and each.began + each.took > frame.began]

    def longest(self) -> Held:
        """Return what one request had the loop for."""
        return max(self.held, key=lambda each: each.own)


async def dragged(port: int, pid: int, seconds: float) -> list[Frame]:
    """Drag as a hand does, one request a frame of the screen at most."""
    server = f"/proc/{pid}/task/{pid}/schedstat"
    wire = await Wire.connect(port)
    await wire.frame(0, a=-1.5)
    frames, number, end = [], 0, time.perf_counter() + seconds
    while (began := time.perf_counter()) < end:
        number += 1
        waited = queued(server), queued()
        await wire.frame(number, a=value(number))
        passed = time.perf_counter() - began
        own = max(0.0, passed - (queued(server) - waited[0]) - (queued() - waited[1]))
        frames.append(Frame(began, passed, own))
        await asyncio.sleep(max(0.0, APART - passed))
    await wire.close()
    return frames


async def played(port: int, values: dict[str, Any], seconds: float) -> None:
    """Open a page, ask for what is wild, move z, rest, and begin again in half of the time; leave without a word."""
    for _ in range(2):
        wire = await Wire.connect(port)
        number, end = 0, time.perf_counter() + seconds / 2
        while time.perf_counter() < end:
            asked = values if number == 0 else {"z": 0.01 * (number // 8)}
            await wire.event("data_event", wire.root, data={"id": number, "set": asked, "rest": number % 8 != 1})
            await wire.patch()
            number += 1
            await asyncio.sleep(0.05)
        await wire.vanish()


def waits(wild: dict[str, dict[str, Any]], seconds: float) -> dict[str, Beside]:
    """Return what the one who drags waits for, and what had the loop, by what the others ask for."""

    async def beside(values: dict[str, Any] | None) -> list[Frame]:
        others = [] if values is None else [asyncio.create_task(played(port, values, seconds)) for _ in range(2)]
        frames = await dragged(port, pid, seconds)
        await asyncio.gather(*others)
        return frames

    found = {}
    with serving("watched") as (port, pid):
        asyncio.run(at_rest(pid))
        asyncio.run(dragged(port, pid, 1.0))
        for name, values in {"nobody": None, **wild}.items():
            held(port)
            frames = asyncio.run(beside(values))
            found[name] = Beside(frames, held(port))
    return found


async def crowded(port: int, pid: int, count: int, seconds: float) -> list[Frame]:
    """Drag beside others who are there and still, while two more come, play and leave again and again."""
    there = [await Wire.connect(port) for _ in range(count)]
    for wire in there:
        await wire.frame(0, a=-1.5)
    await at_rest(pid)
    held(port)
    others = [asyncio.create_task(played(port, WILD["an ordinary portrait"], seconds / 3)) for _ in range(2)]
    frames = await dragged(port, pid, seconds)
    await asyncio.gather(*others)
    for wire in there:
        await wire.vanish()
    return frames


def living(counts: tuple[int, ...], seconds: float) -> dict[str, Beside]:
    """Return what the one who drags waits for, and what had the loop, by how many others are there and still."""
    found = {}
    for count in counts:
        with serving("watched") as (port, pid):
            asyncio.run(at_rest(pid))
            frames = asyncio.run(crowded(port, pid, count, seconds))
            found[f"{count} who are still, two with an ordinary portrait"] = Beside(frames, held(port))
    return found


def _endless(folder: Path) -> None:
    while True:
        (folder / "alive").write_text(str(os.getpid()))


def cancelled(times: int = 5) -> list[float]:
    """Return the seconds from `cancel` until the process that was at work is gone."""
    from codim2_app.frame.workers import Workers

    took = []
    with Workers(1) as workers, TemporaryDirectory() as name:
        for _ in range(times):
            (Path(name) / "alive").unlink(missing_ok=True)
            future = workers.submit(_endless, Path(name))
            while not (Path(name) / "alive").exists():
                time.sleep(0.01)
            began, waited = time.perf_counter(), queued()
            future.cancel()
            try:
                future.result()
            except CancelledError:
                took.append(time.perf_counter() - began - (queued() - waited))
    return took


def row(name: str, beside: Beside) -> str:
    """Return a row of the table."""
    middle, late, most = 1e3 * np.quantile([frame.own for frame in beside.frames], (0.5, 0.99, 1.0))
    worst, meanwhile = beside.worst()
    made_of = " + ".join(f"{1e3 * each.own:.0f}" for each in meanwhile if each.own > 0.002)
    one = beside.longest()
    search = 1e3 * max(each.search for each in beside.held)
    cells = (
        f"{len(beside.frames)}",
        f"{middle:.0f}, {late:.0f}, {most:.0f}",
        f"{made_of}; {1e3 * (worst.took - worst.own):.0f}",
        f"{1e3 * one.own:.0f}, {one.name}",
        f"{1e3 * one.worked:.0f}, {1e3 * one.locked:.0f}, {one.faults}",
        f"{search:.0f}",
    )
    return f"| {name} | {' | '.join(cells)} |"


def report(quick: bool = False) -> str:
    """Return all as Markdown."""
    names = ("an ordinary portrait", "b = 1e12", "sin(100 c + z), separatrices") if quick else WILD
    seconds = 3.0 if quick else SECONDS
    found = waits({name: WILD[name] for name in names}, seconds) | living(LIVING[:1] if quick else LIVING, 5 * seconds)
    alone, *others = found.values()
    frame = 1e3 * np.median([each.own for each in alone.frames])
    one, least = (1e3 * max(getattr(had, what) for each in others for had in each.held) for what in ("own", "alone"))
    return "\n".join(
        [
            "| beside the one who drags, two with | frames | median, 99 %, worst, ms | what had the loop in the worst, "
            "ms; and waited for a processor | longest of one request, ms | of it at work, other threads waited for a "
            "processor; pages read from disk | longest search for garbage, ms |",
            "|---|---|---|---|---|---|---|",
            *(row(name, each) for name, each in found.items()),
            "",
            f"A frame beside nobody takes {frame:.0f} ms here. No request had the loop for more than {one:.0f} ms; for "
            f"more than {least:.0f} ms, if that is taken off for which other threads waited for a processor.",
            f"Cancelled work has ended after {1e3 * max(cancelled()):.0f} ms, the longest of five.",
        ]
    )


if __name__ == "__main__":
    print(report())
