"""The trajectories of a picture: where they start, how far they are followed, and how accurately."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from ..portrait.layer_problem.problem import LayerProblem, found_once
from ..portrait.omega_limits import radially_neutral_ones
from ..portrait.orbits.both_directions import Orbits
from ..portrait.orbits.duration import drawn_duration, is_stiff
from ..portrait.orbits.seeds import ring, structured_seeds, window_seeds
from ..portrait.orbits.trajectories import Trajectories, continuation, trajectories
from ..systems.psi import constructors
from .setting import SceneSetting

SEED_RADIUS = 0.05  # radius of the seeds around an unstable critical set
MAX_HALF_STEPS = 780  # of half a drawn orbit: one that goes round a weak focus for longer is not waited for
CAPTURE = 0.25  # of a pixel: where a drawn trajectory ends, so near its equilibrium that nobody can see the rest


def seeds_of(setting: SceneSetting, outside: bool) -> np.ndarray:
    """Seeds on the hemisphere, or outside: those that are given, or the usual ones and more in the window."""
    if setting.seeds is not None:
        return _sides(setting.seeds)[outside]
    seeds = _structured_seeds(setting.count, setting.view)[outside]
    if setting.window is None:
        return seeds
    return np.concatenate([seeds, _sides(window_seeds(setting.count // 2, setting.window))[outside]])


def _sides(seeds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the seeds on the hemisphere, and those outside or on the equator."""
    outside = np.hypot(seeds[:, 0], seeds[:, 1]) >= 1.0
    return seeds[~outside], seeds[outside]


@lru_cache(maxsize=32)
def _structured_seeds(count: int, view: float) -> tuple[np.ndarray, np.ndarray]:
    return _sides(structured_seeds(count, view))


@found_once()
def _pace(problem: LayerProblem) -> tuple[float, bool]:
    """Return for how long orbits are followed, and whether they creep, on the hemisphere."""
    return drawn_duration(problem.at, problem.equator, problem.critical), is_stiff(problem.equator, problem.critical)


@found_once(of_psi=False)
def _pace_outside(problem: LayerProblem) -> tuple[float, bool]:
    """Return the same outside, where critical sets have no say."""
    return drawn_duration(problem.at, problem.equator), is_stiff(problem.equator)


def _stepping_options(setting: SceneSetting, outside: bool = False) -> dict[str, Any]:
    duration, stiff = (_pace_outside if outside else _pace)(setting.problem)
    return {
        "t_max": duration if setting.t_max is None else setting.t_max,
        "length": setting.length,
        "rtol": setting.rtol,
        "atol": setting.atol,
        "view": setting.view,
        "pixel": setting.pixel,
        "capture": CAPTURE * setting.pixel,
        "step_limit": MAX_HALF_STEPS,
        "stiff": stiff,
    }


def orbit_starts(setting: SceneSetting, outside: bool) -> np.ndarray:
    """Return the starting points of drawn orbits: the seeds, and points around what they would not leave."""
    seeds = seeds_of(setting, outside)
    if outside or setting.seeds is not None or not setting.count:
        return seeds
    # What leaves an unstable critical set (to a limit cycle, in Case III) starts nearer to it than any fixed seed.
    unstable = [C for C in setting.problem.critical if C.kind.startswith(("unstable", "centre"))]
    rings = [C.p + ring(SEED_RADIUS, 6) for C in unstable]
    return np.concatenate([seeds, *(r for r in rings if np.hypot(r[:, 0], r[:, 1]).max() < 1.0)])


def orbits(setting: SceneSetting, outside: bool) -> Orbits:
    """Whole orbits through the seeds, on the hemisphere or outside."""
    seeds, options = orbit_starts(setting, outside), _stepping_options(setting, outside)
    # Outside, e is the direction itself: Psi has no say, and Psi = 1 is cheapest.
    psi = constructors.constant() if outside else setting.psi
    backward, forward = [
        trajectories(setting.coefficients, psi, seeds, backward=back, **options) for back in (True, False)
    ]
    return Orbits(backward, forward)


def continuations(setting: SceneSetting) -> Trajectories:
    """Integrate up the hemisphere from each limit direction along which an open set of trajectories arrives."""
    equator = setting.problem.equator
    decided = ~np.array(radially_neutral_ones(equator), bool)  # where it is not, what rises does so for ever
    arriving = equator.theta[decided & (equator.lambda_rho < 0.0) & (equator.lambda_theta < 0.0)]
    return continuation(setting.coefficients, setting.psi, arriving, **_stepping_options(setting))
