"""The room of one page: what a browser may ask, and the row that its lecturer sees."""

from types import SimpleNamespace

import pytest
from codim2_app.lessons.library import lessons
from codim2_app.lessons.rooms import rooms
from codim2_app.lessons.rooms.rooms import MOST_TRIES, Rooms
from codim2_app.lessons.rooms.visitor import Visitor
from codim2_app.picture.state.chosen_system import NORMAL
from codim2_app.picture.state.controls import ExplorerState, first_values
from codim2_app.view.refresh import Frames

from codim2_core import System


class Page:
    """A page without a browser."""

    def __init__(self, **values):
        self.frames = Frames(ExplorerState(**{"layers": [], "panel": "psi", "trajectories": 0, **values}))
        self.frames.answer({"all": True})
        self.visitor = Visitor(self.frames)
        self.heard = []

    def ask(self, request):
        self.heard.clear()
        self.visitor.answer(request, self.heard.append, lambda act: act())
        return self.heard[-1] if self.heard else {}


@pytest.fixture(autouse=True)
def fresh():
    kept = list(rooms._served)
    rooms.serve_with(Rooms())
    yield rooms.process_rooms()
    rooms._served[:] = kept


def test_what_a_lecturer_sees_of_a_phone(fresh):
    lecturer, phone = Page(), Page(f1=1.5, launch="1,2,3", orbits="0.5,0.5")
    code = lecturer.ask({"open": ""})["open"]
    assert phone.ask({"join": code}) == {"joined": code, "view": {"layers": [], "panel": "psi", "trajectories": 0}}
    lecturer.frames.answer({"set": {"f1": 0.75}})
    fresh.tick()
    assert fresh.view(code)["f1"] == 0.75  # who comes later begins with what is shown then
    [[number, name, settings, lesson]] = lecturer.heard[-1]["rows"]
    assert (name, settings, lesson) == (phone.frames.scene["classification"].name, {"f1": 1.5}, None)
    phone.frames.answer({"set": {"system": "own", "lesson": (key := next(iter(lessons())))}})
    fresh.tick()
    [[same, _, settings, lesson]] = lecturer.heard[-1]["rows"]
    assert same == number
    assert settings["system"] == "own"
    assert settings["parameters"] == dict(phone.frames.scene.system.parameters) != {}
    assert lesson == [lessons()[key].title, -1, False, -1]
    phone.visitor.leave()
    fresh.tick()
    assert lecturer.heard[-1] == {"rows": []}


def test_a_phone_that_follows_is_told_what_the_lecturer_shows_whenever_that_changes(fresh):
    lecturer, phone = Page(), Page()
    code = lecturer.ask({"open": ""})["open"]
    assert phone.ask({"follow": True}) == {}  # who is in no room
    phone.ask({"join": code})
    lecturer.frames.answer({"set": {"f1": 0.75}})
    fresh.tick()
    assert phone.ask({"follow": True})["view"]["f1"] == 0.75
    phone.heard.clear()
    fresh.tick()
    assert phone.heard == []  # nothing has changed
    lecturer.frames.answer({"set": {"f1": 0.5}})
    fresh.tick()
    assert [message["view"]["f1"] for message in phone.heard] == [0.5]
    phone.ask({"follow": False})
    lecturer.frames.answer({"set": {"f1": 0.25}})
    fresh.tick()
    assert phone.heard == []


def row_of(fresh, answered=(), scene=None, **values):
    """What a lecturer is told of a page that shows this."""
    shown = {"portrait_name": "CM4", "last_answer": answered}
    frames = SimpleNamespace(values={**first_values(), **values}, scene=scene, **shown)
    heard = []
    code, _ = fresh.open("", heard.append)
    visitor = Visitor(frames)
    visitor.answer({"join": code}, lambda message: None, lambda act: act())
    fresh.tick()
    visitor.leave()
    return heard[-1]["rows"][0][1:]


