import json
import time
from importlib.util import find_spec
from urllib.parse import urlparse

import pytest

from tests.browser.conftest import EMPTIED, PATIENCE, Explorer
from tests.browser.jupyterlab import jupyterlab, write_notebook

pytestmark = pytest.mark.skipif(
    find_spec("jupyterlab") is None or find_spec("jupyter_bokeh") is None,
    reason='no JupyterLab: pip install jupyterlab, and this package with its extra "notebook"',
)

START = "import panel, codim2_app\npanel.config.comms = '{}'\nview = codim2_app.explorer()\nview"
SECOND = "second = codim2_app.explorer(a=-1, b=1, d=-1, f1=0)\nsecond"
TELL = "print(view.state.a, view.frames.scene.system.a, view.state.d, second.state.a)"
SET = "view.state.param.update(a=-1.25, f1=0.5)"
KERNEL = "window.jupyterapp?.shell.currentWidget?.sessionContext?.session?.kernel?.status === 'idle'"
RUN = """cell => {
    window.jupyterapp.shell.currentWidget.content.activeCellIndex = cell
    window.jupyterapp.commands.execute('notebook:run-cell')
}"""


class Notebook(Explorer):
    """A notebook in JupyterLab; `Explorer` finds the first explorer that is shown in it."""

    def __init__(self, page, address, file):
        super().__init__(page, address)
        self.file = file

    def outputs(self, cell):
        """Return the outputs of a cell as the saved file has them."""
        self.page.evaluate("window.jupyterapp.commands.execute('docmanager:save')")
        return json.loads(self.file.read_text())["cells"][cell]["outputs"]

    def restart(self):
        self.page.evaluate("window.jupyterapp.shell.currentWidget.sessionContext.restartKernel()")
        self.page.wait_for_function(KERNEL)

    def wait(self, holds):
        """Wait until something holds; what follows says what did not."""
        end = time.monotonic() + PATIENCE / 1000
        while not holds() and time.monotonic() < end:
            self.page.wait_for_timeout(50)

    def open(self, name):
        self.page.goto(f"{self.address}/lab/tree/{name}?reset")
        self.page.wait_for_function(KERNEL)
        self.page.evaluate("window.jupyterapp.shell.currentWidget.sessionContext.ready")
        return self

    def run(self, cell):
        self.page.evaluate(RUN, cell)

    def show(self, cell, which):
        self.run(cell)
        self.page.wait_for_function(
            """which => {
                const settled = ".codim2[data-settled=true]"
                const count = (root) => root.querySelectorAll(settled).length
                    + [...root.querySelectorAll("*")].reduce((n, e) => n + (e.shadowRoot ? count(e.shadowRoot) : 0), 0)
                return count(document) > which }""",
            arg=which,
        )

    def find(self, selector):
        return self.page.locator(selector).first

    def cells(self):
        return self.page.evaluate("window.jupyterapp.shell.currentWidget.content.widgets.length")

    def drag(self, slider, way):
        slider.scroll_into_view_if_needed()
        box = slider.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + way, y, steps=5)
        self.page.mouse.up()


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lab")
    with jupyterlab(folder) as address:
        yield address, folder / "notebooks"


@pytest.fixture(scope="module")
def tab(chromium):
    """One tab for all notebooks: it reads JupyterLab's scripts once."""
    context = chromium.new_context(viewport={"width": 1280, "height": 1000})
    context.set_default_timeout(PATIENCE)
    yield context.new_page()
    context.close()


@pytest.fixture
def show_notebook(lab, tab):
    """Write a notebook, and open it in JupyterLab."""
    address, folder = lab
    shown = []

    def show(name, cells):
        write_notebook(folder / name, cells)
        shown.append(Notebook(tab, address, folder / name))
        return shown[-1].open(name)

    yield show
    for notebook in shown:
        notebook.leave()
    tab.unroute_all()
    tab.evaluate(EMPTIED)


@pytest.fixture
def notebook(show_notebook, request):
    return show_notebook(f"{request.param}.ipynb", [START.format(request.param), SECOND, TELL, SET])


