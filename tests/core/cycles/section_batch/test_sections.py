"""Sections of many systems at once: row by row those of one system, and their turns."""

import math
from fractions import Fraction

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.cycles import periodic_orbit
from codim2_core.cycles.global_section import FINE_RTOL, Section
from codim2_core.cycles.periodic_orbit import path
from codim2_core.cycles.section_batch.sections import STEP_NODES, Sections, critical_points

# (a, b, d, f1, f2): foci of all senses, in the middle and out of it.
PLANES = np.array(
    [
        (1.0, 3.0, -2.0, 0.4, -0.3),
        (-0.3, -1.5, 0.5, 0.2, 0.9),
        (0.02, 0.08, -0.03, 0.0, 0.0),
        (2.0, -5.0, -1.0, -2.0, 3.5),
        (0.5, 2.0, -0.6, 1.2, 1.4),
    ]
)


def _one(plane, psi, ray):
    at = c2.ELinear(*plane[:3], tuple(plane[3:])).at()
    return Section(at, psi, c2.critical_sets(at, psi)[0], ray)


def _all(psi, ray, own=None):
    e, complement = critical_points(PLANES)
    return Sections(PLANES, e, complement, psi, own, ray)


@pytest.mark.parametrize(
    "plane",
    [
        (1.0, 0.5, 2.0, 0.1, 0.1),  # a d > 0
        (1.0, 0.5, -2.0, 0.1, 0.1),  # a saddle
        (0.0, 1.0, -1.0, 0.1, 0.1),
        (1.0, 3.0, -2.0, 9.0, 0.0),  # outside
    ],
)
def test_where_no_cycle_can_be_the_complement_is_not_positive(plane):
    assert critical_points(np.array([plane, PLANES[0]]))[1][0] <= 0.0
    assert critical_points(np.array([plane, PLANES[0]]))[1][1] > 0.0


@pytest.mark.parametrize("near", [1e-3, 1e-12, 1e-15])
def test_near_the_equator_and_near_a_double_zero_all_digits_are_kept(near):
    """By exact arithmetic with the given doubles."""
    rows = []
    for angle in (0.3, 2.0, 4.5):
        r = math.sqrt(1.0 - near)
        for a, b, d in ((1.0, 3.0, -2.0), (1.0, math.sqrt(2.0) * (1.0 + near), -2.0)):
            f = -np.array([[a, -b], [b, d]]) @ [r * math.cos(angle), r * math.sin(angle)]
            rows.append((a, b, d, *f))
    e, complement = critical_points(np.array(rows))
    for row, place, gap in zip(rows, e, complement, strict=True):
        a, b, d, f1, f2 = map(Fraction, row)
        det, n1, n2 = a * d + b * b, d * f1 + b * f2, a * f2 - b * f1
        exact = 1 - (n1 * n1 + n2 * n2) / (det * det)
        np.testing.assert_allclose(place, [float(-n1 / det), float(-n2 / det)], rtol=1e-14)
        assert gap == pytest.approx(float(exact), rel=1e-13, abs=0.0)


@pytest.mark.parametrize("back", [False, True])
def test_turns_are_those_of_one_system(back, monkeypatch):
    """Ends, and the nodes of all steps; those that do not return are left out."""
    monkeypatch.setattr(periodic_orbit, "STEP_NODES", STEP_NODES)
    psi, ray = c2.psi.hill(3), 0
    many, backward = _all(psi, ray), np.full(5, back)
    backward[1] = not back
    xi = np.array([0.0, -1.0, 0.5, -0.5, -2.0])
    starts = np.array([_one(plane, psi, ray).states(x[None])[0][0] for plane, x in zip(PLANES, xi, strict=True)])
    rows, ways = many.integrate_turns(starts, FINE_RTOL, backward)
    paths = [path(_one(p, psi, ray), s, FINE_RTOL, bool(b)) for p, s, b in zip(PLANES, starts, backward, strict=True)]
    assert rows.tolist() == [i for i, one in enumerate(paths) if one is not None]
    assert len(rows) > 2
    assert ways.first[0] == 0
    assert ways.first[-1] == len(ways.whose) == len(ways.inner) == STEP_NODES * len(ways.h)
    for k, i in enumerate(rows):
        own = slice(ways.first[k], ways.first[k + 1])
        assert (ways.whose[own] == k).all()
        np.testing.assert_allclose(ways.ends[k], paths[i].end, rtol=1e-7, atol=1e-9)
        lengths = ways.h[own.start // STEP_NODES : own.stop // STEP_NODES]
        assert lengths.sum() == pytest.approx(paths[i].time, rel=1e-8)
        if len(lengths) == len(paths[i].h):
            np.testing.assert_allclose(ways.inner[own], paths[i].inner, atol=1e-6)  # of other steps by rounding
