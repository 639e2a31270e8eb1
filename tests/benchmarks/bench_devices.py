"""A thousand visitors whose devices compute: what their pages cost the server, and for how long they wait.

``CODIM2_PYODIDE=DIR python -m tests.benchmarks devices [--quick]``, with Pyodide's release and the kernels that
``codim2 kernels`` has written. Most visitors are played, by this process; some are Chromium with its worker. All share
the processors of one machine.
"""

from __future__ import annotations

import asyncio
import os
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from codim2_app.lessons.rooms.rooms import SHARING_SECONDS
from codim2_app.picture.state.controls import first_values
from playwright.sync_api import Browser

from .app_load import MANY, at_rest, cpu, family, serving, value
from .app_servers import queued
from .device_visits import Crowd, arrive, load_engine, open_page
from .dragging import DRAG, launched
from .wire import Wire

VISITORS, RATE = 1000, 20.0  # a second
REAL = 3  # in Chromium
PLACES = "600"  # of each of two processes
HELD = 10.0  # seconds for which all stay
LINE = "document.querySelector('.codim2').explorer.line"


def resident(pid: int) -> float:
    """Return the megabytes that a server holds, with its processes."""
    total = 0.0
    for one in family(pid):
        with open(f"/proc/{one}/smaps_rollup") as pages:
            total += sum(int(line.split()[1]) for line in pages if line.startswith("Pss:")) / 1024
    return total


def used(pid: int) -> float:
    """Return the processor time of a server and of all that work for it."""
    return sum(map(cpu, family(pid)))


async def costs(port: int, pid: int, count: int) -> tuple[float, float]:
    """Return the server's processor time of an opening, and of the worker's files."""
    crowd = Crowd()
    before = used(pid)
    wires = [await open_page(port, crowd) for _ in range(count)]
    between = used(pid)
    for wire in wires:
        await load_engine(port, wire, crowd)
    after = used(pid)
    for wire in wires:
        await wire.vanish()
    return (between - before) / count, (after - between) / count


async def noted(port: int, pid: int, pages: int, seconds: float) -> float:
    """Return the server's processor time of a settled change of pages in a room that draw themselves."""
    lecturer = await Wire.connect(port)
    code = (await lecturer.ask("room", {"open": ""}))["open"]
    students = [await Wire.connect(port) for _ in range(pages)]
    for student in students:
        await student.ask("room", {"join": code})
    await at_rest(pid)
    before, ticks = cpu(pid), int(seconds / SHARING_SECONDS)
    for tick in range(ticks):
        for i, student in enumerate(students):
            await student.send({"note": {**first_values(), "a": float(value(tick + 7.3 * i))}})
        await asyncio.sleep(SHARING_SECONDS)
    spent = cpu(pid) - before
    for wire in (lecturer, *students):
        await wire.close()
    return spent / (ticks * pages)


def real_visit(browser: Browser, port: int) -> dict[str, Any]:
    """Open a page in Chromium, wait until its device answers, and drag: what it takes, and what the server hears."""
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    try:
        page = context.new_page()
        heard: list[Any] = []
        page.on("websocket", lambda socket: socket.on("framesent", lambda sent: heard.append(sent)))
        began = time.perf_counter()
        page.goto(f"http://localhost:{port}/")
        page.wait_for_selector(".codim2[data-ready]", timeout=60_000)
        opened = time.perf_counter() - began
        page.wait_for_function(f"() => {LINE}.worker", timeout=180_000)
        loaded = time.perf_counter() - began
        page.evaluate(f"() => {{ {LINE}.limits = {{quick: 1e9, patience: 1e9}} }}")
        page.locator(".codim2").evaluate(DRAG, ["f1", 1.0])  # the hand-over
        before = len(heard)
        moved = page.locator(".codim2").evaluate(DRAG, ["f1", 3.0])
        return {"opened": opened, "loaded": loaded, "painted": moved["painted"], "sent": len(heard) - before}
    finally:
        context.close()


