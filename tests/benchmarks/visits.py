"""Visitors as they are: each opens a page, drags, opens a portrait, launches an orbit, may type, and is gone.

They come in by real websockets, one after the other on each of so many chairs, and leave without a goodbye.
"""

from __future__ import annotations

import asyncio
import itertools
import random
import time
from collections import defaultdict
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import Process
from typing import Any

from codim2_app.picture.state.controls import preset_values
from codim2_app.picture.state.portraits import portrait_keys
from tornado.httpclient import HTTPClientError

from .app_load import RATE, page, value
from .wire import Wire

TYPISTS = 8  # one visitor of so many types a formula
#: What is done, and for how many ticks of a visit at `RATE`.
TICKS = {"drag": 20, "portrait": 3, "launch": 10, "type": 6}
FORMULA = "-c+0.{}*z"
TICKS_OF_TEN = 10  # at which who moves all the time does

#: Says for how many seconds who measures, and who is measured, has waited for a processor: the longer is not own.
Waited = Callable[[], tuple[float, ...]]
Ask = tuple[str, dict[str, Any]]


def asked(number: int) -> Iterator[Ask]:
    """What a visitor does, tick by tick: what it is called, and the values that are set."""
    keys = list(portrait_keys())
    for tick in range(TICKS["drag"]):
        yield "drag", {"a": float(value(tick + 7.3 * number))}
    for tick in range(TICKS["portrait"]):
        key = keys[(3 * number + tick) % len(keys)]
        yield "portrait", {"preset": key, **preset_values(key)}
    for tick in range(TICKS["launch"]):
        yield "launch", {"orbits": f"{0.3 + 0.01 * tick},{0.2 + 0.001 * (number % 100)}"}
    if number % TYPISTS == 0:
        text = FORMULA.format(number)
        for left in reversed(range(TICKS["type"])):
            yield "type", {"system": "own", "texts": {"U1": text[: len(text) - left], "U2": "-s", "W": "0"}}


@dataclass
class Chair:
    """What one chair's visitors, one after the other, have seen."""

    visits: int = 0
    lost: int = 0  # visits that ended before their end: nobody answered, or the connection was closed
    answered: int = 0
    seconds: float = 0.0  # for which somebody moved something
    delays: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))
    own: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))  # without waiting for a processor

    async def timed(self, what: str, doing: Awaitable[Any], waited: Waited) -> Any:
        """Await something, and note how long it took."""
        began, before = time.perf_counter(), waited()
        found = await doing
        took = time.perf_counter() - began
        self.delays[what].append(took)
        self.own[what].append(max(0.0, took - max(after - then for then, after in zip(before, waited(), strict=True))))
        return found


async def visit(
    port: int, number: int, chair: Chair, goes_on: Callable[[], bool] = lambda: True,
    moving: int = TICKS_OF_TEN, waited: Waited = lambda: (0.0,),
) -> None:  # fmt: skip
    """Play one visitor, or note that he was lost."""
    try:
        await _played(port, number, chair, goes_on, moving, waited)
    except (OSError, HTTPClientError):
        chair.lost += 1


async def _open(port: int) -> Wire:
    await asyncio.to_thread(page, port)
    return await Wire.connect(port)


async def _played(
    port: int, number: int, chair: Chair, goes_on: Callable[[], bool], moving: int, waited: Waited
) -> None:
    """One frame in flight, at most `RATE` a second and at so many of ten ticks, and no goodbye."""
    wire = await chair.timed("open", _open(port), waited)
    chair.visits += 1
    chance = random.Random(number)
    for tick, (what, values) in enumerate(asked(number)):
        while chance.random() > moving / TICKS_OF_TEN:
            await asyncio.sleep(1.0 / RATE)
        if not goes_on():
            break
        before = time.perf_counter()
        await chair.timed(what, wire.frame(tick, **values), waited)
        chair.answered += 1
        await asyncio.sleep(max(0.0, 1.0 / RATE - (time.perf_counter() - before)))
        chair.seconds += time.perf_counter() - before
    await wire.vanish()


async def seated(
    port: int, chairs: int, seconds: float, moving: int = TICKS_OF_TEN, waited: Waited = lambda: (0.0,)
) -> list[Chair]:
    """Let visitors come and go on so many chairs, each for as long as this lasts; they come evenly over a visit."""
    visit_seconds = sum(TICKS.values()) / RATE * TICKS_OF_TEN / moving
    end = time.perf_counter() + visit_seconds + seconds
    goes_on = lambda: time.perf_counter() < end
    found = [Chair() for _ in range(chairs)]

    async def sit(i: int) -> None:
        await asyncio.sleep(i * visit_seconds / chairs)
        number = i
        while goes_on():
            await visit(port, number, found[i], goes_on, moving, waited)
            number += chairs

    await asyncio.gather(*(sit(i) for i in range(chairs)))
    return found


#: What a visitor may do to others: slow spirals, formulas that turn hundreds of times, many launched orbits.
SPIRAL = {"a": -0.0489, "b": -28.19, "d": -0.0108, "f1": -0.9785, "f2": 0.2402, "psi": "hill", "n": 8.0}
WILD: dict[str, Callable[[int], dict[str, Any]]] = {
    "outcomes of a slow spiral": lambda i: {**SPIRAL, "a": -0.0489 - 1e-5 * i, "layers": ["outcomes", "equator"]},
    "12 orbits on a slow spiral": lambda i: {
        **SPIRAL, "layers": ["launched"],
        "orbits": ";".join(f"{0.05 * k + 1e-4 * (i % 100):.4f},0.2" for k in range(12)),
    },
    "a formula that turns": lambda i: {
        "system": "own", "texts": {"U1": f"sin({200 + i}*c)-c", "U2": f"cos({200 + i}*s)", "W": "0"},
    },
}  # fmt: skip


@contextmanager
def fetched(port: int, connections: int) -> Iterator[None]:
    """Ask for pages of new addresses meanwhile, in a process each, as fast as they come."""
    fetching = [Process(target=_fetch, args=(port, number), daemon=True) for number in range(connections)]
    for one in fetching:
        one.start()
    try:
        yield
    finally:
        for one in fetching:
            one.terminate()
            one.join()


def _fetch(port: int, number: int) -> None:
    for i in itertools.count():
        page(port, f"?a={-1.0 - 0.1 * number - 1e-6 * i}")


async def beside(port: int, wild: Callable[[int], dict[str, Any]] | None, frames: int, waited: Waited) -> list[float]:
    """Return the own delays of somebody who drags while another one, if any, does this, each as fast as he can."""
    wire, chair = await Wire.connect(port), Chair()

    async def rage() -> None:
        if wild is None:
            return
        other = await Wire.connect(port)
        for i in itertools.count():
            await other.frame(i, **wild(i))

    raging = asyncio.ensure_future(rage())
    for tick in range(frames):
        await chair.timed("drag", wire.frame(tick, a=float(value(tick))), waited)
    raging.cancel()
    await wire.vanish()
    return chair.own["drag"]
