"""Forty phones in one lecturer's room: until all are dots on his atlas, until he sees what one does, what it costs.

``python -m tests.benchmarks room [--quick]``. Each phone is a websocket session of its own, played by another process
on the same machine, which needs a processor too. The cost is the server's processor time: of the phones that drag in
the room, and of the same number that drag in none.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Sequence

import numpy as np

from .app_load import at_rest, cpu, serving, value
from .bokeh_wire import Wire

PHONES, SECONDS, RATE = 40, 8.0, 2.0  # how many, for how long and how often each asks for a frame while all drag


async def seen(lecturer: Wire, condition) -> float:
    """Return when the lecturer was told rows that fulfil a condition."""
    while not condition((await lecturer.heard("room")).get("rows", ())):
        pass
    return time.perf_counter()


async def dragging(phones: Sequence[Wire], pid: int, lecturer: Wire | None) -> float:
    """Let all drag; return the seconds of processor time that the server needs for one second."""

    async def drag(phone: Wire, which: int) -> None:
        for tick in range(int(SECONDS * RATE)):
            await phone.frame(tick, a=value(tick + 7.3 * which))
            await asyncio.sleep(1.0 / RATE)

    async def listen(wire: Wire) -> None:
        while True:
            await wire.heard("room")

    listening = None if lecturer is None else asyncio.create_task(listen(lecturer))
    before, start = cpu(pid), time.perf_counter()
    await asyncio.gather(*(drag(phone, i) for i, phone in enumerate(phones)))
    spent = (cpu(pid) - before) / (time.perf_counter() - start)
    if listening is not None:
        listening.cancel()
    return spent


async def measured(port: int, pid: int, count: int) -> tuple[float, list[float], float, float]:
    """Return seconds until all dots are seen, until each phone's new setting is, the cost with and without a room."""
    phones = [await Wire.connect(port) for _ in range(count)]
    for i, phone in enumerate(phones):
        await phone.frame(1, a=value(i))
    await at_rest(pid)
    alone = await dragging(phones, pid, None)
    lecturer = await Wire.connect(port)
    await lecturer.frame(1, a=-1.5)
    code = (await lecturer.ask("room", {"open": ""}))["open"]
    start = time.perf_counter()
    watching = asyncio.create_task(seen(lecturer, lambda rows: len(rows) == count))
    answers = await asyncio.gather(*(phone.ask("room", {"join": code}) for phone in phones))
    assert all(answer == {"joined": code} for answer in answers)
    all_there = await watching - start
    waits = []
    for i, phone in enumerate(phones):
        start, wanted = time.perf_counter(), round(-2.5 - 0.01 * i, 2)
        watching = asyncio.create_task(
            seen(lecturer, lambda rows, a=wanted: any(row[2] and row[2].get("a") == a for row in rows))
        )
        await phone.frame(100, a=wanted)
        waits.append(await watching - start)
    together = await dragging(phones, pid, lecturer)
    for wire in (*phones, lecturer):
        await wire.close()
    return all_there, waits, together, alone


def report(quick: bool = False) -> str:
    """Return the table as Markdown."""
    count = 8 if quick else PHONES
    with serving("explorer", "1") as (port, pid):
        asyncio.run(at_rest(pid))
        all_there, waits, together, alone = asyncio.run(measured(port, pid, count))
    return (
        f"| {count} phones in one room | |\n|---|---|\n"
        f"| all enter at once: until the lecturer sees all | {all_there:.2f} s |\n"
        f"| one moves: until he sees it, median, longest | {np.median(waits):.2f}, {max(waits):.2f} s |\n"
        f"| all drag, {RATE:g} frames a second each: processor time of the server, in a room, in none "
        f"| {100 * together:.0f} %, {100 * alone:.0f} % |"
    )


if __name__ == "__main__":
    print(report())
