"""Parameters of a system from a measured slip: least squares over whole motions, with intervals."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...results.arrays import Array
from ...results.result import Result
from ...results.tables import html_table, paragraphs, table_number
from ...results.words import say
from ..coefficients import Parameters
from ..elinear import ELinear
from ..reading import short_repr, slow_values
from ..typed import System

STOPPED = 30.0  # log of how much slower than at the start it is when it stops
MAX_TURNS = 1e4  # in turns of the time dt/r


class TooLongError(Exception):
    """A slip takes more evaluations than are allowed."""


@dataclass(frozen=True, eq=False)
class Slipping:
    """A slip: log r, theta and time over tau, dt = r dtau."""

    stop: float | None  # when it stops
    direction: float  # its angle then, or at the last time
    evaluations: int  # of U that it took
    _tau: Array
    _states: Array
    _dense: Any

    def at(self, times: Array) -> Array:
        """Return (x, y) (..., 2); 0 once it has stopped."""
        tau = np.interp(times, self._states[2], self._tau)
        for _ in range(8):  # Newton: dt/dtau = r
            log_r, _, t = self._dense(tau.ravel())[:3].reshape(3, *tau.shape)
            tau = np.clip(tau - (t - times) * np.exp(-log_r), self._tau[0], self._tau[-1])
        log_r, theta = self._dense(tau.ravel())[:2].reshape(2, *tau.shape)
        r = np.exp(log_r) if self.stop is None else np.where(times < self.stop, np.exp(log_r), 0.0)
        return np.stack([r * np.cos(theta), r * np.sin(theta)], axis=-1)


def integrate_slip(system: ELinear | System, start: ArrayLike, z: ArrayLike, times: Array, most: int) -> Slipping:
    """Follow the slip from the first time until it stops, or to the last; TooLongError beyond `most` evaluations."""
    from scipy.integrate import solve_ivp

    x, y = (float(v) for v in np.asarray(start, float))
    slow = np.atleast_1d(np.asarray(z, float))
    still = system.at(tuple(slow)) if not len(slow) else None

    count = 0

    def rates(_tau: float, state: Array) -> Array:
        nonlocal count
        count += 1
        if count > most:
            raise TooLongError
        log_r, theta = state[:2]
        e = np.array([math.cos(theta), math.sin(theta)])
        at = system.at(tuple(state[3:])) if still is None else still
        U, r = at.U(e), math.exp(log_r)
        found = np.empty_like(state)
        found[0], found[1], found[2] = U @ e, e[0] * U[1] - e[1] * U[0], r
        if len(slow):
            found[3:] = r * np.asarray(at.W(e), float)
        return found

    first = math.log(math.hypot(x, y))
    over: Any = lambda _tau, state: state[2] - times[-1]
    slow_now: Any = lambda _tau, state: state[0] - first + STOPPED
    over.terminal = slow_now.terminal = True
    begin = np.array([first, math.atan2(y, x), times[0], *slow])
    run = solve_ivp(rates, (0.0, MAX_TURNS), begin, "DOP853", events=(over, slow_now), rtol=1e-10, atol=1e-12,
                    dense_output=True)  # fmt: skip
    stopped = bool(len(run.t_events[1]))
    return Slipping(float(run.y[2, -1]) if stopped else None, float(run.y[1, -1]), count, run.t, run.y, run.sol)


MOST_LINES = 1_000_000


def read_measurement(path: str | Path) -> tuple[Array, Array]:
    """Read times (k,) and velocities (k, 2) from a file of three columns.

    They are parted by commas, semicolons, tabs or blanks; between semicolons a comma is a decimal one. Empty lines,
    lines that begin with # and a first line of names are passed over.

    Raises ValueError: There is no such file, it is no text, it is too long, or a line is not of three numbers.
    """
    file = Path(path)
    try:
        with file.open(encoding="utf-8-sig") as lines:
            rows = [_numbers(line) for _, line in zip(range(MOST_LINES + 1), lines, strict=False)]
    except (OSError, UnicodeDecodeError, ValueError) as error:
        why = "is no text in UTF-8" if isinstance(error, ValueError) else "cannot be opened"
        raise ValueError(f"times is {short_repr(str(path))}, which {why}; give a CSV file, or an array.") from None
    if len(rows) > MOST_LINES:
        raise ValueError(f"times is {short_repr(str(path))}, of more than {MOST_LINES} lines; give fewer.")
    first = next((i for i, row in enumerate(rows) if row is not None), 0)
    if rows and rows[first] == []:
        rows[first] = None
    for i, row in enumerate(rows):
        if row == []:
            raise ValueError(
                f"times is {short_repr(str(path))}, whose line {i + 1} is not of three numbers; give time, v_x and v_y."
            )
    found = np.array([row for row in rows if row is not None], float).reshape(-1, 3)
    return found[:, 0], found[:, 1:]


def _numbers(line: str) -> list[float] | None:
    """Three numbers; none in a line that is passed over, and an empty list in any other."""
    text = line.strip()
    if not text or text.startswith("#"):
        return None
    if ";" in text:
        text = text.replace(",", ".")
    parts = [part.strip() for part in re.split(r"[;,\t]" if re.search(r"[;,\t]", text) else r"\s+", text)]
    try:
        found = [float(part) for part in parts]
    except ValueError:
        return []
    return found if len(found) == 3 else []


Interval = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Fit(Result):
    """A system estimated from a measured slip: each value with its 95 % confidence interval.

    Intervals are those of least squares: for errors that are independent and normal, of one size, and small.

    Attributes
    ----------
    system : ELinear or System
        The system with the parameters that were found.
    values, intervals : mapping of str to float, and to (low, high)
        The parameters.
    start : ndarray (2,)
        Slip at the first time.
    direction : float
        The angle of the slip, rad, as it stops, or at the last time if it does not.
    direction_interval : (low, high)
    stop : float or None
        When it stops; None if it goes on slipping.
    error : float
        Size of the errors: root of the mean square, by degrees of freedom.
    times, velocities : ndarray (k,), (k, 2)
        What was measured.
    """

    system: ELinear | System
    values: Mapping[str, float]
    intervals: Mapping[str, Interval]
    start: Array
    direction: float
    direction_interval: Interval
    stop: float | None
    error: float
    times: Array = field(repr=False)
    velocities: Array = field(repr=False)
    _course: Slipping = field(repr=False, compare=False)

    def at(self, times: ArrayLike) -> Array:
        """Return the slip (..., 2) of the motion that was found; 0 once it has stopped."""
        return self._course.at(np.asarray(times, float))

    def _records(self) -> Iterator[dict[str, Any]]:
        for name, value in self.values.items():
            low, high = self.intervals[name]
            yield {"parameter": name, "value": value, "low": low, "high": high}

    def _tables_(self) -> str:
        rows = [
            (row["parameter"], *(table_number(row[name]) for name in ("value", "low", "high")))
            for row in self._records()
        ]
        return html_table(("parameter", "value", "from", "to"), rows) + paragraphs([self.sentence])

    def drawn(self, count: int = 200) -> tuple[Array, Array]:
        """Return what was measured, and the motion that was found, as points (1 + |v|) e of the portrait's picture."""
        slips = self.times <= (self.times[-1] if self.stop is None else self.stop)
        end = self.times[-1] if self.stop is None else min(self.stop, self.times[-1])
        return tuple(  # pyright: ignore[reportReturnType]
            (1.0 + 1.0 / np.hypot(v[:, 0], v[:, 1])[:, None]) * v
            for v in (self.velocities[slips], self.at(np.linspace(self.times[0], end, count)[:-1]))
        )

    @property
    def sentence(self) -> str:
        """Return the estimates in a sentence."""
        found = ", ".join(
            f"{name} = {value:.4g} ({self.intervals[name][0]:.4g} to {self.intervals[name][1]:.4g})"
            for name, value in self.values.items()
        )
        low, high = np.degrees(self.direction_interval)
        where = {"found": found, "angle": float(np.degrees(self.direction)), "low": float(low), "high": float(high)}
        return say("fitted", **where) if self.stop is None else say("fitted until it stops", stop=self.stop, **where)


