"""The motions that are raced: a system, a start, a time, the same formulas as text; and where they end, to 1e-15.

`data/motions.json` holds the ends: Radau IIA of order 13 (seven stages) in 64-bit mantissas, a method and a code that
share nothing with what is raced, at two tolerances whose ends differ by the number stored with them. Make it again by
``python -m tests.benchmarks.motions``.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import mpmath
import numpy as np

from codim2_core import ELinear, System, examples
from codim2_core.systems.kinds import AnySystem

from .data import wrapped_rows

DATA = Path(__file__).parent / "data" / "motions.json"
EPS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
STAGES = 7
Real = np.longdouble
Array = np.ndarray


@dataclass(frozen=True)
class Motion:
    """One motion, Psi = 1."""

    system: AnySystem
    start: tuple[float, ...]  # (x, y, z1, ..., zm)
    t_end: float
    rows: tuple[str, ...]  # U and W as Python text in c, s, z[0], z[1], sin, cos

    def field(self, **names: object) -> Callable[..., Array]:
        """Return ``field(t, q, eps)`` on sqrt, sin, cos and pack that are given."""
        scope = dict(names)
        lines = [
            "def field(t, q, eps):",
            "    rho = sqrt(q[0]*q[0] + q[1]*q[1] + eps*eps)",
            "    c, s, z = q[0]/rho, q[1]/rho, q[2:]",
            f"    return pack([{', '.join(self.rows)}])",
        ]
        exec("\n".join(lines), scope)
        return scope["field"]  # type: ignore[return-value]


_PUSH, _SLOW = 3.5 * 0.2 * 9.81, 0.2 * 9.81
MOTIONS = {
    "ball": Motion(
        examples.ball_in_pool(K=2.0), (-1.0, 0.3, 10.0, 0.0), 3.0,
        (f"-{_PUSH!r}*c - 2*z[0]", f"-{_PUSH!r}*s - 2*z[1]", f"-{_SLOW!r}*c - 2*z[0]", f"-{_SLOW!r}*s - 2*z[1]"),
    ),
    "block": Motion(
        examples.tilting_block(), (0.3, 0.1, 0.1), 5.0,
        (
            f"-{0.3 * 9.81!r}*cos(z[0])*c + {9.81 * math.cos(0.5)!r}*sin(z[0])",
            f"-{0.6 * 9.81!r}*cos(z[0])*s + {9.81 * math.sin(0.5)!r}*sin(z[0])",
            "0*c + 0.02",
        ),
    ),
    "non-unique sliding": Motion(
        examples.nonunique_sliding(), (0.25, 0.3, 0.0), 2.0,
        ("-c*(c*c - 0.25*((1 + 2*z[0]*z[0])/(1 + z[0]*z[0]))**2)", "-0.5*s", "-2*c + 0.25"),
    ),
    "forced": Motion(
        System(U=("-c + 1.3*sin(z1)", "-s + 0.4*cos(2*z1)"), W=("1",)), (0.3, 0.2, 0.0), 10.0,
        ("-c + 1.3*sin(z[0])", "-s + 0.4*cos(2*z[0])", "0*c + 1.0"),
    ),
    "so(2,1)": Motion(ELinear(0.0, 1.0, 0.0, (0.3, 0.2)), (0.3, 0.2), 10.0, ("-s + 0.3", "c + 0.2")),
}  # fmt: skip


@lru_cache(maxsize=1)
def ends() -> dict[str, Array]:
    """Return the stored ends, by name and eps."""
    return {name: np.array(found["end"]) for name, found in json.loads(DATA.read_text()).items()}


def key(name: str, eps: float) -> str:
    """What an end is stored under."""
    return f"{name}, {eps:.0e}"


def tableau() -> tuple[Array, Real, Array]:
    """A, gamma and the weights of the error estimate, from mpmath."""
    with mpmath.workdps(40):
        ks = range(STAGES)
        poly = mpmath.taylor(lambda x: mpmath.jacobi(STAGES - 1, 1, 0, x), 0, STAGES - 1)[::-1]
        nodes = [*sorted((1 + mpmath.re(x)) / 2 for x in mpmath.polyroots(poly, maxsteps=200)), mpmath.mpf(1)]
        powers = mpmath.matrix([[c**k for k in ks] for c in nodes])
        A = mpmath.matrix([[c ** (k + 1) / (k + 1) for k in ks] for c in nodes]) * powers**-1
        inverse = A**-1
        values = mpmath.eig(inverse, left=False, right=False)
        gamma = 1 / mpmath.re(min(values, key=lambda v: abs(mpmath.im(v))))
        target = mpmath.matrix([mpmath.mpf(1) / (k + 1) - (gamma if k == 0 else 0) for k in ks])
        embedded = mpmath.lu_solve(powers.T, target)
        weights = (embedded - A[STAGES - 1, :].T).T * inverse
        real = lambda x: Real(mpmath.nstr(x, 30))
        return (np.array([[real(A[i, j]) for j in ks] for i in ks]), real(gamma), np.array([real(w) for w in weights]))


def solved(A: Array, b: Array) -> Array:
    """Gauss with row exchanges: NumPy's own has no long doubles."""
    A, b, n = A.copy(), b.copy(), len(b)
    for k in range(n):
        p = k + int(np.argmax(np.abs(A[k:, k])))
        A[[k, p]], b[[k, p]] = A[[p, k]], b[[p, k]]
        share = A[k + 1 :, k] / A[k, k]
        A[k + 1 :, k:] -= share[:, None] * A[k, k:]
        b[k + 1 :] -= np.multiply.outer(share, b[k])
    for k in range(n - 1, -1, -1):
        b[k] = (b[k] - A[k, k + 1 :] @ b[k + 1 :]) / A[k, k]
    return b


