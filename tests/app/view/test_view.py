import re
import subprocess
import sys
from urllib.request import urlopen

import codim2_app
import holoviews as hv
import holoviews.plotting.bokeh
import holoviews.plotting.mpl
import pytest
from codim2_app.picture.draw.glyphs import critical_columns, equator_columns
from codim2_app.picture.draw.layers import LAYERS
from codim2_app.picture.draw.theme import themes
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.glossary import GLOSSARY, PAPER
from codim2_app.view.markup import explorer_html, page_config
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_hex
from matplotlib.markers import MarkerStyle

import codim2_core as c2
from tests.benchmarks.wire import Wire
from tests.work import talk


def test_one_message_for_each_request(server):
    async def drag():
        wire = await Wire.connect(server.port)
        await wire.frame(1, a=-1.9)
        before = wire.frames
        sizes = [len(await wire.frame(i, a=-1.9 + 0.01 * i)) for i in range(2, 12)]
        await wire.close()
        return wire.frames - before, sizes

    frames, sizes = talk(drag())
    assert frames == 10
    assert max(sizes) <= 60_000


def test_page_asks_nobody_else(server):
    page = urlopen(f"{server}/").read().decode()
    page, links = re.subn(r'<a href="https://[^"]+" target="_blank" rel="noopener noreferrer">', "", page)
    assert links == 1  # to the paper: a reader follows it, the page does not
    for part in page.split("http")[1:]:
        assert part.startswith((server.removeprefix("http"), "://www.w3.org")), part[:80]


def test_importing_the_package_is_cheap():
    code = "import sys, codim2_app; assert not {'panel', 'bokeh', 'holoviews', 'numba'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_page_says_which_paper_it_shows_and_what_its_words_mean():
    page = explorer_html(ExplorerState())
    assert PAPER[1] in page
    for term, meaning in GLOSSARY:
        shown = re.sub("_([ρθ])", r"<sub>\1</sub>", term)  # as in the table of numbers
        assert f"<dt>{shown}</dt>" in page
        assert len(meaning) < 140
    found = page_config(ExplorerState())
    scene = c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)))  # what the opening sentence says, of what is drawn
    assert "pick an example" in found["opening"]
    assert (len(scene["equator"]), bool((scene["equator"].lambda_rho < 0).all())) == (4, True)
    assert scene["critical"][0].kind.startswith("stable")


@pytest.mark.filterwarnings("ignore:No data for colormapping")
def test_matplotlib_draws_each_mark_and_curve_as_the_page_does():
    scene = c2.Scene(c2.ELinear(1, 0.3, -1, (0.2, 0.1)), count=12)  # a saddle, whose marks have three shapes
    (axes,) = hv.render(codim2_app.holoviews(scene), backend="matplotlib").axes
    equator, critical = (c for c in axes.collections if isinstance(c, PathCollection))
    columns = equator_columns(scene["equator"]), critical_columns(scene["critical"])
    for drawn, told in zip((equator, critical), columns, strict=True):
        corners = [len(path.vertices) for path in drawn.get_paths()]
        expected = {"circle": "o", "diamond": "D", "triangle": "^", "x": "x"}
        assert corners == [len(MarkerStyle(expected[name]).get_path().vertices) for name in told["shape"]]
        filled = [bool((face != 1.0).any()) for face in drawn.get_facecolors()]
        assert filled == [bool(one) for one in told["filled"]]
    assert len(set(columns[0]["shape"])) > 1
    lines = {to_hex(c.get_color()[0]): c.get_linewidth()[0] for c in axes.collections if isinstance(c, LineCollection)}
    parts = [part for layer in LAYERS.values() if not layer.hidden for part in layer.parts]
    widths = {themes()["light"][part.colour]: 0.75 * part.width for part in parts}  # px as points of print
    widths[themes()["light"]["ink"]] = 1.5  # the circle
    assert len(lines) > 4
    assert lines == {colour: pytest.approx(widths[colour]) for colour in lines}
