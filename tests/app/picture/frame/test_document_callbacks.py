"""What is asked of a page from elsewhere leaves nothing behind, so that a session goes whatever searches leave out."""

import asyncio
import gc
import logging
from contextlib import contextmanager
from types import SimpleNamespace
from weakref import ref

import pytest
from bokeh.document import Document
from bokeh.io import curdoc
from bokeh.server.contexts import BokehSessionContext
from bokeh.server.session import ServerSession
from codim2_app.picture.frame.document_callbacks import next_tick_scheduler
from tornado.ioloop import IOLoop

from tests.work import talk


class Held:
    """What a function holds."""


@contextmanager
def unsearched():
    """While nothing is searched for garbage."""
    searching = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if searching:
            gc.enable()


def opened():
    """A document with its session, in this loop."""
    document = Document()
    context = BokehSessionContext("name", SimpleNamespace(), document)
    document._session_context = ref(context)
    context._set_session(ServerSession("name", document, io_loop=IOLoop.current()))
    return document, context


async def turns(count=10):
    for _ in range(count):
        await asyncio.sleep(0)


def test_it_is_called_in_its_turn_with_the_documents_lock():
    async def asked():
        document, context = opened()
        done, asked_for = [], asyncio.Event()
        locked = lambda: context.session._pending_writes is not None

        async def before(_):
            done.append("before")
            await asked_for.wait()
            await turns(3)
            done.append("still before")

        first = asyncio.ensure_future(context.with_locked_document(before))
        soon = next_tick_scheduler(document)
        await asyncio.to_thread(soon, lambda: done.append(("first", curdoc() is document, locked())))
        soon(lambda: done.append(("second", curdoc() is document, locked())))
        asked_for.set()
        await turns(20)
        await first
        return done

    assert talk(asked()) == ["before", "still before", ("first", True, True), ("second", True, True)]


@pytest.mark.parametrize("gone", ["destroyed", "forgotten"])
def test_it_is_not_called_once_the_session_is_over(gone):
    async def asked():
        document, context = opened()
        done = []
        next_tick_scheduler(document)(lambda: done.append("called"))
        context.session.destroy()
        if gone == "forgotten":
            del context
        await turns()
        return done

    assert talk(asked()) == []


@pytest.mark.parametrize("how", ["here", "of a thread", "while it is locked", "it fails", "the session is over"])
def test_it_leaves_nothing_that_a_search_must_find(how, monkeypatch):
    """A cycle that is left out of searches when it becomes garbage would hold its session for ever."""
    said = []
    monkeypatch.setattr(logging.Logger, "handle", lambda self, record: said.append(record.getMessage()))

    async def asked():
        document, context = opened()
        held = Held()
        there, done = ref(held), []

        def function(held=held):
            done.append(held is not None)
            assert how != "it fails"

        async def busy(_):
            await turns(5)

        first = asyncio.ensure_future(context.with_locked_document(busy)) if how == "while it is locked" else None
        soon = next_tick_scheduler(document)
        if how == "of a thread":
            await asyncio.to_thread(soon, function)
        else:
            soon(function)
        if how == "the session is over":
            context.session.destroy()
        del held, function
        await turns()
        if first is not None:
            await first
        return there, done

    with unsearched():
        there, done = talk(asked())
        assert there() is None
    assert done == ([] if how == "the session is over" else [True])
    assert said == (["a page could not be answered"] if how == "it fails" else [])
