"""Server CPU of a frame, against a bare Bokeh server and against HoloViews DynamicMaps; load and memory (`app_load`).

Run ``python -m tests.benchmarks.bench_app``. A frame is one tick of the slider `a` in the first setting: everything
in the plane changes, the curves of the atlas included. The servers are measured in turns, and what is compared is the
median over the turns of the ratios within one.
"""

from __future__ import annotations

import asyncio
import json
import math
import sys
import time
from contextlib import ExitStack
from statistics import median

import numpy as np

from . import app_load
from .app_load import at_rest, cpu, serving, value
from .bokeh_wire import Wire

TURNS = 7
FRAMES = 100  # of each server in each turn
HOLOVIEWS_FRAMES = 5
#: Layers that the first setting shows, in the order in which a frame asks for them.
PICTURE = (
    "nullclines_inside", "nullclines_outside", "outside", "inside", "continuations", "cycles", "equator",
    "equator_cycle", "critical", "classification", "slow_flow", "atlas_curves",
)  # fmt: skip

Row = dict[str, float]


async def explorer_turn(wire: Wire, pid: int, first: int) -> Row:
    """One session, one frame after the other."""
    before, times, size = cpu(pid), [], 0
    for i in range(first, first + FRAMES):
        start = time.perf_counter()
        size += len(await wire.frame(i, a=value(i)))
        times.append(time.perf_counter() - start)
    return {"cpu": (cpu(pid) - before) / FRAMES, "delay": float(np.median(times)), "bytes": size / FRAMES}


async def bare_turn(wire: Wire, pid: int) -> Row:
    """The same for the server that swaps one buffer."""
    button = next(_ids(wire.document, "Button"))
    before, times, size = cpu(pid), [], 0
    for _ in range(FRAMES):
        start = time.perf_counter()
        await wire.event("button_click", button)
        size += len(await wire.patch())
        times.append(time.perf_counter() - start)
    return {"cpu": (cpu(pid) - before) / FRAMES, "delay": float(np.median(times)), "bytes": size / FRAMES}


async def frames(servers: dict[str, tuple[int, int]]) -> dict[str, list[Row]]:
    """Measure servers in turns; each is ``(port, pid)``."""
    wires = {name: await Wire.connect(port) for name, (port, _) in servers.items()}
    found: dict[str, list[Row]] = {name: [] for name in servers}

    async def turn(name: str, first: int) -> Row:
        pid = servers[name][1]
        return await (explorer_turn(wires[name], pid, first) if name == "explorer" else bare_turn(wires[name], pid))

    for name, (_, pid) in servers.items():
        await turn(name, -FRAMES)
        await at_rest(pid)
    for i in range(TURNS):
        for name in servers:
            found[name].append(await turn(name, i * FRAMES))
    return found


def holoviews() -> Row:
    """The same scene as one DynamicMap for each layer on one stream: CPU of an update of the Bokeh plot.

    Measured in this process, without a server: the real cost has the protocol on top.
    """
    import holoviews as hv
    from codim2_app.draw.overlay import elements
    from codim2_app.frame.scenes import make_scene
    from codim2_app.state.controls import ExplorerState

    hv.extension("bokeh")
    scenes = [make_scene(ExplorerState().values())]
    stream = hv.streams.Stream.define("Slider", a=-2.0)()

    def layer(name: str) -> hv.DynamicMap:
        def draw(a: float):
            scenes[0] = scenes[0].evolve(a=a)
            return elements(scenes[0])[name]

        return hv.DynamicMap(draw, streams=[stream])

    names = list(elements(scenes[0]))
    picture = layer(names[0])
    for name in names[1:]:
        picture = picture * layer(name)
    hv.renderer("bokeh").get_plot(picture)
    stream.event(a=value(1))
    times = []
    before = time.process_time()
    for i in range(HOLOVIEWS_FRAMES):
        start = time.perf_counter()
        stream.event(a=value(3 * i + 2))
        times.append(time.perf_counter() - start)
    used = time.process_time() - before
    return {"cpu": used / HOLOVIEWS_FRAMES, "delay": float(np.median(times)), "bytes": math.nan}


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


def run() -> dict[str, list[Row]]:
    """Measure everything but load and memory: rows by name, one for each turn."""
    with ExitStack() as stack:
        servers = {name: stack.enter_context(serving(name)) for name in ("bare", "mathematics", "explorer")}
        found = asyncio.run(frames(servers))
        found["arrival"] = [{"cpu": asyncio.run(arrivals(*servers["explorer"]))}]
    found["holoviews"] = [holoviews()]
    return found


def table(found: dict[str, list[Row]]) -> str:
    """Return the results as Markdown."""
    lines = ["| server | CPU a frame | event to message | bytes a frame | CPU, explorer = 1 |", "|---|---|---|---|---|"]
    titles = {
        "bare": "bare Bokeh, one precomputed buffer",
        "mathematics": "the same, its scene computed first",
        "explorer": "explorer",
        "holoviews": "HoloViews DynamicMaps",
    }
    for name, title in titles.items():
        used, delay, size = (median(row[key] for row in found[name]) for key in ("cpu", "delay", "bytes"))
        words = "–" if math.isnan(size) else f"{size / 1e3:.1f} kB"
        share = median(row["cpu"] / ours["cpu"] for row, ours in zip(found[name], found["explorer"], strict=False))
        lines.append(f"| {title} | {1e3 * used:.1f} ms | {1e3 * delay:.1f} ms | {words} | {share:.2f} |")
    ratio = median(a["cpu"] / b["cpu"] for a, b in zip(found["explorer"], found["mathematics"], strict=True))
    lines.append(
        f"\nA frame costs {ratio:.2f} times the mathematics and a bare swap together. Opening a page: "
        f"{1e3 * found['arrival'][0]['cpu']:.0f} ms of CPU."
    )
    return "\n".join(lines)


def report() -> str:
    """Measure everything; return Markdown."""
    return f"{table(run())}\n\n{app_load.report()}"


if __name__ == "__main__":
    if "--json" in sys.argv:
        print(json.dumps(run(), indent=1))
    else:
        print(report())
