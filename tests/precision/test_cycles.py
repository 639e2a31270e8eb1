"""Period, multiplier and means of limit cycles in 30 digits, by Gragg's extrapolation of the variational equation."""

import math

import mpmath as mp
import pytest

from codim2_core import ELinear, limit_cycles, psi

from .reference import derivative, regularisation

CASES = [
    ((172.0, 186.0, -200.0, -86.0, -93.0), psi.hill(3), 40),
    ((172.0, 186.0, -200.0, -86.0, -93.0), psi.hill(4), 100),
    ((1.0, 1.5, -1.2, -0.45, -0.78), psi.hill(4), 40),
]
LEVELS = 11  # order 22


def field(plane, family):
    """(x, y, e-integrals, Y) -> derivatives: x2' = U(e_Psi(x2)), means of e_Psi, Y' = A D e_Psi Y."""
    a, b, d, f1, f2 = map(mp.mpf, plane)
    value, _ = regularisation(family)

    def rates(u):
        x, y = u[0], u[1]
        s = x * x + y * y
        r = mp.sqrt(s + value(s))
        c, e = x / r, y / r
        D11, D12, D22 = derivative(family, x, y)
        J = (a * D11 - b * D12, a * D12 - b * D22, b * D11 + d * D12, b * D12 + d * D22)
        return [
            a * c - b * e + f1, b * c + d * e + f2, c, e,
            J[0] * u[4] + J[1] * u[6], J[0] * u[5] + J[1] * u[7],
            J[2] * u[4] + J[3] * u[6], J[2] * u[5] + J[3] * u[7],
        ]  # fmt: skip

    return rates


def step(rates, u, H):
    """One extrapolated step of the modified midpoint rule."""
    table = []
    first = rates(u)
    for level in range(LEVELS):
        n = 2 * (level + 1)
        h = H / n
        low, high = u, [p + h * v for p, v in zip(u, first, strict=True)]
        for _ in range(n - 1):
            low, high = high, [p + 2 * h * v for p, v in zip(low, rates(high), strict=True)]
        end = [(p + q + h * v) / 2 for p, q, v in zip(high, low, rates(high), strict=True)]
        row = [end]
        for k in range(1, level + 1):
            factor = (mp.mpf(level + 1) / (level + 1 - k)) ** 2 - 1
            row.append([new + (new - old) / factor for new, old in zip(row[-1], table[-1][k - 1], strict=True)])
        table.append(row)
    return table[-1][-1]


def around(rates, start, T, steps):
    u = [*start, mp.mpf(0), mp.mpf(0), mp.mpf(1), mp.mpf(0), mp.mpf(0), mp.mpf(1)]
    for _ in range(steps):
        u = step(rates, u, T / steps)
    return u


@pytest.mark.parametrize(("plane", "family", "steps"), CASES)
def test_cycle(plane, family, steps):
    (cycle,) = limit_cycles(ELinear(*plane[:3], plane[3:]), family)
    p = cycle.points[0]
    h = math.sqrt(1 - p @ p)
    with mp.workdps(30):
        rates = field(plane, family)
        x, y, T = mp.mpf(p[0] / h), mp.mpf(p[1] / h), mp.mpf(cycle.period)
        # One step of Newton's method, for a closed orbit that starts across the flow from here: 1e-13 becomes 1e-25.
        u = around(rates, (x, y), T, steps)
        before, after = rates([x, y, *u[2:]]), rates(u)
        gap = mp.matrix([x - u[0], y - u[1], 0])
        M = mp.matrix([
            [u[4] - 1, u[5], after[0]],
            [u[6], u[7] - 1, after[1]],
            [before[0], before[1], 0],
        ])  # fmt: skip
        move = mp.lu_solve(M, gap)
        x, y, T = x + move[0], y + move[1], T + move[2]
        u = around(rates, (x, y), T, steps)
        assert abs(u[0] - x) + abs(u[1] - y) < mp.mpf(10) ** -17
        multiplier = u[4] * u[7] - u[5] * u[6]  # the other one is 1
        assert abs(cycle.period / T - 1) < 1e-13
        # an exponent of -30 (multiplier 5e-14) is as accurate as its size allows
        slack = 1e-12 * max(1, abs(mp.log(multiplier)))
        assert abs(cycle.multiplier / multiplier - 1) < slack
        assert abs(cycle.divergence_multiplier / multiplier - 1) < slack
        a, b, d, f1, f2 = map(mp.mpf, plane)
        det = a * d + b * b
        mean = (-(d * f1 + b * f2) / det, -(a * f2 - b * f1) / det)
        for k in range(2):
            assert abs(u[2 + k] / T - mean[k]) < mp.mpf(10) ** -15  # prop:LC itself
            assert abs(cycle.mean_e[k] - mean[k]) < 1e-12
