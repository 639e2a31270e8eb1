"""The panel "3-D": what is sent lies where the core says, at a setting without symmetry; nothing is mirrored."""

import numpy as np
import pytest

import codim2_core as c2

from .test_panels_of_motion import sent, solid

NAMES = ("a", "b", "d", "f1", "f2", "k1", "k2", "B1", "B2", "g0")
VALUES = dict(zip(NAMES, (-2.1, 0.3, -1.3, -0.25, 0.2, 0.6, -0.25, 1.2, -0.4, 0.3), strict=True))
SYSTEM = c2.ELinear(-2.1, 0.3, -1.3, ("-0.25 + 0.6*z", "0.2 - 0.25*z"), B=[[1.2, -0.4]], g=[0.3])
PSI = c2.psi.rational()


@pytest.fixture(scope="module")
def sphere():
    return sent(solid, psi="rational", **VALUES)


def test_limit_vectors_are_those_of_the_system(sphere):
    found = sent(solid, psi="rational", solid="filippov", z=0.7, **VALUES)["filippov"]
    theta = np.linspace(0.0, 2.0 * np.pi, len(found["curve"]))
    e = np.column_stack([np.cos(theta), np.sin(theta)])
    at = SYSTEM.at((0.7,))
    np.testing.assert_allclose(found["curve"], np.column_stack([at.U(e), at.W(e)]), rtol=1e-3, atol=1e-3)
    (C,) = c2.critical_sets(SYSTEM, PSI, (0.7,))
    ((flow, kind),) = found["selected"]
    assert flow == pytest.approx(C.slow_flow[0])
    assert kind == C.kind
    for candidate, ends in zip(found["candidates"], found["combined"], strict=True):
        u = np.array(ends)
        assert np.linalg.matrix_rank(u[:, :2], tol=2e-2) < 2 or len(u) > 2  # they combine to U = 0
        weights = np.linalg.lstsq(np.vstack([u[:, :2].T, np.ones(len(u))]), [0, 0, 1], rcond=None)[0]
        assert weights @ u[:, 2] == pytest.approx(candidate, abs=2e-2)


def test_critical_sets_of_the_stack_lie_over_z_and_move_as_the_slow_flow_says(sphere):
    stack = sphere["stack"]
    low, high = stack["span"]
    assert stack["sets"]
    for one in stack["sets"]:
        for x, y, height in one["points"][2:-2:9]:
            sets = c2.critical_sets(SYSTEM, PSI, (low + height * (high - low),))
            places = [np.array(C.x2) / np.sqrt(1 + np.sum(np.square(C.x2))) for C in sets]
            near = int(np.argmin([np.hypot(*(place - [x, y])) for place in places]))
            np.testing.assert_allclose(places[near], [x, y], atol=5e-3)
            assert sets[near].kind.startswith("stable") == one["stable"]
        middle = one["points"][len(one["points"]) // 2]
        (C, *_) = c2.critical_sets(SYSTEM, PSI, (low + middle[2] * (high - low),))
        assert one["flow"] == np.sign(C.slow_flow[0])


def test_the_plane_of_combinations_is_spanned_by_u_and_w():
    """Its corners are those of a square of (lambda1, lambda2), one after the other; it crosses Sigma once."""
    found = sent(solid, psi="rational", solid="filippov", z=0.7, **VALUES)["filippov"]
    at = SYSTEM.at((0.7,))
    corners = np.array(found["plane"])
    weights = np.linalg.solve(at.A, (corners[:, :2] - at.f).T).T
    reach = weights[0, 0]
    assert reach > 1.1
    np.testing.assert_allclose(weights, reach * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]), atol=2e-3)
    np.testing.assert_allclose(corners[:, 2], (weights @ at.B.T + at.g)[:, 0], atol=2e-3)
    place = np.linalg.solve(at.A, -at.f)
    assert found["cross"] == pytest.approx(float((at.B @ place + at.g)[0]), abs=1e-3)


def test_limit_directions_of_the_stack_lie_over_z_with_both_their_signs(sphere):
    stack = sphere["stack"]
    low, high = stack["span"]
    told = set()
    for height, theta, arrives, gathers in stack["directions"][::7]:
        found = c2.equator_equilibria(SYSTEM, (low + height * (high - low),))
        near = int(np.argmin(np.abs(np.remainder(found.theta - theta + np.pi, 2.0 * np.pi) - np.pi)))
        assert np.cos(found.theta[near] - theta) > 1.0 - 1e-4
        rates = found.lambda_rho[near], found.lambda_theta[near]
        if min(map(abs, rates)) > 1e-2:
            assert (arrives, gathers) == (rates[0] < 0.0, rates[1] < 0.0)
            told.add((arrives, gathers))
    assert (1, 0) in told or (0, 1) in told  # one sign taken for the other is told
