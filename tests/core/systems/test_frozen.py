"""Every kind of system answers the same questions once it is frozen at a z (`systems.frozen.FrozenSystem`)."""

import numpy as np
import pytest

from codim2_core import ELinear, System

GIVEN = ELinear(-2.0, 0.25, -1.5, f=(-0.5, "z"), B=((1.0, 0.0),), g=(0.5,))
TYPED = System(U=("-2*c - 0.25*s - 0.5", "0.25*c - 1.5*s + z"), W=("c + 0.5",))
BENT = System(U=("c**2 - x", "s"), parameters={"k": 2.0})
SYSTEMS = {"numbers": GIVEN.at(0.125), "typed": TYPED.at(0.125), "not e-linear": BENT.at()}


def test_the_same_system_given_twice_answers_alike():
    ours, typed = SYSTEMS["numbers"], SYSTEMS["typed"]
    assert ours.as_given.plane == typed.as_given.plane
    assert ours.m == typed.m == 1
    assert (ours.typed, typed.typed) == (None, TYPED)
    assert [x.frozen for x in (ours, typed, GIVEN, TYPED)] == [True, True, False, False]
    e = np.array([[0.3, -0.4], [1.0, 0.0]])
    for one, other in ((ours.U(e), typed.U(e)), (ours.W(e), typed.W(e)), (ours.DU(e), typed.DU(e))):
        np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-15)


@pytest.mark.parametrize("system", [GIVEN, BENT, *SYSTEMS.values(), ELinear.from_matrix([[0, 1], [1, 0]], (1, 2))])
def test_what_can_be_varied_can_be_varied(system):
    for name in system.variable:
        changed = system.varied(name, 3.25)
        assert changed.value_of(name) == 3.25
        assert [changed.value_of(n) for n in system.variable if n != name] == [
            system.value_of(n) for n in system.variable if n != name
        ]
