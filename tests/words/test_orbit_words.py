"""What is said of launched orbits, of sliding along z, and of convex combinations, held against motions and values."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, examples, psi
from codim2_core.layer_problem.problem import LayerProblem
from codim2_core.scene.launched import launched
from codim2_core.sliding.along import slow_portrait
from codim2_core.words import ROOMS, named, recognise

from .read_back import number

ONE = psi.constant()
TURN = np.linspace(0.3, 6.1, 5)
SYSTEMS = {
    "node": (ELinear(-2, 0, -1, (-0.5, 0)), ONE),
    "crossing": (ELinear(-1, 0, -1, (1.3, 0.2)), ONE),
    "spiral": (ELinear(-1, 3, -1.2, (0.2, 0.1)), ONE),
    "saddle": (ELinear(1, 0, -1.5, (0.2, 0.1)), ONE),
    "away": (ELinear(1, 0.5, 1.4, (0.3, 0.2)), ONE),
    "spiral away": (ELinear(1, 3, 1.2, (0.2, 0.1)), ONE),
    "three sets": (System(U=("-c*(c - 1/2)*(c + 1/2)", "-s")), ONE),
    "cycle": (c2.presets["case3-n3"].system, c2.presets["case3-n3"].psi),
}


def angles_agree(one, other):
    return math.cos(one - other) > 1.0 - 1e-6


class Orbit:
    """A launched orbit and the motion of the nonsmooth system from there, forward or backward in time."""

    def __init__(self, system, family, seed, fate, backward):
        self.system, self.psi, self.seed, self.fate = system, family, np.array(seed), fate
        self.z = (0.0,) * system.m
        self.line = c2.trajectories(system, family, [seed], self.z, t_max=4000.0, backward=backward, view=1e3).points[0]
        self.backward = backward

    def motion(self):
        r = float(np.hypot(*self.seed))
        xy = self.seed * (r - 1.0) / r
        return c2.simulate_nonsmooth(self.system, (*xy, *self.z), (0.0, 1e3), self.psi, max_steps=400)


def at_set(orbit, fields):
    sets = c2.critical_sets(orbit.system, orbit.psi, orbit.z)
    C = min(sets, key=lambda C: math.dist(C.p, orbit.line[-1]))
    assert math.dist(C.p, orbit.line[-1]) < 1e-3
    assert fields["kind"].split(" ", 1)[1] == C.kind
    label = "C" if len(sets) == 1 else named(f"C{1 + [id(one) for one in sets].index(id(C))}")
    assert fields["label"] == label


def at_direction(orbit, fields):
    assert angles_agree(math.atan2(*orbit.line[-1][::-1]), number(fields["theta"]))
    assert abs(np.hypot(*orbit.line[-1]) - 1.0) < 1e-3


def on_equator(orbit, _):
    assert not len(c2.equator_equilibria(orbit.system, orbit.z))
    assert abs(np.hypot(*orbit.line[-1]) - 1.0) < 1e-2


def far(orbit, _):
    assert np.abs(orbit.line).max() > 2.0  # half the width of the picture; it may come back from there


def arrives(orbit, fields):
    run = orbit.motion()
    if "t" in fields:
        assert run.phases[0].t_end == pytest.approx(number(fields["t"]), rel=6e-3)
    if "theta" in fields:
        near = run.dense(run.phases[0].t_end * (1.0 - 1e-9))[:2]
        assert math.cos(math.atan2(*near[::-1]) - number(fields["theta"])) > 0.99


def then_slides(orbit, fields):
    """Late in the regularised motion (x, y) is of order eps."""
    r, eps = float(np.hypot(*orbit.seed)), 1e-4
    xy = orbit.seed * (r - 1.0) / r
    run = c2.simulate(
        orbit.system, orbit.psi, eps, (*xy, *orbit.z), (0.0, 1.02 * orbit.motion().phases[0].t_end + 0.01)
    )
    assert np.hypot(*run.states[-1, :2]) < 300 * eps
    assert fields["onto"]


def then_crosses(orbit, fields):
    r, eps = float(np.hypot(*orbit.seed)), 1e-5
    xy = orbit.seed * (r - 1.0) / r
    run = c2.simulate(orbit.system, orbit.psi, eps, (*xy, *orbit.z), (0.0, (orbit.fate.after or 0.05) + 0.5))
    assert np.hypot(*run.states[-1, :2]) > 100 * eps
    if "theta" in fields:
        assert math.cos(math.atan2(*run.states[-1][1::-1]) - number(fields["theta"])) > 0.99


def true(*_):
    """Nothing is claimed."""


ORBITS = {
    "comes from a set": at_set,
    "tends to a set": at_set,
    "comes up": at_direction,
    "comes down": at_direction,
    "spirals up": on_equator,
    "spirals down": on_equator,
    "comes from outside": far,
    "leaves the picture": far,
    "reached": arrives,
    "reached, timed": arrives,
    "reached, in a spiral": arrives,
    "reached, in a spiral, timed": arrives,
    "left": at_direction,
    "left, timed": at_direction,
    "left, in a spiral": on_equator,
    "left, in a spiral, timed": on_equator,
    "then slides": then_slides,
    "then crosses": then_crosses,
    "then crosses, in a spiral": then_crosses,
    "then undecided": true,
    "not followed": true,
    "winds": lambda orbit, _: len(c2.limit_cycles(orbit.system, orbit.psi)) or pytest.fail("no cycle"),
    "unwinds": lambda orbit, _: len(c2.limit_cycles(orbit.system, orbit.psi)) or pytest.fail("no cycle"),
}


@pytest.mark.parametrize("name", SYSTEMS)
def test_of_launched_orbits(name):
    system, family = SYSTEMS[name]
    seeds = [[r * math.cos(t), r * math.sin(t)] for r, t in zip((0.4, 1.4, 0.7, 1.2, 1.6), TURN, strict=True)]
    found = launched(LayerProblem(system.at((0.0,) * system.m), family), np.array(seeds))
    for seed, goes, comes in zip(seeds, found.goes, found.comes, strict=True):
        for fate, backward in ((goes, False), (comes, True)):
            orbit = Orbit(system, family, seed, fate, backward)
            for key, fields in recognise(fate.sentence):
                if key in ORBITS:
                    ORBITS[key](orbit, fields)
                else:
                    assert key in ROOMS["orbits"]


@pytest.mark.parametrize(
    ("system", "span", "others", "axis"),
    [
        (examples.ball_in_pool(), (-10.0, 10.0), (0.0, 0.0), 0),
        (examples.ball_in_pool(), (-10.0, 10.0), (0.0, 2.0), 0),
        (examples.nonunique_sliding(), (-1.0, 1.0), (0.0,), 0),
        (examples.tilting_block(), (-0.6, 0.6), (0.0,), 0),
    ],
)
def test_of_sliding_along_one_slow_variable(system, span, others, axis):
    for point in slow_portrait(system, ONE, span, others, axis).points:
        ((key, fields),) = recognise(point.sentence)
        at = lambda z: tuple(z if i == axis else v for i, v in enumerate(others))
        step = 1e-3 * (span[1] - span[0])
        before, after = (c2.critical_sets(system, ONE, at(point.z + way * step)) for way in (-1, 1))
        if key.startswith(("along: att", "along: rep", "along one")):
            here = min(c2.critical_sets(system, ONE, at(point.z)), key=lambda C: abs(C.slow_flow[axis]))
            assert abs(here.slow_flow[axis]) < 1e-9
            flows = [min(s, key=lambda C: math.dist(C.e, here.e)).slow_flow[axis] for s in (before, after)]
            assert (flows[0] > 0.0 > flows[1]) == key.endswith("attracts")
            rest = [v for i, v in enumerate(here.slow_flow) if i != axis]
            assert any(rest) == ("z" in fields)
        elif key in ("along: equator", "along: fold"):
            assert len(before) != len(after)
        else:
            assert [C.kind for C in before] != [C.kind for C in after]
