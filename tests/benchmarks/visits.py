"""Visitors as they are: each opens a page, drags, opens a portrait, launches an orbit, may type, and is gone.

They come in by real websockets, one after the other on each of so many chairs, and leave without a goodbye.
"""

from __future__ import annotations

import asyncio
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from codim2_app.state.controls import preset_values
from codim2_app.state.portraits import portrait_keys
from tornado.httpclient import HTTPClientError

from .app_load import RATE, page, value
from .wire import Wire

TYPISTS = 8  # one visitor of so many types a formula
#: What is done, and for how many ticks of a visit at `RATE`.
TICKS = {"drag": 20, "portrait": 3, "launch": 10, "type": 6}
FORMULA = "-c+0.{}*z"

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


async def visit(port: int, number: int, chair: Chair, goes_on: Callable[[], bool] = lambda: True) -> None:
    """Play one visitor, or note that he was lost."""
    try:
        await _played(port, number, chair, goes_on)
    except (OSError, HTTPClientError):
        chair.lost += 1


async def _played(port: int, number: int, chair: Chair, goes_on: Callable[[], bool]) -> None:
    """One frame in flight, at most `RATE` a second, and no goodbye."""
    began = time.perf_counter()
    await asyncio.to_thread(page, port)
    wire = await Wire.connect(port)
    chair.delays["open"].append(time.perf_counter() - began)
    chair.visits += 1
    for tick, (what, values) in enumerate(asked(number)):
        if not goes_on():
            break
        before = time.perf_counter()
        await wire.frame(tick, **values)
        took = time.perf_counter() - before
        chair.delays[what].append(took)
        chair.answered += 1
        await asyncio.sleep(max(0.0, 1.0 / RATE - took))
        chair.seconds += time.perf_counter() - before
    await wire.vanish()


async def seated(port: int, chairs: int, seconds: float) -> list[Chair]:
    """Let visitors come and go on so many chairs, each for as long as this lasts."""
    end = time.perf_counter() + seconds
    goes_on = lambda: time.perf_counter() < end
    found = [Chair() for _ in range(chairs)]

    async def sit(i: int) -> None:
        await asyncio.sleep(i / RATE / chairs)
        number = i
        while goes_on():
            await visit(port, number, found[i], goes_on)
            number += chairs

    await asyncio.gather(*(sit(i) for i in range(chairs)))
    return found
