"""What comes at intervals comes at them, whatever somebody does to the machine's clock."""

import asyncio
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from codim2_app.server.process.clock import keep_steady
from tornado.ioloop import IOLoop, PeriodicCallback

DAY = 86400.0


@pytest.mark.parametrize("by", [-DAY, DAY])
def test_a_clock_that_is_set_holds_up_nothing(monkeypatch, by):
    done = []

    async def beating():
        loop = IOLoop.current()
        keep_steady(loop)
        beat = PeriodicCallback(lambda: done.append("beat"), 1)
        beat.start()
        while len(done) < 2:
            await asyncio.sleep(0.001)
        monkeypatch.setattr(time, "time", lambda real=time.time: real() + by)
        had = len(done)
        loop.call_later(0.001, lambda: done.append("later"))
        while "later" not in done or len(done) < had + 4:
            await asyncio.sleep(0.001)
        beat.stop()

    with ThreadPoolExecutor(1) as pool:  # a browser's loop may run in this thread
        pool.submit(asyncio.run, asyncio.wait_for(beating(), 30.0)).result()
