"""Response curves: a periodic motion followed along a parameter, for eps > 0 and in the limit, whatever its stability.

The unknowns are the start (without its clocks), the period where no clock gives it, and the parameter p; the conditions
are those of shooting, ``X(T) = X(0) + a``, and across them ``n.(X(0) - X_ref) = 0`` where every point is a start. The
curve of their zeros is followed by pseudo-arclength, so through folds. The variational equation gives all slopes: by
X(0) and T as in `shooting`, by p as its column of p.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from ...numerics.arclength import CurveEdge, StepBounds, tangent, trace_one_way, zero_between
from ...portrait.layer_problem.vary import check_name
from ...results.arrays import Array, Complex
from ...systems.arguments import number as positive_number
from ...systems.arguments import short_repr
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi
from ..result import Simulation
from ..simulate import MAX_STEPS
from .response_piece import MotionFamily, Piece, at_value, jump_corner, measure_piece, response_row
from .result import KINDS_OF_CHANGE, ResponseCurve, ResponsePoint, ResponseRow, change_point
from .search import periodic_motion, shooting

PIECE_POINTS = 24  # points after which unknowns are measured anew, and the section is laid anew
LONGEST_STEP, MAX_TANGENT_TURN = 0.1, 0.25  # of the span, or of the motion's size; between tangents, rad
MAX_MOTIONS, MAX_SIZE_RATIO = 600, 1e2  # each way; times its first size: a motion that grows beyond has no bound
PLACE_SHARE = 1e-9  # of a step, to which special points are found
CLOSED_DISTANCE = 0.5  # of the longest step: a curve that comes so near to its start, the same way, is closed


@takes_names
def response_curve(
    system: AnySystem,
    psi: Psi | None,
    state0: ArrayLike,
    period: float | Callable[[float], float],
    along: str,
    span: tuple[float, float],
    *,
    eps: float | None = None,
    advance: ArrayLike | None = None,
    rtol: float = 1e-9,
    atol: float = 1e-11,
    stiction: float = 1.0,
    max_steps: int = MAX_STEPS,
    max_step: float = np.inf,
) -> ResponseCurve:
    """Follow a periodic motion along a parameter, both ways from where the system is, through folds.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi or None
        As in `periodic_motion`.
    state0 : (2 + m,)
        Near a periodic motion of the system as it is.
    period : float, or callable
        Of a forced motion its period; where that changes with the parameter, a function of it, as
        ``lambda w: 2*pi/w``. Of others near it.
    along : str
        One of ``system.variable``; its present value lies in the span.
    span : (low, high)
    eps, advance, rtol, atol, stiction, max_steps, max_step
        As in `periodic_motion`.

    Returns
    -------
    ResponseCurve
        Points in order along the curve, with all multipliers; folds, period doublings, Neimark-Sacker points, and where
        phases of the motion begin or end, such as a stick.

    Raises
    ------
    ValueError
        An argument is invalid, or no periodic motion was found to begin with; the message says why.

    Examples
    --------
    A mass on springs that is driven round, with friction 1/2, goes round on circles of radius
    sqrt(F^2 - S^2)/|1 - w^2|:

    >>> import math
    >>> from codim2_core import System, response_curve
    >>> mass = System(
    ...     U=("-z1 - c/2 + cos(w*z3)", "-z2 - s/2 + sin(w*z3)"), W=("x", "y", "1"), parameters={"w": 2.0},
    ... )
    >>> found = response_curve(mass, None, (0.0, -0.5, -0.3, 0.05, 0.0), lambda w: 2.0*math.pi/w, "w", (1.8, 2.2))
    >>> radius = [math.hypot(*state[2:4]) for state in found.state0]
    >>> bool(max(abs(r - math.sqrt(0.75)/(w*w - 1.0)) for r, w in zip(radius, found.values)) < 1e-8)
    True
    """
    check_name(system, psi or constant(), (0.0,) * system.m, "along", along)
    low, high = float(span[0]), float(span[1])
    value = float(system.value_of(along)) if along in system.variable else math.nan
    if not low <= value <= high or not low < high:
        raise ValueError(
            f"span is ({low:g}, {high:g}), and {along} of the system {value:g}; give two numbers about it, low first."
        )

    def period_of(at: float) -> float:
        try:
            return positive_number("period", period(at) if callable(period) else period)
        except TypeError as error:
            raise ValueError(f"period is {short_repr(period)}; give a number, or a function of {along}.") from error

    eps = eps or 0.0
    found = periodic_motion(
        system, psi, state0, period_of(value), eps=eps,
        advance=advance, rtol=rtol, atol=atol, stiction=stiction, max_steps=max_steps, max_step=max_step,
    )  # fmt: skip
    if not found.found:
        raise ValueError(f"no periodic motion to begin with: {found.reason}")
    moved = None if callable(period) and advance is None else found.advance
    own = shooting(system, psi, eps, found.state0, found.period, moved, atol / rtol, max_steps, stiction, max_step)
    family = MotionFamily(own, along, (low, high), period_of, moved, rtol)
    return _trace_both_ways(family, found.run, found.period, value)


def _trace_both_ways(family: MotionFamily, run: Simulation, period: float, value: float) -> ResponseCurve:
    rows: list[ResponseRow] = []
    special: list[ResponsePoint] = []
    ends: list[str] = []
    for sign in (-1.0, 1.0):
        found, points, end = _trace_response(family, run, period, value, sign)
        if not found:
            raise ValueError("the periodic motion to begin with is one of a family: its curve has no direction there.")
        rows = [*reversed(rows), *found[1 if rows else 0 :]]
        special = [*reversed(special), *points]
        ends.append(end)
        if end == "closed":
            ends = ["closed", "closed"]
            break
    return ResponseCurve.of(family.along, family.span, rows, special, (ends[0], ends[1]))


def _trace_response(
    family: MotionFamily, run: Simulation, period: float, value: float, sign: float
) -> tuple[list[ResponseRow], list[ResponsePoint], str]:
    """Follow the curve one way: its motions from the first on, special points between them, and how it ends."""
    rows: list[ResponseRow] = []
    special: list[ResponsePoint] = []
    piece, way = measure_piece(family, run, period, value)[0], None
    here = piece.unknowns(piece.starts, period, value)
    while True:
        along = tangent(piece.condition, here)
        if along is None:
            return rows, special, "lost"
        along = along * (sign if way is None and along[-1] >= 0.0 else -sign if way is None else 1.0)
        if way is not None and float(along @ way) < 0.0:
            along = -along
        edges = [CurveEdge("span", lambda v: (-float(v[-1]), -_last_unit(v))),
                 CurveEdge("span", lambda v: (float(v[-1]) - 1.0, _last_unit(v)))]  # fmt: skip
        bounds = StepBounds(LONGEST_STEP, MAX_TANGENT_TURN, PIECE_POINTS, close=1e-8, enough=1e-5)
        points, end = trace_one_way(piece.condition, here, along, edges, bounds)
        line = [here, *points]
        if end == "lost" and len(line) > 1 and (beyond := jump_corner(piece, *line[-2:])) is not None:
            line, end = [*line, beyond], "many"
        for one, other in pairwise(line):
            before = rows[-1] if rows else response_row(piece, one, float(other[-1] - one[-1]))
            after = response_row(piece, other, float(other[-1] - one[-1]))
            if before is None or after is None:
                return rows, special, "lost"
            rows += [before] if not rows else []
            special += _special_points(piece, one, other, before, after)
            rows.append(after)
        if (rows[-1].swings > MAX_SIZE_RATIO * np.maximum(rows[0].swings, piece.family.first.floor)).any():
            return rows, special, "grows"
        if end != "many" or len(rows) > MAX_MOTIONS or len(line) < 2:
            return rows, special, end
        if _comes_round(rows, piece):
            return rows, special, "closed"
        (_, before, earlier), (_, period, value) = piece.motion_of(line[-2]), piece.motion_of(line[-1])
        old, run = (piece.shot(v).run for v in line[-2:])
        further, part = measure_piece(family, run, period, value)
        starts = further.starts_on(old, before, earlier, part)
        way = further.unknowns(further.starts, period, value) - further.unknowns(starts, before, earlier)
        piece, here = further, further.unknowns(further.starts, period, value)


def _last_unit(v: Array) -> Array:
    unit = np.zeros(len(v))
    unit[-1] = 1.0
    return unit


def _comes_round(rows: list[ResponseRow], piece: Piece) -> bool:
    """Whether the last motions have come to the first again, in the same direction."""
    first, width = rows[0], piece.family.span[1] - piece.family.span[0]
    for row in rows[max(PIECE_POINTS, len(rows) - PIECE_POINTS) :]:
        away = np.abs((row.state - first.state) / piece.sizes)[piece.free].max(initial=0.0)
        near = max(away, abs(row.value - first.value) / width) < CLOSED_DISTANCE * LONGEST_STEP
        if near and row.onward * rows[1].onward > 0.0:
            return True
    return False


def _special_points(
    piece: Piece, one: Array, other: Array, before: ResponseRow, after: ResponseRow
) -> Iterator[ResponsePoint]:
    """Find special points between two neighbours."""
    for kind, test in KINDS_OF_CHANGE.items():
        if len(before.multipliers) != len(after.multipliers):
            continue
        if not test(before.multipliers) * test(after.multipliers) < 0.0:
            continue

        def value(v: Array, test: Callable[[Complex], float] = test) -> float:
            row = response_row(piece, v, 0.0)
            return math.nan if row is None else test(row.multipliers)

        place = zero_between(piece.condition, value, one, other, PLACE_SHARE)
        row = response_row(piece, place, before.onward)
        if row is not None and (
            point := change_point(piece.family.along, kind, row, before, after, _parameter_turns(piece, one, other))
        ):
            yield point
    if Counter(before.phases) != Counter(after.phases) and piece.family.first.eps == 0.0:
        row = _phase_border(piece, (one, before), (other, after))
        if (point := change_point(piece.family.along, "phases change", row, before, after)) is not None:
            yield point


def _parameter_turns(piece: Piece, one: Array, other: Array) -> bool:
    """Whether the parameter turns between two neighbours, by tangents: near a fold its values differ too little."""
    ends = tangent(piece.condition, one), tangent(piece.condition, other)
    slopes = [end[-1] * float(end @ (other - one)) for end in ends if end is not None]
    return len(slopes) == 2 and slopes[0] * slopes[1] < 0.0


def _phase_border(piece: Piece, one: tuple[Array, ResponseRow], other: tuple[Array, ResponseRow]) -> ResponseRow:
    """Bisect for where the phases of a motion change between two, as far as it can be followed there."""
    (low, before), (high, after) = one, other
    while abs(float(high[-1] - low[-1])) > PLACE_SHARE:
        middle = 0.5 * (low + high)
        found = at_value(piece, middle[:-1], float(middle[-1]))
        row = None if found is None else response_row(piece, found, before.onward)
        if found is None or row is None:
            break
        if Counter(row.phases) == Counter(before.phases):
            low, before = found, row
        else:
            high, after = found, row
    return after
