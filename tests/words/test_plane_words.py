"""What is said of a curve in the plane of f, and of its special points, is what portraits there show."""

import math

import numpy as np
import pytest

from codim2_core import ELinear, bifurcations, psi
from codim2_core.results.words import recognise

from .standing import At

ONE, HILL = psi.constant(), psi.hill(3)


class Plane:
    """The systems with one A, over f."""

    def __init__(self, a, b, d, family):
        self.a, self.b, self.d, self.psi = a, b, d, family
        self.A = np.array([[a, -b], [b, d]])

    def at(self, f):
        return At(ELinear(self.a, self.b, self.d, tuple(float(v) for v in f)), self.psi)


def grid(plane):
    """Systems all over the ellipse of critical sets and beyond it."""
    for r, t in ((0.0, 0.0), (0.4, 0.3), (0.4, 2.1), (0.8, 4.0), (0.9, 5.5), (1.3, 1.0), (1.7, 3.0)):
        yield plane.at(-plane.A @ (r * math.cos(t), r * math.sin(t)))


def nowhere(holds):
    return lambda plane, _: all(holds(at) for at in grid(plane)) or pytest.fail("not so")


CURVES = {
    "on the circle": lambda plane, curve: [
        np.testing.assert_allclose(np.hypot(*branch.T), abs(plane.b)) for branch in curve.branches
    ],
    "two for every f": nowhere(lambda at: len(at.equator) == 2 or at.equator.all_directions),
    "still at f = 0": lambda plane, _: [
        np.testing.assert_array_equal(plane.at((0.0, 0.0)).at.U(np.array([0.3, 0.4])), 0.0),
        np.testing.assert_equal(len(plane.at((0.1, 0.2)).sets), 0),
    ],
    "line on a segment": lambda plane, curve: (
        [
            np.testing.assert_array_less(np.linalg.norm(plane.A @ np.linalg.lstsq(plane.A, -f)[0] + f), 1e-9)
            for f in curve.branches[0]
        ]
        + [np.testing.assert_equal(len(at.sets), 0) for at in (plane.at((0.2, 0.1)), plane.at((3.0, 0.2)))]
    ),
    "no cycles at all": nowhere(lambda at: len(at.cycles()) == 0),
    "equator keeps": lambda plane, _: (
        len({np.sign(at.cycle.exponent) for at in grid(plane) if at.cycle}) < 2 or pytest.fail("it changes")
    ),
    "reversible, equator": lambda plane, curve: [
        np.testing.assert_allclose(plane.at(branch[len(branch) // 3]).cycle.exponent, 0.0, atol=1e-9)
        for branch in curve.branches
    ],
    "reversible lines": lambda plane, curve: [
        np.testing.assert_allclose(plane.at(branch[len(branch) // 3]).sets[0].trace, 0.0, atol=1e-9)
        for branch in curve.branches
    ],
    "trace vanishes": nowhere(lambda at: all(abs(C.trace) < 1e-12 for C in at.sets)),
    "no Hopf outside Case III": nowhere(lambda at: all(C.trace != 0.0 or C.kind == "saddle" for C in at.sets)),
    "no Hopf with this Ψ": nowhere(lambda at: all(C.trace < 0.0 for C in at.sets)),
    "saddle or none": nowhere(lambda at: {C.kind for C in at.sets} <= {"saddle"}),
    "one kind": lambda plane, _: len({C.kind for at in grid(plane) for C in at.sets}) == 1 or pytest.fail("kinds"),
    "no fold of cycles": lambda plane, _: (
        None if max((len(at.cycles()) for at in grid(plane)), default=0) < 2 else pytest.fail("two cycles")
    ),
}


POINTS = {
    "nothing turns at f = 0": lambda at: at.equator.all_directions or pytest.fail("no"),
    "reaches where they meet": lambda at: [
        np.testing.assert_allclose([float(np.abs(at.equator.lambda_rho).min()), at.length - 1.0], 0.0, atol=1e-9),
        np.testing.assert_array_less(1, at.equator.multiplicity[np.abs(at.equator.lambda_rho).argmin()]),
    ],
    "reaches, and elsewhere they meet": lambda at: [
        np.testing.assert_allclose(at.length, 1.0),
        np.testing.assert_equal(int(at.equator.multiplicity[np.abs(at.equator.lambda_rho).argmin()]), 1),
        np.testing.assert_equal(int(at.equator.multiplicity.max()), 2),
    ],
    "both eigenvalues agree": lambda at: np.testing.assert_allclose(np.ptp(at.sets[0].eigenvalues), 0.0, atol=1e-9),
}
MATRICES = [
    (-1, 0, -1), (-1, 1, -1), (-1, 0, -1.5), (1, 0, -1), (0, 0, 0), (-1, 0, 0), (0, 1.5, 1), (-1, 3, 1), (-1, 3, 1.2),
    (172, 186, -200), (0, 2, 0), (2, 1.2, -1),
]  # fmt: skip


def hold_curve(curve, plane):
    keys = []
    for key, _ in recognise(curve.sentence):
        if key in CURVES:
            CURVES[key](plane, curve)
        keys.append(key)
    for special in curve.special:
        for key, _ in recognise(special.sentence):
            if key in POINTS:
                POINTS[key](plane.at(special.place))
            keys.append(key)
    return keys


@pytest.mark.parametrize("matrix", MATRICES, ids=str)
def test_on_the_curves_in_the_plane_of_f(matrix):
    assert all(
        hold_curve(curve, Plane(*matrix, family))
        for family in (ONE, HILL)
        for curve in (
            bifurcations.saddle_node(ELinear(*matrix)),
            bifurcations.critical_boundary(ELinear(*matrix)),
            bifurcations.closed_equator(ELinear(*matrix)),
            bifurcations.hopf(ELinear(*matrix), family),
            bifurcations.node_focus(ELinear(*matrix), family),
        )
    )
