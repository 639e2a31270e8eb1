"""The line of a page: what it asks for, and what is asked of nobody else."""

import asyncio
from urllib.request import urlopen

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.request_reading import MOST_CONTROLS
from codim2_app.server.live import MOST_ASKED, REFUSED, LiveConnection, LivePages, merge_requests
from codim2_app.server.session_queue import Rota
from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.httpserver import HTTPServer
from tornado.testing import bind_unused_port
from tornado.web import Application

from tests.benchmarks.wire import Wire
from tests.work import talk


def test_a_flood_is_answered_with_its_newest_values_and_holds_nobody_up(server):
    async def flood():
        wild, calm = await Wire.connect(server.port), await Wire.connect(server.port)
        sets = [{"a": -1.0 - 0.001 * i, "b": 0.5} if i % 2 else {"a": -1.0 - 0.001 * i} for i in range(300)]
        await asyncio.gather(*(wild.send({"id": i, "set": values}) for i, values in enumerate(sets)))  # in one breath
        heard = [unpack(await calm.frame(i, d=-1.0 - 0.01 * i))[0]["id"] for i in range(3)]
        last = -1
        while last < 299:
            header, _ = unpack(await wild.next_frame())
            assert header["id"] > last
            last = header["id"]
        await wild.send({"take": {"kind": "json", "id": 1}})
        link = (await wild.message())["file"].decode()
        await wild.close()
        await calm.close()
        return heard, wild.frames, link

    heard, frames, link = talk(flood())
    assert heard == [0, 1, 2]
    assert frames < 250  # requests that came while others had their turns are one
    assert "a=-1.299&b=0.5" in link


def test_requests_that_are_one_lose_nothing_of_either():
    grab = {"id": 1, "set": {"f1": 1.0, "grab": [0.1, 0.2]}, "all": True, "rest": True, "window": None}
    slider = {"id": 2, "set": {"f1": 0.3}, "rest": False, "window": [0, 1, 0, 1, 0.01]}
    merged = merge_requests(grab, slider)
    assert merged == {**slider, "set": {"grab": [0.1, 0.2], "f1": 0.3}, "all": True}
    assert list(merged["set"]) == ["grab", "f1"]  # in the order in which they were set
    assert merge_requests(grab, {"id": 2, "set": [1]})["set"] == grab["set"]
    assert merge_requests({"set": "x"}, slider)["set"] == slider["set"]


def test_what_another_system_brings_stays_as_it_is_brought():
    merged = merge_requests({"set": {"a": 1.0, "z": 2.0, "parameters": {"k": 1.0}}}, {"set": {"system": "ball"}})
    assert merged["set"] == {"a": 1.0, "system": "ball"}


def test_requests_that_are_one_hold_no_more_than_one_may():
    """Who reads nothing, and names something else each time, has nothing of it kept."""
    merged = {"set": {"a": 1.0}}
    for i in range(1000):
        merged = merge_requests(merged, {"set": {f"x{i}": "x"}})
    assert len(merged["set"]) <= MOST_CONTROLS


def test_who_reads_nothing_is_answered_no_further(server):
    """What is not read is held by the server: one frame, and not one for each request."""

    async def silent():
        wire = await Wire.connect(server.port)
        stream = wire.socket.protocol.stream
        stream._add_io_state = lambda state: None  # nothing is read any more
        for i in range(2000):
            await wire.send({"id": i, "set": {"a": -1.0 - 0.0001 * i}})
        other = await Wire.connect(server.port)
        header, _ = unpack(await other.frame(1))
        await wire.vanish()
        await other.close()
        return header["id"]

    assert talk(silent()) == 1


def test_only_pages_of_names_that_are_known_have_a_line(server):
    async def come(origin):
        request = HTTPRequest(f"ws://localhost:{server.port}/live", headers={"Origin": origin})
        try:
            await (await Wire.at(request)).close()
        except HTTPClientError as error:
            return error.code
        return 101

    async def all_of_them():
        names = (f"http://localhost:{server.port}", "http://elsewhere.example", "null", "https://localhost")
        return [await come(name) for name in names]

    assert talk(all_of_them()) == [101, 403, 403, 403]


