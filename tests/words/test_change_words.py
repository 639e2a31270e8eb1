"""What is said of a change at a value of one parameter is what the portraits on its two sides, and orbits there, show.

Nothing of the curves and branches is used but where they lie: limit directions, critical sets, closed equators and
limit cycles are looked for anew beside them.
"""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, bifurcations, psi
from codim2_core.diagrams.result import SpecialValue
from codim2_core.diagrams.standing import standing
from codim2_core.words import recognise

from .read_back import number
from .standing import At, near, order

ONE, HILL = psi.constant(), psi.hill(3)


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
    special = standing(system, family, name, span, (0.1,) * system.m).special
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
