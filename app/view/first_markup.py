"""Markup of a page before any script runs."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any

from ..docs.docs_folder import site
from ..draw.packing import unpack
from ..draw.svg import draw
from ..frame.budget import Budget
from ..frame.jobs import Jobs
from ..state.links import Link
from .markup import explorer_html
from .refresh import Frames
from .warmup import is_ready_for_all


def page_markup(link: Link) -> tuple[str, bool]:
    """Return the markup of the page of an address, with its first picture, and whether all of the picture is in it."""
    frames = Frames(link.state, None, is_ready_for_all, link.errors, Budget())
    frames.jobs = Jobs(NoBackground())
    first = frames.answer({"all": True})
    frames.publish()
    header, _ = unpack(first)
    complete = bool(header.get("ready")) and "picture" not in header.get("late", ())
    words = first_words(header, first, link.state.layers)
    return explorer_html(link.state, words, (), link.look, docs=site() is not None), complete


class NoBackground(Executor):
    """Computes nothing: what takes long is no part of a page."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:  # noqa: ARG002
        """Return a future that is never done."""
        return Future()


def first_words(header: dict[str, Any], first: bytes, layers: list[str]) -> dict[str, str]:
    """Return what the page says and shows before any script runs."""
    portrait = header.get("portrait")
    if portrait is None:
        return {}
    sentence = portrait["sentence"].split(". ", 1)[-1]
    case = f"Case {portrait['case']}" if portrait["case"] else ""
    return {"name": portrait["name"], "case": case, "sentence": sentence, "svg": draw(first, layers)}
