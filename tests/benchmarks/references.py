"""Compute where the trajectories of `problems` end, once: ``python -m tests.benchmarks.references``.

Exact solutions by mpmath's matrix exponential at 50 digits; the others by heyoka's Taylor method in 113-bit
arithmetic at tolerance 1e-25, stored rounded to double precision in `data/ends.npz`.
"""

from __future__ import annotations

import sys

import mpmath
import numpy as np

from .problems import DATA, Problem, ends, problems


def exact(problem: Problem) -> np.ndarray | None:
    """Return ends from a closed form: ``(y, r)' = [[A, f], [f^T, 0]] (y, r)``, p = y/r, for a = d = 0 and Psi = 1.

    For f = 0 and Psi = 1, ``p = y/sqrt(|y|^2 + ebar^2)`` with y' = A y from p.
    """
    a, b, d, f1, f2 = problem.numbers[:5]
    if problem.psi.family != "constant" or not (a == d == 0.0 or f1 == f2 == 0.0):
        return None
    with mpmath.workdps(50):
        rows = [[a, -b, f1], [b, d, f2], [f1, f2, 0.0]]
        flow = mpmath.expm(mpmath.matrix(rows) * mpmath.mpf(problem.t_end))
        ends = []
        for x, y in problem.seeds:
            x, y = mpmath.mpf(float(x)), mpmath.mpf(float(y))
            u, v, r = flow * mpmath.matrix([x, y, 1])
            if not a == d == 0.0:
                r = mpmath.sqrt(u * u + v * v + 1 - x * x - y * y)
            ends.append((float(u / r), float(v / r)))
    return np.array(ends)


def taylor(problem: Problem) -> np.ndarray:
    """Return ends by heyoka at 113 bits."""
    import heyoka as hy

    real = hy.real128
    variables = hy.make_vars("x", "y")
    scope = {"sqrt": hy.sqrt, "exp": hy.exp, "tanh": hy.tanh, "positive": lambda h: h}
    exec(problem.text(polar=False), scope)
    right = scope["field"](*variables, problem.numbers)
    run = hy.taylor_adaptive(
        list(zip(variables, right, strict=True)), [real(0)] * 2, fp_type=real, tol=real("1e-25"), compact_mode=True
    )
    ends = []
    for x, y in problem.seeds.tolist():
        run.time = real(0)
        run.state[:] = [real(x), real(y)]
        run.propagate_until(real(problem.t_end))
        ends.append((float(run.state[0]), float(run.state[1])))
    return np.array(ends)


def main(names: list[str]) -> None:
    """Compute the named problems, or all, and store them."""
    stored = dict(ends()) if DATA.exists() else {}
    for problem in problems():
        if names and problem.name not in names:
            continue
        closed = exact(problem)
        found = taylor(problem) if closed is None else closed
        stored[problem.name] = found
        print(problem.name, "exact" if closed is not None else "Taylor", flush=True)
        np.savez_compressed(DATA, **stored)


if __name__ == "__main__":
    main(sys.argv[1:])
