"""Listening sockets that let nobody take all descriptors, and keep some for who asks whether the server lives.

Each connection is a descriptor. Who has too many of them, and all who come when nearly all are taken, are let go; but
for a moment each may ask for ``/health``, which is answered here.
"""

from __future__ import annotations

import errno
import logging
import re
import socket
import time
from collections import Counter
from contextlib import suppress
from typing import Any

from tornado.ioloop import IOLoop

from .files import max_files
from .ports import Crowds

#: Descriptors that are no visitor's: files, workers, and those that wait to be let go.
RESERVED, MAX_PENDING = 64, 16
#: Connections of one address for each place: a browser opens six for a page, and one is its line.
MAX_PER_PLACE = 8
#: Seconds for which nobody is accepted when the system has no descriptor left, and between two lines about it.
PAUSE_SECONDS, REPORT_SECONDS = 1.0, 60.0
#: Seconds for which a process leaves the next connection to one that has fewer pages, and how often in a row.
SHARING_SECONDS, MAX_LEFT = 0.005, 20
#: Seconds for which one who is let go may say what he wants.
PENDING_SECONDS = 5.0
HEALTH = re.compile(rb"(GET|HEAD) \S*/health[ ?]")
ANSWER = "HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{}"

_log = logging.getLogger(__name__)


class CountedConnection(socket.socket):
    """A connection that is counted until it is closed."""

    def __init__(self, connection: socket.socket, address: str, counts: Counter[str]) -> None:
        super().__init__(fileno=connection.detach())
        self._address, self._counts = address, counts
        counts[address] += 1

    def close(self) -> None:
        """Close it; counted once."""
        if self.fileno() >= 0:
            self._counts[self._address] -= 1
            if not self._counts[self._address]:
                del self._counts[self._address]
        super().close()


class Listener(socket.socket):
    """A listening socket with bounds.

    Parameters
    ----------
    listening : socket
        In place of which this is.
    counts : Counter of str
        How many connections each address has, by all listeners of this process.
    places : int
        Pages that the process lets in.
    health : str
        What ``/health`` says.
    crowds : Crowds
        Of this process and of others that accept at the same socket.
    """

    def __init__(
        self, listening: socket.socket, counts: Counter[str], places: int, health: str, crowds: Crowds
    ) -> None:
        super().__init__(fileno=listening.detach())
        self.setblocking(False)
        self.most = max(1, max_files() - RESERVED)
        self.most_of_one = max(1, min(self.most // 2, MAX_PER_PLACE * places))
        self._health = ANSWER.format(len(health.encode()), health).encode()
        self._counts, self._crowds = counts, crowds
        self._left = 0  # how often in a row the next connection was left to another process
        self._has_accepted = False  # in this turn of the loop
        self._pending: dict[socket.socket, None] = {}  # in the order in which they came
        self._last_report = -REPORT_SECONDS

    def accept(self) -> tuple[socket.socket, Any]:
        """Return the next connection that may be let in; BlockingIOError if there is none now."""
        if self._crowds.processes > 1:
            self._leave_to_others()
        try:
            found, address = super().accept()
        except OSError as error:
            self._has_accepted = False
            if error.errno in (errno.EMFILE, errno.ENFILE):
                self._tell("no descriptor is left; nobody is accepted for %g s", PAUSE_SECONDS)
                self._pause(PAUSE_SECONDS)
                raise BlockingIOError from error
            raise
        if self._counts.total() < self.most and self._counts[address[0]] < self.most_of_one:
            return CountedConnection(found, address[0], self._counts), address
        self._tell("connections of %s are let go: it has %d", address[0], self._counts[address[0]])
        self._keep_waiting(found)
        raise BlockingIOError

    def _leave_to_others(self) -> None:
        """Raise BlockingIOError where another process is to accept; one connection a turn, so that all are counted."""
        self._has_accepted = not self._has_accepted
        if not self._has_accepted:
            raise BlockingIOError
        self._crowds.count_connections(self._counts.total())
        if not self._crowds.is_smallest() and self._left < MAX_LEFT:
            self._left, self._has_accepted = self._left + 1, False
            self._pause(SHARING_SECONDS)
            raise BlockingIOError
        self._left = 0

    def _pause(self, seconds: float) -> None:
        loop = IOLoop.current()
        loop.update_handler(self, 0)
        loop.call_later(seconds, lambda: self.fileno() >= 0 and loop.update_handler(self, IOLoop.READ))

    def _tell(self, words: str, *of: Any) -> None:
        if (now := time.monotonic()) - self._last_report >= REPORT_SECONDS:
            self._last_report = now
            _log.warning(words, *of)

    def _keep_waiting(self, found: socket.socket) -> None:
        """Wait until somebody says what he wants, for a while and as long as few come after him."""
        self._pending[found] = None
        loop = IOLoop.current()
        loop.add_handler(found, self._hear, IOLoop.READ)
        loop.call_later(PENDING_SECONDS, self._let_go, found)
        if len(self._pending) > MAX_PENDING:
            self._let_go(next(iter(self._pending)))

    def _hear(self, found: Any, _: int) -> None:
        with suppress(OSError):
            found.setblocking(False)
            if HEALTH.match(found.recv(1000)):
                found.send(self._health)
        self._let_go(found)

    def _let_go(self, found: socket.socket) -> None:
        if found in self._pending:
            del self._pending[found]
            IOLoop.current().remove_handler(found)
            found.close()
