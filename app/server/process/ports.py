"""One port for several server processes: each listens by a socket of its own, and the kernel shares visitors out.

By one socket for all, nearly every visitor came to the process that had just been awake, and the others idled.
"""

from __future__ import annotations

import socket
import sys

from tornado.netutil import bind_sockets
from tornado.process import fork_processes

#: Elsewhere such sockets cannot be, or all visitors come to the last of them.
CAN_SHARE_PORT = sys.platform == "linux" and hasattr(socket, "SO_REUSEPORT")
#: Processes that ended and were started again in the life of a server; beyond that it ends, and its host starts it.
MAX_RESTARTS = 10_000


def bind(port: int, address: str, processes: int) -> tuple[list[socket.socket], int]:
    """Return sockets at an address, and their port; each of several processes can bind it again."""
    sockets = bind_sockets(port, address, reuse_port=processes > 1 and CAN_SHARE_PORT)
    return sockets, sockets[0].getsockname()[1]


def fork(sockets: list[socket.socket], address: str, processes: int) -> tuple[list[socket.socket], int]:
    """Fork a server into processes; in each of them return the sockets by which it listens, and its number.

    The first keeps the sockets that all have inherited. The process from which they are forked has them too and never
    answers: without the first it would be waited for.
    """
    if processes == 1:
        return sockets, 0
    number = fork_processes(processes, MAX_RESTARTS)
    if number and CAN_SHARE_PORT:
        return bind_sockets(sockets[0].getsockname()[1], address, reuse_port=True), number
    return sockets, number
