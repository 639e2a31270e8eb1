"""Turns side by side: against one at a time, and their derivatives against differences."""

import pytest

from codim2_core import ELinear, psi
from codim2_core.continuation.parameter_family import ParameterFamily, TurnRequest, run_batch
from codim2_core.layer_problem.vary import vary

SYSTEM = ELinear(1.0, 1.3, -1.2, (0.33, 0.07))
XI = [-3.0, -1.0, -0.4, 0.0, 0.5]


def family(p, name):
    def at(value):
        changed, member, _ = vary(SYSTEM, p, (), name, value)
        return changed.at(()), member

    made = ParameterFamily(at, 1.0)
    made.ray = 1
    return made, p.parameter if name == "n" else getattr(SYSTEM.at(()), name)


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize(
    ("p", "name"), [(psi.hill(3), "f1"), (psi.tanh(), "a"), (psi.constant(), "d"), (psi.hill(2.5), "n")]
)
def test_derivatives_are_those_of_turns_nearby(p, name, backward):
    own, value = family(p, name)
    h = 1e-5

    def turns(dx, dv):
        return run_batch([TurnRequest(own, [x + dx for x in XI], [value + dv] * len(XI), [backward] * len(XI))])[0]

    asked = [turns(*moved) for moved in ((0.0, 0.0), (h, 0.0), (-h, 0.0), (0.0, h), (0.0, -h))]
    seen = 0
    for here, right, left, above, below in zip(*asked, strict=True):
        if None in (here, right, left, above, below):
            continue
        seen += 1
        assert here.by_xi == pytest.approx((right.shift - left.shift) / (2 * h), abs=1e-6, rel=1e-6)
        assert here.by_value == pytest.approx((above.shift - below.shift) / (2 * h), abs=1e-6, rel=1e-5)
        assert here.rate == pytest.approx((right.chi - left.chi) / (2 * h), rel=1e-7)
        assert here.drift == pytest.approx((above.chi - below.chi) / (2 * h), abs=1e-8, rel=1e-6)
    assert seen >= 2
