"""Points of the bifurcation curves in 50 digits: how far the function that vanishes there is from zero.

The unit is what one rounding of a, b, d, f1, f2 does to that function.
"""

import math

import mpmath as mp
import numpy as np
import pytest

from codim2_core import ELinear, bifurcations, critical_sets, psi
from codim2_core.portrait.layer_problem.lyapunov import psi_derivatives

from .reference import CRITICAL, DIGITS, critical, measure, regularisation

MATRICES = [(172.0, 186.0, -200.0), (1.0, 1.5, -1.2), (2.0, -1.4, -0.7), (0.3, 1.0, -2.0)]
FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3), psi.hill(0.7)]
BOUND = 20.0


class Hill:
    """As much of a Psi as the reference reads, with an n of 50 digits."""

    family, text = "hill", ""

    def __init__(self, n):
        self.parameter = n


def sample(branches, count):
    for branch in branches:
        yield from branch[:: max(1, len(branch) // count)].tolist()


@pytest.mark.parametrize("family", FAMILIES, ids=lambda p: p.text)
@pytest.mark.parametrize("abd", MATRICES)
def test_hopf_and_node_focus_points(abd, family):
    for curve, name in ((bifurcations.hopf, "trace"), (bifurcations.node_focus, "discriminant")):
        for f1, f2 in sample(curve(ELinear(*abd), family).branches, 4):
            found = critical_sets(ELinear(*abd, (f1, f2)), family)
            # next to the equator the place itself is known to no more digits than 1 - |e| has
            if not found or np.hypot(*found[0].e) > 1 - 1e-3 or np.hypot(*found[0].e) < 1e-3:
                continue
            start = math.hypot(*found[0].x2)
            zero = lambda q, start=start, name=name: [critical(family, start)(q)[CRITICAL.index(name)]]
            assert measure([0.0], zero, (*abd, f1, f2))[0] < BOUND, (name, f1, f2)


def fold(q):
    """The discriminant of Theta as a quartic in exp(i theta): zero where two of its zeros meet."""
    a, b, d, f1, f2 = q
    m, c1, s1, s2 = b, f2, -f1, (d - a) / 2
    r2, r1, p = s2 * s2, c1 * c1 + s1 * s1, 2 * s2 * c1 * s1
    i, j = 12 * r2 - 3 * r1 + 4 * m * m, m * (72 * r2 + 9 * r1 - 8 * m * m) - 27 * p
    return [i**3 - j * j]


def border(q):
    """``det(A)^2 - |adj(A) f|^2``: zero where the critical set reaches the equator."""
    a, b, d, f1, f2 = q
    det, n1, n2 = a * d + b * b, d * f1 + b * f2, a * f2 - b * f1
    return [det * det - n1 * n1 - n2 * n2]


@pytest.mark.parametrize("abd", [*MATRICES, (-1.0, 0.0, -1.5), (-2.0, 0.3, -1.0), (3.0, 1.0, 3.0), (1.0, 0.3, -2.0)])
def test_saddle_node_and_transcritical_points(abd):
    for curve, zero in ((bifurcations.saddle_node, fold), (bifurcations.critical_boundary, border)):
        found = curve(ELinear(*abd))
        special = [s.place for s in found.special]
        size = max(map(abs, abd))
        for f in sample(found.branches, 40):
            # at a cusp the discriminant vanishes to higher order, and first-order rounding says nothing
            if zero is fold and any(math.dist(f, place) < 1e-2 * size for place in special):
                continue
            assert measure([0.0], zero, (*abd, *f))[0] < BOUND, (zero.__name__, f)


@pytest.mark.parametrize(
    "plane", [(172.0, 186.0, -200.0, -86.0, -93.0), (1.0, 1.5, -1.2, -0.45, -0.78), (-1.0, 0.8, -2.0, 0.82, 0.4)]
)
def test_values_of_n_where_the_kind_changes(plane):
    """n of the Hill family in 50 digits, against what one rounding of the coefficients does to it."""
    changes = bifurcations.hill_changes(ELinear(*plane[:3], plane[3:]))
    assert changes
    for change in changes:
        name = "trace" if change.type == "Hopf" else "discriminant"

        start = math.hypot(*critical_sets(ELinear(*plane[:3], plane[3:]), psi.hill(change.n))[0].x2)

        def root(q, n0=change.n, name=name, start=start):
            def value(n):
                return critical(Hill(n), start)(q)[CRITICAL.index(name)]

            return [mp.findroot(value, (mp.mpf(n0), mp.mpf(n0) * (1 + mp.mpf(10) ** -12)), tol=mp.mpf(10) ** -70)]

        assert measure([change.n], root, plane)[0] < 100.0, change
    if plane[0] == 172.0:
        assert min(abs(change.n - 284 / 129) for change in changes) < 1e-14


@pytest.mark.parametrize("family", FAMILIES, ids=lambda p: p.text)
def test_three_derivatives_of_psi(family):
    value, _ = regularisation(family)
    s = np.array([1e-12, 1e-8, 1e-3, 0.07, 0.24, 0.4, 1.3, 5.0, 11.0])
    found = psi_derivatives(family, s)
    with mp.workdps(DIGITS):
        for k in range(3):
            for i, at in enumerate(s.tolist()):
                exact = mp.diff(value, mp.mpf(at), k + 1)
                scale = abs(exact) + abs(value(mp.mpf(at))) * (1 if family.family == "tanh" else 0)
                assert abs(found[k][i] - exact) <= 3e-14 * scale + 1e-300, (k, at)
