"""A page's end of ``/live``, without a browser: what the benchmarks and tests of traffic need."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from tornado.httpclient import HTTPRequest
from tornado.websocket import WebSocketClientConnection, websocket_connect

from tests.work import PATIENCE


class Wire:
    """One page's connection. `frames` counts those that arrived, `bytes` the size of everything."""

    def __init__(self, socket: WebSocketClientConnection) -> None:
        self.socket = socket
        self.frames = self.bytes = 0
        self.begun: dict[str, Any] = {}

    @classmethod
    async def connect(cls, port: int, query: str = "", prefix: str = "") -> Wire:
        """Come in as the page of an address does."""
        address = f"ws://localhost:{port}{prefix}/live{query}"
        return await cls.at(HTTPRequest(address, connect_timeout=PATIENCE, request_timeout=PATIENCE))

    @classmethod
    async def at(cls, request: HTTPRequest) -> Wire:
        """Come in by a request, and wait for what a page begins with."""
        opened = await websocket_connect(request, max_message_size=2**26)
        opened.protocol.stream.set_nodelay(True)  # as browsers do
        wire = cls(opened)
        wire.begun = json.loads(await wire.read())
        wire.begun["first"] = await wire.read()
        return wire

    async def send(self, request: Any) -> None:
        """Send one request."""
        await self.socket.write_message(json.dumps(request))

    async def read(self) -> Any:
        """Return the next message: text, or bytes."""
        said = await self.socket.read_message()
        if said is None:
            raise ConnectionError("the server closed the connection")
        self.bytes += len(said)
        return said

    async def frame(self, number: int, **values: Any) -> bytes:
        """Ask for one frame and return it."""
        await self.send({"id": number, "set": values})
        return await self.next_frame()

    async def next_frame(self) -> bytes:
        """Return the next frame, past all else."""
        while True:
            said = await self.read()
            if isinstance(said, bytes):
                self.frames += 1
                return said
            if json.loads(said).get("file") is True:
                await self.read()

    async def ask(self, name: str, request: Any) -> Any:
        """Send a request that is no frame, and return what is said next under that name."""
        await self.send({name: request})
        return await self.heard(name)

    async def heard(self, name: str) -> Any:
        """Return what the server says next under a name, past all else."""
        while name not in (message := await self.message()):
            pass
        return message[name]

    async def message(self) -> dict[str, Any]:
        """Return the next message that is no frame, with its file."""
        while isinstance(said := await self.read(), bytes):
            self.frames += 1
        message = json.loads(said)
        return {**message, "file": await self.read()} if message.get("file") is True else message

    async def close(self) -> None:
        """Close the connection and wait until it is closed."""
        self.socket.close()
        while await self.socket.read_message() is not None:
            pass
        stream = self.socket.protocol.stream if self.socket.protocol else None
        if stream is not None:
            stream.close()

    async def vanish(self) -> None:
        """Let the line go without a word, as a phone does that is switched off."""
        if self.socket.protocol is not None:
            self.socket.protocol.stream.close()
            self.socket.protocol = None  # or it would be warned of: nobody has said goodbye
        await asyncio.sleep(0)
