import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from codim2_core.portrait.orbits.seeds import structured_seeds, window_seeds


@given(st.integers(0, 400), st.floats(1.1, 5.0))
def test_structured_seeds_are_that_many_in_view_and_off_the_equator(count, view):
    seeds = structured_seeds(count, view)
    radius = np.hypot(seeds[:, 0], seeds[:, 1])
    assert seeds.shape == (count, 2)
    assert ((radius < 0.95) | ((radius > 1.0) & (radius < view))).all()
    assert len(np.unique(seeds.round(12), axis=0)) == count


@pytest.mark.parametrize("count", [32, 64, 128])
def test_structured_seeds_are_symmetric_about_both_axes_and_lie_on_neither(count):
    seeds = {tuple(p) for p in structured_seeds(count).round(12).tolist()}
    assert {(-x, y) for x, y in seeds} == seeds == {(x, -y) for x, y in seeds}
    assert min(min(abs(x), abs(y)) for x, y in seeds) > 0.01


@pytest.mark.parametrize("count", [-1, 2001])
def test_the_number_of_seeds_is_bounded(count):
    with pytest.raises(ValueError, match="0 to 2000"):
        structured_seeds(count)


@given(st.integers(1, 200), st.floats(-2, 2), st.floats(0.05, 3))
def test_window_seeds_fill_the_window_evenly(count, left, size):
    window = left, left + size, -1.0, -1.0 + 0.7 * size
    seeds = window_seeds(count, window)
    assert 0.6 * count - 2 <= len(seeds) <= 1.6 * count + 2
    assert ((seeds > (window[0], window[2])) & (seeds < (window[1], window[3]))).all()
    assert len(np.unique(seeds, axis=0)) == len(seeds)


def test_a_scene_with_a_window_has_orbits_in_it():
    import codim2_core as c2

    scene = c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)))
    near = scene.evolve(window=(0.3, 0.4, 0.5, 0.6))
    assert len(near["inside"]) == len(scene["inside"]) + len(window_seeds(32, (0.3, 0.4, 0.5, 0.6)))
    with pytest.raises(ValueError, match="left < right"):
        scene.evolve(window=(1.0, 0.0, 0.0, 1.0))
