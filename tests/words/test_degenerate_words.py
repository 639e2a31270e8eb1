"""What is said of a degenerate setting is read off Θ, A and f themselves."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi
from codim2_core.words import ROOMS, recognise

from .portrait_checks import closed_around

ONE = psi.constant()


def theta(system, angle):
    e = np.array([math.cos(angle), math.sin(angle)])
    u, v = system.at((0.0,) * system.m).U(e)
    return e[0] * v - e[1] * u


def multiple(order):
    """Beside the direction Θ falls with that power: of even order it keeps its sign."""

    def check(system):
        equator = c2.equator_equilibria(system, (0.0,) * system.m)
        at = float(equator.theta[list(equator.multiplicity).index(order)])
        near, far = (theta(system, at + h) for h in (1e-3, 2e-3))
        assert far / near == pytest.approx(2.0**order, rel=0.02)
        assert (theta(system, at - 1e-3) * near > 0.0) == (order % 2 == 0)

    return check


def turns_nowhere(system):
    assert np.abs([theta(system, t) for t in np.linspace(0.0, 6.0, 13)]).max() < 1e-12


def at_rest(system):
    e = np.random.default_rng(1).uniform(-0.7, 0.7, (9, 2))
    assert np.abs([system.at((0.0,) * system.m).U(one) for one in e]).max() < 1e-12


def neutral(system):
    t = np.linspace(0.0, math.tau, 2001)[:-1]
    e = np.stack([np.cos(t), np.sin(t)], axis=-1)
    rates = [one @ system.at((0.0,) * system.m).U(one) / abs(theta(system, a)) for one, a in zip(e, t, strict=True)]
    assert abs(np.mean(rates)) < 1e-9


def linear(test):
    return lambda system: test(system.at((0.0,) * system.m).U) or pytest.fail("it is not so")


def parts(U):
    f = U(np.zeros(2))
    return np.stack([U(np.array([1.0, 0.0])) - f, U(np.array([0.0, 1.0])) - f], axis=-1), f


def length(U):
    A, f = parts(U)
    return float(np.hypot(*np.linalg.solve(A, f)))


def singular(U):
    return abs(np.linalg.det(parts(U)[0])) < 1e-12


def in_range(U):
    A, f = parts(U)
    return singular(U) and np.linalg.matrix_rank(np.column_stack([A, f])) == np.linalg.matrix_rank(A)


def trace_vanishes(system):
    assert min(abs(C.jacobian.trace()) for C in c2.critical_sets(system, ONE, (0.0,) * system.m)) < 1e-9


def on_an_arc(system):
    ((first, last),) = c2.equator_equilibria(system).arcs
    angles = first + np.linspace(0.0, (last - first) % math.tau, 9)
    assert np.abs([theta(system, t) for t in angles]).max() < 1e-12
    assert min(abs(theta(system, first - 0.1)), abs(theta(system, last + 0.1))) > 1e-3


DEGENERATE = {
    "two have met": multiple(2),
    "one splits, D2": multiple(3),
    "one splits": multiple(3),
    "cusp": multiple(3),
    "four have met": multiple(4),
    "four directions have met": multiple(4),
    "nothing turns": turns_nowhere,
    "no turning": turns_nowhere,
    "arc of directions": on_an_arc,
    "everything at rest": at_rest,
    "everything, e-linear": at_rest,
    "neutral closed equator": neutral,
    "between the cases": linear(lambda U: 0.0 in np.diag(parts(U)[0])),
    "exists on the equator": linear(lambda U: abs(length(U) - 1.0) < 1e-12),
    "singular, none": linear(lambda U: singular(U) and not in_range(U)),
    "singular, a line": linear(in_range),
    "singular, outside": linear(in_range),
    "linear centre": trace_vanishes,
    "linear centre, one of them": trace_vanishes,
    "true centre": lambda system: [closed_around(system, one) for one in (ONE, psi.hill(3))],
}
SETTINGS = [
    ELinear(-1, 1, -1, (1, 0)),
    ELinear(-1, 0, -1.5, (-0.5, 0)),
    ELinear(0, 1.5, 1, (2**0.5, -(2**0.5))),
    ELinear(-1, 0, -1),
    ELinear(0, 0, 0),
    ELinear(0, 2, 0),
    ELinear(0, 2, 0, (0.3, 0.1)),
    ELinear(-1, 3, 1),
    ELinear(-1, 3, 1, (0.4, -0.4)),
    ELinear(-1, 0, -1, (1, 0)),
    ELinear(-1, 0, 0, (0.3, 0.2)),
    ELinear(-1, 0, 0, (0.3, 0)),
    ELinear(-1, 0, 0, (1.3, 0)),
    System(U=("-s", "c - c**3")),
    System(U=("-c**3", "-s*c**2")),
    System(U=("-c", "-s + abs(c) - c")),
]


@pytest.mark.parametrize("system", SETTINGS, ids=str)
def test_of_degenerate_settings(system):
    found = c2.classify(system, ONE, (0.0,) * system.m).degeneracies
    assert found
    for degeneracy in found:
        key = recognise(degeneracy.sentence)[0][0]
        assert key in ROOMS["degenerate"].keys() | ROOMS["equator"].keys()
        if key in DEGENERATE:
            DEGENERATE[key](system)
