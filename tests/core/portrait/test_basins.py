"""Basins against symmetry, the one-attractor theorem, and trajectories followed one by one."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait import basins as module
from codim2_core.portrait.basins import OUTSIDE, UNDECIDED_CELL, basins


def centres(n):
    x = (np.arange(n) + 0.5) * (2.0 / n) - 1.0
    return np.stack(np.meshgrid(x, x), axis=-1)


def test_the_two_basins_of_nonunique_sliding_are_the_halves_of_the_disc():
    """x = 0 is invariant (the saddle C2 and its stable manifold) and everything is odd in x."""
    found = basins(c2.examples.nonunique_sliding(), c2.psi.tanh(), (0.4,), n=64)
    assert found.destinations == ("C1", "C3")
    x = centres(64)[..., 0]
    inside = found.cells != OUTSIDE
    np.testing.assert_array_equal(found.cells[inside], (x[inside] > 0).astype(np.int8))
    chi = (1.0 + 2.0 * 0.16) / 1.16
    np.testing.assert_allclose([flow[0] for flow in found.slow_flow], [chi + 0.25, -chi + 0.25])


def test_case_three_has_the_cycle_as_a_destination_with_the_mean_slow_flow():
    system = c2.presets["case3-n4"].system
    slow = c2.ELinear(system.a, system.b, system.d, system.f, B=((1.0, 2.0),), g=(0.5,))
    found = basins(slow, c2.psi.hill(4), (0.0,), n=32)
    assert "cycle 1" in found.destinations
    flow = found.slow_flow[found.destinations.index("cycle 1")]
    np.testing.assert_allclose(flow, c2.sliding_flow(slow, (0.0,)), rtol=0.0, atol=1e-6)  # prop:LC


def test_cells_that_lead_nowhere_are_told_by_negative_numbers():
    """Closed orbits about C in all of the disc."""
    found = basins(c2.ELinear(0.0, 1.0, 0.0), c2.psi.constant(), n=32)
    inside = np.hypot(*np.moveaxis(centres(32), -1, 0)) < 1.0
    np.testing.assert_array_equal(found.cells, np.where(inside, -1, -2))
    assert (OUTSIDE, UNDECIDED_CELL, found.destinations, found.slow_flow) == (-2, -1, (), ())


@pytest.mark.parametrize(("n", "friction"), [(32, 0.1), (64, 0.5)])
def test_a_border_that_winds_is_where_orbits_that_are_followed_closely_say(n, friction, monkeypatch):
    """Two wells with friction: x' = y, y' = x/2 - 2 x^3 - friction y before it is regularised."""
    system, psi = c2.System(U=("s", f"c/2 - 2*c**3 - {friction}*s")), c2.psi.constant()
    asked = []

    def counted(*arguments, **options):
        asked.append(c2.trajectories(*arguments, **options))
        return asked[-1]

    monkeypatch.setattr(module, "trajectories", counted)
    found = basins(system, psi, n=n)
    assert found.evaluations == sum(one.evaluations for one in asked) > 0
    followed, every = sum(len(one) for one in asked), (found.cells != OUTSIDE).sum()
    assert followed == every if n == 32 else followed < 0.8 * every  # refined at borders only
    inside = np.flatnonzero((found.cells != OUTSIDE).ravel())[:: n // 16 - 1]
    places, kinds = centres(n).reshape(-1, 2)[inside], found.cells.ravel()[inside]
    lines = c2.trajectories(system, psi, places, t_max=400.0, rtol=1e-9, atol=1e-9, samples="ends")
    sets = [C for C in c2.critical_sets(system, psi) if C.kind.startswith("stable")]
    away = np.hypot(*(lines.ends[:, None, :2] - np.array([C.p for C in sets])).transpose(2, 0, 1))
    assert (away.min(axis=1) < 1e-2).all()
    assert (kinds != np.argmin(away, axis=1)).mean() <= 0.005  # next to a border, or a tongue thinner than the cells


def test_a_part_seen_nearer_has_the_cells_of_the_whole_as_finely():
    preset = c2.presets["case3-n3"]
    whole = basins(preset.system, preset.psi, n=256)
    part = basins(preset.system, preset.psi, n=64, box=(0.25, 0.75, -0.25, 0.25))  # cells of the same size
    names = np.array(["", "", *whole.destinations])[whole.cells[96:160, 160:224] + 2]
    np.testing.assert_array_equal(np.array(["", "", *part.destinations])[part.cells + 2], names)
    assert len(set(names.ravel().tolist())) == 2
    near = basins(preset.system, preset.psi, n=32, box=(0.9, 1.1, -0.1, 0.1))
    x = 0.9 + (np.arange(32) + 0.5) * (0.2 / 32)
    y = x - 1.0
    np.testing.assert_array_equal(near.cells == OUTSIDE, np.hypot(*np.meshgrid(x, y)) >= 1.0)


def test_shares_are_parts_of_the_cells_of_the_disc():
    """Two halves; and a quarter that leads nowhere, whose cells count as well."""
    found = basins(c2.examples.nonunique_sliding(), c2.psi.tanh(), (0.4,), n=64)
    assert found.shares == (0.5, 0.5)
    cells = np.full((4, 4), OUTSIDE, np.int8)
    cells[1:3] = [[UNDECIDED_CELL, 0, 0, 1], [UNDECIDED_CELL, 0, 1, 0]]
    assert module.Basins(cells, ("C1", "C2"), (None, None), 0).shares == (0.5, 0.25)
    nothing = np.full((4, 4), OUTSIDE, np.int8)
    assert module.Basins(nothing, ("C1",), (None,), 0).shares == (0.0,)


def test_a_notebook_shows_the_picture_and_the_shares():
    told = basins(c2.examples.nonunique_sliding(), c2.psi.tanh(), (0.4,), n=32)._repr_html_()
    assert told.index("<img") < told.index("<table")
    assert told.count("<td>0.5</td>") == 2
