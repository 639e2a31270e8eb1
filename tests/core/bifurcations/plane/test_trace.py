"""Hopf and node-focus curves against sign changes of tr J and of its discriminant along circles |e| = m."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, bifurcations, psi
from tests.core.polylines import away

CHORD = 1e-3


def jacobian_numbers(A, p, e):
    """tr J and tr(J)^2 - 4 det J, in units of J."""
    m = float(np.hypot(*e))
    radial, tangential = (v[0] for v in p.jacobian_factors(p.radius(np.array([m]))))
    u = e / m
    J = A @ (tangential * np.eye(2) + (radial - tangential) * np.outer(u, u))
    size = np.abs(J).max()
    return np.trace(J) / size, (np.trace(J) ** 2 - 4.0 * np.linalg.det(J)) / size**2


def farthest(a, b, d, p, curve, which, moduli):
    """Largest distance, in e, of a sign change on the circles from the curve."""
    A = np.array([[a, -b], [b, d]])
    lines = [-np.linalg.solve(A, line.T).T for line in curve.branches]

    def value(m, t):
        return jacobian_numbers(A, p, m * np.array([math.cos(t), math.sin(t)]))[which]

    worst = 0.0
    for m in moduli:
        angles = np.linspace(0.0, 2.0 * math.pi, 61) + 0.013
        values = np.array([value(m, t) for t in angles])
        for i in np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1])):
            low, high = angles[i], angles[i + 1]
            for _ in range(40):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if (value(m, middle) < 0.0) == (values[i] < 0.0) else (low, middle)
            e = m * np.array([[math.cos(low), math.sin(low)]])
            worst = max(worst, min(away(e, line)[0] for line in lines))
    return worst


@pytest.mark.parametrize("which", [0, 1])
def test_where_a_and_minus_d_are_close_no_arc_is_lost(which):
    """The trace changes sign at |e| = 0.920, where a gap of moduli narrower than a step was joined across."""
    plane = 0.768175071389422, -1.4846474812043078, -0.7712348432735607
    curve = (bifurcations.hopf, bifurcations.node_focus)[which](ELinear(*plane), psi.hill(6))
    assert farthest(*plane, psi.hill(6), curve, which, [0.3, 0.6, 0.8, 0.9, 0.92, 0.95, 0.99]) < CHORD


families = st.one_of(
    st.sampled_from([psi.constant(), psi.rational(), psi.exponential(), psi.tanh()]), st.integers(2, 12).map(psi.hill)
)


@settings(max_examples=8)
@given(
    st.floats(0.2, 2.0), st.floats(-7.0, 0.0), st.floats(0.01, 1.0), st.booleans(), families, st.sampled_from([0, 1])
)
def test_curves_pass_every_sign_change(a, exponent, more, swapped, p, which):
    d = -a * (1.0 + 10.0**exponent)
    b = math.sqrt(-a * d) * (1.01 + more)
    a, d = (d, a) if swapped else (a, d)
    curve = (bifurcations.hopf, bifurcations.node_focus)[which](ELinear(a, b, d), p)
    assert farthest(a, b, d, p, curve, which, np.linspace(0.05, 0.99, 8)) < CHORD
    A = np.array([[a, -b], [b, d]])
    for line in curve.branches:
        for f in line[:: max(len(line) // 20, 1)]:
            e = -np.linalg.solve(A, f)
            if 1e-3 < np.hypot(*e) < 0.999:
                assert abs(jacobian_numbers(A, p, e)[which]) < 1e-9
