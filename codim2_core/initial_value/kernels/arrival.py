"""Compiled decisions after an arrival at Sigma where signs are safe; all else is left to the caller.

It slides on C, whatever Psi is, where U = A (e - C) with A + A^T negative definite and |C| < 1 (thm:case1): at a limit
direction (e - C).U = lambda_rho (1 - C.e) < 0, so that all of them lead inward, Bendixson's criterion forbids cycles,
and D_e U D e_Psi = A P with P > 0 has eigenvalues in the left half plane. In an invariant line it goes on to the first
zero of n.U. Elsewhere two orbits of the layer problem are followed up the hemisphere, one on each side of the one that
leaves Q: where both come to the same set, and that attracts under every Psi, the one between them does.
"""

from __future__ import annotations

import math

from ...jit import bits_of_double, call_field, kernel
from ..line import ZERO_NET
from .rate import GAIN, RADIUS
from .slow import RATES, SET_PLACE, TABLE, VALUE, found_set, write_slopes

SIGNED = 1e-6  # of the size of D_e U and U: what has a sign for sure
ATTRACTS = 1e-2  # of the size of D_e U squared: its determinant, where orbits are said to end
MAX_NEWTON, MAX_CORRECTION = 12, 0.3  # for Q from the angle of arrival
SIGN_SAMPLES = 8  # angles on the way there at which Theta is asked for its sign
START_ANGLE, START_HEIGHT = 0.01, 0.02  # angle from Q, and ebar, at which the two orbits start
ORBIT_TOLERANCE, MAX_ORBIT_STEPS, CHECK_INTERVAL = 1e-4, 120, 3  # of their steps
CAPTURED = 1e-2  # in e: so close to a set that attracts, an orbit ends there
ROOT = 80  # bisections at most


@kernel
def write_at(S, m, c, s):
    """Write U, W and their slopes at e = (c, s) on Sigma, at the z in place."""
    S[SET_PLACE], S[SET_PLACE + 1], S[SET_PLACE + 2], S[SET_PLACE + 3] = c, s, 0.0, 0.0
    write_slopes(S, m)
    call_field(bits_of_double(S[VALUE]), S, SET_PLACE, RATES, S)


@kernel
def _field_sizes(S, m):
    """Size of D_e U, and of U."""
    width = 4 + m
    slopes = max(max(abs(S[TABLE]), abs(S[TABLE + 1])), max(abs(S[TABLE + width]), abs(S[TABLE + width + 1])))
    return slopes, slopes + abs(S[RATES]) + abs(S[RATES + 1])


@kernel
def _on_the_only_set(S, m):
    """Return whether all orbits of U = A (e - C) slide on C, by the symmetric part of A; C is in place."""
    write_at(S, m, 0.0, 0.0)
    width = 4 + m
    a, b, c, d = S[TABLE], S[TABLE + 1], S[TABLE + width], S[TABLE + width + 1]
    u, v = S[RATES], S[RATES + 1]
    largest = 0.5 * (a + d) + math.hypot(0.5 * (a - d), 0.5 * (b + c))
    if not largest < -SIGNED * _field_sizes(S, m)[0]:
        return False
    det = a * d - b * c
    S[SET_PLACE], S[SET_PLACE + 1] = (b * v - d * u) / det, (c * u - a * v) / det
    return math.hypot(S[SET_PLACE], S[SET_PLACE + 1]) < 1.0 - SIGNED and found_set(S, m)


@kernel
def _radial_speed(S, m, n1, n2, q):
    """n.U at e = q n, and its derivative by q."""
    write_at(S, m, q * n1, q * n2)
    width = 4 + m
    across1, across2 = S[TABLE] * n1 + S[TABLE + 1] * n2, S[TABLE + width] * n1 + S[TABLE + width + 1] * n2
    return n1 * S[RATES] + n2 * S[RATES + 1], n1 * across1 + n2 * across2


@kernel
def _in_line(S, m, n1, n2, theta):
    """Whether an arrival in an invariant line slides; the set is in place."""
    q = math.copysign(1.0, n1 * math.cos(theta) + n2 * math.sin(theta))
    low, high, found = q, q, False
    if not _radial_speed(S, m, n1, n2, q)[0] * q < -SIGNED * _field_sizes(S, m)[1]:
        return False
    for k in range(1, ZERO_NET + 1):
        high = q - 2.0 * q * k / ZERO_NET
        if not _radial_speed(S, m, n1, n2, high)[0] * q < 0.0:
            found = True
            break
        low = high
    if not found:
        return False
    slope = 0.0
    for _ in range(ROOT):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        value, slope = _radial_speed(S, m, n1, n2, middle)
        if value * q < 0.0:
            low = middle
        else:
            high = middle
    attracts = slope < -SIGNED * _field_sizes(S, m)[0]
    S[SET_PLACE], S[SET_PLACE + 1] = high * n1, high * n2
    return attracts and abs(high) < 1.0 - SIGNED and found_set(S, m)


@kernel
def _limit_direction(S, m, theta):
    """Angle of the limit direction that an arrival at theta comes to, if it attracts on all sides; else NaN."""
    angle, radial, slope, size, change = theta, 0.0, 0.0, 0.0, 1.0
    width = 4 + m
    for _ in range(MAX_NEWTON):
        c, s = math.cos(angle), math.sin(angle)
        write_at(S, m, c, s)
        u, v = S[RATES], S[RATES + 1]
        D11, D12, D21, D22 = S[TABLE], S[TABLE + 1], S[TABLE + width], S[TABLE + width + 1]
        radial, size = c * u + s * v, _field_sizes(S, m)[1]
        slope = s * (s * D11 - c * D12) + c * (c * D22 - s * D21) - radial
        change = (c * v - s * u) / slope
        angle -= change
        if not (abs(change) < MAX_CORRECTION and abs(angle - theta) < MAX_CORRECTION):
            return math.nan
        if abs(change) < 1e-12:
            break
    moved = angle - theta
    if not (abs(change) < 1e-9 and radial < -SIGNED * size and slope < -SIGNED * size):
        return math.nan
    if abs(moved) > 1e-6:
        for k in range(SIGN_SAMPLES):
            c, s = math.cos(theta + moved * k / SIGN_SAMPLES), math.sin(theta + moved * k / SIGN_SAMPLES)
            write_at(S, m, c, s)
            if not (c * S[RATES + 1] - s * S[RATES]) * moved > 0.0:
                return math.nan
    return angle


