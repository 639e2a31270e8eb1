"""The panel "Time": one motion, for the chosen eps and in the nonsmooth limit eps -> 0, phases told apart."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.layer_problem.critical import critical_sets
from codim2_core.layer_problem.equator import equator_equilibria
from codim2_core.motion.nonsmooth import simulate_nonsmooth
from codim2_core.motion.regularised import simulate
from codim2_core.motion.result import Simulation
from codim2_core.orbits.trajectories import continuation
from codim2_core.psi.function import Psi

from ..frame.draft import Draft
from ..state.chosen import System_
from ..state.controls import InputError
from .panel import Panel

SAMPLES = 240  # even times at which a motion is drawn, besides the ends of its steps
MOST = 500  # points of a curve that the browser is sent
PLACES = 24  # of the critical set, along which a slide of the limit is drawn
RTOL = 1e-7
#: Systems whose motion is that of a ball, and where its centre is: the integral of z, or z3 and z4.
BALLS = {"ball_in_pool": "integral", "ball_on_turntable": "position"}


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
    motion = draft.slow("motion", (system, psi, eps, start, t_end), lambda: smooth(system, psi, eps, start, t_end))
    if motion is not None:
        ball = BALLS.get(values["system"])
        draft.header["motion"] = {**motion, "eps": eps, "ball": ball, "start": list(start)}
    limit = draft.slow("limit", (system, psi, start, t_end), lambda: nonsmooth(system, psi, start, t_end))
    if limit is not None:
        draft.header["limit"] = limit


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
    try:
        start = tuple(float(word) for word in text.replace("−", "-").split(","))
    except ValueError:
        start = ()
    if len(start) != 2 + m or not all(map(math.isfinite, start)):
        names = ", ".join(["x", "y", *(f"z{i + 1}" for i in range(m))])
        raise InputError("launch", f"Start: {text[:60]!r} given; give {2 + m} numbers: {names}.")
    return start, t_end


def smooth(system: System_, psi: Psi, eps: float, start: tuple[float, ...], t_end: float) -> dict[str, Any]:
    """Return the regularised motion as the browser draws it."""
    run = simulate(system, psi, eps, start, (0.0, t_end), rtol=RTOL)
    times, states = _sampled(run)
    rho = np.hypot(np.hypot(states[:, 0], states[:, 1]), eps)
    picture = states[:, :2] / rho[:, None] * (1.0 + rho)[:, None]
    return {**_curves(times, states, picture), **_words(run)}


def nonsmooth(system: System_, psi: Psi, start: tuple[float, ...], t_end: float) -> dict[str, Any]:
    """Return the motion in the limit; while it slides, its place in the picture is that of the critical set."""
    run = simulate_nonsmooth(system, start, (0.0, t_end), psi=psi, rtol=RTOL)
    times, states = _sampled(run)
    rho = np.hypot(states[:, 0], states[:, 1])
    on = rho == 0.0
    with np.errstate(invalid="ignore", divide="ignore"):
        picture = np.where(on[:, None], 0.0, states[:, :2] * ((1.0 + rho) / rho)[:, None])
    for phase in run.phases:
        if phase.kind == "slide":
            during = np.flatnonzero(on & (times >= phase.t_start) & (times <= phase.t_end))
            _place_slide(system, psi, states, picture, during)
    for phase in reversed(run.phases):
        if phase.kind != "slip" and phase.t_start > times[0]:
            times, states, picture = _with_jump(system, psi, times, states, picture, phase.t_start)
    return {**_curves(times, states, picture), **_words(run)}


def _with_jump(
    system: System_,
    psi: Psi,
    times: NDArray[np.float64],
    states: NDArray[np.float64],
    picture: NDArray[np.float64],
    t: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Put in the trajectory up the hemisphere that follows an arrival at Sigma, in no time (fig:side_of_sphere)."""
    i = int(np.searchsorted(times, t))
    if not 0 < i < len(times) or not states[i - 1, :2].any():
        return times, states, picture
    theta = math.atan2(states[i - 1, 1], states[i - 1, 0])
    limits = equator_equilibria(system, states[i, 2:]).theta
    if not len(limits):
        return times, states, picture
    theta = float(min(limits, key=lambda limit: abs(math.remainder(limit - theta, math.tau))))
    try:
        path = continuation(system, psi, [theta], states[i, 2:], t_max=60.0, length=4.0).points[0][::3]
    except ValueError:  # nothing arrives along it: the motion only passes near
        return times, states, picture
    jump = len(path)
    return (
        np.insert(times, i, np.full(jump, times[i])),
        np.insert(states, i, np.repeat(states[i : i + 1], jump, axis=0), axis=0),
        np.insert(picture, i, path, axis=0),
    )


def _place_slide(
    system: System_, psi: Psi, states: NDArray[np.float64], picture: NDArray[np.float64], during: NDArray[np.int64]
) -> None:
    """Put the points of a slide onto the critical set that it follows: a few are found, the others interpolated."""
    if not len(during):
        return
    chosen = np.unique(during[np.rint(np.linspace(0, len(during) - 1, PLACES)).astype(int)])
    places: list[NDArray[np.float64]] = []
    for i in chosen:
        sets = critical_sets(system, psi, states[i, 2:])
        stable = [C for C in sets if C.kind.startswith("stable")] or list(sets)
        before = places[-1] if places else None
        if stable:
            places.append(min(stable, key=lambda C: 0.0 if before is None else float(np.hypot(*(C.p - before)))).p)
        else:
            places.append(np.zeros(2) if before is None else before)
    p = np.array(places)
    for axis in range(2):
        picture[during, axis] = np.interp(during, chosen, p[:, axis])


def _sampled(run: Simulation) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return times, even ones and those of the steps, and the states there."""
    if len(run.times) < 2 or run.times[-1] <= run.times[0]:
        return run.times, run.states
    times = np.union1d(np.linspace(run.times[0], run.times[-1], SAMPLES), run.times)
    if len(times) > MOST:
        times = times[np.unique(np.rint(np.linspace(0, len(times) - 1, MOST)).astype(int))]
    return times, run.dense(times)


def _curves(times: NDArray[np.float64], states: NDArray[np.float64], picture: NDArray[np.float64]) -> dict[str, Any]:
    return {
        "t": _short(times),
        "states": [_short(column) for column in states.T],
        "picture": [_short(column) for column in picture.T],
    }


def _words(run: Simulation) -> dict[str, Any]:
    return {
        "phases": [[p.kind, p.t_start, p.t_end, p.reason] for p in run.phases],
        "reason": run.reason,
        "ended": float(run.times[-1]),
    }


def _short(values: NDArray[np.float64]) -> list[float]:
    return [float(f"{v:.5g}") for v in values]


PANEL = Panel("time", "Time", add, "One motion in time, for ε > 0 and in the limit ε → 0.")
