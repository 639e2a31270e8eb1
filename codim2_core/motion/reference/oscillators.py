"""Masses on springs with dry friction: they decay, are driven round, to and fro, or stick and slip.

A mass that is driven round by F e^{i w t} keeps its place in the frame that turns with the force, q = R e^{i(wt + p)}.
Next to it, ``q = R (1 + a + i b)`` there obeys

    a'' - 2 w b' + (1 - w^2) a = (S/R) (b - a'/w),    b'' + 2 w a' + (1 - w^2) b = 0,

whose characteristic polynomial gives all four Floquet multipliers exp(2 pi l/w):

    l^4 + (S/(R w)) l^3 + 2 (1 + w^2) l^2 + (S/(R w)) (1 + w^2) l + (1 - w^2)^2 = 0
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import partial

import numpy as np

from ...systems.psi.constructors import constant
from ...systems.typed import System
from ..periodic.search import periodic_motion
from .record import ATOL, RTOL, ExactValue, ReferenceMotion, closed_form
from .sliding import follow


def _decays() -> Sequence[float]:
    mass = System(U=("-z1 - S*c", "-z2 - S*s"), W=("x", "y"), parameters={"S": 0.3})
    run = follow(mass, (0.0, 0.0, 2.5, 0.0), 20.0)
    return run.phases[-1].t_start, run.states[-1, 2]


DECAYS = ReferenceMotion(
    "decays", "An oscillator comes to rest",
    "q̈ + q = −0.3 q̇/|q̇| from rest at q = 2.5: each half swing is 0.6 shorter, until it sticks.", "textbook", (
        closed_form("time to rest", "1", 4.0 * math.pi, "n π, n = 4 half swings"),
        closed_form("where it rests", "1", 0.1, "q − 2 n S"),
    ), _decays,
)  # fmt: skip

_F, _S, _W = 1.0, 0.5, 2.0
_R = math.sqrt(_F**2 - _S**2) / abs(1.0 - _W**2)


def round_multipliers(S: float, w: float, R: float) -> list[complex]:
    """Return the Floquet multipliers of a mass that is driven round, largest first."""
    s = S / (R * w)
    roots = np.roots([1.0, s, 2.0 * (1.0 + w * w), s * (1.0 + w * w), (1.0 - w * w) ** 2])
    found = [cmath.exp(2.0 * math.pi * complex(one) / w) for one in roots]
    return sorted(found, key=lambda one: (-abs(one), -one.imag))


def _driven_round() -> Sequence[float]:
    mass = System(
        U=("-z1 - S*c + F*cos(w*z3)", "-z2 - S*s + F*sin(w*z3)"), W=("x", "y", "1"),
        parameters={"F": _F, "S": _S, "w": _W},
    )  # fmt: skip
    found = periodic_motion(mass, None, (0.0, -0.5, -0.3, 0.05, 0.0), 2.0 * math.pi / _W, rtol=RTOL, atol=ATOL)
    first, _, third, _ = sorted(found.multipliers.tolist(), key=lambda one: (-abs(one), -one.imag))
    return math.hypot(*found.state0[2:4]), first.real, first.imag, third.real, third.imag


_FIRST, _, _THIRD, _ = round_multipliers(_S, _W, _R)
_POLYNOMIAL = "exp(2πλ/ω), λ⁴ + sλ³ + 2(1+ω²)λ² + s(1+ω²)λ + (1−ω²)² = 0, s = S/(Rω)"
DRIVEN_ROUND = ReferenceMotion(
    "circular-forcing", "A mass is driven round",
    "q̈ + q = F exp(iωt) − S q̇/|q̇| in the plane, F = 1, S = 0.5, ω = 2: it goes round on a circle, and never sticks.",
    "derived in `reference.oscillators`", (
        closed_form("radius", "1", _R, "√(F² − S²)/|1 − ω²|"),
        closed_form("first multiplier, real part", "1", _FIRST.real, _POLYNOMIAL),
        closed_form("first multiplier, imaginary part", "1", _FIRST.imag, _POLYNOMIAL),
        closed_form("third multiplier, real part", "1", _THIRD.real, _POLYNOMIAL),
        closed_form("third multiplier, imaginary part", "1", _THIRD.imag, _POLYNOMIAL),
    ), _driven_round,
)  # fmt: skip

DEN_HARTOG = (("den-hartog", 1.5, 0.3), ("den-hartog-below", 0.8, 0.5), ("den-hartog-fast", 2.5, 0.4))


def _amplitude(w: float, S: float) -> float:
    shift = S * math.sin(math.pi / w) / (w * (1.0 + math.cos(math.pi / w)))
    return math.sqrt(1.0 / (1.0 - w * w) ** 2 - shift * shift)


def _to_and_fro(w: float, S: float) -> Sequence[float]:
    mass = System(U=("-z1 - S*c + cos(w*z2)", "-s"), W=("x", "1"), parameters={"S": S, "w": w})
    start = (0.0, 0.0, _amplitude(w, S) * 0.99, 0.3)
    run = periodic_motion(mass, None, start, 2.0 * math.pi / w, rtol=RTOL, atol=ATOL).run
    turns = [phase.t_start for phase in run.phases if phase.kind == "cross"]
    return (max(abs(float(run.dense(t)[2])) for t in turns) if turns else math.nan,)


def _den_hartog(key: str, w: float, S: float) -> ReferenceMotion:
    return ReferenceMotion(
        key, f"Den Hartog's oscillator, ω = {w:g}",
        f"q̈ + q = cos ωt − S q̇/|q̇| in a line, ω = {w:g}, S = {S:g}: to and fro without a stop.",
        "J. P. Den Hartog, Trans. ASME 53 (1931) 107-115",
        (closed_form("amplitude", "1", _amplitude(w, S), "√(1/(1 − ω²)² − (S sin(π/ω)/(ω (1 + cos(π/ω))))²)"),),
        partial(_to_and_fro, w, S),
    )  # fmt: skip


_STICK_SLIP = "explicit Runge–Kutta of order 8 to 1e-13, the stick in closed form"


def _stick_slip_system() -> System:
    return System(U=("-z1 - c/(1 + delta*abs(x))", "-s"), W=("x + v",), parameters={"delta": 3.0, "v": 0.2})


def _stick_slip() -> Sequence[float]:
    run = follow(_stick_slip_system(), (0.0, 0.0, 0.0), 30.0)
    slip, stick = (phase for phase in run.phases[1:3])
    return slip.t_end - slip.t_start, stick.t_end - stick.t_start, stick.t_end - slip.t_start


LEINE = ReferenceMotion(
    "leine-block", "A block on a belt sticks and slips",
    "Leine's block, m = k = F_s = 1, friction F_s/(1 + 3 |v_rel|), on a belt of speed 0.2: a cycle with a stick.",
    "R. I. Leine, D. H. van Campen, A. de Kraker, L. van den Steen, Nonlinear Dynamics 16 (1998) 41-54: the model", (
        ExactValue("time of slip", "1", 4.29599952548, 2e-12, _STICK_SLIP),
        ExactValue("time of stick", "1", 7.70503176935, 3e-12, _STICK_SLIP),
        ExactValue("period", "1", 12.00103129483, 3e-12, _STICK_SLIP),
    ), _stick_slip,
)  # fmt: skip


_BELT, _KINETIC, _STATIC = 0.3, 0.5, 0.75


def _static_above_kinetic() -> Sequence[float]:
    block = System(U=("-z1 - S*c", "-s"), W=("x + v",), parameters={"S": _KINETIC, "v": _BELT})
    run = follow(block, (0.0, 0.0, 0.0), 12.0, stiction=_STATIC / _KINETIC)
    slip, stick = run.phases[1:3]
    return slip.t_end - slip.t_start, stick.t_end - stick.t_start, float(run.dense(stick.t_start)[2])


STATIC_ABOVE_KINETIC = ReferenceMotion(
    "static-kinetic", "A block on a belt, static friction above kinetic",
    "Mass and spring 1 on a belt of speed 0.3, kinetic friction 0.5, static friction 0.75: it sticks and slips.",
    "textbook; the slip is half a swing about q = 0.5, and more", (
        closed_form("time of slip", "1", 2.0 * (math.pi - math.atan((_STATIC - _KINETIC) / _BELT)),
                    "2 (π − arctan((F_s − F_k)/v))"),
        closed_form("time of stick", "1", 2.0 * (_STATIC - _KINETIC) / _BELT, "2 (F_s − F_k)/v"),
        closed_form("spring where it sticks", "1", 2.0 * _KINETIC - _STATIC, "2 F_k − F_s"),
    ), _static_above_kinetic,
)  # fmt: skip


def _regularised_stick_slip() -> Sequence[float]:
    system, start = _stick_slip_system(), (0.05, 0.0, 1.0)
    return [
        periodic_motion(system, constant(), start, 11.5, eps=eps, rtol=RTOL, atol=ATOL).period for eps in (1e-3, 1e-2)
    ]


_RUNGE_KUTTA = "explicit Runge–Kutta of order 8 to 3e-14"
REGULARISED = ReferenceMotion(
    "leine-block-regularised", "The same block, regularised",
    "Leine's block with Ψ = 1: v_rel/√(v_rel² + ε²) for its sign, which shortens the period by 2 % at ε = 0.001.",
    "computed here", (
        ExactValue("period for ε = 0.001", "1", 11.77007956586, 1e-11, _RUNGE_KUTTA),
        ExactValue("period for ε = 0.01", "1", 10.85586718473, 1e-11, _RUNGE_KUTTA),
    ), _regularised_stick_slip,
)  # fmt: skip

OSCILLATING = (
    DECAYS,
    DRIVEN_ROUND,
    *(_den_hartog(*one) for one in DEN_HARTOG),
    LEINE,
    STATIC_ABOVE_KINETIC,
    REGULARISED,
)
