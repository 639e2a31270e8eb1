"""Rooms: opened, entered, told, ended; in one process and in several; and their bounds."""

from weakref import ref

import pytest
from codim2_app.lessons.rooms import rooms as module
from codim2_app.lessons.rooms.board import Board
from codim2_app.lessons.rooms.rooms import (
    CLOSED_SECONDS,
    HOURS,
    LETTERS,
    LINGERS,
    LONGEST_ROW,
    LOST_SECONDS,
    MOST_GUESTS,
    MOST_TRIES,
    SHARING_SECONDS,
    RoomError,
    Rooms,
    code_of,
)


class Page:
    """What one page is told, and the row that it shows."""

    def __init__(self, name="CM4", **settings):
        self.row = [name, settings, None]
        self.heard = []

    def look(self):
        return self.row

    def tell(self, message):
        self.heard.append(message)


@pytest.fixture
def two():
    """The rooms of two processes."""
    board = Board(2)
    pair = []
    for index in (0, 1):
        own = Board(2)
        own._memory = board._memory
        own.belong(index)
        pair.append(Rooms(own))
    return pair


def opened(rooms, now=0.0, key=""):
    lecturer = Page()
    lecturer.heard_by = lecturer.tell  # one and the same each time, as a page has it
    return lecturer, *rooms.open(key, lecturer.heard_by, now)


def tick(*rooms, now):
    return [each.tick(now) for each in rooms]


def rows(lecturer):
    return [message["rows"] for message in lecturer.heard if "rows" in message]


def test_a_lecturer_is_told_of_the_phones_of_all_processes_when_they_are_others(two):
    here, there = two
    lecturer, code, _ = opened(here)
    assert len(code) == 6
    assert set(code) <= set(LETTERS)
    phones = [Page("CM4"), Page("CM2", f1=1.5)]
    guests = [
        rooms.join(typed, phone.look, phone.tell, 1.0)
        for rooms, phone, typed in zip(two, phones, (code, f" {code.lower()} "), strict=True)
    ]
    assert guests[0].number != guests[1].number
    assert all(tick(there, here, now=1.5))
    assert [row[1:] for row in rows(lecturer)[-1]] == [["CM4", {}, None], ["CM2", {"f1": 1.5}, None]]
    tick(there, here, now=2.0)
    assert len(rows(lecturer)) == 1  # nothing has changed
    phones[1].row = ["CM0", {"f1": 2.0}, ["Ball", 0, True]]
    tick(there, here, now=2.5)
    assert rows(lecturer)[-1][1][1:] == ["CM0", {"f1": 2.0}, ["Ball", 0, True]]
    there.leave(guests[1])
    tick(there, here, now=3.0)
    assert [row[1] for row in rows(lecturer)[-1]] == ["CM4"]
    assert phones[0].heard == phones[1].heard == []


def test_all_are_told_when_a_room_is_closed_and_nothing_of_it_is_left(two):
    here, there = two
    _, code, key = opened(here)
    phone = Page()
    there.join(code, phone.look, phone.tell, 1.0)
    here.close(code, 2.0)
    there.tick(2.5)
    assert phone.heard == [{"ended": code}]
    with pytest.raises(RoomError, match="no room"):
        there.join(code, phone.look, phone.tell, 3.0)
    assert opened(here, 3.0, key)[1] != code  # it is not taken up again
    assert here.tick(3.0)
    assert not there.tick(3.0 + SHARING_SECONDS)
    here.tick(2.0 + CLOSED_SECONDS + 1.0)
    assert code not in here.hosts


def test_a_lecturer_who_loads_the_page_again_has_his_room_also_from_another_process(two):
    here, there = two
    lecturer, code, key = opened(here)
    phone = Page()
    guest = here.join(code, phone.look, phone.tell, 0.5)
    here.leave_open(code, lecturer.heard_by, 1.0)
    here.tick(1.5)
    again, same, _ = opened(there, 2.0, key)
    assert same == code
    there.tick(2.5)
    assert [row[0] for row in rows(again)[-1]] == [guest.number]
    there.close(code, 3.0)  # the first process still knows it as a room that waits
    tick(here, there, now=3.5)
    assert phone.heard == [{"ended": code}]
    for now in (3.0 + CLOSED_SECONDS, 3.0 + CLOSED_SECONDS + 2.0):
        tick(here, there, now=now)
    assert code not in here._states(3.0 + CLOSED_SECONDS + 2.0)


