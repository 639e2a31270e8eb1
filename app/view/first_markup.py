"""A page before any script runs: its markup, and which scripts may run."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any

from ..docs.docs_folder import site
from ..draw.packing import unpack
from ..frame.background_results import Jobs
from ..frame.budget import Budget
from ..state.links import Link
from .markup import markup_of_frame
from .refresh import Frames
from .warmup import is_ready_for_all

#: What a page is called, and where its markup is put.
TITLE = "Isolated codimension-2 discontinuity: explorer"
MARKUP = "<!-- codim2 markup -->"

_INLINE = re.compile(rb"<script(?![^>]*\bsrc=)(?![^>]*application/json)[^>]*>(.*?)</script>", re.DOTALL)

POLICY = (
    "default-src 'self'; script-src 'self'{hashes}; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; "
    "font-src 'self' data:; connect-src 'self'; worker-src 'self'; object-src 'none'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors {ancestors}"
)


def policy(page: bytes, ancestors: str = "'self'") -> str:
    """Return the Content-Security-Policy of a page: its own inline scripts, by their hashes."""
    digests = (base64.b64encode(hashlib.sha256(script).digest()).decode() for script in _INLINE.findall(page))
    return POLICY.format(hashes="".join(f" 'sha256-{digest}'" for digest in digests), ancestors=ancestors)


def page_markup(link: Link) -> tuple[str, bool]:
    """Return the markup of the page of an address, with its first picture, and whether all of the picture is in it."""
    frames = Frames(link.state, None, is_ready_for_all, link.errors, Budget())
    frames.jobs = Jobs(NoBackground())
    first = frames.answer({"all": True})
    frames.publish()
    header, _ = unpack(first)
    complete = bool(header.get("ready")) and "picture" not in header.get("late", ())
    return markup_of_frame(link, first, site() is not None), complete


class NoBackground(Executor):
    """Computes nothing: what takes long is no part of a page."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:  # noqa: ARG002
        """Return a future that is never done."""
        return Future()
