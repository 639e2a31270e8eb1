"""A motion is the same however far ahead its time span ends."""

import numpy as np
import pytest

from codim2_core import Event, System, psi, simulate_nonsmooth

CUBIC = "(z - (c - 0.3)**2)*((c + 0.5)**2 - (z + 0.5)/8)"  # a second set takes over past the fold, and ends at z = -1/2
CASES = {
    "leaves in a line": (("1 + z", "-2*s"), "1", (-0.1, 0.0, 0.0)),
    "leaves along a curve": (("1 + z", "-2*s + 0.3*z"), "1", (-0.1, 0.0, 0.0)),
    "is sped up by x": (("1 + x", "-2*s"), "1", (-0.1, 0.0, 0.0)),
    "z is sped up": (("1", "-2*s + 0.01"), "1 - z + x", (-0.1, 0.0, 0.0)),
    "passes a fold": ((CUBIC, "-s + 0.01*(c + 1)"), "-1", (0.01, 0.0, 0.05)),
    "passes a fold in a line": ((CUBIC, "-s"), "-1", (0.01, 0.0, 0.05)),
    "leaves at the equator": (("-c + z", "-2*s + 0.1"), "1", (0.0, 0.0, 0.5)),
}
T = np.array([0.3, 0.6, 0.9])


def followed(case, t_end, count=1):
    """Follow the motion to t = 1 of a span that may end later, or several side by side to its end."""
    U, W, state0 = case
    system, stop = System(U=U, W=(W,)), Event(lambda t, state: t - 1.0, terminal=True)
    if count == 1:
        return simulate_nonsmooth(system, state0, (0.0, t_end), psi.constant(), events=[stop])
    return simulate_nonsmooth(system, np.tile(state0, (count, 1)), (0.0, t_end), psi.constant())[0]


@pytest.mark.parametrize(("name", "count"), [*((name, 1) for name in CASES), ("passes a fold", 8)])
def test_the_end_of_the_span_changes_nothing_before(name, count):
    near, far = (followed(CASES[name], t_end, count) for t_end in (1.0, 1e7))
    np.testing.assert_allclose(far.dense(T), near.dense(T), atol=2e-11)
    kinds = [phase.kind for phase in near.phases]
    assert [phase.kind for phase in far.phases][: len(kinds)] == kinds
    ends = [[phase.t_end for phase in run.phases][: len(kinds) - 1] for run in (near, far)]
    assert ends[1] == pytest.approx(ends[0], abs=1e-12)
