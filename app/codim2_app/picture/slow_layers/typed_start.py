"""The typed start of the panel "Motion": the motion from (x, y, z1, ...) in the limit eps -> 0, and for eps > 0."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from codim2_core.motion.compare_with_limit import agreement
from codim2_core.motion.result import Simulation
from codim2_core.motion.rolling import rolling
from codim2_core.motion.simulate import LARGEST_EPS, SMALLEST_EPS, simulate, simulate_nonsmooth
from codim2_core.portrait.orbits.in_time import LEAST_RADIUS, angle_along
from codim2_core.systems.examples import Ball, catalogue
from codim2_core.systems.psi.function import Psi

from ..frame.frame_context import FrameContext
from ..state.chosen_system import System_, slow_symbols
from ..state.cleaning import InputError
from ..state.launches import TYPED
from ..state.system_opening_values import opening_launch
from .short import short

RTOL = 1e-7
EPS = round(math.log10(SMALLEST_EPS)), round(math.log10(LARGEST_EPS))


def add(draft: FrameContext) -> None:
    """Add the motion in the limit and, if it is wanted, the one for eps > 0, once nothing moves."""
    values, system = draft.values, draft.system
    if system is None:
        return
    try:
        start, t_end = launch_of(values, system)
    except InputError as error:
        draft.now.pop("orbit", None)  # the browser forgets what it has
        draft.unable("orbit", str(error))
        return
    eps = 10.0 ** values["log_eps"] if values["orbit_eps"] == "show" else 0.0
    example = catalogue.get(values["system"])
    asked = (system, draft.scene.psi, eps, start, t_end, None if example is None else example.ball)
    found = draft.slow("orbit", (TYPED, *asked), motion_from_start, *asked)
    if found is not None:
        draft.header.update(found)
        draft.now["orbit_motion"] = TYPED  # what was there of a launched orbit is gone


def launch_of(values: Mapping[str, Any], system: System_) -> tuple[tuple[float, ...], float]:
    """Return the state from which the motion starts, and the time for which it is followed.

    Raises
    ------
    InputError
        The text of the state does not hold 2 + m numbers, the time is not positive, or no motion takes this eps.
    """
    text, t_end, m = values["launch"], values["t_end"], system.m
    if t_end <= 0.0:
        raise InputError("t_end", f"until t: {t_end:g} given; give a positive time.")
    low, high = EPS
    if not low <= values["log_eps"] <= high:
        given = values["log_eps"]
        raise InputError("log_eps", f"log₁₀ ε: {given:g} given; give a number from {low} to {high}.")
    try:
        start = tuple(float(word) for word in text.replace("−", "-").split(","))
    except ValueError:
        start = ()
    if text == opening_launch(values["system"]):  # not the user's: as many numbers of it as the system has
        start = (*start, *(0.0,) * m)[: 2 + m]
    if len(start) != 2 + m or not all(map(math.isfinite, start)):
        names = ", ".join(["x", "y", *slow_symbols(values["system"], system)])
        raise InputError("launch", f"Start: {text[:60]!r} given; give {2 + m} numbers: {names}.")
    return start, t_end


def motion_from_start(
    system: System_, psi: Psi, eps: float, start: tuple[float, ...], t_end: float, ball: Ball | None = None
) -> dict[str, Any]:
    """Return the motion in the limit as the browser draws it and how a ball rolls; with eps also the one for eps > 0.

    Then also how the two agree, and the ball is that of eps > 0.
    """
    limit = simulate_nonsmooth(system, start, (0.0, t_end), psi=psi, rtol=RTOL)
    parameters = dict(system.parameters)
    orbit = {
        "index": TYPED,
        "m": system.m,
        "fast": False,
        "start": list(start),
        **curves(limit),
        "delays": _delays(limit),
    }
    if not eps:
        return {"orbit": {**orbit, "ball": _rolling(ball, limit, parameters)}}
    run = simulate(system, psi, start, (0.0, t_end), eps=eps, rtol=RTOL)
    together = agreement(system, psi, run, limit)
    comparison = {"agreement": together.sentence, "same": together.same, "ball": _rolling(ball, run, parameters)}
    return {"orbit": orbit, "orbit_motion": {"index": TYPED, "eps": eps, **curves(run), **comparison}}


def curves(run: Simulation) -> dict[str, Any]:
    """Return a motion over time: x, y, its angle and radius in the picture, the slow variables; and its phases."""
    drawn = run.drawn()
    angle, radius = angle_along(drawn.points, LEAST_RADIUS), np.hypot(*drawn.points.T)
    x, y, *z = drawn.states.T
    return {
        "t": short(drawn.times),
        "states": [short(column) for column in (x, y, angle, radius, *z)],
        "picture": [short(column) for column in drawn.points.T],
        "phases": [["delay" if p.delay else p.kind, p.t_start, p.t_end, p.reason] for p in run.phases],
        "reason": run.reason,
    }


def _delays(limit: Simulation) -> list[list[Any]]:
    """Return when, and at which z, sets lose their stability to which the motion stays, and where it leaves them."""
    found = [phase.delay for phase in limit.phases if phase.delay is not None]
    return [
        [one.t_hopf, one.t_out, short(one.z_hopf), None if one.z_out is None else short(one.z_out)] for one in found
    ]


def _rolling(ball: Ball | None, run: Simulation, parameters: Mapping[str, float]) -> dict[str, Any] | None:
    """Return where a ball is and how it is turned, at the times of its curves; None where there is no ball."""
    if ball is None:
        return None
    drawn = run.drawn()
    rate = 0.0 if ball.turning is None else float(parameters[ball.turning])
    found = rolling(ball, drawn.times, drawn.states, rate)
    return {
        "centre": [short(column) for column in found.centre.T],
        "turns": [[round(float(v), 4) for v in turn] for turn in found.turns],
        "radius": found.radius,
    }
