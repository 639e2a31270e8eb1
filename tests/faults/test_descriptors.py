"""One who opens more connections than there are descriptors, and half-sent requests: others are served all the same."""

import asyncio
import sys
from contextlib import suppress
from urllib.request import urlopen

import pytest
from codim2_app.picture.draw.packing import unpack

from tests.app.serving import serving
from tests.benchmarks.wire import Wire
from tests.work import PATIENCE, talk

IDLE = 400


async def heard(line):
    with suppress(ConnectionError):  # it was closed before what it said was read
        return await line.read()


@pytest.mark.skipif(sys.platform != "linux", reason="prlimit is of Linux")
def test_idle_connections_of_one_address_take_no_place_of_others(tmp_path):
    """With 256 descriptors, of which one address wants 400: the server lives, says so, and draws for who is in."""
    log = tmp_path / "log.txt"
    command = ("--nofile=256:256", sys.executable, "-m", "codim2_app.server.cli")

    async def play(port):
        wire = await Wire.connect(port)
        lines = [await asyncio.open_connection("127.0.0.1", port) for _ in range(IDLE)]
        for _, writer in lines[::2]:
            writer.write(b"GET / HTTP/1.1\r\nHost: half")
        health = await asyncio.to_thread(lambda: urlopen(f"http://127.0.0.1:{port}/health", timeout=PATIENCE).status)
        header, _ = unpack(await wire.frame(1, a=-1.5))
        reader, writer = await asyncio.open_connection("127.0.0.1", port, local_addr=("127.0.0.2", 0))
        writer.write(f"GET / HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: close\r\n\r\n".encode())
        page = await asyncio.wait_for(reader.read(), PATIENCE)
        writer.close()
        ends = await asyncio.wait_for(asyncio.gather(*(heard(one) for one, _ in lines)), PATIENCE)
        for _, line in lines:
            line.close()
        await wire.close()
        return health, header["id"], page, ends

    with serving(python="prlimit", command=command, log=log) as address:
        health, drawn, page, ends = talk(play(address.port))
    assert (health, drawn) == (200, 1)
    assert page.startswith(b"HTTP/1.1 200")
    assert len(ends) == IDLE  # all of them have been closed: none sent a request within 20 s
    assert len(log.read_text().splitlines()) < 20
