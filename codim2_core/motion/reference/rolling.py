"""Balls that slip until they roll: on cloth, on a turntable, in a fluid."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from ...numerics.sign_changes import root_between
from ...portrait.layer_problem.equator import equator_equilibria
from ...systems.examples.bodies import ball_on_turntable, spinning_annulus, spinning_disc
from ...systems.examples.example import GRAVITY
from ...systems.examples.paper import ball_in_pool
from ...systems.typed import System
from .record import ExactValue, ReferenceMotion, closed_form
from .sliding import follow

MU = 0.2
CUE = "a ball of moment of inertia 2/5 m R²; G.-G. Coriolis, Théorie mathématique des effets du jeu de billard (1835)"


def _billiard_ball() -> System:
    """(x, y) is the velocity at the contact, z = (v1, v2, r1, r2) velocity and place of the centre."""
    return System(
        U=("-7/2*mu*g*c", "-7/2*mu*g*s"), W=("-mu*g*c", "-mu*g*s", "z1", "z2"), parameters={"mu": MU, "g": GRAVITY}
    )


def _struck() -> Sequence[float]:
    run = follow(_billiard_ball(), (2.0, 0.0, 2.0, 0.0, 0.0, 0.0), 2.0)
    end = run.phases[0].t_end
    return end, run.states[-1, 2], run.dense(end)[4]


STRUCK = ReferenceMotion(
    "billiard-straight", "A billiard ball is struck",
    "A billiard ball is struck through its middle at 2 m/s, friction 0.2: it slips, then rolls.", CUE, (
        closed_form("time until it rolls", "s", 4.0 / (7.0 * MU * GRAVITY), "2 v/(7 μ g)"),
        closed_form("speed at which it rolls", "m/s", 10.0 / 7.0, "5 v/7"),
        closed_form("way until it rolls", "m", 48.0 / (49.0 * MU * GRAVITY), "12 v²/(49 μ g)"),
    ), _struck,
)  # fmt: skip

_SLIP = np.array([2.3, 1.5])
_TIME = 2.0 * math.hypot(*_SLIP) / (7.0 * MU * GRAVITY)
_ROLLS = np.array([2.0, 0.0]) - 2.0 / 7.0 * _SLIP
_PLACE = np.array([2.0, 0.0]) * _TIME - 0.5 * MU * GRAVITY * _TIME**2 * _SLIP / math.hypot(*_SLIP)


def _masse() -> Sequence[float]:
    run = follow(_billiard_ball(), (*_SLIP.tolist(), 2.0, 0.0, 0.0, 0.0), 2.0)
    end = run.phases[0].t_end
    return end, *run.states[-1, 2:4], *run.dense(end)[4:]


MASSE = ReferenceMotion(
    "billiard-masse", "A billiard ball with spin",
    "A billiard ball starts at (2, 0) m/s with such a spin that its contact slips at (2.3, 1.5) m/s, friction 0.2: its "
    "way is a parabola, then straight.", CUE, (
        closed_form("time until it rolls", "s", _TIME, "2 |w|/(7 μ g)"),
        closed_form("v₁ at which it rolls", "m/s", float(_ROLLS[0]), "v − 2 w/7"),
        closed_form("v₂ at which it rolls", "m/s", float(_ROLLS[1]), "v − 2 w/7"),
        closed_form("r₁ where it rolls", "m", float(_PLACE[0]), "v t − μ g t² w/(2 |w|)"),
        closed_form("r₂ where it rolls", "m", float(_PLACE[1]), "v t − μ g t² w/(2 |w|)"),
    ), _masse,
)  # fmt: skip


def _circled() -> Sequence[float]:
    run = follow(ball_on_turntable(), (0.0, 0.0, 1.0, 0.0, 0.5, 0.0), 7.0 * math.pi / 3.0)
    half = run.dense(3.5 * math.pi / 3.0)
    return 0.5 * math.dist(half[4:], run.states[0, 4:]), math.dist(run.states[-1, 4:], run.states[0, 4:])


TURNTABLE = ReferenceMotion(
    "turntable", "A ball rolls on a turntable",
    "A ball rolls at 1 m/s on a table that turns at 3 rad/s, friction 0.2: on a circle, in 7/2 turns of the table.",
    "K. Weltner, Am. J. Physics 47 (1979) 984-986", (
        closed_form("radius of its circle", "m", 7.0 / 6.0, "7 v/(2 Ω)"),
        closed_form("how far it is from its start after 7π/Ω", "m", 0.0, "0"),
    ), _circled,
)  # fmt: skip

_DRAG = MU * GRAVITY  # z of the balance of friction and drag: mu m g/K


def _slipping(t: float) -> float:
    """Speed of the centre, for (x, y) = z = (9, 0) at the start, m = K = 1."""
    return (9.0 + _DRAG) * math.exp(-t) - _DRAG


_STICKS = root_between(lambda t: _slipping(t) - 2.5 * MU * GRAVITY * t, 0.0, 2.0)


def _pool() -> Sequence[float]:
    run = follow(ball_in_pool(), (9.0, 0.0, 9.0, 0.0), 3.0)
    end = run.phases[0].t_end
    return end, run.dense(end)[2], run.states[-1, 2]


POOL = ReferenceMotion(
    "pool", "A ball at the bottom of a pool",
    "The paper's ball, m = K = 1, friction 0.2, starts at 9 m/s without turning: it slips, then rolls and slows down.",
    "N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, Section 5.1", (
        closed_form("time until it rolls", "s", _STICKS, "(z₀ + μmg/K) exp(−Kt/m) − μmg/K = 5/2 μ g t"),
        closed_form("speed at which it rolls", "m/s", _slipping(_STICKS), "(z₀ + μmg/K) exp(−Kt/m) − μmg/K"),
        closed_form("speed after 3 s", "m/s", _slipping(_STICKS) * math.exp(-5.0 / 7.0 * (3.0 - _STICKS)),
                    "z exp(−5K t/(7m))"),
    ), _pool,
)  # fmt: skip

ROLLING = (STRUCK, MASSE, TURNTABLE, POOL)


FARKAS = "Z. Farkas, G. Bartels, T. Unger, D. E. Wolf, Phys. Rev. Lett. 90 (2003) 248302"
WEIDMAN = "P. D. Weidman, C. P. Malhotra, Phys. Rev. Lett. 95 (2005) 264303"


def _terminal_ratios(make: Callable[[float], System], given: Sequence[float]) -> Sequence[float]:
    """Return v/(R omega) of the limit direction along which both stop, for each argument."""
    found = []
    for one in given:
        theta = equator_equilibria(make(one)).theta
        found.append(1.0 / math.tan(theta[(theta > 0.01) & (theta < 0.5 * math.pi - 0.01)][0]))
    return found


def _known_ratio(name: str, value: float) -> ExactValue:
    return ExactValue(name, "1", value, 2e-12, "one-dimensional quadrature about the centre of rotation")


DISC = ReferenceMotion(
    "spinning-disc", "A disc stops sliding and spinning at once",
    "A uniform disc slides and spins on a table: whatever its start, v/(Rω) tends to one number as it stops.", FARKAS,
    (_known_ratio("v/(Rω)", 0.6530017892056),), partial(_terminal_ratios, spinning_disc, (math.sqrt(0.5),)),
)  # fmt: skip
GYRATION = ReferenceMotion(
    "gyration", "Discs that are not uniform",
    "Discs of other radii of gyration k R under uniform pressure: between k = 1/2 and √(2/3) both stop at once.",
    WEIDMAN, (
        _known_ratio("v/(Rω) for k = 0.6", 0.9354650672281), _known_ratio("v/(Rω) for k = 0.75", 0.5090734155928),
    ),
    partial(_terminal_ratios, spinning_disc, (0.6, 0.75)),
)  # fmt: skip
WASHER = ReferenceMotion(
    "washer", "Washers",
    "Uniform annuli of inner radius ηR: the thinner, the nearer v/(Rω) is to 1, as for a ring.", WEIDMAN, (
        _known_ratio("v/(Rω) for η = 0.3", 0.7044077196133), _known_ratio("v/(Rω) for η = 0.5", 0.7744688699130),
        _known_ratio("v/(Rω) for η = 0.8", 0.9034348892635),
    ), partial(_terminal_ratios, spinning_annulus, (0.3, 0.5, 0.8)),
)  # fmt: skip

SPINNING = (DISC, GYRATION, WASHER)
