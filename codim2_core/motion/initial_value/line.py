"""Motions in an invariant line through Sigma: they stay in it, whatever rounding does across it.

Where U is parallel to n on the line ``(x, y) = r n, e = q n``, as in dry friction along a line, a motion that starts
in the line never leaves it, even if the layer problem repels across it; rounding that is amplified there would decide
what follows. So U is projected onto the line, and on Sigma the layer problem is that of q alone, the same for every
Psi: ``q' ~ n.U(q n, 0, 0, z)``, from one end of the diameter to the first zero, or through to the other end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from ...numerics.sign_changes import root_between
from ...results.arrays import Array
from .field import Field

INVARIANCE_SAMPLES = 16  # points at which invariance is asked
EXACT = 1e-13  # of both products in n x U: what counts as parallel
QUICK = (0.37, -0.61)  # of q
ZERO_NET = 400  # of q, on which zeros are looked for


@dataclass(frozen=True, eq=False)
class InvariantLine:
    """An invariant line."""

    field: Field
    n: Array  # (2,) Unit vector

    @property
    def vector(self) -> tuple[float, float]:
        """The unit vector, in floats."""
        n1, n2 = self.n.tolist()
        return n1, n2

    def radial_speed(self, q: float, z: Array) -> float:
        """Return n.U at e = q n on Sigma."""
        c, s = (q * self.n).tolist()
        u, v = self.field.value(c, s, 0.0, 0.0, *z.tolist())[:2]
        return float(self.n[0] * u + self.n[1] * v)

    def slope(self, q: float, z: Array) -> float:
        """Return its derivative by q."""
        c, s = (q * self.n).tolist()
        return float(self.n @ self.field.jacobian(c, s, 0.0, 0.0, z.tolist())[:2, :2] @ self.n)

    def onward(self, q: float, z: Array) -> float | None:
        """Return the limit of the layer problem from q: the first zero of n.U, or an end, +-1; None if it rests."""
        rate = self.radial_speed(q, z)
        if not rate:
            return None
        end = math.copysign(1.0, rate)
        net = q + (end - q) * np.arange(1, ZERO_NET + 1) / ZERO_NET
        before = q
        for after in net.tolist():
            if self.radial_speed(after, z) * end <= 0.0:
                return root_between(lambda at: self.radial_speed(at, z), before, after, 1e-16)
            before = after
        return end


def invariant_line(field: Field, state: Array, left: InvariantLine | None = None) -> InvariantLine | None:
    """Return the invariant line in which a motion at a state (2 + m,), with z in the span of z and W, lies, or None."""
    x, y = state[:2].tolist()
    r = math.hypot(x, y)
    if r > 0.0:
        directions = [np.array([x, y]) / r]
    else:
        directions = [np.array([1.0, 0.0]), np.array([0.0, 1.0])]
        at_rest = np.array(field.value(0.0, 0.0, 0.0, 0.0, *state[2:].tolist())[:2])
        if np.isfinite(at_rest).all() and at_rest.any():  # it leaves e = 0 that way, and no other
            directions = [at_rest / math.hypot(*at_rest.tolist())]
    if left is not None:
        directions = [n for n in directions if abs(float(n @ left.n)) < 0.5]
    found = [n for n in directions if _invariant(field, n, max(r, 1.0), state[2:])]
    return InvariantLine(field, found[0]) if len(found) == 1 or (found and r > 0.0) else None


def _invariant(field: Field, n: Array, r: float, z: Array) -> bool:
    def state_at(q: float, r: float, z: Array) -> tuple[Array, Array]:
        found = np.array(field.value(*(q * n).tolist(), *(r * n).tolist(), *z.tolist()))
        return found[:2], found[2:]

    for q in QUICK:  # most that is no line is seen at once
        U = state_at(q, 0.0, z)[0]
        left, right = float(n[0] * U[1]), float(n[1] * U[0])
        if abs(left - right) > EXACT * (abs(left) + abs(right) + float(np.abs(U).max())):
            return False
    span = np.stack([z, *(state_at(q, 0.0, z)[1] for q in (-1.0, 0.0, 1.0))], axis=-1)
    if not np.isfinite(span).all():
        return False
    basis, sizes, _ = np.linalg.svd(span, full_matrices=False)
    basis = basis[:, sizes > EXACT * max(1e-300, float(sizes.max(initial=0.0)))]
    # In all of z, or, if not there, in the subspace that z stays in.
    return any(_holds_within(field, n, r, z, one) for one in (np.eye(len(z)), basis))


def _holds_within(field: Field, n: Array, r: float, z: Array, basis: Array) -> bool:
    """Whether the line is invariant for z in an affine subspace that z stays in, at samples of it."""
    V, places = _sample_places(basis.shape[1])
    moved = z + (1.0 + np.abs(z).max(initial=0.0)) * (V @ basis.T)
    n1, n2 = n.tolist()
    rows = [
        field.value(q * n1, q * n2, s * r * n1, s * r * n2, *at)
        for (q, s), at in zip(places, moved.tolist(), strict=True)
    ]
    found = np.array([row for row in rows if all(map(math.isfinite, row))]).reshape(-1, 2 + len(z))
    U, W = found[:, :2], found[:, 2:]
    outside = np.abs(W - W @ basis @ basis.T).max(axis=1, initial=0.0)
    if (outside > EXACT * (1.0 + np.abs(W).max(axis=1, initial=0.0))).any():
        return False
    left, right = n1 * U[:, 1], n2 * U[:, 0]
    across, size = np.abs(left - right).max(initial=0.0), (np.abs(left) + np.abs(right)).max(initial=0.0)
    return len(found) > INVARIANCE_SAMPLES // 4 and bool(across <= EXACT * size)


@cache
def _sample_places(width: int) -> tuple[Array, list[tuple[float, float]]]:
    """Return where invariance is asked: (SAMPLES, width) places in the span of z and W, and (q, part of r) of each."""
    rng = np.random.default_rng(0)
    return rng.uniform(-1.0, 1.0, (INVARIANCE_SAMPLES, width)), rng.uniform(-1.0, 1.0, (INVARIANCE_SAMPLES, 2)).tolist()
