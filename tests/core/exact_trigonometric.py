"""An independent reference: integer Sturm sequences for counts, 50-digit Newton for the zeros' digits.

Unlike the code under test it works in tan(theta/2) about theta = 0, with theta = pi apart.
"""

import math
from fractions import Fraction
from itertools import pairwise

import mpmath as mp

DIGITS = mp.mpf(10) ** -45


def integers(values):
    """Exact integers proportional to the doubles."""
    exact = [Fraction(v) for v in values]
    common = math.lcm(*(q.denominator for q in exact))
    return [int(q * common) for q in exact]


def _trim(p):
    while p and p[-1] == 0:
        p.pop()
    return p


def _sign_at_infinity(p, side):
    sign = 1 if p[-1] > 0 else -1
    return -sign if side < 0 and len(p) % 2 == 0 else sign


def _minus_remainder(p, q):
    """-(p mod q) times a positive integer."""
    p, positive = list(p), q[-1] > 0
    lead = abs(q[-1])
    while len(p) >= len(q):
        factor = p[-1] if positive else -p[-1]
        shift = len(p) - len(q)
        p = [lead * a for a in p]
        for i, b in enumerate(q):
            p[i + shift] -= factor * b
        p.pop()
        _trim(p)
    g = math.gcd(*p) if p else 1
    return [-a // g for a in p]


def count_zeros(m0, c1, s1, c2, s2):
    """Distinct zeros in [0, 2 pi), -1 if identically zero; exact for integers or doubles."""
    m0, c1, s1, c2, s2 = integers((m0, c1, s1, c2, s2))
    p = _trim([m0 + c1 + c2, 2 * s1 + 4 * s2, 2 * m0 - 6 * c2, 2 * s1 - 4 * s2, m0 - c1 + c2])
    if not p:
        return -1
    at_pi = len(p) < 5
    if len(p) == 1:
        return int(at_pi)
    chain = [p, [k * a for k, a in enumerate(p)][1:]]
    while len(chain[-1]) > 1:
        r = _minus_remainder(chain[-2], chain[-1])
        if not r:
            break
        chain.append(r)

    def changes(side):
        signs = [_sign_at_infinity(q, side) for q in chain]
        return sum(x != y for x, y in pairwise(signs))

    return changes(-1) - changes(1) + at_pi


def count_equilibria(a, b, d, f1, f2):
    """Distinct zeros of Theta for exactly these doubles."""
    a, b, d, f1, f2 = integers((a, b, d, f1, f2))
    return count_zeros(2 * b, 2 * f2, -2 * f1, 0, d - a)


def theta_coefficients(a, b, d, f1, f2):
    """(m0, c1, s1, c2, s2) of Theta as 50-digit numbers."""
    a, b, d, f1, f2 = map(mp.mpf, (a, b, d, f1, f2))
    with mp.workdps(50):
        return b, f2, -f1, mp.mpf(0), (d - a) / 2


def jet(q, theta):
    """t, t', t'' at theta and the sum of the terms' sizes, in 50 digits."""
    m0, c1, s1, c2, s2 = q
    c, s = mp.cos_sin(theta)
    cc, ss = c * c - s * s, 2 * c * s
    t = m0 + c1 * c + s1 * s + c2 * cc + s2 * ss
    t1 = s1 * c - c1 * s + 2 * (s2 * cc - c2 * ss)
    t2 = -c1 * c - s1 * s - 4 * (c2 * cc + s2 * ss)
    size = abs(m0) + abs(c1 * c) + abs(s1 * s) + abs(c2 * cc) + abs(s2 * ss)
    return t, t1, t2, size


def polished(q, theta):
    """The zero nearest to a good approximation, to 45 digits."""
    with mp.workdps(50):
        theta = mp.mpf(theta)
        for _ in range(12):
            t, t1, _, _ = jet(q, theta)
            step = t / t1
            theta -= step
            if abs(step) < DIGITS:
                break
        return theta


def root_error(q, theta):
    """Error of an approximate simple zero in ulps of 2 pi times (1 + its condition), and in radians."""
    with mp.workdps(50):
        exact = polished(q, theta)
        _, t1, _, size = jet(q, exact)
        error = abs(mp.mpf(theta) - exact)
        # A zero just below 0 is reported as 0.0, and angles near 2 pi may wrap.
        error = min(error, abs(error - 2 * mp.pi))
        return float(error / (mp.mpf(2) ** -52 * (1 + size / abs(t1)))), float(error)
