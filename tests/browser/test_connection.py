import os
import signal
import socket

import pytest

from tests.app.serving import serving

BANNER = ".codim2 .banner"


@pytest.fixture
def port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return str(probe.getsockname()[1])


def stands_still(page, server):
    """Stop the server for a while: it is waited for, the page tells so within two seconds, and both carry on."""
    busy = page.find(".codim2 .busy")
    frame = page.frame()
    os.kill(server.pid, signal.SIGSTOP)
    try:
        box = page.find("[data-control=a] .number")
        box.fill("-1.5")
        box.press("Enter")
        busy.wait_for(state="visible", timeout=2500)  # within 2 s, told when the page next looks
        assert busy.text_content() == "Waiting for the server …"
    finally:
        os.kill(server.pid, signal.SIGCONT)
    busy.wait_for(state="hidden")
    page.settle()
    assert page.frame() > frame
    assert box.input_value() == "-1.5"


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
