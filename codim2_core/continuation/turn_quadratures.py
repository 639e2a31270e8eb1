"""Compiled: what is measured on turns, and their derivatives; see `turns` for the formulas."""

from __future__ import annotations

import math

import numpy as np

from ..jit import kernel
from .turn_columns import AMPLITUDE, BY_XI, CHI, EXPONENT, HEIGHT, PARAMETERS, PERIOD, RATE, SHIFT

MAX_EXPONENT = 600.0
MIN_EIGENVALUE = 1e-280  # eigenvalue of D e_Psi


@kernel
def _across(v0, v1, w0, w1):
    return v0 * w1 - v1 * w0


@kernel
def _lift_change(c, s, radial, tangential, along, v0, v1):
    """Find dx2 for a change v of e, at the direction (c, s) of x2; its part along x2 is given apart, with its digits.

    Far out ``dx2/dr`` and dx2/dmu at fixed r are huge, both along x2, while orbits see only small differences of them.
    """
    across = (c * v1 - s * v0) / tangential
    return along / radial * c - across * s, along / radial * s + across * c


@kernel
def _unit_vector(x, y):
    zeta = math.sqrt(x * x + y * y)
    return (x / zeta, y / zeta) if zeta > 0.0 else (1.0, 0.0)


@kernel
def _level(c, s, radial, tangential, swelling, v0, v1, u0, u1, still):
    """Find dx2/dmu on the section at fixed y, where e moves by v."""
    vr, vp = c * v0 + s * v1 - swelling, c * v1 - s * v0
    ur, up = c * u0 + s * u1, c * u1 - s * u0
    narrow = radial / tangential
    size = ur * ur + narrow * up * up
    twist = (vr * up - vp * ur) / tangential
    along, across = (twist * up - still * ur) / size, -(twist * ur + narrow * still * up) / size
    return along * c - across * s, along * s + across * c


