"""The critical set in a visitor's hand: which push f brings it there."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear

#: The request's name for it, and how far from the centre it can be held: as far as the picture goes.
GRAB, MAX_GRAB_RADIUS = "grab", 2.5
PUSH = ("f1", "f2")  # what it moves
F_DIGITS, MAX_F_DIGITS = 4, 12  # of f: finer than a pixel; where 1 - |e|^2 is small, as many more as that has zeros


def push_for(scene: Scene, values: Mapping[str, Any], place: Any) -> dict[str, float]:
    """Return f for which C, or where it has left to, is at a place of the picture: f = -A e - z k.

    Parameters
    ----------
    scene : Scene
        Of an e-linear system that the controls give; of another nothing is moved.
    values : mapping
    place : (x, y)
        Of the projected disc, where |e| is `Psi.modulus` of x2; or outside it, where e is the place itself.

    Returns
    -------
    dict
        "f1" and "f2"; empty where there is nothing to hold.
    """
    held = place if isinstance(place, list | tuple) and len(place) == 2 else ()
    if not held or not all(isinstance(v, int | float) and math.isfinite(v) for v in held):
        return {}
    if values["system"] != "normal" or not isinstance(scene.system, ELinear):
        return {}
    r = math.hypot(*held)
    if r > MAX_GRAB_RADIUS:
        held, r = tuple(v * MAX_GRAB_RADIUS / r for v in held), MAX_GRAB_RADIUS
    stretch, digits = 1.0, F_DIGITS
    if 0.0 < r < 1.0:
        zeta = r / math.sqrt((1.0 - r) * (1.0 + r))
        stretch = float(scene.psi.modulus(zeta)) / r
        digits = min(MAX_F_DIGITS, F_DIGITS - math.floor(math.log10(max(float(scene.psi.complement(zeta)), 1e-300))))
    c, s = (stretch * v for v in held)
    a, b, d = values["a"], values["b"], values["d"]
    f1, f2 = b * s - a * c - values["z"] * values["k1"], -b * c - d * s - values["z"] * values["k2"]
    return {name: round(f, digits) + 0.0 for name, f in zip(PUSH, (f1, f2), strict=True)}
