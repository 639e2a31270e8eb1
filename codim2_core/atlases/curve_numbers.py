"""Numbers along a curve: its place on the portrait, and one value for each kind."""

from __future__ import annotations

import math

import numpy as np

from ..arrays import Array
from ..families import conditions
from ..families.family import SystemFamily
from ..families.first_lyapunov import lyapunov
from .tracing import TracedCurve


def places(family: SystemFamily, curve: TracedCurve) -> Array:
    """Points (m, 2) of the projected hemisphere."""
    v = curve.points
    if v.shape[1] == 2:
        return np.full((len(v), 2), math.nan)
    if v.shape[1] == 3:
        p = np.stack([np.cos(v[:, 0]), np.sin(v[:, 0])], axis=-1)
    else:
        p = np.array([_place_on_portrait(family, at) for at in v])
    if family.turns:
        angles = [family.frozen(at[-2:]).turn for at in v]
        c, s = np.cos(angles), np.sin(angles)
        p = np.stack([c * p[:, 0] - s * p[:, 1], s * p[:, 0] + c * p[:, 1]], axis=-1)
    return p


def _place_on_portrait(family: SystemFamily, at: Array) -> Array:
    e, modulus = at[:2], math.hypot(*at[:2])
    complement = (1.0 - modulus) * (1.0 + modulus)
    if modulus == 0.0 or complement <= 0.0:
        return e
    zeta = float(family.psi_at(at[2:]).radius(min(modulus, 1.0), complement))
    return e * (zeta / math.hypot(1.0, zeta) / modulus)


def curve_numbers(family: SystemFamily, curve: TracedCurve) -> Array:
    """One number a point, see `AtlasCurve`."""
    v = curve.points
    if curve.kind in ("saddle-node", "pitchfork"):
        return np.array([conditions.EquatorEquations(family, at).radial for at in v])
    if curve.kind == "transcritical":
        return np.array([conditions.EquatorEquations(family, at).slope for at in v])
    if curve.kind in ("fold of critical sets", "pitchfork of critical sets", "node-focus"):
        return np.array([math.copysign(1.0, trace(family, at)) for at in v])
    if curve.kind == "Hopf":
        return lyapunov(family, v)
    return np.zeros(0)


def trace(family: SystemFamily, at: Array) -> float:
    """Return T at (c, s, u, v)."""
    return conditions.InteriorEquations(family, at).trace(family.ratio(float(at[:2] @ at[:2]), at[2:]).bend)
