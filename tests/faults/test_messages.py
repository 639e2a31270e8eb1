"""What no page sends: each is refused in one sentence, costs little, stops nobody else and leaves no traceback."""

import asyncio
import json

import pytest
from codim2_app.draw.packing import unpack
from codim2_app.state.controls import NAMES
from tornado.websocket import WebSocketClosedError

from tests.app.serving import serving
from tests.benchmarks.bokeh_wire import Wire

MOST = 30e6  # bytes that all of them together may leave behind, with their sessions


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """The address of a server, and its log."""
    log = tmp_path_factory.mktemp("log") / "log.txt"
    with serving(log=log) as address:
        yield address, log


def resident(pid):
    with open(f"/proc/{pid}/statm") as pages:
        return int(pages.read().split()[1]) * 4096


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

    answer = asyncio.run(talk())
    assert "Traceback" not in log.read_text()
    assert max(map(len, log.read_text().splitlines()), default=0) < 1000
    return answer


def sent(*parts):
    """Send the parts of a message as they are; return the answer."""

    async def do(wire):
        for part in parts:
            await wire.socket.write_message(part, binary=isinstance(part, bytes))
        return (await wire.read())[:2]

    return do


def of(kind, content, **more):
    return json.dumps({"msgid": "1", "msgtype": kind, **more}), "{}", content


@pytest.mark.parametrize("name", sorted(NAMES))
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
    assert all("Left out:" in one for one in said[-2:])  # too many, too long
    assert "too large" in said[7]
    assert all(len(one) < 600 for one in said)


ODD = [5, "all", [], {"id": "9" * 100_000}, {"id": None, "set": []}, {"take": 1}, {"set": dict.fromkeys("abcd" * 20)}]


@pytest.mark.parametrize("given", [*ODD, {"set": {str(i): 0 for i in range(5000)}}])
def test_requests_of_wrong_kinds(server, given):
    async def do(wire):
        await wire.event("data_event", wire.root, data=given)
        await wire.event("data_event", wire.root, data={"id": 7})
        while True:
            kind, _, buffers = await wire.read()
            if kind == "PATCH-DOC" and buffers and unpack(buffers[0])[0]["id"] == 7:
                return "answered"

    assert refused(server, do) == "answered"


@pytest.mark.parametrize("data", [{"set": {"layers": [f"l{i}" for i in range(10**6)]}}, {"id": "9" * 10**7}])
def test_a_message_of_megabytes_closes_the_connection(server, data):
    async def do(wire):
        await wire.event("data_event", wire.root, data=data)
        await wire.read()

    assert refused(server, do) == "closed"


PATCH = [
    '{"events":5}',
    '{"events":[{"kind":"ModelChanged","model":{"id":"zz"},"attr":"x","new":1}]}',
    '{"events":[{"kind":"MessageSent","msg_type":"bokeh_event","msg_data":{"type":"event","name":"zz","values":1}}]}',
    '{"events":[{"kind":"nothing"}]}',
]


@pytest.mark.parametrize("content", PATCH)
def test_what_bokeh_cannot_handle_is_told_without_its_files(server, content):
    kind, answer = refused(server, sent(*of("PATCH-DOC", content)))
    assert kind == "ERROR"
    assert answer["traceback"] is None
    assert ".py" not in answer["text"]


@pytest.mark.parametrize("parts", [("{", "", "x"), (b"\0\1",), of("NOTHING", "{}"), of("PUSH-DOC", '{"doc":{}}'),
                                   of("PATCH-DOC", "[" * 90_000 + "]" * 90_000), of("ACK", "{}"), ("[]", "[]", "[]"),
                                   ("1" * 150_000, "{}", "{}")])  # fmt: skip
def test_what_is_no_message_closes_the_connection(server, parts):
    assert refused(server, sent(*parts)) == "closed"


@pytest.mark.parametrize("size", [0, 150_000])
def test_the_parts_of_one_message_are_bounded_together(server, size):
    async def do(wire):
        for part in of("PATCH-DOC", '{"events":[]}', num_buffers=10**9):
            await wire.socket.write_message(part)
        for _ in range(3000 if size == 0 else 300):
            await wire.socket.write_message('{"id":"b"}')
            await wire.socket.write_message(b"x" * size, binary=True)
        await wire.read()

    before = resident(server[0].pid)
    assert refused(server, do) == "closed"
    assert resident(server[0].pid) - before < MOST
