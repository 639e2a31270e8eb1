"""A frame that waits for its picture: what was asked for with it is answered once the picture is there."""

import gc
import weakref
from concurrent.futures import Future
from types import SimpleNamespace

import pytest
from codim2_app.view import answers
from codim2_app.view.answers import AnswerQueue


class Frames:
    """Frames whose picture is computed next to them, when they are asked for the first time."""

    def __init__(self):
        self.pending, self.asked = Future(), []

    def answer(self, request):
        self.asked.append(dict(request))
        return b"frame"

    def keep(self):
        pass

    publish = keep


@pytest.fixture
def held():
    """What is sent, what comes in its turn, and what after a time."""
    return [], [], []


def queue(frames, send, soon, late):
    return AnswerQueue(frames, send, soon.append, lambda after, call: late.append((after, call)))


@pytest.mark.parametrize(
    ("asked", "rest"), [({"all": True}, True), ({"rest": True}, True), ({"rest": False}, False), ({}, False)]
)
def test_who_asks_for_all_is_at_rest_when_it_is_answered(held, asked, rest):
    """A link that opened on the Atlas, with a formula yet to be compiled, had no regions until something moved."""
    sent, soon, late = held
    frames = Frames()
    data = {"id": 7, "window": [1.0], **asked}
    queue(frames, sent.append, soon, late).answer(data)
    assert sent == []
    frames.pending.set_result(None)
    [answer] = soon
    answer()
    assert sent == [{"frame": b"frame"}]
    assert frames.asked[1] == {"id": 7, "window": [1.0], "rest": rest}


@pytest.mark.parametrize("meanwhile", ["nothing", "left", "answered"])
def test_an_answer_comes_soon_without_its_picture_unless_nobody_waits_for_it(held, meanwhile):
    sent, soon, late = held
    made = queue(frames := Frames(), sent.append, soon, late)
    frames.jobs, made.visitor = SimpleNamespace(leave=lambda: None), SimpleNamespace(leave=lambda: None)
    made.answer({"id": 7})
    [(after, call)] = late
    assert after == answers.PICTURE_WAIT_SECONDS
    if meanwhile == "left":
        made.leave()
    elif meanwhile == "answered":
        frames.pending.set_result(None)
        soon.pop()()
    call()
    assert len(soon) == (meanwhile == "nothing")
    for answer in soon:
        answer()
    assert len(sent) == (meanwhile in ("nothing", "answered"))


class Page:
    """One that is answered, of which one can see whether somebody holds it."""

    def send(self, message):
        pass


@pytest.mark.parametrize("how", ["answered late", "left", "asked again"])
def test_what_was_waited_for_holds_no_page_that_waits_no_more(held, how):
    """A picture that others want too, or that is kept, outlives the page that asked for it."""
    _, soon, late = held
    model = Page()
    made = queue(frames := Frames(), model.send, soon, late)
    pending, page = frames.pending, weakref.ref(model)
    frames.jobs, made.visitor = SimpleNamespace(leave=lambda: None), SimpleNamespace(leave=lambda: None)
    made.answer({"id": 7})
    if how == "answered late":
        late[0][1]()
        soon.pop()()
    elif how == "left":
        made.leave()
    else:
        frames.pending = None
        made.answer({"id": 8})
    del made, model, frames
    gc.collect()
    assert page() is None
    pending.set_result(None)
    assert soon == []
