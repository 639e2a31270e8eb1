"""What is drawn while the kernels are compiled is what they draw then, within some pixels."""

import numpy as np
import pytest

from codim2_core.figures.presets import presets
from codim2_core.scene import Scene

NEAR = 0.03  # in picture units: four pixels of a small picture


def far(points, line):
    """Largest distance of points from a polyline."""
    a, b = line[:-1], line[1:]
    d = b - a
    size = np.maximum((d**2).sum(axis=-1), 1e-300)
    t = np.clip(((points[:, None] - a) * d).sum(axis=-1) / size, 0.0, 1.0)
    foot = a + t[..., None] * d
    return np.hypot(*(points[:, None] - foot).transpose(2, 0, 1)).min(axis=1).max()


@pytest.mark.parametrize("name", ["case1-cm4", "case2-saddle", "case3-n2", "case3-n4", "ball-slip", "regularisation"])
def test_a_sketch_lies_on_the_trajectories(name):
    preset = presets[name]
    scene = Scene(preset.system, preset.psi, preset.z, count=24)
    for layer in ("inside", "outside"):
        exact, drawn = scene[layer], scene[f"{layer}_sketch"]
        assert len(drawn) == len(exact) > 0
        lines = [drawn.buffer[i:j] for i, j in zip(drawn.offsets, drawn.offsets[1:], strict=False)]
        assert max(map(far, lines, exact.points)) < NEAR
        for line, points in zip(lines, exact.points, strict=True):  # with time, as the arrowheads say
            starts, ends = np.hypot(*(points - line[0]).T).argmin(), np.hypot(*(points - line[-1]).T).argmin()
            assert starts <= ends
        assert all(np.hypot(*np.diff(line, axis=0).T).max(initial=0.0) < 0.2 for line in lines)
