"""From where orbits are followed to be judged: all sides of a limit direction, all angles of the equator."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.layer_problem.problem import LayerProblem
from codim2_core.portrait import verdicts
from codim2_core.portrait.endings import Ending

from .test_endings import equator


def general(limits):
    """What `arriving` reads of a general system's layer problem."""
    return SimpleNamespace(equator=limits, critical=(), at=SimpleNamespace(normal_form=None))


def begun(monkeypatch, limits, which):
    """Judge limit directions; the points followed, what was left from the equator, and what was judged together."""
    points, left, together = [], [], []

    def from_equator(problem, which, wide, lines, angles):
        assert lines is None
        left.append(list(which))
        beside = verdicts._around(problem, wide, angles)
        points.extend([beside] if len(beside) else [])
        return [f"main {i}" for i in which] + [f"fan {k}" for k in range(len(beside))]

    def judge(_, found, many):
        together.append(([one.label for one in found], many))
        return len(together)

    monkeypatch.setattr(verdicts, "from_equator", from_equator)
    monkeypatch.setattr(verdicts, "ends", lambda _, lines: [Ending(label, None, "") for label in lines])
    monkeypatch.setattr(verdicts, "judge", judge)
    assert verdicts.arriving(general(limits), which) == list(range(1, len(which) + 1))
    return points, left, together


