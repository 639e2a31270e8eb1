"""Who is let in: nobody has all descriptors, and who asks whether the server lives is answered."""

import asyncio
import resource
import socket
from collections import Counter

from codim2_app.server.process import listener
from codim2_app.server.process.listener import RESERVED, Listener
from codim2_app.server.process.ports import Crowds
from tornado.tcpserver import TCPServer

from tests.work import PATIENCE, talk

ONE, OTHER = "127.0.0.1", "127.0.0.2"


class Server(TCPServer):
    """What greets whoever is let in, and keeps the connection."""

    def __init__(self):
        super().__init__()
        self.kept = []

    async def handle_stream(self, stream, address):
        self.kept.append(stream)
        await stream.write(b"welcome")


def play(doing, most, monkeypatch, places=1000):
    """Do something at a socket that lets so many in, half of them from one address."""
    monkeypatch.setattr(listener, "max_files", lambda: RESERVED + most)

    async def play():
        listening = socket.create_server((ONE, 0))
        server = Server()
        server.add_sockets([Listener(listening, Counter(), places, "well", Crowds())])
        (own,) = server._sockets.values()
        try:
            return await doing(own, server)
        finally:
            server.stop()
            for stream in server.kept:
                stream.close()

    return talk(play())


async def come(own, address=ONE):
    """Return the ends of the line of somebody who comes from an address."""
    return await asyncio.open_connection(*own.getsockname(), local_addr=(address, 0))


async def hear(own, address, says=b"GET / HTTP/1.1\r\n\r\n"):
    """Return what somebody hears who says something."""
    reader, writer = await come(own, address)
    writer.write(says)
    heard = await asyncio.wait_for(reader.read(1000), PATIENCE)
    writer.close()
    return heard


async def all_in(server, count):
    while len(server.kept) < count:
        await asyncio.sleep(0.001)


def test_nobody_has_more_than_half_of_the_connections_and_his_place_is_free_again(monkeypatch, caplog):
    async def doing(own, server):
        lines = [await come(own) for _ in range(30)]
        await all_in(server, 4)
        heard = [await hear(own, one) for one in (ONE, OTHER)]
        for stream in server.kept:
            stream.close()
        heard.append(await hear(own, ONE))
        for _, line in lines:
            line.close()
        return heard

    assert play(doing, 8, monkeypatch) == [b"", b"welcome", b"welcome"]
    assert len(caplog.records) == 1
    assert ONE in caplog.text


def test_who_asks_for_health_is_answered_when_all_are_taken(monkeypatch):
    async def doing(own, server):
        lines = [await come(own, address) for address in (ONE, OTHER) for _ in range(60)]
        await all_in(server, 8)
        heard = [
            await hear(own, address, says)
            for address in (ONE, OTHER, "127.0.0.3")
            for says in (b"GET /health HTTP/1.1\r\n\r\n", b"GET /docs/ HTTP/1.1\r\n\r\n")
        ]
        for _, line in lines:
            line.close()
        return heard, len(server.kept)

    heard, there = play(doing, 8, monkeypatch)
    assert there == 8
    assert all(one.startswith(b"HTTP/1.1 200 OK") and one.endswith(b"well") for one in heard[::2])
    assert heard[1::2] == [b""] * 3


def test_a_place_has_eight_connections(monkeypatch):
    async def doing(own, server):
        return own.most_of_one

    assert play(doing, 1000, monkeypatch, places=2) == 16


def test_without_a_descriptor_it_waits_and_says_so_once(monkeypatch, caplog):
    monkeypatch.setattr(listener, "PAUSE_SECONDS", 0.01)
    limit = resource.getrlimit(resource.RLIMIT_NOFILE)
    tried = []

    async def doing(own, server):
        accept = socket.socket.accept

        def fails(self):
            tried.append(1)
            if len(tried) < 4:
                resource.setrlimit(resource.RLIMIT_NOFILE, (3, limit[1]))
            try:
                return accept(self)
            finally:
                resource.setrlimit(resource.RLIMIT_NOFILE, limit)

        monkeypatch.setattr(socket.socket, "accept", fails)
        return await hear(own, ONE)

    assert play(doing, 8, monkeypatch) == b"welcome"
    assert len(tried) == 3 + 1 + 1  # and not again and again meanwhile; the last finds nobody
    assert len(caplog.records) == 1