def test_the_first_page_of_a_room_that_is_open_twice_does_not_end_it():
    rooms = Rooms()
    first, code, key = opened(rooms)
    second, same, _ = opened(rooms, 1.0, key)
    assert same == code
    rooms.leave_open(code, first.heard_by, 2.0)
    rooms.tick(3.0 + LINGERS)
    assert rows(second)


@pytest.mark.parametrize(
    ("leaves", "ends"), [(True, 1.0 + LINGERS), (False, 3600.0 * HOURS)], ids=["nobody holds it", "hours"]
)
def test_a_room_ends_by_itself(leaves, ends):
    rooms = Rooms()
    lecturer, code, _ = opened(rooms)
    phone = Page()
    rooms.join(code, phone.look, phone.tell, 0.5)
    if leaves:
        rooms.leave_open(code, lecturer.heard_by, 1.0)
    rooms.tick(ends - 1.0)
    assert phone.heard == []
    rooms.tick(ends + 1.0)
    assert phone.heard == [{"ended": code}]
    assert ({"ended": code} in lecturer.heard) == (not leaves)


def test_a_phone_waits_while_the_process_of_its_room_is_started_again(two):
    here, there = two
    _, code, _ = opened(here)
    phone = Page()
    there.join(code, phone.look, phone.tell, 0.0)
    here.board.belong(0)  # begins with nothing
    there.tick(1.0)
    there.tick(1.0 + LOST_SECONDS)
    assert phone.heard == []
    there.tick(1.0 + LOST_SECONDS + 1.0)
    assert phone.heard == [{"ended": code}]


def test_another_key_of_the_same_code_does_not_take_a_room_over(monkeypatch):
    rooms = Rooms()
    _, code, _ = opened(rooms)
    real = code_of
    monkeypatch.setattr(module, "code_of", lambda key: code if key == "forged" else real(key))
    _, other, given = opened(rooms, 1.0, "forged")
    assert other != code
    assert given != "forged"


def test_rooms_and_phones_are_bounded():
    rooms = Rooms(most=2)
    for _ in range(2):
        _, code, _ = opened(rooms)
        rooms.join(code, (phone := Page()).look, phone.tell, 0.0)
    with pytest.raises(RoomError, match="All 2 rooms"):
        opened(rooms)
    rooms.close(code, 1.0)
    code = opened(rooms, 2.0)[1]
    phone = Page()
    for _ in range(MOST_GUESTS):
        rooms.join(code, phone.look, phone.tell, 3.0)
    with pytest.raises(RoomError, match="full"):
        rooms.join(code, phone.look, phone.tell, 3.0)
    with pytest.raises(RoomError, match="no rooms"):
        opened(Rooms(most=0))


def test_settings_that_are_too_long_are_counted_but_not_sent():
    rooms = Rooms()
    lecturer, code, _ = opened(rooms)
    phone = Page("CM4", texts={"U1": "c" * LONGEST_ROW})
    rooms.join(code, phone.look, phone.tell, 1.0)
    rooms.tick(1.5)
    assert [row[1:] for row in rows(lecturer)[-1]] == [["CM4", None, None]]


def test_no_two_phones_have_one_number(two):
    _, code, _ = opened(two[0])
    phone = Page()
    numbers = [rooms.join(code, phone.look, phone.tell, 1.0).number for rooms in (*two, *two, two[0])]
    assert len(set(numbers)) == 5
    alone = Rooms()
    code = opened(alone)[1]
    assert [alone.join(code, phone.look, phone.tell, 1.0).number for _ in range(3)] == [1, 2, 3]


def test_a_lecturer_takes_up_his_room_though_all_are_taken():
    rooms = Rooms(most=1)
    _, code, key = opened(rooms)
    assert opened(rooms, 1.0, key)[1] == code


@pytest.mark.parametrize("jump", [-86400.0, 86400.0])
def test_a_clock_that_is_set_ends_no_room(monkeypatch, jump):
    rooms, lecturer, guest = Rooms(Board(1)), Page(), Page()
    code, _ = rooms.open("", lecturer.tell)
    rooms.join(code, guest.look, guest.tell)
    there = module.time.time()
    monkeypatch.setattr(module.time, "time", lambda: there + jump)
    assert rooms.tick()
    late = Page()
    rooms.join(code, late.look, late.tell)
    assert not any("ended" in message for page in (lecturer, guest, late) for message in page.heard)


