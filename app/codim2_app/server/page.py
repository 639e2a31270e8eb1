"""The server around the page. Composition only."""

from __future__ import annotations

import gc
import json
import logging
import os
import sys
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from importlib.metadata import version
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.httputil import HTTPHeaders
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.web import HTTPError, OutputTransform, RequestHandler

from ..lessons.library import lessons
from ..lessons.rooms.board import Board
from ..lessons.rooms.rooms import MOST_ROOMS, SHARING_SECONDS, Rooms
from ..lessons.rooms.rooms import serve_with as serve_rooms
from ..picture.frame.background_results import serve_with
from ..picture.frame.work_queue import WorkQueue
from ..picture.frame.workers import Workers, processors
from ..site.docs.docs_handlers import MAKER, Docs, ToDocs
from ..view import warmup
from ..view.compiling.steps import Report
from ..view.first_markup import policy
from ..view.lecture_page import SHEETS, lecture_html
from ..view.markup import edition
from .application import ExplorerApplication, known_names
from .engine_files import EngineFiles, served_panels
from .first_page import Page
from .kernel_cache import begin_early
from .live import MOST_OF_ONE, MOST_SENT, LiveConnection, LivePages
from .metrics import Metrics, MetricsPage
from .process.clock import keep_steady
from .process.compile_throttle import stand_back
from .process.listener import Listener
from .process.ports import Crowds, bind, fork
from .scripts import ROUTES


# Security headers of every answer: which hosts a page may ask, who may embed it, and nothing about the server.
#
# A page runs two kinds of script: files of this server, and its own inline scripts, allowed one by one by their hashes.
# Styles are inline: BokehJS writes a style sheet into each shadow root. Nothing is evaluated from text, and nobody else
# gets a request.
def embedders(sources: str) -> str:
    """Return who may embed the pages: some sources, and always the server itself.

    The second portrait is a frame of the same page, and opens it to nobody else.
    """
    others = [source for source in sources.split() if source.lower() not in ("'none'", "'self'")]
    return " ".join(["'self'", *others])


def transform(sources: str) -> type[OutputTransform]:
    """Return what Tornado applies to every answer, before it is compressed."""
    ancestors = embedders(sources)

    class Headers(OutputTransform):
        """Adds the headers."""

        def transform_first_chunk(
            self,
            status_code: int,
            headers: HTTPHeaders,
            chunk: bytes,
            finishing: bool,  # noqa: ARG002 (Tornado gives it)
        ) -> tuple[int, HTTPHeaders, bytes]:
            if "Server" in headers:
                del headers["Server"]
            headers["X-Content-Type-Options"] = "nosniff"
            headers["Referrer-Policy"] = "no-referrer"
            if "Content-Security-Policy" not in headers:
                page = headers.get("Content-Type", "").startswith("text/html")
                headers["Content-Security-Policy"] = policy(chunk if page else b"", ancestors)
            return status_code, headers, chunk

    return Headers


#: What the workers find imported.
PRELOAD = ("codim2_app.server.worker",)

#: Seconds for which a thread that compiles keeps the interpreter from a frame that asks for it, which a frame does
#: after each of its kernels; by default they are 5 ms.
SWITCH = 0.0005

#: Seconds for which a connection may say nothing before its next request, or go on with one; no websocket.
HEADERS = 20.0
#: Seconds by which the loop of a process is late that is not well.
LATE_SECONDS = 5.0
#: Bytes of a request's lines, of which a link is the longest.
MAX_HEADER_BYTES = 20_000
#: Seconds between two signs of life to each page: proxies close a line on which nothing is said for a minute.
BEAT = 37.0


@dataclass
class Server:
    """A server of the explorer: it listens, and answers once its loop runs."""

    application: ExplorerApplication
    http: HTTPServer
    io_loop: IOLoop
    port: int

    @property
    def prefix(self) -> str:
        """The path below which it answers."""
        return self.application.prefix


class ToRoom(RequestHandler):
    """Answers ``/room`` with the explorer that opens one."""

    def get(self) -> None:
        """Send the browser there, below whatever prefix a proxy shows."""
        self.redirect("./?room=new")


class LecturePage(RequestHandler):
    """Answers ``/lecture?of=KEY``, and with ``&sheet=questions`` or ``&sheet=key`` what is printed for the class."""

    async def get(self) -> None:
        """Send the page, which is made off the loop: a worksheet poses and draws all questions."""
        lesson, sheet = lessons().get(self.get_query_argument("of", "")), self.get_query_argument("sheet", "")
        if lesson is None or not lesson.views or sheet not in SHEETS:
            raise HTTPError(404)
        application: Any = self.application
        here = f"{self.request.protocol}://{self.request.host}{application.prefix}/"
        self.finish(await IOLoop.current().run_in_executor(MAKER, lecture_html, lesson, sheet, here))


def health() -> dict[str, Any]:
    """Return what the process says of itself."""
    return {"status": "ok", "version": version("codim2"), "edition": edition()}