@pytest.mark.parametrize("notebook", ["default", "ipywidgets"], indirect=True)
def test_sliders_draw_in_jupyterlab_and_python_follows(notebook):
    notebook.show(0, 0)
    slider = notebook.find("#c2-a")
    frame, picture, words = notebook.frame(), notebook.picture(), notebook.find(".inspector").inner_text()
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    slider.press("x")  # in JupyterLab's command mode this cuts the cell
    notebook.settle()
    assert (slider.input_value(), notebook.cells()) == ("-1.995", 4)
    assert notebook.frame() > frame
    assert notebook.find(".inspector").inner_text() != words
    notebook.drag(notebook.find("#c2-d"), 30)
    notebook.settle()
    assert notebook.picture() != picture

    notebook.show(1, 1)
    other = notebook.page.locator("#c2-a").nth(1)
    other.focus()
    other.press("ArrowRight")
    second = notebook.page.locator(".codim2").nth(1)
    notebook.wait(lambda: second.get_attribute("data-settled") == "true")
    d = float(notebook.find("#c2-d").input_value())
    notebook.run(2)
    said = notebook.find(".jp-OutputArea-output[data-mime-type='application/vnd.jupyter.stdout'] pre").inner_text()
    assert [float(word) for word in said.split()] == [-1.995, -1.995, d, -0.999]
    assert d > -1

    picture, words = notebook.picture(), notebook.find(".inspector").inner_text()
    notebook.run(3)
    notebook.wait(lambda: slider.input_value() == "-1.25")  # the kernel draws in its own time
    notebook.settle()
    assert (slider.input_value(), notebook.find("#c2-f1").input_value()) == ("-1.25", "0.5")
    assert notebook.find("[data-control=a] .number").input_value() == "-1.25"
    assert notebook.find(".inspector").inner_text() != words
    assert notebook.picture() != picture
    assert other.input_value() == "-0.999"  # another view is left alone

    hosts = {urlparse(url).netloc for url in notebook.requests if not url.startswith(("data:", "blob:"))}
    assert hosts == {urlparse(notebook.address).netloc}
    assert notebook.complaints == []


@pytest.mark.parametrize("notebook", ["default"], indirect=True)
def test_widget_takes_the_theme_and_leaves_the_notebook_alone(notebook):
    notebook.show(0, 0)
    notebook.show(1, 1)
    assert notebook.find(".codim2.dark").count() == 0
    notebook.page.evaluate("window.jupyterapp.commands.execute('apputils:change-theme', {theme: 'JupyterLab Dark'})")
    notebook.page.locator(".codim2.dark").nth(1).wait_for()
    sheets = notebook.page.evaluate("[...document.querySelectorAll('style')].map(s => s.textContent).join('')")
    assert ".codim2" not in sheets
    before, name = notebook.find(".codim2").bounding_box(), notebook.name()
    notebook.type("b", "3")
    after = notebook.find(".codim2").bounding_box()
    assert notebook.name() != name
    assert (after["width"], after["height"]) == (before["width"], before["height"])  # cells below stay where they are
    assert after["height"] < 1300


STILL = "[class^=explorer-still]"


@pytest.mark.slow
@pytest.mark.parametrize("notebook", ["default"], indirect=True)
def test_a_page_that_is_loaded_again_is_live_without_running_a_cell(notebook):
    notebook.show(0, 0)
    notebook.type("d", "-0.5")
    notebook.wait(lambda: len(notebook.outputs(0)) == 2)
    notebook.page.reload()
    notebook.page.wait_for_function(KERNEL)
    notebook.page.wait_for_selector(".codim2[data-settled=true]")
    assert notebook.find("#c2-d").input_value() == "-0.5"
    assert not notebook.find(STILL).is_visible()
    slider, frame = notebook.find("#c2-a"), notebook.frame()
    slider.focus()
    slider.press("ArrowRight")
    notebook.settle()
    assert notebook.frame() > frame
    notebook.run(0)  # and the cell can be run in the new page
    notebook.wait(lambda: notebook.find("#c2-d").count() and notebook.find("#c2-d").input_value() == "-1")
    assert notebook.find("#c2-d").input_value() == "-1"
    assert notebook.complaints == []


