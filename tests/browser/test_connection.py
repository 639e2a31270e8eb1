import os
import signal
import socket

import pytest
from codim2_app.picture.phrases import say

from tests.app.serving import serving

BANNER = ".codim2 .banner"
#: A page that a test answers in a server's place is from elsewhere, and would have to ask whether it may open a line.
ANSWERED = {"permissions": ["local-network-access"]}
RENEWED = "A new version of the explorer is available. Reload the page: your settings stay. Reload"


@pytest.fixture
def port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return str(probe.getsockname()[1])


def stands_still(page, server):
    """Stop the server for a while: it is waited for, the page tells so, and both carry on."""
    busy = page.find(".codim2 .busy")
    frame = page.frame()
    os.kill(server.pid, signal.SIGSTOP)
    try:
        box = page.find("[data-control=a] .number")
        box.fill("-1.5")
        box.press("Enter")
        busy.wait_for(state="visible")
        assert busy.text_content() == "Waiting for the server …"
        assert busy.bounding_box()["y"] > page.find(".tools").evaluate("(e) => e.getBoundingClientRect().bottom")
    finally:
        os.kill(server.pid, signal.SIGCONT)
    busy.wait_for(state="hidden")
    page.settle()
    assert page.frame() > frame
    assert box.input_value() == "-1.5"


@pytest.mark.slow
def test_a_server_is_waited_for_and_when_it_was_lost_the_page_returns_as_it_was(open_page, port):
    page = open_page()
    with serving("--port", port) as page.address:
        page.open("?psi=rational")
        stands_still(page, page.address)
        assert not page.find(BANNER).is_visible()
    banner = page.find(BANNER)
    banner.wait_for(state="visible")
    assert banner.text_content() == "Connection lost. Trying again …"
    box = page.find("[data-control=d] .number")  # what is set meanwhile is kept
    box.fill("-1.25")
    box.press("Enter")
    for _ in range(2):  # attempts
        page.page.wait_for_event("requestfailed")
    assert banner.is_visible()
    with serving("--port", port):
        banner.wait_for(state="hidden")
        page.page.wait_for_selector(".codim2[data-ready]")
        page.settle()
        assert page.find("[data-control=a] .number").input_value() == "-1.5"
        assert page.find("[data-control=d] .number").input_value() == "-1.25"
        assert page.find("select.psi").input_value() == "rational"
        frame = page.frame()
        page.type("a", "-1")
        assert page.frame() > frame
        assert page.find("[data-control=a] .number").input_value() == "-1"
        page.type("a", "-0.75").kept()
    is_renewed(page)


def is_renewed(page):
    """A server of another version comes in place of a page's own: nothing is loaded before a person says so."""
    page.page.route("**/health*", lambda route: route.fulfill(json={"status": "ok", "edition": "after"}))
    page.find(f"{BANNER} button").wait_for(state="visible")
    assert page.find(BANNER).text_content() == RENEWED
    page.find("[data-control=d] .number").fill("-0.25")  # what is set meanwhile is in the address that is asked for
    with page.page.expect_event("requestfailed", lambda request: request.is_navigation_request()) as asked:
        page.find(f"{BANNER} button").click()
    assert {"a=-0.75", "d=-0.25"} <= set(asked.value.url.partition("?")[2].split("&"))


@pytest.mark.parametrize(("code", "key"), [(1011, "no connection"), (1013, "places taken")])
def test_a_page_that_gets_no_connection_says_so_and_what_to_do(open_page, code, key):
    explorer = open_page(locale="en-GB" if code == 1011 else "en-IE")  # a tab of its own: it closes all that it opens
    page, refused = explorer.page, [code]
    page.route_web_socket(
        "**/live*", lambda line: line.close(code=refused.pop()) if refused else line.connect_to_server()
    )
    page.goto(f"{explorer.address}/?psi=rational")
    banner = explorer.find(BANNER)
    banner.wait_for(state="visible")
    assert banner.text_content() == f"{say(key)} Reload"
    banner.locator("button").click()
    page.wait_for_selector(".codim2[data-ready]")
    assert explorer.settle().find("select.psi").input_value() == "rational"
    assert not banner.is_visible()


def test_a_site_that_lets_its_own_name_lead_here_gets_no_page_and_no_line(chromium, server):
    page = chromium.new_page()
    port = server.rsplit(":", 1)[1]
    try:
        answer = page.goto(f"http://evil.rebound.test:{port}/")
        assert answer.status == 421
        assert "does not expect to be reached as" in page.locator("p").inner_text()
        tried = """() => new Promise((tell) => {
            const line = new WebSocket(`ws://${location.host}/live`)
            line.onopen = () => tell("open")
            line.onclose = () => tell("closed")
        })"""
        assert page.evaluate(tried) == "closed"
        page.goto(f"{server}/")
        assert page.evaluate(tried) == "open"
    finally:
        page.close()
