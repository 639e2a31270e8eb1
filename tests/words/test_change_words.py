"""What is said of a change at a value of one parameter is what portraits on its two sides, and orbits, show."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, bifurcations, psi
from codim2_core.bifurcations.diagrams.equilibrium_branches import equilibrium_branches
from codim2_core.bifurcations.diagrams.result import SpecialValue

from .read_back import number
from .recognition import recognise
from .standing import At

ONE, HILL = psi.constant(), psi.hill(3)


class Change:
    """A special value of a diagram with the systems on its two sides."""

    def __init__(self, system, family, name, special, width, alone=True):
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
        self.special, self.alone = special, alone


def moved(system, name, v):
    f = list(system.f)
    f[int(name[1]) - 1] = v
    return system.evolve(f=tuple(f))


def sign_changes(change, value):
    one, two = map(value, (change.before, change.after))
    return one * two < 0.0


def nearest(side, place):
    return min(side.sets, key=lambda C: math.dist(C.p, place))


def counts(directions, sets, changing=""):
    """A check that so many directions and sets are on one side only, and which number there changes its sign."""

    def check(change, _):
        sides = change.before, change.after
        gained = [abs(len(a) - len(b)) for a, b in ([s.equator for s in sides], [s.sets for s in sides])]
        if change.alone:
            assert gained[0] == directions
            assert sets is None or gained[1] == sets
        if changing == "exponent":
            assert sign_changes(change, lambda side: side.cycle.exponent)
        elif changing:
            assert sign_changes(change, lambda side: getattr(nearest(side, change.special.place), changing))

    return check


def hopf(change, fields):
    """Where the trace is zero orbits come to C, or leave it, as the coefficient says."""
    counts(0, 0, "trace")(change, fields)
    coefficient = number(fields["number"]) if "number" in fields else 0.0
    if coefficient:
        assert coefficient == pytest.approx(change.special.number, rel=1e-3)
        C = nearest(change.here, change.special.place)
        (line,) = c2.trajectories(change.here.at, change.here.psi, [C.p + 0.1], t_max=4000.0).points
        distance = np.hypot(*(line - C.p).T)
        assert (distance[-len(distance) // 4 :].max() < distance[: len(distance) // 4].max()) == (coefficient < 0.0)


def over_psi(change, fields):
    kinds = [nearest(side, change.special.place).kind for side in (change.before, change.after)]
    assert kinds == [fields["before"], fields["after"]]
    assert number(fields["value"]) == pytest.approx(change.special.value, rel=1e-5)


def typed(first, second):
    return System((first, second), parameters={"k": 0.1})


(CUSP, *_) = bifurcations.saddle_node(ELinear(-1, 0.2, -1.5)).special
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
    "border, turns back": (ELinear(1.5, 0, 1, (0, 1)), HILL, "b", (-3, 3)),
    "set reaches the equator": (typed("k - c - c**3", "-s + 0.1*c"), ONE, "k", (1.5, 2.6)),
    "two sets meet": (typed("k - c**2", "-s + 0.1*c"), ONE, "k", (-0.3, 0.4)),
    "set splits": (typed("k*c - c**3", "-s"), ONE, "k", (-0.4, 0.3)),
    "det J = 0": (typed("k*c - c**2", "-s"), ONE, "k", (-0.4, 0.3)),
    "Hopf": (typed("k*c - s - c*abs(c)", "c + k*s - s**3"), ONE, "k", (-0.3, 0.2)),
    "Hopf, supercritical": (ELinear(172, 186, -200, (-86, -93)), HILL, "n", (2.0, 2.6)),
    "Hopf, degenerate": (ELinear(-1, 3, 1.2), ONE, "a", (-1.6, -0.9)),
    "Hopf, degenerate, reversible": (ELinear(-1, 3, 1.2, (0.5, 0.5)), HILL, "d", (0.6, 1.9)),
    "trace touches zero": (ELinear(1, 3, -1, (0.0, 0.0)), ONE, "f1", (-0.5, 0.5)),
    "node-focus": (ELinear(-1, 0.1, -2, (0.0, 0.0)), ONE, "b", (0.1, 1.0)),
    "line at one value": (ELinear(-1, 0, 1, (0.3, 0.0)), ONE, "d", (-0.7, 0.6)),
    "through infinity": (ELinear(-1, 0, 1, (0.3, 0.2)), ONE, "d", (-0.7, 0.6)),
    "nothing turns at f = 0": (ELinear(-1, 0, -1, (0.3, 0.0)), ONE, "f1", (-0.7, 0.6)),
}
AT_A_VALUE = {
    "meet at": counts(2, 0),
    "pass through": counts(0, 0),
    "touch": counts(0, 0),
    "splits": counts(2, 0),
    "splits, D2": counts(2, 0),
    "passes a cusp": counts(0, 0),
    "equator neutral, a cycle may leave": counts(0, 0, "exponent"),
    "border, turns back": counts(0, 0),
    "set reaches the equator": counts(0, 1),
    "two sets meet": counts(0, 2),
    "one comes or goes": counts(0, 1),
    "set splits": counts(0, 2),
    "det J = 0": counts(0, 0, "determinant"),
    "Hopf": hopf,
    "Hopf, supercritical": hopf,
    "Hopf, subcritical": hopf,
    "Hopf, degenerate": hopf,
    "trace touches zero": counts(0, 0),
    "node-focus": counts(0, 0, "discriminant"),
    "line at one value": counts(0, None),
    "through infinity": counts(0, 0),
    "changes over Ψ": over_psi,
    "nothing turns at f = 0": counts(0, 0),
}


@pytest.mark.parametrize("key", ALONG)
def test_at_a_value_of_one_parameter(key):
    system, family, name, span = ALONG[key]
    said = set()
    special = equilibrium_branches(system, family, name, span, (0.1,) * system.m).special
    values = np.array([*span, *(s.value for s in special)])
    for one in special:
        gaps = np.abs(values - one.value)
        width = 0.02 * min(0.05 * (span[1] - span[0]), gaps[gaps > 1e-9].min())
        for found, fields in recognise(one.sentence):
            AT_A_VALUE[found](Change(system, family, name, one, width, np.count_nonzero(gaps <= 1e-9) == 1), fields)
            said.add(found)
    assert key.removesuffix(", reversible") in said, said


@pytest.mark.parametrize("n", [1.0, 6.0])
def test_over_the_parameter_of_psi(n):
    system = c2.presets["case3-n3"].system
    changes = bifurcations.parameter_changes(system, psi.hill(n))
    assert len(changes) > 1
    for one in changes:
        ((key, fields),) = recognise(one.sentence)
        special = SpecialValue(one.type, one.n, (0.0, 0.0), one.sentence)
        AT_A_VALUE[key](Change(system, HILL, "n", special, 1e-3 * one.n), fields)
