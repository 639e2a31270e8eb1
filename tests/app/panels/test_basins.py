"""The layer "Basins" is as fine as what is seen: near by it is computed for a part of the disc, once nothing moves."""

import numpy as np
import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.slow_layers.basins import CELLS_ACROSS, DISC, part_of
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames


@pytest.mark.parametrize("size", [3.0, 1.6, 1.4, 0.7, 0.2, 0.013])
@pytest.mark.parametrize("middle", [(0.0, 0.0), (0.31, -0.44), (-0.7, 0.69)])
def test_the_box_holds_what_is_seen_and_is_not_much_larger(size, middle):
    (x, y), half = middle, size / 2
    window = (x - half, x + half, y - half, y + half)
    (left, right, bottom, top), cells = part_of(window)
    seen = np.clip(window, -1.0, 1.0)
    assert left <= seen[0] < seen[1] <= right
    assert bottom <= seen[2] < seen[3] <= top
    assert (right - left) / cells <= size / 89  # some seven pixels of a picture of 640


def test_what_is_next_to_the_disc_needs_no_box():
    assert part_of((1.5, 1.8, 0.0, 0.3)) == part_of(None) == (DISC, CELLS_ACROSS)


def test_a_small_pan_keeps_the_box():
    boxes = {part_of((0.3 + d, 0.4 + d, 0.1, 0.2)) for d in np.linspace(0.0, 0.01, 20).tolist()}
    assert len(boxes) <= 2


def at_rest(frames, window, **more):
    """The frames that come at rest: the first, and the one once the cells are there."""
    first = unpack(frames.answer({"rest": True, "window": window, **more}))
    waits = frames.jobs.future("basins")
    if waits is None:
        return first[0], first
    waits.result(60)
    return first[0], unpack(frames.answer({"rest": True, "window": window}))


def test_what_the_browser_has_stays_until_finer_cells_are_there():
    state = ExplorerState.from_values(
        {"preset": "nonunique-sliding", "layers": ["basins"], "trajectories": 0, "panel": "psi"}
    )
    frames = Frames(state)
    _, (whole, _) = at_rest(frames, [-2, 2, -2, 2, 0.006], all=True)
    assert whole["basins"]["box"] == list(DISC)
    window = [0.1, 0.2, 0.3, 0.4, 1.5e-4]
    header, _ = unpack(frames.answer({"id": 1, "set": {}, "window": window}))
    assert "basins" not in header
    assert "window" in header["late"]
    assert "basins" not in header["late"]  # it is true, if coarse
    first, (header, blocks) = at_rest(frames, window)
    assert "basins" in first or "basins" not in first["late"]
    left, right, bottom, top = header["basins"]["box"]
    assert left <= 0.1 < 0.2 <= right < 0.5
    assert bottom <= 0.3 < 0.4 <= top < 0.7
    assert blocks["basins"].reshape(-1, 2)[:, 0].sum() == header["basins"]["cells"] ** 2
    header, _ = unpack(frames.answer({"id": 3, "rest": True, "window": [0.101, 0.2, 0.301, 0.4, 1.5e-4]}))
    assert "basins" not in header
    header, _ = unpack(frames.answer({"id": 4, "set": {"z": 0.5}, "window": window}))
    assert "basins" in header["late"]  # of another system