@kernel
def _integrals(plane, e0, e1, rho, inner, tangential, radial, first, last, h, sign, weights, matrix, U, out):
    """Write exp(E(tau, end)), F and e at the nodes of one turn; return its exponent and its time in tau.

    U : (6, k)
        Room: weight in tau times exp(E(tau, end)), F (2), e (2), rate of the exponent.
    """
    a, b, d = plane[0], plane[1], plane[2]
    nodes = len(weights)
    exponent, period = 0.0, 0.0
    for j in range(first, last):
        x, y = inner[j, 0] / inner[j, 2], inner[j, 1] / inner[j, 2]
        c, s = _unit_vector(x, y)
        divergence = tangential[j] * (a + d) + (radial[j] - tangential[j]) * (a * c * c + d * s * s)
        weight = h[j // nodes] * weights[j % nodes] / inner[j, 2]
        period += weight
        exponent += sign * weight * divergence
        U[3, j], U[4, j] = x * tangential[j], y * tangential[j]
        g0, g1 = U[3, j] - e0, U[4, j] - e1
        U[1, j], U[2, j] = a * g0 - b * g1, b * g0 + d * g1
        U[0, j] = weight
        U[5, j] = sign * divergence / inner[j, 2]
    past = 0.0
    for step in range(first // nodes, last // nodes):
        whole = 0.0
        for k in range(nodes):
            part = 0.0
            for m in range(nodes):
                part += matrix[k, m] * U[5, step * nodes + m]
            whole += weights[k] * U[5, step * nodes + k]
            U[0, step * nodes + k] *= math.exp(min(exponent - past - h[step] * part, MAX_EXPONENT))
        past += h[step] * whole
    out[EXPONENT], out[PERIOD] = sign * exponent, period / rho
    return exponent


@kernel
def _extent(inner, p0, p1, first, last, out):
    """Write the amplitude, by a parabola through the three places about the largest, and the height of one turn."""
    top, at, height = -1.0, first, math.inf
    for j in range(first, last):
        away = math.hypot(inner[j, 0] - p0, inner[j, 1] - p1)
        if away > top:
            top, at = away, j
        height = min(height, inner[j, 2])
    i, k = at - 1 if at > first else last - 1, at + 1 if at + 1 < last else first
    before = math.hypot(inner[i, 0] - p0, inner[i, 1] - p1)
    after = math.hypot(inner[k, 0] - p0, inner[k, 1] - p1)
    bend = before - 2.0 * top + after
    out[AMPLITUDE] = top if bend >= 0.0 else top - (after - before) ** 2 / (8.0 * bend)
    out[HEIGHT] = height


@kernel
def turn_quadratures(
    plane, changes, rho, e, u, room, centre, x2, starts, ends, first, h, inner, radial, tangential, swelling, sign,
    weights, matrix,
):  # fmt: skip
    """Measure n turns and differentiate them by q parameters.

    Parameters
    ----------
    plane : (n, 5)
        (a, b, d, f1, f2) in units of `rho` (n,).
    changes : (q, n, 5)
        Its derivatives.
    e, u : (n, 2)
        e_C, and the direction of the section.
    room : (n, 2)
        `reach` and `other` of the section.
    centre, x2 : (n, 2)
        x2 of C, and where the turns start.
    starts : (n, 3)
        r, reach - r and ``1 - |e|^2`` there.
    ends : (n, 3)
        States where they end.
    first : (n + 1,)
        Where the nodes of each begin.
    h : (k / number of weights,)
        Lengths of steps.
    inner : (k, 3)
        States at the nodes.
    radial, tangential : (k + 3 n,)
        Eigenvalues of D e_Psi at the nodes, the starts, the ends and the centres.
    swelling : (q, k + 3 n), or (q, 0)
        d|e_Psi|/dmu there, if Psi changes.
    sign : (n,)
        -1 for a turn backward in time.
    weights, matrix
        Of Gauss' method.

    Returns
    -------
    ndarray (n, PARAMETERS + 2 q)
        Then by_value of each parameter, and drift of each. NaN where the section has no room, or a number overflows.
    """
    n, q, k = len(plane), len(changes), len(inner)
    out = np.full((n, PARAMETERS + 2 * q), np.nan)
    U = np.empty((6, k))
    varies = swelling.shape[1] > 0
    for i in range(n):
        a, b, d = plane[i, 0], plane[i, 1], plane[i, 2]
        e0, e1, u0, u1, R, S = e[i, 0], e[i, 1], u[i, 0], u[i, 1], room[i, 0], room[i, 1]
        r, rest, gap = starts[i, 0], starts[i, 1], starts[i, 2]
        s, t, m = k + i, k + n + i, k + 2 * n + i  # start, end, centre
        z0, z1 = ends[i, 0] / ends[i, 2], ends[i, 1] / ends[i, 2]
        away = x2[i, 0] - centre[i, 0], x2[i, 1] - centre[i, 1], z0 - centre[i, 0], z1 - centre[i, 1]
        y, after = u0 * away[0] + u1 * away[1], u0 * away[2] + u1 * away[3]
        if not (y > 0.0 and after > 0.0 and min(radial[s], radial[t]) >= MIN_EIGENVALUE):
            continue
        exponent = _integrals(
            plane[i], e0, e1, rho[i], inner, tangential, radial, first[i], first[i + 1], h, sign[i], weights, matrix,
            U, out[i],
        )  # fmt: skip
        if abs(exponent) > MAX_EXPONENT:
            continue
        centre_p = 1.0 / math.sqrt(1.0 + centre[i, 0] ** 2 + centre[i, 1] ** 2)
        _extent(inner, centre[i, 0] * centre_p, centre[i, 1] * centre_p, first[i], first[i + 1], out[i])
        multiplier = math.exp(exponent)
        # F at both ends
        g0, g1 = x2[i, 0] * tangential[s] - e0, x2[i, 1] * tangential[s] - e1
        F0, F1 = sign[i] * (a * g0 - b * g1), sign[i] * (b * g0 + d * g1)
        g0, g1 = z0 * tangential[t] - e0, z1 * tangential[t] - e1
        G0, G1 = sign[i] * (a * g0 - b * g1), sign[i] * (b * g0 + d * g1)
        last_r = math.hypot(d * G0 + b * G1, a * G1 - b * G0) / (a * d + b * b)
        # dx2/dr there, and d ln y/dr
        c, v = _unit_vector(x2[i, 0], x2[i, 1])
        t0, t1 = _lift_change(c, v, radial[s], tangential[s], c * u0 + v * u1, u0, u1)
        C, V = _unit_vector(z0, z1)
        l0, l1 = _lift_change(C, V, radial[t], tangential[t], C * u0 + V * u1, u0, u1)
        rise, last_rise = (u0 * t0 + u1 * t1) / y, (u0 * l0 + u1 * l1) / after
        by_r = r * rest / R  # dr/dxi
        q_xi, across = rise * by_r, _across(G0, G1, l0, l1)
        square = 1.0 / (1.0 + y) ** 2
        out[i, SHIFT] = math.log(after / y)
        out[i, BY_XI] = last_rise * multiplier * _across(F0, F1, t0, t1) * by_r / across - q_xi
        out[i, RATE], out[i, CHI] = q_xi * y * square, y / (1.0 + y)
        for j in range(q):
            da, db, dd, d1, d2 = changes[j, i]
            # of e_C, u, reach and other
            m0, m1 = da * e0 - db * e1 + d1, db * e0 + dd * e1 + d2
            c0, c1 = -(d * m0 + b * m1) / (a * d + b * b), -(a * m1 - b * m0) / (a * d + b * b)
            angle = 0.5 * (da / a - dd / d) * u0 * u1
            w0, w1 = -angle * u1, angle * u0
            h0, h1, k0, k1 = e0 + R * u0, e1 + R * u1, e0 - S * u0, e1 - S * u1  # both on the equator
            by_R = -(h0 * (c0 + R * w0) + h1 * (c1 + R * w1)) / (h0 * u0 + h1 * u1)
            by_S = (k0 * (c0 - S * w0) + k1 * (c1 - S * w1)) / (k0 * u0 + k1 * u1)
            swell_s, swell_t, swell_m = 0.0, 0.0, 0.0
            if varies:
                swell_s, swell_t, swell_m = swelling[j, s], swelling[j, t], swelling[j, m]
            # dy/dmu at fixed x2
            p0, p1 = _unit_vector(centre[i, 0], centre[i, 1])
            n0, n1 = _lift_change(p0, p1, radial[m], tangential[m], p0 * c0 + p1 * c1 - swell_m, c0, c1)
            drawn = u0 * n0 + u1 * n1
            still, last_still = w0 * away[0] + w1 * away[1] - drawn, w0 * away[2] + w1 * away[3] - drawn
            # the start moves along s_0 with mu: xi is fixed there, and so is 1 - |e|^2 but for its factors
            share = by_R / R
            turned0, turned1 = c0 + r * (w0 + share * u0), c1 + r * (w1 + share * u1)
            widened = gap * (share + (r * share + by_S) / (r + S))
            modulus = min(math.hypot(e0 + r * u0, e1 + r * u1), 1.0)
            s0, s1 = _lift_change(c, v, radial[s], tangential[s], -0.5 * widened / modulus - swell_s, turned0, turned1)
            q_0 = (u0 * s0 + u1 * s1 + still) / y
            f0, f1 = _level(
                C, V, radial[t], tangential[t], swell_t, c0 + last_r * w0, c1 + last_r * w1, u0, u1, last_still
            )
            melnikov = 0.0
            for node in range(first[i], first[i + 1]):
                x, z = U[3, node], U[4, node]
                U0, U1 = da * x - db * z + d1, db * x + dd * z + d2
                if varies:
                    x, z = _unit_vector(inner[node, 0], inner[node, 1])
                    U0 += swelling[j, node] * (a * x - b * z)
                    U1 += swelling[j, node] * (b * x + d * z)
                melnikov += U[0, node] * _across(U[1, node], U[2, node], U0, U1)
            end = multiplier * _across(F0, F1, s0, s1) + melnikov - _across(G0, G1, f0, f1)
            out[i, PARAMETERS + j] = last_rise * end / across - q_0
            out[i, PARAMETERS + q + j] = q_0 * y * square
    return out
