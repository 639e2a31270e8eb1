"""One visitor types wild formulas while another drags: how long the one who drags waits; and how soon work is ended.

``python -m tests.benchmarks.wild``
"""

from __future__ import annotations

import asyncio
import os
import time
from concurrent.futures import CancelledError
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from .app_load import serving, value
from .bokeh_wire import Wire

ALL = ["inside", "outside", "continuations", "separatrices", "cycles", "lines", "critical", "equator"]
TYPED: dict[str, Any] = {"system": "own", "layers": ALL}
PLAIN = {"W": "0", "where": ""}
LONG = {**PLAIN, "U1": "sin(100*c+z)-s", "U2": "cos(100*s)+c"}
WILD: list[dict[str, Any]] = [
    {**TYPED, "texts": LONG},
    {**TYPED, "texts": {**PLAIN, "U1": "sin(1000000*c)-c", "U2": "s"}},
    {**TYPED, "texts": {**PLAIN, "U1": "sin(30*c)*c-s+z", "U2": "cos(30*s)+c"}},
    {"system": "normal", "b": 1e12},
    {"system": "normal", "b": 0.0, "psi": "custom", "psi_text": "1+sin(1000*s)/2"},
    {"system": "normal", "psi": "custom", "psi_text": "exp(-1e6*s^2)+1e-9"},
]
SECONDS = 6.0  # for which each formula is there
APART = 1 / 60


def running(pid: int) -> float:
    """Return the seconds that the thread which answers has run: other programs on the machine do not count."""
    return 1e-9 * int(Path(f"/proc/{pid}/task/{pid}/schedstat").read_text().split()[0])


async def dragged(port: int, pid: int, seconds: float) -> list[tuple[float, float]]:
    """Drag as a hand does, one request a frame of the screen at most.

    Returns for each answer the seconds that it took, and those for which the server's thread was at work meanwhile.
    """
    wire = await Wire.connect(port)
    await wire.frame(0, a=-1.5)
    took, number, end = [], 0, time.perf_counter() + seconds
    while (began := time.perf_counter()) < end:
        number += 1
        before = running(pid)
        await wire.frame(number, a=value(number))
        took.append((time.perf_counter() - began, running(pid) - before))
        await asyncio.sleep(max(0.0, APART - took[-1][0]))
    await wire.close()
    return took


async def played(port: int, values: dict[str, Any], seconds: float) -> None:
    """Type a formula, and move z and a under it, until the time is over."""
    wire = await Wire.connect(port)
    number, end = 0, time.perf_counter() + seconds
    while time.perf_counter() < end:
        moved = {"z": 0.01 * number} if values["system"] == "own" else {}
        await wire.frame(number + 1, **(values if number == 0 else moved))
        number += 1
        await asyncio.sleep(0.05)
    await wire.vanish()


def waits(seconds: float = SECONDS) -> list[tuple[str, list[tuple[float, float]]]]:
    """Return what the one who drags waits for, alone and beside each formula, in one server."""

    async def beside(values: dict[str, Any] | None) -> list[tuple[float, float]]:
        others = [] if values is None else [asyncio.create_task(played(port, values, seconds)) for _ in range(2)]
        took = await dragged(port, pid, seconds)
        await asyncio.gather(*others)
        return took

    found = []
    with serving("explorer") as (port, pid):
        asyncio.run(dragged(port, pid, 1.0))
        for values in (None, *WILD):
            name = "alone" if values is None else ", ".join(f"{k} = {v}" for k, v in values.items() if k != "layers")
            found.append((name, asyncio.run(beside(values))))
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
            began = time.perf_counter()
            future.cancel()
            try:
                future.result()
            except CancelledError:
                took.append(time.perf_counter() - began)
    return took


def report() -> str:
    """Return both as Markdown."""
    found = waits()
    lines = [
        "| beside the one who drags, two who type | frames | median | worst | worst, the server's thread at work |",
        "|---|---|---|---|---|",
    ]
    for name, both in found:
        took, worked = 1e3 * np.array(both).T
        lines.append(f"| {name} | {len(took)} | {np.median(took):.0f} ms | {max(took):.0f} ms | {max(worked):.0f} ms |")
    lines.append(f"\nCancelled work has ended after {1e3 * max(cancelled()):.0f} ms, the longest of five.")
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())
