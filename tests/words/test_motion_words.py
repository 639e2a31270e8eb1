"""What is said of a motion, phase by phase, is what the other description of it does there."""

import math

import pytest

import codim2_core as c2
from codim2_core import ELinear, System, examples, psi

from .motion_checks import CONSTANT, MOTIONS, Told
from .recognition import recognise

HILL = psi.hill(3)
CASE_3 = ELinear(172.0, 186.0, -200.0, ("-172*z", "-186*z"), B=((0.5, 0.0),))  # C at e = (z, 0), z' = e_1/2
TYPED_3 = System(U=("172*c - 186*s - 172*z", "186*c - 200*s - 186*z"), W=("c/2",))
ARRIVING = (8.5e-4, 5.2e-4)
TWO_NODES = System(U=("-c*(c - 1/2)*(c + 1/2)", "-s"))
SUBCRITICAL = System(U=("z*c - s + c*(c**2 + s**2)", "c + z*s + s*(c**2 + s**2)"), W=("1",))
BUFFER = System(U=("z*(c - 0.3*z) - s/2 - c*(c**2 + s**2)", "(c - 0.3*z)/2 + z*s - s*(c**2 + s**2)"), W=("1",))
CYCLE = System(U=("c - s - 2*c*(c**2 + s**2)", "c + s - 2*s*(c**2 + s**2)"))
ON_A_CIRCLE = System(U=("4*c*(1/4 - c*c - s*s) - s*(z + 2*c)", "4*s*(1/4 - c*c - s*s) + c*(z + 2*c)"), W=("1",))
CASES = {
    "focus": (ELinear(-1, 0.5, -1, (0.1, 0)), None, (1, 0.2), 3),
    "in a line": (ELinear(-1, 0, -1.5, (0.3, 0)), CONSTANT, (0.5, 0), 1),
    "across in a line": (ELinear(-1, 0, -1.5, (1.3, 0)), CONSTANT, (-0.5, 0), 3),
    "from a saddle": (ELinear(1, 0, -1.5), CONSTANT, (0, 0), 1),
    "fold in a line": (System(U=("z - c**2", "-s"), W=("-1",)), CONSTANT, (0.3, 0, 0.5), 3),
    "fold": (System(U=("z - c**2", "-s + 0.1*c"), W=("-1",)), CONSTANT, (0.3, 0.1, 0.5), 3),
    "ball": (examples.ball_in_pool(K=2.0), CONSTANT, (-1, 0.3, 10, 0), 2.5),
    "block": (examples.tilting_block(), CONSTANT, (0.3, 0.1, 0.1), 5),
    "Case III": (CASE_3, HILL, (*ARRIVING, 0.3), 2.6),
    "Case III, no psi": (CASE_3, None, (0.1, 0, 0.5), 5),
    "Case III, no psi, on Sigma": (CASE_3, None, (0, 0, 0.5), 5),
    "Case III, typed": (TYPED_3, HILL, (*ARRIVING, 0.3), 1),
    "three sets": (examples.nonunique_sliding(), None, (0, 0, 0.1), 5),
    "all directions away": (ELinear(1, 0, 1), None, (0, 0), 5),
    "spirals away, no psi": (ELinear(1, 3, 1), None, (0, 0), 5),
    "spirals away": (ELinear(1, 3, 1, (0.2, 0)), CONSTANT, (0, 0), 5),
    "two nodes": (TWO_NODES, None, (0, 0), 1),
    "cycle": (CYCLE, CONSTANT, (0, 0), 1),
    "to a cycle by a saddle-node on it": (ON_A_CIRCLE, CONSTANT, (-0.3, 0.05, 0.5), 3),
    "cycle, no psi": (CYCLE, None, (0, 0), 1),
    "one way out": (ELinear(-1, 0, -2, (3, 0)), None, (0, 0), 1),
    "saddle": (ELinear(1, 0, -1), None, (0, 0), 1),
    "node and way out": (System(U=("c**2 - 1/8", "-2*s")), None, (0, 0), 1),
    "moves out": (ELinear(-1, 0, -1, ("z", 0.0), g=(1,)), CONSTANT, (0, 0, 1), 1),
    "moves in": (ELinear(-1, 0, -1, ("z", 0.0), g=(-1,)), CONSTANT, (0, 0, 1), 1),
    "off the equator": (ELinear(-1, 0.2, -1.2, ("z", 0.1), g=(1,)), CONSTANT, (0, 0, 0.5), 0.8),
    "stable middle": (ELinear(-1, 0, -2), CONSTANT, (0, 0), 1),
    "next to the middle": (ELinear(-1, 0, -2, (0.3, 0.2)), CONSTANT, (0, 0), 1),
    "no psi": (ELinear(-1, 0, -2, (0.3, 0.2)), None, (0, 0), 1),
    "blows up": (System(U=("x**2", "-s")), CONSTANT, (1, 0.1), 5),
    "undefined": (System(U=("-c", "-s"), W=("1/sqrt(2 - z)",)), CONSTANT, (1, 0.1, 0), 50),
    "starts in a line": (ELinear(-1, 0, -1, (0.2, 0.1)), CONSTANT, (0, 0), 1),
    "rests": (System(U=("c", "s + c")), CONSTANT, (0, 0), 1),
    "fold, no psi": (System(U=("z - c**2", "-s + 0.1*c"), W=("-1",)), None, (0.3, 0.1, 0.5), 3),
    "Hopf, no psi": (SUBCRITICAL, None, (0, 0, -0.5), 2),
    "subcritical Hopf": (SUBCRITICAL, CONSTANT, (0, 0, -0.5), 2),
    "delayed to the end": (SUBCRITICAL, CONSTANT, (0, 0, -0.5), 0.8),
    "buffer point": (BUFFER, CONSTANT, (0, 0, -1.2), 1.9),
    "kink": (System(U=("z*c - (1/2 + abs(z + 0.3))*s - z^2/4", "c/2 + z*s"), W=("1",)), CONSTANT, (0, 0, -1), 2),
    "crosses": (examples.attracting_repelling(), CONSTANT, (0.2, 0.25, 0.5), 2),
}


def hold(system, family, start, run, asked):
    texts = [phase.reason for phase in run.phases] + [run.reason]
    for k, text in enumerate(texts):
        told = Told(system, family, start, run, k)
        told.asked = asked
        for key, fields in recognise(text):
            if key in MOTIONS:
                MOTIONS[key](told, fields)


@pytest.mark.parametrize("name", CASES)
def test_of_the_limit(name):
    system, family, start, t = CASES[name]
    run = c2.simulate_nonsmooth(system, start, (0.0, t), family)
    hold(system, family, tuple(map(float, start)), run, t)


@pytest.mark.parametrize("name", ["across in a line", "fold", "ball", "one way out", "off the equator", "blows up"])
def test_of_the_regularised_motion(name):
    system, family, start, t = CASES[name]
    run = c2.simulate(system, family or CONSTANT, start, (0.0, t), eps=1e-5)
    hold(system, family, tuple(map(float, start)), run, t)


@pytest.mark.parametrize("name", c2.presets)
def test_of_every_portrait(name):
    preset = c2.presets[name]
    angle = float(len(name))
    start = (0.05 * math.cos(angle), 0.05 * math.sin(angle), *(preset.z or (0.0,) * preset.system.m))
    run = c2.simulate_nonsmooth(preset.system, start, (0.0, 0.2), preset.psi)
    hold(preset.system, preset.psi, start, run, 0.2)
