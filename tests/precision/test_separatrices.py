"""Directions in which separatrices leave their saddles, in 50 digits."""

import math

import mpmath as mp
import pytest

from codim2_core import ELinear, critical_sets, psi, separatrices

from .reference import CRITICAL, critical, measure

SADDLES = [
    (1.0, 0.3, -2.0, 0.2, 0.3),
    (2.0, 0.0, -0.5, -0.9, 0.2),
    (-0.7, 0.4, 1.9, 0.31, -0.62),
    (100.0, 10.0, -25.0, -19.0, 2.0),
]
FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(4)]


def tangents(family, start):
    """Angles mod pi, in the disc, of the two eigendirections of a saddle: first the unstable one."""

    def angles(q):
        v = dict(zip(CRITICAL, critical(family, start)(q), strict=True))
        out = []
        for value in (v["eigenvalue 1"], v["eigenvalue 2"]):
            # (J - value) t = 0, then p = x2/sqrt(1 + |x2|^2)
            t = (v["J12"], value - v["J11"])
            if abs(t[0]) + abs(t[1]) < abs(v["J21"]) + abs(value - v["J22"]):
                t = (value - v["J22"], v["J21"])
            x, y = v["x2"], v["y2"]
            along = (x * t[0] + y * t[1]) / (1 + x * x + y * y)
            out.append(mp.atan2(t[1] - along * y, t[0] - along * x))
        return out

    return angles


@pytest.mark.parametrize("family", FAMILIES, ids=lambda p: p.text)
@pytest.mark.parametrize("plane", SADDLES)
def test_directions_at_a_saddle(plane, family):
    at = ELinear(*plane[:3], plane[3:])
    (C,) = critical_sets(at, family)
    exact = tangents(family, math.hypot(*C.x2))
    found = separatrices(at, family)
    with mp.workdps(50):
        wanted = [float(v) for v in exact([mp.mpf(v) for v in plane])]
    count = 0
    for branch in found:
        if branch.origin != "C":
            continue
        count += 1
        k = 0 if branch.direction == "unstable" else 1
        turns = round((branch.departure_angle - wanted[k]) / math.pi)
        reported = list(wanted)
        reported[k] = branch.departure_angle - turns * math.pi
        # an angle is an absolute number, and pi itself is rounded once in turning it
        assert measure(reported, exact, plane, [2.0 * math.pi] * 2)[k] < 30.0
    assert count == 4
