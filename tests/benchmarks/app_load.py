"""Servers in processes of their own, what they use, and what closed sessions leave behind."""

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
from tornado.httpclient import AsyncHTTPClient

from tests.work import PATIENCE

from .wire import Wire

RATE = 10.0  # requests a second of each session
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
                if kind == "panel" or b'"ready"' in urlopen(f"http://localhost:{port}/ready").read():
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
    """Wait until a server has no work left, such as what it compiles or its panels compute next to the frames."""
    for _ in range(int(2 * most)):
        before = sum(map(cpu, family(pid)))
        await asyncio.sleep(0.5)
        if sum(map(cpu, family(pid))) - before < 0.01:
            return


def value(i: float) -> float:
    """Return `a` of tick i, never the same twice in a row nor one remembered by a scene."""
    return -2.0 + 1.2 * np.sin(0.037 * i)


async def burst(port: int) -> list[float]:
    """Open `MANY` pages evenly over `WITHIN` seconds; return how long each waits for its picture, in their order."""

    async def visit(i: int) -> float:
        await asyncio.sleep(i * WITHIN / MANY)
        start = time.perf_counter()
        await asyncio.to_thread(page, port)
        wires.append(await Wire.connect(port))
        return time.perf_counter() - start

    wires: list[Wire] = []
    waits = await asyncio.gather(*(visit(i) for i in range(MANY)))
    await asyncio.gather(*(wire.close() for wire in wires))
    return list(waits)


async def come_back(port: int, pages: int) -> tuple[list[float], list[float]]:
    """Let pages, each at an address of its own, come back at once as they do when their server was gone.

    Returns
    -------
    waits, whole : list of float
        Seconds until the picture is there: from the turn that the server gives a page, and from the beginning.
    """
    client = AsyncHTTPClient(force_instance=True, max_clients=pages)

    async def visit(i: int) -> tuple[float, float]:
        began = time.perf_counter()
        told = await client.fetch(f"http://localhost:{port}/health?back=1", request_timeout=PATIENCE)
        await asyncio.sleep(json.loads(told.body)["wait"])
        turn = time.perf_counter()
        query = f"?a={-1.0 - 1e-3 * i}"
        await client.fetch(f"http://localhost:{port}/{query}", request_timeout=PATIENCE)
        wires.append(await Wire.connect(port, query))
        end = time.perf_counter()
        return end - turn, end - began

    wires: list[Wire] = []
    found = await asyncio.gather(*map(visit, range(pages)))
    await asyncio.gather(*(wire.close() for wire in wires))
    client.close()
    return [wait for wait, _ in found], [whole for _, whole in found]


def page(port: int, query: str = "") -> str:
    """Return the text of a page."""
    with urlopen(f"http://localhost:{port}/{query}") as answer:
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
