"""Two versions behind one proxy, as in an upgrade: a page of the old one says so, and is not driven by the new."""

from urllib.request import urlopen

import pytest

from tests.app.serving import serving
from tests.benchmarks.app_load import free_port
from tests.browser.conftest import Tabs, chromium  # noqa: F401 (a fixture)
from tests.browser.test_connection import ANSWERED, BANNER, RENEWED
from tests.faults.test_hosting import answers, needs_nginx, proxy

LATER = (
    "import importlib.metadata as packages, sys\n"
    "of = packages.version\n"
    "packages.version = lambda name: '99' if name == 'codim2' else of(name)\n"
    "from codim2_app.server.cli import main; sys.exit(main(sys.argv[1:]))"
)
SET = "?psi=rational&a=-1.5"


@pytest.fixture
def page(chromium):  # noqa: F811
    with Tabs(chromium, "").page(**ANSWERED) as found:
        yield found


def loaded_again(page):
    """Press the button; the page is of the later version then, with what was set."""
    page.find(f"{BANNER} button").click()
    page.until("root.dataset.ready === 'true'").settle()
    assert not page.find(BANNER).is_visible()
    assert page.find("select.psi").input_value() == "rational"
    assert page.find("[data-control=a] .number").input_value() == "-1.5"
    return page.find(".codim2").get_attribute("data-edition")


@needs_nginx
def test_a_page_of_the_old_version_is_loaded_again_when_its_visitor_says_so(tmp_path, page):
    port, old, new = free_port(), str(free_port()), str(free_port())
    page.address = f"http://localhost:{port}"
    named = ("--allow-origin", f"localhost:{port}")
    with proxy(tmp_path, port, (old, new)):
        with serving("--port", old, *named):
            assert answers(port)
            text = urlopen(f"{page.address}/{SET}").read().decode()
            before = page.open(SET).find(".codim2").get_attribute("data-edition")
            later = serving("--port", new, *named, command=("-c", LATER))
            later.__enter__()
        try:
            page.find(f"{BANNER} button").wait_for(state="visible")  # its server has ended
            assert page.find(BANNER).text_content() == RENEWED
            after = loaded_again(page)
            assert after != before

            page.complaints.clear()
            whole = f"{page.address}/{SET}"
            page.page.route(whole, lambda route: route.fulfill(body=text, content_type="text/html"))
            page.page.goto(whole)  # the page is of the old version, its websocket of the new one
            page.find(f"{BANNER} button").wait_for(state="visible")
            assert page.find(".codim2").get_attribute("data-edition") == before
            assert page.find(BANNER).text_content() == RENEWED
            assert page.complaints == []
            page.page.unroute_all()
            assert loaded_again(page) == after
        finally:
            later.__exit__(None, None, None)
