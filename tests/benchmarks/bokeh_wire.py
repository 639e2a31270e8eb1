"""A browser's end of Bokeh's websocket, without a browser: what the benchmarks and tests of traffic need."""

from __future__ import annotations

import asyncio
import json
import re
from typing import Any
from urllib.request import urlopen

from tornado.httpclient import HTTPRequest
from tornado.websocket import WebSocketClientConnection, websocket_connect


def encoded(value: Any) -> Any:
    """Write nested dicts as Bokeh's protocol does."""
    if isinstance(value, dict):
        return {"type": "map", "entries": [[key, encoded(item)] for key, item in value.items()]}
    return value


def decoded(value: Any) -> Any:
    """Read nested dicts and lists as Bokeh's protocol writes them."""
    if isinstance(value, dict) and value.get("type") == "map":
        return {key: decoded(item) for key, item in value.get("entries", ())}
    return [decoded(item) for item in value] if isinstance(value, list) else value


class Wire:
    """One page's connection. `patches` counts the patches that arrived, `bytes` the size of everything."""

    def __init__(self, socket: WebSocketClientConnection) -> None:
        self.socket, self.root = socket, ""
        self.count = 0
        self.patches = 0
        self.bytes = 0
        self.document: dict[str, Any] = {}

    @classmethod
    async def connect(cls, port: int, query: str = "", page: str | None = None, prefix: str = "") -> Wire:
        """Open a page (or use its text, fetched before) and the session behind it."""
        if page is None:
            with urlopen(f"http://localhost:{port}{prefix}/{query}") as answer:
                page = answer.read().decode()
        token = re.search(r'"token":"([^"]+)"', page)
        assert token is not None
        request = HTTPRequest(
            f"ws://localhost:{port}{prefix}/ws", headers={"Sec-WebSocket-Protocol": f"bokeh, {token[1]}"}
        )
        opened = await websocket_connect(request, max_message_size=2**26)
        opened.protocol.stream.set_nodelay(True)  # as browsers do
        wire = cls(opened)
        await wire.read()  # ACK
        await wire.send("PULL-DOC-REQ", {})
        _, content, _ = await wire.read()
        wire.document = content["doc"]
        wire.root = wire.document["roots"][0]["id"]  # another process than the page's may have made the document
        return wire

    async def send(self, kind: str, content: Any) -> None:
        """Send one message."""
        self.count += 1
        header = {"msgid": f"m{self.count}", "msgtype": kind}
        for part in (header, {}, content):
            await self.socket.write_message(json.dumps(part))

    async def read(self) -> tuple[str, Any, list[bytes]]:
        """Return kind, content and buffers of the next message."""
        parts = [await self._part() for _ in range(3)]
        header = json.loads(parts[0])
        buffers = []
        for _ in range(header.get("num_buffers", 0)):
            await self._part()
            buffers.append(await self._part())
        self.patches += header["msgtype"] == "PATCH-DOC"
        return header["msgtype"], json.loads(parts[2]), buffers

    async def _part(self) -> Any:
        part = await self.socket.read_message()
        if part is None:
            raise ConnectionError("the server closed the connection")
        self.bytes += len(part)
        return part

    async def event(self, name: str, model: str, **values: Any) -> None:
        """Send one model event, as BokehJS does."""
        entries = [["model", {"id": model}], *([key, encoded(value)] for key, value in values.items())]
        data = {"type": "event", "name": name, "values": {"type": "map", "entries": entries}}
        await self.send("PATCH-DOC", {"events": [{"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": data}]})

    async def frame(self, number: int, **values: Any) -> bytes:
        """Ask the explorer for one frame and return its buffer."""
        await self.event("data_event", self.root, data={"id": number, "set": values})
        return await self.patch()

    async def patch(self) -> bytes:
        """Return the first buffer of the next patch, past acknowledgements."""
        while True:
            kind, content, buffers = await self.read()
            if kind == "PATCH-DOC":
                return buffers[0] if buffers else b""
            if kind == "ERROR":
                raise RuntimeError(f"the server reports an error: {content['text']}")

    async def ask(self, name: str, request: Any) -> Any:
        """Send a request that is no frame, and return the answer to it."""
        await self.event("data_event", self.root, data={name: request})
        return await self.heard(name)

    async def heard(self, name: str) -> Any:
        """Return what the server says next under a name, past all else."""
        while True:
            kind, content, _ = await self.read()
            for event in content["events"] if kind == "PATCH-DOC" else ():
                said = decoded(event.get("msg_data", {}).get("values", {})).get("data", {})
                if name in said:
                    return said[name]

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
