"""One listening socket for several server processes, among which visitors are shared evenly.

The process that has the fewest pages accepts the next connection. Otherwise nearly all would come to the one that had
just been awake, or, with a socket for each process, as many as chance gives it.
"""

from __future__ import annotations

import mmap
import socket

from tornado.netutil import bind_sockets
from tornado.process import fork_processes

#: Processes that ended and were started again in the life of a server; beyond that it ends, and its host starts it.
MAX_RESTARTS = 10_000


class Crowds:
    """The number of pages and of connections of each process, in memory that all of them see.

    Parameters
    ----------
    processes : int
        That are forked after this has been made.
    """

    def __init__(self, processes: int = 1) -> None:
        self.processes = processes
        self._counts = memoryview(mmap.mmap(-1, 16 * processes)).cast("q")
        self._mine = 0

    def belong(self, number: int) -> None:
        """Say which of the processes this is; what another of this number has left is forgotten."""
        self._mine = number
        self.count_pages(0)
        self.count_connections(0)

    def count_pages(self, pages: int) -> None:
        """Note the pages that this process has."""
        self._counts[2 * self._mine] = pages

    def count_connections(self, connections: int) -> None:
        """Note the connections that this process has: between as many pages, they decide."""
        self._counts[2 * self._mine + 1] = connections

    def is_smallest(self) -> bool:
        """Whether no process has fewer pages than this one."""
        counts = self._counts.tolist()
        crowds = list(zip(counts[::2], counts[1::2], strict=True))
        return crowds[self._mine] == min(crowds)


def bind(port: int, address: str) -> tuple[list[socket.socket], int]:
    """Return sockets at an address, and their port."""
    sockets = bind_sockets(port, address)
    return sockets, sockets[0].getsockname()[1]


def fork(processes: int) -> int:
    """Fork a server into processes, which inherit its sockets; return the number of each."""
    return 0 if processes == 1 else fork_processes(processes, MAX_RESTARTS)
