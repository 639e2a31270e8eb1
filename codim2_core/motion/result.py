"""The result of a simulation: states, times, dense output, and its phases with their reasons."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..formulas.names import SLOW_NAMES
from ..numerics.dense import Dense, DenseMotion
from ..results.arrays import Array
from ..results.result import Tabled, result_rows
from ..results.tables import MAX_ROWS, paragraphs, table_number
from ..results.words import say
from .delay import Delay
from .locations import NO_POINTS, Ascent, Location

if TYPE_CHECKING:
    from .variation.propagators import Variation


from numpy.typing import NDArray

MIN_TIMES = 240  # even times of a drawn motion, at least
CHORD_TOLERANCE = (
    0.002  # radii of the equator, outside of the distance from Sigma: how far a chord may be from the curve
)
MAX_POINTS = 8000  # points, beyond which chords may be further from it
MAX_HALVINGS, THINNINGS = 8, 5


@dataclass(frozen=True, eq=False)
class Drawn:
    """A motion as a curve of the picture; arrays are read-only."""

    times: Array  # (k,) Not decreasing: what takes no time in the limit has several points at one time
    states: Array  # (k, 2 + m)
    points: Array  # (k, 2) (1 + r) e outside in the limit, (1 + rho) p for eps > 0; p on the hemisphere


def drawn_curve(motion: Dense, phases: Sequence[Any], eps: float) -> Drawn:
    """Return a motion as a curve, as `Simulation.drawn` does."""
    times = _drawing_times(motion, eps)
    states = motion(times)
    points = states[:, :2].copy()
    pieces: list[tuple[Array, Array, Array]] = []
    done = 0
    for k, phase in enumerate(phases):
        last = k + 1 == len(phases)
        end = len(times) if last else int(np.searchsorted(times, phases[k + 1].t_start, side="left"))
        up = phase.ascent
        up = up[_needed_points(up, CHORD_TOLERANCE)]
        state = motion(np.full(len(up), phase.t_start))
        pieces.append((np.full(len(up), phase.t_start), state, up))
        if end > done:
            p = phase.p(np.clip(times[done:end], phase.t_start, phase.t_end))
            rho = np.hypot(np.hypot(states[done:end, 0], states[done:end, 1]), eps)
            points[done:end] = p * (1.0 + rho)[:, None]
            if eps == 0.0 and len(up) and str(phase.onto).startswith("cycle"):
                points[done:end] = up[-1]  # it stays on the cycle onto which the orbit winds
            pieces.append((times[done:end], states[done:end], points[done:end]))
            done = end
    if not pieces:
        pieces.append((times, states, points))
    return Drawn(*(np.concatenate(column) for column in zip(*pieces, strict=True)))


def _drawing_times(motion: Dense, eps: float) -> Array:
    """Return the times at which a motion is drawn: even ones, and those that chords need to look like the curve."""
    first, last = float(motion.times[0]), float(motion.times[-1])
    if not last > first:
        return motion.times

    def state_at(t: Array) -> Array:
        xy = motion(t)[:, :2]
        rho = np.hypot(np.hypot(xy[:, 0], xy[:, 1]), eps)[:, None]
        return xy * np.divide(1.0 + rho, rho, out=np.zeros_like(rho), where=rho > 0.0)

    even = np.linspace(first, last, MIN_TIMES)
    times = np.union1d(even, motion.times)
    for _ in range(MAX_HALVINGS):
        middle = 0.5 * (times[:-1] + times[1:])
        points = state_at(times)
        bent = _off(state_at(middle), points[:-1], points[1:]) > CHORD_TOLERANCE
        times = np.union1d(times, middle[bent])
        if not bent.any() or len(times) > 4 * MAX_POINTS:
            break
    points, eye = state_at(times), CHORD_TOLERANCE
    while True:
        kept = _needed_points(points, eye) | np.isin(times, even)
        if kept.sum() <= MAX_POINTS or eye > 1.0:
            return times[kept]
        eye *= 2.0


def _needed_points(points: Array, eye: float) -> NDArray[np.bool_]:
    """Mark the points of a curve without which chords would be further from it than the eye may see."""
    kept = np.arange(len(points))
    for _ in range(THINNINGS):
        here = kept[1:-1:2]
        if not len(here):
            break
        off = _off(points[here], points[kept[:-2:2]], points[kept[2::2]])
        kept = np.setdiff1d(kept, here[off <= eye / THINNINGS], assume_unique=True)
    mask = np.zeros(len(points), bool)
    mask[kept] = True
    return mask


def _off(points: Array, start: Array, end: Array) -> Array:
    """Distance of points from chords, in units of what is seen as a radius there."""
    chord = end - start
    share = ((points - start) * chord).sum(axis=1) / np.maximum((chord**2).sum(axis=1), 1e-300)
    away = points - start - np.clip(share, 0.0, 1.0)[:, None] * chord
    return np.hypot(away[:, 0], away[:, 1]) / np.maximum(1.0, np.hypot(points[:, 0], points[:, 1]))


class SimulationStatus(Enum):
    """The reason why a simulation ended; the value is the sentence shown."""

    T_END = say("end of span")
    EVENT = say("at an event")
    NOT_UNIQUE = say("not unique")
    FORGOTTEN = say("past ends")
    BLOW_UP = say("blows up")
    STEP_LIMIT = say("step limit")


@dataclass(frozen=True, eq=False)
class Phase(Tabled):
    """One phase of a motion.

    Attributes
    ----------
    kind : str
        "slide": it follows a critical set or a limit cycle of the layer problem, in the limit exactly and for eps > 0
        within O(eps) in p, with the way onto it; "cross": it passes Sigma, and follows none; "slip": else.
    t_start, t_end : float
    reason : str
        Why it began: a sentence.
    onto : str or None
        The set that it slides on, by its name at t_start: "C" (or "C1", ..., in the order of `critical_sets`),
        "cycle 1"; None elsewhere.
    delay : Delay or None
        Of a slide in the limit on a critical set that has lost its stability (Hopf): when and where that was, and when
        and where the motion leaves it.
    """

    _head_ = ("phase", "from t", "to t", "on", "why it began")

    _internal_: ClassVar[frozenset[str]] = frozenset({"with_place"})

    kind: str
    t_start: float
    t_end: float
    reason: str
    onto: str | None = None
    delay: Delay | None = field(default=None, repr=False, compare=False)
    _place: Location | None = field(default=None, repr=False, compare=False)
    _ascent: Ascent | None = field(default=None, repr=False, compare=False)

    def with_place(self, place: Location, ascent: Ascent | None) -> Phase:
        """Return the phase with where it lies, and how it came there."""
        return replace(self, _place=place, _ascent=ascent)

    def _row_(self) -> tuple[str, ...]:
        return self.kind, table_number(self.t_start), table_number(self.t_end), self.onto or "", self.reason

    def e(self, t: ArrayLike) -> Array:
        """Return e at times within the phase: ``e_Psi`` of the state, in the limit that of the set it slides on.

        On a limit cycle in the limit it is the mean over the cycle; for a crossing in the limit, which takes no time,
        that of the direction in which it leaves.

        Parameters
        ----------
        t : float or (...,)

        Returns
        -------
        ndarray (..., 2)

        Raises
        ------
        ValueError
            A time is outside the phase.
        """
        return self._at(t)[0]

    def p(self, t: ArrayLike) -> Array:
        """Return the place in the projected disc at times within the phase; as `e`, with |p| = 1 on the equator.

        Parameters
        ----------
        t : float or (...,)

        Returns
        -------
        ndarray (..., 2)

        Raises
        ------
        ValueError
            A time is outside the phase.
        """
        return self._at(t)[1]

    def _at(self, t: ArrayLike) -> tuple[Array, Array]:
        when = np.asarray(t, float)
        if self._place is None:
            raise ValueError("this phase was not made by a simulation: it has no place.")
        if when.size and not (when.min() >= self.t_start and when.max() <= self.t_end):
            raise ValueError(f"t is {t}; this phase lasts from {self.t_start} to {self.t_end}.")
        e, p = self._place.at(when.ravel())
        return e.reshape(*when.shape, 2), p.reshape(*when.shape, 2)

    @cached_property
    def ascent(self) -> Array:
        """Orbit (k, 2) of the layer problem that it begins with, in p: in the limit that takes no time; else empty."""
        return NO_POINTS if self._ascent is None else self._ascent.path(self.onto)


@dataclass(frozen=True, eq=False)
class Simulation(DenseMotion):
    """A motion; arrays are read-only.

    Attributes
    ----------
    times : ndarray (k,)
        Those that were requested; else the ends of the steps, from t_start on, never decreasing. Near Sigma two may be
        equal: steps of length eps can be shorter than the spacing of doubles.
    states : ndarray (k, 2 + m)
        (x, y, z1, ..., zm).
    phases : tuple of Phase
    status : SimulationStatus
    reason : str
        The status, and what there is to say about it here.
    eps : float
        0 for the nonsmooth limit.
    evaluations : int
        Evaluations of the field.
    events : tuple of ndarray
        Times of each event.
    """

    _internal_: ClassVar[frozenset[str]] = frozenset({"motion", "sample"})

    status: SimulationStatus
    reason: str
    eps: float
    evaluations: int
    events: tuple[Array, ...]
    _phases: Callable[[], tuple[Phase, ...]] = field(repr=False, compare=False)
    _variation: Callable[[tuple[str, ...]], Variation] = field(repr=False, compare=False)

    def __repr__(self) -> str:
        phases = ", ".join(f"{one.kind} from {one.t_start:.6g}" for one in self.phases[:MAX_ROWS])
        span = f"{self.motion.times[0]:.6g} to {self.motion.times[-1]:.6g}"
        return f"<motion for eps = {self.eps:g} from t = {span}: {phases}. {self.reason}>"

    def _tables_(self) -> str:
        return result_rows(self.phases) + paragraphs([self.reason])

    @property
    def success(self) -> bool:
        """Whether it came to the end of its span, or to a terminal event: as SciPy's `solve_ivp` says it."""
        return self.status in (SimulationStatus.T_END, SimulationStatus.EVENT)

    @property
    def message(self) -> str:
        """The reason, by the name that SciPy's results have for it."""
        return self.reason

    @cached_property
    def phases(self) -> tuple[Phase, ...]:
        """Consecutive phases, read off the motion when first requested."""
        return self._phases()

    def variation(self, *names: str) -> Variation:
        """Differentiate the motion by its start and by numbers of its system.

        In the limit the derivatives go through arrival at Sigma, sliding on critical sets, crossing and exit at the
        equator. Left out, as columns of zeros, is what has no derivative: (x, y) of a start on Sigma itself, and in
        an invariant line that repels what leads out of it.

        Parameters
        ----------
        *names : str
            Of ``system.variable``: its parameters; of e-linear systems also a, b, d, f1, f2 where they are numbers.

        Returns
        -------
        Variation
            As far as the derivatives are known, with the reason where that is not all of the motion.

        Raises
        ------
        ValueError
            A name is none of the system's.

        Examples
        --------
        A ball that slips comes to roll with 5/7 of its speed:

        >>> from codim2_core import examples, simulate_nonsmooth
        >>> run = simulate_nonsmooth(examples.ball_in_pool(K=0.0), (1.0, 0.0, 1.0, 0.0), (0.0, 1.0))
        >>> run.variation().last[2, :3].round(9).tolist()
        [-0.285714286, 0.0, 1.0]
        """
        return self._variation(names)

    @cached_property
    def invariant(self) -> float:
        """Largest relative drift of rho ebar = eps over the states; 0 in the nonsmooth limit.

        x and y themselves are integrated, so that this is rounding alone.
        """
        if self.eps == 0.0:
            return 0.0
        rho = np.hypot(np.hypot(self.states[:, 0], self.states[:, 1]), self.eps)
        ebar = np.sqrt(np.maximum(0.0, 1.0 - ((self.states[:, :2] / rho[:, None]) ** 2).sum(axis=1)))
        near = ebar > 0.1  # further out 1 - |p|^2 only cancels
        drift = np.abs(rho[near] * ebar[near] / self.eps - 1.0)
        return float(drift.max()) if near.any() else 0.0

    def phase_at(self, t: float) -> Phase | None:
        """Return the phase at time t, at a change of phases the later one; None if the motion stopped at once."""
        self.motion(t)  # raises where t is outside
        return next((phase for phase in reversed(self.phases) if phase.t_start <= t), None)

    def drawn(self) -> Drawn:
        """Return the motion as a curve of the picture, at even times and wherever its chords would be seen to bend.

        In the limit the orbits up the hemisphere, which take no time, are put in where phases begin with one; a slide
        on a limit cycle is drawn by the orbit that winds onto it.
        """
        return drawn_curve(self.motion, self.phases, self.eps)

    def _columns(self, when: Array, states: Array) -> dict[str, Any]:
        named = dict(zip(("x", "y", *SLOW_NAMES), states.T, strict=False))
        starts = [phase.t_start for phase in self.phases]
        phases = [self.phases[i - 1] for i in np.searchsorted(starts, when, side="right") if i]  # as `phase_at`
        own = {"phase": [phase.kind for phase in phases], "onto": [phase.onto for phase in phases]} if starts else {}
        return {"t": when, **named, **own}


def simulation(
    motion: Dense,
    phases: Callable[[], tuple[Phase, ...]],
    variation: Callable[[tuple[str, ...]], Variation],
    status: SimulationStatus,
    *,
    detail: str = "",
    eps: float = 0.0,
    evaluations: int = 0,
    events: Sequence[Sequence[float]] = (),
) -> Simulation:
    """Gather a result."""
    found = tuple(np.array(times) for times in events)
    for array in found:
        array.flags.writeable = False
    return Simulation(motion, status, f"{status.value} {detail}".strip(), eps, evaluations, found, phases, variation)