def test_two_rooms_are_not_opened_by_one_page(server):
    async def lecturer():
        wire, codes = await Wire.connect(server.port), []
        for _ in range(30):  # more than there may be rooms
            told = await wire.ask("room", {"open": ""})
            while "open" not in told:  # rows of the room before, which come in between, twice a second
                told = await wire.heard("room")
            codes.append(told["open"])
        other = await Wire.connect(server.port)
        found = [(await other.ask("room", {"join": code})) for code in codes[-2:]]
        await wire.close()
        await other.close()
        return found, codes

    found, codes = talk(lecturer())
    assert "error" in found[0]
    assert found[1]["joined"] == codes[-1]


def test_metrics_count_what_was_done(server):
    def metrics():
        with urlopen(f"{server}/metrics") as answer:
            assert answer.headers["Content-Type"].startswith("text/plain; version=0.0.4")
            lines = [line.rsplit(" ", 1) for line in answer.read().decode().splitlines() if not line.startswith("#")]
        return {name.partition("{")[0]: float(value) for name, value in lines}

    async def drag():
        wire = await Wire.connect(server.port)
        for i in range(5):
            await wire.frame(i, a=-1.0 - 0.01 * i)
        there = await asyncio.to_thread(metrics)
        await wire.close()
        return there

    before, there = metrics(), talk(drag())
    for name, least in (("frames", 5), ("openings", 1)):
        assert there[f"codim2_{name}_total"] - before[f"codim2_{name}_total"] >= least
    assert there["codim2_wait_seconds_count"] - before["codim2_wait_seconds_count"] >= 5
    assert there["codim2_pages"] >= 1
    assert there["codim2_resident_bytes"] > 5e7


def test_what_a_page_draws_itself_is_noted_for_rooms_and_files(server):
    """No frame is made of it; the next frame has every layer, as its page asks for all."""

    async def noted():
        lecturer, student = await Wire.connect(server.port), await Wire.connect(server.port)
        code = (await lecturer.ask("room", {"open": ""}))["open"]
        await student.ask("room", {"join": code})
        await student.send({"note": {"f1": 2.5, "a": "no number", "nothing": 1}})
        row = []
        while row[2:] != [{"f1": 2.5}, None]:
            row = ((await lecturer.heard("room")).get("rows") or [[]])[0]
        await student.send({"note": {"f1": 1.0, "psi": "rational"}})
        await student.send({"take": {"kind": "json", "id": 1}})
        link = (await student.message())["file"].decode()
        frames = student.frames
        await student.send({"id": 9, "set": {}, "all": True})
        header, blocks = unpack(await student.next_frame())
        await lecturer.close()
        await student.close()
        return row[1], link, frames, header, blocks

    name, link, frames, header, blocks = talk(noted())
    assert name == "NCM2"
    assert "f1=1.0" in link
    assert "psi=rational" in link
    assert frames == 0
    assert (header["id"], header["portrait"]["name"]) == (9, "CM2")
    assert "inside.xy" in blocks


def test_whatever_is_asked_at_once_is_answered(server):
    """Forty-two of fifty files were not; and half a character ends no request."""

    async def ask():
        wire = await Wire.connect(server.port)
        for i in range(50):
            await wire.send({"take": {"kind": "json", "id": i}})
        taken = [(await wire.message()).get("taken") for _ in range(50)]
        opened = await wire.ask("room", {"open": "\ud800"})
        joined = await wire.ask("room", {"join": "\udfff"})
        await wire.send({"room": {"close": True}})
        await wire.close()
        return taken, opened, joined

    taken, opened, joined = talk(ask())
    assert taken == list(range(50))
    assert "open" in opened
    assert "error" in joined


@pytest.mark.parametrize(("count", "size"), [(MOST_ASKED, 0), (2, 150_000)])
def test_more_than_a_page_asks_at_once_closes_its_line(monkeypatch, count, size):
    """So much may wait for its turn, and one more closes the line."""
    monkeypatch.setattr(Rota, "ask", lambda rota, page: None)  # nobody has a turn

    async def flood():
        places = LivePages(1)
        server = HTTPServer(Application([("/live", LiveConnection, {"places": places})]))
        listening, port = bind_unused_port()
        server.add_socket(listening)
        wire = await Wire.connect(port)
        (page,) = places.open
        for i in range(count):
            await wire.send({"take": {"kind": "json", "id": i, "more": "x" * size}})
        while len(page._asked) < count:
            await asyncio.sleep(0)
        await wire.send({"take": {"kind": "json", "id": count, "more": "x" * size}})
        with pytest.raises(ConnectionError):
            await wire.message()
        await wire.vanish()
        server.stop()
        return wire.socket.close_code

    assert talk(flood()) == REFUSED
