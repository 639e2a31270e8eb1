"""From an angle of approach to the limit direction that decides, on equators made up so that every answer is known."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.outcomes import Outcome, Outcomes
from codim2_core.tables import point

from .test_endings import equator

PSI = c2.psi.constant()


def on_circle(theta, multiplicity):
    """Outcomes of Theta = product of sin((t - theta_i)/2)^m_i, and Theta."""
    limits, _ = equator(theta, multiplicity)

    def U(e):
        t = math.atan2(e[1], e[0])
        Theta = float(np.prod(np.sin(0.5 * (t - limits.theta)) ** limits.multiplicity))
        return Theta * np.array([-e[1], e[0]]) + 0.7 * e

    directions = tuple(SimpleNamespace(label=f"Q{i + 1}") for i in range(len(theta)))
    return Outcomes((), directions, limits, None, SimpleNamespace(U=U)), U


@pytest.mark.parametrize("multiplicity", [(1, 1, 1, 1), (1, 2, 1), (2,), (2, 3, 1), (1, 1)])
@pytest.mark.parametrize("theta", [(0.4, 0.6, 3.9, 4.2), (0.1, 2.0, 4.9, 6.2), (0.1, 6.2, 6.23, 6.26)])
def test_a_trajectory_outside_tends_to_the_next_direction_the_way_it_turns(theta, multiplicity):
    theta = theta[: len(multiplicity)]
    found, U = on_circle(theta, multiplicity)
    for i, t in enumerate(theta):
        for near in (t, t + 3e-10, t - 3e-10, t + 2.0 * math.pi, t - 4.0 * math.pi):
            assert found.destination(near) == i
    ends = [*theta, theta[0] + 2.0 * math.pi]
    for i in range(len(theta)):
        middle = 0.5 * (ends[i] + ends[i + 1])
        e = np.array([math.cos(middle), math.sin(middle)])
        expected = (i + 1) % len(theta) if e[0] * U(e)[1] > e[1] * U(e)[0] else i
        for part in (1e-7, 1e-6, 0.3, 0.9, 1.0 - 1e-6):  # Theta is 1e-24 beside a triple zero
            angle = ends[i] + part * (ends[i + 1] - ends[i])
            for turn in (-1, 0, 2):
                assert found.destination(angle + 2.0 * math.pi * turn) == expected
                assert found.outcome(angle + 2.0 * math.pi * turn) is found.directions[expected]
    arcs = found.arcs
    assert [(begin, end) for begin, end, _ in arcs] == [(ends[i], ends[i + 1]) for i in range(len(theta))]
    for begin, end, outcome in arcs:
        assert outcome is found.outcome(begin + 0.2 * (end - begin)) is found.outcome(begin + 0.7 * (end - begin))


def test_where_no_direction_decides_all_angles_have_one_outcome():
    limits, _ = equator([], [])
    whole = SimpleNamespace(label="equator")
    found = Outcomes((), (), limits, whole, None)
    assert found.destination(1.0) is None
    assert found.outcome(1.0) is whole
    assert found.arcs == ((0.0, 2.0 * math.pi, whole),)


def on_arc(turn, sign):
    """Outcomes of Theta = sign max(sin(theta - turn), 0) cos(theta - turn): rests on half the circle."""
    limits, _ = equator([(0.5 * math.pi + turn) % (2.0 * math.pi)], [1])
    limits.arcs = np.remainder([(math.pi + turn, 2.0 * math.pi + turn)], 2.0 * math.pi)

    def U(e):
        t = math.atan2(e[1], e[0]) - turn
        return sign * max(math.sin(t), 0.0) * math.cos(t) * np.array([-e[1], e[0]]) - e

    return Outcomes((), (SimpleNamespace(label="Q1"),), limits, None, SimpleNamespace(U=U))


def typed_arc():
    turning = "max(s, 0)*c"
    return c2.approach_outcomes(c2.System(U=(f"-s*{turning} - c", f"c*{turning} - s")), PSI, compare=())


@pytest.mark.parametrize(
    ("made", "turn", "sign"),
    [(typed_arc, 0.0, 1), *((None, turn, sign) for turn in (0.3, 1.9, 2.8, -1.2) for sign in (1, -1))],
)
def test_on_a_whole_arc_of_limit_directions_none_is_tended_to(made, turn, sign):
    """On the other half all turn to Q in its middle, or from it to the ends of the arc."""
    found = made() if made else on_arc(turn, sign)
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


def test_a_row_has_a_dash_for_what_is_not_there():
    told = Outcome(1.25, "Q1", "open set", "cross", "Q2", 2.5, np.array([0.5]), "Away.")
    assert told._row_() == ("Q1", "1.25", "open set", "cross", "Q2", "2.5", point(np.array([0.5])), "Away.")
    bare = Outcome(None, "equator", "nothing", "misses", None, None, None, "Away.")
    assert bare._row_() == ("equator", "–", "nothing", "misses", "–", "–", "–", "Away.")


def test_where_nothing_arrives_the_table_tells_what_the_directions_do_instead():
    """U = e + (0.2, -0.1): all of the equator repels."""
    found = c2.approach_outcomes(c2.ELinear(1.0, 0.0, 1.0, (0.2, -0.1)), c2.psi.constant())
    assert len(found) == 0
    shown = found._repr_html_()
    assert shown.count("<tr>") == 1 + len(found.directions) == 3
    for one in found.directions:
        assert f"<td>{one.label}</td>" in shown
        assert one.reason in shown
