"""Reading what a mechanism is made of: numbers or text in the names that the user gave, checked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ...formulas.expression import Expression, ExpressionError, parse
from ...formulas.names import FAST_NAMES, SLOW_NAMES
from ...formulas.reader import check_names
from ...results.arrays import Array
from ..reading import mapping, parameter, short_repr

Given = float | str | Expression  # what a formula is read from
GivenRow = Sequence[Given] | Array
GivenMatrix = Sequence[GivenRow] | Array
FormulaRow = tuple[Expression, ...]
Matrix = tuple[FormulaRow, ...]

MOST_VELOCITIES = 12
ZERO = parse("0", ())


def words(values: Any, what: str) -> tuple[str, ...]:
    """Check names: text, one or several."""
    found = (values,) if isinstance(values, str) or not hasattr(values, "__iter__") else tuple(values)
    for word in found:
        if not isinstance(word, str) or len(word) > 40:
            raise ValueError(f"{what} has the name {short_repr(word)}; use at most 40 ASCII letters, digits and _.")
        if word in FAST_NAMES:
            raise ValueError(f"{what} has the name {word!r}; use names other than c, s, x, y, which are of the slip.")
        try:
            check_names((word,))
        except ValueError as error:
            raise ValueError(f"{what}: {error}") from error
    twice = next((word for word in found if found.count(word) > 1), None)
    if twice is not None:
        raise ValueError(f"{what} names {short_repr(twice)} twice; once is enough.")
    return found


def velocities(values: Any) -> tuple[str, ...]:
    """Check the names of the velocities."""
    found = words(values, "velocities")
    if not 2 <= len(found) <= MOST_VELOCITIES:
        raise ValueError(f"there are {len(found)} velocities; name from 2 to {MOST_VELOCITIES}.")
    return found


def slow(values: Any) -> tuple[str, ...]:
    """Check the names of the slow variables."""
    found = words(values, "slow")
    if len(found) > len(SLOW_NAMES):
        raise ValueError(f"slow has {len(found)} names; at most {len(SLOW_NAMES)} slow variables are allowed.")
    return found


def parameters(values: Any, taken: Sequence[str]) -> dict[str, float]:
    """Check the parameters, none with the name of something else."""
    found: dict[str, float] = {}
    for key, value in mapping(values, "parameters").items():
        try:
            found[key] = parameter(key, value)
        except ValueError as error:
            raise ValueError(f"parameters: {error}") from error
    both = next((key for key in found if key in taken), None)
    if both is not None:
        raise ValueError(f"the parameter {both} has the name of a velocity or of a slow variable; choose another.")
    return found


def as_text(value: Any, what: str, names: Sequence[str] = ()) -> str:
    """Return a number, or text, as text."""
    if isinstance(value, Expression):
        return value.text
    if isinstance(value, str):
        return value
    try:
        return repr(float(value))
    except (TypeError, ValueError, OverflowError):
        known = f" in {', '.join(names)}" if names else ""
        raise ValueError(f"{what} is {short_repr(value)}; give a number, or text{known}.") from None


def formula(value: Any, what: str, names: Sequence[str]) -> Expression:
    """Read a number, or text in the names."""
    if isinstance(value, Expression) and set(value.names) <= set(names):
        return value
    try:
        return parse(as_text(value, what, names), tuple(names))
    except ExpressionError as error:
        raise ExpressionError(f"{what}: {error}", error.text, error.column) from error


def row(values: Any, what: str, length: int, names: Sequence[str]) -> FormulaRow:
    """Read a row of so many entries."""
    if isinstance(values, str) or not hasattr(values, "__getitem__") or len(values) != length:
        raise ValueError(f"{what} is {short_repr(values)}; give {length} entries, numbers or text.")
    return tuple(formula(value, f"{what}[{i}]", names) for i, value in enumerate(values, 1))


def matrix(values: Any, what: str, rows: int, columns: int, names: Sequence[str]) -> Matrix:
    """Read a matrix of so many rows and columns."""
    if isinstance(values, str) or not hasattr(values, "__getitem__") or len(values) != rows:
        raise ValueError(f"{what} is {short_repr(values)}; give {rows} rows of {columns} entries, numbers or text.")
    return tuple(row(value, f"{what}[{i}]", columns, names) for i, value in enumerate(values, 1))


def coefficient(mu: Any, names: Sequence[str]) -> Matrix:
    """Read Coulomb's coefficient: a number or text, or a matrix."""
    if not isinstance(mu, str) and hasattr(mu, "__len__"):
        return matrix(mu, "mu", 2, 2, names)
    one = formula(mu, "mu", names)
    return (one, ZERO), (ZERO, one)


def rates(values: Any, positions: Sequence[str], names: Sequence[str]) -> Mapping[str, Expression]:
    """Read how the slow variables move that are no velocities."""
    given = mapping(values, "rates")
    strange = next((key for key in given if key not in positions), None)
    if strange is not None:
        raise ValueError(f"rates has {short_repr(strange)}, which is no slow variable but a velocity, or nothing.")
    missing = next((key for key in positions if key not in given), None)
    if missing is not None:
        raise ValueError(f"the slow variable {missing} is no velocity; say how it moves: rates={{'{missing}': '...'}}.")
    return {key: formula(given[key], f"the rate of {key}", names) for key in positions}
