"""Parameters of a system: a mapping of names to numbers that nobody changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping


class Parameters(Mapping[str, float]):
    """Names and their numbers, in the order in which they were given; read-only, so that a system is a value."""

    __slots__ = ("_values",)

    def __init__(self, values: Mapping[str, float]) -> None:
        self._values = dict(values)

    def __getitem__(self, name: str) -> float:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __hash__(self) -> int:
        return hash(frozenset(self._values.items()))

    def __repr__(self) -> str:
        return repr(self._values)
