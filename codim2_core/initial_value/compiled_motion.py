"""The regularised motion compiled: for motions that are long, and for systems that are asked for again.

A step costs 0.3 ms as Python calls NumPy, and some microseconds compiled; compiling the formulas of a system takes
about a second. So a motion is followed in Python until it has cost about that much, and from then on, and whenever
the same system comes again, compiled: implicitly by the same method to the same coefficients, or explicitly where that
costs less (`kernels.motion`).
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..expressions.functions import kernels
from ..expressions.names import FAST_NAMES, SLOW_NAMES
from ..expressions.source import program
from ..jit import carray, compile_source
from ..numerics.dense import Dense, StepArray
from ..numerics.growth import BlowUpError, too_short
from ..numerics.radau import Problem, TooManyStepsError, tableau
from ..psi.function import Psi
from ..stepping.compiling import CompiledCache
from ..stepping.psi_gain import one_gain
from ..words import say
from .field import Field
from .kernels.explicit import DENSE_DEGREE, MAX_COMPONENTS
from .kernels.motion import (
    AT_SIGMA,
    BLOWN_UP,
    CHUNK_FULL,
    CONTROL,
    LIMIT,
    MIN_IMPLICIT_STEPS,
    MIN_STEP,
    SHORT,
    follow_all,
    integrate_motion,
    price,
)
from .kernels.rate import MotionConstants
from .kernels.stages import tableau_of, workspace
from .line import InvariantLine

MOST_SYSTEMS = 64
STEPS_PER_CALL = 256  # steps that one call fills in
SHARED_OUT = 16  # motions at once that are shared out to all cores, in as many parts each, at most so many in one
PARTS_PER_CORE, LARGEST_PART = 4, 256
_fields = CompiledCache(MOST_SYSTEMS)


def is_compiled(field: Field) -> bool:
    """Whether the formulas of a field are compiled already."""
    return field.rows in _fields


def _compile_field(field: Field) -> tuple[Any, Any]:
    names = (*FAST_NAMES, *SLOW_NAMES[: field.m])
    slopes = [row.derivative(name) for row in field.rows for name in names]
    return tuple(_compile_rows(rows, names) for rows in (field.rows, slopes))  # pyright: ignore[reportReturnType]


def _compile_rows(rows: Any, names: tuple[str, ...]) -> Any:
    written = program(rows, {name: name for name in names}, names)
    lines = [
        f"A, D = carray(state, ({len(names)},)), carray(out, ({len(rows)},))",
        *(f"{name} = A[{k}]" for k, name in enumerate(names)),
        *written.before,
        *written.inside,
        *(f"D[{k}] = {result}" for k, result in enumerate(written.results)),
    ]
    source = "def right_hand_side(state, out, parameters):\n" + "\n".join(f"    {line}" for line in lines)
    # Written by `program`: its own names, numbers and math.* only.
    return compile_source(source, {"carray": carray, **kernels.called}, strict=True)


@lru_cache(maxsize=1)
def numbers_of_tableau() -> Array:
    """Return the numbers of Radau IIA as `kernels.stages.tableau_of` reads them."""
    table = tableau()
    return np.concatenate([[table.gamma], table.nodes, table.A.ravel(), table.error, table.fit.ravel()])


@lru_cache(maxsize=1)
def _table() -> Any:
    return tableau_of(numbers_of_tableau())


@dataclass(frozen=True)
class CompiledFunctions:
    """The compiled functions of a field and a Psi: they must outlive the use of their addresses."""

    functions: tuple[Any, ...]
    addresses: NDArray[np.int64]


_last = CompiledCache(MOST_SYSTEMS)


def functions_of(field: Field, psi: Psi) -> CompiledFunctions:
    """Return the compiled functions of a field and a Psi; they are compiled when they are first asked for."""

    def make() -> CompiledFunctions:
        functions = (*_fields.get(field.rows, lambda: _compile_field(field)), one_gain(psi))
        return CompiledFunctions(functions, np.array([function.address for function in functions], np.int64))

    return _last.get((field.rows, psi), make)


def failure(problem: Problem, code: int, t: float, state: Array) -> TooManyStepsError | None:
    """Say why a motion has ended before its time; None where it has not.

    Parameters
    ----------
    problem : Problem
        The same in Python.
    code : int
        Of `integrate_motion`.
    t : float
    state : ndarray (n,)
        The last ones.
    """
    if code == LIMIT:
        return TooManyStepsError()
    if code == BLOWN_UP:
        return BlowUpError(say("blow-up time", t=t))
    return too_short(problem, t, state) if code == SHORT else None


class CompiledMotion:
    """One motion under way, compiled.

    Parameters
    ----------
    problem : Problem
        The same in Python.
    field : Field
    psi : Psi
    eps : float
    line : InvariantLine or None
        The invariant line it stays in.
    t_start, t_end, first, rtol, h, most
        As in `numerics.radau.steps`.
    floor : float
        atol/rtol.
    farthest : float
        The largest rho so far, of a nonsmooth motion: eps = 0. It ends where rho is `arrival_radius` of the largest.
    """

    chunk = STEPS_PER_CALL

    def __init__(
        self,
        problem: Problem,
        field: Field,
        psi: Psi,
        eps: float,
        line: InvariantLine | None,
        t_start: float,
        t_end: float,
        first: Array,
        rtol: float,
        floor: float,
        h: float,
        most: int,
        farthest: float = 0.0,
    ) -> None:
        self.problem, n = problem, len(first)
        self.functions, self.parameter = functions_of(field, psi), psi.parameter
        along = (0.0, 0.0) if line is None else line.vector
        value, slopes, gain = self.functions.addresses.tolist()
        self.motion = MotionConstants(value, slopes, gain, n, eps, rtol, floor, along[0], along[1])
        self.y, self.clock = np.array(first), np.array([t_start, 0.0, t_end, 0.0])
        implicit = 1.0 if n > MAX_COMPONENTS else 0.0
        largest = max(1.0, float(np.abs(first).max()))
        worth = MIN_IMPLICIT_STEPS * price(n)
        self.control = np.array([h, 1.0, 0.0, float(most), 0.0, largest, implicit, 0.0, worth, farthest, MIN_STEP])
        assert len(self.control) == CONTROL

    @property
    def evaluations(self) -> int:
        """Evaluations of the field so far."""
        return int(self.clock[3])

    def chunks(self) -> Iterator[StepArray]:
        """Step to the end.

        Raises
        ------
        BlowUpError, StepsTooShortError, TooManyStepsError
            As `bounded` does of `steps`.
        """
        n, count = len(self.y), self.chunk
        table, work, code = _table(), self.work(), CHUNK_FULL
        while code in (CHUNK_FULL, AT_SIGMA):  # who has arrived asks for no more
            starts, lengths = np.empty(count), np.empty(count)
            ends, polynomials = np.empty((count, n)), np.empty((count, n, DENSE_DEGREE))
            begin = self.y.copy()
            code, filled = integrate_motion(
                self.motion, table, work, self.y, self.clock, self.control, starts, lengths, ends, polynomials
            )
            yield StepArray(begin, starts[:filled], lengths[:filled], ends[:filled], polynomials[:filled])
        error = self.failure(code)
        if error is not None:
            raise error

    def work(self) -> Any:
        """Return a workspace."""
        return workspace(len(self.y), self.parameter)

    def failure(self, code: int) -> TooManyStepsError | None:
        """Say why it has ended before its time."""
        return failure(self.problem, code, float(self.clock[0]), self.y)


@dataclass(frozen=True)
class CompletedMotion:
    """A motion that was followed all the way: its dense output, why it ended (`failure`), and its evaluations."""

    motion: Dense
    code: int
    t: float
    evaluations: int


def integrate_compiled(
    field: Field,
    psi: Psi,
    eps: float,
    lines: Sequence[InvariantLine | None],
    first: Array,
    span: tuple[float, float],
    rtol: float,
    floor: float,
    most: int,
) -> list[CompletedMotion]:
    """Follow one motion from each state; of many, on all cores.

    Parameters
    ----------
    field : Field
    psi : Psi
    eps : float
    lines : sequence of k InvariantLine or None
    first : ndarray (k, n)
    span : (t_start, t_end)
    rtol, floor, most
        As in `CompiledMotion`.

    Raises
    ------
    ValueError
        The rate is not finite at one of the states; the message names the first.
    """
    made, count = functions_of(field, psi), len(first)
    numbers, along = np.array([eps, rtol, floor, *span, psi.parameter]), line_directions(lines)

    def part(cut: slice) -> list[CompletedMotion]:
        times, lengths, states, polynomials, told = follow_all(
            made.addresses, numbers, numbers_of_tableau(), along[cut], first[cut], float(most)
        )
        return _split_motions(times, lengths, states, polynomials, told, first.shape[1])

    return shared_out(part, count)


def line_directions(lines: Sequence[InvariantLine | None]) -> Array:
    """Return the direction (k, 2) of the invariant line of each motion, 0 where there is none."""
    return np.array([(0.0, 0.0) if line is None else line.n for line in lines], float).reshape(-1, 2)


def shared_out(part: Callable[[slice], list[Any]], count: int) -> list[Any]:
    """Return what `part` returns for `count` motions, slice by slice: few at once, many on all cores."""
    cores = os.cpu_count() or 1
    if count < SHARED_OUT or cores == 1:
        return part(slice(0, count))
    from concurrent.futures import ThreadPoolExecutor  # imported late: one motion does without

    size = max(1, min(LARGEST_PART, -(-count // (PARTS_PER_CORE * cores))))
    cuts = [slice(i, i + size) for i in range(0, count, size)]
    with ThreadPoolExecutor(cores) as pool:
        return [one for found in pool.map(part, cuts) for one in found]


def _split_motions(
    times: Array, lengths: Array, states: Array, polynomials: Array, told: Array, n: int
) -> list[CompletedMotion]:
    """Cut what `follow_all` returns into motions, without copying."""
    states, polynomials = states.reshape(-1, n), polynomials.reshape(-1, n, DENSE_DEGREE)
    for array in (times, lengths, states, polynomials):
        array.flags.writeable = False
    found, row = [], 0
    for steps, code, t, evaluations in told.tolist():
        last = row + int(steps)
        motion = Dense(times[row : last + 1], states[row : last + 1], lengths[row:last], polynomials[row:last])
        found.append(CompletedMotion(motion, int(code), t, int(evaluations)))
        row = last + 1
    return found
