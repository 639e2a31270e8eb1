"""Orbits under several Psi side by side: each as it is alone, to the last bit."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.orbits.options import stepping
from codim2_core.orbits.together import states_at, together
from codim2_core.orbits.trajectories import Status, stepped
from codim2_core.psi.constructors import compared

AT = c2.presets["case3-n2"].system.at(())
TYPED = c2.System(U=("172*c - 186*s - 86", "186*c - 200*s - 93")).at(())
OPTIONS = stepping(40.0, 1e-8, 1e-9, capture=1e-6, samples="ends", step_limit=400)


def begun(psis):
    """As many states as there are lanes to each Psi, one more, none at all, and fewer."""
    angle = np.arange(60) * 2.4
    points = 0.95 * np.sqrt((np.arange(60) + 0.5) / 60.0)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    counts = [(4, 5, 0, 2)[i % 4] for i in range(len(psis))]
    return [states_at(points[3 * i : 3 * i + count]) for i, count in enumerate(counts)]


def same(found, alone):
    np.testing.assert_array_equal(found.ends, alone.ends)
    np.testing.assert_array_equal(found.codes, alone.codes)
    np.testing.assert_array_equal(found.offsets, alone.offsets)
    np.testing.assert_array_equal(found.buffer, alone.buffer)
    np.testing.assert_array_equal(found.clock, alone.clock)
    assert found.evaluations == alone.evaluations


@pytest.mark.parametrize("at", [AT, TYPED], ids=["e-linear", "typed"])
@pytest.mark.parametrize("options", [OPTIONS, stepping(0.05, 1e-6, 1e-8, backward=True)], ids=["ends", "lines"])
def test_under_several_psi_each_goes_where_it_goes_alone(at, options):
    psis = compared()
    states = begun(psis)
    found = together(at, psis, states, options)
    for psi, own, lines in zip(psis, states, found, strict=True):
        assert len(lines) == len(own)
        if len(own):
            same(lines, stepped(at, psi, own, np.full(len(own), -1.0), options))
    if options is OPTIONS:  # they do not all end alike: on C, at the equator, and not yet
        ended = {status for lines in found for status in lines.status}
        assert {Status.EQUILIBRIUM, Status.ARRIVED, Status.STEP_LIMIT} <= ended | {Status.T_MAX}
