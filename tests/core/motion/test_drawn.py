"""A drawn motion looks like the motion: its chords are nowhere seen to leave the curve."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import psi
from codim2_core.motion.result import CHORD_TOLERANCE

TURNING = c2.System(U=("mu*c-s-beta*c*(c*c+s*s)", "c+mu*s-beta*s*(c*c+s*s)"), W=(), parameters={"mu": 0.3, "beta": 1.0})


def off(run, drawn, eps):
    """Largest distance of the curve from the chord between two drawn times, at eight times between them."""
    share = np.linspace(0.0, 1.0, 10)[1:-1]
    t = drawn.times[:-1, None] + np.diff(drawn.times)[:, None] * share
    x, y = np.moveaxis(run.dense(t)[..., :2], -1, 0)
    rho = np.hypot(np.hypot(x, y), eps)
    points = np.stack([x, y], axis=-1) * ((1.0 + rho) / rho)[..., None]
    a, side = drawn.points[:-1, None], np.diff(drawn.points, axis=0)[:, None]
    way = np.clip(((points - a) * side).sum(-1) / np.maximum((side**2).sum(-1), 1e-300), 0.0, 1.0)
    away = np.linalg.norm(points - a - way[..., None] * side, axis=-1)
    return float((away / np.maximum(1.0, np.linalg.norm(points, axis=-1))).max())


@pytest.mark.parametrize("turns", [2, 88])
def test_an_orbit_that_turns_often_is_round(turns):
    eps = 0.01
    run = c2.simulate(TURNING, psi.constant(), (0.002, 0.0), (0.0, 0.01 * 2.0 * np.pi * turns), eps=eps)
    drawn = run.drawn()
    assert off(run, drawn, eps) < 1.5 * CHORD_TOLERANCE
    radius = np.hypot(*drawn.points[len(drawn.points) // 2 :].T)
    middle = np.hypot(*(0.5 * (drawn.points[1:] + drawn.points[:-1]))[len(drawn.points) // 2 :].T)
    assert abs(radius - middle.mean()).max() < 3.0 * CHORD_TOLERANCE or turns < 10  # no chord is inside the cycle
    assert len(drawn.times) < 240 + 60 * turns


def test_in_the_limit_it_stays_on_its_cycle():
    """|e|^2 = mu/beta on the cycle, for every Psi."""
    system = TURNING.evolve(W=("1",))
    run = c2.simulate_nonsmooth(system, (0.3, 0.0, 0.0), (0.0, 2.0), psi=psi.constant())
    phase = run.phases[-1]
    assert phase.onto == "cycle 1"
    drawn = run.drawn()
    on = drawn.points[drawn.times > phase.t_start + 1e-9]
    assert len(on) > 10
    np.testing.assert_allclose(np.hypot(*on.T), np.sqrt(0.3), atol=3.0 * CHORD_TOLERANCE)
