"""A machine on which nothing is compiled: a script's first results, and `codim2 serve` until a drag moves its picture.

``python -m tests.benchmarks fresh [--quick]``. Each is a process of its own whose folder of kernels is empty; seconds
from its command on.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.error import HTTPError
from urllib.request import urlopen

from playwright.sync_api import Browser

from .app_load import family, free_port
from .bench_browser import launched

#: What a script does first, by what it is called.
SCRIPTS = {
    "`import codim2_core`": "",
    "`trajectories` of 3 starts": "c2.trajectories(p.system, p.psi, [(0.3, 0.2), (1.4, 0.3), (-0.5, 0.1)])",
    "`classify`": "c2.classify(p.system, p.psi)",
    "`limit_cycles`, Case III": "p = c2.presets['case3-n2']; c2.limit_cycles(p.system, p.psi)",
    "`simulate_nonsmooth`, a ball": "c2.simulate_nonsmooth(c2.examples.ball_in_pool(K=2.0), (-1, .3, 10, 0), (0, 3))",
    "what a `Scene` draws": "drawn(c2.presets['case1-cm4'])",
    "what a `Scene` draws, Case III": "drawn(c2.presets['case3-n2'])",
    "what a `Scene` draws of a typed system": "drawn(c2.presets['nonunique-sliding'])",
}
BEGIN = """
import codim2_core as c2
p = c2.presets["case1-cm4"]
def drawn(preset):
    scene = c2.Scene(preset.system, preset.psi, preset.z)
    for name in ("inside", "outside", "nullclines_inside", "nullclines_outside", "cycles", "separatrices"):
        scene[name]