@pytest.mark.slow
@pytest.mark.parametrize("notebook", ["default"], indirect=True)
def test_the_file_keeps_one_picture_and_it_follows(notebook):
    notebook.show(0, 0)
    first = notebook.outputs(0)[0]["data"]["image/svg+xml"]
    notebook.type("b", "3")
    notebook.wait(lambda: notebook.outputs(0)[0]["data"]["image/svg+xml"] != first)
    still, live = notebook.outputs(0)
    assert len(json.dumps([still, live])) < 300_000
    assert f"{notebook.name()}." in "".join(still["data"]["text/plain"])
    assert "<svg" not in live["data"]["text/html"]


@pytest.mark.slow
@pytest.mark.parametrize("notebook", ["default"], indirect=True)
def test_when_the_kernel_has_ended_the_picture_is_seen_until_the_cell_is_run(notebook):
    notebook.show(0, 0)
    assert not notebook.find(STILL).is_visible()
    notebook.restart()
    notebook.page.wait_for_selector(STILL)
    assert notebook.find(".codim2").count() == 0
    assert len(notebook.outputs(0)) == 2
    notebook.page.reload()
    notebook.page.wait_for_selector(STILL)
    notebook.page.wait_for_function(KERNEL)
    notebook.show(0, 0)
    assert not notebook.find(STILL).is_visible()


OWN = """import codim2_core as c2, codim2_app
own = c2.System(U=("-mu*c + pull", "-s + z/4"), W=("c - 1/4",), parameters={"mu": 0.5, "pull": 0.3})
view = codim2_app.explorer(own, c2.psi.tanh(), z=0)
view"""
ASK = """pull = dict(view.scene.system.parameters)["pull"]
print(pull, len(view.scene["critical"]), len(view.orbits), view.scene.system == own, view.scene.psi == c2.psi.tanh())"""
GIVE = "view.state.parameters = {'mu': 0.5, 'pull': 0.7}\nview.state.orbits = '1.4,0.5;-0.3,0.4'"


@pytest.mark.slow
def test_a_system_of_ones_own_goes_both_ways_and_is_live_after_reopening(show_notebook):
    notebook = show_notebook("own.ipynb", [OWN, GIVE, ASK])
    pull = "[data-control='parameter-pull'] input[type=range]"

    def heard():
        """Return what the third cell prints, once it has run again."""
        cell = "window.jupyterapp.shell.currentWidget.content.widgets[2]"
        before = notebook.page.evaluate(f"{cell}.model.executionCount")
        notebook.run(2)
        told = f"{cell}.model.executionCount > (before ?? 0) && {cell}.outputArea.node.textContent.trim()"
        notebook.page.wait_for_function(f"(before) => {told} && {KERNEL}", arg=before)
        return notebook.page.evaluate(f"{cell}.outputArea.node.textContent").split()

    notebook.show(0, 0)
    assert heard() == ["0.3", "1", "0", "True", "True"]
    notebook.run(1)
    notebook.wait(lambda: notebook.find(pull).input_value() == "0.7")
    assert notebook.find(pull).input_value() == "0.7"
    notebook.wait(lambda: heard()[0] == "0.7")
    assert heard() == ["0.7", "0", "2", "False", "True"]

    notebook.page.evaluate("window.jupyterapp.commands.execute('docmanager:save')")
    notebook.open("own.ipynb")
    notebook.page.wait_for_selector(".codim2[data-settled=true]")
    assert notebook.find(pull).input_value() == "0.7"
    slider, frame = notebook.find(pull), notebook.frame()
    slider.focus()
    slider.press("ArrowLeft")
    notebook.settle()
    assert notebook.frame() > frame
    notebook.wait(lambda: heard()[0] == slider.input_value())
    assert heard()[0] == slider.input_value()
    notebook.run(1)
    notebook.wait(lambda: notebook.find(pull).input_value() == "0.7")
    assert notebook.complaints == []
