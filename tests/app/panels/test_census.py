"""The panel "Census": its shares are a census's, and each of its examples is of the name that it stands for."""

import pytest
from codim2_app.panels.census import COEFFICIENT_RANGE, _polynomial
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.state.choices import CENSUSES, MOST_CENSUS
from codim2_app.picture.state.cleaning import clean
from codim2_app.picture.state.controls import ExplorerState
from hypothesis import given
from hypothesis import strategies as st

import codim2_core as c2

from .opening import ask, opened, settled

SIZE = 0


@pytest.fixture(scope="module", params=list(CENSUSES))
def shown(request):
    """A draw, and all that the browser has of its census."""
    _, header = opened("census", census=request.param, census_size=SIZE)
    return request.param, header


def test_what_is_shown_is_a_census(shown):
    draw, header = shown
    rows = header["census"]["rows"]
    table = c2.census(draw, count=CENSUSES[draw][1] * 10**SIZE).table
    assert [row[:2] for row in rows] == [[row.name, row.count] for row in table]
    for (_, _, *shares, _), row in zip(rows, table, strict=True):
        assert shares == pytest.approx([row.share, row.low, row.high], rel=1e-5)
    assert header["census"]["draw"] == draw
    assert set(header["census_portraits"]) == {row.name for row in table}
    assert all(svg.startswith("<svg") and "<path" in svg for svg in header["census_portraits"].values())


def test_each_example_opens_as_a_portrait_of_its_name(shown):
    """Through all that a browser's values go through: bounds of sliders, readers of formulas."""
    _, header = shown
    for name, *_, controls in header["census"]["rows"]:
        values = {control: clean(control, value) for control, value in controls.items()}
        scene = make_scene({**ExplorerState().values(), **values})
        assert scene["classification"].full_name == name
        assert all(abs(controls[one]) <= COEFFICIENT_RANGE for one in ("a", "b", "d", "f1", "f2") if one in controls)


def test_the_present_portrait_is_told_and_followed():
    frames, header = opened("census", census_size=SIZE)
    assert header["census_here"] == "I CM4"
    header = ask(frames, f1=-2.5)
    assert header["census_here"] == frames.scene["classification"].full_name != "I CM4"
    assert not {"census", "census_portraits"} & header.keys()  # they do not depend on it
    assert "census_here" not in ask(frames, f1=-2.51)


def test_another_draw_replaces_the_first_and_a_larger_one_narrows_its_intervals():
    frames, first = opened("census", census_size=SIZE)
    ask(frames, census_size=SIZE + 1)
    more = settled(frames, rest=True)["census"]["rows"]
    width = lambda row: row[4] - row[3]
    assert width(more[0]) == pytest.approx(width(first["census"]["rows"][0]) / 10**0.5, rel=0.05)
    ask(frames, census="quadratic", census_size=SIZE)
    header = settled(frames, rest=True)
    assert header["census"]["draw"] == "quadratic"
    assert set(header["census_portraits"]) == {row[0] for row in header["census"]["rows"]}


def test_the_largest_is_bounded():
    assert {draw: base * 10**MOST_CENSUS for draw, (_, base) in CENSUSES.items()} == {
        "normal": 1_000_000,
        "quadratic": 5_000,
    }


@given(st.tuples(*[st.floats(-9, 9).map(lambda value: float(f"{value:.3g}"))] * 6))
def test_a_polynomial_is_read_as_it_is_written(weights):
    text = _polynomial(weights)
    system = c2.System(U=(text, "1"))
    for c, s in ((0.3, -0.7), (1.0, 0.0)):
        expected = sum(w * m for w, m in zip(weights, (1, c, s, c * c, c * s, s * s), strict=True))
        assert float(system.at().U((c, s))[0]) == pytest.approx(expected, abs=1e-9)
