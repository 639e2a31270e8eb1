"""What is said of a change is what the portraits on its two sides, and orbits there, show.

Nothing of the curves and branches is used but where they lie: limit directions, critical sets, closed equators and
limit cycles are looked for anew beside them.
"""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, bifurcations, psi
from codim2_core.diagrams.diagram import diagram
from codim2_core.diagrams.result import SpecialValue
from codim2_core.words import ROOMS, recognise

ONE, HILL = psi.constant(), psi.hill(3)


def number(text):
    mantissa, _, power = text.replace("−", "-").partition(" · 10")
    return float(mantissa) * 10.0 ** int(power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")) or 0)


def near(one, other, width):
    return math.cos(one - other) > math.cos(width)


class At:
    """One system at one z, with what stands still there."""

    def __init__(self, system, family, z=()):
        self.psi, self.at = family, system.at(z or (0.0,) * system.m)
        self.equator = c2.equator_equilibria(system, z or (0.0,) * system.m)
        self.cycle = c2.equator_cycle(self.at)
        self.sets = c2.critical_sets(self.at, family)

    def theta(self, angle):
        u, v = self.at.U(np.array([math.cos(angle), math.sin(angle)]))
        return math.cos(angle) * v - math.sin(angle) * u

    def directions(self, angle, width=0.2):
        return [i for i, t in enumerate(self.equator.theta.tolist()) if near(t, angle, width)]

    def cycles(self):
        return c2.limit_cycles(self.at, self.psi)

    @property
    def length(self):
        """|A^-1 f|."""
        q = self.at.normal_form
        return float(np.hypot(*np.linalg.solve(q.A, q.f)))

    @property
    def determinant(self):
        return float(np.linalg.det(self.at.normal_form.A))


def order(at, angle):
    """With which power Θ leaves zero there, on the two sides."""
    near_, far = (np.abs([at.theta(angle + s * h) for s in (1, -1)]).max() for h in (2e-3, 4e-3))
    return round(math.log2(far / near_))


# at a value of one parameter ---------------------------------------------------------------------------------------


class Change:
    """A special value of a diagram with the systems on its two sides."""

    def __init__(self, system, family, name, special, width):
        def at(v):
            if name == "n":
                return At(system, psi.hill(v))
            if name == "z":
                return At(system, family, (v,))
            if name == "k":
                return At(system.evolve(parameters={"k": v}), family)
            return At(system.evolve(**{name: v}) if name not in ("f1", "f2") else moved(system, name, v), family)

        self.at = at
        self.here, (self.before, self.after) = at(special.value), (at(special.value + s * width) for s in (-1, 1))
        self.special = special

    def counts(self, angle):
        return sorted(len(side.directions(angle)) for side in (self.before, self.after))


def moved(system, name, v):
    f = list(system.f)
    f[int(name[1]) - 1] = v
    return system.evolve(f=tuple(f))


def angle_of(fields):
    return number(fields.get("at", fields.get("theta", "")).removeprefix("θ = "))


def meet(change, fields):
    assert change.counts(angle_of(fields)) == [0, 2]


def pass_through(change, fields):
    angle = angle_of(fields)
    assert change.counts(angle) == [2, 2]
    kinds = [
        [bool(side.equator.lambda_theta[i] < 0.0) for i in side.directions(angle)]
        for side in (change.before, change.after)
    ]
    assert all(sorted(pair) == [False, True] for pair in kinds)


def touch(change, fields):
    angle = angle_of(fields)
    assert change.counts(angle) == [0, 0]
    assert len(change.here.directions(angle)) == 1
    assert order(change.here, angle) == 2


def splits(change, fields):
    assert change.counts(angle_of(fields)) == [1, 3]
    assert order(change.here, angle_of(fields)) == 3


def passes_cusp(change, fields):
    """Θ has three zeros beside the cusp where the parameter comes from between two saddle-nodes, or one."""
    assert order(change.here, angle_of(fields)) == 3
    assert set(change.counts(angle_of(fields))) <= {1, 3}


def equator_neutral(change, _):
    exponents = [side.cycle.exponent for side in (change.before, change.after)]
    assert exponents[0] * exponents[1] < 0.0


def border(keeps):
    def check(change, fields):
        lengths = [side.length - 1.0 for side in (change.before, change.after)]
        assert (lengths[0] * lengths[1] > 0.0) == keeps
        rates = []
        for side in (change.before, change.after):
            (i,) = side.directions(angle_of(fields))
            rates.append(side.equator.lambda_rho[i])
        assert (rates[0] * rates[1] > 0.0) == keeps
        assert abs(change.here.length - 1.0) < 1e-9

    return check


def reaches(change, fields):
    fewer, more = sorted((change.before, change.after), key=lambda side: len(side.sets))
    assert len(more.sets) - len(fewer.sets) == 1
    C = max(more.sets, key=lambda C: np.hypot(*C.e))
    assert near(math.atan2(C.e[1], C.e[0]), angle_of(fields), 0.2)
    rates = [side.equator.lambda_rho[side.directions(angle_of(fields))[0]] for side in (fewer, more)]
    assert rates[0] * rates[1] < 0.0


def sets_meet(change, fields):
    fewer, more = sorted((change.before, change.after), key=lambda side: len(side.sets))
    assert len(more.sets) - len(fewer.sets) == 2
    pair = sorted(more.sets, key=lambda C: math.dist(C.p, change.special.place))[:2]
    assert sorted("saddle" if C.kind == "saddle" else "node" for C in pair) == sorted(fields.values())


def set_splits(change, _):
    counts = [len(side.sets) for side in (change.before, change.after)]
    assert abs(counts[0] - counts[1]) == 2
    turns_saddle(change, {})


def comes_alone(change, _):
    assert abs(len(change.before.sets) - len(change.after.sets)) == 1
    assert max(np.hypot(*C.e) for side in (change.before, change.after) for C in side.sets) < 0.95


def nearest(change, side):
    return min(side.sets, key=lambda C: math.dist(C.p, change.special.place))


def turns_saddle(change, _):
    kinds = [nearest(change, side).kind == "saddle" for side in (change.before, change.after)]
    assert sorted(kinds) == [False, True]


def hopf(change, fields):
    """The trace changes its sign; where it is zero orbits come to C, or leave it, as the coefficient says."""
    one, two = (nearest(change, side) for side in (change.before, change.after))
    assert one.trace * two.trace < 0.0 < min(one.determinant, two.determinant)
    if "number" not in fields:
        return
    coefficient = number(fields["number"])
    assert coefficient == pytest.approx(change.special.number, rel=1e-3)
    if coefficient == 0.0:
        assert len(change.here.cycles()) == 0
        return
    C = nearest(change, change.here)
    (line,) = c2.trajectories(change.here.at, change.here.psi, [C.p + 0.1], t_max=4000.0).points
    distance = np.hypot(*(line - C.p).T)
    assert (distance[-len(distance) // 4 :].max() < distance[: len(distance) // 4].max()) == (coefficient < 0.0)
    stable = {c.stable for side in (change.before, change.after) for c in side.cycles()}
    assert (coefficient < 0.0) in stable


def touches_zero(change, _):
    traces = [nearest(change, side).trace for side in (change.before, change.after)]
    assert traces[0] * traces[1] > 0.0
    assert abs(nearest(change, change.here).trace) < 1e-6 * min(map(abs, traces))


def focus(change, _):
    signs = [nearest(change, side).discriminant for side in (change.before, change.after)]
    assert signs[0] * signs[1] < 0.0


def singular(line):
    def check(change, _):
        assert abs(change.here.determinant) < 1e-12
        assert (change.before.length < 1.0 or change.after.length < 1.0) == line
        q = change.here.at.normal_form
        assert (np.linalg.matrix_rank(np.column_stack([q.A, q.f]), 1e-9) == np.linalg.matrix_rank(q.A, 1e-9)) == line
        if not line:
            e = [np.linalg.solve(s.at.A, s.at.f) for s in (change.before, change.after)]
            assert e[0] @ e[1] < -0.9 * np.hypot(*e[0]) * np.hypot(*e[1])

    return check


def over_psi(change, fields):
    kinds = [nearest(change, side).kind for side in (change.before, change.after)]
    assert kinds == [fields["before"], fields["after"]]
    assert number(fields["value"]) == pytest.approx(change.special.value, rel=1e-5)
    assert fields["name"] == "n"


def no_turning(change, _):
    assert np.abs([change.here.theta(t) for t in np.linspace(0, 6, 7)]).max() < 1e-12


def typed(first, second):
    return System((first, second), parameters={"k": 0.1})


(CUSP, *_) = bifurcations.saddle_node(-1, 0.2, -1.5).special
#: A change of each kind: what is said, then the system, Ψ, the parameter and its span.
ALONG = {
    "meet at": (ELinear(-1, 1, -1, (0.3, 0)), ONE, "f1", (0.5, 1.5)),
    "pass through": (ELinear(-1, 0.5, -1.5, (0.3, -0.5)), ONE, "f1", (-2, 2)),
    "touch": (ELinear(-1, "1 + z**2", -1, (1, 0)), ONE, "z", (-0.5, 0.4)),
    "splits, D2": (ELinear(-1, 0, -1.5, (0.3, 0)), ONE, "f1", (0.2, 0.9)),
    "passes a cusp": (
        ELinear(-1, 0.2, -1.5, (f"{CUSP.place[0]!r} + z", f"{CUSP.place[1]!r} - 2*z")),
        ONE,
        "z",
        (-0.3, 0.2),
    ),
    "splits": (typed("-c", "-s + k*s + s**3/2"), ONE, "k", (-1.5, 0.5)),
    "equator neutral, a cycle may leave": (ELinear(-1, 3, 1.5, (0.3, 0.1)), ONE, "a", (-2.5, -0.6)),
    "equator neutral": (typed("k*c - s", "c + k*s"), ONE, "k", (-0.7, 0.6)),
    "border, turns": (ELinear(-1, 0.2, -1.5, (0.3, 0.2)), ONE, "f1", (0.3, 2.0)),
    "border, turns back": (ELinear(1.5, 0, 1, (0, 1)), HILL, "b", (-3, 3)),
    "set reaches the equator": (typed("k - c - c**3", "-s + 0.1*c"), ONE, "k", (1.5, 2.6)),
    "two sets meet": (typed("k - c**2", "-s + 0.1*c"), ONE, "k", (-0.3, 0.4)),
    "set splits": (typed("k*c - c**3", "-s"), ONE, "k", (-0.4, 0.3)),
    "saddle turns": (typed("k*c - c**2", "-s"), ONE, "k", (-0.4, 0.3)),
    "Hopf, typed": (typed("k*c - s", "c + k*s - s**3"), ONE, "k", (-0.3, 0.2)),
    "Hopf, supercritical": (ELinear(172, 186, -200, (-86, -93)), HILL, "n", (2.0, 2.6)),
    "Hopf, degenerate": (ELinear(-1, 3, 1.2), ONE, "a", (-1.6, -0.9)),
    "Hopf, degenerate, reversible": (ELinear(-1, 3, 1.2, (0.5, 0.5)), HILL, "d", (0.6, 1.9)),
    "trace touches zero": (ELinear(1, 3, -1, (0.0, 0.0)), ONE, "f1", (-0.5, 0.5)),
    "between node and focus": (ELinear(-1, 0.1, -2, (0.0, 0.0)), ONE, "b", (0.1, 1.0)),
    "line at one value": (ELinear(-1, 0, 1, (0.3, 0.0)), ONE, "d", (-0.7, 0.6)),
    "through infinity": (ELinear(-1, 0, 1, (0.3, 0.2)), ONE, "d", (-0.7, 0.6)),
    "nothing turns at f = 0": (ELinear(-1, 0, -1, (0.3, 0.0)), ONE, "f1", (-0.7, 0.6)),
}
AT_A_VALUE = {
    "meet at": meet,
    "pass through": pass_through,
    "touch": touch,
    "splits": splits,
    "splits, D2": splits,
    "passes a cusp": passes_cusp,
    "equator neutral": equator_neutral,
    "equator neutral, a cycle may leave": equator_neutral,
    "border, turns": border(False),
    "border, turns back": border(True),
    "set reaches the equator": reaches,
    "two sets meet": sets_meet,
    "one comes or goes": comes_alone,
    "set splits": set_splits,
    "saddle turns": turns_saddle,
    "Hopf, typed": hopf,
    "Hopf, supercritical": hopf,
    "Hopf, subcritical": hopf,
    "Hopf, degenerate": hopf,
    "trace touches zero": touches_zero,
    "between node and focus": focus,
    "line at one value": singular(True),
    "through infinity": singular(False),
    "changes over Ψ": over_psi,
    "nothing turns at f = 0": no_turning,
}


@pytest.mark.parametrize("key", ALONG)
def test_at_a_value_of_one_parameter(key):
    system, family, name, span = ALONG[key]
    said = set()
    special = diagram(system, family, name, span, (0.1,) * system.m).special
    values = np.array([*span, *(s.value for s in special)])
    for one in special:
        gaps = np.abs(values - one.value)
        width = 0.02 * min(0.05 * (span[1] - span[0]), gaps[gaps > 1e-9].min())
        for found, fields in recognise(one.sentence):
            AT_A_VALUE[found](Change(system, family, name, one, width), fields)
            said.add(found)
    assert key.removesuffix(", reversible") in said, said


@pytest.mark.parametrize("n", [1.0, 6.0])
def test_over_the_parameter_of_psi(n):
    system = c2.presets["case3-n3"].system
    changes = bifurcations.parameter_changes(system, psi.hill(n))
    assert len(changes) > 1
    for one in changes:
        ((key, fields),) = recognise(one.sentence)
        special = SpecialValue(one.type, one.n, (0.0, 0.0), one.sentence, "")
        AT_A_VALUE[key](Change(system, HILL, "n", special, 1e-3 * one.n), fields)


# on a curve in the plane of f --------------------------------------------------------------------------------------


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
    "fold reaches the equator": "tests/core/bifurcations/test_cycles.py",
    "fold followed no further": "nothing is claimed",
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
    assert AT_A_VALUE.keys() | CURVES.keys() | POINTS.keys() | ELSEWHERE.keys() == ROOMS["changes"].keys()
