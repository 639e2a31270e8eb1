"""Blocks, boxes and pucks: closed forms of Coulomb friction in the plane.

On an incline with gravity's pull G along it, and friction m G, let u = tan(psi/2) of the angle psi between the velocity
and the way down. Then ``v = K u^(m - 1) (1 + u^2)`` and ``dt = -(K/G) u^(m - 2) (1 + u^2) du``, which gives time and
place in powers of u: a puck that is thrown across stops, for m > 1, after ``v (m + cos psi)/(G (m^2 - 1))``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from numpy.typing import ArrayLike

from ...systems.examples.bodies import tilting_block, unit_vector_control
from ...systems.examples.example import GRAVITY
from ...systems.kinds import AnySystem
from ...systems.typed import System
from ..result import Simulation
from ..simulate import simulate_nonsmooth
from .record import ATOL, RTOL, ReferenceMotion, closed_form

TEXTBOOK = "textbook; the closed form is derived in `reference.sliding`"


def follow(system: AnySystem, state0: ArrayLike, t_end: float, stiction: float = 1.0) -> Simulation:
    """Follow a motion in the limit eps -> 0, as closely as is sensible."""
    return simulate_nonsmooth(system, state0, (0.0, t_end), rtol=RTOL, atol=ATOL, stiction=stiction)


def incline(slope: float, mu: float) -> System:
    """Return a puck on an incline: (x, y) its velocity down and across, z its place."""
    return System(
        U=("g*sin(slope) - mu*g*cos(slope)*c", "-mu*g*cos(slope)*s"), W=("x", "y"),
        parameters={"g": GRAVITY, "slope": slope, "mu": mu},
    )  # fmt: skip


def _box_stops() -> Sequence[float]:
    run = follow(incline(0.0, 0.5), (6.0 * math.cos(0.4), 6.0 * math.sin(0.4), 0.0, 0.0), 2.0)
    return run.phases[0].t_end, math.hypot(*run.states[-1, 2:])


BOX_STOPS = ReferenceMotion(
    "box-stops", "A box slides to rest",
    "A box slides on level ground at 6 m/s, friction 0.5, gravity 9.81 m/s², in a direction of 0.4 rad.",
    "textbook; the test of sliding boxes of rigid-body engines", (
        closed_form("time to rest", "s", 6.0 / (0.5 * GRAVITY), "v/(μ g)"),
        closed_form("way to rest", "m", 36.0 / GRAVITY, "v²/(2 μ g)"),
    ), _box_stops,
)  # fmt: skip

_BRAKING = GRAVITY * (0.5 * math.cos(0.3) - math.sin(0.3))


def _ramp_down() -> Sequence[float]:
    run = follow(incline(0.3, 0.5), (3.0, 0.0, 0.0, 0.0), 3.0)
    return run.phases[0].t_end, run.states[-1, 2]


RAMP_DOWN = ReferenceMotion(
    "ramp-down", "A block stops on a ramp",
    "A block slides down a ramp of 0.3 rad at 3 m/s, friction 0.5: it stops, and sticks.", "textbook", (
        closed_form("time to rest", "s", 3.0 / _BRAKING, "v/(g (μ cos α − sin α))"),
        closed_form("way to rest", "m", 4.5 / _BRAKING, "v²/(2 g (μ cos α − sin α))"),
    ), _ramp_down,
)  # fmt: skip

_ACCELERATION = GRAVITY * (math.sin(0.6) - 0.5 * math.cos(0.6))


def _ramp_slides() -> Sequence[float]:
    run = follow(incline(0.6, 0.5), (0.0, 0.0, 0.0, 0.0), 2.0)
    return run.states[-1, 0], run.states[-1, 2]


RAMP_SLIDES = ReferenceMotion(
    "ramp-slides", "A block begins to slide",
    "A block is let go on a ramp of 0.6 rad, friction 0.5, which is less than the slope: after 2 s.", "textbook", (
        closed_form("speed", "m/s", 2.0 * _ACCELERATION, "g (sin α − μ cos α) t"),
        closed_form("way", "m", 2.0 * _ACCELERATION, "g (sin α − μ cos α) t²/2"),
    ), _ramp_slides,
)  # fmt: skip


def _thrown_across() -> tuple[float, float, float]:
    v, psi, G, m = 2.0, 2.0, GRAVITY * math.sin(0.3), 0.5 / math.tan(0.3)
    u = math.tan(0.5 * psi)
    K = v / (u ** (m - 1.0) * (1.0 + u * u))
    down = K * K / G * (u ** (2.0 * m - 2.0) / (2.0 * m - 2.0) - u ** (2.0 * m + 2.0) / (2.0 * m + 2.0))
    across = 2.0 * K * K / G * (u ** (2.0 * m - 1.0) / (2.0 * m - 1.0) + u ** (2.0 * m + 1.0) / (2.0 * m + 1.0))
    return v * (m + math.cos(psi)) / (G * (m * m - 1.0)), down, across


def _ramp_across() -> Sequence[float]:
    run = follow(incline(0.3, 0.5), (2.0 * math.cos(2.0), 2.0 * math.sin(2.0), 0.0, 0.0), 2.0)
    return run.phases[0].t_end, run.states[-1, 2], run.states[-1, 3]


_TIME, _DOWN, _ACROSS = _thrown_across()
RAMP_ACROSS = ReferenceMotion(
    "ramp-across", "A puck is thrown across a ramp",
    "A puck is thrown at 2 m/s on a ramp of 0.3 rad, friction 0.5, at 2 rad from the way down: it curves, and stops.",
    TEXTBOOK, (
        closed_form("time to rest", "s", _TIME, "v (m + cos ψ)/(G (m² − 1))"),
        closed_form("way down", "m", _DOWN, "(K²/G) [u^(2m−2)/(2m−2) − u^(2m+2)/(2m+2)]"),
        closed_form("way across", "m", _ACROSS, "(2K²/G) [u^(2m−1)/(2m−1) + u^(2m+1)/(2m+1)]"),
    ), _ramp_across,
)  # fmt: skip


def _ramp_critical() -> Sequence[float]:
    return (follow(incline(0.5, math.tan(0.5)), (0.0, 2.0, 0.0, 0.0), 40.0).states[-1, 0],)


RAMP_CRITICAL = ReferenceMotion(
    "ramp-critical", "A puck on the critical ramp",
    "A puck is thrown straight across at 2 m/s where friction is the slope, μ = tan α: in the end it slides down.",
    "I. E. Irodov, Problems in General Physics, 1.92", (
        closed_form("last speed", "m/s", 1.0, "v/2"),
    ), _ramp_critical,
)  # fmt: skip


def _belt() -> Sequence[float]:
    belt = System(U=("-mu*g*c", "-mu*g*s"), W=("x + V", "y"), parameters={"mu": 0.4, "g": GRAVITY, "V": 1.0})
    run = follow(belt, (-1.0, 2.0, 0.0, 0.0), 2.0)
    end = run.phases[0].t_end
    return end, *run.dense(end)[2:]


_SLIP = math.hypot(1.0, 2.0) / (0.4 * GRAVITY)
BELT = ReferenceMotion(
    "belt", "A box comes onto a conveyor belt",
    "A box comes at 2 m/s, from the side, onto a belt that runs at 1 m/s, friction 0.4: it slips until it goes along.",
    "textbook", (
        closed_form("time until it goes along", "s", _SLIP, "√(V² + v²)/(μ g)"),
        closed_form("way along", "m", 0.5 * _SLIP, "V t/2"),
        closed_form("way across", "m", _SLIP, "v t/2"),
    ), _belt,
)  # fmt: skip

_YIELDS = math.atan(1.0 / math.hypot(math.cos(0.5) / 0.3, math.sin(0.5) / 0.6))


def _tilted() -> Sequence[float]:
    run = follow(tilting_block(), (0.0, 0.0, 0.15), 10.0)
    end = run.phases[0].t_end
    c, s = run.phases[0].e(end)
    return run.dense(end)[2], math.atan2(s, c)


TILTED = ReferenceMotion(
    "tilted", "A block whose friction has directions",
    "A block on an incline that is tilted at 0.02 rad/s, friction 0.3 and 0.6 along two axes, steepest at 0.5 rad.",
    "A. Zmitrowicz, Int. J. Solids Structures 25 (1989) 837-862", (
        closed_form("angle at which it slips", "rad", _YIELDS, "cot α = √((cos φ/μ₁)² + (sin φ/μ₂)²)"),
        closed_form("direction of slip", "rad", math.atan2(math.sin(0.5) / 0.6, math.cos(0.5) / 0.3),
                    "tan θ = (μ₁/μ₂) tan φ"),
    ), _tilted,
)  # fmt: skip


def _controlled() -> Sequence[float]:
    run = follow(unit_vector_control(w1=0.0, h=0.0), (2.5, -1.0, 1.0, 0.5), 6.0)
    end = run.phases[0].t_end
    return end, *run.dense(end)[2:]


_REACHED = 0.5 * math.hypot(2.5, 1.0)
_DECAY = math.exp(-_REACHED)
CONTROLLED = ReferenceMotion(
    "controlled", "A point reaches its sliding mode",
    "Unit-vector control of gain 2 of a point, (x, y) = (2.5, −1), z = (1, 0.5), k = 1, with no disturbance.",
    "S. Gutman, IEEE Trans. Automatic Control 24 (1979) 437-443", (
        closed_form("time to slide", "s", _REACHED, "|(x, y)|/K"),
        closed_form("z₁ there", "m", _DECAY + 2.5 * ((1.0 - _DECAY) / _REACHED - _DECAY),
                    "z E + x ((1 − E)/T − E), E = exp(−T)"),
        closed_form("z₂ there", "m", 0.5 * _DECAY - ((1.0 - _DECAY) / _REACHED - _DECAY),
                    "z E + y ((1 − E)/T − E), E = exp(−T)"),
    ), _controlled,
)  # fmt: skip

SLIDING = (BOX_STOPS, RAMP_DOWN, RAMP_SLIDES, RAMP_ACROSS, RAMP_CRITICAL, BELT, TILTED, CONTROLLED)
