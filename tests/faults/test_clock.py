"""The machine's clock is set while people are there, by hours: nobody notices."""

import asyncio

import pytest
from codim2_app.picture.draw.packing import unpack

from tests.benchmarks import app_load
from tests.benchmarks.wire import Wire
from tests.faults.test_leaving import FILE, TYPED, state_of, workers
from tests.work import talk as in_a_thread
from tests.work import wait_until

HOUR = 3600.0
AT_WORK = 0.5  # seconds of processor time of a worker that has begun


@pytest.fixture(scope="module")
def machine(tmp_path_factory):
    """A server, as (port, pid), and the file that holds by how much its clock has been set."""
    offset = tmp_path_factory.mktemp("clock") / "offset"
    offset.write_text("0")
    with app_load.serving("jumping", str(offset)) as served:
        yield *served, offset


pages: list[Wire] = []


async def opened(port):
    pages.append(await Wire.connect(port))
    return pages[-1]


async def told(wire, condition):
    """What a page is told of its room, once it meets a condition."""
    while not condition(answer := await wire.heard("room")):
        pass
    return answer


async def finished(wire):
    """Wait for a frame of a typed system of which workers have computed the picture."""
    number, header = 100, {"ready": False}
    while not header["ready"] or "picture" in header.get("late", ()):
        await asyncio.sleep(0.1)
        number += 1
        header, _ = unpack(await wire.frame(number))


@pytest.mark.parametrize("by", [-2 * HOUR, 24 * HOUR])
def test_a_clock_that_is_set_ends_no_session_and_holds_up_nothing(machine, by):
    port, pid, offset = machine

    async def talk():
        lecturer, phone, typist = [await opened(port) for _ in range(3)]
        code = (await lecturer.ask("room", {"open": ""}))["open"]
        assert (await phone.ask("room", {"join": code}))["joined"] == code
        await told(lecturer, lambda answer: len(answer.get("rows", ())) == 1)

        offset.write_text(str(float(offset.read_text()) + by))
        after = await opened(port)  # a new page opens
        for number, wire in enumerate((lecturer, phone, after)):
            header, _ = unpack(await wire.frame(number + 2, a=-1.1 - 0.1 * number))
            assert header["id"] == number + 2
        later = await opened(port)  # the room is open, and its lecturer sees who comes
        assert (await later.ask("room", {"join": code}))["joined"] == code
        await told(lecturer, lambda answer: len(answer.get("rows", ())) == 2)

        await typist.frame(1, **TYPED)
        await finished(typist)
        spent = {worker: app_load.cpu(worker) for worker in workers(pid)}
        await typist.send({"take": {**FILE, "id": 1}})

        def at_work():
            return [one for one in workers(pid) if app_load.cpu(one) - spent.get(one, 0.0) > AT_WORK]

        (busy,) = await asyncio.to_thread(wait_until, at_work)
        while pages:
            await pages.pop().vanish()
        assert await asyncio.to_thread(wait_until, lambda: state_of(busy) == "gone", 5.0)
        assert await asyncio.to_thread(wait_until, lambda: not app_load.there(port), 20.0)

    async def whole():
        try:
            await asyncio.wait_for(talk(), 120)
        finally:
            while pages:
                await pages.pop().vanish()

    in_a_thread(whole())