def fit(
    system: ELinear | System,
    times: ArrayLike | str | Path,
    velocities: ArrayLike | None = None,
    names: Iterable[str] = ("mu",),
    z: ArrayLike = (),
    max_evaluations: int = 200_000,
) -> Fit:
    """Find parameters of a system from a measured slip (v_x, v_y) over time.

    Whole motions are held against what was measured, from a start that is fitted too; a motion that comes to rest stays
    there. Nothing is differentiated, so noise does no harm but to widen the intervals.

    Parameters
    ----------
    system : ELinear or System
        (x, y) is the slip that was measured, and U may not read x or y. Its parameters are where the search begins.
    times : (k,), or path of a CSV file
        Growing. A file has three columns, time, v_x and v_y, and may begin with their names.
    velocities : (k, 2)
        Left out where a file is given.
    names : names of parameters
        Those to find.
    z : (m,) floats
        The slow variables at the first time.
    max_evaluations : int
        Evaluations of U before the search is given up.

    Raises
    ------
    ValueError
        A name is no parameter of the system, shapes do not fit, times do not grow, a file cannot be read, U reads x or
        y, what was measured does not determine the parameters, or the search takes too many evaluations.

    Examples
    --------
    >>> import numpy as np
    >>> from codim2_core.systems.mechanics import contact, fit
    >>> block = contact(((1, 0), (0, 1)), ((1, 0), (0, 1)), (0, 0), "mu", "g", ("vx", "vy"),
    ...                 parameters={"mu": 0.1, "g": 9.81})
    >>> t = np.linspace(0.0, 0.6, 61)
    >>> speed = np.maximum(1.0 - 0.3 * 9.81 * t, 0.0)[:, None] * [0.6, 0.8]
    >>> round(fit(block, t, speed).values["mu"], 6)
    0.3
    """
    from scipy.optimize import least_squares
    from scipy.stats import t as student

    t, v = _read_measurements(times, velocities)
    searched = _parameter_names(system, names)
    slow = slow_values(z, system.m)
    _check_measurement(system, t, v, searched)
    known = dict(system.parameters)
    first = np.array([*(known[name] for name in searched), *v[0]])

    left = max_evaluations

    def course(unknown: Array) -> Slipping:
        nonlocal left
        changed = dict(zip(searched, map(float, unknown[:-2]), strict=True))
        try:
            one = integrate_slip(system.evolve(**changed), unknown[-2:], slow, t, left)
        except TooLongError:
            raise ValueError(
                f"{max_evaluations} evaluations of U did not lead to an end, the last at {short_repr(changed)}; begin "
                "with parameters closer to what was measured, or allow more by max_evaluations."
            ) from None
        left -= one.evaluations
        return one

    def away(unknown: Array) -> Array:
        return np.ravel(course(unknown).at(t) - v)

    found = least_squares(away, first, jac="3-point", x_scale="jac", xtol=1e-13, ftol=1e-13, gtol=1e-13)
    freedom = v.size - len(first)
    error = float(np.sqrt(np.sum(found.fun**2) / freedom))
    spread = found.jac.T @ found.jac
    if np.linalg.cond(spread / np.sqrt(np.outer(*(np.diag(spread),) * 2) + 1e-300)) > 1e12:
        raise ValueError(
            f"what was measured does not determine {', '.join(searched)}; find fewer, or measure what they change."
        )
    covariance = error**2 * np.linalg.inv(spread)
    sure = float(student.ppf(0.975, freedom))
    half = sure * np.sqrt(np.diag(covariance))
    last = course(found.x)
    steps = 1e-6 * np.maximum(np.abs(found.x), np.abs(v).max() * 1e-3)
    turns = [_turn(course(found.x - h * e).direction, course(found.x + h * e).direction) / (2.0 * h)
             for h, e in zip(steps, np.eye(len(first)), strict=True)]  # fmt: skip
    blur = sure * float(np.sqrt(np.array(turns) @ covariance @ turns))
    values = dict(zip(searched, map(float, found.x[:-2]), strict=True))
    return Fit(
        system=system.evolve(**values),
        values=Parameters(values),
        intervals=Parameters({name: (x - h, x + h) for (name, x), h in zip(values.items(), map(float, half))}),  # noqa: B905 (the start comes after)
        start=found.x[-2:],
        direction=last.direction,
        direction_interval=(last.direction - blur, last.direction + blur),
        stop=last.stop,
        error=error,
        times=t,
        velocities=v,
        _course=last,
    )


