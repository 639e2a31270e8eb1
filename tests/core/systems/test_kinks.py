"""U with kinks in e, as friction engineers write it: everything is found, and no NaN passes on silently."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.portrait.layer_problem.disc_zeros import disc_zeros

HILL = c2.psi.hill(2)
CORNERS = c2.System(U=("-c-0.3*abs(s)", "-s"))
KINKED = (
    CORNERS,
    c2.System(U=("-c-0.3|s|+0.2", "-s+0.1|c|")),
    c2.System(U=("-c+0.5*abs(c-0.3)", "-s+0.2")),
    c2.System(U=("-c+abs(abs(s)-0.5)", "-0.4s-0.1")),
    c2.System(U=("-c-0.3*min(s, 0.2)", "-s")),
    c2.System(U=("-max(c, 2c) - 0.2s", "-max(s, 0.5s) + 0.1")),
    c2.System(U=("-c*(1 + 0.3*sqrt(c^2 + s^2)) + 0.1", "-s*(1 + 0.3*sqrt(c^2 + s^2))")),
)


def finite(*values):
    return all(np.isfinite(np.asarray(value, float)).all() for value in values)


@pytest.mark.parametrize("system", KINKED, ids=lambda system: ", ".join(u.text for u in system.U))
def test_a_kinked_law_goes_through_every_public_function(system):
    on = c2.equator_equilibria(system)
    assert finite(on.theta, on.lambda_rho, on.lambda_theta)
    for C in c2.critical_sets(system, HILL):
        assert finite(C.e, C.p, C.jacobian, C.trace, C.determinant)
        assert abs(system.at().U(C.e)).max() < 1e-12
    assert c2.classify(system, HILL).name
    for branch in c2.nullclines(system, HILL):
        assert finite(branch.points)
    c2.separatrices(system, HILL)
    c2.limit_cycles(system, HILL)
    c2.approach_outcomes(system, HILL)
    limit = c2.simulate_nonsmooth(system, (1.0, 0.5), (0.0, 2.0), psi=HILL)
    assert limit.phases[0].kind == "slip"
    assert finite(limit.states)
    near = c2.simulate(system, HILL, (1.0, 0.5), (0.0, 2.0), eps=1e-5)
    np.testing.assert_allclose(near.states[-1], limit.states[-1], atol=1e-3)
    for points in c2.trajectories(system, HILL, [(0.3, 0.4), (1.2, 0.5)]).points:
        assert finite(points)


@given(st.floats(0.05, 3.1), st.floats(0.05, 3.1))
@settings(max_examples=20, deadline=None)
def test_directions_of_a_piecewise_linear_law_are_those_of_its_pieces(k, f):
    """U = (-c - k|s|, -f): Theta = -f c + s c + k s|s|, on either half circle a smooth law with known zeros."""
    found = c2.equator_equilibria(c2.System(U=("-c - k*|s|", "-f"), parameters={"k": k, "f": f})).theta
    expected = []
    for side, inside in ((1.0, lambda t: math.sin(t) > 0), (-1.0, lambda t: math.sin(t) < 0)):
        piece = c2.System(U=("-c - k*s", "-f"), parameters={"k": side * k, "f": f})
        expected += [t for t in c2.equator_equilibria(piece).theta if inside(t)]
    np.testing.assert_allclose(found, sorted(expected), rtol=0.0, atol=1e-9)


@pytest.mark.parametrize(
    ("U", "J"),
    [
        (("-c-c**0*s+0.3*s**2", "-s+c"), [[-1.0, -1.0], [1.0, -1.0]]),
        (("-c-c**k*s+0.3*s**2", "-s+c"), [[-1.0, -1.0], [1.0, -1.0]]),
        (("-c*(0.2+0.1*exp(-sqrt(c**2+s**2)))-0.5*s", "-s*(0.2+0.1*exp(-sqrt(s*s+c*c)))+0.3*c"),
         [[-0.3, -0.5], [0.3, -0.3]]),
        (("-c*(0.2+0.1*exp(-(c**2+s**2)**0.5))-0.5*s", "-s*0.3+0.3*c"), [[-0.3, -0.5], [0.3, -0.3]]),
        (("-c*(1+sqrt(c**2))", "-s*(1+sqrt(4*s**2))"), [[-1.0, 0.0], [0.0, -1.0]]),
    ],
)  # fmt: skip
def test_derivatives_at_the_centre_are_no_nan(U, J):
    system = c2.System(U=U, parameters={"k": 0.0})
    (C,) = c2.critical_sets(system, c2.psi.constant())
    np.testing.assert_allclose(C.jacobian, J, rtol=0.0, atol=1e-9)
    assert C.kind.startswith("stable")
    found = c2.classify(system, c2.psi.constant())
    assert not [d.name for d in found.degeneracies if d.name in ("index mismatch", "degenerate critical set")]
    np.testing.assert_allclose(system.at().DU((0.0, 0.0)), J, rtol=0.0, atol=1e-9)
    c2.separatrices(system, c2.psi.constant())


def test_what_jumps_in_e_is_refused_and_what_jumps_in_z_is_not():
    for U in (("-sign(c)", "-s"), ("-c", "-s + sign(x)"), ("sign(c + z) - c", "-s")):
        with pytest.raises(ValueError, match="it jumps there, on a discontinuity set of codimension 1"):
            c2.System(U=U)
    with pytest.raises(ValueError, match="W1 has the sign"):
        c2.System(U=("-c", "-s"), W=("sign(s)",))
    system = c2.System(U=("-c + 0.2*sign(z)", "-s"))
    assert c2.critical_sets(system, HILL, -3.0)[0].e.tolist() == [-0.2, 0.0]
    with pytest.raises(ValueError, match="write c for x/sqrt"):
        c2.System(U=("-x/sqrt(x^2+y^2)", "-s"))
    with pytest.raises(ValueError, match="write c for x/sqrt"):
        c2.System(U=("-c", "2*y/(x**2+y**2)**0.5"))


@pytest.mark.parametrize(
    ("U", "e", "index"),
    [
        (("-(sqrt(max(s, 0)) - sqrt(max(-s, 0)))", "-c + 0.1"), (0.1, 0.0), -1),
        (("-(sqrt(max(c, 0)) - sqrt(max(-c, 0)))", "-s - 0.2"), (0.0, -0.2), 1),
        (("-(max(c - 0.2, 0)**0.5 - max(0.2 - c, 0)**0.5)", "-s + 0.1"), (0.2, 0.1), 1),
    ],
)
def test_a_zero_with_an_infinite_slope_is_found_with_its_index(U, e, index):
    system = c2.System(U=U)
    (C,) = c2.critical_sets(system, c2.psi.tanh())
    np.testing.assert_allclose(C.e, e, atol=1e-6)
    assert C.kind in (("saddle",) if index < 0 else ("degenerate",))
    found = disc_zeros(system.at().key)
    assert found.index.tolist() == [index]
    assert found.consistent
    named = c2.classify(system, c2.psi.tanh())
    assert named.name.startswith("1 critical set")
    assert ("corner at a critical set" in [d.name for d in named.degeneracies]) == (C.kind == "degenerate")


def test_a_limit_that_is_no_value_is_refused_with_what_to_write():
    with pytest.raises(ValueError, match=r"no value at e = \(0, 0\).*log\(abs\(c\) \+ 1e-300\)"):
        c2.classify(c2.System(U=("c*log(abs(c)) - s", "-s - c")), c2.psi.tanh())
    named = c2.classify(c2.System(U=("c*log(abs(c) + 1e-300) - s", "-s - c")), c2.psi.tanh())
    assert named.name.startswith("3 critical sets")
