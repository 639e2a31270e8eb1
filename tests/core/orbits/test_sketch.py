"""What is drawn while the kernels are compiled is what they draw then, within some pixels."""

import numpy as np
import pytest

from codim2_core.figures.presets import presets
from codim2_core.scene import Scene
from tests.core.polylines import away

NEAR = 0.03  # in picture units: four pixels of a small picture


@pytest.mark.parametrize("name", ["case1-cm4", "case2-saddle", "case3-n2", "case3-n4", "ball-slip", "regularisation"])
def test_a_sketch_lies_on_the_trajectories(name):
    preset = presets[name]
    scene = Scene(preset.system, preset.psi, preset.z, count=24)
    for layer in ("inside", "outside"):
        exact, drawn = scene[layer], scene[f"{layer}_sketch"]
        assert len(drawn) == len(exact) > 0
        lines = [drawn.buffer[i:j] for i, j in zip(drawn.offsets, drawn.offsets[1:], strict=False)]
        assert max(away(line, points).max() for line, points in zip(lines, exact.points, strict=True)) < NEAR
        for line, points in zip(lines, exact.points, strict=True):  # with time, as the arrowheads say
            starts, ends = np.hypot(*(points - line[0]).T).argmin(), np.hypot(*(points - line[-1]).T).argmin()
            assert starts <= ends
        assert all(np.hypot(*np.diff(line, axis=0).T).max(initial=0.0) < 0.2 for line in lines)
