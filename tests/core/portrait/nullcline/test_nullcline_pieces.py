"""Nullclines that fall into a diameter and a chord off the axes; rays and lines outside reach the corners."""

import math

import numpy as np
import pytest

from codim2_core import ELinear, nullclines, psi

from .test_nullclines import component


# theta: b + (d - a) sin cos = 0 along f; rho: a t1^2 + d t2^2 = 0 across f; with (cos, sin) = (3/5, 4/5).
@pytest.mark.parametrize(
    ("plane", "kind"),
    [
        ((20.0, 12.0, -5.0, 3.0, 4.0), "theta"),
        ((20.0, 12.0, -5.0, -6.0, -8.0), "theta"),
        ((16.0, 3.0, -9.0, -4.0, 3.0), "rho"),
        ((16.0, -2.0, -9.0, 1.0, -0.75), "rho"),
        ((-16.0, 5.0, 9.0, 2.0, -1.5), "rho"),
    ],
)
def test_diameter_and_chord(plane, kind):
    system = ELinear(*plane[:3], plane[3:])
    inside = [b for b in nullclines(system, psi.constant()) if b.inside and b.kind == kind]
    lengths = sorted(math.dist(b.points[0], b.points[-1]) for b in inside)
    assert lengths[-1] == pytest.approx(2.0, abs=1e-12)  # the diameter
    assert len(inside) == 2
    for branch in inside:
        np.testing.assert_allclose(component(branch, system, psi.constant(), branch.points), 0.0, atol=1e-12)
        for end in (branch.points[0], branch.points[-1]):
            assert np.hypot(*end) == pytest.approx(1.0, abs=1e-12)
    # the same line when f moves off by little: no branch jumps
    near = ELinear(*plane[:3], (plane[3] * (1 + 1e-7), plane[4]))
    moved = [b for b in nullclines(near, psi.constant()) if b.inside and b.kind == kind]
    for branch in inside:
        for point in branch.points[8:-8:8]:
            gaps = [np.hypot(*(b.points - point).T).min() for b in moved]
            assert min(gaps) < 0.1


@pytest.mark.parametrize("view", [1.5, 3.0])
def test_outside_reaches_the_corners(view):
    system = ELinear(1.0, 0.4, -2.0, (0.3, 0.5))
    reach = math.sqrt(2.0) * view
    kinds = set()
    for branch in nullclines(system, psi.constant(), view=view):
        if branch.inside:
            continue
        kinds.add(branch.kind)
        radii = np.hypot(*branch.points.T)
        assert radii.max() == pytest.approx(reach)
        if branch.kind in ("rho", "theta"):
            assert radii.min() == pytest.approx(1.0)
        else:
            n, k = ((1.0, -0.4), 0.3) if branch.kind == "U1" else ((0.4, -2.0), 0.5)
            np.testing.assert_allclose(branch.points @ n + k, 0.0, atol=1e-12)
    assert kinds == {"rho", "theta", "U1", "U2"}
