"""Server CPU of a frame, against a bare Bokeh server and against HoloViews DynamicMaps.

Run ``python -m tests.benchmarks.bench_app``; everything is measured in one run, on this machine.
"""

from __future__ import annotations

import asyncio
import json
import math
import os
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from urllib.request import urlopen

import numpy as np

from .bench_scene import PICTURE
from .bokeh_wire import Wire

FRAMES = 300
HOLOVIEWS_FRAMES = 5
SESSIONS = 8
RATE = 15.0  # requests a second of each of them
SECONDS = 6.0


def free_port() -> int:
    """Return a port that nothing listens on."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


@contextmanager
def serving(kind: str):
    """Run one server in its own process; yields (port, pid)."""
    port = free_port()
    command = [sys.executable, "-m", "tests.benchmarks.app_servers", kind, str(port)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        for _ in range(300):
            try:
                urlopen(f"http://localhost:{port}/", timeout=20).read()
                if kind != "explorer" or b"ready" in urlopen(f"http://localhost:{port}/health").read():
                    break
            except OSError:
                time.sleep(0.2)
        yield port, process.pid
    finally:
        process.terminate()
        process.wait(10)


def cpu(pid: int) -> float:
    """Return the seconds of CPU that a process has used."""
    with open(f"/proc/{pid}/stat") as stat:
        fields = stat.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def value(i: int) -> float:
    """Return f1 of tick i, never the same twice in a row nor one remembered by a scene."""
    return -0.5 + 1.5 * np.sin(0.037 * i)


async def explorer(port: int, pid: int) -> dict[str, float]:
    """One session, one frame after the other."""
    wire = await Wire.connect(port)
    for i in range(20):
        await wire.frame(i, f1=value(-i))
    before, times, size = cpu(pid), [], 0
    for i in range(FRAMES):
        start = time.perf_counter()
        size += len(await wire.frame(i, f1=value(i)))
        times.append(time.perf_counter() - start)
    return {"cpu": (cpu(pid) - before) / FRAMES, "median": float(np.median(times)), "bytes": size / FRAMES}


async def bare(port: int, pid: int) -> dict[str, float]:
    """The same for the server that swaps one buffer."""
    wire = await Wire.connect(port)
    button = next(i for i in _ids(wire.document, "Button"))
    for _ in range(20):
        await wire.event("button_click", button)
        await wire.patch()
    before, times, size = cpu(pid), [], 0
    for _ in range(FRAMES):
        start = time.perf_counter()
        await wire.event("button_click", button)
        size += len(await wire.patch())
        times.append(time.perf_counter() - start)
    return {"cpu": (cpu(pid) - before) / FRAMES, "median": float(np.median(times)), "bytes": size / FRAMES}


def holoviews() -> dict[str, float]:
    """The same scene as one DynamicMap for each layer on one stream: CPU of an update of the Bokeh plot.

    Measured in this process, without a server: the real cost has the protocol on top.
    """
    import holoviews as hv
    from codim2_app.holoviews_view import elements
    from codim2_app.refresh import make_scene
    from codim2_app.state import ExplorerState

    hv.extension("bokeh")
    scenes = [make_scene(ExplorerState().values())]
    stream = hv.streams.Stream.define("Slider", f1=-0.5)()

    def layer(name: str) -> hv.DynamicMap:
        def draw(f1: float):
            scenes[0] = scenes[0].evolve(f1=f1)
            return elements(scenes[0])[name]

        return hv.DynamicMap(draw, streams=[stream])

    names = list(elements(scenes[0]))
    picture = layer(names[0])
    for name in names[1:]:
        picture = picture * layer(name)
    hv.renderer("bokeh").get_plot(picture)
    stream.event(f1=value(1))
    times = []
    before = time.process_time()
    for i in range(HOLOVIEWS_FRAMES):
        start = time.perf_counter()
        stream.event(f1=value(3 * i + 2))
        times.append(time.perf_counter() - start)
    used = time.process_time() - before
    return {"cpu": used / HOLOVIEWS_FRAMES, "median": float(np.median(times)), "bytes": float("nan")}


async def crowd(port: int, pid: int) -> dict[str, float]:
    """Eight sessions dragging at 15 Hz on one process, each with one frame in flight."""
    wires = [await Wire.connect(port) for _ in range(SESSIONS)]
    delays: list[float] = []

    async def drag(wire: Wire, offset: float) -> int:
        await asyncio.sleep(offset / RATE / SESSIONS)
        start, frames = time.perf_counter(), 0
        while (now := time.perf_counter()) - start < SECONDS:
            await wire.frame(frames, f1=value(frames + 7 * int(offset)))
            delays.append(time.perf_counter() - now)
            frames += 1
            await asyncio.sleep(max(0.0, start + frames / RATE - time.perf_counter()))
        return frames

    before = cpu(pid)
    frames = await asyncio.gather(*(drag(wire, i) for i, wire in enumerate(wires)))
    return {"cpu": (cpu(pid) - before) / sum(frames), "median": float(np.median(delays)),
            "p95": float(np.quantile(delays, 0.95)), "rate": sum(frames) / SESSIONS / SECONDS}  # fmt: skip


async def arrivals(port: int, pid: int, count: int = 10) -> float:
    """Return server CPU of opening one page with its session, in seconds."""
    before = cpu(pid)
    for _ in range(count):
        await (await Wire.connect(port)).close()
    return (cpu(pid) - before) / count


def _ids(document: object, name: str):
    """Yield the ids of all models of one type in a serialised document."""
    if isinstance(document, dict):
        if document.get("type") == "object" and name in str(document.get("name", "")) and "id" in document:
            yield document["id"]
        for part in document.values():
            yield from _ids(part, name)
    elif isinstance(document, list):
        for part in document:
            yield from _ids(part, name)


def scene_alone() -> float:
    """Return the CPU of computing the same scenes in this process, without frame or server, in seconds."""
    from codim2_app.refresh import make_scene
    from codim2_app.state import ExplorerState

    scene = make_scene(ExplorerState().values())
    for name in PICTURE:
        scene[name]
    before = time.process_time()
    for i in range(FRAMES):
        fresh = scene.evolve(f1=value(i))
        for name in PICTURE:
            fresh[name]
    return (time.process_time() - before) / FRAMES


def run() -> dict[str, dict[str, float]]:
    """Measure everything."""
    results = {"scene": {"cpu": scene_alone()}}
    with serving("bare") as (port, pid):
        results["bare"] = asyncio.run(bare(port, pid))
    with serving("explorer") as (port, pid):
        results["explorer"] = asyncio.run(explorer(port, pid))
        results["crowd"] = asyncio.run(crowd(port, pid))
        results["arrival"] = {"cpu": asyncio.run(arrivals(port, pid))}
    results["holoviews"] = holoviews()
    return results


def table(results: dict[str, dict[str, float]]) -> str:
    """Return the results as a Markdown table."""
    ours, base, hv = results["explorer"], results["bare"], results["holoviews"]
    rows = ["| server | CPU a frame | event to message | bytes a frame | CPU, explorer = 1 |", "|---|---|---|---|---|"]
    for name, row in (("bare Bokeh, one precomputed buffer", base), ("explorer", ours), ("HoloViews DynamicMaps", hv)):
        size = "–" if math.isnan(row["bytes"]) else f"{row['bytes'] / 1e3:.1f} kB"
        rows.append(
            f"| {name} | {1e3 * row['cpu']:.1f} ms | {1e3 * row['median']:.1f} ms | {size} "
            f"| {row['cpu'] / ours['cpu']:.2f} |"
        )
    eight = results["crowd"]
    rows.append(
        f"\n{SESSIONS} sessions at {RATE:.0f} Hz on one process: {eight['rate']:.1f} frames/s each, "
        f"p95 {1e3 * eight['p95']:.1f} ms, {1e3 * eight['cpu']:.1f} ms of CPU a frame. "
        f"Opening a page: {1e3 * results['arrival']['cpu']:.0f} ms of CPU."
    )
    alone = results["scene"]["cpu"]
    rows.append(
        f"The scene alone takes {1e3 * alone:.1f} ms; without it the explorer's frame costs "
        f"{(ours['cpu'] - alone) / base['cpu']:.2f} times the bare one, with it in both "
        f"{ours['cpu'] / (base['cpu'] + alone):.2f} times."
    )
    ratios = ours["cpu"] / base["cpu"], ours["cpu"] / hv["cpu"]
    rows.append(f"Explorer/bare {ratios[0]:.2f}, DynamicMaps/explorer {1 / ratios[1]:.0f}.")
    return "\n".join(rows)


def report() -> str:
    """Measure everything; return a Markdown table."""
    return table(run())


if __name__ == "__main__":
    found = run()
    print(json.dumps(found, indent=1) if "--json" in sys.argv else table(found))
