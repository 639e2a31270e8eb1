"""Each value that is known is computed again, by another way than its formula, and this package finds it."""

import pickle

import pytest

from codim2_core import reference
from codim2_core.motion.reference import sliding

G = 9.81


@pytest.mark.parametrize("key", reference.catalogue)
def test_what_is_found_is_what_is_known(key):
    motion = reference.catalogue[key]
    for known, one in zip(motion.values, motion.compare(), strict=True):
        assert one.difference == pytest.approx(0.0, abs=known.error + 1e-11 * max(1.0, abs(known.value))), one.name


def test_another_solver_is_scored():
    box = reference.catalogue["box-stops"]
    found = box.compare(lambda: (1.25, 3.0), "mine")
    assert [one.difference for one in found] == pytest.approx([1.25 - 6.0 / (0.5 * G), 3.0 - 36.0 / G])
    assert found.solver == "mine"
    assert found.largest == pytest.approx(abs(3.0 - 36.0 / G) / (36.0 / G))
    with pytest.raises(ValueError, match="these 2: time to rest, way to rest"):
        box.compare(lambda: (1.0,))


def test_motions_are_results():
    for motion in reference.catalogue.values():
        again = pickle.loads(pickle.dumps(motion))
        assert again == motion
        assert again.values[0].formula in again.values[0]._repr_html_()
    frame = reference.catalogue["pool"].compare().to_frame()
    assert list(frame["name"]) == ["time until it rolls", "speed at which it rolls", "speed after 3 s"]


def test_mujoco_comes_near():
    pytest.importorskip("mujoco")
    from codim2_core.motion.reference.mujoco import FOLLOWED, follow_in_mujoco

    for key in FOLLOWED:
        found = follow_in_mujoco(reference.catalogue[key])
        assert 1e-6 < found.largest < 0.05, key  # near, and not by our own simulator
    with pytest.raises(ValueError, match="no model in MuJoCo here"):
        follow_in_mujoco(sliding.BELT)