class Health(RequestHandler):
    """Answers 200 while the process serves: a container that does not is started again."""

    def initialize(self, metrics: Metrics) -> None:
        """Take what `make_server` gives."""
        self.metrics = metrics

    def get(self) -> None:
        """Say that it is there, and which version it is; pages that come back look whether it is still theirs.

        Each of these is given a time to wait, so that many do not wait for each other. 503: the loop is late.
        """
        self.set_header("Cache-Control", "no-store")
        said = health()
        if self.metrics.lag.worst >= LATE_SECONDS:
            self.set_status(503)
            said["status"] = "late"
        elif self.get_query_argument("back", "") == "1":
            said["wait"] = self.metrics.places.turn_of_return()
        self.write(said)

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
    per_address: int = MOST_OF_ONE,
    proxied: bool = False,
    rooms: int = MOST_ROOMS,
    report: Report | None = None,
    engine: EngineFiles | None = None,
    executor: Executor | None = None,
    at_once: int = 1,
) -> Server:
    """Return a server of the explorer, which answers when its loop runs (``.io_loop.start()``).

    Parameters
    ----------
    port : int
        0 takes any free port.
    address : str
        Where to listen; "0.0.0.0" for all interfaces.
    allow_origin : sequence of str
        Host names (with port) whose pages may open the websocket, in addition to this address.
    processes : int
        Number of server processes that share the port.
    workers : int
        Number of processes, of each of these, that compute what takes longer than a frame; 0 shares the processors.
    prefix : str
        The path below which a proxy shows this server.
    frame_ancestors : str
        Who may embed the pages in addition to this server, as Content-Security-Policy says it.
    sessions : int
        Open pages of a process, beyond which a new one is asked to wait.
    per_address : int
        Open pages of one network address, of a process.
    proxied : bool
        Whether a proxy in front says in X-Real-IP whose a request is; nobody else may reach the server then.
    rooms : int
        Rooms that lecturers have open at once, of a process; 0 for none.
    report : callable, optional
        Called with what has been compiled, see `steps.warm_all`.
    engine : EngineFiles, optional
        With which pages compute on their visitors' devices.
    executor : Executor, optional
        Does the long work in place of `workers`, `at_once` at a time; with one process only, as it cannot be forked.
    """
    sys.setswitchinterval(SWITCH)
    stand_back()
    if executor is None:
        at_once = workers or max(1, processors() // processes)
        executor = Workers(at_once, preload=PRELOAD, is_ready=warmup.wait, begin=begin_early)
    turns = WorkQueue(executor, at_once)
    serve_with(turns)
    warmup_now = processes == 1
    begin = partial(warmup.start, partial(_report_warm_up, report), patience=warmup.POLL_SECONDS)
    if warmup_now:
        begin()
    parent = os.getpid()
    board = Board(processes)
    crowds = Crowds(processes)
    config = engine and {"script": engine.script, "served": served_panels()}
    places = LivePages(sessions, config, per_address, crowds.count_pages)
    listen = partial(Listener, counts=Counter(), places=sessions, health=json.dumps(health()), crowds=crowds)
    sockets, port = bind(port, address)
    number = fork(processes)
    board.belong(number)
    crowds.belong(number)
    kept = Rooms(board, rooms)
    _keep(kept)
    metrics = Metrics(places, turns, kept)
    application = ExplorerApplication(
        [
            (r"/?", Page, {"places": places, "ancestors": embedders(frame_ancestors)}),
            (r"/live", LiveConnection, {"places": places}),
            (r"/health", Health, {"metrics": metrics}),
            (r"/ready", Ready),
            (r"/metrics", MetricsPage, {"metrics": metrics}),
            (r"/room", ToRoom),
            (r"/lecture", LecturePage),
            (r"/docs", ToDocs),
            (r"/docs/(.*)", Docs),
            *ROUTES,
            *([engine.route()] if engine else []),
        ],
        f"/{prefix.strip('/')}".rstrip("/"),
        known_names(allow_origin, port),
        transform(frame_ancestors),
        websocket_max_message_size=MOST_SENT,
        websocket_ping_interval=BEAT,  # a page that has not answered at the next beat has gone
        websocket_ping_timeout=BEAT,
        log_function=_log_request,
    )
    loop = IOLoop.current()
    keep_steady(loop)
    http = HTTPServer(
        application,
        idle_connection_timeout=HEADERS,
        body_timeout=HEADERS,
        max_header_size=MAX_HEADER_BYTES,
        max_body_size=0,  # nobody sends any
        max_buffer_size=4 * MOST_SENT,
        xheaders=proxied,
    )
    http.add_sockets(map(listen, sockets))
    loop.add_callback(metrics.lag.begin)
    server = Server(application, http, loop, port)
    if not warmup_now:
        loop.add_callback(begin)
    if os.getpid() != parent:
        _stop_with(parent, loop)
    return server


def _report_warm_up(report: Report | None, what: str, seconds: float, done: int, of: int) -> None:
    """Tell what has been compiled; once it is all, it is no garbage: no search stops a visitor for it."""
    if report is not None:
        report(what, seconds, done, of)
    if done == of:
        gc.freeze()


def _keep(rooms: Rooms) -> None:
    """Keep these rooms in this process, and look after them while anybody is there."""

    def look() -> None:
        if not rooms.tick():
            beat.stop()

    def begin() -> None:
        if not beat.is_running():
            beat.start()

    beat = PeriodicCallback(look, 1000 * SHARING_SECONDS)
    rooms.beat_with(begin)
    serve_rooms(rooms)


def _log_request(handler: RequestHandler) -> None:
    """Log a request that failed; probes that have to wait have not."""
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
