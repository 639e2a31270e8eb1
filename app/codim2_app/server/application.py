"""The Tornado application of the explorer: its own rules and no others, under the names that the server knows."""

from __future__ import annotations

import logging
import re
import sys
from collections.abc import Sequence
from html import escape
from ipaddress import IPv4Address, ip_address, ip_network
from typing import Any

from bokeh.server.util import check_allowlist
from tornado.httputil import HTTPServerRequest
from tornado.ioloop import IOLoop
from tornado.web import Application, GZipContentEncoding, OutputTransform, RequestHandler

#: A rule as Tornado reads it: a pattern, a handler, and what it is initialised with.
Rule = tuple[Any, ...]
#: What a server is reached by from its own machine.
LOOPBACK = ("localhost", "127.0.0.1", "[::1]")
_PORT = re.compile(r":\d+$")
#: Answered under any name: probes of a host know none, and nothing of a visitor is in the answer.
PROBES = ("/health", "/ready")
UNKNOWN_NAME = (
    '<!DOCTYPE html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
    '<meta name="color-scheme" content="light dark"><title>Unknown name</title>'
    '<p role="alert" style="font:18px/1.5 sans-serif;max-width:26em;margin:20vh auto;padding:0 1em">'
    "This server does not expect to be reached as <b>{0}</b>. Start it with <code>--allow-origin {0}</code> or "
    "<code>CODIM2_ORIGINS={0}</code>.</p></html>"
)


def known_names(allowed: Sequence[str], port: int) -> list[str]:
    """Return the hosts under which a server is reached: those that it is given, and those of its own machine."""
    listed = [name if name == "*" or _PORT.search(name) else f"{name}:80" for name in map(str.lower, allowed)]
    return [*listed, *(f"{name}:{port}" for name in LOOPBACK)]


def is_known(origin: str, names: Sequence[str]) -> bool:
    """Whether the host of an origin is among the names of a server."""
    scheme, _, host = origin.lower().partition("://")
    port = "" if _PORT.search(host) else ":443" if scheme == "https" else ":80"
    return check_allowlist(host + port, names) or check_allowlist(host, names)


def visitor_of(request: HTTPServerRequest) -> str:
    """Return the network address of a visitor: of IPv6 the network, which one visitor has all of."""
    try:
        address = ip_address((request.remote_ip or "").partition("%")[0])
    except ValueError:  # of a socket that has none
        return ""
    if isinstance(address, IPv4Address):
        return str(address)
    return str(address.ipv4_mapped or ip_network((int(address), 64), strict=False))


class Misdirected(RequestHandler):
    """Answers 421 under a name that is not known: a page there could be another site's, by its own DNS."""

    def prepare(self) -> None:
        """Say what to set."""
        self.set_status(421)
        self.finish(UNKNOWN_NAME.format(escape(self.request.host[:200])))


class _Guarded(RequestHandler):
    """A handler in which nothing ends the process."""

    async def _execute(self, transforms: list[OutputTransform], *args: bytes, **kwargs: bytes) -> None:
        try:
            await super()._execute(transforms, *args, **kwargs)
        except (SystemExit, KeyboardInterrupt):
            self.log_exception(*sys.exc_info())
            self.send_error(500)


def _guard(pattern: Any, handler: type[RequestHandler], *more: Any) -> Rule:
    return pattern, type(handler.__name__, (_Guarded, handler), {}), *more


class ExplorerApplication(Application):
    """The rules of a server.

    Parameters
    ----------
    rules : sequence of tuple
        As Tornado reads them, below the prefix.
    prefix : str
    names : sequence of str
        Hosts, with their ports.
    headers : type
        What is applied to every answer, before it is compressed.
    **settings
        Tornado's.
    """

    def __init__(
        self, rules: Sequence[Rule], prefix: str, names: Sequence[str], headers: type[OutputTransform], **settings: Any
    ) -> None:
        self.prefix, self.names = prefix, names
        self.listed = [name for name in names if "*" not in name]
        below = [_guard(re.escape(prefix) + pattern, *more) for pattern, *more in rules]
        super().__init__(below, transforms=[headers, GZipContentEncoding], **settings)

    def find_handler(self, request: HTTPServerRequest, **kwargs: Any) -> Any:
        """Return what answers a request: nobody under a name that is not known."""
        if not self.knows(request) and request.path.removeprefix(self.prefix) not in PROBES:
            return self.get_handler_delegate(request, Misdirected)
        return super().find_handler(request, **kwargs)

    def knows(self, request: HTTPServerRequest) -> bool:
        """Whether a request names this server as it is known."""
        return is_known(f"{request.protocol}://{request.host}", self.names)


def run(loop: IOLoop) -> None:
    """Run a loop until it is stopped; an exit that some callback asks for does not end it."""
    while True:
        try:
            loop.start()
        except (SystemExit, KeyboardInterrupt):
            logging.getLogger(__name__).exception("a callback asked the server to exit; it goes on")
        else:
            return
