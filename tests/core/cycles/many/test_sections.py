"""Sections of many systems at once: row by row those of one system, and their turns."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.cycles import orbit
from codim2_core.cycles.many import placing
from codim2_core.cycles.many.sections import NODES, Sections, located
from codim2_core.cycles.orbit import path
from codim2_core.cycles.section import FINE, INNER, Section

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
EVERY_RAY = pytest.mark.parametrize("ray", range(4))


def _one(plane, psi, ray):
    at = c2.ELinear(*plane[:3], tuple(plane[3:])).at()
    return Section(at, psi, c2.critical_sets(at, psi)[0], ray)


def _all(psi, ray, own=None):
    e, complement = located(PLANES)
    return Sections(PLANES, e, complement, psi, own, ray)


def test_critical_sets_are_those_of_each_system():
    e, complement = located(PLANES)
    for plane, place, gap in zip(PLANES, e, complement, strict=True):
        a, b, d, f1, f2 = plane
        np.testing.assert_allclose([[a, -b], [b, d]] @ place, [-f1, -f2], rtol=1e-13, atol=1e-15)
        assert gap == pytest.approx(1.0 - place @ place, rel=1e-13)
    for power in (-900, 900):
        e_too, gap_too = located(np.ldexp(PLANES, power))
        np.testing.assert_array_equal(e_too, e)
        np.testing.assert_array_equal(gap_too, complement)


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
    assert located(np.array([plane, PLANES[0]]))[1][0] <= 0.0
    assert located(np.array([plane, PLANES[0]]))[1][1] > 0.0


@pytest.mark.parametrize("near", [1e-3, 1e-12, 1e-15])
def test_near_the_equator_and_near_a_double_zero_all_digits_are_kept(near):
    """By exact arithmetic with the given doubles."""
    rows = []
    for angle in (0.3, 2.0, 4.5):
        r = math.sqrt(1.0 - near)
        for a, b, d in ((1.0, 3.0, -2.0), (1.0, math.sqrt(2.0) * (1.0 + near), -2.0)):
            f = -np.array([[a, -b], [b, d]]) @ [r * math.cos(angle), r * math.sin(angle)]
            rows.append((a, b, d, *f))
    e, complement = located(np.array(rows))
    for row, place, gap in zip(rows, e, complement, strict=True):
        a, b, d, f1, f2 = map(Fraction, row)
        det, n1, n2 = a * d + b * b, d * f1 + b * f2, a * f2 - b * f1
        exact = 1 - (n1 * n1 + n2 * n2) / (det * det)
        np.testing.assert_allclose(place, [float(-n1 / det), float(-n2 / det)], rtol=1e-14)
        assert gap == pytest.approx(float(exact), rel=1e-13, abs=0.0)


@EVERY_RAY
@pytest.mark.parametrize("psi", [c2.psi.rational(), c2.psi.hill(3)], ids=lambda psi: psi.text)
def test_rows_are_sections_of_one_system(psi, ray):
    many = _all(psi, ray)
    xi = np.array([-4.0, 0.0, 1.5, -0.5, 3.0])
    parts, x2 = many.starts(xi)
    assert len(many) == 5
    for i, plane in enumerate(PLANES):
        one = _one(plane, psi, ray)
        assert many.rate[i] == pytest.approx(one.rate, rel=1e-14)
        np.testing.assert_allclose(many.plane[i], one.plane, rtol=1e-14)
        np.testing.assert_allclose(many.u[i], one.u, rtol=1e-14)
        np.testing.assert_allclose(many.room[i], [one.reach, one.other], rtol=1e-12)
        np.testing.assert_allclose(many.x2[i], one.critical.x2, rtol=1e-11, atol=1e-15)
        assert many.zeta[i] == pytest.approx(np.hypot(*one.critical.x2), rel=1e-11, abs=1e-15)
        assert many.inner[i] == pytest.approx(one.inner, rel=1e-10)
        (state,), _ = one.states(xi[i : i + 1])
        np.testing.assert_allclose(x2[i], state[:2] / state[2], rtol=1e-11, atol=1e-14)
        r, rest, gap = parts[i]
        assert r + rest == pytest.approx(one.reach, rel=1e-14)
        assert math.log(r / rest) == pytest.approx(xi[i], abs=1e-12)
        e = one.e + r * one.u
        assert gap == pytest.approx(1.0 - e @ e, rel=1e-9)


def test_the_innermost_sample_is_as_far_from_c_as_is_said():
    """In x2, to first order in INNER: d x2 = D(x2_C) INNER reach u."""
    for psi in (c2.psi.rational(), c2.psi.tanh()):
        many = _all(psi, 1)
        _, x2 = many.starts(np.full(5, math.log(INNER)))
        # |d x2| is sqrt(u . D^2 u); what is said is u . D u, which is no more and half of it at least here.
        away = np.hypot(*(x2 - many.x2).T)
        assert (many.inner <= 1.01 * away).all()
        assert (many.inner >= 0.3 * away).all()
        along = ((x2 - many.x2) * many.u).sum(axis=1)
        np.testing.assert_allclose(many.inner, along, rtol=1e-2)


def test_each_has_a_psi_and_a_ray_of_its_own():
    own, rays = np.array([1.0, 2.0, 3.0, 4.0, 6.0]), np.array([0, 1, 2, 3, 1])
    many = _all(c2.psi.hill(2), rays, own)
    rows = np.array([3, 1])
    some = many.taken(rows)
    assert len(some) == 2
    for i, (value, ray) in enumerate(zip(own.tolist(), rays.tolist(), strict=True)):
        one = _one(PLANES[i], c2.psi.hill(value), ray)
        np.testing.assert_allclose(many.x2[i], one.critical.x2, rtol=1e-10, atol=1e-14)
        np.testing.assert_allclose(many.u[i], one.u, rtol=1e-14)
    for name in ("rate", "plane", "e", "u", "room", "zeta", "x2", "inner", "own"):
        np.testing.assert_array_equal(getattr(some, name), getattr(many, name)[rows])
    zeta = np.array([0.7, 0.2])
    expected = [float(c2.psi.hill(own[i]).modulus(z)) for i, z in zip(rows, zeta, strict=True)]
    np.testing.assert_allclose(many.psi_at(rows).modulus(zeta), expected, rtol=1e-13)
    np.testing.assert_allclose(some.psi_at().modulus(zeta), expected, rtol=1e-13)
    assert _all(c2.psi.hill(2), 0).psi_at(rows).parameter == 2.0


def test_each_runs_forward_or_backward_by_itself():
    own = np.array([1.0, 2.0, 3.0, 4.0, 6.0])
    backward = np.array([True, False, False, True, False])
    many = _all(c2.psi.hill(2), 0, own)
    states = np.tile([0.1, 0.2, 0.9], (5, 1))
    rows, sense, _, _ = placing.lanes(many.plane, own, backward, states, many.x2, many.inner)
    for i, row in enumerate(rows):
        one = _one(PLANES[i], c2.psi.hill(own[i]), 0)
        np.testing.assert_allclose(row, one.shared(bool(backward[i])), rtol=1e-13)
        assert sense[i] == row[1]


@pytest.mark.parametrize("back", [False, True])
def test_turns_are_those_of_one_system(back, monkeypatch):
    """Ends, and the nodes of all steps; those that do not return are left out."""
    monkeypatch.setattr(orbit, "NODES", NODES)
    psi, ray = c2.psi.hill(3), 0
    many, backward = _all(psi, ray), np.full(5, back)
    backward[1] = not back
    xi = np.array([0.0, -1.0, 0.5, -0.5, -2.0])
    starts = np.array([_one(plane, psi, ray).states(x[None])[0][0] for plane, x in zip(PLANES, xi, strict=True)])
    rows, ways = many.turned(starts, FINE, backward)
    paths = [path(_one(p, psi, ray), s, FINE, bool(b)) for p, s, b in zip(PLANES, starts, backward, strict=True)]
    assert rows.tolist() == [i for i, one in enumerate(paths) if one is not None]
    assert len(rows) > 2
    assert ways.first[0] == 0
    assert ways.first[-1] == len(ways.whose) == len(ways.inner) == NODES * len(ways.h)
    for k, i in enumerate(rows):
        own = slice(ways.first[k], ways.first[k + 1])
        assert (ways.whose[own] == k).all()
        np.testing.assert_allclose(ways.ends[k], paths[i].end, rtol=1e-7, atol=1e-9)
        lengths = ways.h[own.start // NODES : own.stop // NODES]
        assert lengths.sum() == pytest.approx(paths[i].time, rel=1e-8)
        if len(lengths) == len(paths[i].h):
            np.testing.assert_allclose(ways.inner[own], paths[i].inner, atol=1e-6)  # of other steps by rounding


def test_where_none_returns_there_are_no_turns():
    """C attracts from near by: what starts within it is gone before it comes round."""
    planes = np.array([(1.0, 1.5, -60.0, 0.0, 0.0)])
    e, complement = located(planes)
    assert complement[0] < 0.0
    planes = np.array([(0.01, 0.7, -40.0, 0.0, 0.0)])
    e, complement = located(planes)
    many = Sections(planes, e, complement, c2.psi.rational(), None, 0)
    _, x2 = many.starts(np.array([0.0]))
    height = 1.0 / math.hypot(1.0, *x2[0])
    rows, ways = many.turned(np.array([[*(height * x2[0]), height]]), FINE, np.array([False]))
    assert len(rows) == 0
    assert ways is None


def test_turns_under_a_psi_of_each():
    """Also where that of the family is whole and others are not."""
    own = np.array([1.3, 2.0, 2.5, 3.7, 6.0])
    many = _all(c2.psi.hill(2), 0, own)
    ones = [_one(plane, c2.psi.hill(value), 0) for plane, value in zip(PLANES, own.tolist(), strict=True)]
    starts = np.array([one.states(np.zeros(1))[0][0] for one in ones])
    rows, ways = many.turned(starts, FINE, np.zeros(5, bool))
    assert len(rows) > 2
    for k, i in enumerate(rows):
        np.testing.assert_allclose(ways.ends[k], path(ones[i], starts[i], FINE, False).end, rtol=1e-7, atol=1e-9)


@pytest.mark.parametrize("psi", [c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(2.5)])
def test_the_trace_at_c_is_that_of_its_critical_set(psi):
    found = _all(psi, 0)
    for plane, trace, rate in zip(PLANES, found.trace, found.rate, strict=True):
        (C,) = c2.critical_sets(c2.ELinear(*plane[:3], tuple(plane[3:])), psi)
        assert trace * rate == pytest.approx(C.trace, rel=1e-12, abs=1e-14 * rate)
