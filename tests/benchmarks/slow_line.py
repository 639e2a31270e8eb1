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
            writer.write(piece)
            await writer.drain()

    delivering = asyncio.ensure_future(deliver())
    piece = b"start"
    while piece:
        try:
            piece = await reader.read(1 << 16)
        except (ConnectionError, asyncio.CancelledError):
            piece = b""
        pieces.put_nowait((time.perf_counter() + delay, piece))
    await asyncio.gather(delivering, return_exceptions=True)


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
    loop = asyncio.new_event_loop()
    opened: list[int] = []
    ready = threading.Event()

    async def connect(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        far_reader, far_writer = await asyncio.open_connection(host, int(port))
        for one in (writer, far_writer):
            one.transport.set_write_buffer_limits(0)
        await asyncio.gather(
            _carry(reader, far_writer, round_trip / 2),
            _carry(far_reader, writer, round_trip / 2),
            return_exceptions=True,
        )

    async def listen() -> None:
        server = await asyncio.start_server(connect, "localhost", 0)
        opened.append(server.sockets[0].getsockname()[1])
        ready.set()

    def run() -> None:
        asyncio.set_event_loop(loop)
        loop.run_until_complete(listen())
        loop.run_forever()
        for task in asyncio.all_tasks(loop):
            task.cancel()
        loop.run_until_complete(asyncio.sleep(0.05))
        loop.close()

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    ready.wait(10)
    try:
        yield f"http://localhost:{opened[0]}"
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join(5)
