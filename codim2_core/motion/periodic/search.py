"""Periodic motions by Newton's method, for eps > 0 and in the limit, and whether they are stable."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...formulas.expression import Expression
from ...formulas.names import SLOW_NAMES
from ...formulas.tape import compact
from ...results.arrays import Array
from ...results.words import say
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.function import Psi
from ..initial_value.field import Field, field
from ..limit.sigma_decision import checked_stiction
from ..result import Simulation
from ..simulate import MAX_STEPS, checked_eps, checked_state, checked_tolerances, simulate, with_time
from .result import PeriodicMotion, PeriodicStatus
from .shooting import LostError, Shooting, Shot, matching_distances, multipliers

MAX_NEWTON, MAX_HALVINGS = 40, 8  # of Newton's method, and of one of its steps
FINAL_RTOL_SHARE = 1e-2  # of rtol: how closely the motion is followed at last
CLOSEST = 1e-13  # rtol of a motion
RESIDUAL_RTOLS, LOOSE = 10.0, 1e4  # times rtol: residuals that are small enough, and that rounding may leave
RESIDUAL_ROUNDING = 1e-15
#: Of its size: what moves less is at rest; also where the search ends in no motion.
REST_EXTENT, NEARLY_STILL = 1e-6, 1e-3
MAX_PERIOD_FACTOR = (
    3.0  # factor by which a period may be another than is given: as it shrinks all motions come to repeat themselves
)
MOST_TIMES = 12  # that a motion is asked whether it has repeated itself
REPEAT_TOLERANCE = 1e-7  # relative: formulas, and states, that repeat themselves
LOOKED_AT = 16  # states at which formulas are asked whether they do
NEUTRAL = 1e-4  # |1 - multiplier|, up to which motions that nearly repeat themselves are a family
SETTLED = 1e-4  # of the residual of a period: that of the next one, of a motion that has settled
GENERIC = 0.381966  # of the way between two places: none lies where a square wave jumps


@takes_names
def periodic_motion(
    system: AnySystem,
    psi: Psi | None,
    state0: ArrayLike,
    period: float,
    *,
    eps: float | None = None,
    advance: ArrayLike | None = None,
    rtol: float = 1e-9,
    atol: float = 1e-11,
    stiction: float = 1.0,
    max_steps: int = MAX_STEPS,
    max_step: float = np.inf,
) -> PeriodicMotion:
    """Find a motion that repeats itself, by Newton's method from a start near it, and say whether it is stable.

    Time is a slow variable with the rate 1, and a forcing a function of it. A slow variable of constant rate is such a
    clock: if there is one, the period is what is given, its start is kept, and all else is sought. Without a clock the
    period is sought too.

    Parameters
    ----------
    system : ELinear, System, or one of them frozen at a z
    psi : Psi
        The regularisation. In the limit it may be None, as in `simulate`.
    state0 : (2 + m,)
        (x, y, z1, ..., zm) near it.
    period : float
        Of a forced motion its period, a multiple of that of the forcing; else near it, within a factor of 3.
    eps : float, optional
        Left out, or 0, for the limit eps -> 0; else 1e-14 <= eps <= 1e6.
    advance : (m,), optional
        How far each slow variable is on after a period, as 2 pi for an angle. Left out, a clock is on by its rate times
        the period, and all others are where they were.
    rtol, atol : float
        As in `simulate`; at last it is followed with a hundredth of both.
    stiction : float
        Static over kinetic friction in the limit, as in `simulate_nonsmooth`.
    max_step : float
        As in `simulate`.
    max_steps : int
        Steps of one motion.

    Returns
    -------
    PeriodicMotion
        With a status that says so where none was found.

    Raises
    ------
    ValueError
        An argument is invalid, or the formulas do not repeat themselves when the slow variables are on by `advance`.

    Examples
    --------
    A mass on springs in the plane, pushed round and braked by friction on the ground, goes round with the push on a
    circle of radius sqrt(F^2 - mu^2)/|1 - w^2|:

    >>> import math
    >>> from codim2_core import System, periodic_motion
    >>> mass = System(
    ...     U=("-z1 - mu*c + F*cos(w*z3)", "-z2 - mu*s + F*sin(w*z3)"), W=("x", "y", "1"),
    ...     parameters={"mu": 0.3, "F": 0.5, "w": 2.0},
    ... )
    >>> found = periodic_motion(mass, None, (0.3, 0.0, 0.0, -0.1, 0.0), math.pi)
    >>> found.stability, round(math.hypot(*found.state0[2:4]), 9)
    ('stable', 0.133333333)
    """
    checked_tolerances(rtol, atol, max_steps, max_step)
    formulas = field(system)
    start = checked_state(with_time(state0, system, 0.0), formulas.m)
    asked = shooting(
        system,
        psi,
        checked_eps(eps, psi, stiction),
        start,
        float(period),
        advance,
        atol / rtol,
        max_steps,
        stiction,
        max_step,
    )
    return _search(asked, start, rtol)


def shooting(
    system: AnySystem, psi: Psi | None, eps: float, start: Array, period: float, advance: ArrayLike | None,
    floor: float, max_steps: int, stiction: float = 1.0, max_step: float = np.inf,
) -> Shooting:  # fmt: skip
    """Return the boundary value problem of a periodic motion; refuse formulas that do not repeat themselves."""
    formulas = field(system)
    checked_stiction(stiction, formulas)
    rates = np.array([row.constant or 0.0 for row in formulas.rows[2:]])
    moved = _advance(advance, rates, period)
    if not _repeats(formulas, start[None], moved):
        raise ValueError(
            f"the formulas do not repeat themselves as z moves on by {moved.tolist()}; give a multiple of the "
            "forcing's period, or by how much z moves on as advance."
        )
    return Shooting(system, psi, eps, formulas, rates != 0.0, moved, period, floor, max_steps, stiction, max_step)


def _advance(given: ArrayLike | None, rates: Array, period: float) -> Array:
    """Return how far z is on after a period."""
    if given is None:
        return rates * period
    found = np.array(given, float)
    if found.shape != rates.shape or not np.isfinite(found).all():
        raise ValueError(f"advance is {given!r}; give {len(rates)} finite numbers, one for each slow variable.")
    wrong = (rates != 0.0) & ~np.isclose(found, rates * period, rtol=REPEAT_TOLERANCE, atol=0.0)
    if wrong.any():
        i = int(np.argmax(wrong))
        raise ValueError(f"advance[{i}] is {found[i]}; z{i + 1} moves on by {rates[i] * period:.10g} in a period.")
    return np.where(rates != 0.0, rates * period, found)


def _repeats(formulas: Field, states: Array, advance: Array) -> bool:
    """Whether the field is the same at states and where z is on by `advance`: there, and at places next to."""
    if not advance.any():
        return True
    angles = np.arange(LOOKED_AT) * 2.4  # the golden angle: no two places look alike
    for k, angle in enumerate(angles.tolist()):
        x, y, *z = states[k % len(states)].tolist()
        z = np.array(z) + advance * ((k + GENERIC) / LOOKED_AT)
        e = 0.9 * np.cos(angle), 0.9 * np.sin(angle)
        here, there = (np.array(formulas.value(*e, x + e[0], y + e[1], *at.tolist())) for at in (z, z + advance))
        if not np.allclose(
            here, there, rtol=REPEAT_TOLERANCE, atol=REPEAT_TOLERANCE * (1.0 + np.nanmax(np.abs(here))), equal_nan=True
        ):
            return False
    return True


@dataclass(frozen=True)
class _Stopped(Exception):
    """Newton's method goes no further."""

    status: PeriodicStatus
    reason: str
    shot: Shot


