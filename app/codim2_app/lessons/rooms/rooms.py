"""The rooms of one server process: who has opened one, who is in one, and what the one learns of the others.

A room is a code of six letters. Its lecturer holds a key, of which the code is the digest, so that the room can be
taken up again from another page or process. Who is in it shows a row: a number, the name of his portrait, his
settings, and how far he is in a lesson. A room ends when it is closed, when nobody has held its key for a while, or
after some hours; then nothing of it is left. One that had no guest goes with its page.
"""

from __future__ import annotations

import hashlib
import json
import logging
import secrets
import time
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ...picture.phrases import say
from .board import Board

#: Without vowels no code is a word, and none of these is taken for another, or for a figure.
LETTERS, CODE_LENGTH = "BCDFGHJKLMNPQRSTVWXZ", 6
HOURS = 4.0  # that a room lasts
LINGERS = 600.0  # seconds for which it waits for its lecturer to come back
CLOSED_SECONDS = 120.0  # seconds for which it is known that it was closed
LOST_SECONDS = 60.0  # seconds for which a process that holds it may be gone
# (They are counted by the clock of the machine's start, which all its processes share and nobody sets.)
MOST_ROOMS, MOST_GUESTS, LONGEST_ROW = 20, 300, 2000
SHARE = 4  # of all rooms, one network address has at most this part
MOST_TRIES = 60  # of one network address in a minute, in vain: codes are not to be guessed
SHARING_SECONDS = 0.5  # seconds

#: ``[number, name of the portrait, settings or None, [lesson, question, right] or None]``
GuestRow = list[Any]
Tell = Callable[[dict[str, Any]], None]


class RoomError(ValueError):
    """A room that cannot be opened or entered; its text is a sentence for who asked."""


@dataclass(slots=True)
class Host:
    """The page that has opened a room."""

    code: str
    mark: str
    opened: float
    tell: Tell | None
    view: Callable[[], Any]
    left: float = 0.0
    closed: float = 0.0
    shown: Any = None
    address: str = ""
    had_guest: bool = False

    def release_page(self) -> Tell | None:
        """Hold nothing of the lecturer's page any more; return the channel to it."""
        tell, self.tell, self.view = self.tell, None, dict
        return tell

    def is_open(self, now: float) -> bool:
        """Say whether the room is open."""
        waits = self.tell is not None or now - self.left < LINGERS
        return not self.closed and waits and now - self.opened < 3600.0 * HOURS


@dataclass(slots=True)
class Guest:
    """A page in a room of any process."""

    number: int
    code: str
    look: Callable[[], GuestRow]
    tell: Tell
    missed: float = 0.0
    follows: bool = False
    shown: Any = None  # of the lecturer's view


