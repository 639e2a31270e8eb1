"""Results of public functions: equal by their values, shown in a notebook, exported as tables and pictures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from enum import Enum
from pathlib import Path
from typing import Any, ClassVar, Generic, TypeVar, cast

import numpy as np

from . import drawing
from .tables import frame, html_table, write_csv


class ByValue:
    """A frozen dataclass made with ``eq=False``, as its fields hold arrays: equal by all numbers, NaN as itself."""

    __slots__ = ()

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return self is other or all(equal_values(value, getattr(other, name)) for name, value in compared_fields(self))

    def __hash__(self) -> int:
        texts = (value for _, value in compared_fields(self) if type(value) is str)  # equal numbers may differ in type
        return hash((type(self), *texts))


def compared_fields(result: ByValue) -> list[tuple[str, Any]]:
    """Return the fields by which a result is compared, with their values."""
    return [(one.name, getattr(result, one.name)) for one in fields(cast("Any", result)) if one.compare]


def equal_values(one: Any, other: Any) -> bool:
    """Whether two values of a field are equal: arrays by their numbers, tuples and mappings by what they hold."""
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        one, other = np.asarray(one), np.asarray(other)
        return one.dtype.kind == other.dtype.kind and np.array_equal(one, other, equal_nan=one.dtype.kind in "fc")
    if isinstance(one, tuple | list) and type(one) is type(other):
        return len(one) == len(other) and all(map(equal_values, one, other))
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(equal_values(value, other[name]) for name, value in one.items())
    return bool(one == other) or (one != one and other != other)


LONGEST_PART, LONGEST_SENTENCE = 90, 300  # characters of a value within a line
MAX_COLUMNS = 4  # numbers of an array or a tuple that a row of `to_frame` holds: a place, or z'


class Listed:
    """An object of which `dir`, and so the Tab key, lists what is for users; `_internal_` names what the core asks."""

    __slots__ = ()

    _internal_: ClassVar[frozenset[str]] = frozenset()

    def __dir__(self) -> Iterable[str]:
        return [name for name in super().__dir__() if name not in self._internal_]


class Written(Listed):
    """An object that is written to files: its rows as a table, its picture as SVG, PNG or PDF."""

    __slots__ = ()

    def _records(self) -> Iterator[dict[str, Any]]:
        raise NotImplementedError

    def to_frame(self) -> Any:
        """Return a pandas DataFrame.

        Raises
        ------
        ValueError
            pandas is not installed.
        """
        return frame(self._records())

    def to_csv(self, path: str | Path) -> None:
        """Write what `to_frame` has as CSV."""
        write_csv(path, self._records())

    def save(self, path: str | Path) -> None:
        """Write the picture that a notebook shows.

        Parameters
        ----------
        path : str or Path
            A name that ends with .svg, .png or .pdf.

        Raises
        ------
        ValueError
            The name ends otherwise, or the app, which draws, or for PNG and PDF Typst, is not installed, or there
            is no picture of this result.
        """
        drawing.save(self, path)


class Result(Written, ByValue):
    """A result: a frozen dataclass whose fields say all that it is, and by which it is compared.

    It has a length, an index and an iterator: over what it holds, else over the rows of `to_frame`, as dictionaries.
    """

    __slots__ = ()

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "__repr__" not in cls.__dict__ and not issubclass(cls, tuple):
            cls.__repr__ = Result.__repr__  # else a dataclass writes one of its own, with every number of an array

    def __repr__(self) -> str:
        shown = ((one.name, getattr(self, one.name)) for one in fields(cast("Any", self)) if one.repr)
        said = (f"{name}={text}" for name, value in shown if (text := one_line(value)))
        return f"{type(self).__name__}({', '.join(said)})"

    def _records(self) -> Iterator[dict[str, Any]]:
        yield record(self)

    def __len__(self) -> int:
        return sum(1 for _ in self._records())

    def __iter__(self) -> Iterator[Any]:
        return iter(self._records())

    def __getitem__(self, i: Any) -> Any:
        return list(self._records())[i]

    def __bool__(self) -> bool:
        return True

    def plot(self, ax: Any = None) -> Any:
        """Draw the picture into Matplotlib axes, and return them.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Left out, a figure is made.

        Raises
        ------
        ValueError
            Matplotlib, or the app, which draws, is not installed.
        """
        return drawing.plot(self, ax)

    def _repr_svg_(self) -> str | None:
        return None

    def _tables_(self) -> str:
        """Return what a notebook shows below the picture, as HTML."""
        row = record(self)
        return html_table(tuple(row), [tuple(map(str, row.values()))])

    def _repr_html_(self) -> str:
        return drawing.image(self) + self._tables_()


class Pictured(Result):
    """A result that has a picture."""

    __slots__ = ()

    def _repr_svg_(self) -> str | None:
        return drawing.svg(self)


class Tabled(Result):
    """A result that is one row of a table."""

    __slots__ = ()

    _head_: ClassVar[tuple[str, ...]] = ()

    def _row_(self) -> tuple[str, ...]:
        raise NotImplementedError

    def _tables_(self) -> str:
        return result_rows([self])


class OfOneKind(Result):
    """A result that holds others, one after the other."""

    __slots__ = ()

    def __bool__(self) -> bool:
        return len(self) > 0

    @property
    def kinds(self) -> tuple[str, ...]:
        """Kinds, where they have one."""
        return tuple(one.kind for one in self)

    @property
    def sentences(self) -> tuple[str, ...]:
        """Sentences about each, where there are some."""
        return tuple(one.sentence for one in self)


Kind = TypeVar("Kind", bound=Result)
Row = TypeVar("Row", bound=Tabled)


class Several(OfOneKind, Generic[Kind]):
    """A result that holds others of one kind, in the field that `_held_` names; it iterates over them."""

    __slots__ = ()

    _held_: ClassVar[str] = ""

    def __iter__(self) -> Iterator[Kind]:
        return iter(getattr(self, self._held_))

    def __len__(self) -> int:
        return len(getattr(self, self._held_))

    def __getitem__(self, i: int) -> Kind:
        return getattr(self, self._held_)[i]

    def _records(self) -> Iterator[dict[str, Any]]:
        return map(record, self)


class Results(tuple[Row, ...], OfOneKind):
    """Several results of one kind, in order: a tuple that a notebook shows as one table."""

    __slots__ = ()

    def _records(self) -> Iterator[dict[str, Any]]:
        return map(record, self)

    def _tables_(self) -> str:
        return result_rows(self) or "<p>none</p>"


def record(result: Result) -> dict[str, Any]:
    """Return one row: the fields that are text or a number, and short arrays, a column for each of their numbers."""
    row: dict[str, Any] = {}
    for one in fields(cast("Any", result)):
        value = getattr(result, one.name)
        if isinstance(value, Enum):
            value = value.value
        if value is None or isinstance(value, str | bool | int | float | complex):
            row[one.name] = value
        elif (numbers := short_numbers(value)) is not None:
            row |= {f"{one.name}_{i + 1}": number for i, number in enumerate(numbers)}
    return row


def short_numbers(value: Any) -> list[Any] | None:
    """Return the numbers of a short array, or of a tuple of numbers; None of anything else."""
    if isinstance(value, np.ndarray):
        return value.tolist() if value.ndim == 1 and len(value) <= MAX_COLUMNS else None
    short = isinstance(value, tuple) and len(value) <= MAX_COLUMNS
    return list(value) if short and all(isinstance(one, int | float) for one in value) else None


def one_line(value: Any) -> str:
    """Return a value as a terminal shows it within a line: numbers to six digits, of long arrays their shape."""
    if isinstance(value, Enum):
        return value.name
    if isinstance(value, np.ndarray):
        short = value.size <= MAX_COLUMNS
        return one_line(value.tolist()) if short else f"<array of shape {value.shape}>"
    if isinstance(value, tuple | list):
        inner = [one_line(one) for one in value[: MAX_COLUMNS + 1]]
        if len(value) > MAX_COLUMNS or sum(map(len, inner)) > LONGEST_PART:
            return f"<{len(value)} of them>"
        return f"({', '.join(inner)}{',' * (len(inner) == 1)})"
    if isinstance(value, float | complex) and not isinstance(value, bool | int):
        return f"{value:.6g}"
    text, most = repr(value), LONGEST_SENTENCE if isinstance(value, str) else LONGEST_PART
    return text if len(text) <= most else f"{text[:most]}…"


def column_rows(columns: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Return the rows of columns of one length, arrays or sequences, by their names."""
    values = (one.tolist() if isinstance(one, np.ndarray) else one for one in columns.values())
    return (dict(zip(columns, row, strict=True)) for row in zip(*values, strict=True))


def result_rows(results: Iterable[Tabled]) -> str:
    """Return results of one kind as a table, a row each; nothing if there are none."""
    found = list(results)
    return html_table(found[0]._head_, [one._row_() for one in found]) if found else ""
