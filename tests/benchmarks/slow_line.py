"""A TCP proxy that holds everything back: a server that is far away, on this machine."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager


async def _carry(reader: asyncio.StreamReader, writer: asyncio.StreamWriter, delay: float) -> None:
    """Copy one direction; each piece leaves `delay` seconds after it came, in order, however many are on their way."""
    pieces: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()

    async def deliver() -> None:
        while True:
            due, piece = await pieces.get()
            await asyncio.sleep(max(0.0, due - time.perf_counter()))
            if not piece:
                writer.close()
                return
            try:
                writer.write(piece)
                await writer.drain()
            except ConnectionError:  # nobody is there any more
                return

    async with asyncio.TaskGroup() as both:
        both.create_task(deliver())
        piece = b"start"
        while piece:
            try:
                piece = await reader.read(1 << 16)
            except ConnectionError:
                piece = b""
            pieces.put_nowait((time.perf_counter() + delay, piece))


class _Line:
    """The proxy within its loop: connections are closed in order when it ends, and their tasks awaited."""

    def __init__(self, host: str, port: int, delay: float) -> None:
        self.far = host, port
        self.delay = delay
        self.over = asyncio.Event()
        self.connections: set[asyncio.Task[None]] = set()

    async def connect(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Carry one connection until both of its ends have closed it, or all is over."""
        task = asyncio.current_task()
        assert task is not None
        self.connections.add(task)
        try:
            far_reader, far_writer = await asyncio.open_connection(*self.far)
        except OSError:
            writer.close()
            return
        writers = (writer, far_writer)
        for one in writers:
            one.transport.set_write_buffer_limits(0)
        ways = [asyncio.create_task(_carry(*way, self.delay)) for way in ((reader, far_writer), (far_reader, writer))]
        both, over = asyncio.gather(*ways), asyncio.create_task(self.over.wait())
        await asyncio.wait((both, over), return_when=asyncio.FIRST_COMPLETED)
        for rest in (*ways, over):
            rest.cancel()
        await asyncio.gather(*ways, both, over, return_exceptions=True)
        for one in writers:
            one.close()
        await asyncio.gather(*(one.wait_closed() for one in writers), return_exceptions=True)


@contextmanager
def slow_line(address: str, round_trip: float) -> Iterator[str]:
    """Yield the address at which the server at `address` answers `round_trip` seconds later than it does.

    Parameters
    ----------
    address : str
        ``http://host:port``.
    round_trip : float
        In seconds; half of it each way.
    """
    host, port = address.removeprefix("http://").split(":")
    opened: list[tuple[asyncio.AbstractEventLoop, _Line, int]] = []
    ready = threading.Event()

    async def serve() -> None:
        line = _Line(host, int(port), round_trip / 2)
        server = await asyncio.start_server(line.connect, "localhost", 0)
        opened.append((asyncio.get_running_loop(), line, server.sockets[0].getsockname()[1]))
        ready.set()
        await line.over.wait()
        server.close()
        await asyncio.gather(*line.connections)

    thread = threading.Thread(target=asyncio.run, args=(serve(),), daemon=True)
    thread.start()
    ready.wait(10)
    loop, line, near = opened[0]
    try:
        yield f"http://localhost:{near}"
    finally:
        loop.call_soon_threadsafe(line.over.set)
        thread.join(10)
