"""Floquet multipliers of a periodic motion, without those that are known: of a shift in time 1, of what is lost 0.

The monodromy matrix is M = P_K ... P_1, a product over steps. Its eigenvalues are those of the product begun at any
other step: P_i ... P_1 P_K ... P_(i+1). In the limit eps -> 0 this begins where most is lost. On a slide (x, y) = 0
and the state is z alone: two multipliers are 0, the others are those of z by z. Where the motion crosses Sigma,
(x, y) = 0 too, and a motion next to it is given by z and by when it leaves, along e: one multiplier is 0. So zeros are
exact, and not what rounding leaves of them.

Where the motion is shot in segments, M = S_k ... S_1 is never multiplied out: large multipliers would drown small ones.
Sweeps of QR decompositions around the period, ``S_i Q_(i-1) = Q_i R_i`` (periodic Schur form: Bojanczyk, Golub and Van
Dooren 1992), turn Q_0 into an invariant basis, and each multiplier is a product of diagonal entries of R_i.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...numerics.curves.assignment import assign
from ...results.arrays import Array, Complex
from ...systems.psi.function import Psi
from ..initial_value.field import Field
from ..result import Simulation
from ..tracked_set import place_on_hemisphere
from ..variation.result import Variation

SWEEPS = 8  # around the period
DEFLATED = 1e-11  # what a sweep still turns of a direction into those before it, where they are apart


def rate_at(formulas: Field, psi: Psi | None, run: Simulation, i: int) -> Array:
    """Rate (2 + m,) with which a motion goes on from the end of a step."""
    x, y, *z = run.states[i].tolist()
    if run.eps > 0.0:
        assert psi is not None
        e = place_on_hemisphere(psi, run.eps, x, y)[0]
    elif x or y:
        e = np.array([x, y]) / np.hypot(x, y)
    else:
        t = float(run.times[i])
        phase = next(one for one in reversed(run.phases) if one.t_start <= t and (one.kind != "slip" or one.t_end > t))
        e = phase.e(min(t, phase.t_end))
        found = np.array(formulas.value(*e.tolist(), x, y, *z))
        if phase.kind == "slide":
            found[:2] = 0.0
        return found
    return np.array(formulas.value(*e.tolist(), x, y, *z))


def start_of(run: Simulation, variation: Variation) -> tuple[int, Array]:
    """Step end at which most is lost, and a basis (2, k) of the changes of (x, y) that are left there."""
    plane = np.eye(2) if variation.within is None else variation.within[:2, :1]
    if run.eps > 0.0:
        return 0, plane
    on = (run.states[:, :2] == 0.0).all(axis=1)
    for phase in run.phases:
        if phase.kind == "slide" and phase.t_end > phase.t_start:
            within = on & (run.times >= phase.t_start) & (run.times <= phase.t_end)
            return int(np.argmax(within)), np.empty((2, 0))
    for phase in run.phases:
        if phase.kind == "cross":
            at = int(np.argmin(np.where(on, np.abs(run.times - phase.t_start), np.inf)))
            return at, phase.e(phase.t_start)[:, None]
    return 0, plane


def multipliers(
    formulas: Field, psi: Psi | None, run: Simulation, variation: Variation, clocks: NDArray[np.bool_],
    cuts: Sequence[int] = (0,),
) -> tuple[Complex, Array, int]:  # fmt: skip
    """Return the multipliers, largest first, their conditions (relative errors to first order), and how many are 0."""
    n = run.states.shape[1]
    steps = variation.propagators[:, :n, :n]
    i, plane = start_of(run, variation)
    slow = np.eye(n)[:, 2:] if variation.within is None else variation.within[:, 1:]
    slow = slow[:, ~slow[2:][clocks].any(axis=0)]
    basis = np.concatenate([np.concatenate([plane, np.zeros((n - 2, plane.shape[1]))]), slow], axis=1)

    def across(k: int) -> Array:  # the motion
        if clocks.any():
            return basis
        ahead = basis.T @ rate_at(formulas, psi, run, k)
        return basis @ np.linalg.qr(ahead[:, None], mode="complete")[0][:, 1:]

    steps, starts = [*steps[i:], *steps[:i]], [i, *cuts[1:]]
    bases = [across(k) for k in (*starts, i)]
    segments = [
        after.T @ reduce(lambda product, step: step @ product, steps[low - i : high - i], np.eye(n)) @ before
        for (low, high), (before, after) in zip(pairwise([*starts, i + len(steps)]), pairwise(bases), strict=True)
    ]
    found, conditions = _product_eigenvalues(segments)
    lost = (2 if variation.within is None else 1) - plane.shape[1]
    order = np.argsort(-np.abs(found), kind="stable")
    zeros = np.zeros(lost)
    return np.concatenate([found[order], zeros.astype(complex)]), np.concatenate([conditions[order], zeros]), lost


def _product_eigenvalues(factors: Sequence[Array]) -> tuple[Complex, Array]:
    """Eigenvalues of a product, the first factor acting first, and their condition.

    An error of a segment moves what is deflated by the same share: conditions are those of an error of the product.
    """
    if len(factors) == 1:
        return _eigenvalues(factors[0])
    n = len(factors[0])
    turned = first = upper = np.eye(n)
    for _ in range(SWEEPS):
        first, upper = turned, np.eye(n)
        for factor in factors:
            turned, right = np.linalg.qr(factor @ turned)
            upper = right @ upper
    mixed = first.T @ turned  # of the product in the basis `first`: mixed @ upper
    borders = [k for k in range(1, n) if np.abs(mixed[k:, :k]).max() < DEFLATED]
    blocks = [mixed[low:high, low:high] @ upper[low:high, low:high] for low, high in pairwise([0, *borders, n])]
    parts = [_eigenvalues(block) for block in blocks]
    sizes = [np.linalg.norm(block) for block in blocks]
    shares = [condition * size / max(sizes) for (_, condition), size in zip(parts, sizes, strict=True)]
    return np.concatenate([values for values, _ in parts]), np.concatenate(shares)


def _eigenvalues(matrix: Array) -> tuple[Complex, Array]:
    """Eigenvalues, and their condition 1/|l.r|, l and r the eigenvectors of length 1."""
    values, right = np.linalg.eig(matrix)
    try:
        left = np.linalg.inv(right)
    except np.linalg.LinAlgError:
        return values.astype(complex), np.full(len(values), np.inf)
    return values.astype(complex), np.linalg.norm(left, axis=1) * np.linalg.norm(right, axis=0)


def matching_distances(values: Complex, others: Complex) -> Array:
    """Distance of each value to its partner among as many others, partners being chosen to be close in all."""
    apart = np.abs(values[:, None] - others[None, :])
    return apart[np.arange(len(values)), assign(apart)]
