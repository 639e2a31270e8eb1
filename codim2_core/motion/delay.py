"""A delayed loss of stability as a result: where a motion came to a set, where that became unstable, where it left."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numerics.dense import Dense
from ..results.arrays import Array
from ..results.result import Tabled
from ..results.tables import point
from ..results.words import say
from .initial_value.field import Field
from .initial_value.slow_manifold import solve_critical

DELAY_SAMPLES = 33  # of the delay


@dataclass(frozen=True, eq=False, slots=True)
class Delay(Tabled):
    """A motion that stays near a critical set past its loss of stability; arrays are read-only.

    At a Hopf bifurcation (tr J = 0 < det J), or an exchange of stability (det J = 0) on a set that does not move.

    Attributes
    ----------
    onto : str
        The critical set, by its name where the motion came to it: "C" or "C1", ....
    t_in, t_hopf : float
        When the motion came to it, and when it lost its stability.
    t_out : float or None
        When the motion leaves it: in the limit eps -> 0, in formulas that are analytic and while nothing disturbs it.
        None if it was not left as far as it was followed.
    z_in, z_hopf : ndarray (m,)
        z then.
    z_out : ndarray (m,) or None
    buffer : complex or None
        The singular time that ends the delay before way in = way out; None where that does.
    z, e, flow : ndarray (k, m), (k, 2), (k, m)
        Along the delay, at even times from ``t_hopf`` to ``t_out``, or as far as it was followed.
    bifurcation : str
        "Hopf", "transcritical" or "pitchfork".
    """

    _head_ = ("on", "came at z", "unstable from z", "left at z", "why there")

    onto: str
    t_in: float
    t_hopf: float
    t_out: float | None
    z_in: Array
    z_hopf: Array
    z_out: Array | None
    buffer: complex | None
    z: Array
    e: Array
    flow: Array
    bifurcation: str = "Hopf"

    @property
    def reason(self) -> str:
        """Return the reason of its end as a sentence."""
        if self.t_out is None:
            return say("delay, open", C=self.onto, how=self.bifurcation)
        key = "Hopf, delayed until" if self.buffer is None else "Hopf, delayed until the buffer"
        return say(key, C=self.onto, how=self.bifurcation)

    def _row_(self) -> tuple[str, ...]:
        left = "–" if self.z_out is None else point(self.z_out)
        return self.onto, point(self.z_in), point(self.z_hopf), left, self.reason


def delay(
    formulas: Field,
    motion: Dense,
    known: tuple[Array, Array],
    onto: str,
    times: tuple[float, float, float],
    left: bool,
    buffer: complex | None,
    bifurcation: str = "Hopf",
) -> Delay:
    """Gather a delay; `known` are times (k,) and the e (k, 2) there."""
    t_in, t_hopf, t_end = times
    z_in, z_hopf, z_end = motion(np.array(times))[:, 2:]
    t = np.linspace(t_hopf, t_end, DELAY_SAMPLES)
    z = motion(t)[:, 2:]
    e = np.stack([np.interp(t, known[0], column) for column in known[1].T], axis=-1)
    for i, guess in enumerate(e):
        found = solve_critical(formulas, guess, z[i])
        e[i] = guess if found is None else found
    flow = np.array(
        [formulas.value(*place, 0.0, 0.0, *slow)[2:] for place, slow in zip(e.tolist(), z.tolist(), strict=True)]
    )
    for array in (z_in, z_hopf, z_end, z, e, flow):
        array.flags.writeable = False
    t_out, z_out = (t_end, z_end) if left else (None, None)
    return Delay(onto, t_in, t_hopf, t_out, z_in, z_hopf, z_out, buffer if left else None, z, e, flow, bifurcation)
