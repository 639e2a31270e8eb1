"""Garbage is looked for often, by searches that are short: they leave out what lives for long.

A search through all stops every visitor for 0.1 to 0.4 s, and nearly all that it meets are modules, kernels, and what
those hold who are there. So whatever a search leaves is frozen (`gc.freeze`): the next one meets what has come since.
When a session has ended, what it had is brought back (see `left_behind`), and the next search meets that as well.
Garbage that came to be while it was frozen, and that nothing of a session leads to, keeps what it holds: nothing that
is made here does that (see `later`), but what others make may. So all that lives is searched when the last visitor has
gone; when something of a session that has ended is still there after all its searches, as soon as nobody has asked for
a while; and at once, whoever asks, if that has become much, or much else is frozen.
"""

from __future__ import annotations

import gc
import time
from contextlib import suppress
from dataclasses import dataclass
from typing import Any
from weakref import ref

import panel as pn

from .left_behind import Old, bring_back
from .returned import give_back

EVERY = 0.25  # seconds between looks
QUIET = 0.5  # seconds without a request
#: Seconds after a session's end until what it had is searched: till then somebody may be at work for it. Also seconds
#: without a request after which all that lives is, where there is a reason.
REST = 5.0
#: Searches through the young after which there is enough for one of what they left (objects that stayed: 7000 each,
#: two visits); and beyond which it no longer waits for quiet.
SOME, MOST = 1, 2
NEVER = 10**6
#: Sessions that are due, beyond which two are searched at once: where more came than looks, they would pile up.
BEHIND = 8
#: How often what a session had is searched, each time after twice as long, while something of it is still in use.
TRIES = 6
#: Sessions of which something is still there, and objects that are frozen beyond those of `begin` and of sessions
#: (each of `OBJECTS`), either of which is enough to search all though somebody asks.
STUCK, FROZEN, OBJECTS = 40, 400_000, 3000
#: Sessions after which the latter are counted, when nobody waits, or twice as many: that takes up to 30 ms.
COUNTED = 64
#: The name of Panel's own search through all, some seconds after a session's end.
PANELS = "gc.collect"


@dataclass
class _Session:
    """What leads to all that a session had, which has ended."""

    roots: list[Any]
    due: float
    tried: int = 0


_asked = 0.0
_ended = 0.0  # when a session last ended and all has not been searched since; 0 for none
_documents: list[Any] = []  # of the sessions that are there
_left: list[_Session] = []
_stuck = 0  # sessions
_uncounted = 0  # sessions
_frozen = 0  # objects, at the begin
_old: Old | None = None


def asked() -> None:
    """Note that a visitor waits for an answer."""
    global _asked
    _asked = time.monotonic()


def begun(document: Any) -> None:
    """Note that the session of a document begins, once or again: from now on somebody is there."""
    if document not in _documents:
        _documents.append(document)


def ended(document: Any, *roots: Any) -> None:
    """Note that a session has ended, and what leads, with its document, to all that it had."""
    global _ended
    _ended = time.monotonic()
    _documents.remove(document)
    _left.append(_Session([document, *roots], _ended + REST))
    with suppress(KeyError):  # searched here instead, see above
        pn.state.cancel_task(PANELS)


def begin() -> None:
    """Leave out what was there before the first visitor, and let Python's own search keep to the young."""
    global _old
    gc.set_threshold(*gc.get_threshold()[:2], NEVER)
    _old = Old()
    _count()


def _count() -> None:
    global _frozen, _uncounted, _stuck
    _frozen, _uncounted, _stuck = gc.get_freeze_count() - OBJECTS * len(_documents), 0, 0


def keep() -> None:
    """Leave out of later searches what lives now.

    Not while a document waits for a callback: Bokeh's are garbage as soon as they were called, and hold the document.
    """
    if not any(document.session_callbacks for document in _documents):
        gc.freeze()


def look() -> None:
    """Search if a session has ended or there is enough, and nobody waits; through all where it need be."""
    now = time.monotonic()
    quiet = now - _asked
    if quiet >= REST and (_stuck or (_ended and not _documents and now - _ended >= REST)):
        _search_all()
    elif due := [session for session in _left if now >= session.due + (0.0 if quiet >= QUIET else REST)]:
        _search_sessions(due[: 1 + (len(due) > BEHIND)])
    elif gc.get_count()[2] >= (SOME if quiet >= QUIET else MOST):
        _search()
    elif _uncounted >= (COUNTED if quiet >= QUIET else 2 * COUNTED) and _many():
        _search_all()


def _search() -> bool:
    """Search what is not frozen, and freeze what is left; say whether it could.

    Python searches nothing while another thread does, which gives way to this one where garbage has something to do
    when it goes: that of the compiler has. What would be frozen then is garbage too.
    """
    before = _searches()
    gc.collect()
    if _searches() == before:
        return False
    keep()
    return True


def _searches() -> int:
    return gc.get_stats()[2]["collections"]


def _search_sessions(sessions: list[_Session]) -> None:
    """Search what some sessions had; what is still in use of one, again later."""
    global _uncounted, _stuck
    assert _old is not None  # since before the first visitor
    there = [[ref(root) for root in session.roots] for session in sessions]
    bring_back([root for session in sessions for root in session.roots], _old)
    for session in sessions:
        _left.remove(session)
        session.roots.clear()
    searched = _search()
    give_back()
    for session, were in zip(sessions, there, strict=True):
        session.roots = [root for one in were if (root := one()) is not None]
        session.tried += searched
        if session.roots and session.tried < TRIES:
            session.due = time.monotonic() + (REST * 2**session.tried if searched else 0.0)
            _left.append(session)
        else:
            _uncounted += 1
            _stuck += bool(session.roots)
    if _stuck >= STUCK:
        _search_all()


def _many() -> bool:
    """Whether much more is frozen than sessions explain."""
    global _uncounted
    _uncounted = 0
    return gc.get_freeze_count() > _frozen + FROZEN + OBJECTS * len(_documents)


def _search_all() -> None:
    """Search all that lives; if nobody is there, what lives then is old."""
    global _ended, _old
    if not _documents:
        _ended, _old = 0.0, None
        _left.clear()
    gc.unfreeze()
    gc.collect()
    give_back()
    if _old is None:
        _old = Old()
    else:
        gc.freeze()
    _count()
