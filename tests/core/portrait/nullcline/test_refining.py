"""What is looked at closely is drawn as finely: a polyline stays within a pixel of its curve, at any magnification."""

import numpy as np
import pytest

from codim2_core import ELinear, System, psi
from codim2_core.portrait.nullcline.nullclines import MAX_BRANCH_POINTS
from codim2_core.scene import Scene

HALF = 2.0  # half the width of the whole picture
SYSTEMS = {
    "conics": ELinear(-2, 0.5, -1, (-0.5, 0.2)),
    "saddle": ELinear(1, 0.3, -1.6, (0.2, 0.1)),
    "typed": System(U=("-2*c**3 - s/2 - 0.3", "-s + c*s + 0.1")),
    "typed, of x": System(U=("-2*c**3 - s/2 - 0.3 + x*y/4", "-s + c*s + 0.1 + x/5")),
}


def component(at, family, kind, p):
    """A component of U at points of the picture."""
    r = np.hypot(*p.T)[:, None]
    u = p / np.where(r > 0.0, r, 1.0)
    inside = r < 1.0
    zeta = np.where(inside, r / np.sqrt(np.where(inside, (1.0 - r) * (1.0 + r), 1.0)), 0.0)
    e = np.where(inside, np.asarray(family.modulus(zeta)) * u, u)
    U = at.U(e, np.where(inside, 0.0, (r - 1.0) * u))
    if kind in ("U1", "U2"):
        return U[:, int(kind[1]) - 1]
    return (u * U).sum(axis=1) if kind == "rho" else u[:, 0] * U[:, 1] - u[:, 1] * U[:, 0]


def away(at, family, kind, points):
    """Distance of points from the zeros of the component, to first order."""
    h = 1e-7
    value = component(at, family, kind, points)
    beside = [[component(at, family, kind, points + way * h * v) for way in (1, -1)] for v in np.eye(2)]
    slopes = [(ahead - behind) / (2.0 * h) for ahead, behind in beside]
    return np.abs(value) / np.hypot(*slopes)


def window(middle, times):
    (x, y), half = middle, HALF / times
    return x - half, x + half, y - half, y + half


@pytest.mark.parametrize("times", [1, 35, 1000])
@pytest.mark.parametrize("family", [psi.constant(), psi.hill(3), psi.exponential()], ids=lambda p: p.text)
@pytest.mark.parametrize("name", SYSTEMS)
def test_within_a_pixel_at_any_magnification(name, family, times):
    scene = Scene(SYSTEMS[name], family)
    pixel = 2.0 * HALF / times / 720
    looked = 0
    for layer in ("nullclines_inside", "nullclines_outside"):
        for k, branch in enumerate(scene[layer]):
            if layer == "nullclines_outside" and branch.kind in ("U1", "U2") and "of x" not in name:
                continue  # construction lines
            i = int(0.37 * (len(branch.points) - 1))
            middle = 0.5 * (branch.points[i] + branch.points[i + 1])
            seen = window(middle, times)
            found = scene.evolve(window=seen)[layer][k]
            assert found.kind == branch.kind
            np.testing.assert_array_equal(found.points[[0, -1]], branch.points[[0, -1]])
            a, b = found.points[:-1], found.points[1:]
            between = np.concatenate([a + share * (b - a) for share in (0.0, 0.3, 0.5, 0.8)])
            r = np.hypot(*between.T)
            shown = (between > (seen[0], seen[2])).all(axis=1) & (between < (seen[1], seen[3])).all(axis=1)
            shown &= (r > 1e-3) & (np.abs(r - 1.0) > 1e-3)
            looked += int(shown.sum())
            if shown.any():
                assert away(scene.coefficients, family, branch.kind, between[shown]).max() < pixel
    assert looked > 8


def test_what_is_not_seen_costs_nothing_and_what_is_seen_is_bounded():
    scene = Scene(SYSTEMS["conics"], psi.hill(3))
    before = sum(len(branch.points) for branch in scene["nullclines_inside"])
    elsewhere = scene.evolve(window=(1.5, 1.51, 1.5, 1.51))["nullclines_inside"]
    assert sum(len(branch.points) for branch in elsewhere) == before
    close = scene.evolve(window=window(scene["nullclines_inside"][0].points[30], 1e6))["nullclines_inside"]
    assert all(len(branch.points) <= MAX_BRANCH_POINTS for branch in close)
    assert sum(len(branch.points) for branch in close) < 2 * before


@pytest.mark.parametrize("times", [1, 35, 400])
def test_the_hyperbola_is_as_fine_as_it_is_seen(times):
    system = ELinear(-2, 0.5, -1, (-0.5, 0.7))
    scene = Scene(system)
    pixel = 2.0 * HALF / times / 720
    for piece in scene.evolve(window=window((0.4, 0.3), times))["conics"].pieces:
        middle = 0.5 * (piece[1:] + piece[:-1])
        x, y = middle.T
        value = (system.d - system.a) * x * y + 0.7 * x + 0.5 * y + 0.5
        slope = np.hypot((system.d - system.a) * y + 0.7, (system.d - system.a) * x + 0.5)
        assert (np.abs(value) / slope).max() < pixel
        assert len(piece) <= MAX_BRANCH_POINTS
