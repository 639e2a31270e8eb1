"""Lectures: Markdown files of views with notes and polls, as lessons are; a lecturer can write one."""

import pytest
from codim2_app.frame.scenes import make_scene
from codim2_app.lessons.asking import goal_is_reached, judge, pose
from codim2_app.lessons.lesson import LectureView, portrait_of
from codim2_app.lessons.library import lectures
from codim2_app.lessons.reading import LessonError, read_lesson
from codim2_app.state.controls import ExplorerState
from codim2_app.view.lecture_page import SEED

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
