"""What no page sends: each is refused in one sentence, costs little, stops nobody else and leaves no traceback."""

import asyncio

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.controls import CONTROL_NAMES
from tornado.websocket import WebSocketClosedError

from tests.app.serving import serving
from tests.benchmarks.wire import Wire
from tests.work import talk as in_a_thread


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """The address of a server, and its log."""
    log = tmp_path_factory.mktemp("log") / "log.txt"
    with serving(log=log) as address:
        yield address, log


def told(frame):
    return " ".join(unpack(frame)[0]["errors"].values())


async def still_served(address):
    wire = await Wire.connect(address.port)
    header, _ = unpack(await wire.frame(1, a=-1.5))
    assert header["id"] == 1
    await wire.close()


def refused(server, do):
    """Do something in a page of its own; return what it is answered. Another page is served after it."""
    address, log = server

    async def talk():
        wire = await Wire.connect(address.port)
        try:
            answer = await asyncio.wait_for(do(wire), 60)
        except (ConnectionError, WebSocketClosedError):
            answer = "closed"
        await wire.vanish()
        await still_served(address)
        return answer

    answer = in_a_thread(talk())
    assert "Traceback" not in log.read_text()
    assert max(map(len, log.read_text().splitlines()), default=0) < 1000
    return answer


@pytest.mark.parametrize("name", sorted(CONTROL_NAMES))
def test_values_of_wrong_types(server, name):
    wrong = [None, [], {}, "\0", True, [[[]]], {"a": {"b": {}}}, 10**400, 1e308, ["x"] * 8000, "x" * 100_000]

    async def do(wire):
        said = []
        for i, value in enumerate(wrong):
            frame = await wire.frame(i + 1, **{name: value})
            assert unpack(frame)[0]["id"] == i + 1
            said.append(told(frame))
        return said

    said = refused(server, do)
    assert all("ignored" in one for one in said[-2:])  # too many, too long
    assert "too large" in said[7]
    assert all(len(one) < 600 for one in said)


ODD = [{"id": "9" * 100_000}, {"id": None, "set": []}, {"take": 1}, {"set": dict.fromkeys("abcd" * 20)}, {"room": []},
       {"window": "x"}, {"set": {str(i): 0 for i in range(5000)}}]  # fmt: skip


@pytest.mark.parametrize("given", ODD)
def test_requests_of_wrong_kinds(server, given):
    async def do(wire):
        await wire.send(given)
        await wire.send({"id": 7})
        while unpack(await wire.next_frame())[0]["id"] != 7:
            pass
        return "answered"

    assert refused(server, do) == "answered"


@pytest.mark.parametrize("text", ["", "{", "5", "[]", '"all"', "null", "1" * 150_000, "[" * 90_000 + "]" * 90_000,
                                  '{"id": "' + "9" * 10**7 + '"}', b"\0\1"])  # fmt: skip
def test_what_is_no_request_closes_the_connection(server, text):
    async def do(wire):
        await wire.socket.write_message(text, binary=isinstance(text, bytes))
        await wire.read()

    assert refused(server, do) == "closed"
