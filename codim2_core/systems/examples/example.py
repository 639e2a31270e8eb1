"""An example: a system, ranges of its parameters, and initial states."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import wraps
from numbers import Real
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..elinear import ELinear
from ..mechanics.several.contacts import Contacts
from ..reading import MAX_NUMBER
from ..typed import System

GRAVITY = 9.81  # m/s²


def check_physics(above: Mapping[str, float], least: Mapping[str, float] = MappingProxyType({})) -> None:
    """Refuse what no mechanism has: values that must be above 0, and values that must be at least 0.

    What is no number, or too large, the system refuses.
    """
    for name, value in above.items():
        if isinstance(value, Real) and -MAX_NUMBER <= value <= 0.0:
            raise ValueError(f"{name} is {value:g}; give a number above 0.")
    for name, value in least.items():
        if isinstance(value, Real) and -MAX_NUMBER <= value < 0.0:
            raise ValueError(f"{name} is {value:g}; give a number of at least 0.")


def _system_at_contact(mechanism: Callable[..., Contacts], i: int, key: str) -> Callable[..., ELinear | System]:
    """Return the function of this name that makes the system at contact i."""

    @wraps(mechanism)
    def make(*values: float, **named: float) -> ELinear | System:
        return mechanism(*values, **named).at(i)

    make.__name__ = make.__qualname__ = key
    return make


@dataclass(frozen=True)
class Ball:
    """A ball on a plane: z begins with the velocity of its centre, (x, y) is the slip at its contact, m/s.

    Attributes
    ----------
    placed : bool
        The next two slow variables are the place of the centre, m; else it starts at (0, 0).
    turning : str or None
        The parameter that is the rate of the plane about (0, 0), rad/s; None where the plane is at rest.
    """

    placed: bool = False
    turning: str | None = None


@dataclass(frozen=True, eq=False)
class Example:
    """One example as the explorer offers it.

    Attributes
    ----------
    make : callable
        The function; its name is the example's key, its keyword arguments are the parameters.
    title, label : str
        What people call it, and the paper's label or the kind of system.
    source : str
        Who wrote it down.
    sentence : str
        What there is to see.
    ranges : mapping of str to (low, high)
        In which each parameter is interesting.
    z : tuple of float
        Where to start.
    slow : tuple of (symbol, low, high)
        Each slow variable and its range.
    launch : tuple of float
        A state (x, y, z1, …, zm) from which a motion is worth following.
    t_end : float
        For how long.
    ball : Ball or None
        What its states say if it is a ball: then it is seen to roll.
    mechanism : callable or None
        Of one with several contacts, the function that makes it, of the same parameters; `make` is its system at the
        set of one of them, while the others slip.
    """

    make: Callable[..., ELinear | System]
    title: str
    label: str
    source: str
    sentence: str
    ranges: Mapping[str, tuple[float, float]]
    z: tuple[float, ...]
    slow: tuple[tuple[str, float, float], ...]
    launch: tuple[float, ...]
    t_end: float
    ball: Ball | None = None
    mechanism: Callable[..., Contacts] | None = None

    @property
    def key(self) -> str:
        """The function's name."""
        return self.make.__name__

    def check(self) -> None:
        """See that the numbers fit the system.

        Raises
        ------
        ValueError
            They do not.
        """
        system = self.make()
        m = len(self.z)
        system.at(self.z)
        unknown = [name for name in self.ranges if name not in dict(system.parameters)]
        if unknown:
            raise ValueError(f"ranges of {self.key} name {unknown[0]!r}, which is no parameter of its system.")
        if len(self.slow) != m or len(self.launch) != 2 + m:
            raise ValueError(
                f"{self.key} starts at z with {m} values, and gives {len(self.slow)} slow variables and a state of "
                f"{len(self.launch)} values; give {m} and {2 + m}."
            )


def read_examples(path: Path, functions: Mapping[str, Callable[..., Any]]) -> tuple[Example, ...]:
    """Read the examples of a TOML file, a table each by the name of its function; of several contacts one at each."""
    found: list[Example] = []
    for name, table in tomllib.loads(path.read_text("utf-8")).items():
        title, contacts, make = table.pop("title"), table.pop("contacts", {}), functions[name]
        shared = {key: as_tuples(value) for key, value in table.items()}
        shared["ranges"] = {key: as_tuples(value) for key, value in table["ranges"].items()}
        shared["ball"] = Ball(**table["ball"]) if "ball" in table else None
        if not contacts:
            found.append(Example(make, title, **shared))
        for i, (key, where) in enumerate(contacts.items()):
            found.append(Example(_system_at_contact(make, i, key), f"{title}: {where}", mechanism=make, **shared))
    return tuple(found)


def as_tuples(value: Any) -> Any:
    """Return a value of a TOML file with tuples for its lists, however deep."""
    return tuple(map(as_tuples, value)) if isinstance(value, list) else value
