"""Compiled: where sections of many e-linear systems lie, and what a turn from each needs and leaves; see `sections`."""

from __future__ import annotations

import math

import numpy as np

from ...jit import kernel
from ...layer_problem.border import CANCELS
from ...numerics import double_double
from ...stepping.field_parameters import PSI, SHARED_SIZE
from ..equator_pull import EQUATOR_CAPTURE_HEIGHT, MIN_HEIGHT, UNDERFLOW_HEIGHT
from ..global_section import INNER_CAPTURE_RATIO, INNER_RADIUS
from ..global_section_kernel import RETURNED, single_step

_add = kernel(double_double.add_pairs)
_product = kernel(double_double.product)


@kernel
def _abs_squared(pair):
    high, low = _product(pair[0], pair[0])
    return _add((high, low), (2.0 * pair[0] * pair[1], 0.0 * high))


@kernel
def critical_points(planes):
    """Find ``e_C = -A^-1 f`` (n, 2) and ``1 - |e_C|^2`` (n,) of (a, b, d, f1, f2) (n, 5), of any size.

    The complement is positive just where no theorem forbids cycles: a, d differ in sign, and C exists with det A > 0.
    """
    n = len(planes)
    e, complement = np.empty((n, 2)), np.empty(n)
    for i in range(n):
        power = -math.frexp(np.abs(planes[i]).max())[1]
        a, b, d = math.ldexp(planes[i, 0], power), math.ldexp(planes[i, 1], power), math.ldexp(planes[i, 2], power)
        f1, f2 = math.ldexp(planes[i, 3], power), math.ldexp(planes[i, 4], power)
        det, n1, n2 = a * d + b * b, d * f1 + b * f2, a * f2 - b * f1
        gap = det * det - n1 * n1 - n2 * n2
        if abs(gap) < CANCELS * det * det or abs(det) < CANCELS * (abs(a * d) + b * b):  # as `border.to_all_digits`
            whole = _add(_product(a, d), _product(b, b))
            one, two = _add(_product(d, f1), _product(b, f2)), _add(_product(a, f2), _product(-b, f1))
            s, t = _add(_abs_squared(one), _abs_squared(two))
            gap, det, n1, n2 = _add(_abs_squared(whole), (-s, -t))[0], whole[0], one[0], two[0]
        e[i, 0], e[i, 1] = -n1 / det, -n2 / det
        complement[i] = gap / (det * det) if a * d < 0.0 and det > 0.0 else -1.0
    return e, complement


@kernel
def rays(planes, e, complement, signs):
    """Return rate, the plane in its unit, u, room, and |e_C| and u.e_C (n, 2) of sections; `signs` (n, 2) of u."""
    n = len(planes)
    rate, plane, u, room, sides = np.empty(n), np.empty((n, 5)), np.empty((n, 2)), np.empty((n, 2)), np.empty((n, 2))
    for i in range(n):
        size, square = np.abs(planes[i]).max(), 0.0
        for c in range(5):
            square += (planes[i, c] / size) ** 2
        rate[i] = size * math.sqrt(square)
        for c in range(5):
            plane[i, c] = planes[i, c] / rate[i]
        a, d = abs(plane[i, 0]), abs(plane[i, 2])
        u[i, 0], u[i, 1] = signs[i, 0] * math.sqrt(d / (a + d)), signs[i, 1] * math.sqrt(a / (a + d))
        along = u[i, 0] * e[i, 0] + u[i, 1] * e[i, 1]
        root = math.sqrt(along * along + complement[i])
        room[i, 0] = complement[i] / (root + abs(along)) if along > 0.0 else root - along
        room[i, 1] = complement[i] / room[i, 0]
        sides[i, 0], sides[i, 1] = min(math.hypot(e[i, 0], e[i, 1]), 1.0), along
    return rate, plane, u, room, sides


@kernel
def linearise_at_critical(e, sides, room, zeta, radial, tangential):
    """Return x2 of C (n, 2), the eigenvalues (n, 2) of D e_Psi there, and the distance (n,) of the innermost sample."""
    n = len(e)
    x2, factors, inner = np.empty((n, 2)), np.empty((n, 2)), np.empty(n)
    for i in range(n):
        modulus = max(sides[i, 0], 1e-300)
        x2[i, 0], x2[i, 1] = zeta[i] / modulus * e[i, 0], zeta[i] / modulus * e[i, 1]
        factors[i, 0], factors[i, 1] = radial[i], tangential[i]
        along = sides[i, 1] / modulus
        inner[i] = (
            INNER_RADIUS * room[i, 0] * (1.0 / tangential[i] + along * along * (1.0 / radial[i] - 1.0 / tangential[i]))
        )
    return x2, factors, inner


