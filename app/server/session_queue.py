"""A round robin of pages with one request each; every fourth turn goes to a page that opens.

A page that asks for more than it is answered keeps its newest values only, and nobody else waits for it.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections import deque
from collections.abc import Callable
from typing import Protocol

from .process.compile_throttle import answering

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
        self._coming: deque[Callable[[], None]] = deque()
        self._task: asyncio.Task[None] | None = None
        self._turns = 0
        self.waited: Callable[[float], object] = lambda seconds: None  # noqa: ARG005 (told how long one has waited)

    def ask(self, page: Page) -> None:
        """Give a page a turn, unless it waits for one."""
        self._pages.setdefault(page, time.monotonic())
        self._begin()

    def come_in(self, opening: Callable[[], None]) -> None:
        """Have somebody let in."""
        self._coming.append(opening)
        self._begin()

    def leave(self, page: Page) -> None:
        """Give a page no turn any more."""
        self._pages.pop(page, None)

    @property
    def waiting(self) -> int:
        """Return the number of pages that wait for a turn."""
        return len(self._pages) + len(self._coming)

    def _begin(self) -> None:
        if self._task is None:
            self._task = asyncio.get_running_loop().create_task(self._run())

    async def _run(self) -> None:
        while self._pages or self._coming:
            for _ in range(TURNS_PER_OPENING):
                await asyncio.sleep(0)
            self._turns += 1
            if self._coming and (self._turns % FOURTH == 0 or not self._pages):
                do = self._coming.popleft()
            elif self._pages:
                page = next(iter(self._pages))
                self.waited(time.monotonic() - self._pages.pop(page))
                do = page.turn
            else:
                continue
            try:
                with answering:
                    do()
            except BaseException:  # one page's fault ends nobody else's turns, nor does its exit
                logging.getLogger(__name__).exception("a page could not be answered")
        self._task = None
