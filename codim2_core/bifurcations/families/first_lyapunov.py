"""The first Lyapunov coefficient, where tr J = 0 ((4.19), (3.26)): at one Hopf point, and at those of a family.

It is that of the layer problem ``x2' = U(e_Psi(x2))``. With ``e_Psi = x h(|x|^2)``, ``h(s) = (s + Psi(s))^(-1/2)``, the
second and third differentials of e_Psi are exact polynomials in h', h'', h''' and hence in the first three derivatives
of Psi.
"""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...formulas.expression import parse
from ...results.arrays import Array
from ...systems.psi.function import Psi
from .family import AXES, SystemFamily

TERM_ROUNDING = 2.0**-44  # of the terms that the coefficient is the sum of


def psi_derivatives(psi: Psi, s: Array) -> tuple[Array, Array, Array]:
    """First three derivatives of Psi at s (m,), as its family has them, or of its formula."""
    if psi.record.derivatives is not None:
        return psi.record.derivatives(s, psi.parameter)
    expression = parse(psi.text, ("s",)) if psi.expression is None else psi.expression
    found = []
    for _ in range(3):
        expression = expression.derivative("s")
        values = np.broadcast_to(expression.evaluate({"s": s}), s.shape)
        found.append(np.where(np.isfinite(values), values, 0.0))  # inf/inf in a tail that has long become 0
    return tuple(found)  # type: ignore[return-value]


@np.errstate(all="ignore")  # where det J is lost in rounding, next to the equator, the answer is no number
def first_lyapunov(A: Array, psi: Psi, x2: Array, second_U: Array | None = None, third_U: Array | None = None) -> Array:
    """First Lyapunov coefficient at critical sets with tr J = 0 < det J.

    In Kuznetsov's normalisation ``<q, q> = <p, q> = 1``, with x2 and the fast time tau as they are. Negative: a
    stable cycle is born (supercritical). 0.0 where it vanishes within rounding. A cycle at tr J = 2 mu has ``mu +
    omega l1 r^2 = 0`` to leading order. Shapes: A (2, 2), x2 (m, 2), second_U, third_U (m, 2, 2, 2).
    """
    s = (x2**2).sum(axis=1)
    P1, P2, P3 = psi_derivatives(psi, s)
    w, w1 = s + np.asarray(psi(s)), 1.0 + P1
    h0 = w**-0.5
    h1 = -0.5 * h0**3 * w1
    h2 = 0.75 * h0**5 * w1**2 - 0.5 * h0**3 * P2
    h3 = -1.875 * h0**7 * w1**3 + 2.25 * h0**5 * w1 * P2 - 0.5 * h0**3 * P3
    # at 0 they come with powers of x alone, and may be infinite where e_Psi bends as the power of a Hill Psi does
    h2, h3 = np.where(s > 0.0, h2, 0.0), np.where(s > 0.0, h3, 0.0)
    x = x2

    def dot(u: NDArray, v: NDArray) -> NDArray:
        return (u * v).sum(axis=1)[:, None]

    h0, h1, h2, h3 = h0[:, None], h1[:, None], h2[:, None], h3[:, None]
    eye = np.eye(2)
    De = h0[:, :, None] * eye + 2.0 * h1[:, :, None] * x[:, :, None] * x[:, None, :]
    J = A @ De

    def apply_matrix(matrix: NDArray, u: NDArray) -> NDArray:
        return (matrix @ u[:, :, None])[:, :, 0]

    def second_derivative(v: NDArray, u: NDArray) -> NDArray:
        xv, xu = dot(x, v), dot(x, u)
        return 2.0 * h1 * (xu * v + xv * u + dot(u, v) * x) + 4.0 * h2 * xu * xv * x

    def twice(v: NDArray, u: NDArray) -> NDArray:
        return np.zeros(2) if second_U is None else np.einsum("mijk,mj,mk->mi", second_U, v, u)

    def second(v: NDArray, u: NDArray) -> NDArray:
        return apply_matrix(A, second_derivative(v, u)) + twice(apply_matrix(De, v), apply_matrix(De, u))

    def third(u: NDArray, v: NDArray, t: NDArray) -> NDArray:
        xu, xv, xt, uv, ut, vt = dot(x, u), dot(x, v), dot(x, t), dot(u, v), dot(u, t), dot(v, t)
        plain = 2.0 * h1 * (ut * v + uv * t + vt * u)
        mixed = 4.0 * h2 * (xu * xt * v + xu * xv * t + xv * xt * u + (uv * xt + xv * ut + xu * vt) * x)
        out = apply_matrix(A, plain + mixed + 8.0 * h3 * xu * xv * xt * x)
        Du, Dv, Dt = apply_matrix(De, u), apply_matrix(De, v), apply_matrix(De, t)
        out = (
            out
            + twice(second_derivative(u, v), Dt)
            + twice(second_derivative(v, t), Du)
            + twice(second_derivative(t, u), Dv)
        )
        return out if third_U is None else out + np.einsum("mijkl,mj,mk,ml->mi", third_U, Du, Dv, Dt)

    # On the curve tr J = 0; its rounding is taken out, so that the eigenvalues are +- i omega.
    J = J - 0.5 * np.trace(J, axis1=1, axis2=2)[:, None, None] * eye
    omega = np.sqrt(np.linalg.det(J))
    # J q = i omega q: either column of J + i omega
    columns = J + 1j * omega[:, None, None] * eye
    size = (abs(columns) ** 2).sum(axis=1)
    q = np.where((size[:, :1] >= size[:, 1:]), columns[:, :, 0], columns[:, :, 1])
    q = q / np.sqrt((abs(q) ** 2).sum(axis=1))[:, None]
    adjoint = np.swapaxes(J, 1, 2) - 1j * omega[:, None, None] * eye  # J^T p = -i omega p
    size = (abs(adjoint) ** 2).sum(axis=1)
    p = np.where((size[:, :1] >= size[:, 1:]), adjoint[:, :, 0], adjoint[:, :, 1])
    p = p / np.conj((np.conj(p) * q).sum(axis=1))[:, None]
    bar = np.conj(q)
    # J J = -omega^2, so that the inverses of J and of 2i omega - J are multiples of J and of 2i omega + J
    square = (omega**2)[:, None]
    still = (-J @ second(q, bar)[:, :, None])[:, :, 0] / square
    double = ((-2j * omega[:, None, None] * eye - J) @ second(q, q)[:, :, None])[:, :, 0] / (3.0 * square)
    terms = np.stack([third(q, q, bar), -2.0 * second(q, still), second(bar, double)])
    value = (np.conj(p) * terms.sum(axis=0)).sum(axis=1).real
    # where the flow is linear or reversible the terms cancel: what rounding leaves of them is no sign
    lost = TERM_ROUNDING * (abs(p) * abs(terms).sum(axis=0)).sum(axis=1)
    return np.where(abs(value) <= lost, 0.0, value) / (2.0 * omega)


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
