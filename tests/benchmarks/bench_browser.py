"""A drag in a browser: painted frames, the browser's time for each, and from the event to the painted frame.

``python -m tests.benchmarks browser [--quick]``. On a loaded machine only the processor time of a frame can be trusted.
"""

from __future__ import annotations

import os
import shutil
import statistics
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from playwright.sync_api import Browser, sync_playwright

from ..app.serving import serving

#: A slider that moves once in each frame of the screen, a tenth of its range to both sides, and what is painted
#: meanwhile: the frames of the screen in which the picture was drawn, each of which shows a value that it knows.
DRAG = """async (root, [name, seconds]) => {
    const slider = root.querySelector(`#c2-${name}`), asked = new Map(), delays = []
    const {picture, requests, values} = root.explorer, view = picture.drawn.view
    const apply = picture.apply.bind(picture), paint = view._paint.bind(view), send = requests.send
    const middle = values[name], reach = 0.1 * (slider.max - slider.min)
    let shown = null, most = 0, long = 0, frames = 0, painted = 0, fresh = true
    picture.apply = (frame) => { shown = frame.header.set?.[name] ?? shown; apply(frame) }
    view._paint = (ctx) => {
        paint(ctx)
        if (fresh) painted++
        fresh = false
        if (asked.has(shown)) { delays.push(performance.now() - asked.get(shown)); asked.delete(shown) }
    }
    requests.send = (request) => { most = Math.max(most, requests.out.size); send(request) }
    const observer = new PerformanceObserver((entries) => { long += entries.getEntries().length })
    observer.observe({entryTypes: ["longtask"]})
    const start = performance.now(), step = slider.step
    slider.step = "any"
    while (performance.now() - start < 1000 * seconds) {
        await new Promise(requestAnimationFrame)
        fresh = true
        slider.value = middle + reach * (Math.sin((performance.now() - start) / 700) + 1e-6 * frames++)
        slider.dispatchEvent(new Event("input", {bubbles: true}))
        asked.set(values[name], performance.now())
    }
    const passed = (performance.now() - start) / 1000
    observer.disconnect()
    slider.step = step
    Object.assign(picture, {apply}); Object.assign(view, {_paint: paint}); Object.assign(requests, {send})
    return {painted: painted / passed, frames: frames / passed, passed, delays, long, most}
}"""


@dataclass(frozen=True)
class Case:
    """Where and on what it is dragged."""

    name: str
    throttle: int = 1
    query: str = ""
    width: int = 1440
    height: int = 900
    ratio: int = 1
    slider: str = "f1"


ALL = "outside,inside,continuations,separatrices,cycles,rho,theta,lines,equator,critical,outcomes,basins"
CASES = (
    Case("default portrait"),
    Case("4 times slower", throttle=4),
    Case("all layers", query=f"?layers={ALL}"),
    Case("Case III", query="?preset=case3-n3"),
    Case("Case III, all layers", query=f"?preset=case3-n3&layers={ALL}"),
    Case("phone, ratio 3", width=390, height=844, ratio=3),
)  # fmt: skip
QUICK = CASES[:2]
#: Every slider of the e-linear system, and the addresses of those that the first page does not have.
SLIDERS = ("a", "b", "d", "f1", "f2", "z", "k1", "k2", "B1", "B2", "g0", "n")
QUERIES = {"n": "?psi=hill&n=3", "k1": "?z=1", "k2": "?z=1"}
SLOWER = 4


@contextmanager
def launched() -> Iterator[Browser]:
    """Run Chromium without a window."""
    path = os.environ.get("CODIM2_CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=path, args=["--headless=new", "--no-sandbox", "--disable-gpu"]
        )
        yield browser
        browser.close()


def _processor(browser: Browser) -> float:
    """Return the seconds that the renderer processes have taken so far."""
    session = browser.new_browser_cdp_session()
    processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
    session.detach()
    return sum(process["cpuTime"] for process in processes if process["type"] == "renderer")


def drag(browser: Browser, address: str, case: Case, seconds: float) -> dict[str, Any]:
    """Drag a slider of one page and return what was painted; "cpu" is the renderer's ms for a painted frame."""
    viewport = {"width": case.width, "height": case.height}
    context = browser.new_context(viewport=viewport, device_scale_factor=case.ratio)  # type: ignore[arg-type]
    try:
        page = context.new_page()
        page.goto(f"{address}/{case.query}")
        page.wait_for_selector(".codim2[data-settled=true]", timeout=60_000)
        page.wait_for_timeout(1000)
        root = page.locator(".codim2")
        if case.throttle > 1:
            context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": case.throttle})
        root.evaluate(DRAG, [case.slider, 1.5])  # the window of requests finds its size
        before = _processor(browser)
        found = root.evaluate(DRAG, [case.slider, seconds])
        found["cpu"] = 1000 * (_processor(browser) - before) / max(1.0, found["painted"] * found["passed"])
        return found
    finally:
        context.close()


def report(quick: bool = False) -> str:
    """Return the table of all cases, and what is painted of every slider."""
    rows = [
        "| drag of f1 | painted /s | animation frames /s | renderer's CPU a frame, ms | event to painted, ms: "
        "median, p95 | tasks > 50 ms | most requests out |",
        "|---|---|---|---|---|---|---|",
    ]
    seconds, times = (2.0, 1) if quick else (3.0, 3)
    with serving() as address, launched() as browser:
        drag(browser, address, CASES[0], 2.0)  # what a server still loads after its first page is no part of a drag
        rows += [
            _row(case, [drag(browser, address, case, seconds) for _ in range(times)])
            for case in (QUICK if quick else CASES)
        ]
        rows += [
            "",
            f"| slider | painted /s | renderer's CPU a frame, ms | {SLOWER} times slower: painted /s |",
            "|---|---|---|---|",
        ]
        for name in SLIDERS:
            cases = [Case(name, rate, QUERIES.get(name, ""), slider=name) for rate in (1, SLOWER)]
            fast, slow = (drag(browser, address, case, seconds) for case in cases)
            rows.append(f"| {name} | {fast['painted']:.1f} | {fast['cpu']:.1f} | {slow['painted']:.1f} |")
    return "\n".join(rows)


def _row(case: Case, runs: list[dict[str, Any]]) -> str:
    def middle(key: str) -> float:
        return statistics.median(run[key] for run in runs)

    delays = sorted(delay for run in runs for delay in run["delays"])
    waits = f"{statistics.median(delays):.0f}, {delays[int(0.95 * len(delays))]:.0f}" if delays else "–"
    most = max(run["most"] for run in runs) or "–"
    counts = f"{middle('painted'):.1f} | {middle('frames'):.1f} | {middle('cpu'):.1f}"
    return f"| {case.name} | {counts} | {waits} | {sum(run['long'] for run in runs)} | {most} |"
