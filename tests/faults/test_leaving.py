"""What visitors leave behind: work ends with who wanted it."""

import asyncio
import time
from pathlib import Path

import pytest

from tests.app.serving import serving
from tests.benchmarks.bokeh_wire import Wire


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
    """The processes that were forked to work beside the frames."""
    return [worker for helper in children(server) for worker in children(helper)]


def until(condition, seconds=60.0):
    """Wait for a condition; return what it is in the end."""
    end = time.monotonic() + seconds
    while not (found := condition()) and time.monotonic() < end:
        time.sleep(0.05)
    return found


FILE = {"kind": "html", "sliders": ["f1=-1,1", "d=-2,2"]}  # a hundred pictures: tens of seconds


async def begin(address):
    """Open a page and ask for a file that takes long, until a worker has been at it for a while."""
    wire = await Wire.connect(address.port)
    await wire.frame(1, a=-1.25)
    await wire.event("data_event", wire.root, data={"take": {**FILE, "id": 1}})
    for _ in range(3):
        busy = await asyncio.to_thread(until, lambda: [one for one in workers(address.pid) if state_of(one) == "R"])
        await asyncio.sleep(0.3)
    return wire, busy


@pytest.mark.parametrize("how", ["leave", "vanish", "another file"])
def test_work_that_nobody_wants_any_more_ends_in_mid_work(address, how):
    async def talk():
        wire, busy = await begin(address)
        assert busy
        if how == "another file":
            await wire.event("data_event", wire.root, data={"take": {"kind": "json", "id": 2}})
        else:
            await (wire.close() if how == "leave" else wire.vanish())
        # one that is done waits for more; one that is stopped is gone
        ended = await asyncio.to_thread(until, lambda: "gone" in map(state_of, busy), 5.0)
        ended = ended and await asyncio.to_thread(until, lambda: "R" not in map(state_of, busy), 5.0)
        if how == "another file":
            await wire.frame(3, a=-1.5)  # this page goes on
            await wire.close()
        return ended

    assert asyncio.run(talk())