def _search(asked: Shooting, start: Array, rtol: float) -> PeriodicMotion:
    try:
        rough = _newton(_divided(_after_settling(asked.shot(start, asked.period, rtol), rtol), rtol), rtol)
        closer = max(FINAL_RTOL_SHARE * rtol, CLOSEST)
        fine = _newton(rough.of.shot(rough.starts, rough.period, closer), closer)
    except LostError as lost:
        return _not_found(asked, lost.status, str(lost), lost.run, asked.period, np.nan)
    except _Stopped as stopped:
        shot = stopped.shot
        return _not_found(asked, stopped.status, stopped.reason, shot.run, shot.period, shot.residual)
    return _make_result(asked, rough, fine)


def _after_settling(shot: Shot, rtol: float) -> Shot:
    """Return the motion of the next period, where that repeats itself far better, as after one slip to rest."""
    ahead = shot.run.states[-1].copy()
    ahead[2:] -= shot.of.advance
    if not shot.of.is_forced or shot.residual <= LOOSE * rtol:
        return shot
    try:
        after = shot.of.shot(ahead, shot.period, rtol)
    except LostError:
        return shot
    return after if after.residual <= SETTLED * shot.residual else shot


def _divided(shot: Shot, rtol: float) -> Shot:
    """Return a shot in as many segments as it needs."""
    own, starts = shot.of.divide(shot.run, 0, shot.period, shot.variation)
    return shot if len(starts) == 1 else own.shot(starts, shot.period, rtol)


