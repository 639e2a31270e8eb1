"""What is long for the loop is done for one visitor at a time, and gives way to whoever waits for an answer."""

from __future__ import annotations

import asyncio
from types import TracebackType
from typing import Any

from ..frame.later import others_first


class OneByOne:
    """Lets one in at a time, first come first served, and whoever waits for an answer before the next."""

    def __init__(self) -> None:
        self._lock = asyncio.Lock()

    async def __aenter__(self) -> None:
        await self._lock.acquire()

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        try:
            await others_first()
        finally:
            self._lock.release()


def one_by_one(application: Any) -> OneByOne:
    """Return what lets in those for whom a Tornado application does what is long."""
    return application.settings.setdefault("codim2_one_by_one", OneByOne())
