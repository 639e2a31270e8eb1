"""Numbers along a curve: its place on the portrait, and one value for each kind."""

from __future__ import annotations

import math

import numpy as np

from ...results.arrays import Array
from ...results.special_kinds import HOPF, SPECIAL_KINDS
from ...systems.psi.constructors import many
from ..families import conditions
from ..families.family import SystemFamily
from ..families.first_lyapunov import lyapunov
from .tracing import TracedCurve


def places(family: SystemFamily, curve: TracedCurve) -> Array:
    """Points (m, 2) of the projected hemisphere."""
    v = curve.points
    if v.shape[1] == 2:
        return np.full((len(v), 2), math.nan)
    p = np.stack([np.cos(v[:, 0]), np.sin(v[:, 0])], axis=-1) if v.shape[1] == 3 else _places_on_portrait(family, v)
    if family.turns:
        angles = [family.frozen(at[-2:]).turn for at in v]
        c, s = np.cos(angles), np.sin(angles)
        p = np.stack([c * p[:, 0] - s * p[:, 1], s * p[:, 0] + c * p[:, 1]], axis=-1)
    return p


def _places_on_portrait(family: SystemFamily, v: Array) -> Array:
    """Return places (m, 2) of the projected hemisphere from (c, s, u, v); on and beyond the equator (c, s)."""
    e, modulus = v[:, :2], np.hypot(v[:, 0], v[:, 1])
    complement = (1.0 - modulus) * (1.0 + modulus)
    inner = (modulus > 0.0) & (complement > 0.0)
    psi = family.psi
    if any(family.of_psi):
        psi = many(psi, family.values(v[inner, 2:])[:, family.of_psi.index(True)])
    zeta = psi.radius(modulus[inner], complement[inner])
    p = e.copy()
    p[inner] *= (zeta / np.hypot(1.0, zeta) / modulus[inner])[:, None]
    return p


def curve_numbers(family: SystemFamily, curve: TracedCurve) -> Array:
    """One number a point, see `AtlasCurve`."""
    v = curve.points
    if curve.kind in ("saddle-node", "pitchfork"):
        return np.array([conditions.EquatorEquations(family, at).radial for at in v])
    if curve.kind == "transcritical":
        return np.array([conditions.EquatorEquations(family, at).slope for at in v])
    if curve.kind in (
        "fold of critical sets",
        "pitchfork of critical sets",
        *(one.kind for one in SPECIAL_KINDS if one.level),
    ):
        return np.array([math.copysign(1.0, trace(family, at)) for at in v])
    if curve.kind == HOPF.kind:
        return lyapunov(family, v)
    return np.zeros(0)


def trace(family: SystemFamily, at: Array) -> float:
    """Return T at (c, s, u, v)."""
    return conditions.InteriorEquations(family, at).trace(family.ratio(float(at[:2] @ at[:2]), at[2:]).bend)