async def crowd_of(port: int, pid: int, count: int, after: asyncio.Event) -> dict[str, Any]:
    """Let a crowd arrive, and stay for a while."""
    gone, before, began, at_first = asyncio.Event(), used(pid), time.perf_counter(), resident(pid)
    waited = queued()
    crowd, visits = await arrive(port, count, RATE, gone)
    while len(crowd.loads) + crowd.lost < count:
        await asyncio.sleep(0.1)
    came, took = used(pid) - before, time.perf_counter() - began
    waited = queued() - waited
    await after.wait()
    await at_rest(pid)
    before = used(pid)
    await asyncio.sleep(HELD)
    still, held = (used(pid) - before) / HELD, resident(pid)
    gone.set()
    await asyncio.gather(*visits)
    return {"crowd": crowd, "came": came, "took": took, "still": still, "memory": held - at_first, "waited": waited}


def play(port: int, pid: int, count: int) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Let a crowd arrive, of whom some are real."""
    loop, after = asyncio.new_event_loop(), asyncio.Event()
    with ThreadPoolExecutor(1) as other, launched() as browser:
        met = other.submit(loop.run_until_complete, crowd_of(port, pid, count, after))
        try:
            real = [real_visit(browser, port) for _ in range(REAL)]
        finally:
            loop.call_soon_threadsafe(after.set)
        found = met.result()
    loop.close()
    return found, real


def quantiles(seconds: list[float]) -> str:
    """Return the median and the p95."""
    return ", ".join(f"{q:.2f}" for q in np.quantile(seconds, (0.5, 0.95)))


def report(quick: bool = False) -> str:
    """Return the tables as Markdown."""
    release, count = os.environ["CODIM2_PYODIDE"], 100 if quick else VISITORS
    with serving("explorer", "2", "--pyodide", release, "--sessions", PLACES) as (port, pid):
        asyncio.run(at_rest(pid))
        asyncio.run(costs(port, pid, 20))
        asyncio.run(at_rest(pid))
        opening, files = asyncio.run(costs(port, pid, 40))
        asyncio.run(at_rest(pid))
        found, real = play(port, pid, count)
        load = os.getloadavg()[0]
    with serving("explorer") as (port, pid):
        asyncio.run(at_rest(pid))
        settled = asyncio.run(noted(port, pid, MANY, 5.0))
    crowd = found["crowd"]
    lines = [
        f"| {count} visitors at {RATE:g} a second, 2 processes, their devices compute | |",
        "|---|---|",
        f"| openings: median, p95, s (p95 to reach: 3) | {quantiles(crowd.openings)} |",
        f"| the worker's files: median, p95, s | {quantiles(crowd.loads)} |",
        f"| lost | {crowd.lost} |",
        f"| bytes for each | {crowd.bytes / count / 1e6:.1f} MB |",
        f"| server's processor time of an opening | {1e3 * opening:.1f} ms |",
        f"| server's processor time of the worker's files | {1e3 * files:.1f} ms |",
        f"| server's processor time of a visitor in all | {1e3 * found['came'] / count:.1f} ms |",
        f"| server's processors used while they come | {found['came'] / found['took']:.2f} |",
        f"| visitors waited for a processor that others had | {found['waited'] / found['took']:.0%} of the time |",
        f"| all {count} stay and move what their devices draw: server's processors used | {found['still']:.3f} |",
        f"| server's processor time of a settled change in a room (1 to reach) | {1e3 * settled:.2f} ms |",
        f"| server's memory for each page | {1e3 * found['memory'] / count:.0f} kB |",
        "",
        "| Chromium among them | there after, s | device answers after, s | painted /s | messages sent in a drag |",
        "|---|---|---|---|---|",
    ]
    for i, one in enumerate(real):
        lines.append(f"| {i + 1} | {one['opened']:.1f} | {one['loaded']:.1f} | {one['painted']:.0f} | {one['sent']} |")
    return "\n".join([*lines, "", f"Load of the machine then: {load:.1f}."])
