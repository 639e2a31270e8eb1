"""One port for several server processes: each listens by a socket of its own, and the kernel shares visitors out.

By one socket for all, nearly every visitor came to the process that had just been awake, and the others idled.
"""

from __future__ import annotations

import socket
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from bokeh.server import server
from tornado.netutil import bind_sockets
from tornado.process import task_id

#: Puts another socket in the place of one that listens.
ListenerFactory = Callable[[socket.socket], socket.socket]

bokeh_server: Any = server  # it says of no name that it may be replaced
#: Elsewhere such sockets cannot be, or all visitors come to the last of them.
CAN_SHARE_PORT = sys.platform == "linux" and hasattr(socket, "SO_REUSEPORT")


@contextmanager
def share_port(processes: int, listen: ListenerFactory) -> Iterator[None]:
    """Let a server that is made meanwhile listen so, at a port that each of several processes can bind again."""
    shared = processes > 1 and CAN_SHARE_PORT

    def bind(address: str | None, port: int) -> tuple[list[socket.socket], int]:
        sockets = bind_sockets(port or 0, address, reuse_port=shared)
        own = sockets[0].getsockname()[1]
        return [listen(one) for one in sockets], own

    kept, bokeh_server.bind_sockets = bokeh_server.bind_sockets, bind
    try:
        yield
    finally:
        bokeh_server.bind_sockets = kept


def listen_by_own(one: Any, address: str, listen: ListenerFactory) -> None:
    """In each forked process but the first, which keeps the socket that all have inherited: listen by another one.

    The process from which they are forked has that socket too and never answers: without the first it would be waited
    for.
    """
    if not CAN_SHARE_PORT or not task_id():
        return
    http = one._http  # noqa: SLF001 (Bokeh hands out no other way to it)
    http.stop()
    http.add_sockets(listen(each) for each in bind_sockets(one.port, address, reuse_port=True))