def _newton(shot: Shot, rtol: float) -> Shot:
    """Take Newton's steps, shorter ones where a whole one does not lead closer."""
    asked = shot.of
    for _ in range(MAX_NEWTON):
        if not asked.is_forced and _extent(shot) <= REST_EXTENT:
            break
        if shot.residual <= RESIDUAL_RTOLS * rtol and shot.step_size <= LOOSE * rtol:
            return shot
        if asked.is_forced and shot.residual <= min(np.sqrt(rtol), NEUTRAL * shot.step_size):
            return shot  # it drifts along a family of motions that repeat themselves nearly
        ahead = _closer(shot, rtol)
        if ahead is None:
            break
        shot = ahead
    still = not asked.is_forced and _extent(shot) <= REST_EXTENT
    if not still and shot.residual <= LOOSE * rtol and shot.step_size <= np.sqrt(rtol):
        return shot
    if not asked.is_forced and _extent(shot) <= NEARLY_STILL:
        raise _Stopped(PeriodicStatus.STANDS_STILL, say("comes to rest"), shot)
    raise _Stopped(PeriodicStatus.NO_CONVERGENCE, say("no periodic motion", residual=shot.residual), shot)


def _closer(shot: Shot, rtol: float) -> Shot | None:
    """Return what the longest part of the step that leads closer leads to; None if none does."""
    asked, (change, later) = shot.of, shot.step
    lost: LostError | None = None
    for k in range(MAX_HALVINGS):
        part = 0.5**k
        period = shot.period + part * later
        if not asked.period / MAX_PERIOD_FACTOR < period < asked.period * MAX_PERIOD_FACTOR:
            continue
        try:
            ahead = asked.shot(shot.starts + part * change, period, rtol)
        except LostError as error:
            lost = error
            continue
        if ahead.norm(shot.sizes) < (1.0 - 0.1 * part) * shot.residual:
            return ahead
    if lost is not None and shot.residual > LOOSE * rtol:
        raise lost
    return None


def _extent(shot: Shot) -> float:
    """Return the largest distance of a motion from its start, in units of its size."""
    return float((np.abs(shot.run.states - shot.run.states[0]) / shot.sizes).max())


def _not_found(
    asked: Shooting, status: PeriodicStatus, reason: str, run: Simulation, period: float, residual: float
) -> PeriodicMotion:
    missing = np.full(len(run.states[0]), np.nan)
    return _result(
        status, reason, run, period, asked.is_forced, asked.advance, np.empty(0, complex), np.empty(0), "undecided",
        residual, missing, 0.0 if asked.is_forced else np.nan,
    )  # fmt: skip


def _make_result(asked: Shooting, rough: Shot, fine: Shot) -> PeriodicMotion:
    n = len(fine.state)
    (others, _, _), (values, conditions, lost) = (
        multipliers(asked.formulas, asked.psi, shot.run, shot.variation, asked.clocks, shot.cuts[:-1])
        for shot in (rough, fine)
    )
    blur = float((fine.variation.error[:, :n] / fine.sizes[:, None] * fine.sizes).max(initial=0.0))
    apart = matching_distances(values, others) if len(others) == len(values) else np.ones(len(values))
    errors = conditions * max(blur, RESIDUAL_ROUNDING) + apart
    errors[len(values) - lost :] = 0.0
    change, later = fine.step
    moved = np.abs(fine.state - rough.state) + np.abs(change[0])
    moved[~asked.free] = 0.0
    period_error = 0.0 if asked.is_forced else abs(fine.period - rough.period) + abs(later)
    stability, why = _verdict(values, errors, fine.variation.within is not None)
    alone = not (np.abs(values - 1.0) <= np.maximum(errors, NEUTRAL * (fine.step_size > errors.max(initial=0.0)))).any()
    said = [say("repeats", period=fine.period)]
    times = _repetitions(asked, fine)
    said += [say("repeats sooner", count=times)] if times > 1 else []
    said += [say("start is lost", count=lost)] if lost else []
    said += [why] + ([] if alone else [say("not isolated")])
    return _result(
        PeriodicStatus.FOUND if alone else PeriodicStatus.NOT_ISOLATED, " ".join(said), fine.run, fine.period,
        asked.is_forced, asked.advance, values, errors, stability, fine.residual, moved, period_error,
    )  # fmt: skip


