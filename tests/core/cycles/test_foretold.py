"""Where orbits go, told by samples of the return map, against where they have gone when they are followed."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.cycles import foretold as module
from codim2_core.cycles.foretold import ON_C, foretold
from codim2_core.cycles.limit_cycles import cycles_of
from codim2_core.layer_problem.problem import LayerProblem

DISC = np.array([(0.1, 0.2), (0.5, 0.1), (0.3, -0.4), (0.7, 0.3), (-0.2, 0.6), (0.45, 0.02)])


def followed(problem, points):
    """Where orbits go by following them for long: the index of a cycle, ON_C, or None."""
    lines = c2.trajectories(
        problem.at, problem.psi, points, t_max=1e4 / problem.at.speed, rtol=1e-9, atol=1e-10, samples="ends"
    )
    out = []
    for end in lines.ends[:, :2]:
        gaps = [np.hypot(*(cycle.points - end).T).min() for cycle in problem.keep(cycles_of)]
        on = int(np.argmin(gaps)) if gaps and min(gaps) < 1e-2 else None
        out.append(ON_C if np.hypot(*(problem.critical[0].p - end)) < 1e-4 else on)
    return out


def states_of(points):
    return np.column_stack([points, np.sqrt(1.0 - (points**2).sum(axis=1))])


@pytest.mark.parametrize(("n", "onto"), [(2, ON_C), (3, 0), (4, 0)])
def test_orbits_go_where_it_is_foretold(n, onto):
    problem = LayerProblem(c2.presets["case3-n3"].system.at(), c2.psi.hill(n))
    told, went = foretold(problem, states_of(DISC)), followed(problem, DISC)
    assert onto in told
    for one, other in zip(told, went, strict=True):
        assert one is None or one == other


def test_between_two_cycles_either_way_is_told():
    """A repelling cycle in an attracting one: from inside orbits go to C, from outside to cycle 2."""
    at = c2.ELinear(1.0, 1.3, -1.2, (0.33, 0.07)).at()
    problem = LayerProblem(at, c2.psi.hill(3))
    cycles = problem.keep(cycles_of)
    C = problem.critical[0].p
    points = np.concatenate([C + part * (cycle.points[:1] - C) for cycle in cycles for part in (0.9, 1.1)])
    points = points[np.hypot(*points.T) < 1.0]
    told, went = foretold(problem, states_of(points)), followed(problem, points)
    assert [one for one in told if one is not None]
    assert all(one is None or one == other for one, other in zip(told, went, strict=True))


def test_what_the_samples_do_not_show_for_certain_is_not_told(monkeypatch):
    problem = LayerProblem(c2.presets["case3-n3"].system.at(), c2.psi.hill(3))
    assert 0 in foretold(problem, states_of(DISC))
    monkeypatch.setattr(module.Shown, "certain", -1)
    assert foretold(problem, states_of(DISC)) == [None] * len(DISC)


def test_where_no_cycle_can_be_nothing_is_sampled():
    problem = LayerProblem(c2.ELinear(-1.0, 0.3, -2.0, (0.2, 0.1)).at(), c2.psi.constant())
    assert foretold(problem, states_of(DISC)) == [None] * len(DISC)
