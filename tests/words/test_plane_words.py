"""What is said of a curve in the plane of f, and of its special points, is what the portraits on its two sides show.

Nothing of the curves and branches is used but where they lie.
"""

import math

import numpy as np
import pytest

from codim2_core import ELinear, bifurcations, psi
from codim2_core.words import ROOMS, recognise

from .standing import At, order
from .test_atlas_words import CHECKS as OF_ATLASES
from .test_change_words import AT_A_VALUE

ONE, HILL = psi.constant(), psi.hill(3)


class Plane:
    """The systems with one A, over f."""

    def __init__(self, a, b, d, family):
        self.a, self.b, self.d, self.psi = a, b, d, family
        self.A = np.array([[a, -b], [b, d]])

    def at(self, f):
        return At(ELinear(self.a, self.b, self.d, tuple(float(v) for v in f)), self.psi)

    def across(self, curve, width=0.02, narrow=True):
        """Systems on one side of some points of the curve, at them, and on the other side.

        The step is a part of the curve's own, of `narrow` ones in A⁻¹f, in which no direction is narrow.
        """
        A = self.A if narrow and abs(np.linalg.det(self.A)) > 1e-9 else np.eye(2)
        for branch in curve.branches:
            for share in (0.21, 0.57) if len(branch) > 4 else ():
                i = int(share * (len(branch) - 2))
                point, (u, v) = branch[i], np.linalg.solve(A, branch[i + 1] - branch[i])
                step = width * (A @ np.array([-v, u]))
                yield self.at(point - step), self.at(point), self.at(point + step)


def grid(plane):
    """Systems all over the ellipse of critical sets and beyond it."""
    for r, t in ((0.0, 0.0), (0.4, 0.3), (0.4, 2.1), (0.8, 4.0), (0.9, 5.5), (1.3, 1.0), (1.7, 3.0)):
        yield plane.at(-plane.A @ (r * math.cos(t), r * math.sin(t)))


def two_meet(plane, curve):
    for one, _, two in plane.across(curve, narrow=False):
        assert abs(len(one.equator) - len(two.equator)) == 2


def set_reaches(plane, curve):
    for one, here, two in plane.across(curve):
        assert {len(one.sets), len(two.sets)} == {0, 1}
        rates = [[side.equator.lambda_rho[side.directions(t)[0]] for side in (one, two) if side.directions(t)]
                 for t in here.equator.theta[here.equator.radially_degenerate].tolist()]  # fmt: skip
        assert all(len(pair) < 2 or pair[0] * pair[1] < 0.0 for pair in rates)


def hopf_across(plane, curve):
    for row in curve.values:
        assert row.any()
    for one, _, two in plane.across(curve):
        assert one.sets[0].trace * two.sets[0].trace < 0.0
        assert {C.kind.split()[0] for C in (one.sets[0], two.sets[0])} == {"stable", "unstable"}


def focus_across(plane, curve):
    for one, here, two in plane.across(curve):
        parts = [at.sets[0].discriminant / at.sets[0].trace ** 2 for at in (one, here, two)]
        assert abs(parts[1]) < 1e-9
        assert parts[0] * parts[2] < 0.0 or max(map(abs, parts)) < 1e-4  # the strip beside a star node is narrow


def equator_turns(plane, curve):
    for one, _, two in plane.across(curve):
        assert one.cycle.exponent * two.cycle.exponent < 0.0


def cycles_vanish(plane, curve):
    found = [[side.cycles() for side in (one, two)] for one, _, two in plane.across(curve, 0.3)]
    assert any(abs(len(one) - len(two)) == 2 for one, two in found)
    for one, two in found:
        more = max(one, two, key=len)
        if abs(len(one) - len(two)) == 2:
            assert {True, False} <= {cycle.stable for cycle in more}


def becomes_loop(plane, curve):
    assert any(len(one.cycles()) != len(two.cycles()) for one, _, two in plane.across(curve, 0.3))


def nowhere(holds):
    return lambda plane, _: all(holds(at) for at in grid(plane)) or pytest.fail("not so")


