"""Decide which of several contacts stick: the minimiser of a strictly convex function.

With M positive definite and bounds r_i = mu_i N_i that read no velocity, the friction -J^T r e is minus the
subdifferential of ``sum r_i |x_i|``, x_i = J_i v - w_i. Of contacts at their sets, x_i = 0, the accelerations u = v'
are those of the one minimiser of (Gauss's principle with friction, Moreau 1966)

    u·M u/2 - u·Q + sum r_i |J_i u + k_i|,    k_i = J_i' v - w_i',

Q with the friction of the contacts that slip: a contact sticks if x_i' = J_i u + k_i = 0 there, and r_i e_i is the
force that holds it, |e_i| <= 1; else it begins to slip along x_i'. The minimum is found as a limit of ``|x|`` replaced
by ``sqrt(x^2 + delta^2)``, delta -> 0, by the primal-dual Newton method of Andersen, Christiansen, Conn and Overton
(2000), and then again where it is smooth. That limit is Psi = 1 itself: of the forces that hold redundant contacts, for
which ``J M^-1 J^T`` is singular, it picks those of the product of hemispheres, the largest ``sum r_i sqrt(1 - e_i^2)``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....results.arrays import Array

Flags = NDArray[np.bool_]

SMALLEST_DELTA, DELTA_FACTOR = 1e-12, 0.1  # in units of the accelerations
MAX_ITERATIONS = 60  # of Newton's method, for one delta
STICKING_RATE = 1e-7  # x_i' below which it is 0, in units of the accelerations: more than delta^(2/3)
AT_BOUND = 1e-6  # 1 - |e|^2 of a contact about to slip
NEWTON_SHARE = 1e-4  # last correction of x_i, in units of delta
NEWTON_ERROR = 1e-14  # and of u, where it is smooth, relative
SMALLEST_RATE = 1e-30  # x_i' by which is divided
RANK_TOLERANCE = 1e-10


class Decided(NamedTuple):
    """Accelerations u (n,), rates of slip (k, 2), e (k, 2), and which contacts stick (k,)."""

    u: Array
    rates: Array
    e: Array
    sticks: Flags

    @property
    def is_at_bound(self) -> bool:
        """Whether a force that holds a contact is at its bound, or which contacts stick is not clear."""
        size = (self.e**2).sum(axis=1)
        return bool((self.sticks & (size > 1.0 - AT_BOUND)).any() or (size > 1.0 + AT_BOUND).any())


def decide_contacts(M: Array, Q: Array, J: Array, k: Array, r: Array) -> Decided:
    """Return what contacts at their sets do, by M (n, n) and Q (n,)."""
    free = np.asarray(np.linalg.solve(M, Q), np.float64)
    if not len(J):
        return Decided(free, np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0, bool))
    flat = J.reshape(-1, len(Q))
    pull = flat @ np.linalg.solve(M, flat.T)
    unit = float(np.max(np.hypot(*(J @ free + k).T)) + np.abs(pull).max() * r.max())
    u, force, delta = free, np.zeros_like(k), unit
    while delta > SMALLEST_DELTA * unit:
        u, force = _regularised_minimum(M, Q, J, k, r, u, force, delta)
        delta *= DELTA_FACTOR
    rates = J @ u + k
    sticks = np.hypot(*rates.T) < STICKING_RATE * unit
    u = _smooth_minimum(M, Q, J, k, r, u, sticks)
    rates = np.where(sticks[:, None], 0.0, J @ u + k)
    size = np.hypot(*rates.T)[:, None]
    e = np.where(sticks[:, None], force / r[:, None], rates / np.where(size == 0.0, 1.0, size))
    if sticks.any():
        held = J[sticks].reshape(-1, len(Q))
        rest = Q - M @ u - flat.T @ (r[:, None] * e).ravel()
        e[sticks] += np.linalg.lstsq(held.T, rest, RANK_TOLERANCE)[0].reshape(-1, 2) / r[sticks, None]
    return Decided(u, rates, e, sticks)


def _regularised_minimum(
    M: Array, Q: Array, J: Array, k: Array, r: Array, u: Array, force: Array, delta: float
) -> tuple[Array, Array]:
    """Solve ``M u + J^T force = Q``, ``sqrt(x^2 + delta^2) force = r x``, x = J u + k."""
    flat = J.reshape(-1, len(Q))
    value = lambda u: 0.5 * u @ M @ u - u @ Q + r @ np.sqrt(((J @ u + k) ** 2).sum(axis=1) + delta**2)
    before = value(u)
    for _ in range(MAX_ITERATIONS):
        x = J @ u + k
        s = np.sqrt((x**2).sum(axis=1) + delta**2)
        gain = r[:, None, None] * np.eye(2) - force[:, :, None] * x[:, None, :] / s[:, None, None]
        gain = 0.5 * (gain + gain.transpose(0, 2, 1)) / s[:, None, None]
        slope = np.concatenate(gain @ J)
        there = r[:, None] * x / s[:, None]
        step = np.linalg.solve(M + flat.T @ slope, Q - M @ u - flat.T @ there.ravel())
        share, now = 1.0, value(u + step)
        while now > before + 1e-12 * abs(before) and share > 1e-6:
            share *= 0.5
            now = value(u + share * step)
        u, before = u + share * step, now
        x = J @ u + k
        force = there + share * (gain @ (J @ step)[:, :, None])[:, :, 0]
        size = np.hypot(*force.T)
        force = force * np.minimum(1.0, r / np.where(size > 0.0, size, 1.0))[:, None]
        if np.abs(share * (J @ step)).max() < NEWTON_SHARE * delta:
            break
    return u, force


def _smooth_minimum(M: Array, Q: Array, J: Array, k: Array, r: Array, u: Array, sticks: Flags) -> Array:
    """Minimise where contacts that stick do so exactly, and the others slip."""
    held, own, out, most = J[sticks].reshape(-1, len(Q)), k[sticks].ravel(), J[~sticks], r[~sticks]
    basis = np.eye(len(Q))
    if len(held):
        _, sizes, right = np.linalg.svd(held)
        rank = int((sizes > RANK_TOLERANCE * sizes[0]).sum())
        basis = right[rank:].T
        u = u - np.linalg.lstsq(held, held @ u + own, rcond=RANK_TOLERANCE)[0]
    for _ in range(MAX_ITERATIONS):
        x = out @ u + k[~sticks]
        size = np.maximum(np.hypot(*x.T), SMALLEST_RATE)
        e = x / size[:, None]
        gain = (most / size)[:, None, None] * (np.eye(2) - e[:, :, None] * e[:, None, :])
        flat = out.reshape(-1, len(Q))
        slope = M + flat.T @ np.concatenate([gain @ out]).reshape(-1, len(Q))
        rest = Q - M @ u - flat.T @ (most[:, None] * e).ravel()
        step = basis @ np.linalg.solve(basis.T @ slope @ basis, basis.T @ rest)
        u = u + step
        if np.abs(step).max(initial=0.0) <= NEWTON_ERROR * np.abs(u).max(initial=0.0):
            break
    return u
