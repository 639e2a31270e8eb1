"""The motion that the puck on the page shows: from a place of the picture until it rests or leaves the view."""

from __future__ import annotations

import json
import math

import numpy as np

from codim2_core.motion.simulate import simulate
from codim2_core.portrait.layer_problem.hemisphere import scaling_from_disc
from codim2_core.scene import Scene
from codim2_core.systems.coefficients import Coefficients
from codim2_core.systems.elinear import ELinear

from ..draw.theme import PICTURE_REACH
from .short import short

#: Of the regularisation: the slip at which a velocity becomes a state of rest.
EPS = 0.01
RTOL = 1e-7
#: Times as long as a slip that is larger by one takes to stop, if nothing pushes.
LASTS = 8.0
#: Of the picture: a motion that stays as near to its last place has come to rest.
RESTS = 0.002
MOST_NUMBERS = 200  # characters of a place


def slip(scene: Scene, start: str) -> bytes:
    """Return, as JSON, times, (x, y), e and places of the picture along the motion of an e-linear system at this z.

    Raises
    ------
    ValueError
        The start is no place of the picture, or the system is not e-linear.
    """
    at = scene.coefficients
    if not isinstance(at, Coefficients):
        raise ValueError("Only the puck of an e-linear system is shown; choose one.")
    try:
        x, y = map(float, start[:MOST_NUMBERS].split(","))
    except ValueError:
        x = y = math.nan
    radius = math.hypot(x, y)
    if not radius <= 2 * PICTURE_REACH:
        raise ValueError(f"Start {start[:60]!r} given; give a place of the picture, such as 1.2,0.5.")
    place = np.array([x, y])
    state = EPS * scaling_from_disc((x, y)) if radius < 1.0 - EPS else place * (max(radius - 1.0, EPS) / radius)
    size = max(np.linalg.norm(at.A, 2), np.linalg.norm(at.f), 1e-6)
    frozen = ELinear(a=at.a, b=at.b, d=at.d, f=tuple(at.f))
    end = float(LASTS * (np.hypot(*state) + 1.0) / size)
    drawn = simulate(frozen, scene.psi, state.tolist(), (0.0, end), eps=EPS, rtol=RTOL).drawn()
    far = np.hypot(*drawn.points.T) > PICTURE_REACH
    moves = np.hypot(*(drawn.points - drawn.points[-1]).T) > RESTS
    last = int(np.argmax(far)) + 1 if far.any() else int(np.flatnonzero(moves).max(initial=0)) + 2
    times, states, points = drawn.times[:last], drawn.states[:last], drawn.points[:last]
    rho = np.hypot(*states.T)
    e = states * (scene.psi.modulus(rho / EPS) / np.maximum(rho, 1e-300))[:, None]
    columns = dict(zip("txycsuv", (times, *states.T, *e.T, *points.T), strict=True))
    return json.dumps({name: short(column) for name, column in columns.items()} | {"eps": EPS}).encode()
