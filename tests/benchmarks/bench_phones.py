"""Phones: how long a change takes whose answer a device computes, on a page of files and on a server's page.

``CODIM2_PYODIDE=DIR python -m tests.benchmarks phones [--quick]``. A phone is Chromium with a small window whose
process, page and worker alike, runs for a part of the time only: every few milliseconds it is stopped and goes on.
DevTools throttles no worker. What composes the picture is another process, which is not slower.
"""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from threading import Event, Thread
from typing import Any

from codim2_app.server.cli import main
from playwright.sync_api import Browser

from ..app.serving import files_of, serving
from .app_load import family
from .dragging import DRAG, launched

RATES = (1, 4, 6)
SLICE = 0.002  # seconds for which a slowed process runs at a time
LOOKED_AFTER = 1.0  # seconds after which it is looked again which processes there are
PHONE: Any = {"viewport": {"width": 390, "height": 844}, "device_scale_factor": 3, "has_touch": True}
LINE = "document.querySelector('.codim2').explorer.line"
PATIENCE = 300_000  # ms
PANELS = ("diagram", "along", "solid")  # which compute for longest
BURSTS, RESTING, LOADING = 6, 400, 15_000  # of a drag; ms between two, and after the first change

#: Moves f1 as soon as the page is there; returns ms from the start of the page to that, and to the frame that shows it.
CHANGE = """async () => {
    const find = () => document.querySelector(".codim2[data-ready]")
    while (!find()?.explorer) await new Promise(requestAnimationFrame)
    const {picture, values} = find().explorer, there = performance.now(), wanted = values.f1 + 0.2
    const shown = new Promise((done) => {
        const apply = picture.apply.bind(picture)
        picture.apply = (frame) => { apply(frame); if (frame.header.set?.f1 === wanted) done(performance.now()) }
    })
    const slider = find().querySelector("#c2-f1")
    slider.step = "any"
    slider.value = wanted
    slider.dispatchEvent(new Event("input", {bubbles: true}))
    slider.dispatchEvent(new Event("change", {bubbles: true}))
    return [there, await shown]
}"""


def main_process(browser: Browser) -> int:
    """Return the process of a browser that has started all others."""
    session = browser.new_browser_cdp_session()
    processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
    session.detach()
    return next(int(process["id"]) for process in processes if process["type"] == "browser")


def renderers(pid: int) -> list[int]:
    """Return the processes in which a browser's pages run, with their workers."""
    return [one for one in family(pid) if b"--type=renderer" in Path(f"/proc/{one}/cmdline").read_bytes()]


@contextmanager
def slowed(pid: int, rate: int) -> Iterator[None]:
    """Let a browser's pages run for one in `rate` parts of the time."""
    done, pages = Event(), list[int]()

    def signal_all(number: int) -> None:
        for one in pages:
            with suppress(ProcessLookupError):
                os.kill(one, number)

    def alternate() -> None:
        looked = 0.0
        while not done.is_set():
            signal_all(signal.SIGCONT)
            began = time.perf_counter()
            time.sleep(SLICE)
            signal_all(signal.SIGSTOP)
            stopped = time.perf_counter()
            if stopped - looked > LOOKED_AFTER:
                with suppress(OSError):  # one has just ended: next time
                    pages[:] = renderers(pid)  # a page of another host has another process
                looked = time.perf_counter()
            time.sleep(max(0.0, (rate - 1) * (stopped - began) - (time.perf_counter() - stopped)))
        signal_all(signal.SIGCONT)

    thread = Thread(target=alternate)
    if rate > 1:
        thread.start()
    try:
        yield
    finally:
        done.set()
        if rate > 1:
            thread.join()


def visit(browser: Browser, address: str, rate: int, seconds: float, handed_over: bool) -> dict[str, Any]:
    """Open a page, move f1 at once, and drag it; on a server's page, once the device answers."""
    context = browser.new_context(**PHONE)
    context.set_default_timeout(PATIENCE)
    try:
        page = context.new_page()
        with slowed(main_process(browser), rate):
            page.goto(address, wait_until="commit")
            there, changed = page.evaluate(CHANGE)
            loaded = None
            if handed_over:
                page.evaluate(f"() => {{ {LINE}.limits = {{quick: 1e9, patience: 1e9}} }}")
                page.wait_for_function(f"() => {LINE}.worker")
                loaded = page.evaluate("performance.now()")
            root = page.locator(".codim2")
            root.evaluate(DRAG, ["f1", 2.0])
            moved = root.evaluate(DRAG, ["f1", seconds])
        return {"there": there, "changed": changed, "loaded": loaded, **moved}
    finally:
        context.close()


def computed_beside(browser: Browser, address: str, panel: str, bursts: int) -> list[float]:
    """Return the delays of a drag that rests and goes on, again and again, while a panel computes what it shows."""
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    context.set_default_timeout(PATIENCE)
    try:
        page = context.new_page()
        page.goto(f"{address}?panel={panel}")
        page.evaluate(CHANGE)
        page.wait_for_timeout(LOADING)  # a second worker comes, if there is one
        delays: list[float] = []
        for _ in range(bursts):
            delays += page.locator(".codim2").evaluate(DRAG, ["f1", 1.0])["delays"]
            page.wait_for_timeout(RESTING)
        return sorted(delays)
    finally:
        context.close()


def quantiles(delays: list[float]) -> str:
    """Return the median, the p95 and the longest of some delays, in order."""
    return f"{median(delays):.0f}, {delays[int(0.95 * len(delays))]:.0f}, {delays[-1]:.0f}" if delays else "–"


def row(where: str, rate: int, found: dict[str, Any]) -> str:
    """Return the row of a visit."""
    late = quantiles(sorted(found["delays"]))
    loaded = "–" if found["loaded"] is None else f"{1e-3 * found['loaded']:.1f}"
    return (
        f"| {where} | {rate} | {1e-3 * found['there']:.1f} | {1e-3 * found['changed']:.1f} | {loaded} "
        f"| {found['painted']:.1f} | {late} |"
    )


def report(quick: bool = False) -> str:
    """Return the table as Markdown."""
    release, seconds = os.environ["CODIM2_PYODIDE"], 2.0 if quick else 5.0
    lines = [
        "| page | times slower | controls there, s | first change shown, s | device answers, s | painted /s "
        "| change to picture in a drag, ms: median, p95, longest |",
        "|---|---|---|---|---|---|---|",
    ]
    rates = RATES[: 2 if quick else None]
    stalls = [
        "",
        "| panel that computes when a drag rests | change to picture, ms: median, p95, longest |",
        "|---|---|",
    ]
    with TemporaryDirectory() as folder, launched() as browser:
        main(["static", "-o", folder, "--pyodide", release])
        with files_of(Path(folder)) as address:
            lines += [row("of files", rate, visit(browser, f"{address}/", rate, seconds, False)) for rate in rates]
            for panel in PANELS[: 1 if quick else None]:
                delays = computed_beside(browser, f"{address}/", panel, BURSTS)
                stalls.append(f"| {panel} | {quantiles(delays)} |")
        with serving("--pyodide", release) as address:
            lines += [row("of a server", rate, visit(browser, f"{address}/", rate, seconds, True)) for rate in rates]
    return "\n".join([*lines, *stalls, "", f"Load of the machine then: {os.getloadavg()[0]:.1f}."])
