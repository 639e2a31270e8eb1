"""A page of one figure: its picture, and the link that an explorer next to it opens in its place."""

import re
from html import unescape

import pytest
from codim2_app.exports.figure_page import figure_page
from codim2_app.exports.view import View, view_of
from codim2_app.picture.state.links import read_link
from codim2_app.server.cli import main

import codim2_core as c2

OWN = "v=1&system=own&texts=%7B%22U1%22%3A%22mu+-+2*c%22%7D&parameters=%7B%22mu%22%3A0.25%7D"


@pytest.mark.parametrize(
    ("view", "sliders", "controls", "ranges"),
    [
        ("case1-cm4", ["f1", "n=1,3"], ("f1", "n"), {"n": [1.0, 3.0]}),
        (OWN, ["mu=-1,2"], ("mu",), {"own:mu": [-1.0, 2.0]}),
    ],
)
def test_the_figure_is_the_view_with_these_sliders(tmp_path, view, sliders, controls, ranges):
    file = tmp_path / "page.html"
    flags = [part for slider in sliders for part in ("--slider", slider)]
    assert main(["live", view, *flags, "--explorer", "../files", "-o", str(file)]) == 0
    text = file.read_text(encoding="utf-8")
    link = read_link(unescape(re.search(r'data-codim2="([^"]*)"', text)[1]))
    assert (link.errors, link.look.controls) == ((), controls)
    assert link.state.values() == {**read_link(view_of(view).query).state.values(), "ranges": ranges}
    assert text.count("<svg") == 1
    assert "<?xml" not in text
    assert '<script type="module" src="../files/figures.js"></script>' in text


def test_what_cannot_be_in_a_page_is_told():
    with pytest.raises(ValueError, match="is no slider of this system"):
        figure_page(view_of("case1-cm4"), ["q"], "files")
    with pytest.raises(ValueError, match="has no link"):
        figure_page(View(view_of("case1-cm4").values, system=c2.ELinear(-1, 0, -2)), ["f1"], "files")
