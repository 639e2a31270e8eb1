"""The site as the explorer serves it: allowed by its own policy, searched offline, dark, on a phone, and linked to."""

from urllib.error import HTTPError
from urllib.parse import urlparse
from urllib.request import urlopen

import pytest

from tests.app.docs.whole import whole_site
from tests.app.serving import serving
from tests.browser.conftest import PATIENCE, Explorer
from tests.browser.test_accessible import COLOURS, SERIOUS, STATES, axe

__all__ = ["axe"]

PAGES = (
    "", "tutorial.html", "lessons.html", "lesson-09-ball.html", "theory-near.html", "paper-figures.html",
    "api-classify.html", "reference-psi.html", "hosting.html",
)  # fmt: skip
FITS = "() => document.documentElement.scrollWidth <= innerWidth + 1"


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    folder, _ = whole_site(tmp_path_factory)
    with serving("--docs", str(folder)) as address:
        yield address


@pytest.mark.slow
@pytest.mark.parametrize("state", STATES)
def test_pages_break_no_rule_and_ask_nobody_else(address, chromium, axe, state):
    context = chromium.new_context(**STATES[state])
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    heard = Explorer(page, address)
    for name in PAGES:
        page.goto(f"{address}/docs/{name}")
        assert page.evaluate(FITS), name
        assert page.evaluate("document.body.dataset.theme")  # its one inline script has run
        page.evaluate(axe)
        assert page.locator("html").evaluate(SERIOUS, COLOURS if state == "dark" else None) == [], name
    assert {urlparse(url).netloc for url in heard.requests if url.startswith("http")} == {urlparse(address).netloc}
    assert heard.complaints == []
    context.close()


def test_it_is_searched_and_found_from_the_explorer(address, chromium):
    context = chromium.new_context()
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    heard = Explorer(page, address).open()
    heard.find(".about summary").click()
    with page.expect_popup() as opened:
        heard.find(".about a.docs").click()
    site = opened.value
    complaints = Explorer(site, address).complaints
    assert site.title().startswith("codim2")
    site.goto(f"{address}/docs/search.html?q=basins")
    site.locator("#search-results li a", has_text="basins").first.wait_for()
    site.goto(f"{address}/docs/lesson-09-ball.html")
    site.locator("a.live").first.click()
    site.wait_for_selector(".codim2[data-settled=true]")
    assert site.locator(".panel-lessons").is_visible()
    assert complaints == []
    context.close()


def test_nothing_beside_the_site_is_sent_and_no_site_is_said(address, server):
    for path in ("../pyproject.toml", "%2e%2e/%2e%2e/etc/passwd", "nothing.html"):
        with pytest.raises(HTTPError, match="404"):
            urlopen(f"{address}/docs/{path}")
    with urlopen(f"{address}/docs") as answer:  # the address without its last slash is sent on
        assert answer.url == f"{address}/docs/"
    with pytest.raises(HTTPError, match="404") as unbuilt:
        urlopen(f"{server}/docs/")
    assert b"codim2 docs" in unbuilt.value.read()
    with urlopen(f"{server}/") as answer:
        assert b'class="docs"' not in answer.read()
