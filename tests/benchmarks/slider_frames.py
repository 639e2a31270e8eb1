"""Frames of a slider that is dragged: calls of functions, and time. Runs here, and in Pyodide as in a page's worker."""

import json
import math
import statistics
import sys
import time

#: Portrait ("" is the first one) and slider.
DRAGS = (("", "f1"), ("case3-n2", "f1"), ("nonunique-sliding", "z"))
WARM_FRAMES, COUNTED_FRAMES, TIMED_FRAMES = 20, 20, 200
REACH = 0.1
NOW = time.perf_counter_ns if sys.platform == "emscripten" else time.process_time_ns


def opened(portrait):
    """Return the frames of a page that shows a portrait."""
    from codim2_app.picture.state.controls import ExplorerState, preset_values
    from codim2_app.view.refresh import Frames

    page = Frames(ExplorerState())
    page.answer({"id": 0, "all": True, "set": {"preset": portrait, **preset_values(portrait)} if portrait else {}})
    page.publish()
    return page


def calls_of(function):
    """Return how often Python's functions, and those of C that Python's bytecode calls, are called meanwhile."""
    counts = {"call": 0, "c_call": 0}

    def count(_frame, event, _argument):
        if event in counts:
            counts[event] += 1

    sys.setprofile(count)
    try:
        function()
    finally:
        sys.setprofile(None)
    return counts["call"] - 1, counts["c_call"] - 1  # this function's own


def drag(portrait, slider):
    """Return the calls of Python and of C of a frame, in the mean, and the median of its milliseconds."""
    page = opened(portrait)
    middle = page.values[slider]
    ticks = iter(range(1, WARM_FRAMES + COUNTED_FRAMES + TIMED_FRAMES + 1))

    def move():
        tick = next(ticks)
        page.answer({"id": tick, "set": {slider: middle + REACH * math.sin(0.37 * tick)}})

    def move_often(count):
        for _ in range(count):
            move()

    move_often(WARM_FRAMES)
    python, c = calls_of(lambda: move_often(COUNTED_FRAMES))
    times = []
    for _ in range(TIMED_FRAMES):
        began = NOW()
        move()
        times.append(1e-6 * (NOW() - began))
    return {"python": python / COUNTED_FRAMES, "c": c / COUNTED_FRAMES, "ms": statistics.median(times)}


def written():
    """Return what is measured of every drag, as JSON."""
    return json.dumps([drag(*one) for one in DRAGS]).encode()
