"""Several server processes on one port: visitors are shared evenly among them."""

import asyncio
import re
import subprocess
import sys

from codim2_app.server.process.ports import Crowds
from tornado.websocket import websocket_connect

from tests.work import PATIENCE, talk

PROCESSES, PAGES = 2, 6
#: A busy machine may keep the smallest process from its next page for long: the others wait.
CODE = """import sys
from codim2_app.server.cli import main
from codim2_app.server.process import listener

listener.MAX_LEFT = 10**9
sys.exit(main(sys.argv[1:]))
"""


def test_the_smallest_crowd_is_that_of_fewest_pages_then_of_fewest_connections():
    crowds = Crowds(2)
    crowds.belong(1)
    assert crowds.is_smallest()
    crowds.count_connections(1)
    assert not crowds.is_smallest()
    crowds.belong(0)
    crowds.count_pages(1)
    assert not crowds.is_smallest()
    crowds.belong(0)
    assert crowds.is_smallest()


def test_pages_are_shared_evenly_among_the_processes():
    command = [sys.executable, "-c", CODE, "serve", "--port", "0", "--processes", str(PROCESSES)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        port, listening = None, 0
        while listening < PROCESSES:  # each process says where it is, once it listens
            said = process.stdout.readline()
            assert said, "the server has ended"
            port = re.search(r"http://[^/]*:(\d+)/", said)[1] if "http://" in said else port
            listening += "version" in said
        assert talk(shares(int(port))) == [PAGES // PROCESSES] * PROCESSES
    finally:
        process.terminate()
        process.wait(PATIENCE)
        process.stdout.close()


async def shares(port):
    """Return the pages of each process once all are open."""
    async with Lines(port) as lines:
        await lines.until(lambda told: all(one["compiled"] == one["to_compile"] > 0 for one in told))
        pages = [await websocket_connect(f"ws://localhost:{port}/live") for _ in range(PAGES)]
        told = await lines.until(lambda told: sum(one["pages"] for one in told) == PAGES)
        for page in pages:
            page.close()
            while await page.read_message() is not None:
                pass
    return sorted(one["pages"] for one in told)


class Lines:
    """Lines to all processes, over which each tells its metrics: what is connected already goes to no other one."""

    def __init__(self, port):
        self.port, self.lines = port, {}

    async def __aenter__(self):
        spare = []
        while len(self.lines) < PROCESSES:
            line = await asyncio.open_connection("localhost", self.port)
            name = (await self.metrics(line))["process"]
            if name in self.lines:
                spare.append(line)
            else:
                self.lines[name] = line
        await self.close(spare)
        return self

    async def __aexit__(self, *_):
        await self.close(self.lines.values())

    async def close(self, lines):
        for _, writer in lines:
            writer.close()
            await writer.wait_closed()

    async def metrics(self, line):
        """Return what the process at the other end of a line tells."""
        reader, writer = line
        writer.write(b"GET /metrics HTTP/1.1\r\nHost: localhost:%d\r\n\r\n" % self.port)
        head = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), PATIENCE)
        body = await reader.readexactly(int(re.search(rb"Content-Length: (\d+)", head)[1]))
        rows = re.findall(r'codim2_(\w+){process="(\d+)"} (\d+)', body.decode())
        return {"process": rows[0][1], **{name: int(value) for name, _, value in rows}}

    async def until(self, condition):
        """Return what all tell once it meets a condition."""
        while not condition(told := [await self.metrics(line) for line in self.lines.values()]):
            await asyncio.sleep(0.05)
        return told
