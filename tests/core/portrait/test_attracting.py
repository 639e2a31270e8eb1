"""The attracting set that sliding follows, among several critical sets, and a limit cycle where none is stable."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.portrait_name import attracting_set


def never():
    raise AssertionError("limit cycles are asked for only where no critical set is stable")


def test_one_stable_critical_set():
    sets = c2.critical_sets(c2.ELinear(-2, 0, -1, (-0.5, 0), B=((1, 0),), g=(0.25,)), c2.psi.constant(), (0.0,))
    found = attracting_set(sets, never)
    assert found.name == "C"
    np.testing.assert_allclose(found.e, [-0.25, 0])
    np.testing.assert_allclose(found.slow_flow, [0.0])


def test_of_several_the_one_it_was_on_is_followed():
    system = c2.examples.nonunique_sliding()
    sets = c2.critical_sets(system, c2.psi.constant(), (0.3,))
    stable = [i for i, C in enumerate(sets) if C.kind.startswith("stable")]
    assert len(stable) == 2
    assert len(sets) > 2
    assert attracting_set(sets, never).name == f"C{stable[0] + 1}"
    for i in stable:
        found = attracting_set(sets, never, last=sets[i].e + np.array([0.02, -0.01]))
        assert found.name == f"C{i + 1}"
        assert found.slow_flow is sets[i].slow_flow
        assert found.e is sets[i].e


@pytest.mark.parametrize(("preset", "name"), [("case3-n3", "cycle 1"), ("case2-saddle", None)])
def test_where_no_critical_set_is_stable_a_stable_cycle_or_none_is(preset, name):
    one = c2.presets[preset]
    sets = c2.critical_sets(one.system, one.psi, one.z)
    assert not any(C.kind.startswith("stable") for C in sets)
    found = attracting_set(sets, lambda: c2.limit_cycles(one.system, one.psi, one.z))
    assert (found and found.name) == name
    if found:
        np.testing.assert_allclose(found.slow_flow, sets[0].slow_flow)  # prop:LC
