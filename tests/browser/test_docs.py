"""The site as the explorer serves it: allowed by its own policy, searched offline, dark, on a phone, and linked to."""

from urllib.error import HTTPError
from urllib.parse import urlparse
from urllib.request import urlopen

import pytest

from tests.browser.conftest import PATIENCE, Explorer
from tests.browser.test_accessible import COLOURS, SERIOUS, STATES, axe

__all__ = ["axe"]

PAGES = (
    "", "tutorial.html", "lessons.html", "lesson-09-ball.html", "theory-near.html", "paper-figures.html",
    "api-classify.html", "reference-psi.html", "hosting.html",
)  # fmt: skip
FITS = "() => document.documentElement.scrollWidth <= innerWidth + 1"


@pytest.fixture
def address(server):
    return str(server).rstrip("/")


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
    assert site.title().endswith("codim2")
    site.fill("input[type=search]", "basins")
    site.press("input[type=search]", "Enter")
    site.locator(".found li a", has_text="basins").first.wait_for()
    site.goto(f"{address}/docs/lesson-09-ball.html")
    site.locator("a.live").first.click()
    site.wait_for_selector(".codim2[data-settled=true]")
    assert site.locator(".panel-lessons").is_visible()
    assert complaints == []
    context.close()


def test_nothing_else_is_sent(address):
    for path in ("../pyproject.toml", "%2e%2e/%2e%2e/etc/passwd", "nothing.html"):
        with pytest.raises(HTTPError, match="404"):
            urlopen(f"{address}/docs/{path}")
    with urlopen(f"{address}/docs") as answer:  # the address without its last slash is sent on
        assert answer.url == f"{address}/docs/"