def followed(F: Callable[[Array], Array], start: Array, t_end: float, eps: float, tolerance: float) -> Array:
    """The end of a motion in long doubles."""
    A, gamma, weights = tableau()
    y, t, n = start.astype(Real), Real(0), len(start)
    unit, h = np.eye(n, dtype=Real), Real(1e-3 * math.hypot(*start[:2], eps))
    size = lambda q: np.array([np.sqrt(q[0] ** 2 + q[1] ** 2 + Real(eps) ** 2)] * 2 + [abs(v) + 1e-2 for v in q[2:]])
    while t < t_end:
        h = min(h, t_end - t)
        w, d = size(y), Real(1e-9)
        J = np.stack([(F(y + d * w * e) - F(y - d * w * e)) / (2 * d) for e in unit], axis=-1) / w[:, None]
        full = np.eye(n * STAGES, dtype=Real) - np.kron(A, h * J)
        inverse = solved(full, np.eye(n * STAGES, dtype=Real))
        Z, last, good = np.zeros((STAGES, n), Real), math.inf, False
        for _ in range(30):
            rates = np.stack([F(y + row * w) for row in Z]) / w
            change = (inverse @ (h * (A @ rates) - Z).ravel()).reshape(Z.shape)
            Z, moved = Z + change, float(np.abs(change).max())
            if moved <= 1e-17 or (moved <= 1e-14 and moved >= 0.3 * last):
                good = True
                break
            if not moved < 2.0 * last:
                break
            last = moved
        raw = gamma * h * F(y) / w + weights @ Z
        error = float(np.abs(solved(unit - gamma * h * J, raw)).max()) / tolerance if good else math.inf
        factor = min(4.0, max(0.2, 0.8 * (error + 1e-12) ** (-1.0 / (STAGES + 1))))
        if error <= 1.0:
            y, t = y + Z[-1] * w, t + h
        h *= Real(factor if good else 0.3)
    return y


def main() -> None:
    """Compute all ends, and store them."""
    stored = {}
    for name, motion in MOTIONS.items():
        field = motion.field(sqrt=np.sqrt, sin=np.sin, cos=np.cos, pack=np.array)
        for eps in EPS:
            F = lambda q, eps=eps, field=field: field(Real(0), q, Real(eps))
            start = np.array(motion.start, Real)
            loose, tight = (followed(F, start, motion.t_end, eps, tolerance) for tolerance in (1e-11, 1e-12))
            apart = float(np.abs(tight - loose).max())
            stored[key(name, eps)] = {"end": [float(v) for v in tight], "apart": apart}
            print(key(name, eps), stored[key(name, eps)], flush=True)
            DATA.write_text(wrapped_rows(stored))


if __name__ == "__main__":
    main()
