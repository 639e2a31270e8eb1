"""The course, file by file: everything in it can be opened, drawn, answered and reached."""

import json
import math
import re

import pytest
from codim2_app.lessons.asking import goal_is_reached, judge, pose, right_option, stands
from codim2_app.lessons.facts import facts_of
from codim2_app.lessons.library import LessonError, built_in, from_folder, read_lesson
from codim2_app.lessons.marks import MARK_TOLERANCE, MARKS, gap
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.state.controls import ExplorerState, preset_values

COURSE = built_in()
QUESTIONS = [(key, i) for key, lesson in COURSE.items() for i in range(len(lesson.questions))]


def values_of(lesson, drawn):
    start = ExplorerState.from_values(lesson.values).values()
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
def test_exactly_one_answer_is_right_whatever_is_drawn(key, i):
    lesson = COURSE[key]
    question = lesson.questions[i]
    for seed in range(8):
        drawn = pose(question, values_of(lesson, {}), seed)
        assert drawn == pose(question, values_of(lesson, {}), seed)
        scene = make_scene(values_of(lesson, drawn))
        assert not goal_is_reached(question, scene)
        answers = [*range(len(question.options)), *there(question, scene)]
        right = [answer for answer in answers if judge(question, scene, answer)["right"]]
        assert right, (seed, drawn)
        assert right == there(question, scene) or len(right) == 1, (seed, drawn)
        for answer in answers:
            said = judge(question, scene, answer)
            assert "{" not in said["explain"] + said["why"]
            assert bool(said["why"]) is not said["right"]  # who is wrong is told why


def there(question, scene):
    return MARKS[question.mark][1](scene) if question.mark else []


def test_a_mark_is_right_near_its_place_and_told_how_far_it_is():
    question = COURSE["04-sliding"].questions[0]
    scene = make_scene(values_of(COURSE["04-sliding"], {"a": -1.0, "d": -1.0, "b": 0.0, "f1": 0.5, "f2": 0.0}))
    assert judge(question, scene, (0.5 + MARK_TOLERANCE - 0.01, 0.0))["right"]
    far = judge(question, scene, (0.5, 0.41))
    assert (far["right"], far["why"]) == (False, "The right place is 0.41 radii of the disc from your mark.")
    assert judge(question, scene, 0)["why"]  # there is one
    none = make_scene(values_of(COURSE["04-sliding"], {"a": -1.0, "d": -1.0, "b": 0.0, "f1": 1.5, "f2": 0.0}))
    assert judge(question, none, 0)["right"]
    assert judge(question, none, (0.0, 0.0))["why"] == "There is none here."


def test_a_mark_next_to_the_equator_counts_by_its_angle():
    shown = {"f1": -0.5, "a": -2.0, "b": 0.0, "d": -1.0, "f2": 0.0}
    scene = make_scene(values_of(COURSE["03-limit-directions"], shown))
    angle = 2 * math.pi / 3  # Q2: both eigenvalues are negative
    for radius in (0.5, 1.0, 1.7):
        place = (radius * math.cos(angle), radius * math.sin(angle))
        assert gap("along_an_open_set", scene, place) == pytest.approx(0.0, abs=1e-12)
    assert gap("limit_directions", scene, (1.0, 0.0)) == pytest.approx(0.0, abs=1e-12)
    assert gap("along_an_open_set", scene, (1.0, 0.0)) == pytest.approx(math.sqrt(3.0))
    assert gap("limit_directions", scene, (0.01, 0.0)) == pytest.approx(1.0)  # the middle has no angle
    assert gap("leaving", scene, (1.0, 0.0)) is None


def test_a_goal_that_is_missed_is_told_where_it_stands():
    lesson = COURSE["06-case-two"]
    assert stands(lesson.questions[0].vary.goal, make_scene(values_of(lesson, {}))) == "case: II, critical sets: 1"


def test_questions_that_draw_have_different_answers():
    """A question whose answer never changes can be answered without thinking; most of the course must not be so."""
    varied = 0
    for key, i in QUESTIONS:
        question = COURSE[key].questions[i]
        base = values_of(COURSE[key], {})
        scenes = [make_scene(values_of(COURSE[key], pose(question, base, seed))) for seed in range(12)]
        facts = [right_option(question, facts_of(scene, question.facts)) for scene in scenes]
        varied += len({(truth, *there(question, scene)) for truth, scene in zip(facts, scenes, strict=True)}) > 1
    assert varied == len(QUESTIONS) - 1  # the paper's system of attracting and repelling directions has no slider


#: What a student would set to reach each goal: the hints lead there.
SOLUTIONS = {
    "01-friction": {"b": 0.3, "f1": 1.2},
    "02-blowing-up": {"a": -2, "d": -1, "b": 0, "f1": -2.2, "f2": 0},
    "03-limit-directions": {"a": -0.3, "b": 0, "d": -1, "f1": 0.5, "f2": 0},
    "04-sliding": {"a": -1, "d": -1, "b": 0, "f1": 0.2, "f2": 0, "B1": -1, "g0": 0},
    "05-case-one": {"a": -1, "d": -1, "b": 2, "f1": 0.1, "f2": 0},
    "06-case-two": {"a": 1, "b": 0.3, "d": -1, "f1": 1.2, "f2": 0.8},
    "07-psi-matters": {"n": 4},
    "08-approach": {"a": -0.3, "b": 0, "d": -1, "f1": 0.5, "f2": 0},
    "09-ball": {"z": 3.43},
    "10-nonunique": {"z": 1.5},
    "11-bifurcations": {"a": -1, "d": -1, "b": 0.3, "f1": 1.2, "f2": 0},
    "12-your-own": {"texts": {"U1": "-c*(c - 1/2)*(c + 1/2)", "U2": "-2*s", "W": "0", "where": ""}},
    "14-engines": {"a": 220, "b": 183, "d": -150, "f1": 1, "f2": 1},
    "13-census": {"a": 1.5, "d": -1.2, "b": 0.2, "f1": 0.1, "f2": 1.3},
}


def test_every_goal_can_be_reached():
    goals = {key for key, lesson in COURSE.items() for question in lesson.questions if question.vary}
    assert goals == set(SOLUTIONS)
    for key, solution in SOLUTIONS.items():
        lesson = COURSE[key]
        question = next(question for question in lesson.questions if question.vary)
        drawn = pose(question, values_of(lesson, {}), seed=1)
        assert not goal_is_reached(question, make_scene(values_of(lesson, drawn)))
        assert goal_is_reached(question, make_scene(values_of(lesson, {**drawn, **solution}))), key


def test_what_a_lesson_shows_is_safe_and_complete():
    for lesson in COURSE.values():
        html = "".join(part.html for part in lesson.parts)
        assert "$" not in html, lesson.key  # every formula was read
        assert "<script" not in html
        assert "href" not in html
        assert html.count('role="slider"') == len(re.findall(r'role="slider" tabindex="0" aria-label="[^"<]+"', html))
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
        (GOOD + "\n" + QUESTION + "explain: e\nmark: all\n```\n", 7, "no 'all'"),
        (GOOD + "\n" + QUESTION + "explain: e\nmark: stable\n```\n", 7, "at most one"),
        (GOOD + "\n```question\nask: W\nexplain: e\n```\n", 7, "two or more, or mark:"),
        (GOOD + "\n" + QUESTION.replace("0'}", "0', wrong: '{no}'}") + "explain: e\n```\n", 7, "wrong: no fact"),
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
