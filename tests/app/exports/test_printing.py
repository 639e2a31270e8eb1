"""PNG and PDF of a figure."""

import io
import re
import sys
import zlib

import numpy as np
import pytest
import typst
from codim2_app.exports.figure import Style, figure
from codim2_app.exports.printing import pdf, png
from codim2_app.exports.view import view_of
from codim2_app.picture.draw.theme import themes
from PIL import Image


@pytest.fixture(scope="module")
def svg():
    return figure(view_of("case1-cm4"), Style(size=50.0, legend=False))


def test_a_png_shows_the_figure_at_its_scale(svg):
    small, large = (Image.open(io.BytesIO(png(svg, scale))).convert("RGB") for scale in (1, 3))
    assert small.width == pytest.approx(50 / 25.4 * 96, abs=1)
    assert large.width == pytest.approx(3 * small.width, abs=3)
    pixels = np.asarray(large).astype(int)
    h, w, _ = pixels.shape
    assert np.abs(pixels - (0xC8, 0x10, 0x2E)).sum(axis=2).min() < 12  # the critical set's red
    # C is at p = (-1/4, 0): its mark is there
    at = pixels[h // 2, round((1.75 - 0.25) / 3.5 * w)]
    assert np.abs(at - (0xC8, 0x10, 0x2E)).sum() < 12


def test_the_edge_of_a_dark_png_is_as_dark_as_its_page():
    style = Style(size=120.0, theme="dark", legend=False, title=True)  # no whole number of pixels wide or high
    pixels = np.asarray(Image.open(io.BytesIO(png(figure(view_of("case1-cm4"), style), 1.25))).convert("RGBA"))
    page = np.array([int(themes()["dark"]["page"][i : i + 2], 16) for i in (1, 3, 5)])
    for edge in (pixels[-1], pixels[:, -1]):
        colour, there = edge[:, :3].astype(int), edge[:, 3:] / 255
        shown = there * colour + (1 - there) * page  # where it covers a part of a pixel, what lies behind is seen
        assert np.abs(np.median(shown, axis=0) - page).max() < 3


def _inflated(data):
    try:
        return zlib.decompress(data)
    except zlib.error:
        return data


def test_a_pdf_holds_lines_and_letters(svg):
    made = pdf(svg)
    assert made.startswith(b"%PDF")
    assert b"LibertinusSerif" in made  # text stays text, its font is in the file
    streams = [_inflated(s) for s in re.findall(rb"stream\r?\n(.*?)endstream", made, re.DOTALL)]
    assert max(s.count(b" l") for s in streams) > 1000  # lines are lines
    assert b"/Subtype /Image" not in made
    assert b"/Subtype/Image" not in made


def test_without_typst_one_is_told_what_to_install(svg, monkeypatch):
    assert typst.__name__ in sys.modules
    monkeypatch.setitem(sys.modules, "typst", None)
    with pytest.raises(ValueError, match=r"pip install 'codim2\[figures\]'"):
        png(svg)


@pytest.mark.parametrize("scale", [0.0, -1.0, 100.0, float("nan")])
def test_a_scale_out_of_range(svg, scale):
    with pytest.raises(ValueError, match="at most 12"):
        png(svg, scale)