def test_a_room_that_had_no_guest_goes_with_its_page():
    """Twenty pages that open one each and leave took all rooms for ten minutes."""
    rooms = Rooms(most=3)
    for _ in range(20):
        lecturer, code, key = opened(rooms)
        rooms.leave_open(code, lecturer.heard_by, 1.0)
        assert rooms.count(1.0) == 0
    assert opened(rooms, 2.0, key)[1] == code  # as a page that is loaded again
    rooms.join(code, (phone := Page()).look, phone.tell, 3.0)
    rooms.leave_open(code, rooms.hosts[code].tell, 4.0)
    assert rooms.count(5.0) == 1


def test_a_room_with_guests_of_another_process_stays(two):
    here, there = two
    lecturer, code, _ = opened(here)
    there.join(code, (phone := Page()).look, phone.tell, 1.0)
    here.leave_open(code, lecturer.heard_by, 2.0)
    assert here.count(3.0) == 1


def test_the_oldest_room_without_a_guest_gives_way_and_its_lecturer_is_told():
    rooms = Rooms(most=2)
    first, code, _ = opened(rooms, 0.0)
    busy = opened(rooms, 1.0)[1]
    rooms.join(busy, (phone := Page()).look, phone.tell, 1.0)
    opened(rooms, 2.0)
    assert first.heard[-1] == {"ended": code}
    assert rooms.count(3.0) == 2
    assert rooms.hosts[busy].is_open(3.0)


def test_a_network_address_has_a_part_of_all_rooms():
    rooms = Rooms(most=8)
    codes = [rooms.open("", Page().tell, 0.0, address="one")[0] for _ in range(2)]
    for code in codes:
        rooms.join(code, (phone := Page()).look, phone.tell, 0.0)
    with pytest.raises(RoomError, match="All 2 rooms"):
        rooms.open("", Page().tell, 1.0, address="one")
    assert rooms.open("", Page().tell, 1.0, address="another")


def test_codes_are_not_tried_from_one_network_address():
    rooms = Rooms()
    code = opened(rooms)[1]
    tries = lambda now: rooms.join("BCDFGH", (phone := Page()).look, phone.tell, now, address="one")
    for i in range(MOST_TRIES):
        with pytest.raises(RoomError, match="no room"):
            tries(0.1 * i)
    with pytest.raises(RoomError, match="Too many"):
        tries(10.0)
    rooms.join(code, (phone := Page()).look, phone.tell, 10.0, address="another")
    with pytest.raises(RoomError, match="no room"):
        tries(70.0)


def test_one_who_cannot_be_shown_stops_no_other_row(caplog):
    rooms = Rooms()
    lecturer, code, _ = opened(rooms)
    other, other_code, _ = opened(rooms)
    broken, phone = Page("CM2"), Page("CM4")
    for page, its in ((broken, code), (phone, code), (Page("NCM2"), other_code)):
        rooms.join(its, page.look, page.tell, 1.0)
    broken.row = ["CM2"]
    other.view = lambda: 1 // 0
    rooms.hosts[other_code].view = other.view
    rooms.tick(2.0)
    assert [row[1] for row in rows(lecturer)[-1]] == ["CM4"]
    assert [row[1] for row in rows(other)[-1]] == ["NCM2"]
    assert "taken out" in caplog.text


def test_half_a_character_is_a_key_like_any_other():
    rooms = Rooms()
    code, key = rooms.open("\ud800", Page().tell, 0.0)
    assert rooms.open(key, Page().tell, 1.0) == (code, key)


@pytest.mark.parametrize("ends", ["leaves", "closes"])
def test_a_room_that_outlives_its_lecturers_page_holds_nothing_of_it(ends):
    rooms, page = Rooms(), Page()
    tell, held = page.tell, ref(page)
    code, _ = rooms.open("", tell, 0.0, page.look)
    rooms.join(code, Page().look, Page().tell, 0.0)
    rooms.leave_open(code, tell, 1.0) if ends == "leaves" else rooms.close(code, 1.0)
    assert code in rooms.hosts
    del page, tell
    assert held() is None
