"""A frame that waits for its picture: what was asked for with it is answered once the picture is there."""

from concurrent.futures import Future
from types import SimpleNamespace

import pytest
from codim2_app.view import answers
from codim2_app.view.answers import Answers


class Frames:
    """Frames whose picture is computed beside them, when they are asked for the first time."""

    def __init__(self):
        self.pending, self.asked = Future(), []

    def answer(self, request):
        self.asked.append(dict(request))
        return b"frame"

    def keep(self):
        pass

    publish = keep


@pytest.mark.parametrize(
    ("asked", "rest"), [({"all": True}, True), ({"rest": True}, True), ({"rest": False}, False), ({}, False)]
)
def test_who_asks_for_all_is_at_rest_when_it_is_answered(monkeypatch, asked, rest):
    """A link that opened on the Atlas, with a formula yet to be compiled, had no regions until something moved."""
    sent, soon = [], []
    monkeypatch.setattr(answers, "send", lambda model, message: sent.append(message))
    document = SimpleNamespace(
        session_context=True, add_next_tick_callback=soon.append, add_timeout_callback=lambda call, after: None
    )
    frames = Frames()
    data = {"id": 7, "window": [1.0], **asked}
    Answers(frames).answer(SimpleNamespace(document=document), data)
    assert sent == []
    frames.pending.set_result(None)
    [answer] = soon
    answer()
    assert sent == [{"frame": b"frame"}]
    assert frames.asked[1] == {"id": 7, "window": [1.0], "rest": rest}