class Rooms:
    """The rooms of one process.

    Parameters
    ----------
    board : Board, optional
        What all processes share; by default there is but this one.
    most : int
        Rooms that this process opens; 0 for none.
    """

    def __init__(self, board: Board | None = None, most: int = MOST_ROOMS) -> None:
        self.board = board or Board()
        self.most = most
        self.hosts: dict[str, Host] = {}
        self.guests: dict[int, Guest] = {}
        self._count = 0
        self._tried: tuple[int, Counter[str]] = 0, Counter()  # in which minute, by network address
        self._ticks: Callable[[], None] | None = None

    def beat_with(self, begin: Callable[[], None]) -> None:
        """Have `begin` called when somebody comes in; it calls `tick` every `SHARING_SECONDS` while that is True."""
        self._ticks = begin

    def count(self, now: float | None = None) -> int:
        """Return how many rooms are open."""
        now = time.monotonic() if now is None else now
        return sum(host.is_open(now) for host in self.hosts.values())

    # The lecturer ----------------------------------------------------------------------------------------------

    def open(
        self, key: str, tell: Tell, now: float | None = None, view: Callable[[], Any] = dict, address: str = ""
    ) -> tuple[str, str]:
        """Open a room, or take up the one of this key; return its code and its key.

        `view` returns what the lecturer shows: who types the code begins with it. If all rooms are taken, or all that
        his network address may have, the oldest without a guest gives way.

        Raises
        ------
        RoomError
            This server has no room left, or has none at all.
        """
        now = time.monotonic() if now is None else now
        if not self.most:
            raise RoomError(say("no rooms"))
        states = self._states(now)
        code, mark = code_of(key), mark_of(key)
        known = self._openings_of(code, now)
        if not key or states.get(code) == "closed" or any(other != mark for _, other in known):
            known = []
            while not key or code in states:
                key = secrets.token_urlsafe(16)
                code, mark = code_of(key), mark_of(key)
        if code not in self.hosts:
            self._make_room(address, now)
        had_guest = code in self.hosts and self.hosts[code].had_guest
        opened = min((opened for opened, _ in known), default=now)
        self.hosts[code] = Host(code, mark, opened, tell, view, address=address, had_guest=had_guest)
        self._begin(now)
        return code, key

    def _make_room(self, address: str, now: float) -> None:
        """See that one more room may be open, of all and of a network address."""
        there = [host for host in self.hosts.values() if host.is_open(now)]
        own = [host for host in there if host.address == address]
        for rooms, most in ((own, max(1, self.most // SHARE) if address else self.most), (there, self.most)):
            if len(rooms) < most:
                continue
            empty = [host for host in rooms if not self._rows(host.code, now)]
            if not empty:
                raise RoomError(say("all rooms taken", most=most))
            self.close(min(empty, key=lambda host: (host.tell is not None, host.opened)).code, now)
            there = [host for host in there if host.is_open(now)]

    def leave_open(self, code: str, tell: Tell, now: float | None = None) -> None:
        """Note that a lecturer's page has gone: he may come back, but where nobody was a room is not kept."""
        now = time.monotonic() if now is None else now
        host = self.hosts.get(code)
        if host is not None and host.tell is tell:  # else another page holds the room by now
            host.release_page()
            host.left = now
            if not host.had_guest and not self._rows(code, now):
                del self.hosts[code]
                self._write(now)

    def close(self, code: str, now: float | None = None) -> None:
        """Close a room: all who are in it learn it."""
        now = time.monotonic() if now is None else now
        host = self.hosts.get(code)
        if host is not None and not host.closed:
            tell, host.closed = host.release_page(), now
            if tell is not None:
                tell({"ended": code})
            self.tick(now)

    # Who is in it ----------------------------------------------------------------------------------------------

    def join(
        self, code: str, look: Callable[[], GuestRow], tell: Tell, now: float | None = None, address: str = ""
    ) -> Guest:
        """Enter a room.

        Parameters
        ----------
        code : str
            As it was typed.
        look : callable
            Returns the row that the room shows, but for its number.
        tell : callable
            Called with ``{"ended": code}`` when the room ends, and ``{"view": settings}`` while the guest follows.

        Raises
        ------
        RoomError
            There is no such room, it is full, or too many codes were tried from a network address.
        """
        now = time.monotonic() if now is None else now
        code = code.strip().upper()
        minute = int(now / 60.0)
        if self._tried[0] != minute:
            self._tried = minute, Counter()
        if self._tried[1][address] >= MOST_TRIES:
            raise RoomError(say("too many codes"))
        if self._states(now).get(code) != "open":
            self._tried[1][address] += 1
            raise RoomError(say("no such room", code=code[:8]))
        if len(self._rows(code, now)) >= MOST_GUESTS:
            raise RoomError(say("room full", most=MOST_GUESTS))
        self._count += 1
        number = self._count * self.board.processes + self.board.mine  # no other process gives it
        guest = self.guests[number] = Guest(number, code, look, tell)
        if code in self.hosts:
            self.hosts[code].had_guest = True
        self._begin(now)
        return guest

    def view(self, code: str, now: float | None = None) -> Any:
        """Return what the lecturer of a room shows, as far as is known; None where it is not."""
        boards = self.board.read(time.monotonic() if now is None else now)
        return next((one["views"][code] for _, _, one in boards if code in one["views"]), None)

    def follow(self, guest: Guest, on: bool) -> None:
        """Subscribe a student to the lecturer's view, or unsubscribe."""
        guest.follows, guest.shown = on, None
        self._show(guest, time.monotonic())

    def _show(self, guest: Guest, now: float) -> None:
        view = self.view(guest.code, now) if guest.follows else None
        if view is not None and view != guest.shown:
            guest.shown = view
            guest.tell({"view": view})

    def leave(self, guest: Guest) -> None:
        """Take somebody out of his room."""
        self.guests.pop(guest.number, None)

    # All -------------------------------------------------------------------------------------------------------

    def tick(self, now: float | None = None) -> bool:
        """Tell all processes of who is here, the lecturers of who is in their rooms, and these of rooms that ended.

        Returns
        -------
        bool
            Whether anybody is here for whom to do so again.
        """
        now = time.monotonic() if now is None else now
        for code, host in list(self.hosts.items()):
            if not host.closed and not host.is_open(now):
                tell, host.closed = host.release_page(), now
                if tell is not None:
                    tell({"ended": code})
            if host.closed and now - host.closed > CLOSED_SECONDS:
                del self.hosts[code]
        self._write(now)
        states = self._states(now)
        for code, host in self.hosts.items():
            if states.get(code) == "closed" and not host.closed:  # by another process
                host.release_page()
                host.closed = now
        for guest in list(self.guests.values()):
            state = states.get(guest.code)
            guest.missed = 0.0 if state == "open" else guest.missed or now
            if state == "closed" or (guest.missed and now - guest.missed > LOST_SECONDS):
                self.leave(guest)
                guest.tell({"ended": guest.code})
            self._show(guest, now)
        for host in self.hosts.values():
            rows = self._rows(host.code, now)
            host.had_guest = host.had_guest or bool(rows)
            if host.tell is not None and rows != host.shown:
                host.shown = rows
                host.tell({"rows": rows})
        return bool(self.hosts or self.guests)

    def _begin(self, now: float) -> None:
        self._write(now)
        if self._ticks is not None:
            self._ticks()

    def _write(self, now: float) -> None:
        rows: dict[str, list[GuestRow]] = {}
        for guest in list(self.guests.values()):
            try:
                rows.setdefault(guest.code, []).append(_guest_row(guest))
            except Exception:  # his room and all others go on without him
                logging.getLogger(__name__).exception("a guest of a room cannot be shown; he is taken out of it")
                self.leave(guest)
        hosts = {host.code: [host.opened, host.is_open(now), host.closed, host.mark] for host in self.hosts.values()}
        views = {host.code: _view_of(host) for host in self.hosts.values() if host.tell is not None}
        if not self.board.write({"hosts": hosts, "rows": rows, "views": views}, now):
            bare = {code: [[row[0], row[1], None, row[3]] for row in all_] for code, all_ in rows.items()}
            self.board.write({"hosts": hosts, "rows": bare, "views": {}}, now)

    def _states(self, now: float) -> dict[str, str]:
        """Return "open" or "closed" for each room that any process knows."""
        found: dict[str, str] = {}
        for _, _, board in self.board.read(now):
            for code, (_, is_open, closed, _) in board["hosts"].items():
                if closed:
                    found[code] = "closed"
                elif is_open:
                    found.setdefault(code, "open")
        return found

    def _openings_of(self, code: str, now: float) -> list[tuple[float, str]]:
        """Return when a room was opened, and the mark of its key, by each process that knows it."""
        hosts = [board["hosts"][code] for _, _, board in self.board.read(now) if code in board["hosts"]]
        return [(opened, mark) for opened, _, _, mark in hosts]

    def _rows(self, code: str, now: float) -> list[GuestRow]:
        return [row for _, _, board in self.board.read(now) for row in board["rows"].get(code, ())]


def _bytes_of(key: str) -> bytes:
    return key.encode("utf-8", "backslashreplace")  # JSON may hold half of a character


def code_of(key: str) -> str:
    """Return the code of the room of a key."""
    number = int.from_bytes(hashlib.sha256(_bytes_of(key)).digest()[:8], "big")
    letters = []
    for _ in range(CODE_LENGTH):
        number, at = divmod(number, len(LETTERS))
        letters.append(LETTERS[at])
    return "".join(letters)


def mark_of(key: str) -> str:
    """Return what tells the keys of one code apart, and does not give them away."""
    return hashlib.sha256(b"mark " + _bytes_of(key)).hexdigest()[:24]


def _guest_row(guest: Guest) -> GuestRow:
    name, settings, lesson = guest.look()
    return [
        guest.number,
        name,
        _short_settings(settings),
        lesson,
    ]  # without settings it is counted, but cannot be opened


def _view_of(host: Host) -> Any:
    """Return what a lecturer shows; None where that fails, so that the other rooms go on."""
    try:
        return _short_settings(host.view())
    except Exception:
        logging.getLogger(__name__).exception("what the lecturer of a room shows cannot be sent")
        return None


def _short_settings(settings: Any) -> Any:
    """Return settings, or None where they are too long to be shared."""
    return settings if len(json.dumps(settings)) <= LONGEST_ROW else None


def settings_of(values: Mapping[str, Any], first: Mapping[str, Any], names: tuple[str, ...]) -> dict[str, Any]:
    """Return what of the values of controls is other than at first."""
    return {name: values[name] for name in names if values[name] != first[name]}


_served: list[Rooms] = []


def serve_with(rooms: Rooms) -> None:
    """Set the rooms of this process."""
    _served[:] = [rooms]


def process_rooms() -> Rooms:
    """Return the rooms of this process."""
    if not _served:
        serve_with(Rooms())
    return _served[0]
