"""Keeping the last things that were compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class CompiledCache:
    """Compiled things by key, the last `most` of them; what to compile is said when it is asked for."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._things: dict[Any, Any] = {}

    def __contains__(self, key: object) -> bool:
        return key in self._things

    def get(self, key: Any, make: Callable[[], Any]) -> Any:
        """Return what is kept under a key, or make it."""
        thing = self._things.get(key)
        if thing is None:
            thing = make()
            while len(self._things) >= self._most:
                self._things.pop(next(iter(self._things)), None)
            self._things[key] = thing
        return thing
