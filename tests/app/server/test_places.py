"""Who has a place: a share of each network address, and none for who is not there."""

import asyncio
import os
import re
import socket
from base64 import b64encode
from contextlib import closing, contextmanager, suppress
from urllib.request import urlopen

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.server import live
from codim2_app.server.live import CLOSE_FULL, CLOSE_RESTING, LivePages
from tornado.websocket import websocket_connect

from tests.app.serving import serving
from tests.benchmarks.wire import Wire
from tests.work import PATIENCE, talk, wait_until

from .test_first_page import opened, refused

PATCHED = """import sys
from itertools import count
from types import SimpleNamespace
from codim2_app.server import live, page
{0}
from codim2_app.server.cli import main
sys.exit(main(sys.argv[1:]))
"""


class Line:
    """A line of a visitor at an address of this machine, who reads and answers nothing unless told to."""

    def __init__(self, port, address="127.0.0.1", **headers):
        self.socket = socket.create_connection(("127.0.0.1", port), PATIENCE, source_address=(address, 0))
        key = b64encode(os.urandom(16)).decode()
        given = {"Host": f"127.0.0.1:{port}", "Upgrade": "websocket", "Connection": "Upgrade",
                 "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": key, **headers}  # fmt: skip
        lines = "".join(f"{name}: {value}\r\n" for name, value in given.items())
        self.socket.sendall(f"GET /live HTTP/1.1\r\n{lines}\r\n".encode())
        heard = b""
        while len(heard.partition(b"\r\n\r\n")[2]) < 1:
            heard += self.socket.recv(4096)
        self.begins = heard.partition(b"\r\n\r\n")[2][0] == 0x81  # a text: it is let in; 0x88 closes

    def ends(self):
        """Read until the server has closed it."""
        with suppress(ConnectionResetError):
            while self.socket.recv(65536):
                pass
        return True


@contextmanager
def lines_to(server):
    """Yield what opens lines, one after the other; in the end all are closed, and the server has noticed."""
    lines = []

    def open_line(*given, **headers):
        lines.append(Line(server.port, *given, **headers))
        return lines[-1].begins

    try:
        yield open_line
    finally:
        for line in lines:
            line.socket.close()
        assert wait_until(lambda: pages_of(server) == 0)


def pages_of(server):
    with urlopen(f"http://127.0.0.1:{server.port}/metrics") as answer:
        return int(re.search(rb"^codim2_pages(?:{.*})? (\d+)", answer.read(), re.M)[1])


@pytest.fixture(scope="module")
def shared():
    """A server of which one address has two places of three."""
    with serving("--sessions", "3", "--per-address", "2", "--address", "127.0.0.1", warm=False) as address:
        yield address


def test_one_network_address_has_a_share_of_all_places(shared):
    one, other = "127.0.0.1", "127.0.0.2"
    with lines_to(shared) as let_in:
        assert [let_in(address) for address in (one, one, one, other, other)] == [True, True, False, True, False]
    with lines_to(shared) as let_in:
        assert let_in(other)


def test_a_page_beyond_the_share_is_asked_to_wait(shared):
    with lines_to(shared) as let_in:
        assert [let_in() for _ in range(2)] == [True, True]
        assert refused(lambda: opened(shared)) == 503


def test_a_visitor_names_no_other_address_than_his_own(shared):
    with lines_to(shared) as let_in:
        given = [{"X-Real-IP": f"10.0.0.{i}", "X-Forwarded-For": f"10.0.1.{i}"} for i in range(3)]
        assert [let_in(**headers) for headers in given] == [True, True, False]


def test_behind_a_proxy_addresses_are_the_visitors():
    with (
        serving("--per-address", "1", "--proxied", "--address", "127.0.0.1", warm=False) as there,
        lines_to(there) as let_in,
    ):
        visitors = "10.0.0.1", "10.0.0.2", "10.0.0.1"
        assert [let_in(**{"X-Real-IP": visitor}) for visitor in visitors] == [True, True, False]


def test_a_page_that_answers_no_sign_of_life_has_gone():
    """Who answers outlives who does not."""
    with serving("--address", "127.0.0.1", command=("-c", PATCHED.format("page.BEAT = 1.0")), warm=False) as there:

        async def lives():
            wire = await Wire.connect(there.port)
            silent = await asyncio.to_thread(Line, there.port)
            with closing(silent.socket):
                assert silent.begins
                assert await asyncio.to_thread(silent.ends)  # though it reads, it says nothing
            frame = await wire.frame(1)
            await wire.close()
            return unpack(frame)[0]["id"]

        assert talk(lives()) == 1


def test_a_page_that_has_rested_gives_its_place_to_one_that_comes():
    """Not one that is in a room, nor one that asks; the server's clock counts what it is asked."""
    clock = "live.time, live.RESTING_SECONDS = SimpleNamespace(monotonic=count().__next__), 10"
    with serving("--sessions", "3", command=("-c", PATCHED.format(clock)), warm=False) as there:

        async def come():
            lecturer, resting, busy = [await Wire.connect(there.port) for _ in range(3)]
            await lecturer.ask("room", {"open": ""})
            for i in range(10):
                await busy.frame(i, a=-1.5 - 0.01 * i)
            new = await Wire.connect(there.port)
            with pytest.raises(ConnectionError):
                await resting.message()
            late = await websocket_connect(f"ws://localhost:{there.port}/live")
            assert await late.read_message() is None
            codes = resting.socket.close_code, late.close_code
            late.close()
            await resting.vanish()
            for wire in (lecturer, busy, new):
                await wire.close()
            return codes

        assert talk(come()) == (CLOSE_RESTING, CLOSE_FULL)


def test_pages_that_come_back_together_come_one_after_the_other(monkeypatch):
    monkeypatch.setattr(live.time, "monotonic", lambda: 100.0)
    places = LivePages(10)
    assert [places.turn_of_return() for _ in range(4)] == [0.0, 0.03, 0.06, 0.09]
    assert max(places.turn_of_return() for _ in range(1000)) == live.MAX_RETURN_SECONDS
    monkeypatch.setattr(live.time, "monotonic", lambda: 200.0)
    assert places.turn_of_return() == 0.0
