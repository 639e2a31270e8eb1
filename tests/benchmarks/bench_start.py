"""From the start of `codim2 serve` to its first trajectories: on a fresh install, where nothing is compiled, and again.

``python -m tests.benchmarks start [--quick]``. The clock starts with the process. The trajectories are those of the
first frame of a page: sketched until the kernels are compiled. Beside them a server of Panel's alone, with one empty
figure: what no server can do without that imports it. Seconds of its processor are told too, as others may have it
meanwhile. With --quick only one of each start; else also two processes that begin with the same empty folder: what they
keep in it together, and how many kernels each compiled.
"""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any
from urllib.error import URLError
from urllib.request import urlopen

from codim2_app.draw.packing import unpack

from .app_load import cpu, free_port
from .bokeh_wire import Wire

LONGEST = 300.0  # seconds; of processor time for all that is compiled, as others may have the machine
LINES = ("inside", "outside")


@contextmanager
def started(cache: str, *module: str) -> Iterator[tuple[int, float, int]]:
    """Start a server; yields its port, when it was started, and its process."""
    port = free_port()
    environment = {**os.environ, "NUMBA_CACHE_DIR": cache}
    command = [sys.executable, "-m", *module, str(port)]
    begun = time.perf_counter()
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield port, begun, process.pid
    finally:
        process.terminate()
        process.wait(20)


def answers(port: int, path: str, begun: float) -> float:
    """Return the seconds from the start until an address answers 200."""
    while time.perf_counter() - begun < LONGEST:
        try:
            with urlopen(f"http://localhost:{port}/{path}", timeout=20) as answer:
                answer.read()
                return time.perf_counter() - begun
        except (URLError, ConnectionError, TimeoutError):
            time.sleep(0.02)
    raise TimeoutError(f"no answer from /{path}")


async def first_trajectories(port: int, begun: float) -> float:
    """Return the seconds from the start until a page that is open has trajectories."""
    wire = await Wire.connect(port)
    number = 0
    try:
        while time.perf_counter() - begun < LONGEST:
            number += 1
            await wire.event("data_event", wire.root, data={"id": number, "set": {}, "all": True})
            _, blocks = unpack(await wire.patch())
            if any(len(blocks.get(f"{name}.n", ())) or name in blocks for name in LINES):
                return time.perf_counter() - begun
            await asyncio.sleep(0.1)
    finally:
        await wire.close()
    raise TimeoutError("no trajectories")


def start(cache: str) -> dict[str, float]:
    """Return the seconds of one start until each of what a visitor waits for."""
    with started(cache, "codim2_app.server.cli", "serve", "--port") as (port, begun, pid):
        page, worked = answers(port, "", begun), cpu(pid)
        drawn = asyncio.run(first_trajectories(port, begun))
        ready = answers(port, "ready", begun)
        whole = compiled(port, begun, pid)
    return {"page": page, "worked": worked, "drawn": drawn, "ready": ready, "whole": whole}


def alone(cache: str) -> dict[str, float]:
    """Return the seconds of one start of Panel alone."""
    with started(cache, "tests.benchmarks.app_servers", "panel") as (port, begun, pid):
        return {"page": answers(port, "", begun), "worked": cpu(pid)}


def compiled(port: int, begun: float, pid: int) -> float:
    """Return the seconds from the start until nothing is left to compile."""
    while cpu(pid) < LONGEST:
        with urlopen(f"http://localhost:{port}/ready", timeout=20) as answer:
            done, of = json.load(answer)["compiled"]
        if done == of:
            return time.perf_counter() - begun
        time.sleep(0.1)
    raise TimeoutError("not all is compiled")


def together() -> str:
    """Let two processes compile into one empty folder; return how many kernels each compiled, and what is kept."""
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "NUMBA_CACHE_DIR": cache, "NUMBA_DEBUG_CACHE": "1"}
        command = [sys.executable, "-m", "codim2_app.server.cli", "warm"]
        both = [subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) for _ in range(2)]
        saved = [process.communicate()[0].count("data saved") for process in both]
        kept = len(list(Path(cache).rglob("*.nbc")))
    return f"Two processes at once on an empty folder compiled {saved[0]} and {saved[1]} kernels; {kept} are kept."


def report(quick: bool = False) -> str:
    """Return the tables as Markdown."""
    kinds = {"first": start, "second": start, "Panel alone": alone}
    rows: dict[str, list[dict[str, Any]]] = {name: [] for name in kinds}
    for _ in range(1 if quick else 3):
        with tempfile.TemporaryDirectory() as cache:
            for name, begin in kinds.items():
                rows[name].append(begin(cache))
    lines = [
        "| start | page, s | of it at work | first trajectories, s | first scene, s | all compiled, s |",
        "|---|---|---|---|---|---|",
    ]
    for name, found in rows.items():
        keys = ("page", "worked", "drawn", "ready", "whole")
        cells = [f"{median(row[key] for row in found):.1f}" if key in found[0] else "" for key in keys]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines if quick else [*lines, "", together()])


if __name__ == "__main__":
    print(report())
