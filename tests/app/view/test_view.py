import asyncio
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from html import unescape

import pytest
from codim2_app.draw.layers import LAYERS
from codim2_app.draw.packing import unpack
from codim2_app.server.cli import main, parser
from codim2_app.state.controls import ExplorerState
from codim2_app.view.markup import explorer_html

import codim2_core as c2
from tests.benchmarks.wire import Wire


@pytest.fixture
def port(server):
    return server.port


def test_one_message_for_each_request(port):
    async def talk():
        wire = await Wire.connect(port)
        await wire.frame(1, a=-1.9)
        before = wire.frames
        sizes = [len(await wire.frame(i, a=-1.9 + 0.01 * i)) for i in range(2, 12)]
        await wire.close()
        return wire.frames - before, sizes

    frames, sizes = alone(talk())
    assert frames == 10
    assert max(sizes) <= 60_000


def alone(talk):
    """Run a coroutine in a thread of its own: Playwright's loop may be running in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, talk).result()


def test_address_is_the_state(port):
    async def talk():
        wire = await Wire.connect(port, "?a=-1&b=1&d=-1&f1=0&psi=rational")
        header, _ = unpack(await wire.frame(1))
        await wire.close()
        return header

    assert alone(talk())["slow_flow"] == [0.0]


def test_page_asks_nobody_else(port):
    from urllib.request import urlopen

    page = urlopen(f"http://localhost:{port}/").read().decode()
    page, links = re.subn(r'<a href="https://[^"]+" target="_blank" rel="noopener noreferrer">', "", page)
    assert links == 1  # to the paper: a reader follows it, the page does not
    for part in page.split("http")[1:]:
        assert part.startswith((f"://localhost:{port}", "://www.w3.org")), part[:80]


def test_health(port):
    from urllib.request import urlopen

    with urlopen(f"http://localhost:{port}/health") as answer:
        assert answer.status == 200


def test_port_in_use_is_said_plainly(port, capsys):
    assert main(["serve", "--port", str(port)]) == 1
    assert "Give another --port" in capsys.readouterr().out


def test_options_have_local_defaults():
    chosen = parser().parse_args(["serve"])
    assert (chosen.address, chosen.show, chosen.processes) == ("localhost", False, 1)


def test_importing_the_package_is_cheap():
    code = "import sys, codim2_app; assert not {'panel', 'bokeh', 'holoviews', 'numba'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_notebook_widget_is_the_same_view_and_answers():
    import codim2_app
    from codim2_app.view.explorer import ExplorerView

    view = codim2_app.explorer(a=-1, b=1, d=-1, f1=0)
    assert isinstance(view, ExplorerView)
    assert "portrait-name" in view.markup
    header, _ = unpack(view.frames.answer({"id": 1, "set": {"b": 0.0}, "all": True}))
    assert header["portrait"]["name"] == "CM∞"
    view.frames.publish()
    assert view.state.b == 0.0


def test_notebook_takes_a_system():
    import codim2_app

    view = codim2_app.explorer(c2.ELinear(-3, 0, -1, (0.25, "0.1*z1")), z=2.0)
    assert (view.state.a, view.state.f1, view.state.f2) == (-3.0, 0.25, 0.2)
    assert "f2" in view.frames.locked
    with pytest.raises(ValueError, match="no control"):
        codim2_app.explorer(alpha=1)
    with pytest.raises(ValueError, match="finite"):
        codim2_app.explorer(a=float("nan"))


def test_state_of_a_view_is_its_own():
    assert ExplorerState().layers is not ExplorerState().layers


def test_holoviews_overlay_can_be_added_to():
    import codim2_app
    import holoviews as hv

    scene = c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)), count=12)
    overlay = codim2_app.holoviews(scene)
    assert len(overlay.Points.values()) == 2
    assert len(overlay) == 11
    assert isinstance(overlay * hv.Curve([(0, 0), (1, 1)]), hv.Overlay)


def test_the_page_says_which_paper_it_shows_and_what_its_words_mean():
    from codim2_app.view.glossary import GLOSSARY, PAPER
    from codim2_app.view.markup import explorer_html, page_config

    page = explorer_html(ExplorerState())
    assert PAPER[1] in page
    for term, meaning in GLOSSARY:
        shown = re.sub("_([ρθ])", r"<sub>\1</sub>", term)  # as in the table of numbers
        assert f"<dt>{shown}</dt>" in page
        assert len(meaning) < 140
    found = page_config(ExplorerState())
    scene = c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)))  # what the opening sentence says, of what is drawn
    assert "four limit directions, all radially attracting" in found["opening"]
    assert (len(scene["equator"]), bool((scene["equator"].lambda_rho < 0).all())) == (4, True)
    assert scene["critical"][0].kind.startswith("stable")


# HoloViews leaves it out by `catch_warnings`, which a thread of a test before undoes when it leaves its own
@pytest.mark.filterwarnings("ignore:No data for colormapping")
def test_both_backends_of_holoviews_draw_equal_axes_with_the_papers_names():
    import codim2_app
    import holoviews as hv
    import holoviews.plotting.bokeh
    import holoviews.plotting.mpl

    overlay = codim2_app.holoviews(c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)), count=12))
    (axes,) = hv.render(overlay, backend="matplotlib").axes
    assert axes.get_aspect() == 1.0
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x\u0304", "\u0233")
    figure = hv.render(overlay, backend="bokeh")
    assert figure.match_aspect
    assert figure.xaxis[0].axis_label == axes.get_xlabel()


def test_marks_and_layers_are_explained_beside_the_picture():
    markup = explorer_html(ExplorerState())
    hero = unescape(markup[markup.index('<main class="hero">') : markup.index("</main>")])
    for words in ("layer problem", "1 + ρ", "time", "filled", "hollow", "repels", "node", "saddle", "out of the page",
                  "into it", "dashed", "U₁ = 0, U₂ = 0 inside", "outside"):  # fmt: skip
        assert words in hero, words
    for layer in LAYERS.values():
        assert layer.tip.endswith(".")
        assert f'title="{layer.tip}"' in hero