def test_a_row_is_the_name_the_settings_and_the_lesson(fresh):
    key, other = list(lessons())[:2]
    title = lessons()[key].title
    assert row_of(fresh) == ["CM4", {}, None]
    assert row_of(fresh, lesson=key) == ["CM4", {}, [title, -1, False, -1]]
    assert row_of(fresh, (key, 2, True, 1), lesson=key)[2] == [title, 2, True, 1]
    assert row_of(fresh, (key, 0, False, 2), lesson=key)[2] == [title, 0, False, 2]
    assert row_of(fresh, (other, 2, True, 1), lesson=key)[2] == [title, -1, False, -1]
    assert row_of(fresh, (key, 2, True, 1))[2] is None


def test_of_a_system_with_formulas_all_parameters_are_told(fresh):
    typed = SimpleNamespace(system=System(U=("k*c", "s"), parameters={"k": 3.0}))
    assert row_of(fresh, scene=typed, system="own")[1]["parameters"] == {"k": 3.0}
    assert "parameters" not in row_of(fresh, scene=typed, system=NORMAL)[1]
    assert "parameters" not in row_of(fresh, scene=SimpleNamespace(system=None), system="own")[1]


def test_only_who_says_so_leaves_or_closes(fresh):
    lecturer, phone = Page(), Page()
    code = lecturer.ask({"open": ""})["open"]
    phone.ask({"join": code})
    for odd in ({"leave": True}, {"close": 1}, {}):
        assert lecturer.ask(odd) == {}
    assert phone.ask({"leave": 1}) == {}
    fresh.tick()
    assert len(fresh.guests) == 1
    assert fresh.hosts[code].is_open(fresh.hosts[code].opened)
    phone.ask({"leave": True})
    assert fresh.guests == {}
    Page().visitor.leave()  # who is in no room
    lecturer.visitor.leave()
    assert fresh.hosts[code].tell is None


def test_a_lecturer_closes_his_room_and_nobody_elses(fresh):
    lecturer, phone = Page(), Page()
    code = lecturer.ask({"open": ""})["open"]
    phone.ask({"join": code})
    phone.ask({"close": True})
    fresh.tick()
    assert phone.heard == []
    assert lecturer.ask({"close": True}) == {"ended": code}
    assert phone.heard == [{"ended": code}]
    assert "error" in phone.ask({"join": code})


def test_a_page_that_goes_leaves_its_room_waiting(fresh):
    lecturer = Page()
    first = lecturer.ask({"open": ""})
    lecturer.visitor.leave()
    assert Page().ask({"open": first["key"]}) == first


def test_codes_are_not_guessed_by_pages_that_are_loaded_again():
    """A page may be a new one each time: tries are of its network."""
    for _ in range(MOST_TRIES):
        assert "no room" in Page().ask({"join": "BCDF"})["error"]
    assert "Too many" in Page().ask({"join": "BCDF"})["error"]


def test_of_what_a_page_does_not_take_the_newest_is_kept(fresh):
    """Its turns do not come: a lecturer who reads nothing once had all rows of hours kept for him."""
    lecturer, phone, waiting = Page(), Page(), []
    lecturer.visitor.answer({"open": ""}, lecturer.heard.append, waiting.append)
    phone.ask({"join": lecturer.heard[0]["open"]})
    for i in range(30):
        phone.frames.answer({"set": {"f1": 0.01 * i}})
        fresh.tick()
    assert len(waiting) == 1
    waiting[0]()
    assert lecturer.heard[-1]["rows"][0][2] == {"f1": 0.29}


@pytest.mark.parametrize(
    "odd", [None, [], "open", {"open": 3}, {"join": ["A"]}, {"close": "yes"}, {"leave": 1}, {"open": "x" * 10**5}]
)
def test_what_no_page_sends_changes_nothing(odd):
    page = Page()
    heard = page.ask(odd)
    assert heard == {} or len(heard["key"]) < 64
