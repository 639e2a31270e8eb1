"""Phases follow from the set that is followed: within O(eps) of it, and as in the nonsmooth limit."""

import numpy as np
import pytest

from codim2_core import ELinear, System, critical_sets, examples, limit_cycles, simulate, simulate_nonsmooth
from codim2_core import psi as families
from codim2_core.motion.result import SimulationStatus

PSI = (families.constant(), families.rational(), families.hill(2), families.tanh())


def named(run):
    return [(phase.kind, phase.onto) for phase in run.phases]


def random_system(rng, m, general):
    def draw(n):
        return np.round(rng.uniform(-2.0, 2.0, n), 2)

    def drift(size):
        return "".join(f"+({value})*z{i + 1}" for i, value in enumerate(draw(m) * size))

    if not general:
        a, b, d = draw(3).tolist()
        f = [f"{value}{drift(1.0)}" for value in draw(2)]
        return ELinear(a, b, d, f=f, B=draw((m, 2)).tolist(), g=[f"{v}{drift(0.5)}" for v in draw(m)]) if m else (
            ELinear(a, b, d, f=f)
        )  # fmt: skip
    k = draw(10)
    U = (
        f"{k[0]}*c+({k[1]})*s+({k[2] / 2})+({k[3] / 3})*c*s+({k[8] / 4})*c**2{drift(1.0)}",
        f"{k[4]}*c+({k[5]})*s+({k[6] / 2})+({k[7] / 3})*s**2+({k[9] / 4})*x{drift(1.0)}",
    )
    W = [f"{u}*c+({v})*s+({w})-z{i + 1}/2" for i, (u, v, w) in enumerate(draw((m, 3)))]
    return System(U=U, W=W)


@pytest.mark.parametrize("block", range(2))
def test_random_systems_have_the_phases_of_the_limit(block):
    eps, compared, circling = 1e-7, 0, 0
    for seed in range(50 * block, 50 * block + 20):
        rng = np.random.default_rng(seed)
        m, general = int(rng.integers(0, 3)), bool(rng.random() < 0.3)
        system, psi = random_system(rng, m, general), PSI[rng.integers(4)]
        state0 = np.round(rng.uniform(-1.0, 1.0, 2 + m), 2)
        if rng.random() < 0.3:
            state0[:2] = 0.0
        limit = simulate_nonsmooth(system, state0, (0.0, 2.0), psi, rtol=1e-9)
        if limit.times[-1] <= 0.0:
            assert limit.status is SimulationStatus.NOT_UNIQUE
            continue
        run = simulate(system, psi, state0, (0.0, limit.times[-1]), eps=eps, max_steps=2000)
        if run.status is SimulationStatus.STEP_LIMIT:  # around a cycle once in a time of order eps
            assert any("cycle" in (phase.onto or "") for phase in limit.phases)
            circling += 1
            continue
        assert named(run) == named(limit), seed
        for own, other in zip(run.phases, limit.phases, strict=True):
            assert own.t_start == pytest.approx(other.t_start, abs=0.02), seed
        compared += 1
    assert compared >= 17
    assert circling <= 1


def test_a_cycle_that_is_followed_is_named():
    system, psi = ELinear(172.0, 186.0, -200.0, (-86.0, -93.0)), families.hill(3)
    (cycle,) = limit_cycles(system, psi)
    eps = 1e-3
    p = cycle.points[0]
    run = simulate(system, psi, eps * p / np.sqrt(1.0 - p @ p), (0.0, 12.0 * eps * cycle.period), eps=eps)
    assert named(run) == [("slide", "cycle 1")]


def test_the_middle_of_the_hemisphere_decides_a_start_on_sigma():
    system = ELinear(1.72, 1.86, -2, f=("-1.72*z1", "-1.86*z1"), B=[[0, 0], [1, 1]], g=(-0.1, 0))
    start, psi = (0.0, 0.0, 0.9, 0.0), families.hill(2)
    limit = simulate_nonsmooth(system, start, (0.0, 12.0), psi)
    assert named(limit) == [("slip", None)]
    run = simulate(system, psi, start, (0.0, 12.0), eps=1e-8)
    np.testing.assert_allclose(run.states[-1], limit.states[-1], atol=1e-4)
    assert limit.states[-1, 3] == pytest.approx(-16.95, abs=0.01)


def test_phases_carry_their_place():
    system, psi = examples.nonunique_sliding(), families.constant()
    limit = simulate_nonsmooth(system, (0.25, 0.3, 0.0), (0.0, 2.0), psi)
    slip, slide = limit.phases
    assert slide.onto == "C3"
    times = np.linspace(slide.t_start, slide.t_end, 7)
    z = limit.dense(times)[:, 2]
    np.testing.assert_allclose(
        slide.e(times), np.stack([(1 + 2 * z**2) / (1 + z**2) / 2, 0 * z], axis=-1), rtol=0.0, atol=1e-12
    )
    C3 = critical_sets(system, psi, (z[3],))[2]
    np.testing.assert_allclose(slide.p(times[3]), C3.p, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(np.hypot(*slip.e(np.linspace(0.0, slip.t_end, 5)).T), 1.0)
    # Up the hemisphere in no time: from the equator, at the angle of arrival, to the set.
    ascent = slide.ascent
    assert np.hypot(*ascent[0]) > 1.0 - 1e-5
    np.testing.assert_allclose(ascent[0], slip.e(slip.t_end), atol=1e-4)
    np.testing.assert_allclose(ascent[-1], slide.p(slide.t_start), atol=1e-3)
    with pytest.raises(ValueError, match="this phase lasts"):
        slip.e(1.9)
    drawn = limit.drawn()
    np.testing.assert_allclose(drawn.points[-1], slide.p(2.0), rtol=0.0, atol=1e-12)
    assert (np.diff(drawn.times) >= 0.0).all()
    smooth = simulate(system, psi, (0.25, 0.3, 0.0), (0.0, 2.0), eps=1e-4)
    np.testing.assert_allclose(smooth.drawn().points[-1], drawn.points[-1], atol=1e-3)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("turn", [0.0, 0.5 * np.pi])
def test_in_an_invariant_line_the_way_up_ends_where_the_slide_begins(side, turn):
    """C = (z, 0), or the same turned: what comes to Sigma at one end of the line climbs to C, and leaves at z = 1."""
    f = ("z", 0.0) if turn == 0.0 else (0.0, "z")
    n = np.array([np.cos(turn), np.sin(turn)])
    start = (*(0.1 * side * n + 0.0), -0.5)
    limit = simulate_nonsmooth(ELinear(-1.0, 0.0, -1.0, f, g=(1.0,)), start, (0.0, 2.5), families.constant())
    slip, slide, away = limit.phases
    assert [phase.kind for phase in limit.phases] == ["slip", "slide", "slip"]
    z = float(limit.dense(slide.t_start)[2])
    np.testing.assert_allclose(slide.e(slide.t_start), z * n, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(slide.ascent[0], side * n, atol=1e-6)
    np.testing.assert_allclose(slide.ascent[-1], slide.p(slide.t_start), atol=1e-5)  # as far as it is drawn
    assert float(limit.dense(away.t_start)[2]) == pytest.approx(1.0, abs=1e-9)
    np.testing.assert_allclose(away.e(away.t_end), n, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(slip.e(0.0), side * n, rtol=0.0, atol=1e-12)
