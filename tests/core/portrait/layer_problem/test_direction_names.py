"""Names of limit directions follow by continuity, whatever passes the angle from which they are counted."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, equator_equilibria, psi
from codim2_core.portrait.layer_problem.equator import cut_that_keeps_names
from codim2_core.portrait.layer_problem.problem import LayerProblem

TURN = 2.0 * math.pi


def off(one, other):
    return float(np.abs(np.mod(np.asarray(one) - other + math.pi, TURN) - math.pi).max())


def test_the_same_directions_in_the_same_order_from_another_angle():
    on = equator_equilibria(ELinear(-2.0, 0.1, -1.0, (-0.4, 0.05)))
    assert len(on) == 4
    for cut in np.linspace(-7.0, 7.0, 40):
        turned = on.counted_from(cut)
        angles = np.mod(turned.theta - cut, TURN)
        assert (np.diff(angles) > 0.0).all()
        k = int(np.flatnonzero(on.theta == turned.theta[0])[0])
        for name in ("theta", "lambda_rho", "lambda_theta", "multiplicity", "radially_degenerate"):
            np.testing.assert_array_equal(getattr(turned, name), np.roll(getattr(on, name), -k))
            assert not getattr(turned, name).flags.writeable
        assert (turned.turns, turned.summary, turned.exact) == (on.turns, on.summary, on.exact)
        assert sorted(turned.kind(i) for i in range(4)) == sorted(on.kind(i) for i in range(4))
    assert on.counted_from(0.0) is on


def test_all_of_a_layer_problem_has_these_names():
    at, family = ELinear(-2.0, 0.0, -1.0, (-0.5, 0.0)).at(), psi.constant()
    problem = LayerProblem(at, family, 6.0)
    assert problem.equator.theta[0] == 0.0
    assert LayerProblem(at, family, 1.0).equator.theta[0] == pytest.approx(TURN / 3.0)
    assert problem.with_psi(psi.tanh()).equator is problem.equator
    scenes = [c2.Scene(ELinear(-2.0, 0.1, -1.0, (-0.4, 0.05)), cut=cut) for cut in (0.0, 3.0)]
    shift = scenes[0]["equator"].theta.tolist().index(scenes[1]["equator"].theta[0])
    assert shift > 0
    first, second = (scene["outcomes"].directions for scene in scenes)
    for i, outcome in enumerate(second):
        other = first[(i + shift) % 4]
        assert (outcome.label, outcome.theta, outcome.verdict) == (f"Q{i + 1}", other.theta, other.verdict)
    first, second = ({(b.inside, b.direction, b.origin): b for b in scene["separatrices"]} for scene in scenes)
    for (inside, direction, origin), branch in second.items():
        if origin.startswith("Q"):
            there = first[inside, direction, f"Q{(int(origin[1:]) - 1 + shift) % 4 + 1}"]
            assert off(there.points[0, 0], branch.points[0, 0]) < 1e-9


@pytest.mark.parametrize("seed", range(6))
def test_each_keeps_its_name_while_a_system_turns(seed):
    """Turning all axes by an angle turns every direction by it: after a whole turn each is where it was."""
    random = np.random.default_rng(seed)
    A, f = random.uniform(-1.0, 1.0, (2, 2)), random.uniform(-0.2, 0.2, 2)
    cut, before, moved = 0.0, None, 0.0
    for angle in np.linspace(0.0, TURN, 90):
        R = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        (p, q), (r, s), (u, v) = *(R @ A @ R.T).tolist(), (R @ f).tolist()
        on = equator_equilibria(c2.System(U=(f"{p!r}*c+{q!r}*s+{u!r}", f"{r!r}*c+{s!r}*s+{v!r}"), W=()))
        if before is not None:
            cut = cut_that_keeps_names(before, on, cut)
            now = on.counted_from(cut)
            assert len(now) == len(before)
            moved = max(moved, off(now.theta, before.theta)) if len(now) else moved
        else:
            now = on
        before = now
    assert moved < 0.1
