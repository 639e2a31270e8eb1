"""What response curves begin with: periods read off formulas, and motions that settle."""

import math

import pytest

from codim2_core import System, psi, reference
from codim2_core.motion.periodic.search import forcing_period, settled_motion


@pytest.mark.parametrize(
    ("U", "W", "period"),
    [
        ("-c + cos(w*t)", "x", math.tau / 0.6),
        ("-c + cos(w*t + 1)*sin(2*w*t)", "x", math.tau / 0.6),
        ("-c + cos(2*w*t) + sin(3*w*t)", "x", math.tau / 0.6),
        ("-c + cos(w*t) + sin(sqrt(2)*w*t)", "x", None),  # no common period
        ("-c + cos(w*t*t)", "x", None),
        ("-c + cos(z1)", "x", None),  # no clock
    ],
)
def test_the_period_of_a_forcing_is_read_off_the_formulas(U, W, period):
    found = forcing_period(System(U=(U, "-s"), W=(W,), parameters={"w": 0.6} if "w" in U else {}))
    assert found is None if period is None else found == pytest.approx(period, rel=1e-14)


def test_a_block_on_a_belt_settles_to_its_cycle():
    block = System(U=("-z1 - c/(1 + 3*abs(x))", "-s"), W=("x + v",), parameters={"v": 0.2})
    _, period = settled_motion(block, (0.1, 0.0, 0.0), psi.constant(), 0.0, 40.0)
    assert period == pytest.approx(reference.catalogue["leine-block"].values[2].value, abs=0.05)


def test_what_comes_to_rest_is_not_taken_for_a_cycle():
    assert settled_motion(System(U=("-z1 - c", "-s"), W=("x",)), (0.0, 0.0, 2.0), psi.constant(), 0.0, 40.0) is None
