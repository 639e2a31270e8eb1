"""From an angle of approach to the limit direction that decides, on equators of which all is known."""

import math

import numpy as np
import pytest

import codim2_core as c2


def outcomes(turning):
    """Outcomes of U = -e + t e turned, and t as a function of the angle: Theta = t, and all of the equator attracts."""
    system = c2.System(U=(f"-c - s*({turning})", f"-s + c*({turning})"))

    def Theta(angle):
        e = np.array([math.cos(angle), math.sin(angle)])
        return system.at().U(e) @ [-e[1], e[0]]

    return c2.approach_outcomes(system, c2.psi.constant(), compare=()), Theta


@pytest.mark.parametrize("turning", ["s", "s*(1/2 - c)", "(1 - c)*(c + 1/2)", "s**2*(c - 1/3)", "s**2*(c - 0.999)"])
def test_a_trajectory_outside_tends_to_the_next_direction_the_way_it_turns(turning):
    found, Theta = outcomes(turning)
    theta = found.equator.theta.tolist()
    ends = [*theta, theta[0] + 2.0 * math.pi]
    assert [(begin, end) for begin, end, _ in found.arcs] == [(ends[i], ends[i + 1]) for i in range(len(theta))]
    for i, (begin, end, outcome) in enumerate(found.arcs):
        for near in (begin, begin + 3e-10, begin - 3e-10, begin + 2.0 * math.pi, begin - 4.0 * math.pi):
            assert found.destination(near) == i
        expected = (i + 1) % len(theta) if Theta(0.5 * (begin + end)) > 0.0 else i
        for part in (1e-6, 0.3, 0.9, 1.0 - 1e-6):
            for turn in (-1, 0, 2):
                angle = begin + part * (end - begin) + 2.0 * math.pi * turn
                assert found.destination(angle) == expected
                assert found.outcome(angle) is found.directions[expected] is outcome


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("turn", [0.0, 0.3, 1.9, 2.8, -1.2])
def test_on_a_whole_arc_of_limit_directions_none_is_tended_to(turn, sign):
    """On the other half all turn to Q in its middle, or from it to the ends of the arc."""
    k, n = repr(math.cos(turn)), repr(math.sin(turn))
    found, _ = outcomes(f"{sign}*max(({k})*s - ({n})*c, 0)*(({k})*c + ({n})*s)")
    (Q,) = found.directions
    for angle in (3.2, 4.5, 6.2, -0.1, 4.0 * math.pi - 1.0):
        assert found.destination(angle + turn) is None
        assert found.outcome(angle + turn).verdict == "undecided"
        assert "a limit direction" in found.outcome(angle + turn).reason
    for angle in (0.01, 1.5, 1.6, 3.0):
        assert found.destination(angle + turn) == (0 if sign > 0 else None)
    assert found.outcome(0.5 * math.pi + turn) is Q
    cuts = np.array([(begin, end) for begin, end, _ in found.arcs])
    np.testing.assert_allclose(cuts[1:, 0], cuts[:-1, 1])
    assert cuts[-1, 1] - cuts[0, 0] == pytest.approx(2.0 * math.pi)
    on = sum(end - begin for begin, end, outcome in found.arcs if outcome is not Q)
    assert on == pytest.approx(math.pi if sign > 0 else 2.0 * math.pi, abs=1e-5)
