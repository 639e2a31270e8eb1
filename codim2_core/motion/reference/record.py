"""A motion whose values are known, and how near a solver comes to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from ...results.result import Several, Tabled
from ...results.tables import table_number

ROUNDING = 4.0 * 2.0**-52  # relative: what evaluating a closed form in doubles loses at most
RTOL, ATOL = 1e-11, 1e-13  # with which motions are followed here


@dataclass(frozen=True, eq=False)
class ExactValue(Tabled):
    """A value that is known.

    Attributes
    ----------
    name : str
    unit : str
        "1" of a pure number.
    value : float
    error : float
        Bound on its error: rounding where it is a closed form, else that of the independent computation.
    formula : str
        The closed form, or how it was computed.
    """

    _head_ = ("value", "unit", "is", "formula")

    name: str
    unit: str
    value: float
    error: float
    formula: str

    def _row_(self) -> tuple[str, ...]:
        return self.name, self.unit, f"{self.value:.12g} ± {self.error:.0e}", self.formula


def closed_form(name: str, unit: str, value: float, formula: str) -> ExactValue:
    """Return a value that is known in closed form."""
    return ExactValue(name, unit, value, ROUNDING * max(abs(value), 1.0), formula)


@dataclass(frozen=True, eq=False)
class Measured(Tabled):
    """A value of a solver next to what it should be; NaN where it has found none."""

    _head_ = ("value", "unit", "exact", "found", "difference")

    name: str
    unit: str
    exact: float
    error: float
    found: float
    difference: float

    def _row_(self) -> tuple[str, ...]:
        return self.name, self.unit, f"{self.exact:.12g}", f"{self.found:.12g}", table_number(self.difference)


@dataclass(frozen=True, eq=False)
class Comparison(Several[Measured]):
    """A solver's values of one motion next to the exact ones; a sequence of `Measured`.

    Attributes
    ----------
    key : str
        Of the motion.
    solver : str
    values : tuple of Measured
    """

    _held_ = "values"

    key: str
    solver: str
    values: tuple[Measured, ...]

    @property
    def largest(self) -> float:
        """The largest difference, relative where the value is above 1."""
        return max(abs(one.difference) / max(1.0, abs(one.exact)) for one in self.values)


@dataclass(frozen=True, eq=False)
class ReferenceMotion(Tabled):
    """A motion with friction, with values that are known.

    Attributes
    ----------
    key, title : str
    sentence : str
        What moves, and from where, with all numbers.
    source : str
        Where it is from.
    values : tuple of ExactValue
    """

    _head_ = ("motion", "what moves", "source")

    key: str
    title: str
    sentence: str
    source: str
    values: tuple[ExactValue, ...]
    _follow: Callable[[], Sequence[float]] = field(repr=False, compare=False)

    def _row_(self) -> tuple[str, ...]:
        return self.key, self.sentence, self.source

    def compare(self, follow: Callable[[], Sequence[float]] | None = None, solver: str = "codim2") -> Comparison:
        """Return a solver's values next to the exact ones.

        Parameters
        ----------
        follow : callable, optional
            Follows the motion and returns its values, in the order of `values`; left out, this package does.
        solver : str
            Name of what follows it.

        Returns
        -------
        Comparison

        Raises
        ------
        ValueError
            It returns another number of values.

        Examples
        --------
        >>> from codim2_core import reference
        >>> found = reference.catalogue["box-stops"].compare()
        >>> [(one.name, round(one.exact, 6), abs(one.difference) < 1e-9) for one in found]
        [('time to rest', 1.223242, True), ('way to rest', 3.669725, True)]
        """
        found = list(self._follow() if follow is None else follow())
        if len(found) != len(self.values):
            wanted = ", ".join(one.name for one in self.values)
            raise ValueError(f"follow returned {len(found)} values; return these {len(self.values)}: {wanted}.")
        rows = [
            Measured(one.name, one.unit, one.value, one.error, float(value), float(value) - one.value)
            for one, value in zip(self.values, found, strict=True)
        ]
        return Comparison(self.key, solver, tuple(rows))
