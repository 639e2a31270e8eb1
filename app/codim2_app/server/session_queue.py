"""A round robin of pages with one request each; every fourth turn goes to a page that opens.

A page that asks for more than it is answered keeps its newest values only, and nobody else waits for it.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections import deque
from collections.abc import Callable
from typing import Protocol, TypeVar

from .process.compile_throttle import answering

TurnResult = TypeVar("TurnResult")

#: Of so many turns one is that of somebody who opens a page, if there is one.
FOURTH = 4
#: Turns of the loop between two turns: so what has come over any line meanwhile is in the circle.
TURNS_PER_OPENING = 4


class Page(Protocol):
    """One who has turns."""

    def turn(self) -> None:
        """Do what is asked of it, once."""


class Rota:
    """The turns of one process."""

    def __init__(self) -> None:
        self._pages: dict[Page, float] = {}  # since when each has waited, in the order of their turns
        self._coming: dict[str, deque[Callable[[], None]]] = {}  # by network address, in the order of their turns
        self._task: asyncio.Task[None] | None = None
        self._turns = 0
        self.waited: Callable[[float], object] = lambda seconds: None  # noqa: ARG005 (called with how long one has waited)

    def ask(self, page: Page) -> None:
        """Give a page a turn, unless it waits for one."""
        self._pages.setdefault(page, time.monotonic())
        self._begin()

    def come_in(self, opening: Callable[[], None], address: str = "") -> None:
        """Have somebody let in; network addresses take turns, whatever one asks for."""
        self._coming.setdefault(address, deque()).append(opening)
        self._begin()

    async def take_turn(self, do: Callable[[], TurnResult], address: str) -> TurnResult:
        """Return what a function gives, which is called in the turn of somebody who comes in."""
        given: asyncio.Future[TurnResult] = asyncio.get_running_loop().create_future()

        def turn() -> None:
            if given.cancelled():
                return
            try:
                given.set_result(do())
            except Exception as error:  # of who asked
                given.set_exception(error)

        self.come_in(turn, address)
        return await given

    def leave(self, page: Page) -> None:
        """Give a page no turn any more."""
        self._pages.pop(page, None)

    @property
    def waiting(self) -> int:
        """Return the number of pages that wait for a turn."""
        return len(self._pages) + sum(map(len, self._coming.values()))

    def _begin(self) -> None:
        if self._task is None:
            self._task = asyncio.get_running_loop().create_task(self._run())

    async def _run(self) -> None:
        try:
            while self._pages or self._coming:
                for _ in range(TURNS_PER_OPENING):
                    await asyncio.sleep(0)
                self._turn()
        finally:
            self._task = None

    def _turn(self) -> None:
        """Give the next one a turn."""
        try:
            do = self._next()
            with answering:
                do()
        except BaseException:  # one page's fault ends nobody else's turns, nor does its exit
            logging.getLogger(__name__).exception("a page could not be answered")

    def _next(self) -> Callable[[], None]:
        """Return the turn of whoever has waited for it, and let him wait no longer."""
        self._turns += 1
        if self._coming and (self._turns % FOURTH == 0 or not self._pages):
            address, openings = next(iter(self._coming.items()))
            do = openings.popleft()
            del self._coming[address]
            if openings:  # to the end of the circle
                self._coming[address] = openings
            return do
        if not self._pages:
            return lambda: None
        page = next(iter(self._pages))
        since = self._pages.pop(page)
        self.waited(time.monotonic() - since)
        return page.turn
