import math

import numpy as np
import pytest
from codim2_app.draw import glyphs
from codim2_app.draw.packing import EXTENT, STEP, Polylines, pack, quantise, unpack
from hypothesis import given
from hypothesis import strategies as st

import codim2_core as c2

LINE = np.column_stack([np.linspace(0, 1, 11), np.zeros(11)])


def test_join_never_mixes_pieces():
    offsets, points = glyphs.join([LINE, LINE[:3] + 5])
    assert offsets.tolist() == [0, 11, 14]
    assert points[11].tolist() == [5, 5]


@given(st.lists(st.floats(0, 6.28), min_size=1, max_size=8).map(sorted))
def test_labels_are_apart(angles):
    moved = glyphs.spread(angles)
    for i, angle in enumerate(moved):
        following = moved[(i + 1) % len(moved)] + (2 * math.pi if i + 1 == len(moved) else 0)
        assert following - angle > 0.8 * glyphs.LABEL_GAP


def test_equator_marks_tell_the_types_apart():
    q = glyphs.equator_columns(c2.equator_equilibria(c2.ELinear(-0.3, 0, -1, (0.5, 0))))
    assert q["label"] == ["Q₁", "Q₂", "Q₃", "Q₄"]
    assert q["filled"] == [int(v < 0) for v in q["lambda_rho"]]
    assert len({(s, f) for s, f in zip(q["shape"], q["filled"], strict=True)}) >= 2
    for shape, rate in zip(q["shape"], q["lambda_theta"], strict=True):
        assert shape == ("circle" if rate < 0 else "diamond")


@pytest.mark.parametrize(("g0", "sense"), [(1.0, "⊙"), (-1.0, "⊗"), (0.0, "")])
def test_the_slow_flow_comes_out_of_the_page_where_it_is_positive(g0, sense):
    system = c2.ELinear(-2, 0, -1, (0, 0), B=((0, 0),), g=(g0,))
    assert glyphs.critical_columns(c2.critical_sets(system, c2.psi.constant(), (0.0,)))["sense"] == [sense]


def test_equator_arrows_follow_theta():
    system = c2.ELinear(-2, 0.3, -1, (-0.5, 0.1))
    at = system.at()
    arrows = glyphs.equator_arrows(c2.equator_equilibria(system))
    assert len(arrows) >= 2
    for x, y, angle in arrows:
        assert np.dot(at.U((x, y)), (-y, x)) * np.dot((math.cos(angle), math.sin(angle)), (-y, x)) > 0


def test_closed_equator_turns_the_right_way():
    for b in (1.0, -1.0):
        system = c2.ELinear(-1, b, -1)
        cycle = c2.equator_cycle(system)
        x, y, angle = glyphs.equator_arrows(c2.equator_equilibria(system), cycle.direction)[0]
        assert math.copysign(1, x * math.sin(angle) - y * math.cos(angle)) == math.copysign(1, b)


def test_packing_round_trip():
    points = np.random.default_rng(1).uniform(-3, 3, (101, 2))
    buffer = pack({"id": 3, "words": "θ"}, {"n": np.array([101], np.uint16), "xy": quantise(points)})
    header, blocks = unpack(buffer)
    assert (header["id"], header["words"]) == (3, "θ")
    assert blocks["n"].tolist() == [101]
    assert np.abs(blocks["xy"].reshape(-1, 2) * STEP - points).max() <= STEP / 2 * 1.001


POLYLINES = st.lists(st.integers(0, 9), max_size=5).map(
    lambda sizes: [np.random.default_rng(size).uniform(-2, 2, (size, 2)) for size in sizes]
)


@given(st.lists(st.tuples(POLYLINES, st.booleans()), max_size=4))
def test_layers_packed_together_are_the_layers_alone(layers):
    """Arrowheads and coordinates of all layers are made in one pass; each must be as if there were no other."""
    blocks = {f"layer {i}": Polylines(*glyphs.join(pieces), arrows) for i, (pieces, arrows) in enumerate(layers)}
    _, together = unpack(pack({}, {**blocks, "more": np.arange(3, dtype=np.int16)}))
    assert together.pop("more").tolist() == [0, 1, 2]
    alone = {}
    for name, block in blocks.items():
        alone |= unpack(pack({}, {name: block}))[1]
        counts, points = alone[f"{name}.n"], alone[f"{name}.xy"]
        assert counts.tolist() == np.diff(block.offsets).tolist()
        assert points.tolist() == quantise(block.points).ravel().tolist()
        assert (f"{name}.at" in alone) == block.arrows
    assert {name: values.tolist() for name, values in together.items()} == {
        name: values.tolist() for name, values in alone.items()
    }


def test_far_points_move_to_the_edge_and_nan_is_refused():
    assert quantise(np.array([[1e300, -1e300]])).tolist() == [[32767, -32767]]
    assert pytest.approx(EXTENT) == 32767 * STEP
    with pytest.raises(ValueError, match="not JSON compliant"):
        pack({"x": math.nan}, {})