def test_a_whole_family_is_followed_from_a_half_circle_around_its_direction(monkeypatch):
    """One orbit leaves where Theta falls through a simple zero; else a family: all sides of it, at one distance."""
    limits, beyond = equator([0.3, 1.4, 2.9, 4.0, 5.5], [1, 1, 2, 3, 1], lambda_rho=[-1.0] * 5)
    limits.lambda_theta[3] = -1e-14  # a multiple zero, whatever rounding makes of its slope
    which = [i for i in range(5) if i != 1]
    ((points,), (left,), together) = begun(monkeypatch, limits, which)
    assert left == which
    wide = [i for i in which if limits.multiplicity[i] > 1 or beyond[i] > 0]
    assert 0 < len(wide) < len(which)
    each = len(points) // len(wide)
    height = np.sqrt(1.0 - (points**2).sum(axis=1)).reshape(len(wide), each)
    angle = np.arctan2(*points.T[::-1]).reshape(len(wide), each) - limits.theta[wide][:, None]
    angle = np.remainder(angle + math.pi, 2.0 * math.pi) - math.pi
    np.testing.assert_allclose(np.hypot(angle, height), verdicts.FAN, rtol=1e-9)
    assert verdicts.FAN < 0.1  # where the linearisation holds
    around = np.arctan2(height, angle)
    np.testing.assert_allclose(around, np.repeat(around[:1], len(wide), axis=0), rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(np.diff(around[0]), math.pi / each, rtol=1e-9)  # even,
    np.testing.assert_allclose(around[0] + around[0][::-1], math.pi, rtol=1e-9)  # and as many on either side
    for i, (labels, many) in zip(which, together, strict=True):
        if i in wide:
            k = wide.index(i)
            assert labels == [f"main {i}", *(f"fan {j}" for j in range(k * each, (k + 1) * each))]
            assert many == "A whole family of orbits leaves Q"
        else:
            assert (labels, many) == ([f"main {i}"], "")


def test_two_orbits_of_a_family_do_where_they_end_apart(monkeypatch):
    """Else all are followed: those between the two may end elsewhere."""
    problem = LayerProblem(c2.presets["case3-n2"].system.at(), c2.psi.rational())
    (i,) = (i for i in range(4) if problem.equator.lambda_rho[i] < 0.0 < problem.equator.lambda_theta[i])
    whole = verdicts.arriving(problem, [i])[0]
    followed, real = [], verdicts.followed
    monkeypatch.setattr(verdicts, "followed", lambda own, points: followed.append(len(points)) or real(own, points))
    assert (*whole[:2], whole.why) == ("undecided", None, "several")
    assert verdicts.arriving(problem, [i], angles=verdicts.OUTER)[0][:2] == whole[:2]
    assert followed == []
    both = verdicts.ANGLES[[2, 2]]  # as if these were the outer ones: they end alike
    assert verdicts.arriving(problem, [i], angles=both)[0].verdict == verdicts.arriving(problem, [i])[0].verdict
    assert followed == [len(verdicts.ANGLES)]


def test_where_single_orbits_leave_no_family_is_followed(monkeypatch):
    limits, beyond = equator([0.3, 1.4, 2.9, 4.0], [1, 1, 1, 1], lambda_rho=[-1.0] * 4)
    which = [i for i in range(4) if beyond[i] < 0]
    points, left, together = begun(monkeypatch, limits, which)
    assert (points, left) == ([], [which])
    assert together == [([f"main {i}"], "") for i in which]
    assert verdicts.arriving(general(limits), []) == []


def test_orbits_leave_the_closed_equator_at_all_angles(monkeypatch):
    seen = []
    monkeypatch.setattr(verdicts, "followed", lambda _, at: at)
    monkeypatch.setattr(verdicts, "ends", lambda _, at: seen.append(at) or ["ends"])
    monkeypatch.setattr(verdicts, "judge", lambda *given: given)
    problem = SimpleNamespace()
    assert verdicts.spiralling(problem, "many") == (problem, ["ends"], "many")
    (points,) = seen
    radius = np.hypot(*points.T)
    assert (radius < 1.0).all()
    assert (radius > 0.999).all()  # at once above the equator
    np.testing.assert_allclose(radius, radius[0], rtol=1e-14)
    gaps = np.diff(np.unwrap(np.arctan2(*points.T[::-1])))
    np.testing.assert_allclose(gaps, 2.0 * math.pi / len(points), rtol=1e-12)


@pytest.mark.parametrize("p", [c2.psi.constant(), c2.psi.hill(3)], ids=lambda p: p.text)
def test_orbits_are_followed_until_they_have_ended(p):
    """From all sides of Q1 and from Q1 itself onto the only attractor, a node."""
    problem = LayerProblem(c2.ELinear(-1.0, 0.0, -2.0, (0.2, 0.1)).at(), p)
    equator = problem.equator
    which = [i for i in range(len(equator)) if equator.lambda_rho[i] < 0.0]
    lines = verdicts.from_equator(problem, which)
    np.testing.assert_allclose(
        lines.ends[:, :2], np.repeat(problem.critical[0].p[None], len(which), axis=0), rtol=0.0, atol=1e-5
    )
    lines = verdicts.followed(problem, np.array([(0.9, 0.3), (-0.99, 0.0)]))
    assert {one.label for one in verdicts.ends(problem, lines)} == {"C"}


def test_cycles_are_not_searched_for_where_an_orbit_nears_a_stable_set(monkeypatch):
    """In Case III with Psi = 1 the orbit from Q1 creeps onto a stiff node: it has not come there in its first time."""
    problem = LayerProblem(c2.presets["case3-n2"].system.at(), c2.psi.constant())
    lines = verdicts.from_equator(problem, [0])
    assert lines.status[0].name == "T_MAX"
    monkeypatch.setattr(verdicts, "cycles_of", lambda _: pytest.fail("cycles were searched for"))
    assert [one.label for one in verdicts.ends(problem, lines)] == ["C"]


def test_orbits_beside_are_followed_as_they_are_alone():
    problem = LayerProblem(c2.presets["case3-n3"].system.at(), c2.psi.hill(3))
    beside = verdicts._around(problem, [1])
    both = verdicts.from_equator(problem, [0, 1], [1])
    apart = [verdicts.from_equator(problem, [0, 1]), verdicts.followed(problem, beside)]
    np.testing.assert_array_equal(both.ends, np.concatenate([part.ends for part in apart]))
    assert both.status == apart[0].status + apart[1].status


def test_orbits_that_end_nowhere_are_followed_closely():
    """About a centre they go round and round, at the distance at which they were."""
    problem = LayerProblem(c2.ELinear(0.0, 1.0, 0.0).at(), c2.psi.constant())
    points = np.array([(0.3, 0.2), (-0.7, 0.1)])
    lines = verdicts.followed(problem, points)
    np.testing.assert_allclose(np.hypot(*lines.ends[:, :2].T), np.hypot(*points.T), rtol=0.0, atol=1e-6)


def test_an_end_that_is_no_object_is_told_in_words():
    line = c2.ELinear(1, 1, -1, (0.5, 0.5))  # det A = 0, with a line of equilibria in the disc
    (outcome,) = c2.approach_outcomes(line, c2.psi.constant())
    assert outcome.why == "several"
    assert "an equilibrium that is not isolated" in outcome.reason
    assert "undecided" not in outcome.reason
