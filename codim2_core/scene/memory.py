"""The cache of a lineage of scenes: results under the values of the inputs that each layer reads."""

from __future__ import annotations

from collections import Counter, OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from threading import Lock
from typing import Any

KEPT_RESULTS = 8  # results kept for each layer: a few settings back and forth


@dataclass
class Memory:
    """Results by layer and by the values that they were computed from.

    Attributes
    ----------
    results : dict of str to OrderedDict
        Of each layer the last `KEPT_RESULTS`.
    runs : Counter of str
        How often each layer has been computed, for tests and benchmarks.
    before : callable, optional
        ``before(scene, layer)`` is called before a layer is computed; it may raise, or return what is called after.
    """

    results: dict[str, OrderedDict[Hashable, Any]] = field(default_factory=dict)
    runs: Counter[str] = field(default_factory=Counter)
    before: Callable[[Any, str], Callable[[], None] | None] | None = None
    lock: Lock = field(default_factory=Lock)  # the jobs beside the frames read the same memory

    def result(self, layer: str, key: Hashable, compute: Callable[[], Any]) -> Any:
        """Return what is kept for these values, or compute it and keep it."""
        with self.lock:
            kept = self.results.setdefault(layer, OrderedDict())
            if key in kept:
                kept.move_to_end(key)
                return kept[key]
        result = compute()
        self.keep(layer, key, result)
        self.runs[layer] += 1
        return result

    def keep(self, layer: str, key: Hashable, result: Any) -> None:
        """Keep a result, and forget the oldest of more than `KEPT_RESULTS`."""
        with self.lock:
            kept = self.results.setdefault(layer, OrderedDict())
            kept[key] = result
            if len(kept) > KEPT_RESULTS:
                kept.popitem(last=False)
