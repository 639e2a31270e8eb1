import pytest

from codim2_core.portrait.orbits.seeds import structured_seeds, window_seeds


@pytest.mark.parametrize("count", [-1, 2001])
def test_the_number_of_seeds_is_bounded(count):
    with pytest.raises(ValueError, match="0 to 2000"):
        structured_seeds(count)


def test_a_scene_with_a_window_has_orbits_in_it():
    import codim2_core as c2

    scene = c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)))
    near = scene.evolve(window=(0.3, 0.4, 0.5, 0.6))
    assert len(near["inside"]) == len(scene["inside"]) + len(window_seeds(32, (0.3, 0.4, 0.5, 0.6)))
    with pytest.raises(ValueError, match="left < right"):
        scene.evolve(window=(1.0, 0.0, 0.0, 1.0))
