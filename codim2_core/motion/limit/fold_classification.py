"""Classify a fold of critical sets at which a slide ends: a jump point, or a folded singularity of the slow flow.

With D = D_e U, the slow flow on U = 0 in the time that det D divides,

    e' = -adj(D) D_z U W,    z' = det D W,

is smooth through the fold det D = 0, and has U as first integrals. Where its e' vanishes on the fold the slow flow may
pass to the repelling set beyond: a canard. Its eigenvalues there are those of a folded node, saddle or focus, and
zeros (P. Szmolyan, M. Wechselberger, J. Differential Equations 177, 419, 2001); with one slow variable it is the canard
point (M. Krupa, P. Szmolyan, SIAM J. Math. Anal. 33, 286, 2001).

Where D_z U has no part along the left null vector of D either, the critical sets cross and go on: an exchange of
stability, transcritical or a pitchfork (the same authors, Nonlinearity 14, 1473, 2001).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...results.arrays import Array
from ...results.words import say
from ..initial_value.field import Field

SINGULAR_SPEED = 1e-5  # |e'| in units of what it is made of, below which a fold is a folded singularity
DIFFERENCE_STEP = 1e-5  # in e and z, for derivatives
MAX_PITCHFORK_CURVATURE = 1e-4  # second derivative along the kernel of a pitchfork, in units of D_e U
MAX_ZERO_PRODUCT = 1e-4  # of the eigenvalues, in units of their squares, below which one is taken for 0


@dataclass(frozen=True)
class Fold:
    """A fold at which a slide ends."""

    reason: str  # a sentence
    left_to_eps: bool = False  # whether what follows is not decided by the limit
    exchange: str = ""  # "transcritical" or "pitchfork" where the set goes on, "" at a fold
    # (m,) Direction in z to where both sets are gone, where the slow flow does not lead there
    beyond: Array | None = None


def classify_fold(formulas: Field, e: Array, z: Array, C: str | None, plain: str) -> Fold:
    """Classify the fold at e (2,) and z (m,)."""
    at = np.concatenate([e, z])
    D, Dz, W, We = _parts(formulas, at)
    across, bends = _transverse_slope(formulas, at, D, Dz)
    if float(np.abs(across).max()) <= SINGULAR_SPEED * float(np.abs(D).max() + np.abs(Dz).max()):
        kind = "transcritical" if abs(bends) > MAX_PITCHFORK_CURVATURE * float(np.abs(D).max()) else "pitchfork"
        return Fold(say(kind, C=C), exchange=kind)
    size = float(np.abs(D).max() * np.abs(Dz).max() * (np.abs(W).max() + np.abs(We).max()))
    if not float(np.abs(_flow(formulas, at)[:2]).max()) < SINGULAR_SPEED * size:
        return Fold(say(plain, C=C))
    if len(z) == 1:
        return Fold(say("canard point", C=C), left_to_eps=True)
    steps = DIFFERENCE_STEP * np.eye(len(at))
    M = np.column_stack([(_flow(formulas, at + h) - _flow(formulas, at - h)) / (2.0 * DIFFERENCE_STEP) for h in steps])
    total, squares = float(np.trace(M)), float(np.trace(M @ M))
    product, scale = 0.5 * (total**2 - squares), total**2 + abs(squares)
    if abs(product) < MAX_ZERO_PRODUCT * scale:
        return Fold(say("folded, degenerate", C=C), left_to_eps=True)
    if product < 0.0:
        return Fold(say("folded saddle", C=C), left_to_eps=True)
    if 0.25 * total**2 < product:
        return Fold(say(plain, C=C))  # a focus turns its canards away: all motions next to it come to jump points
    return Fold(say("folded node", C=C), beyond=_direction_past_fold(formulas, at, D, Dz))


def _parts(formulas: Field, at: Array) -> tuple[Array, Array, Array, Array]:
    """D_e U, D_z U, W and D_e W at (e, z)."""
    c, s, *z = at.tolist()
    slopes = formulas.jacobian(c, s, 0.0, 0.0, z)
    return slopes[:2, :2], slopes[:2, 4:], np.array(formulas.value(c, s, 0.0, 0.0, *z)[2:]), slopes[2:, :2]


def _adjugate(D: Array) -> Array:
    return np.array([[D[1, 1], -D[0, 1]], [-D[1, 0], D[0, 0]]])


def _flow(formulas: Field, at: Array) -> Array:
    """Slow flow in the time that det D divides."""
    D, Dz, W, _ = _parts(formulas, at)
    return np.concatenate([-_adjugate(D) @ Dz @ W, (D[0, 0] * D[1, 1] - D[0, 1] * D[1, 0]) * W])


def _transverse_slope(formulas: Field, at: Array, D: Array, Dz: Array) -> tuple[Array, float]:
    """Return D_z U along the left null vector of D, and how U bends that way along the kernel."""
    left, _, right = np.linalg.svd(D)
    null, r = left[:, 1], np.concatenate([right[1], np.zeros(Dz.shape[1])])
    change = _parts(formulas, at + DIFFERENCE_STEP * r)[0] - _parts(formulas, at - DIFFERENCE_STEP * r)[0]
    return null @ Dz, float(null @ change @ right[1]) / (2.0 * DIFFERENCE_STEP)


def _direction_past_fold(formulas: Field, at: Array, D: Array, Dz: Array) -> Array:
    """Direction in z in which U does not vanish near the fold: that in which U moves as it does along the kernel."""
    across, bends = _transverse_slope(formulas, at, D, Dz)
    way = np.sign(bends) * across
    return way / np.linalg.norm(way)
