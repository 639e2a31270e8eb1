"""The page: one session of the explorer, and the server around it. Composition only."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import panel as pn
from bokeh.server.urls import per_app_patterns
from panel.io.server import WSHandler
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.web import RequestHandler

from . import warmup
from .markup import page_template
from .state import ExplorerState
from .view import ExplorerView

TITLE = "Isolated codimension-2 discontinuity: explorer"


def session() -> ExplorerView:
    """Return one session's explorer; the query of the page's address is its state."""
    doc = pn.state.curdoc
    assert doc is not None  # Bokeh's server calls this with a document
    arguments = pn.state.session_args or {}
    query = {name: values[-1].decode("utf-8", "replace") for name, values in arguments.items() if values}
    state, errors = ExplorerState.from_query(query)
    view = ExplorerView(state, page=True, errors=tuple(errors))
    doc.template = page_template()  # type: ignore[assignment]
    doc.template_variables["explorer_markup"] = view.page_markup
    return view


class PromptSocket(WSHandler):
    """Bokeh's websocket without Nagle's algorithm.

    A frame is several small writes; with it each one waits for the browser's delayed acknowledgement, 40 ms.
    """

    def open(self, *arguments: str, **named: str) -> None:
        """Start the connection."""
        super().open(*arguments, **named)
        self.set_nodelay(True)


@contextmanager
def _prompt_websockets() -> Iterator[None]:
    """Let a server that is made meanwhile use `PromptSocket`; Bokeh has no option for it."""
    kept = list(per_app_patterns)
    per_app_patterns[:] = [("/ws", PromptSocket) if route[0] == "/ws" else route for route in kept]
    try:
        yield
    finally:
        per_app_patterns[:] = kept


class Health(RequestHandler):
    """Answers 200 while the process serves, for container health checks."""

    def get(self) -> None:
        """Say whether the integrator is ready."""
        self.set_header("Cache-Control", "no-store")
        self.write({"status": "ok", "integrator": "ready" if warmup.is_ready() else "compiling"})

    head = get


def make_server(
    port: int = 5006,
    address: str = "localhost",
    allow_origin: Sequence[str] = (),
    processes: int = 1,
    threads: int | None = None,
    **options: Any,
) -> Any:
    """Return a server of the explorer, not yet started (``.start()``, ``.io_loop.start()``).

    Parameters
    ----------
    port : int
        0 takes any free port.
    address : str
        Where to listen; "0.0.0.0" for all interfaces.
    allow_origin : sequence of str
        Host names (with port) whose pages may open the websocket, besides this address.
    processes : int
        Number of server processes that share the port.
    threads : int, optional
        Threads that answer requests in each process; default one.
    """
    warmup_now = processes == 1
    if warmup_now:
        warmup.start()
    pn.config.nthreads = threads  # type: ignore[assignment]  # a property of Panel's, with a setter
    parent = os.getpid()
    with _prompt_websockets():
        server = _server(port, address, allow_origin, processes, options)
    if not warmup_now:
        server.io_loop.add_callback(warmup.start)
    if os.getpid() != parent:
        _stop_with(parent, server.io_loop)
    return server


def _stop_with(parent: int, loop: IOLoop) -> None:
    """Stop this forked process within a second when its parent has ended, so that no orphan keeps the port."""

    def check() -> None:
        if os.getppid() != parent:
            loop.stop()

    loop.add_callback(PeriodicCallback(check, 1000).start)


def _server(port: int, address: str, allow_origin: Sequence[str], processes: int, options: dict[str, Any]) -> Any:
    return pn.io.server.get_server(
        {"/": session},
        port=port,
        address=address,
        websocket_origin=list(allow_origin) or None,
        title={"/": TITLE},
        location=False,
        num_procs=processes,
        extra_patterns=[(r"/health", Health)],
        compress_response=True,
        start=False,
        **options,
    )