CURVES = {
    "directions meet": two_meet,
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
    "reaches the equator": set_reaches,
    "no cycles at all": nowhere(lambda at: len(at.cycles()) == 0),
    "equator turns": equator_turns,
    "equator keeps": lambda plane, _: (
        len({np.sign(at.cycle.exponent) for at in grid(plane) if at.cycle}) < 2 or pytest.fail("it changes")
    ),
    "reversible, equator": lambda plane, curve: [
        np.testing.assert_allclose(plane.at(branch[100]).cycle.exponent, 0.0, atol=1e-9) for branch in curve.branches
    ],
    "reversible lines": lambda plane, curve: [
        np.testing.assert_allclose(plane.at(branch[len(branch) // 3]).sets[0].trace, 0.0, atol=1e-9)
        for branch in curve.branches
    ],
    "trace vanishes": nowhere(lambda at: all(abs(C.trace) < 1e-12 for C in at.sets)),
    "no Hopf outside Case III": nowhere(lambda at: all(C.trace != 0.0 or C.kind == "saddle" for C in at.sets)),
    "no Hopf with this Ψ": nowhere(lambda at: all(C.trace < 0.0 for C in at.sets)),
    "Hopf curve": hopf_across,
    "saddle or none": nowhere(lambda at: {C.kind for C in at.sets} <= {"saddle"}),
    "node-focus curve": focus_across,
    "one kind": lambda plane, _: len({C.kind for at in grid(plane) for C in at.sets}) == 1 or pytest.fail("kinds"),
    "two cycles meet": cycles_vanish,
    "no fold of cycles": lambda plane, _: (
        None if max((len(at.cycles()) for at in grid(plane)), default=0) < 2 else pytest.fail("two cycles")
    ),
    "loop through the equator": becomes_loop,
    "no loop": lambda plane, _: None,
}


def triple(at):
    assert max(order(at, float(t)) for t in at.equator.theta) == 3


def fourfold(at):
    assert max(order(at, float(t)) for t in at.equator.theta) == 4


def double_twice(at):
    assert sum(order(at, float(t)) == 2 for t in at.equator.theta) == 2


def neutral_saddles(at):
    ratio = 1.0
    for rho, theta in zip(at.equator.lambda_rho, at.equator.lambda_theta, strict=True):
        ratio *= theta / rho
    # of the half-saddles on the hemisphere the eigenvalues are λ with index θ, and −λ with index ρ
    assert abs(ratio) == pytest.approx(1.0, rel=1e-6)


POINTS = {
    "pitchfork in the plane": triple,
    "cusp in the plane": triple,
    "two cusps have met": fourfold,
    "two double zeros": double_twice,
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
    "Bautin": lambda at: np.testing.assert_allclose(at.sets[0].trace, 0.0, atol=1e-6),
    "neutral loop": neutral_saddles,
}
#: Ends of a fold of cycles, held by continuations that come from elsewhere, and what was not found.
ELSEWHERE = {
    "fold ends, saddle-node": "tests/core/bifurcations/test_cycles.py",
    "fold ends, neutral loop": "tests/core/bifurcations/test_cycles.py",
    "cusp of cycles": "tests/core/cycles/test_near_folds.py",
    "fold not caught": "nothing is claimed",
    "gap": "tests/core/diagrams/test_branches.py",
    "fold reaches the equator": "tests/core/bifurcations/test_cycles.py",
    "fold followed no further": "nothing is claimed",
    "connection followed no further": "nothing is claimed",
    "connection ends beside": "nothing is claimed but a place",
    "neutral connection": "tests/core/atlases/connections/test_connection_curves.py",
    "one comes or goes": "held above wherever it is said",
}
MATRICES = [
    (-1, 0, -1), (-1, 1, -1), (-1, 0, -1.5), (1, 0, -1), (0, 0, 0), (-1, 0, 0), (0, 1.5, 1), (-1, 3, 1), (-1, 3, 1.2),
    (172, 186, -200), (0, 2, 0), (2, 1.2, -1),
]  # fmt: skip


def hold_curve(curve, plane):
    keys = []
    for key, _ in recognise(curve.sentence):
        CURVES[key](plane, curve)
        keys.append(key)
    for special in curve.special:
        for key, _ in recognise(special.sentence):
            if key not in ELSEWHERE:
                POINTS[key](plane.at(special.place))
            keys.append(key)
    return keys


@pytest.mark.parametrize("matrix", MATRICES, ids=str)
def test_on_the_curves_in_the_plane_of_f(matrix):
    assert all(
        hold_curve(curve, Plane(*matrix, family))
        for family in (ONE, HILL)
        for curve in (
            bifurcations.saddle_node(*matrix),
            bifurcations.critical_boundary(*matrix),
            bifurcations.closed_equator(*matrix),
            bifurcations.hopf(*matrix, family),
            bifurcations.node_focus(*matrix, family),
        )
    )


@pytest.mark.parametrize(("matrix", "family"), [((-1, 3, 1.2), HILL), ((1, 2, -2), ONE)], ids=str)
def test_on_the_curves_of_cycles(matrix, family):
    plane = Plane(*matrix, family)
    assert hold_curve(bifurcations.cycle_folds(*matrix, family), plane)
    assert hold_curve(bifurcations.heteroclinic(*matrix, family), plane)


def test_every_sentence_of_a_change_is_held():
    assert (
        AT_A_VALUE.keys() | CURVES.keys() | POINTS.keys() | ELSEWHERE.keys() | OF_ATLASES.keys()
        == ROOMS["changes"].keys()
    )
