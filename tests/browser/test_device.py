"""A page of a server that its visitor's device goes on with: nothing is seen of it, and the server draws no more."""

import re
from urllib.request import urlopen

import pytest

from tests.app.serving import serving

from .conftest import PATIENCE, VISITED, Explorer
from .test_static import portraits_of_a_drag, release, worker_count

WIDE = {"width": 1440, "height": 900}
LINE = "root.explorer.line"
#: No test is about time: the worker may be as slow as a busy machine makes it.
PATIENT = f"(root) => Object.assign({LINE}.limits, {{quick: 1e9, patience: 1e9}})"


@pytest.fixture(scope="module")
def offering():
    """A server that offers pages a worker."""
    options = release()
    with serving(*options) as address:
        yield address


def frames(address):
    with urlopen(f"{address}/metrics") as answer:
        return int(float(re.search(r"^codim2_frames_total.* (\S+)$", answer.read().decode(), re.MULTILINE)[1]))


@pytest.fixture
def explorer(chromium, offering):
    context = chromium.new_context(viewport=WIDE)
    context.add_init_script(VISITED)
    context.set_default_timeout(PATIENCE)
    page = Explorer(context.new_page(), offering)
    yield page
    assert page.complaints == []
    context.close()


def test_a_page_is_handed_over_to_its_device_and_asks_the_server_for_what_remains(explorer, offering):
    explorer.open("?panel=numbers&solid=filippov")
    explorer.find(".codim2").evaluate(PATIENT)
    explorer.type("b", "0.1").kept()
    explorer.until(f"{LINE}.worker")
    assert worker_count(explorer.page) == 2  # one answers, one computes what takes long
    before, sent = frames(offering), len(explorer.received)
    assert portraits_of_a_drag(explorer, (0.42, 0.3, 0.1)) == ["CM2", "NCM2"]
    assert explorer.find(".codim2").evaluate(f"(root) => {LINE}.end === {LINE}.worker")
    explorer.press("body", "Control+z").kept()
    assert explorer.name() == "CM4"
    explorer.press("body", "Control+z").kept()  # what was done while the server answered
    assert explorer.find("[data-control=b] .number").input_value() == "0"
    assert (frames(offering), len(explorer.received)) == (before, sent)
    explorer.click("[role=tab][data-panel=solid]")  # whose polygon of Filippov SciPy computes
    assert "SciPy" not in explorer.find(".panel-solid").inner_text()
    assert frames(offering) > before


def test_a_second_portrait_has_the_same_worker_and_a_switch_ends_it(explorer, offering):
    explorer.open("?panel=numbers")
    explorer.find(".codim2").evaluate(PATIENT)
    explorer.until(f"{LINE}.worker")
    explorer.press(".two", "Enter").kept()
    inner = explorer.page.wait_for_selector(".second-place iframe").content_frame()
    inner.wait_for_function("() => document.querySelector('.codim2')?.explorer?.line.worker")
    assert worker_count(explorer.page) == 2  # the same two
    inner.evaluate(f"() => {{ const root = document.querySelector('.codim2'); ({PATIENT})(root) }}")
    before = frames(offering)
    explorer.type("f1", "2.5")
    inner.wait_for_function("() => document.querySelector('.portrait-name').textContent === 'NCM2'")
    assert (explorer.name(), frames(offering)) == ("NCM2", before)
    explorer.find(".on-device input").uncheck()
    explorer.type("f1", "1.2")
    assert explorer.name() == "CM2"
    assert frames(offering) > before
    explorer.page.reload()
    explorer.until("root.dataset.ready")
    assert not explorer.find(".on-device input").is_checked()
