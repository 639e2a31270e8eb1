"""Many sessions at once, and one after the other: delay under load, and what closed sessions leave behind."""

from __future__ import annotations

import asyncio
import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from urllib.request import urlopen

import numpy as np

from .bokeh_wire import Wire

RATE = 10.0  # requests a second of each session
SECONDS = 4.0
CROWDS = (1, 2, 4, 8, 16)
MANY, WITHIN = 40, 2.0  # pages that are opened together, and the seconds in which they are


def free_port() -> int:
    """Return a port that nothing listens on."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


@contextmanager
def serving(kind: str, *options: str) -> Iterator[tuple[int, int]]:
    """Run one server in its own process; yields (port, pid)."""
    port = free_port()
    command = [sys.executable, "-m", "tests.benchmarks.app_servers", kind, str(port), *options]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        for _ in range(300):
            try:
                urlopen(f"http://localhost:{port}/", timeout=20).read()
                if (
                    kind in ("bare", "mathematics", "panel")
                    or b'"ready"' in urlopen(f"http://localhost:{port}/ready").read()
                ):
                    break
            except OSError:
                time.sleep(0.2)
        yield port, process.pid
    finally:
        process.terminate()
        process.wait(10)


def cpu(pid: int) -> float:
    """Return the seconds of CPU that a process has used, also by threads that have ended; without its children."""
    try:
        return time.clock_gettime(~pid << 3 | 2)  # how Linux numbers the clock of another process's work
    except OSError:  # it has just ended
        return 0.0


def family(pid: int) -> list[int]:
    """Return a process and those that it has forked, such as the server processes that share a port."""
    found = [pid]
    for one in found:
        found += children(one)
    return found


def children(pid: int) -> list[int]:
    """Return the processes that the threads of one have forked."""
    found = []
    for thread in sorted(os.listdir(f"/proc/{pid}/task"), key=int):
        with open(f"/proc/{pid}/task/{thread}/children") as forked:
            found += [int(child) for child in forked.read().split()]
    return found


async def at_rest(pid: int, most: float = 30.0) -> None:
    """Wait until a server has no work left, such as what it compiles or its panels compute beside the frames."""
    for _ in range(int(2 * most)):
        before = sum(map(cpu, family(pid)))
        await asyncio.sleep(0.5)
        if sum(map(cpu, family(pid))) - before < 0.01:
            return


def value(i: float) -> float:
    """Return `a` of tick i, never the same twice in a row nor one remembered by a scene."""
    return -2.0 + 1.2 * np.sin(0.037 * i)


async def crowd(port: int, sessions: int, seconds: float = SECONDS) -> list[float]:
    """Let sessions drag at `RATE`, each with one frame in flight; return the delays from tick to message."""
    wires = [await Wire.connect(port) for _ in range(sessions)]
    delays: list[float] = []

    async def drag(wire: Wire, which: int) -> None:
        await asyncio.sleep(which / RATE / sessions)
        start, tick = time.perf_counter(), 0
        while (now := time.perf_counter()) - start < seconds:
            await wire.frame(tick, a=value(tick + 7.3 * which))
            delays.append(time.perf_counter() - now)
            # a tick that comes while a frame is under way is superseded, as in the browser
            tick = max(tick + 1, int((time.perf_counter() - start) * RATE) + 1)
            await asyncio.sleep(max(0.0, start + tick / RATE - time.perf_counter()))

    await asyncio.gather(*(drag(wire, i) for i, wire in enumerate(wires)))
    await asyncio.gather(*(wire.close() for wire in wires))
    return delays


def load(processes: int) -> dict[int, dict[str, float]]:
    """Return median and p95 of the delay in seconds, and frames a second of each session, by number of sessions."""
    found = {}
    with serving("explorer", str(processes)) as (port, pid):
        asyncio.run(crowd(port, 2))
        asyncio.run(at_rest(pid))
        for sessions in CROWDS:
            delays = asyncio.run(crowd(port, sessions))
            found[sessions] = {
                "median": float(np.median(delays)),
                "p95": float(np.quantile(delays, 0.95)),
                "rate": len(delays) / SECONDS / sessions,
            }
    return found


async def burst(port: int) -> list[float]:
    """Open `MANY` pages evenly over `WITHIN` seconds; return how long each waits for its picture, in their order."""

    async def visit(i: int) -> float:
        await asyncio.sleep(i * WITHIN / MANY)
        start = time.perf_counter()
        page = await asyncio.to_thread(_read, port)
        wires.append(await Wire.connect(port, page=page))
        return time.perf_counter() - start

    wires: list[Wire] = []
    waits = await asyncio.gather(*(visit(i) for i in range(MANY)))
    await asyncio.gather(*(wire.close() for wire in wires))
    return list(waits)


def _read(port: int) -> str:
    with urlopen(f"http://localhost:{port}/") as answer:
        return answer.read().decode()


def overtaken(waits: list[float]) -> int:
    """Count the pairs of neighbours of which the one who came later was served first."""
    done = [i * WITHIN / len(waits) + wait for i, wait in enumerate(waits)]
    return sum(later < earlier for earlier, later in pairwise(done))


def left(port: int) -> dict[str, float]:
    """Return what a `forgetful` server holds: resident bytes, and living objects by kind."""
    return json.loads(urlopen(f"http://localhost:{port}/left").read())


def there(port: int) -> int:
    """Return how many explorers a `forgetful` server holds."""
    return int(urlopen(f"http://localhost:{port}/there").read())


async def forgotten(port: int) -> dict[str, float]:
    """Wait until a `forgetful` server has forgotten its last page; return what it holds then."""
    for _ in range(60):
        await asyncio.sleep(0.5)
        if not there(port):
            break
    return left(port)


def memory(warm: int = 100, sessions: int = 200) -> tuple[dict[str, float], dict[str, float]]:
    """Open and close sessions, each with a few frames; return what is held after `warm` and `sessions` more."""

    async def visit(count: int) -> None:
        for i in range(count):
            wire = await Wire.connect(port)
            for tick in range(3):
                await wire.frame(tick, a=value(3 * i + tick))
            await wire.close()
        await forgotten(port)

    with serving("forgetful") as (port, pid):
        asyncio.run(visit(warm))
        asyncio.run(at_rest(pid))
        before = left(port)
        asyncio.run(visit(sessions))
        asyncio.run(at_rest(pid))
        return before, left(port)


def report() -> str:
    """Return both as Markdown."""
    alone, pair = load(1), load(2)
    lines = [
        f"| sessions at {RATE:.0f} Hz | 1 process: median, p95 | frames/s each | 2 processes: median, p95 "
        "| frames/s each |",
        "|---|---|---|---|---|",
    ]
    for n in CROWDS:
        cells = [
            f"{1e3 * row['median']:.1f}, {1e3 * row['p95']:.1f} ms | {row['rate']:.1f}" for row in (alone[n], pair[n])
        ]
        lines.append(f"| {n} | {' | '.join(cells)} |")
    ratios = [row[max(CROWDS)]["p95"] / row[1]["median"] for row in (alone, pair)]
    lines.append(
        f"\np95 with {max(CROWDS)} sessions over the median of one: {ratios[0]:.1f} with 1 process, {ratios[1]:.1f} "
        "with 2. The sessions are played by a third process on the same machine."
    )
    before, after = memory()
    lines.append(
        f"200 sessions opened and closed: {(after['resident'] - before['resident']) / 200e3:+.1f} kB of memory and "
        f"{(after['objects'] - before['objects']) / 200:+.1f} objects each; {after['ExplorerView']} explorers and "
        f"{after['Scene']} scenes are left."
    )
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())
