"""The picture as a file of its own."""

import re
from xml.etree import ElementTree

import pytest
from codim2_app import explorer
from codim2_app.picture.draw.theme import themes
from codim2_app.picture.state.portraits import portrait_keys


@pytest.mark.parametrize("key", ["case1-cm0", "case3-n3", "ball-dynamic"])
def test_it_needs_nothing_else(key):
    assert key in portrait_keys()
    svg, sentence, finished = explorer(key).still()
    root = ElementTree.fromstring(svg)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert "var(" not in svg
    assert not re.search(r'(href|src)="', svg)
    assert finished
    assert sentence.strip()
    assert len(svg) < 100_000


def test_it_holds_orbits_marks_and_colours():
    view = explorer("case1-cm4")
    svg, sentence, _ = view.still()
    assert view.scene["classification"].name in sentence
    labels = re.findall(r"<text[^>]*>([^<]*)</text>", svg)
    assert {"Q₁", "Q₂", "Q₃", "Q₄"} <= {label.split(" ")[0] for label in labels}
    assert themes()["light"]["page"] in svg
    lines = [len(path) for path in re.findall(r'<path d="(M[^"]*)" stroke=', svg)]
    assert max(lines) > 3000  # its orbits are drawn


def test_an_explorer_is_saved_as_a_finished_picture(tmp_path):
    view = explorer("case1-cm0")
    view.save(tmp_path / "x.html", title="a < b")
    view.save(str(tmp_path / "x.svg"))
    page, svg = ((tmp_path / name).read_text() for name in ("x.html", "x.svg"))
    assert svg in page
    assert "<title>a &lt; b</title>" in page
    assert "<script" not in page
    assert "Compiling" not in page
    assert view.scene["classification"].name in page
    ElementTree.fromstring(svg)


def test_panel_saves_it_finished_within_a_layout(tmp_path):
    import panel as pn
    from codim2_app.picture.draw.packing import unpack

    view = explorer("case1-cm0")
    pn.Row(view).save(tmp_path / "row.html", resources="inline")
    assert unpack(view.first)[0]["ready"] is True
    assert "case1-cm0" in (tmp_path / "row.html").read_text()
