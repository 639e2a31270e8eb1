"""A drag of a slider in a browser: frames that are painted, and the delay of each from its event."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager

from playwright.sync_api import Browser, sync_playwright

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
