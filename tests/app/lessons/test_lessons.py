"""The course, file by file: everything in it can be opened, drawn, answered and reached."""

import json
import re

import pytest
from codim2_app.frame.scenes import make_scene
from codim2_app.lessons.asking import judge, pose, reached
from codim2_app.lessons.library import TEXT, built_in, from_folder
from codim2_app.lessons.reading import LessonError, read_lesson
from codim2_app.state.controls import ExplorerState, preset_values

COURSE = built_in()
QUESTIONS = [(key, i) for key, lesson in COURSE.items() for i in range(len(lesson.questions))]


def values_of(lesson, drawn):
    start = ExplorerState.of(lesson.values).values()
    return {**start, **preset_values(drawn.get("preset")), **drawn}


def test_the_course_has_at_least_ten_stations_in_the_order_of_the_paper():
    assert len(COURSE) >= 10
    assert list(COURSE) == sorted(COURSE)
    assert all(lesson.questions for lesson in COURSE.values())


@pytest.mark.parametrize("key", list(COURSE))
def test_a_lesson_opens_on_a_picture(key):
    lesson = COURSE[key]
    scene = make_scene(values_of(lesson, {}))
    assert scene["classification"].name
    assert len(lesson.title) < 60
    assert lesson.summary.endswith((".", "?"))


@pytest.mark.parametrize(("key", "i"), QUESTIONS)
def test_exactly_one_option_is_right_whatever_is_drawn(key, i):
    lesson = COURSE[key]
    question = lesson.questions[i]
    for seed in range(8):
        drawn = pose(question, values_of(lesson, {}), seed)
        assert drawn == pose(question, values_of(lesson, {}), seed)
        scene = make_scene(values_of(lesson, drawn))
        said = judge(question, scene, 0)
        assert said["truth"] is not None, (seed, drawn)
        assert judge(question, scene, said["truth"])["right"]
        assert not judge(question, scene, (said["truth"] + 1) % len(question.options))["right"]
        assert "{" not in said["explain"]
        assert not reached(question, scene)


def test_questions_that_draw_have_different_answers():
    """A question whose answer never changes can be answered without thinking; most of the course must not be so."""
    varied = 0
    for key, i in QUESTIONS:
        question = COURSE[key].questions[i]
        base = values_of(COURSE[key], {})
        truths = {
            judge(question, make_scene(values_of(COURSE[key], pose(question, base, seed))), 0)["truth"]
            for seed in range(12)
        }
        varied += len(truths) > 1
    assert varied >= len(QUESTIONS) // 2


#: What a student would set to reach each goal: the hints lead there.
SOLUTIONS = {
    "01-friction": {"a": -1, "d": -1, "b": 0.5, "f1": 0.8},
    "03-limit-directions": {"a": -0.3, "b": 0, "d": -1, "f1": 0.5, "f2": 0},
    "04-sliding": {"a": -1, "d": -1, "b": 0, "f1": 0.2, "f2": 0, "B1": -1, "g0": 0},
    "05-case-one": {"a": -1, "d": -1, "b": 2, "f1": 0.1, "f2": 0},
    "06-case-two": {"a": 1, "b": 0.3, "d": -1, "f1": 1.2, "f2": 0.8},
    "07-psi-matters": {"n": 4},
    "11-bifurcations": {"a": -1, "d": -1, "b": 0.3, "f1": 1.2, "f2": 0},
}


def test_every_goal_can_be_reached():
    goals = {key for key, lesson in COURSE.items() for question in lesson.questions if question.vary}
    assert goals == set(SOLUTIONS)
    for key, solution in SOLUTIONS.items():
        lesson = COURSE[key]
        question = next(question for question in lesson.questions if question.vary)
        drawn = pose(question, values_of(lesson, {}), seed=1)
        assert not reached(question, make_scene(values_of(lesson, drawn)))
        assert reached(question, make_scene(values_of(lesson, {**drawn, **solution}))), key


def test_what_a_lesson_shows_is_safe_and_complete():
    for lesson in COURSE.values():
        html = "".join(part.html for part in lesson.parts)
        assert "$" not in html, lesson.key  # every formula was read
        assert "<script" not in html
        assert "href" not in html
        for found in re.findall(r'data-set="([^"]*)"', html):
            assert json.loads(found.replace("&quot;", '"'))


GOOD = "---\ntitle: T\nsummary: S.\n---\nText with [](fact:name).\n"


def test_a_lecturers_own_folder_and_a_broken_file_in_it(tmp_path):
    (tmp_path / "one.md").write_text(GOOD, encoding="utf-8")
    (tmp_path / "two.md").write_text(GOOD + "\n[x](portrait:case9)\n", encoding="utf-8")
    found, errors = from_folder(tmp_path)
    assert list(found) == ["one"]
    assert [str(error) for error in errors] == [
        "two.md, line 7: there is no portrait 'case9'; `codim2 presets` lists them."
    ]


QUESTION = "```question\nask: What?\noptions:\n- {say: a, when: 'stable == 1'}\n- {say: b, when: 'stable == 0'}\n"


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 1, "begins with"),
        ("---\ntitle: T\n---\n", 1, "'summary' is missing"),
        ("---\ntitle: [\n---\n", 2, "YAML"),
        ("---\ntitle: T\nsummary: S\ncolour: red\n---\n", 1, "'colour' means nothing"),
        ("---\ntitle: T\nsummary: S\nset: {q: 1}\n---\n", 1, "no control 'q'"),
        (GOOD + "\n[x](https://example.org)\n", 7, "leads nowhere"),
        (GOOD + "\n[x](set:a=much)\n", 7, "not a number"),
        (GOOD + "\n" + QUESTION + "```\n", 7, "'explain' is missing"),
        (GOOD + "\n" + QUESTION + "explain: '{nonsense}'\n```\n", 7, "no fact 'nonsense'"),
        (GOOD + "\n" + QUESTION + "explain: e\nrequire: import os\n```\n", 7, "cannot be read"),
        (GOOD + "\n" + QUESTION + "explain: e\nhide: [all]\n```\n", 7, "no layer 'all'"),
        (GOOD + "\n" + QUESTION + "explain: e\ndraw: {a: [2, 1]}\n```\n", 7, "low < high"),
    ],
)
def test_what_is_wrong_is_told_with_its_file_and_line(tmp_path, text, line, words):
    path = tmp_path / "broken.md"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(LessonError, match=re.escape(words)) as told:
        read_lesson(path)
    assert told.value.line == line
    assert str(told.value).startswith(f"broken.md, line {line}: ")


def test_html_in_a_lesson_is_text(tmp_path):
    path = tmp_path / "html.md"
    path.write_text(GOOD + "\n<script>alert(1)</script> <b>x</b>\n", encoding="utf-8")
    html = "".join(part.html for part in read_lesson(path).parts)
    assert "<script" not in html
    assert "<b>x" not in html


def test_every_file_of_the_folder_is_in_the_course():
    assert {path.stem for path in TEXT.iterdir()} == set(COURSE)
