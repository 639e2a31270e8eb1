"""Visitors whose devices compute: each opens a page, loads its files as a browser does, and then asks for nothing."""

from __future__ import annotations

import asyncio
import gzip
import json
import re
import time
from dataclasses import dataclass, field

from .wire import Wire

RESTS = 2  # requests of a page that has just opened: for what is computed once nothing moves
REST, QUIET = 0.3, 4.0  # seconds after which it asks for that, and after which it loads the worker
CHUNK = 2**18
SCRIPT = re.compile(r'(?:src="|from ")\./((?:explorer|static/js/bokeh)[^"]+)"')


class Files:
    """One connection of a browser that has nothing in its cache."""

    def __init__(self, port: int) -> None:
        self.port, self.bytes = port, 0

    async def __aenter__(self) -> Files:
        self.reader, self.writer = await asyncio.open_connection("localhost", self.port, limit=CHUNK)
        return self

    async def __aexit__(self, *_: object) -> None:
        self.writer.close()

    async def load(self, path: str, kept: bool = False) -> bytes:
        """Load a file, compressed if the server can; return it only if it is to be read."""
        self.writer.write(
            f"GET /{path} HTTP/1.1\r\nHost: localhost:{self.port}\r\nAccept-Encoding: gzip\r\n\r\n".encode()
        )
        head = (await self.reader.readuntil(b"\r\n\r\n")).decode().lower()
        if not head.startswith("http/1.1 200"):
            raise OSError(f"{path}: {head.splitlines()[0]}")
        left, parts = int(head.split("content-length: ")[1].split()[0]), []
        while left:
            part = await self.reader.read(min(left, CHUNK))
            if not part:
                raise OSError(f"{path}: the server closed the connection")
            left -= len(part)
            self.bytes += len(part)
            if kept:
                parts.append(part)
        data = b"".join(parts)
        return gzip.decompress(data) if kept and "content-encoding: gzip" in head else data


@dataclass
class Crowd:
    """What visitors have met: seconds until a first frame, and until the worker's files were there; bytes; losses."""

    openings: list[float] = field(default_factory=list)
    loads: list[float] = field(default_factory=list)
    bytes: int = 0
    lost: int = 0


async def open_page(port: int, crowd: Crowd) -> Wire:
    """Open a page up to its first frame: its text, its scripts, its websocket."""
    began = time.perf_counter()
    async with Files(port) as files:
        text = (await files.load("", kept=True)).decode()
        for path in dict.fromkeys(SCRIPT.findall(text)):
            await files.load(path)
    wire = await Wire.connect(port)
    crowd.openings.append(time.perf_counter() - began)
    crowd.bytes += files.bytes
    return wire


async def load_engine(port: int, wire: Wire, crowd: Crowd) -> None:
    """Load what a page's worker is made of."""
    folder = wire.begun["config"]["engine"]["script"].rsplit("/", 1)[0]
    began = time.perf_counter()
    async with Files(port) as files:
        sizes = json.loads(await files.load(f"{folder}/folder.json", kept=True))["sizes"]
        for name in sizes:
            await files.load(f"{folder}/{name}")
    crowd.loads.append(time.perf_counter() - began)
    crowd.bytes += files.bytes


async def visit(port: int, crowd: Crowd, gone: asyncio.Event, engine: bool = True) -> None:
    """Open a page, ask for what comes at rest, load the worker, and stay: what moves then, the device draws."""
    try:
        wire = await open_page(port, crowd)
        for number in range(RESTS):
            await asyncio.sleep(REST)
            await wire.send({"id": number, "set": {}, "rest": True})
            await wire.next_frame()
        if engine:
            await asyncio.sleep(QUIET)
            await load_engine(port, wire, crowd)
        await gone.wait()
        await wire.vanish()
    except (OSError, asyncio.IncompleteReadError):
        crowd.lost += 1


async def arrive(port: int, count: int, rate: float, gone: asyncio.Event, engine: bool = True) -> tuple[Crowd, list]:
    """Let so many come at so many a second, each of whom stays; return what they meet, and the visits under way."""
    crowd, visits = Crowd(), []
    for _ in range(count):
        visits.append(asyncio.create_task(visit(port, crowd, gone, engine)))
        await asyncio.sleep(1.0 / rate)
    return crowd, visits
