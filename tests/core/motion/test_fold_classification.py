"""A slide that ends at a folded singularity of the slow flow: a canard point, a folded node, saddle or focus."""

import math
from itertools import pairwise

import numpy as np
import pytest

from codim2_core import SimulationStatus, System, psi, simulate, simulate_nonsmooth
from codim2_core.motion.initial_value.field import field
from codim2_core.motion.limit.fold_classification import classify_fold

PSI = psi.constant()


def parabola(a, b, across="-s", more=""):
    """U = (z1 + c^2, ...), z' = (a z2 + b c, 1): in the time that 2c divides, c' = a z2 + b c, z2' = -2 c."""
    return System(U=(f"z1 + c^2{more}", across), W=(f"{a}*z2 + {b}*c", "1"))


def canard(more=""):
    """With one slow variable, z' = -c: from z = -1/4, c = (t - 1)/2 comes to the fold at t = 1, with z' = 0."""
    return System(U=(f"z + c^2{more}", "-s"), W=("-c",))


def test_motions_for_eps_come_to_leave_at_the_folded_node():
    """In a distance of order eps^((1 - mu)/2), mu = 0.17 the ratio of the eigenvalues: 0.38 for a tenth of eps."""
    system = parabola(0.25, -2.0)
    late = []
    for eps in (1e-4, 1e-5, 1e-6):
        run = simulate(system, PSI, (0.0, 0.0, -0.09, -0.6), (0.0, 1.0), eps=eps)
        late.append(next(phase.t_start for phase in run.phases if phase.kind == "slip") - 0.6)
    assert all(after < 0.5 * before for before, after in pairwise(late))
    assert 0.0 < late[-1] < 0.03


def test_at_a_canard_point_what_follows_is_left_to_terms_of_order_eps():
    """U + k x is the same in the limit, and for k = 10 the motion leaves, for k = -10 it stays."""
    for more, count in (("", 1), ("", 8), (" + 10*x", 1), (" - 10*x", 1)):
        run = simulate_nonsmooth(canard(more), [(0.0, 0.0, -0.25)] * count, (0.0, 1.5), PSI)[0]
        assert run.status is SimulationStatus.NOT_UNIQUE
        assert run.times[-1] == pytest.approx(1.0, abs=1e-6)
        assert "canard point" in run.reason
    leaves, stays = (
        [simulate(canard(more), PSI, (0.0, 0.0, -0.25), (0.0, 1.5), eps=eps) for eps in (1e-3, 1e-4, 1e-5)]
        for more in (" + 10*x", " - 10*x")
    )
    assert all(run.phases[-1].kind == "slip" and run.phases[-1].t_start < 1.05 for run in leaves)
    assert all(math.hypot(*run.states[-1, :2]) < 20.0 * run.eps for run in stays)


@pytest.mark.parametrize("shift", [0.02, -0.02])
def test_next_to_a_canard_point_it_is_a_jump_point_or_a_rest(shift):
    """With z' = -c + shift there is a rest at c = shift: before the fold it is come to, else the fold is left at."""
    system = System(U=("z + c^2", "-s"), W=(f"-c + {shift}",))
    run = simulate_nonsmooth(system, (0.0, 0.0, -0.25), (0.0, 2.0), PSI)
    assert run.status is SimulationStatus.T_END
    assert [phase.kind for phase in run.phases] == (["slide", "slip"] if shift > 0.0 else ["slide"])


@pytest.mark.parametrize(
    ("a", "b", "word", "decided"),
    [
        (0.25, -2.0, "folded node", True),
        (-0.5, -1.0, "folded saddle", False),
        (0.0, -1.0, "eigenvalue 0", False),
        (1.0, -1.0, "(det J = 0)", True),
    ],
)
def test_what_a_fold_is_by_the_eigenvalues_of_its_slow_flow(a, b, word, decided):
    """Node, saddle, both borders: l^2 - b l + 2 a = 0."""
    found = classify_fold(field(parabola(a, b, "-s + 0.1*c")), np.zeros(2), np.zeros(2), "C1", "fold")
    assert word in found.reason
    assert found.left_to_eps is not decided
    if word == "folded node":
        np.testing.assert_allclose(found.beyond, [1.0, 0.0], atol=1e-9)  # for z1 > 0 z1 + c^2 has no zero


def to_saddle(c, beside):
    """Follow a motion from next to the stable eigenvector of a folded saddle, z2 = -2 c/l."""
    a, b = -0.5, -1.0
    stable = 0.5 * (b - math.sqrt(b * b - 8.0 * a))
    return simulate_nonsmooth(parabola(a, b), (0.0, 0.0, -c * c, -2.0 * c / stable - beside), (0.0, 1.0), PSI)


@pytest.mark.parametrize(("c", "beside"), [(-0.3, 1e-8), (-0.02, 1e-7)])
def test_a_motion_comes_to_a_folded_saddle_within_the_resolution(c, beside):
    """On this side motions come to the fold, on the other they turn away from it."""
    run = to_saddle(c, beside)
    assert run.status is SimulationStatus.NOT_UNIQUE
    assert "folded saddle" in run.reason
    np.testing.assert_allclose(run.states[-1], 0.0, atol=1e-5)
    away = to_saddle(c, -1e-6)
    assert [phase.kind for phase in away.phases] == ["slide"]
    assert away.status is SimulationStatus.T_END


def test_within_the_rounding_it_does_either():
    """Near the fold the end of a step may be found on the other set: one of these raised for that."""
    for beside in (1e-10, 1e-11, 1e-12, 1e-13, 0.0, -1e-12):
        run = to_saddle(-(2.0**-12), beside)
        assert (run.status is SimulationStatus.T_END) != ("folded saddle" in run.reason)
