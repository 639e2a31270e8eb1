"""What is said of launched orbits, held against their ends and against motions of the nonsmooth system."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi
from codim2_core.results.words import ROOMS, written_label

from .read_back import number
from .recognition import recognise

ONE = psi.constant()
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
SEEDS = np.array([(r * math.cos(t), r * math.sin(t)) for r, t in ((0.4, 0.3), (1.4, 1.75), (0.7, 3.2), (1.6, 6.1))])


def holds(key, fields, system, family, seed, end):
    """Whether a sentence is so of an orbit from a seed with this end."""
    place, sets = float(np.hypot(*end)), c2.critical_sets(system, family)
    if key.endswith("a set"):
        i = int(np.argmin([math.dist(C.p, end) for C in sets]))
        label = "C" if len(sets) == 1 else written_label(f"C{i + 1}")
        is_there = math.dist(sets[i].p, end) < 1e-3 and fields["label"] == label
        return is_there and fields["kind"].split(" ", 1)[1] == sets[i].kind
    if key in ("comes up", "comes down", "left", "left, timed"):
        return math.cos(math.atan2(*end[::-1]) - number(fields["theta"])) > 1.0 - 1e-6 and abs(place - 1.0) < 1e-3
    if key.startswith("spirals") or key.startswith("left, in a spiral"):
        return not len(c2.equator_equilibria(system)) and abs(place - 1.0) < 1e-2
    if key.startswith("reached"):
        r = float(np.hypot(*seed))
        run = c2.simulate_nonsmooth(system, seed * (r - 1.0) / r, (0.0, 1e3), family, max_steps=400)
        theta = math.atan2(*run.dense(run.phases[0].t_end * (1.0 - 1e-9))[1::-1])
        in_time = "t" not in fields or abs(number(fields["t"]) / run.phases[0].t_end - 1.0) < 6e-3
        return in_time and ("theta" not in fields or math.cos(theta - number(fields["theta"])) > 0.99)
    if key in ("winds", "unwinds"):
        return bool(len(c2.limit_cycles(system, family)))
    return key in ROOMS["orbits"]


@pytest.mark.parametrize("name", SYSTEMS)
def test_of_launched_orbits(name):
    system, family = SYSTEMS[name]
    found = c2.Scene(system, family, launch=SEEDS)["launched"]
    for fates, backward in ((found.goes, False), (found.comes, True)):
        lines = c2.trajectories(system, family, SEEDS, t_max=4000.0, backward=backward, view=1e3).points
        for seed, fate, line in zip(SEEDS, fates, lines, strict=True):
            for key, fields in recognise(fate.sentence):
                assert holds(key, fields, system, family, seed, line[-1]), fate.sentence
