"""The cache of a lineage of scenes: results under the values of the inputs that each layer reads."""

from __future__ import annotations

from collections import Counter, OrderedDict, defaultdict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from threading import Lock
from typing import Any

ABSENT = object()  # in place of a result that is not kept
KEPT_RESULTS = 8  # results kept for each layer: a few settings back and forth


@dataclass
class Memory:
    """Results by layer and by the values that they were computed from."""

    # of each layer the last `KEPT_RESULTS`
    results: defaultdict[str, OrderedDict[Hashable, Any]] = field(default_factory=lambda: defaultdict(OrderedDict))
    # how often each layer has been computed, for tests and benchmarks
    runs: Counter[str] = field(default_factory=Counter)
    # ``before(scene, layer)`` is called before a layer is computed; it may raise, or return what is called after
    before: Callable[[Any, str], Callable[[], None] | None] | None = None
    lock: Lock = field(default_factory=Lock)  # the jobs in the background read the same memory

    def find(self, layer: str, key: Hashable) -> Any:
        """Return what is kept for these values, or `ABSENT`."""
        with self.lock:
            kept = self.results[layer]
            if key not in kept:
                return ABSENT
            kept.move_to_end(key)
            return kept[key]

    def keep(self, layer: str, key: Hashable, result: Any) -> None:
        """Keep a result, and forget the oldest of more than `KEPT_RESULTS`."""
        with self.lock:
            kept = self.results[layer]
            kept[key] = result
            if len(kept) > KEPT_RESULTS:
                kept.popitem(last=False)
