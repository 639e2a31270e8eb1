"""In another unit of time, with (U, W) K times as large, a motion is the same one, step by step."""

import numpy as np
import pytest

from codim2_core import psi as families
from codim2_core.motion.simulate import simulate, simulate_nonsmooth
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.typed import System
from tests.core.ways import WAYS, follow

K = 1024.0  # a power of two: no rounding differs


def fold(k):
    return System(U=(f"{k}*(c**2 - z + s/4)", f"{k}*(c/8 - s)"), W=(f"{k}*(c/4 - 1/2)",))


def equator(k):
    return ELinear(-1.0 * k, 0.5 * k, -2.0 * k, (f"{k}*z", f"{k}*0.2"), B=((0.3 * k, 0.0),), g=(0.8 * k,))


def same(own, other):
    assert [(phase.kind, phase.onto, phase.reason) for phase in other.phases] == [
        (phase.kind, phase.onto, phase.reason) for phase in own.phases
    ]
    times = [(phase.t_start, phase.t_end) for phase in own.phases]
    np.testing.assert_allclose([(K * p.t_start, K * p.t_end) for p in other.phases], times, rtol=1e-9, atol=0.0)
    assert len(other.times) == len(own.times)
    assert other.evaluations == own.evaluations
    np.testing.assert_allclose(other.states[-1], own.states[-1], rtol=1e-9, atol=1e-14)


FOLD = fold, (0.0, 0.0, 0.3), 1.0, families.constant(), "C₁ ends in a fold (det J = 0). They cross Σ and leave"
EQUATOR = equator, (0.3, -0.2, 0.1), 3.0, families.tanh(), "C reaches the equator (Figure 19), so sliding ends"


@pytest.mark.parametrize(("case", "way"), [(FOLD, WAYS[0]), *((EQUATOR, way) for way in WAYS)])
def test_a_motion_and_its_limit_are_the_same_in_another_unit_of_time(monkeypatch, case, way):
    system, state0, t, psi, end = case  # … and what is said of its last phase
    follow(monkeypatch, way)
    own, other = (simulate_nonsmooth(system(k), state0, (0.0, t / k), psi) for k in (1.0, K))
    assert own.phases[-1].reason.startswith(end)
    same(own, other)
    same(*(simulate(system(k), psi, state0, (0.0, t / k), eps=1e-4) for k in (1.0, K)))
