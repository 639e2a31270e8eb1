"""What a layer draws of what the core found: each piece with its owner."""

from types import SimpleNamespace

import numpy as np
import pytest
from codim2_app.picture.draw import layers


@pytest.mark.parametrize(("direction", "names"), [("stable", ["S1", "S5"]), ("unstable", ["S2"])])
def test_separatrices_of_a_direction_are_those_on_the_hemisphere_with_their_numbers(direction, names):
    kinds = [(True, "stable"), (True, "unstable"), (False, "stable"), (False, "unstable"), (True, "stable")]
    branches = [
        SimpleNamespace(points=np.array([[float(i), 0.0], [float(i), 1.0]]), inside=inside, direction=way)
        for i, (inside, way) in enumerate(kinds)
    ]
    offsets, points = layers._direction_lines(direction)(branches)
    assert layers._of_direction(direction)(branches) == names
    assert offsets.tolist() == [2 * k for k in range(len(names) + 1)]
    assert [f"S{int(x) + 1}" for x in points[offsets[:-1], 0]] == names


def test_branches_are_told_apart_by_their_kinds():
    branches = [SimpleNamespace(points=np.full((3, 2), k), kind=kind) for k, kind in enumerate(("rho", "U1", "theta"))]
    offsets, points = layers._lines_of_kinds("rho", "theta")(branches)
    assert offsets.tolist() == [0, 3, 6]
    assert points[:, 0].tolist() == [0.0] * 3 + [2.0] * 3
