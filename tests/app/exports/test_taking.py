"""A file that is taken away has a name that every system takes."""

import re

import pytest
import segno
from codim2_app.exports.export_request import ExportRequest, file_name, make_file
from codim2_app.exports.view import view_of


@pytest.mark.parametrize(
    ("query", "name"),
    [("?preset=case3-n2", "codim2-case3-n2"), ("?system=own", "codim2-cm2"),
     ("?a=1&d=1", "codim2-cm2")],
)  # fmt: skip
def test_it_is_the_portrait_in_letters_figures_and_dashes(query, name):
    found = [file_name(view_of(query), ExportRequest("gif", sliders=each)) for each in ((), ("n=1,3;2",), ("own:mu",))]
    assert found == [f"{name}{moves}.gif" for moves in ("", "-n", "-own-mu")]


@pytest.mark.parametrize(
    ("query", "title"),
    [
        ("v=1", "When friction stops pointing anywhere: CM4"), ("case1-cm4", "CM4: four limit directions"),
        ("system=spinning_annulus", "Sliding, spinning annulus: "),
    ],
)  # fmt: skip
def test_a_poster_of_whatever_is_shown_has_a_title_that_says_what_it_is(query, title):
    poster = make_file(view_of(query), ExportRequest.read({"kind": "svg", "link": "https://h/"}))[1].decode()
    assert f">{title}" in poster


def test_a_poster_has_a_title_a_caption_and_the_code_of_its_address():
    link = "https://h/?v=1&preset=case3-n2"
    view = view_of("case3-n2")
    name, poster = make_file(view, ExportRequest.read({"kind": "svg", "link": link}))
    text = poster.decode()
    assert name == "codim2-case3-n2.svg"
    assert "n = 2: stable focus" in text
    assert "f = (−86 + 0.5 z, −93)" in re.sub(r"<[^>]+>", "", text).replace("\n", " ")
    (code,) = re.findall(r'<path d="((?:M\d+ \d+h1v1h-1z)+)" fill="#000"', text)
    squares = {(int(y) - 2, int(x) - 2) for x, y in re.findall(r"M(\d+) (\d+)", code)}
    matrix = segno.make_qr(link, error="l", boost_error=False).matrix
    assert squares == {(i, j) for i, row in enumerate(matrix) for j, dark in enumerate(row) if dark}
    assert make_file(view, ExportRequest.read({"kind": "pdf", "link": link}))[1].startswith(b"%PDF")
    with pytest.raises(ValueError, match="2000 bytes"):
        ExportRequest.read({"kind": "svg", "link": "h" * 2001})
