"""The page as text, made once for all who open one address: the session begins with the websocket.

All that is a visitor's own in it is a token, which names the session to come. Where Panel's page is not what is
expected here, its own handler answers, which makes a session for each page.
"""

from __future__ import annotations

import json
import logging
import re
from collections import OrderedDict
from collections.abc import Mapping
from html import escape
from typing import Any

from bokeh.server.util import check_allowlist
from bokeh.util.token import generate_jwt_token, generate_session_id
from panel.io.resources import Resources
from panel.io.server import DocHandler, server_html_page_for_session
from panel.io.state import set_curdoc

from ..phrases import say
from ..state.cleaning import InputError
from ..state.controls import ExplorerState
from ..state.links import Link, read_link
from ..view import warmup
from ..view.first_markup import page_markup
from .giving_way import one_by_one
from .process.garbage import asked
from .scripts import PREVIEW
from .sockets import full

TOKEN, MARKUP = "codim2-token", "<!-- codim2 markup -->"
#: A script of Bokeh's that draws with WebGL, which the picture does not.
UNUSED = re.compile(r'<script[^>]* src="[^"]*/bokeh-gl\.min\.js[^"]*"></script>')
#: Where a page gets its session from, written by Bokeh.
ITEMS = re.compile(r"const render_items = (\[.*?\]);")
REMEMBERED = 64  # addresses
BUSY = (
    '<!DOCTYPE html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
    '<meta http-equiv="refresh" content="{0}"><meta name="color-scheme" content="light dark"><title>Busy</title>'
    '<p role="status" style="font:18px/1.5 sans-serif;max-width:26em;margin:20vh auto;padding:0 1em">All places '
    "are taken just now. This page tries again every {0} seconds, and opens as its address says as soon as one is free."
    "</p></html>"
)
RETRY = 20  # seconds

_pages: OrderedDict[tuple[tuple[str, str], ...], str] = OrderedDict()
_skeletons: dict[str, str | None] = {}


def opening(query: Mapping[str, str]) -> Link:
    """Return what an address asks for, whatever that is."""
    try:
        return read_link(query)
    except Exception:  # a visitor sees the explorer and a sentence; the log has the rest
        logging.getLogger(__name__).exception("an address could not be opened")
        return Link(ExplorerState(), (InputError("", say("address failed")),))


def markup_of(query: Mapping[str, str]) -> str:
    """Return the explorer's markup for an address, with its first picture; the same address is drawn once."""
    kept = remembered(query)
    if kept is not None:
        return kept
    key = tuple(sorted(query.items()))
    markup, complete = page_markup(opening(query))
    if complete:
        _pages[key] = markup
        if len(_pages) > REMEMBERED:
            _pages.popitem(last=False)
    return markup


def remembered(query: Mapping[str, str]) -> str | None:
    """Return the markup for an address that has been drawn, or None."""
    key = tuple(sorted(query.items()))
    if key not in _pages:
        return None
    _pages.move_to_end(key)
    return _pages[key]


def skeleton_of(html: str) -> str | None:
    """Return a page of Bokeh's as one for any session: its token is `TOKEN`, and it names no models; None if it cannot.

    What the session shows is then put into the one element of the page.
    """
    found = ITEMS.findall(html)
    if len(found) != 1 or html.count(MARKUP) != 1:
        return None
    items = json.loads(found[0])
    if len(items) != 1 or items[0].get("token") != TOKEN:
        return None
    html = UNUSED.sub("", html)
    item = {**items[0], "roots": {}, "root_ids": [], "elementid": "codim2-root"}
    html = html.replace(found[0], json.dumps([item], separators=(",", ":")))
    for element in items[0].get("roots", {}).values():
        html, count = re.subn(rf'<div id="{re.escape(element)}"[^>]*></div>', "", html)
        if count != 1:
            return None
    return html


class Page(DocHandler):
    """Answers with the page as text."""

    async def get(self, *args: Any, **kwargs: Any) -> None:
        """Answer; a session is made only where Bokeh is asked for one by name."""
        asked()
        app: Any = self.application
        own = {"bokeh-token", "bokeh-session-id"} & self.request.arguments.keys()
        if own or "Bokeh-Session-Id" in self.request.headers or self.request.path == app.prefix != "":
            await super().get(*args, **kwargs)  # type: ignore[misc]  # a coroutine, under a decorator
            return
        if full(app, self.application_context):
            self.set_status(503)
            self.set_header("Retry-After", str(RETRY))
            self.finish(BUSY.format(RETRY))
            return
        skeleton = await self._skeleton()
        if skeleton is None:
            await super().get(*args, **kwargs)  # type: ignore[misc]  # a coroutine, under a decorator
            return
        payload: Any = self._generate_token_payload()
        token = generate_jwt_token(
            generate_session_id(secret_key=app.secret_key, signed=app.sign_sessions),
            secret_key=app.secret_key,
            signed=app.sign_sessions,
            expiration=app.session_token_expiration,
            extra_payload=payload,
        )
        query = {name: values[-1].decode("utf-8", "replace") for name, values in self.request.arguments.items()}
        self.set_header("Cache-Control", "no-store")
        self.set_header("Content-Type", "text/html")
        here = f"{self.request.protocol}://{escape(self.request.host)}{app.prefix}"
        skeleton = skeleton.replace(f'content="{PREVIEW}"', f'content="{here}/{PREVIEW}"')  # it is asked for whole
        before, after = skeleton.replace(TOKEN, token).split(MARKUP)
        markup = remembered(query)
        if markup is None:
            async with one_by_one(app):
                markup = markup_of(query)
        self.finish(before + self._notice() + markup + after)

    async def prepare(self) -> None:
        """Let what can wait stand back for the first page."""
        warmup.page_asked()
        await super().prepare()

    def on_finish(self) -> None:
        """Let go on what stands back for the first page."""
        warmup.page_sent()
        super().on_finish()

    async def head(self, *args: Any, **kwargs: Any) -> None:
        """Answer a probe as `get` does, without the page."""
        await self.get(*args, **kwargs)

    async def _skeleton(self) -> str | None:
        """Return the page without what is a visitor's own; the first one is made with a session."""
        app: Any = self.application
        if app.prefix not in _skeletons:
            try:
                session: Any = await self.get_session()  # type: ignore[misc]  # a coroutine, under a decorator
                with set_curdoc(session.document):
                    html = server_html_page_for_session(
                        session, Resources.from_bokeh(app.resources()), session.document.title, TOKEN,
                        session.document.template, {**session.document.template_variables, "explorer_markup": MARKUP},
                    )  # fmt: skip
                _skeletons[app.prefix] = skeleton_of(html)
            except (TypeError, AttributeError, ValueError):
                logging.getLogger(__name__).warning("Panel's pages are others than known here: each makes a session.")
                _skeletons[app.prefix] = None
        return _skeletons[app.prefix]

    def _notice(self) -> str:
        """Say what to set where the browser's websocket will be refused: under a name that is not allowed."""
        host = self.request.host.lower()
        port = "" if ":" in host else ":443" if self.request.protocol == "https" else ":80"
        app: Any = self.application
        if check_allowlist(host + port, app.websocket_origins) or check_allowlist(host, app.websocket_origins):
            return ""
        return (
            '<p role="alert" style="font:16px sans-serif;margin:0;padding:.8em;background:#fff6e0;color:#1c2430">'
            f"This server does not expect to be reached as <b>{escape(host)}</b>, so the picture below cannot move. "
            f"Start it with <code>--allow-origin {escape(host)}</code> or <code>CODIM2_ORIGINS={escape(host)}</code>."
            "</p>"
        )
