"""Period, multiplier and means of limit cycles in 30 digits, by Gragg's extrapolation and Liouville's formula."""

import math

import mpmath as mp
import pytest

from codim2_core import ELinear, limit_cycles, psi

from .reference import regularisation

CASES = [
    ((172.0, 186.0, -200.0, -86.0, -93.0), psi.hill(3), 40),
    ((172.0, 186.0, -200.0, -86.0, -93.0), psi.hill(4), 100),
    ((1.0, 1.5, -1.2, -0.45, -0.78), psi.hill(4), 40),
]
LEVELS = 11  # order 22


def field(plane, family):
    """x2' = U(e_Psi(x2)) of (x, y); with the integrals of e_Psi and of tr U D e_Psi next to them if there are five."""
    a, b, d, f1, f2 = map(mp.mpf, plane)
    value, slope = regularisation(family)

    def rates(u):
        x, y = u[0], u[1]
        s = x * x + y * y
        P = value(s)
        r = mp.sqrt(s + P)
        c, e = x / r, y / r
        velocity = [a * c - b * e + f1, b * c + d * e + f2]
        # D e_Psi = 1/r - (1 + Psi') x2 x2^T/r^3, of which A takes the trace: the antisymmetric part b drops out
        return velocity if len(u) == 2 else [*velocity, c, e, (a + d - (1 + slope(s)) * (a * c * c + d * e * e)) / r]

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


def around(rates, start, T, steps, more=0):
    u = [*start, *[mp.mpf(0)] * more]
    for _ in range(steps):
        u = step(rates, u, T / steps)
    return u


def gap(end, start, velocity):
    """How far from its start a turn ends: across the flow, and along it in time."""
    x, y, (v, w) = end[0] - start[0], end[1] - start[1], velocity
    return (v * y - w * x) / mp.hypot(v, w), (v * x + w * y) / (v * v + w * w)


@pytest.mark.parametrize(("plane", "family", "steps"), CASES)
def test_cycle(plane, family, steps):
    (cycle,) = limit_cycles(ELinear(*plane[:3], plane[3:]), family)
    p = cycle.points[0]
    h = math.sqrt(1 - p @ p)
    with mp.workdps(30):
        rates = field(plane, family)
        x, y, T = mp.mpf(p[0] / h), mp.mpf(p[1] / h), mp.mpf(cycle.period)
        # One step of Newton's method across the flow, where a turn multiplies by the multiplier: 1e-13 becomes 1e-25.
        across, _ = gap(around(rates, (x, y), T, steps), (x, y), rates([x, y]))
        v, w = rates([x, y])
        move = across / (1 - mp.mpf(cycle.multiplier)) / mp.hypot(v, w)
        x, y = x - w * move, y + v * move
        u = around(rates, (x, y), T, steps, 3)
        across, late = gap(u, (x, y), rates([x, y]))
        assert abs(across) < mp.mpf(10) ** -17
        assert abs(late) < mp.mpf(10) ** -12
        T -= late  # what is left of it is its square
        c, e, trace = (end - late * rate for end, rate in zip(u[2:], rates(u)[2:], strict=True))
        multiplier = mp.exp(trace)  # the other one is 1
        assert abs(cycle.period / T - 1) < 1e-13
        # an exponent of -30 (multiplier 5e-14) is as accurate as its size allows
        slack = 1e-12 * max(1, abs(mp.log(multiplier)))
        assert abs(cycle.multiplier / multiplier - 1) < slack
        assert abs(cycle.divergence_multiplier / multiplier - 1) < slack
        a, b, d, f1, f2 = map(mp.mpf, plane)
        det = a * d + b * b
        mean = (-(d * f1 + b * f2) / det, -(a * f2 - b * f1) / det)
        for k in range(2):
            assert abs((c, e)[k] / T - mean[k]) < mp.mpf(10) ** -15  # prop:LC itself
            assert abs(cycle.mean_e[k] - mean[k]) < 1e-12
