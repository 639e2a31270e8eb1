"""The regions into which the curves cut the plane of f."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, bifurcations, classify, psi
from tests.core.strategies import coefficient

matrices = st.tuples(coefficient, coefficient, coefficient)
CASE3 = (172.0, 186.0, -200.0)


def contains(loop, point):
    x, y = loop[:, 0] - point[0], loop[:, 1] - point[1]
    nx, ny = np.roll(x, -1), np.roll(y, -1)
    spans = (y > 0.0) != (ny > 0.0)
    right = x - y * (nx - x) / np.where(spans, ny - y, 1.0) > 0.0
    return bool((spans & right).sum() % 2)


def clear_of_borders(found, points, distance):
    """Those of the points that are farther than that from all borders of regions: a polygon is not quite the curve."""
    start = np.concatenate([np.zeros((1, 2)), *(loop for r in found for loop in r.boundary)])
    step = np.concatenate([np.zeros((1, 2)), *(np.roll(x, -1, axis=0) - x for r in found for x in r.boundary)])
    square = np.maximum((step**2).sum(axis=1), 1e-300)
    x, y = (points[:, k, None] - start[:, k] for k in range(2))  # (points, parts of borders)
    along = np.clip((x * step[:, 0] + y * step[:, 1]) / square, 0.0, 1.0)
    return points[np.hypot(x - along * step[:, 0], y - along * step[:, 1]).min(axis=1) >= distance]


def region_at(found, f):
    inside = [r for r in found if r.bounded and sum(contains(loop, f) for loop in r.boundary) % 2]
    assert len(inside) <= 1
    return inside[0] if inside else found[-1]


TYPICAL = [
    (-1, 1, -1), (-2, 0, -1), (-1, 0.3, -2.5), (1, 0.3, -1), (1, 1.2, -1.2), CASE3, (-1, 0, -1), (0, 1, 0),
    (1, 1, -1), (0, 1, -1), (-2, 0.4, 0), (-1, 1.5, -2), (-1, 0.5, -2), (-1, 0.7, -2), (1, 3 * math.sqrt(2), -2),
    (0, 0, 0), (1, 0, 0), (-1, 0, -1.5),
]  # fmt: skip


@pytest.mark.parametrize("abd", TYPICAL)
def test_regions_agree_with_classification_of_random_points(abd):
    found = bifurcations.regions(ELinear(*abd))
    rng = np.random.default_rng(7)
    extent = 1.2 * max((float(abs(loop).max()) for r in found for loop in r.boundary), default=1.0)
    hit = set()
    corners = np.stack(np.meshgrid(*2 * [np.arange(-8, 8)]), axis=-1).reshape(-1, 2)
    points = (corners + rng.uniform(0.0, 1.0, corners.shape)) * extent / 8  # one in each of 16 times 16 squares
    for f in clear_of_borders(found, points, 2e-3 * extent):
        region = region_at(found, f)
        assert classify(ELinear(*abd, tuple(f)), psi.constant()).name == region.name
        hit.add(id(region))
    areas = {id(r): region_area(r) for r in found if r.bounded}
    assert all(key in hit for key, area in areas.items() if area > 0.03 * extent**2)


def region_area(region):
    loops = region.boundary
    return sum(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)) for x, y in (loop.T for loop in loops))


@settings(max_examples=20)
@example((1.25, 0.0, 0.0), 0)  # a line of equilibria passes through the middle
@example((1.0, 0.0, 0.0), 7)
@given(matrices, st.integers(0, 2**32 - 1))
def test_regions_of_random_matrices(abd, seed):
    size = max(map(abs, abd))
    # Below 1e-6 of the rest a or d counts as 0 and the sliver |A^-1 f| < 1 is no region: a point inside may lie on it.
    assume(all(v == 0.0 or abs(v) > 2e-6 * size for v in (abd[0], abd[2])))
    found = bifurcations.regions(ELinear(*abd))
    extent = 1.2 * max((float(abs(loop).max()) for r in found for loop in r.boundary), default=1.0)
    system = ELinear(*abd)
    for r in found:
        if region_area(r) > 1e-3 * size**2:  # the polygons of slivers may overlap, by the distance of chord and arc
            assert region_at(found, r.inside) is r
        assert r.name == classify(system.evolve(f=r.inside), psi.rational()).name
    points = np.random.default_rng(seed).uniform(-extent, extent, (25, 2))
    for f in clear_of_borders(found, points, 2e-3 * extent):
        assert classify(system.evolve(f=tuple(f)), psi.constant()).name == region_at(found, f).name


@pytest.mark.parametrize("small", [1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 1e-12])
def test_close_to_degenerate_matrices_nothing_is_classified_wrongly(small):
    first = [(small, 1, -1), (1, 1, -small), (small, 3, -small), (small, 3, small), (-1, 0.5 + small, -2)]
    second = [(-1, 1.5 - small, -2), (-2, small, -1), (-2, 0, -1 - small), (1, 1 + small, -1), (-1, small, -1)]
    for abd in first + second:
        found = bifurcations.regions(ELinear(*abd))
        border = np.concatenate([loop for r in found for loop in r.boundary])
        extent = 1.2 * float(abs(border).max())
        points = np.random.default_rng(3).uniform(-extent, extent, (25, 2))
        for f in clear_of_borders(found, points, 2e-3 * extent):
            assert classify(ELinear(*abd, tuple(f)), psi.constant()).name == region_at(found, f).name


def test_the_pinched_annulus_of_cusps_on_the_ellipse_is_two_regions():
    assert sorted(r.name for r in bifurcations.regions(ELinear(-2, 0, -1))) == ["CM2", "CM2", "CM4", "NCM2"]
