"""A browser's wish for a file is read, made in its turn, and answered once."""

import gc
import json
import math
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from queue import Queue
from threading import Event
from weakref import ref

import numpy as np
import pytest
from codim2_app.exports import export_request as made
from codim2_app.exports import film as films
from codim2_app.exports.export_request import TYPES, ExportRequest, make_file, seen_by
from codim2_app.exports.figure import Style, figure
from codim2_app.exports.files import DATA
from codim2_app.exports.view import view_of
from codim2_app.picture.draw.theme import themes
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.state.links import read_link
from codim2_app.view import export_jobs as takings
from codim2_app.view.export_jobs import ExportJobs
from codim2_app.view.refresh import Frames

import codim2_core as c2
from codim2_core.portrait.cycles.proof.check import check
from tests.work import PATIENCE


@pytest.fixture(scope="module")
def executor():
    with ThreadPoolExecutor(1) as one:
        yield one


def asked(executor, link, request):
    """The one answer to a request."""
    frames = Frames(read_link(link).state)
    frames.jobs = Jobs(executor)
    answers, later = Queue(), Queue()
    ExportJobs(frames).answer(request, answers.put, later.put)
    if answers.empty():
        later.get(timeout=PATIENCE)()  # on the thread that answers
    answer = answers.get(timeout=PATIENCE)
    assert answers.empty()
    assert later.empty()
    return answer


@pytest.mark.parametrize("kind", ["svg", "zip", "json", "npz", "py", "tex"])
def test_a_file_is_what_the_command_line_writes(executor, kind):
    answer = asked(executor, "preset=case1-cm4", {"id": 7, "kind": kind, "theme": "paper", "legend": False})
    assert (answer["taken"], answer["name"], answer["type"]) == (7, f"codim2-case1-cm4.{kind}", TYPES[kind])
    view = view_of("case1-cm4")
    expected = figure(view, Style(theme="paper", legend=False)).encode() if kind == "svg" else DATA[f".{kind}"](view)
    assert answer["file"] == expected
    again = asked(executor, "preset=case1-cm4", {"id": 8, "kind": kind, "theme": "paper", "legend": False})
    assert (again["taken"], again["file"]) == (8, expected)


def test_a_proof_is_taken_with_its_certificate_and_the_program_that_checks_it(executor):
    query = "a=1&b=3&d=-2&f1=0.4&f2=0.1&psi=constant"
    found = json.loads(asked(executor, query, {"id": 5, "kind": "proof"})["file"])
    assert (found["whole"], found["cycles"]) == (True, [])
    assert "there are no other limit cycles" in found["sentence"]
    assert check(json.loads(found["certificate"]))["limit cycles"] == 0
    assert found["checker"].startswith('"""Check a certificate')
    found = json.loads(asked(executor, "preset=case1-cm4", {"id": 6, "kind": "proof"})["file"])
    assert (found["whole"], found["certificate"], found["checker"]) == (True, None, None)  # by a theorem


SLIPS = "a=-2&b=0.5&d=-1&f1=-0.5&f2=0.2&k1=1&z=0.25&psi=rational"


def test_a_motion_is_taken_for_the_puck_from_a_place_of_the_picture(executor):
    told = json.loads(asked(executor, SLIPS, {"id": 7, "kind": "motion", "start": "1.2,0.9"})["file"])
    t, x, y, c, s, u, v = (np.array(told[name]) for name in "txycsuv")
    A, f = np.array([[-2, -0.5], [0.5, -1]]), np.array([-0.25, 0.2])
    assert (x[0], y[0]) == pytest.approx((0.4, 0.3), abs=1e-4)  # rho = 0.5 in the direction (4, 3)/5
    e = np.column_stack([c, s])
    slip = np.column_stack([x, y])
    moving = np.hypot(x, y) > 0.05
    assert np.allclose(e[moving], (slip / np.hypot(x, y)[:, None])[moving], atol=0.02)
    mean = ((e @ A.T + f)[1:] + (e @ A.T + f)[:-1]) / 2
    assert np.allclose(np.diff(slip, axis=0)[:8], (mean * np.diff(t)[:, None])[:8], atol=1e-3)
    assert np.allclose(A @ e[-1], -f, atol=0.01)  # at rest friction balances the push
    critical = c2.critical_sets(c2.ELinear(a=-2, b=0.5, d=-1, f=tuple(f)), c2.psi.rational())
    assert np.allclose((u[-1], v[-1]), critical[0].p, atol=0.02)


