"""What visitors leave behind: work ends with who wanted it, sessions with their pages, and memory has a plateau."""

import asyncio
from pathlib import Path

import pytest
from codim2_app.picture.draw.packing import unpack

from tests.app.serving import serving
from tests.benchmarks import app_load
from tests.benchmarks.wire import Wire
from tests.work import talk as in_a_thread
from tests.work import wait_until

AT_ONCE = 4  # visitors: one after the other they would wait for their own machine most of the time
FORGOTTEN = 30.0  # seconds
TYPED_FIRST, MOVED = 58, 12  # visits that type, and settings of their formulas: the first ones are timed by workers
PLATEAU = 40e6  # bytes by which what is held after a thousand visits may exceed what is held after a hundred


@pytest.fixture(scope="module")
def address():
    with serving("--workers", "2") as found:
        yield found


def children(pid):
    return [
        int(word) for task in Path(f"/proc/{pid}/task").iterdir() for word in (task / "children").read_text().split()
    ]


def state_of(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "gone"


def workers(server):
    """The processes that were forked to work next to the frames."""
    return [worker for helper in children(server) for worker in children(helper)]


WHILE = 3.0  # seconds of processor time: a worker that is at something else, for the picture, is done before
TYPED = {"system": "own", "texts": {"U1": "sin(5*c)*c-s+z", "U2": "cos(5*s)+c", "W": "0"}}
FILE = {"kind": "html", "sliders": ["z=-1,1"]}  # a hundred pictures of a typed system: tens of seconds


async def begin(address):
    """Open a page and ask for a file that takes long, until a worker has been at it for a while."""
    wire = await Wire.connect(address.port)
    await wire.frame(1, **TYPED)
    before = {worker: app_load.cpu(worker) for worker in workers(address.pid)}
    await wire.send({"take": {**FILE, "id": 1}})

    def at_work():
        return [one for one in workers(address.pid) if app_load.cpu(one) - before.get(one, 0.0) > WHILE]

    return wire, await asyncio.to_thread(wait_until, at_work)


@pytest.mark.parametrize("how", ["leave", "vanish", "another file"])
def test_work_that_nobody_wants_any_more_ends_in_mid_work(address, how):
    async def talk():
        wire, busy = await begin(address)
        assert len(busy) == 1
        if how == "another file":
            await wire.send({"take": {"kind": "json", "id": 2}})
        else:
            await (wire.close() if how == "leave" else wire.vanish())
        ended = await asyncio.to_thread(wait_until, lambda: state_of(*busy) == "gone", 5.0)
        if how == "another file":
            await wire.frame(3, z=0.5)  # this page goes on
            await wire.close()
        return ended

    assert in_a_thread(talk())


async def drawn(wire, number, **values):
    """Ask for a frame until nothing of its picture is late; return its header."""
    header, _ = unpack(await wire.frame(number, **values))
    while "picture" in header.get("late", []) or not header["ready"]:
        await wire.send({"id": number, "rest": True})
        header, _ = unpack(await wire.next_frame())
    return header


async def type_and_vanish(port, i):
    """Open a page, type a Psi that nobody has typed before, move a slider until frames draw it themselves, and go."""
    wire = await Wire.connect(port)
    await drawn(wire, 1, psi="custom", psi_text=f"1/(1+s)+exp(-{1 + i}*s)")
    for tick in range(MOVED if i < TYPED_FIRST else 1):
        await drawn(wire, 2 + tick, a=app_load.value(i + tick))
    await wire.vanish()


async def drag_and_vanish(port, i):
    wire = await Wire.connect(port)
    await wire.frame(1, a=app_load.value(i))
    await wire.vanish()


def test_a_thousand_visits_hold_no_more_than_a_hundred():
    async def visits(port, kinds):
        for first in range(0, len(kinds), AT_ONCE):
            await asyncio.gather(*(visit(port, i) for i, visit in kinds[first : first + AT_ONCE]))

    async def held(port, pid):
        stays = await Wire.connect(port)
        for kinds in (first, others):
            await visits(port, kinds)
            await stays.frame(1, a=app_load.value(len(kinds)))
            alone = lambda: app_load.there(port) == 1
            assert await asyncio.to_thread(wait_until, alone, FORGOTTEN), app_load.left(port)
            await app_load.at_rest(pid)
            yield app_load.left(port)
        await stays.close()

    async def both(port, pid):
        return [each async for each in held(port, pid)]

    first = [(i, type_and_vanish if i < TYPED_FIRST else drag_and_vanish) for i in range(150)]
    others = [(i, drag_and_vanish if i % 10 else type_and_vanish) for i in range(150, 1000)]
    with app_load.serving("forgetful") as (port, pid):
        before, after = in_a_thread(both(port, pid))
    assert after["Frames"] == 1
    assert after["Scene"] <= before["Scene"]
    assert after["resident"] - before["resident"] < PLATEAU, (before, after)