@kernel
def section_points(e, u, room, xi):
    """Return r, reach - r, ``1 - |e|^2`` (n, 3), e (n, 2) and |e| (n,), at parameters (n,) of sections."""
    n = len(e)
    parts, place, modulus = np.empty((n, 3)), np.empty((n, 2)), np.empty(n)
    for i in range(n):
        r, rest = room[i, 0] / (1.0 + math.exp(-xi[i])), room[i, 0] / (1.0 + math.exp(xi[i]))
        parts[i, 0], parts[i, 1], parts[i, 2] = r, rest, rest * (r + room[i, 1])
        place[i, 0], place[i, 1] = e[i, 0] + r * u[i, 0], e[i, 1] + r * u[i, 1]
        modulus[i] = min(math.hypot(place[i, 0], place[i, 1]), 1.0)
    return parts, place, modulus


@kernel
def hemisphere(x2):
    """Return states (n, 3) = (p, ebar) at x2 (n, 2)."""
    states = np.empty((len(x2), 3))
    for i in range(len(x2)):
        length = math.hypot(1.0, math.hypot(x2[i, 0], x2[i, 1]))
        states[i, 0], states[i, 1], states[i, 2] = x2[i, 0] / length, x2[i, 1] / length, 1.0 / length
    return states


@kernel
def lanes(plane, parameters, backward, states, x2, inner):
    """Return what `global_section_kernel.returns` is given of each: parameters of the field, sense, floor and sunk."""
    n = len(plane)
    shared, sense, floor, sunk = np.zeros((n, SHARED_SIZE)), np.empty(n), np.empty(n), np.empty(n)
    for i in range(n):
        for c in range(5):
            shared[i, c] = -plane[i, c] if backward[i] else plane[i, c]
        shared[i, PSI] = parameters[i]
        sense[i] = -plane[i, 1] if backward[i] else plane[i, 1]
        w = states[i, 2]
        away = math.hypot(states[i, 0] / w - x2[i, 0], states[i, 1] / w - x2[i, 1])
        floor[i] = INNER_CAPTURE_RATIO * min(inner[i], away)
        sunk[i] = min(EQUATOR_CAPTURE_HEIGHT, max(UNDERFLOW_HEIGHT, MIN_HEIGHT / max(MIN_HEIGHT, min(w, 1.0))))
    return shared, sense, floor, sunk


@kernel
def collect_nodes(steps, codes, shared, nodes, field):
    """Return, of the turns that return: rows (k,), first node of each, h, and whose nodes are which and where.

    Steps (m, 5) as `global_section_kernel.returns` writes them, with its codes (n,); nodes (q,) of a step's length.
    """
    n, q = len(codes), len(nodes)
    count = np.zeros(n + 1, np.int64)
    for j in range(len(steps)):
        count[int(steps[j, 4]) + 1] += 1
    rows, first, place = np.empty(n, np.int64), np.zeros(n + 1, np.int64), np.full(n, -1)
    k = total = 0
    for i in range(n):
        if codes[i] == RETURNED:
            rows[k], place[i] = i, total
            total += count[i + 1]
            k += 1
            first[k] = q * total
    h, begin, length = np.empty(total), np.empty((q * total, 3)), np.empty(q * total)
    whose, own = np.empty(q * total, np.int64), np.empty(q * total, np.int64)
    number = np.empty(n, np.int64)
    for i in range(k):
        number[rows[i]] = i
    for j in range(len(steps)):
        i = int(steps[j, 4])
        if place[i] < 0:
            continue
        at = place[i]
        place[i] += 1
        h[at] = steps[j, 3]
        for m in range(q):
            for c in range(3):
                begin[q * at + m, c] = steps[j, c]
            length[q * at + m] = steps[j, 3] * nodes[m]
            own[q * at + m], whose[q * at + m] = i, number[i]
    return rows[:k], first[: k + 1], h, whose, single_step(begin, length, shared, own, field)


@kernel
def distances(inner, states, ends, zeta):
    """Return |x2| at nodes, where turns start and end, and at their centres, one after the other."""
    k, n = len(inner), len(states)
    out = np.empty(k + 3 * n)
    for j in range(k):
        out[j] = math.hypot(inner[j, 0] / inner[j, 2], inner[j, 1] / inner[j, 2])
    for i in range(n):
        out[k + i] = math.hypot(states[i, 0] / states[i, 2], states[i, 1] / states[i, 2])
        out[k + n + i] = math.hypot(ends[i, 0] / ends[i, 2], ends[i, 1] / ends[i, 2])
        out[k + 2 * n + i] = zeta[i]
    return out
