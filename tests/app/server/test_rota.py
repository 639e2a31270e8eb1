"""Whose turn it is: in a circle, whoever comes in at every fourth, and nobody because of another."""

import asyncio

import pytest
from codim2_app.server.session_queue import FOURTH, Rota

from tests.work import talk


class Page:
    """One that asks again in each of its turns, so many times."""

    def __init__(self, name, rota, done, again=0, fails=False):
        self.name, self.rota, self.done, self.again, self.fails = name, rota, done, again, fails

    def turn(self):
        self.done.append(self.name)
        if self.fails:
            raise RuntimeError("a fault")
        if self.again:
            self.again -= 1
            self.rota.ask(self)


def played(begin):
    """Let something be asked, and return whose turns it were."""
    done = []

    async def play():
        rota = Rota()
        begin(rota, done)
        for _ in range(10_000):
            if not rota.waiting:
                break
            await asyncio.sleep(0)
        await asyncio.sleep(0.01)
        return done

    return talk(play())


def test_pages_have_turns_in_a_circle_however_much_one_asks():
    def begin(rota, done):
        greedy, modest = Page("greedy", rota, done, 50), Page("modest", rota, done, 3)
        for page in (greedy, greedy, greedy, modest):
            rota.ask(page)

    assert played(begin)[:8] == ["greedy", "modest"] * 4


def test_every_fourth_turn_is_of_who_comes_in_and_all_are_if_nobody_asks():
    def begin(rota, done):
        rota.ask(Page("there", rota, done, 9))
        for _ in range(4):
            rota.come_in(lambda: done.append("new"))

    turns = played(begin)
    assert turns[: 2 * FOURTH] == (["there"] * (FOURTH - 1) + ["new"]) * 2
    assert played(lambda rota, done: [rota.come_in(lambda: done.append("new")) for _ in range(3)]) == ["new"] * 3


def test_a_fault_of_one_ends_nobody_elses_turns_and_who_has_left_has_none(caplog):
    def begin(rota, done):
        gone = Page("gone", rota, done)
        for page in (Page("broken", rota, done, fails=True), gone, Page("there", rota, done)):
            rota.ask(page)
        rota.leave(gone)

    assert played(begin) == ["broken", "there"]
    assert "could not be answered" in caplog.text


def test_a_fault_while_a_turn_is_given_stops_no_other_turn(caplog):
    """What is told of the time that one has waited, or a page without turns: both once ended all turns."""

    def begin(rota, done):
        def fails(seconds):
            if rota.waiting == 2:
                raise RuntimeError("no metric")

        rota.waited = fails
        rota.ask(object())
        for name in ("first", "second"):
            rota.ask(Page(name, rota, done))

    assert played(begin) == ["first", "second"]
    assert len(caplog.records) >= 1


def test_network_addresses_come_in_by_turns_whatever_one_asks_for():
    def begin(rota, done):
        for number in range(50):
            rota.come_in(lambda number=number: done.append(f"greedy {number}"), "greedy")
        for number in range(2):
            rota.come_in(lambda number=number: done.append(f"modest {number}"), "modest")

    assert played(begin)[:5] == ["greedy 0", "modest 0", "greedy 1", "modest 1", "greedy 2"]


def test_who_takes_a_turn_is_given_what_he_asked_for_or_its_error():
    async def play():
        rota = Rota()
        given = await rota.take_turn(lambda: 3, "here")
        left = asyncio.ensure_future(rota.take_turn(lambda: 4, "here"))
        await asyncio.sleep(0)
        left.cancel()
        with pytest.raises(ZeroDivisionError):
            await rota.take_turn(lambda: 1 // 0, "here")
        return given, left.cancelled()

    assert talk(play()) == (3, True)
