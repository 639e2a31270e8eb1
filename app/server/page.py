"""The page: one session of the explorer, and the server around it. Composition only."""

from __future__ import annotations

import logging
import os
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from functools import partial
from importlib.metadata import version
from typing import Any

import panel as pn
from panel.io.server import DocHandler, WSHandler
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.process import task_id
from tornado.web import RequestHandler

from ..docs.served import Docs, ToDocs
from ..frame.jobs import serve_with
from ..frame.turns import Turns
from ..frame.workers import Workers, processors
from ..phrases import say
from ..rooms.board import Board
from ..rooms.rooms import EVERY, MOST_ROOMS, Rooms
from ..rooms.rooms import serve_with as serve_rooms
from ..view import warmup
from ..view.explorer import ExplorerView
from ..view.markup import address_of_script, edition, page_template
from .first_page import Page, markup_of
from .headers import transform
from .openings import Ahead, query_of_the_page, view_of
from .process import garbage
from .process.clock import keep_steady
from .process.ports import listen_by_own, shared
from .process.standing_back import stand_back
from .scripts import routes
from .sockets import MOST_SENT, PromptSocket, closed, untraced, views

#: What the workers find imported.
PRELOAD = ("codim2_app.server.worker",)

#: Seconds for which a thread that compiles keeps the interpreter from a frame that asks for it, which a frame does
#: after each of its kernels; by default they are 5 ms.
SWITCH = 0.0005

#: Seconds for which a page may begin its session after it was sent, by the machine's clock. After Bokeh's 300, one
#: that slept meanwhile, or where a clock was set, would show a picture that stands still; its token is no secret.
TOKEN_HOLDS = 10 * 365 * 86_400

#: Seconds between looks for sessions whose pages have been closed: what they hold is searched for garbage till then.
FORGOTTEN = 2

TITLE = "Isolated codimension-2 discontinuity: explorer"


def session() -> ExplorerView:
    """Return one session's explorer; the query of the page's address is its state."""
    doc = pn.state.curdoc
    assert doc is not None  # Bokeh's server calls this with a document
    view = view_of(doc)
    spare = doc.config.notifications  # Bokeh makes some as soon as it is given others, and loses them with the session
    # The page says itself when the connection is lost, and loads itself again: see connection.js.
    doc.config.update(reconnect_session=False, notify_connection_status=False, notifications=None)
    garbage.begun(doc)
    doc.on_session_destroyed(lambda _: view.leave())
    doc.on_session_destroyed(lambda _: garbage.ended(doc, spare, views.pop(doc), *closed.pop(doc, ())))
    views[doc] = view
    doc.template = page_template()  # type: ignore[assignment]  # Bokeh takes a template's text as well
    doc.template_variables["explorer_script"] = address_of_script()
    doc.template_variables["refused"] = {"full": say("places taken"), "other": say("no connection")}
    # Bokeh's own handler, which makes a session first, writes it
    doc.template_variables["explorer_markup"] = _Markup(query_of_the_page())
    return view


class _Markup:
    """The markup of an address, made when a template writes it."""

    def __init__(self, query: Mapping[str, str]) -> None:
        self.query = query

    def __str__(self) -> str:
        return markup_of(self.query)


#: Routes of Bokeh and Panel that are answered here.
OURS: dict[type, type] = {WSHandler: PromptSocket, DocHandler: Page}


def take_over(application: Any) -> None:
    """Let a server's websockets be `PromptSocket` and its pages `Page`; what is not found answers as it did."""
    found = set()
    for rule in getattr(getattr(application, "wildcard_router", None), "rules", ()):
        if isinstance(rule.target, type) and rule.target in OURS:
            found.add(rule.target)
            rule.target = OURS[rule.target]
    for theirs in OURS.keys() - found:
        logging.getLogger(__name__).warning("Panel's routes are others than known here: %s answers.", theirs.__name__)


class ToRoom(RequestHandler):
    """Answers ``/room`` with the explorer that opens one."""

    def get(self) -> None:
        """Send the browser there, below whatever prefix a proxy shows."""
        self.redirect("./?room=new")


class Health(RequestHandler):
    """Answers 200 while the process serves: a container that does not is started again."""

    def get(self) -> None:
        """Say that it is there, and which version it is; pages that come back look whether it is still theirs."""
        self.set_header("Cache-Control", "no-store")
        self.write({"status": "ok", "version": version("codim2"), "edition": edition()})

    head = get


class Ready(RequestHandler):
    """Answers 200 once a scene has been computed, 503 before and where it cannot be: a proxy sends visitors then."""

    def get(self) -> None:
        """Say how far it is."""
        self.set_header("Cache-Control", "no-store")
        status = warmup.outcome or "compiling"
        if status != "ready":
            self.set_status(503)
        self.write({"status": status, "compiled": warmup.done})

    head = get