def test_a_motion_that_cannot_be_held_leaves_the_picture_and_one_at_rest_is_one(executor):
    told = json.loads(asked(executor, "a=-1&b=0&d=-1&f1=2&f2=0", {"id": 7, "kind": "motion", "start": "0.5,0"})["file"])
    assert told["u"][-1] > 2.4
    assert told["c"][-1] == pytest.approx(1, abs=1e-3)
    assert told["x"][0] == pytest.approx(told["eps"] / math.sqrt(3), rel=1e-4)  # tan 30° of the hemisphere


@pytest.mark.parametrize(
    ("query", "start", "says"),
    [
        ("a=-1", "far", "give a place"),
        ("a=-1", "9,9", "give a place"),
        ("preset=nonunique-sliding", "1.2,0.9", "e-linear"),
    ],
)
def test_no_motion_is_taken_from_nowhere_or_of_another_system(executor, query, start, says):
    assert says in asked(executor, query, {"id": 7, "kind": "motion", "start": start})["error"]


def test_a_proof_is_stopped_alone(executor):
    """What else is made meanwhile goes on, and takes nothing from it."""
    frames = Frames(read_link("f1=0.123").state)
    frames.jobs = Jobs(executor)
    answers, later, begin = Queue(), Queue(), Event()
    taking = ExportJobs(frames)
    executor.submit(begin.wait)
    try:
        taking.answer({"id": 1, "kind": "proof"}, answers.put, later.put)
        taking.answer({"id": 2, "kind": "tex"}, answers.put, later.put)
        assert frames.jobs.future("proof") is not None
        taking.answer({"id": 1, "kind": "proof", "stop": True}, answers.put, later.put)
        assert frames.jobs.future("proof") is None
        assert answers.get(timeout=PATIENCE) == {"taken": 1, "error": "The search for a proof was stopped."}
    finally:
        begin.set()
    later.get(timeout=PATIENCE)()
    assert answers.get(timeout=PATIENCE)["taken"] == 2
    assert answers.empty()


def test_it_is_what_is_on_the_screen(executor):
    request = {"id": 1, "kind": "svg", "theme": "dark", "window": [-0.5, 0.5, -0.5, 0.5, 0.002], "layers": ["inside"]}
    text = asked(executor, "f1=0.25&layers=inside,outside,critical", request)["file"].decode()
    assert themes()["dark"]["page"] in text
    assert re.search(r'<path d="M[^"]*" stroke="{}"'.format(themes()["dark"]["orbit"]), text)
    assert f'stroke="{themes()["dark"]["outside"]}"' not in text  # a question hides it
    view = seen_by(request, read_link("f1=0.25&layers=inside,outside,critical").state.values(), None)
    assert (view.seen, view.values["layers"], view.values["f1"]) == ((-0.5, 0.5, -0.5, 0.5), ["inside"], 0.25)


@pytest.mark.parametrize(
    ("request_", "said"),
    [
        ({"kind": "exe"}, "no such file"),
        ("svg", "no such file"),
        ({"kind": ["svg"]}, "no such file"),
        ({"kind": None, "id": [1]}, "no such file"),
        ({"kind": "svg", "theme": ["dark"]}, "light, dark, paper"),
        ({"kind": "svg", "theme": "red"}, "light, dark, paper"),
        ({"kind": "html", "sliders": ["a", "b", "d"]}, "at most 2 sliders"),
        ({"kind": "html", "sliders": ["a" * 201]}, "NAME=LOW,HIGH"),
        ({"kind": "html", "sliders": [3]}, "NAME=LOW,HIGH"),
        ({"kind": "html", "sliders": ["q"]}, "no slider of this system"),
        ({"kind": "gif", "sliders": ["nothing"]}, "no slider"),
        ({"kind": "gif", "sliders": []}, "no slider"),
    ],
)
def test_a_wish_that_cannot_be_had_is_answered_with_a_sentence(executor, request_, said):
    answer = asked(executor, "v=1", request_)
    assert said in answer["error"]
    assert "file" not in answer


def test_a_file_is_bounded(monkeypatch):
    monkeypatch.setattr(made, "MAX_FILE_BYTES", 1000)
    with pytest.raises(ValueError, match="show fewer layers"):
        make_file(view_of("v=1"), ExportRequest("svg"))


