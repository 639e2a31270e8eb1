"""Numbers along a curve: its place on the portrait, and one value for each kind."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from ..arrays import Array
from ..layer_problem.lyapunov import first_lyapunov
from . import conditions
from .family import AXES, PlaneFamily
from .tracing import TracedCurve


def places(family: PlaneFamily, curve: TracedCurve) -> Array:
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


def _place_on_portrait(family: PlaneFamily, at: Array) -> Array:
    e, modulus = at[:2], math.hypot(*at[:2])
    complement = (1.0 - modulus) * (1.0 + modulus)
    if modulus == 0.0 or complement <= 0.0:
        return e
    zeta = float(family.psi_at(at[2:]).radius(min(modulus, 1.0), complement))
    return e * (zeta / math.hypot(1.0, zeta) / modulus)


def curve_numbers(family: PlaneFamily, curve: TracedCurve) -> Array:
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


def trace(family: PlaneFamily, at: Array) -> float:
    """Return T at (c, s, u, v)."""
    return conditions.InteriorEquations(family, at).trace(family.ratio(float(at[:2] @ at[:2]), at[2:]).bend)


def lyapunov(family: PlaneFamily, v: Array) -> Array:
    """First Lyapunov coefficients (m,) at places (m, 4) where tr J = 0 < det J; on the equator that beside it."""
    inner = np.hypot(v[:, 0], v[:, 1]) < 1.0
    if not inner.all():
        rows = np.flatnonzero(inner)
        if not len(rows):
            return np.full(len(v), math.nan)
        nearest = rows[np.abs(np.arange(len(v))[:, None] - rows).argmin(axis=1)]
        return lyapunov(family, v[rows])[np.searchsorted(rows, nearest)]
    m = len(v)
    values: dict[str, Any] = dict(zip(("c", "s", *AXES), v.T, strict=True))
    D, D2, D3 = np.empty((m, 2, 2)), np.empty((m, 2, 2, 2)), np.empty((m, 2, 2, 2, 2))
    for i, row in enumerate(family.unit_rows):
        for j, first in enumerate("cs"):
            once = row.derivative(first)
            D[:, i, j] = once.evaluate(values)
            for k, second in enumerate("cs"):
                D2[:, i, j, k] = once.derivative(second).evaluate(values)
        for j, k, m3 in itertools.product(range(2), repeat=3):
            D3[:, i, j, k, m3] = row.derivative("cs"[j]).derivative("cs"[k]).derivative("cs"[m3]).evaluate(values)
    modulus = np.hypot(v[:, 0], v[:, 1])
    psis = [family.psi_at(at[2:]) for at in v] if any(family.of_psi) else [family.psi] * m
    zeta = np.array(
        [float(psi.radius(r, (1.0 - r) * (1.0 + r))) for psi, r in zip(psis, modulus.tolist(), strict=True)]
    )
    x2 = v[:, :2] * (zeta / np.maximum(modulus, 1e-300))[:, None]
    if not any(family.of_psi):
        return first_lyapunov(D, family.psi, x2, D2, D3)
    every = [
        first_lyapunov(D[i : i + 1], psi, x2[i : i + 1], D2[i : i + 1], D3[i : i + 1]) for i, psi in enumerate(psis)
    ]
    return np.concatenate(every)
