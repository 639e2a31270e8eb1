"""The panel "Time": one motion, for the chosen eps and in the nonsmooth limit eps -> 0, phases told apart."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from codim2_core.examples import Ball, catalogue
from codim2_core.motion.agreement import agreement
from codim2_core.motion.nonsmooth import simulate_nonsmooth
from codim2_core.motion.regularised import LARGEST_EPS, SMALLEST_EPS, simulate
from codim2_core.motion.result import Simulation
from codim2_core.motion.rolling import rolling
from codim2_core.psi.function import Psi

from ..frame.draft import Draft
from ..state.chosen import System_, slow_symbols
from ..state.controls import InputError, opening_launch
from .panel import Panel
from .short import short

RTOL = 1e-7
EPS = round(math.log10(SMALLEST_EPS)), round(math.log10(LARGEST_EPS))


def add(draft: Draft) -> None:
    """Add the motion for eps and that of the limit, once nothing moves."""
    scene, values = draft.scene, draft.values
    system, psi = draft.system, scene.psi
    if system is None:
        return
    try:
        start, t_end = launch_of(values, system.m)
    except InputError as error:
        draft.header.setdefault("unable", {})["motion"] = str(error)
        return
    eps = 10.0 ** values["log_eps"]
    example = catalogue.get(values["system"])
    asked = (system, psi, eps, start, t_end, None if example is None else example.ball)
    found = draft.slow("motion", asked, both, *asked)
    if found is not None:
        draft.header["motion"] = {**found["motion"], "eps": eps, "start": list(start)}
        draft.header["limit"] = found["limit"]


def launch_of(values: Mapping[str, Any], m: int) -> tuple[tuple[float, ...], float]:
    """Return the state from which the motion starts, and the time for which it is followed.

    Raises
    ------
    InputError
        The text of the state does not hold 2 + m numbers, or the time is not positive.
    """
    text, t_end = values["launch"], values["t_end"]
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
        names = ", ".join(["x", "y", *slow_symbols(values["system"], m)])
        raise InputError("launch", f"Start: {text[:60]!r} given; give {2 + m} numbers: {names}.")
    return start, t_end


def both(
    system: System_, psi: Psi, eps: float, start: tuple[float, ...], t_end: float, ball: Ball | None = None
) -> dict[str, Any]:
    """Return the regularised motion and the limit as the browser draws them, how they agree, and how a ball rolls."""
    run = simulate(system, psi, eps, start, (0.0, t_end), rtol=RTOL)
    limit = simulate_nonsmooth(system, start, (0.0, t_end), psi=psi, rtol=RTOL)
    together = agreement(system, psi, run, limit)
    return {
        "motion": {
            **_curves(run),
            "agreement": together.sentence,
            "same": together.same,
            "ball": None if ball is None else _rolling(ball, run, dict(system.parameters)),
        },
        "limit": _curves(limit),
    }


def _curves(run: Simulation) -> dict[str, Any]:
    drawn = run.drawn()
    return {
        "t": short(drawn.times),
        "states": [short(column) for column in drawn.states.T],
        "picture": [short(column) for column in drawn.points.T],
        "phases": [[p.kind, p.t_start, p.t_end, p.reason, p.onto] for p in run.phases],
        "reason": run.reason,
        "ended": float(run.times[-1]),
    }


def _rolling(ball: Ball, run: Simulation, parameters: Mapping[str, float]) -> dict[str, Any]:
    """Return where a ball is and how it is turned, at the times of its curves."""
    drawn = run.drawn()
    rate = 0.0 if ball.turning is None else float(parameters[ball.turning])
    found = rolling(ball, drawn.times, drawn.states, rate)
    return {
        "centre": [short(column) for column in found.centre.T],
        "turns": [[round(float(v), 4) for v in turn] for turn in found.turns],
        "radius": found.radius,
    }


PANEL = Panel("time", "Time", add, "One motion in time, for ε > 0 and in the limit ε → 0.")