def test_a_newer_wish_replaces_an_older(executor):
    frames = Frames(read_link("v=1").state)
    frames.jobs = Jobs(executor)
    answers, later = Queue(), Queue()
    taking, begin = ExportJobs(frames), Event()
    executor.submit(begin.wait)  # none has begun before all are asked for
    for i, kind in enumerate(("json", "npz", "tex")):
        taking.answer({"id": i, "kind": kind}, answers.put, later.put)
        assert frames.jobs.queue.pending <= 1
    begin.set()
    while answers.empty():
        later.get(timeout=PATIENCE)()
    assert answers.get()["taken"] == 2


FILM = {"id": 3, "kind": "gif", "theme": "dark", "sliders": ["f1=-1,1"]}


def conversation(executor, request, query="preset=case1-cm4", stop_after=None):
    """All answers to the wish for a film; after some of them it is stopped."""
    frames = Frames(read_link(query).state)
    frames.jobs = Jobs(executor)
    taking, answers, later = ExportJobs(frames), [], Queue()
    taking.answer(request, answers.append, later.put)
    while not answers or "done" in answers[-1]:
        if len(answers) == stop_after:
            taking.answer({"id": request["id"], "stop": True}, answers.append, later.put)
            continue
        later.get(timeout=PATIENCE)()
    while not later.empty():
        later.get()()
    return answers


OTHER = {**FILM, "sliders": ["f1=-0.5,1"]}  # its parts are remembered


@pytest.mark.parametrize("request_", [{"id": 1, "kind": "json"}, OTHER])
def test_a_file_that_was_made_leaves_nothing_that_a_search_must_find(executor, monkeypatch, request_):
    """What looks for it again and again must not hold itself: left out of searches, it would hold the page for ever."""
    monkeypatch.setattr(takings, "count_of", lambda slider: 6)
    monkeypatch.setattr(films, "picture", lambda view, slider, value, style: b"")
    monkeypatch.setattr(takings, "encode_film", lambda *what: b"")

    class Page(list):
        """The answers that one page was given."""

    searching = gc.isenabled()
    gc.disable()
    try:
        page, later = Page(), Queue()
        there, frames = ref(page), Frames(read_link("preset=case1-cm4").state)
        frames.jobs = Jobs(executor)
        ExportJobs(frames).answer(request_, page.append, later.put)
        while not page or "done" in page[-1]:
            later.get(timeout=PATIENCE)()
        assert "file" in page[-1]
        del page
        assert there() is None
    finally:
        if searching:
            gc.enable()


def test_a_film_is_drawn_in_parts_and_is_that_of_the_command_line(executor, monkeypatch):
    monkeypatch.setattr(takings, "count_of", lambda slider: 6)
    *progress, film = conversation(executor, FILM)
    assert [(one["taken"], one["done"], one["all"]) for one in progress] == [(3, 4, 6), (3, 6, 6)]
    assert (film["name"], film["type"]) == ("codim2-case1-cm4-f1.gif", "image/gif")
    assert film["file"] == films.film(
        view_of("case1-cm4"), "f1=-1,1", style=replace(films.STYLE, theme="dark"), positions=6
    )


def test_a_film_of_play_is_drawn_in_larger_parts_and_refused_where_nothing_was_launched(executor, monkeypatch):
    monkeypatch.setattr(takings, "count_of", lambda slider: 5)
    [progress, film] = conversation(executor, {**FILM, "sliders": ["play"]}, "preset=case1-cm4&orbits=0.3,0.4")
    assert (progress["done"], progress["all"]) == (5, 5)
    assert film["file"][:3] == b"GIF"
    [answer] = conversation(executor, {**FILM, "sliders": ["play"]})
    assert "Click the picture" in answer["error"]


def test_a_film_that_is_stopped_draws_no_more(executor, monkeypatch):
    drawn = []
    monkeypatch.setattr(films, "picture", lambda view, slider, value, style: drawn.append(value) or b"")
    answers = conversation(executor, {**FILM, "sliders": ["f2=-1,1"]}, stop_after=2)
    assert [set(one) for one in answers] == [{"taken", "done", "all"}] * 2 + [{"taken", "error"}]
    assert "stopped" in answers[-1]["error"]
    assert len(drawn) <= 3 * takings.FILE_MESSAGE
