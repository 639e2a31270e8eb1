"""The first Lyapunov coefficient of Hopf points of a family."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from ...portrait.layer_problem.lyapunov import first_lyapunov
from ...results.arrays import Array
from .family import AXES, SystemFamily

__all__ = ["lyapunov"]


def lyapunov(family: SystemFamily, v: Array) -> Array:
    """First Lyapunov coefficients (m,) at places (m, 2 + n) where tr J = 0 < det J; on the equator that next to it."""
    inner = np.hypot(v[:, 0], v[:, 1]) < 1.0
    if not inner.all():
        rows = np.flatnonzero(inner)
        if not len(rows):
            return np.full(len(v), math.nan)
        nearest = rows[np.abs(np.arange(len(v))[:, None] - rows).argmin(axis=1)]
        return lyapunov(family, v[rows])[np.searchsorted(rows, nearest)]
    m = len(v)
    values: dict[str, Any] = dict(zip(("c", "s", *AXES), v.T, strict=False))
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
