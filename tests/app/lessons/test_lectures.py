"""Lectures: Markdown files of views with notes and polls, as lessons are; a lecturer can write one."""

import asyncio
import threading
from functools import partial

import pytest
from codim2_app.lessons.asking import goal_is_reached, judge, pose
from codim2_app.lessons.lesson import LectureView, portrait_of
from codim2_app.lessons.library import LessonError, lectures, read_lesson
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.server import page
from codim2_app.view.lecture_page import SEED
from tornado.httpclient import AsyncHTTPClient
from tornado.httpserver import HTTPServer
from tornado.testing import bind_unused_port
from tornado.web import Application, RequestHandler

from tests.work import talk

OWN = """---
title: Mine
summary: Two views.
---
```view
title: One
portrait: case1-cm4
minutes: 3
```
Say *this*.

```view
title: Two
set: {f1: -2.4}
```
And that.

```question
ask: "Does it stick?"
options:
  - {say: "yes", when: "stable >= 1", wrong: "No."}
  - {say: "no", when: "stable == 0", wrong: "Yes."}
explain: "{critical_sets} critical sets."
```
"""


def test_a_lecturer_writes_views_notes_and_polls(tmp_path):
    path = tmp_path / "mine.md"
    path.write_text(OWN, encoding="utf-8")
    lesson = read_lesson(path)
    (one, notes, _), (two, _, asked) = lesson.views
    assert (one.title, one.minutes, one.values["preset"]) == ("One", 3.0, "case1-cm4")
    assert "<em>this</em>" in notes
    assert (two.values, asked) == ({"f1": -2.4}, [0])
    assert lesson.questions[0].draw == {"f1": -2.4}  # it is asked of what is shown
    path.write_text(OWN.replace("minutes", "minute"), encoding="utf-8")
    with pytest.raises(LessonError, match=r"line 5: 'minute' means nothing here"):
        read_lesson(path)


@pytest.mark.parametrize("key", lectures())
def test_a_lecture_has_twelve_views_for_fifty_minutes_and_polls_with_one_right_answer(key):
    lesson = lectures()[key]
    views = [view for view in lesson.parts if isinstance(view, LectureView)]
    assert (len(views), sum(view.minutes for view in views)) == (12, 50.0)
    assert all(notes for _, notes, _ in lesson.views)
    start = ExplorerState.from_values(lesson.values).values()
    assert len(lesson.questions) >= 4
    for question in lesson.questions:
        drawn = pose(question, start, SEED)
        scene = make_scene({**start, **portrait_of(drawn.get("preset")), **drawn})
        said = [judge(question, scene, answer) for answer in range(len(question.options))]
        assert sum(one["right"] for one in said) == 1, question.html
        assert all(bool(one["why"]) is not one["right"] for one in said)
        assert not goal_is_reached(question, scene)


def test_a_worksheet_is_made_off_the_loop_and_no_other_sheet_is_made(monkeypatch):
    """Its questions are posed and drawn, for seconds: whoever asks for it holds nobody's frame."""
    begun, answered = threading.Event(), threading.Event()

    def made(*_):
        begun.set()
        return "late" if answered.wait(20.0) else "the loop was held"

    class Frame(RequestHandler):
        def get(self):
            answered.set()

    async def both():
        sockets, port = bind_unused_port()
        application = Application([("/lecture", page.LecturePage), ("/frame", Frame)])
        application.prefix = ""
        server = HTTPServer(application)
        server.add_sockets([sockets])
        client = AsyncHTTPClient(force_instance=True)
        ask = partial(client.fetch, raise_error=False, request_timeout=60.0)
        address = f"http://127.0.0.1:{port}"
        try:
            sheet = asyncio.ensure_future(ask(f"{address}/lecture?of=spatial-friction&sheet=key"))
            while not begun.is_set():
                await asyncio.sleep(0.01)
            await ask(f"{address}/frame")
            other = await ask(f"{address}/lecture?of=spatial-friction&sheet=x")
            return (await sheet).body, other.code
        finally:
            client.close()
            server.stop()

    monkeypatch.setattr(page, "lecture_html", made)
    assert talk(both()) == (b"late", 404)