def _verdict(values: NDArray[np.complex128], errors: Array, in_a_line: bool) -> tuple[str, str]:
    """Say whether a motion with these multipliers is stable."""
    sizes = np.abs(values)
    if (sizes - errors > 1.0).any():
        return "unstable", say("periodic unstable", size=float(sizes.max()))
    close = sizes + errors >= 1.0
    if close.any():
        i = int(np.argmax(np.where(close, sizes, 0.0)))
        value, error = complex(values[i]), float(errors[i])
        where = "+1" if abs(value - 1.0) <= error else "−1" if abs(value + 1.0) <= error else "on the unit circle"
        return "undecided", say("periodic undecided", where=where, error=error)
    size = float(sizes.max(initial=0.0))
    if in_a_line:
        return "undecided", say("periodic next to a line", size=size)
    return "stable", say("periodic stable", size=size)


def _repetitions(asked: Shooting, shot: Shot) -> int:
    """Return how many times a motion repeats itself in its period."""
    motion, some = shot.run.dense, shot.run.states[:: max(1, len(shot.run.states) // LOOKED_AT)]
    for count in range(MOST_TIMES, 1, -1):
        part = asked.advance / count
        away = motion(shot.period / count) - shot.state
        away[2:] -= part
        if (np.abs(away) <= REPEAT_TOLERANCE * shot.sizes).all() and _repeats(asked.formulas, some, part):
            return count
    return 1


def _result(
    status: PeriodicStatus, reason: str, run: Simulation, period: float, forced: bool, advance: Array,
    values: NDArray[np.complex128], errors: Array, stability: str, residual: float, error: Array, period_error: float,
) -> PeriodicMotion:  # fmt: skip
    for array in (advance, values, errors, error):
        array.flags.writeable = False
    return PeriodicMotion(
        status, reason, run, period, forced, advance, values, errors, stability, residual, error, period_error
    )


MAX_DENOMINATOR, RATIO_TOLERANCE = 12, 1e-9  # of ratios of frequencies that have a common period
SETTLING_PERIODS, SETTLING_RTOL = 40, 1e-8  # of a forcing, for which a motion is followed until it has settled
SAMPLES = 4000  # of a free motion, among which it is seen to return
RETURN_DISTANCE = 0.05  # of its size: how near to its end a settled motion comes again


def forcing_period(system: AnySystem) -> float | None:
    """Return the common period of all sines and cosines of a slow variable of constant rate; None without one."""
    rows = field(system).rows
    rates = {name: row.constant for name, row in zip(SLOW_NAMES, rows[2:], strict=False) if row.constant}
    frequencies: set[float] = set()
    for row in rows:
        for op, *arguments in row.tape:
            if op in ("sin", "cos"):
                inner = Expression(compact(list(row.tape), arguments[0]))
                slopes = [(inner.derivative(name), rate) for name, rate in rates.items() if name in inner.names]
                if any(slope.names for slope, _ in slopes):
                    return None
                frequencies.add(abs(sum(slope.evaluate({}) * rate for slope, rate in slopes)))
    frequencies.discard(0.0)
    if not frequencies:
        return None
    base = min(frequencies)
    ratios = {one / base: Fraction(one / base).limit_denominator(MAX_DENOMINATOR) for one in frequencies}
    if any(abs(float(near) - ratio) > RATIO_TOLERANCE * ratio for ratio, near in ratios.items()):
        return None
    return 2.0 * math.pi / base * math.lcm(*(near.denominator for near in ratios.values()))


def settled_motion(
    system: AnySystem, start: tuple[float, ...], psi: Psi, eps: float, t_end: float
) -> tuple[Array, float] | None:
    """Follow a motion until it nearly repeats itself: a state (2 + m,) and a period; None where it does not."""

    def follow(span: float) -> Simulation:
        return simulate(system, psi, start, (0.0, span), eps=eps, rtol=SETTLING_RTOL)

    period = forcing_period(system)
    if period is not None:
        span = period * max(SETTLING_PERIODS, round(t_end / period))
        run = follow(span)
        clocks = [False, False, *(bool(row.constant) for row in field(system).rows[2:])]
        state = np.where(clocks, start, run.states[-1])
        return (state, period) if run.times[-1] == span else None
    if any(row.constant for row in field(system).rows[2:]):
        return None
    run = follow(t_end)
    if run.times[-1] < t_end:
        return None
    times = np.linspace(0.5 * t_end, t_end, SAMPLES)
    states = run.dense(times)
    away = np.linalg.norm((states - states[-1]) / (np.ptp(states, axis=0) + 1e-300), axis=1)
    left = np.flatnonzero(away > 10.0 * RETURN_DISTANCE)  # where it was last far away, and before that near again
    near = np.flatnonzero(away[: left[-1]] < RETURN_DISTANCE) if len(left) else left
    if not len(near):
        return None
    back = near[-1]
    while back and away[back - 1] < away[back]:
        back -= 1
    return states[-1], float(times[-1] - times[back])