def make_server(
    port: int = 5006,
    address: str = "localhost",
    allow_origin: Sequence[str] = (),
    processes: int = 1,
    workers: int = 0,
    prefix: str = "",
    frame_ancestors: str = "'self'",
    sessions: int = 400,
    rooms: int = MOST_ROOMS,
    told: warmup.Told | None = None,
    executor: Executor | None = None,
    at_once: int = 1,
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
    workers : int
        Number of processes, of each of these, that compute what takes longer than a frame; 0 shares the processors.
    prefix : str
        The path below which a proxy shows this server.
    frame_ancestors : str
        Who may embed the pages besides this server, as Content-Security-Policy says it.
    sessions : int
        Open pages of a process, beyond which a new one is asked to wait.
    rooms : int
        Rooms that lecturers have open at once, of a process; 0 for none.
    told : callable, optional
        Told what has been compiled, see `warmup.warm_all`.
    executor : Executor, optional
        Does the long work in place of `workers`, `at_once` at a time; with one process only, as it cannot be forked.
    """
    sys.setswitchinterval(SWITCH)
    stand_back()
    pn.config.browser_info = False  # a model for each page, which nobody reads
    if executor is None:
        at_once = workers or max(1, processors() // processes)
        executor = Workers(at_once, preload=PRELOAD, first=warmup.wait)
    serve_with(Turns(executor, at_once))
    warmup_now = processes == 1
    begin = partial(warmup.start, partial(_told, told), patience=warmup.PATIENCE)
    if warmup_now:
        begin()
    parent = os.getpid()
    board = Board(processes)
    with shared(processes):
        server = _server(port, address, allow_origin, processes, prefix, options)
    keep_steady(server.io_loop)
    listen_by_own(server, address)
    board.belong(task_id() or 0)
    _keep(Rooms(board, rooms))
    application = server._tornado  # noqa: SLF001 (Bokeh hands out no other way to it)
    for context in application.applications.values():
        context.application.add(Ahead())
    application.add_handlers(".*", routes(server.prefix))
    take_over(application)
    application.transforms.insert(0, transform(frame_ancestors))  # before they are compressed
    application.settings["most_sessions"] = sessions
    application.settings["log_function"] = _log
    logging.getLogger("bokeh.server.protocol_handler").addFilter(untraced)
    if not warmup_now:
        server.io_loop.add_callback(begin)
    server.io_loop.add_callback(garbage.begin)
    server.io_loop.add_callback(PeriodicCallback(garbage.look, 1000 * garbage.EVERY).start)
    if os.getpid() != parent:
        _stop_with(parent, server.io_loop)
    return server


def _told(told: warmup.Told | None, what: str, seconds: float, done: int, of: int) -> None:
    """Tell what has been compiled; once it is all, it is no garbage."""
    if told is not None:
        told(what, seconds, done, of)
    if done == of:
        garbage.keep()


def _keep(rooms: Rooms) -> None:
    """Keep these rooms in this process, and look after them while anybody is there."""

    def look() -> None:
        if not rooms.tick():
            beat.stop()

    def begin() -> None:
        if not beat.is_running():
            beat.start()

    beat = PeriodicCallback(look, 1000 * EVERY)
    rooms.beat_with(begin)
    serve_rooms(rooms)


def _log(handler: RequestHandler) -> None:
    """Log a request that failed; probes that are told to wait have not."""
    status = handler.get_status()
    if status >= 400 and not isinstance(handler, (Health, Ready)):
        level = logging.ERROR if status >= 500 and status != 503 else logging.WARNING
        request = handler.request
        logging.getLogger("codim2.access").log(level, "%d %s %s", status, request.method, request.path[:200])


def _stop_with(parent: int, loop: IOLoop) -> None:
    """Stop this forked process within a second when its parent has ended, so that no orphan keeps the port."""

    def check() -> None:
        if os.getppid() != parent:
            loop.stop()

    loop.add_callback(PeriodicCallback(check, 1000).start)


def _server(
    port: int, address: str, allow_origin: Sequence[str], processes: int, prefix: str, options: dict[str, Any]
) -> Any:
    return pn.io.server.get_server(
        {"/": session},
        port=port,
        address=address,
        websocket_origin=list(allow_origin) or None,
        title={"/": TITLE},
        location=False,
        num_procs=processes,
        extra_patterns=[
            (r"/health", Health),
            (r"/ready", Ready),
            (r"/room", ToRoom),
            (r"/docs", ToDocs),
            (r"/docs/(.*)", Docs),
        ],
        websocket_max_message_size=MOST_SENT,
        prefix=prefix,
        compress_response=True,
        start=False,
        session_token_expiration=TOKEN_HOLDS,
        **{"check_unused_sessions_milliseconds": 1000 * FORGOTTEN, **options},
    )