@kernel
def _layer_rate(S, P, gain, p, q):
    """Rate of the layer problem at a point of the projected disc; NaN outside."""
    gap = 1.0 - p * p - q * q
    if not gap > 0.0:
        return math.nan, math.nan
    S[RADIUS], S[RADIUS + 1] = p * p + q * q, math.sqrt(gap)
    call_field(gain, S, RADIUS, GAIN, P)
    S[SET_PLACE], S[SET_PLACE + 1] = S[GAIN] * p, S[GAIN] * q
    call_field(bits_of_double(S[VALUE]), S, SET_PLACE, RATES, S)
    u, v = S[RATES], S[RATES + 1]
    along = p * u + q * v
    return u - p * along, v - q * along


@kernel
def _is_captured(S, P, gain, m, p, q):
    """Whether a point is close to a set that attracts under every Psi, which is then in place."""
    _layer_rate(S, P, gain, p, q)
    c, s = S[SET_PLACE], S[SET_PLACE + 1]
    if not found_set(S, m):
        return False
    e1, e2, width = S[SET_PLACE], S[SET_PLACE + 1], 4 + m
    if not (math.hypot(e1 - c, e2 - s) < CAPTURED and math.hypot(e1, e2) < 1.0 - SIGNED):
        return False
    D11, D12, D21, D22 = S[TABLE], S[TABLE + 1], S[TABLE + width], S[TABLE + width + 1]
    r = math.hypot(e1, e2)
    n1, n2 = (e1 / r, e2 / r) if r > 0.0 else (1.0, 0.0)
    radial, size = n1 * (n1 * D11 + n2 * D12) + n2 * (n1 * D21 + n2 * D22), _field_sizes(S, m)[0]
    across = D11 + D22 - radial  # tr J is a sum of both, each times a positive number
    return max(radial, across) < -SIGNED * size and ATTRACTS * size * size < D11 * D22 - D12 * D21


@kernel
def _ends_on_a_set(S, P, gain, m, angle):
    """Follow an orbit of the layer problem from beside the equator; whether it ends on a set, which is then in place.

    By the method of Bogacki and Shampine: only where it ends is asked.
    """
    height = math.sqrt(1.0 - START_HEIGHT * START_HEIGHT)
    p, q = height * math.cos(angle), height * math.sin(angle)
    a1, b1 = _layer_rate(S, P, gain, p, q)
    h = 0.1 / (abs(S[RATES]) + abs(S[RATES + 1]))
    taken = 0
    for _ in range(MAX_ORBIT_STEPS):
        a2, b2 = _layer_rate(S, P, gain, p + 0.5 * h * a1, q + 0.5 * h * b1)
        a3, b3 = _layer_rate(S, P, gain, p + 0.75 * h * a2, q + 0.75 * h * b2)
        to_p, to_q = p + h * (2.0 * a1 + 3.0 * a2 + 4.0 * a3) / 9.0, q + h * (2.0 * b1 + 3.0 * b2 + 4.0 * b3) / 9.0
        a4, b4 = _layer_rate(S, P, gain, to_p, to_q)
        off_p, off_q = -5.0 * a1 + 6.0 * a2 + 8.0 * a3 - 9.0 * a4, -5.0 * b1 + 6.0 * b2 + 8.0 * b3 - 9.0 * b4
        error = h * (abs(off_p) + abs(off_q)) / (72.0 * ORBIT_TOLERANCE)
        if not error < math.inf:
            h *= 0.25
            continue
        if error <= 1.0:
            p, q, a1, b1 = to_p, to_q, a4, b4
            taken += 1
            if taken % CHECK_INTERVAL == 0 and _is_captured(S, P, gain, m, p, q):
                return True
        h *= min(3.0, max(0.25, 0.8 * max(error, 1e-9) ** (-1.0 / 3.0)))
    return False


@kernel
def slides(S, P, gain, n, affine, known, n1, n2, theta):
    """Whether what arrives at Sigma at theta surely slides; the critical set is in place, at the z there.

    Parameters
    ----------
    S : (EXTENT,)
        As `slow` reads it, with z in place.
    P : (PARAMETERS,)
        With the parameter of Psi.
    gain : int64
        Address of Psi's.
    n : int
        2 + m.
    affine : bool
        U is affine in e.
    known : bool
        Psi is known: else only what every Psi gives is said.
    n1, n2 : float
        Along the invariant line of the motion, or 0.
    theta : float
    """
    m = n - 2
    if n1 != 0.0 or n2 != 0.0:
        return _in_line(S, m, n1, n2, theta)
    if affine and _on_the_only_set(S, m):
        return True
    if not known:
        return False
    angle = _limit_direction(S, m, theta)
    if not (angle == angle and _ends_on_a_set(S, P, gain, m, angle - START_ANGLE)):
        return False
    c, s = S[SET_PLACE], S[SET_PLACE + 1]
    if not _ends_on_a_set(S, P, gain, m, angle + START_ANGLE):
        return False
    return math.hypot(S[SET_PLACE] - c, S[SET_PLACE + 1] - s) < 1e-8