"""

#: Moves f1, and waits until a frame of it is painted: milliseconds since the page was asked for.
MOVE = """(root) => new Promise((done) => {
    const {picture} = root.explorer, apply = picture.apply.bind(picture), slider = root.querySelector("#c2-f1")
    picture.apply = (frame) => {
        apply(frame)
        if (!("f1" in (frame.header.set ?? {}))) return
        picture.apply = apply
        requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now())))
    }
    slider.value = 0.5 * (Number(slider.value) + Number(slider.max))
    slider.dispatchEvent(new Event("input", {bubbles: true}))
})"""

#: All small portraits are there: those of the strip, and of the atlas's regions.
DRAWN = """document.querySelectorAll('.gallery [data-preset] path').length > 7
    && document.querySelector('.thumbnails:not(.old) svg')"""


def emptied(folder: str) -> dict[str, str]:
    """Return the environment of a process that finds no kernels."""
    return {**os.environ, "NUMBA_CACHE_DIR": folder, "PYTHONUNBUFFERED": "1"}


def first_result(code: str) -> float:
    """Return the seconds of a script on an empty disk."""
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        subprocess.run([sys.executable, "-c", BEGIN + code], env=emptied(folder), check=True, capture_output=True)
        return time.perf_counter() - start


class Watch(threading.Thread):
    """Watches the memory of a server and of the processes that it begins, in bytes, until it is stopped.

    Pages that several share are counted once in the sum.
    """

    def __init__(self, pid: int) -> None:
        super().__init__(daemon=True)
        self.pid, self.own, self.others, self.all, self.goes_on = pid, 0, 0, 0, True
        self.start()

    def run(self) -> None:
        """Look every tenth of a second."""
        while self.goes_on:
            try:
                pids = family(self.pid)
                held = {pid: _resident(pid) for pid in pids}
                self.all = max(self.all, sum(map(_share, pids)))
            except OSError:  # one has just ended
                continue
            self.own = max(self.own, held[self.pid])
            self.others = max(self.others, *held.values()) if len(held) > 1 else self.others
            time.sleep(0.1)


def _resident(pid: int) -> int:
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")
    except OSError:  # it has just ended
        return 0


def _share(pid: int) -> int:
    """Return what a process holds, with a part of each page that it shares."""
    try:
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    except OSError:  # it has just ended
        return 0
    return sum(1024 * int(line.split()[1]) for line in lines if line.startswith("Pss:"))


class Ready(threading.Thread):
    """Asks a server again and again whether it is ready, and notes when it is."""

    def __init__(self, port: int) -> None:
        super().__init__(daemon=True)
        self.port, self.at = port, 0.0
        self.start()

    def run(self) -> None:
        """Ask five times a second."""
        while not _answers(self.port, "/ready"):
            time.sleep(0.2)
        self.at = time.perf_counter()


@contextmanager
def begun(folder: str, *options: str) -> Iterator[tuple[int, subprocess.Popen[bytes], float]]:
    """Begin a server; yield its port, itself, and when that was."""
    port = free_port()
    command = [sys.executable, "-m", "codim2_app.server.cli", "serve", "--port", str(port), *options]
    start = time.perf_counter()
    process = subprocess.Popen(command, env=emptied(folder), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield port, process, start
    finally:
        process.terminate()
        process.wait(30)


def _answers(port: int, path: str) -> bool:
    try:
        urlopen(f"http://localhost:{port}{path}", timeout=20).read()
    except HTTPError as error:
        error.read()
        return False
    except OSError:
        return False
    return True


def _is_compiled(port: int) -> bool:
    done, of = json.loads(urlopen(f"http://localhost:{port}/ready").read())["compiled"]
    return done == of


def visit(browser: Browser, folder: str, everything: bool) -> dict[str, float]:
    """Open a server's page as soon as there is one; return the seconds of all, and the memory."""
    with begun(folder) as (port, process, start):
        watch = Watch(process.pid)
        while not _answers(port, "/health"):
            time.sleep(0.02)
        found = {"listens": time.perf_counter() - start}
        asking = Ready(port)
        context = browser.new_context(viewport={"width": 1440, "height": 900}, bypass_csp=True)
        page = context.new_page()
        asked = time.perf_counter() - start
        page.goto(f"http://localhost:{port}/", wait_until="commit")
        page.wait_for_function("document.querySelector('.codim2')?.explorer", polling=20)
        found["moves"] = asked + 1e-3 * float(page.locator(".codim2").evaluate(MOVE))
        page.wait_for_function(DRAWN, timeout=600_000)
        found["thumbnails"] = time.perf_counter() - start
        page.wait_for_selector(".codim2[data-settled=true]", timeout=600_000)
        found["whole"] = time.perf_counter() - start
        asking.join()
        found["ready"] = asking.at - start
        while everything and not _is_compiled(port):
            time.sleep(0.5)
        found["all"] = time.perf_counter() - start
        context.close()
        watch.goes_on = False
        watch.join()
        return {**found, "own": watch.own, "others": watch.others, "together": watch.all}


def report(quick: bool = False) -> str:
    """Return the tables as Markdown."""
    lines = ["| a script on an empty disk | seconds, with the imports |", "|---|---|"]
    lines += [f"| {what} | {first_result(code):.1f} |" for what, code in SCRIPTS.items()]
    with launched() as browser, tempfile.TemporaryDirectory() as folder:
        found = [visit(browser, folder, everything=not quick)]
        if not quick:
            found.append(visit(browser, folder, everything=True))
    titles = ["empty disk", "second start"][: len(found)]
    lines += ["", f"| `codim2 serve` | {' | '.join(titles)} |", "|---" * (1 + len(found)) + "|"]
    rows = {
        "listens": "listens, s", "ready": "/ready, s", "moves": "a slider moves the picture, s",
        "thumbnails": "small portraits are drawn, s", "whole": "all next to it too, s",
        "all": "all kernels are loaded, s",
        "own": "the server's memory at most, MB", "others": "the largest process next to it, MB",
        "together": "all together at most, MB",
    }  # fmt: skip
    for key, words in rows.items():
        told = [f"{1e-6 * one[key]:.0f}" if words.endswith("MB") else f"{one[key]:.1f}" for one in found]
        lines.append(f"| {words} | {' | '.join(told)} |")
    return "\n".join(lines)
