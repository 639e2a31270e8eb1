"""The first page against a bare Panel page with an empty Bokeh figure: first byte, first stroke, processor time.

``python -m tests.benchmarks page [--quick]``. The two servers take turns; what is compared is the median of the ratios
within one turn. A stroke is one on a canvas of the page: of the figure's axes there, of the live picture here.
"""

from __future__ import annotations

import asyncio
import time
from contextlib import ExitStack
from statistics import median
from typing import Any
from urllib.request import urlopen

from playwright.sync_api import Browser

from .app_load import at_rest, cpu, serving
from .app_load import page as page_text
from .bench_browser import launched
from .wire import Wire

KINDS = {"panel": "bare Panel page, empty Bokeh figure", "explorer": "explorer"}
BYTES = 10  # first bytes measured in each turn, one after the other

#: Notes when something is first drawn on a canvas: milliseconds since the page was asked for.
NOTED = """{
    const stroke = CanvasRenderingContext2D.prototype.stroke
    CanvasRenderingContext2D.prototype.stroke = function (...path) {
        if (this.canvas.isConnected) document.documentElement.dataset.stroke ??= performance.now()
        return stroke.apply(this, path)
    }
}"""


def first_byte(port: int) -> float:
    """Return the seconds until a page's first byte."""
    times = []
    for _ in range(BYTES):
        start = time.perf_counter()
        with urlopen(f"http://localhost:{port}/") as answer:
            answer.read(1)
            times.append(time.perf_counter() - start)
            answer.read()
    return median(times)


def first_stroke(browser: Browser, port: int) -> float:
    """Return the seconds until the first stroke in a browser that has never been there."""
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    try:
        page = context.new_page()
        page.add_init_script(NOTED)
        page.goto(f"http://localhost:{port}/")
        page.wait_for_selector("html[data-stroke]", timeout=60_000)
        return 1e-3 * float(page.evaluate("document.documentElement.dataset.stroke"))
    finally:
        context.close()


async def arrivals(kind: str, port: int, pid: int, count: int) -> float:
    """Return the server's processor time of a page, and of what it begins with, in seconds."""
    before = cpu(pid)
    for _ in range(count):
        await asyncio.to_thread(page_text, port)
        if kind == "explorer":  # of Panel's page a session has been made already
            await (await Wire.connect(port)).close()
    return (cpu(pid) - before) / count


def run(turns: int) -> dict[str, list[dict[str, Any]]]:
    """Measure both servers in turns: rows by kind, one for each turn."""
    found: dict[str, list[dict[str, Any]]] = {kind: [] for kind in KINDS}
    with ExitStack() as stack:
        servers = {kind: stack.enter_context(serving(kind)) for kind in KINDS}
        browser = stack.enter_context(launched())
        for port, pid in servers.values():
            first_stroke(browser, port)
            _run(at_rest(pid))
        for _ in range(turns):
            for kind, (port, pid) in servers.items():
                byte = first_byte(port)
                stroke = first_stroke(browser, port)
                used = _run(arrivals(kind, port, pid, 10))
                found[kind].append({"byte": byte, "stroke": stroke, "cpu": used})
                _run(at_rest(pid))
    return found


def _run(what: Any) -> Any:
    """Run a coroutine in a thread of its own: Playwright's loop runs in this one."""
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(1) as one:
        return one.submit(asyncio.run, what).result()


def report(quick: bool = False) -> str:
    """Return the table as Markdown."""
    found = run(2 if quick else 7)
    lines = ["| page | first byte | first stroke in a browser | server's CPU a page |", "|---|---|---|---|"]
    for kind, title in KINDS.items():
        rows = found[kind]
        byte, stroke, used = (1e3 * median(row[key] for row in rows) for key in ("byte", "stroke", "cpu"))
        lines.append(f"| {title} | {byte:.1f} ms | {stroke:.0f} ms | {used:.0f} ms |")
    ratios = {
        key: median(ours[key] / bare[key] for ours, bare in zip(found["explorer"], found["panel"], strict=True))
        for key in ("byte", "stroke", "cpu")
    }
    lines.append(
        f"\nExplorer over bare page, median of {len(found['panel'])} turns: first byte {ratios['byte']:.2f}, "
        f"first stroke {ratios['stroke']:.2f}, CPU {ratios['cpu']:.2f}."
    )
    return "\n".join(lines)