def _read_measurements(times: Any, velocities: Any) -> tuple[Array, Array]:
    if isinstance(times, str | Path):
        if velocities is not None:
            raise ValueError("times is a file and velocities are given too; leave them out: they are in the file.")
        return read_measurement(times)
    if velocities is None:
        raise ValueError("velocities is None; give (k, 2) numbers, or a CSV file instead of times.")
    return np.asarray(times, float), np.asarray(velocities, float)


def _turn(one: float, other: float) -> float:
    """Return how far it is from one angle to another."""
    return float(np.angle(np.exp(1j * (other - one))))


def _parameter_names(system: ELinear | System, names: Any) -> tuple[str, ...]:
    known = dict(system.parameters)
    given = (names,) if isinstance(names, str) or not isinstance(names, Iterable) else tuple(names)
    strange = any(not isinstance(name, str) or name not in known for name in given)
    if strange or not given or len(set(given)) < len(given):
        raise ValueError(
            f"names is {short_repr(names)}; give one or several parameters of the system, among "
            f"{', '.join(known) or '(none)'}."
        )
    return given


def _check_measurement(system: ELinear | System, t: Array, v: Array, names: tuple[str, ...]) -> None:
    typed = system.typed
    if typed is not None and any(w in ("x", "y") for row in (*typed.U, *typed.W) for w in row.names):
        raise ValueError("the system reads x or y; give one whose U and W depend on e and z alone.")
    if t.ndim != 1 or v.shape != (len(t), 2) or len(t) <= len(names) + 1:
        raise ValueError(
            f"times and velocities have the shapes {t.shape} and {v.shape}; give (k,) and (k, 2), k > {len(names) + 1}."
        )
    if not (np.isfinite(t).all() and np.isfinite(v).all() and (np.diff(t) > 0.0).all()):
        raise ValueError("times must grow, and all that was measured be finite; leave out what is not.")
    if not np.hypot(*v[0]) > 0.0:
        raise ValueError("the first velocity is 0: there is no slip; begin where it slips.")
