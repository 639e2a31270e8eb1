"""Lines are packed into few bytes, and nothing is lost that is seen."""

import math

import numpy as np
import pytest
from codim2_app.picture.draw import glyphs
from codim2_app.picture.draw.packing import INT16_RANGE, INT16_STEP, Polylines, pack, quantise, unpack
from hypothesis import given
from hypothesis import strategies as st

LINE = np.column_stack([np.linspace(0, 1, 11), np.zeros(11)])
POLYLINES = st.lists(st.integers(0, 9), max_size=5).map(
    lambda sizes: [np.random.default_rng(size).uniform(-2, 2, (size, 2)) for size in sizes]
)


def test_packing_round_trip():
    points = np.random.default_rng(1).uniform(-3, 3, (101, 2))
    buffer = pack({"id": 3, "words": "θ"}, {"n": np.array([101], np.uint16), "xy": quantise(points)})
    header, blocks = unpack(buffer)
    assert (header["id"], header["words"]) == (3, "θ")
    assert blocks["n"].tolist() == [101]
    assert np.abs(blocks["xy"].reshape(-1, 2) * INT16_STEP - points).max() <= INT16_STEP / 2 * 1.001


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
    assert pytest.approx(INT16_RANGE) == 32767 * INT16_STEP
    with pytest.raises(ValueError, match="not JSON compliant"):
        pack({"x": math.nan}, {})


def test_lines_and_arrays_are_packed_side_by_side():
    line = np.array([[0.5, -0.25], [0.75, 1.0], [-INT16_RANGE, 9.0]])
    blocks = {
        "a": Polylines(np.array([0, 3]), line, True),
        "b": Polylines(np.array([0, 1, 1]), line[:1]),
        "c": np.arange(3, dtype=np.uint16),
    }
    header, arrays = unpack(pack({"id": 7}, blocks, window=(-2.0, 2.0, -2.0, 2.0), pixel=0.001))
    assert header["exact"] is True
    assert arrays["a.xy"].tolist() == line.ravel().tolist()
    assert arrays["b.n"].tolist() == [1, 0]
    assert (arrays["a.n"].tolist(), arrays["c"].tolist(), arrays["c"].dtype.name) == ([3], [0, 1, 2], "uint16")
    assert len(arrays["a.angle"]) * 2 == len(arrays["a.at"]) > 0
    assert "b.at" not in arrays
    header, arrays = unpack(pack({"id": 7}, blocks))
    assert "exact" not in header
    assert arrays["a.xy"].tolist() == [4096, -2048, 6144, 8192, -32767, 32767]
    slope = math.atan2(1.25, 0.25)
    assert arrays["a.angle"][0] == round(slope / math.pi * 32767)
