"""Visitors ask for what is wild while another drags: how long the one who drags waits; and how soon work is ended.

``python -m tests.benchmarks wild [--quick]``. Each request comes from two visitors, who open a page with it, move z and
leave; beside them one drags, who is compared with one who drags beside nobody. Time for which a thread waits for a
processor, because other programs have it, is taken from all that is told; that for which it waits for the interpreter's
lock is not.
"""

from __future__ import annotations

import asyncio
import json
import os
import time
from concurrent.futures import CancelledError
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from urllib.request import urlopen

import numpy as np

from .app_load import at_rest, serving, value
from .app_servers import queued
from .bokeh_wire import Wire

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
#: Seconds that the longest callback took, those at work, which it was, and those of the longest search for garbage.
Longest = tuple[float, float, str, float]

SECONDS = 6.0  # for which each is there
LIVING = (20, 50)  # pages that are open beside the one who drags
APART = 1 / 60


async def dragged(port: int, pid: int, seconds: float) -> list[float]:
    """Drag as a hand does, one request a frame of the screen at most; return the seconds until each answer."""
    server = f"/proc/{pid}/task/{pid}/schedstat"
    wire = await Wire.connect(port)
    await wire.frame(0, a=-1.5)
    took, number, end = [], 0, time.perf_counter() + seconds
    while (began := time.perf_counter()) < end:
        number += 1
        waited = queued(server), queued()
        await wire.frame(number, a=value(number))
        passed = time.perf_counter() - began
        took.append(max(0.0, passed - (queued(server) - waited[0]) - (queued() - waited[1])))
        await asyncio.sleep(max(0.0, APART - passed))
    await wire.close()
    return took


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


def longest(port: int) -> Longest:
    """Return the longest callback that had the loop, and the longest search, since this was asked last."""
    return tuple(json.loads(urlopen(f"http://localhost:{port}/longest").read()))


def waits(wild: dict[str, dict[str, Any]], seconds: float) -> dict[str, tuple[list[float], Longest]]:
    """Return what the one who drags waits for, and the longest callback, by what the others ask for."""

    async def beside(values: dict[str, Any] | None) -> list[float]:
        others = [] if values is None else [asyncio.create_task(played(port, values, seconds)) for _ in range(2)]
        took = await dragged(port, pid, seconds)
        await asyncio.gather(*others)
        return took

    found = {}
    with serving("watched") as (port, pid):
        asyncio.run(at_rest(pid))
        asyncio.run(dragged(port, pid, 1.0))
        for name, values in {"nobody": None, **wild}.items():
            longest(port)
            found[name] = asyncio.run(beside(values)), longest(port)
    return found


async def crowded(port: int, pid: int, count: int, seconds: float) -> list[float]:
    """Drag beside others who are there and still, while two more come, play and leave again and again."""
    there = [await Wire.connect(port) for _ in range(count)]
    for wire in there:
        await wire.frame(0, a=-1.5)
    await at_rest(pid)
    longest(port)
    others = [asyncio.create_task(played(port, WILD["an ordinary portrait"], seconds / 3)) for _ in range(2)]
    took = await dragged(port, pid, seconds)
    await asyncio.gather(*others)
    for wire in there:
        await wire.vanish()
    return took


def living(counts: tuple[int, ...], seconds: float) -> dict[int, tuple[list[float], Longest]]:
    """Return what the one who drags waits for, and the longest callback, by how many others are there and still."""
    found = {}
    for count in counts:
        with serving("watched") as (port, pid):
            asyncio.run(at_rest(pid))
            found[count] = asyncio.run(crowded(port, pid, count, seconds)), longest(port)
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


def report(quick: bool = False) -> str:
    """Return both as Markdown."""
    names = ("an ordinary portrait", "b = 1e12", "sin(100 c + z), separatrices") if quick else WILD
    seconds = 3.0 if quick else SECONDS
    found = waits({name: WILD[name] for name in names}, seconds)
    lines = [
        "| beside the one who drags, two with | frames | median, ms | 99 % | worst | longest callback, ms | at work |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, (took, (held, worked, what, _)) in found.items():
        middle, late, worst = 1e3 * np.quantile(took, (0.5, 0.99, 1.0))
        cells = f"{len(took)} | {middle:.0f} | {late:.0f} | {worst:.0f} | {1e3 * held:.0f}, {what} | {1e3 * worked:.0f}"
        lines.append(f"| {name} | {cells} |")
    lines += [
        "",
        "| others are there, still | frames | median, ms | 99 % | worst | longest callback, ms | longest search |",
        "|---|---|---|---|---|---|---|",
    ]
    for count, (took, (held, _, what, search)) in living(LIVING[:1] if quick else LIVING, 5 * seconds).items():
        middle, late, worst = 1e3 * np.quantile(took, (0.5, 0.99, 1.0))
        cells = f"{len(took)} | {middle:.0f} | {late:.0f} | {worst:.0f} | {1e3 * held:.0f}, {what} | {1e3 * search:.0f}"
        lines.append(f"| {count} | {cells} |")
    lines.append(f"\nCancelled work has ended after {1e3 * max(cancelled()):.0f} ms, the longest of five.")
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())
