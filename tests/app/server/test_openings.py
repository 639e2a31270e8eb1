"""How sessions are opened: in parts, one after the other, and others are answered meanwhile."""

import asyncio
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from types import SimpleNamespace

from bokeh.document import Document
from bokeh.events import ButtonClick
from bokeh.models import Button
from bokeh.server.server import Server
from codim2_app.frame.later import TURNS
from codim2_app.server import openings
from codim2_app.server.giving_way import OneByOne, one_by_one
from codim2_app.server.page import take_over
from tornado.web import Application

from tests.benchmarks.bokeh_wire import Wire

#: Turns of the loop that a message takes from the line to its answer.
MESSAGE = 10


def alone(doing):
    """Run in a thread of its own: a browser's loop may run in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, doing).result()


async def beside(done, doing):
    """Do something, and let others have their turns, each of which is noted."""

    async def others():
        while not task.done():
            done.append("other")
            await asyncio.sleep(0)

    task = asyncio.ensure_future(doing)
    await others()
    return await task


def between(done, *parts):
    """How many turns others had between each part and the next."""
    places = [done.index(part) for part in parts]
    return [done[first:second].count("other") for first, second in pairwise(places)]


def test_between_the_parts_of_an_opening_a_message_is_answered(monkeypatch):
    done = []
    view = SimpleNamespace(prepare=lambda _: done.append("models"))
    monkeypatch.setattr(openings, "begun", lambda _: done.append("begun"))
    monkeypatch.setattr(openings, "make_figure", lambda: done.append("figure") or "a figure")
    monkeypatch.setattr(openings, "begin", lambda _state, _errors: done.append("frame") or "frames")
    made = lambda _link, drawn, frames: done.append(f"explorer with {drawn}, {frames}") or view
    monkeypatch.setattr(openings, "opened", made)

    async def opening():
        await openings.Ahead().on_session_created(SimpleNamespace(_document=doc))
        done.append("session")

    doc = Document()
    alone(beside(done, opening()))
    assert done.index("begun") < done.index("figure")  # it is noted that somebody is there
    assert min(between(done, "figure", "frame", "explorer with a figure, frames", "models", "session")) >= MESSAGE
    assert openings.view_of(doc) is view


def test_a_message_comes_from_the_line_to_its_answer_in_fewer_turns():
    """Else an opening would hold it up by several of its parts."""
    turns, answered = [0], []

    async def served():
        def page(doc):
            button = Button()
            button.on_event(ButtonClick, lambda _: answered.append(turns[0]))
            doc.add_root(button)

        loop = asyncio.get_running_loop()
        once = loop._run_once

        def counted():
            turns[0] += 1
            once()

        loop._run_once = counted
        server = Server({"/": page}, port=0)
        take_over(server._tornado)
        server.start()
        try:
            return await asyncio.to_thread(lambda: asyncio.run(clicks(server.port)))
        finally:
            server.stop()

    async def clicks(port):
        wire = await Wire.connect(port)
        asked = []
        for count in range(1, 6):
            asked.append(turns[0])
            await wire.event("button_click", wire.root)
            while len(answered) < count:
                await asyncio.sleep(0.01)
        await wire.close()
        return asked

    asked = alone(served())
    took = sorted(later - sooner for sooner, later in zip(asked, answered, strict=True))
    assert 3 <= took[0] <= took[2] <= MESSAGE < TURNS


def test_one_at_a_time_is_let_in_first_come_first_served_and_others_are_answered_between():
    done = []

    async def visitor(name, door):
        async with door:
            done.append(f"{name} comes")
            await asyncio.sleep(0)
            done.append(f"{name} goes")
        if name == "second":
            raise ConnectionError

    async def all_of_them():
        door = OneByOne()
        return await asyncio.gather(
            *(visitor(name, door) for name in ("first", "second", "third")), return_exceptions=True
        )

    _, error, _ = alone(beside(done, all_of_them()))
    assert isinstance(error, ConnectionError)
    said = [one for one in done if one != "other"]
    assert said == [f"{name} {does}" for name in ("first", "second", "third") for does in ("comes", "goes")]
    assert min(between(done, "first goes", "second comes")) >= MESSAGE
    assert min(between(done, "second goes", "third comes")) >= MESSAGE


def test_who_has_left_or_failed_lets_the_next_one_in():
    done = []

    async def visitor(name, door):
        async with door:
            done.append(name)
            await asyncio.sleep(0)
            raise ConnectionError

    async def all_of_them():
        door = OneByOne()
        tasks = [asyncio.ensure_future(visitor(name, door)) for name in ("failed", "left in the queue", "next")]
        await asyncio.sleep(0)
        tasks[1].cancel()
        return await asyncio.gather(*tasks, return_exceptions=True)

    alone(all_of_them())
    assert done == ["failed", "next"]


def test_the_pages_of_one_server_come_through_one_door():
    one, other = Application(), Application()
    assert one_by_one(one) is one_by_one(one)
    assert one_by_one(one) is not one_by_one(other)


def test_the_last_part_finds_the_parameters_of_the_view_copied():
    """It is the longest part, and would copy each of them: a quarter of its time."""
    view = openings.opened(openings.opening({}))
    of_all = type(view).param.objects("existing")
    shared = [name for name, one in view.param.objects("existing").items() if one.per_instance and one is of_all[name]]
    assert shared == []
