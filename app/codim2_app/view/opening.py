"""The beginning of a page: the link of its address, what its script must know, and its first frame."""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from typing import Any

from ..picture.phrases import say
from ..picture.state.cleaning import InputError
from ..picture.state.controls import ExplorerState
from ..picture.state.links import Link, read_link
from .markup import offered_text, settings
from .refresh import Frames


def link_of(query: Mapping[str, str]) -> Link:
    """Return what an address asks for, whatever that is."""
    try:
        return read_link(query)
    except Exception:  # a visitor sees the explorer and a sentence; the log has the rest
        logging.getLogger(__name__).exception("an address could not be opened")
        return Link(ExplorerState(), (InputError("", say("address failed")),))


def opening_messages(
    frames: Frames, link: Link, edition: str, worker: bool = False, engine: Mapping[str, Any] | None = None
) -> tuple[str, bytes]:
    """Return what the script of a page must know, as JSON, and the page's first frame.

    Parameters
    ----------
    frames : Frames
        What the page shows.
    link : Link
        Its address.
    edition : str
        Of the page that this belongs to.
    worker : bool
        Whether a worker of the page answers, and there is no server with rooms and codes for phones.
    engine : mapping, optional
        Of a page whose server has a worker for it too: where its script is, and which panels are the server's alone.
    """
    first = frames.answer({"all": True})
    frames.publish()  # what cannot be drawn is not in the state
    config = {
        **settings(link.state, frames.locked, link.look), "page": True, "refused": frames.refused, "dark": False,
        "edition": edition, "worker": worker, "engine": engine,
    }  # fmt: skip
    if worker:
        config["film"] = False  # as in the worker, wherever the page was written
    return f'{{"config":{json.dumps(config)},"offered":{offered_text()}}}', first
