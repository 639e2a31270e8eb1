"""One browser and its room: opened by a lecturer, or entered by a student; it is served over its own session."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, Protocol

from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.typed import System

from ...picture.state.choices import SETTING
from ...picture.state.chosen_system import NORMAL
from ...picture.state.controls import CONTROL_NAMES, first_values
from ..library import lessons
from .rooms import Guest, GuestRow, RoomError, code_of, process_rooms, settings_of

MAX_KEY_CHARACTERS = 64  # characters of a key or a code
_default_values = cache(first_values)


class SharedView(Protocol):
    """The view of a browser, as far as a room shows it."""

    values: dict[str, Any]
    scene: Scene

    @property
    def portrait_name(self) -> str:
        """Name of the portrait; "" while it has none."""
        ...

    @property
    def last_answer(self) -> tuple[Any, ...]:
        """The lesson, the question answered last, whether rightly, and with which option; () if none was."""
        ...


class Visitor:
    """The room of one browser, if it has opened or entered one.

    Parameters
    ----------
    frames : SharedView
        What it shows.
    address : str
        Of its network.
    """

    def __init__(self, frames: SharedView, address: str = "") -> None:
        self.frames, self.address = frames, address
        self._waiting: dict[str, dict[str, Any]] = {}  # of each kind the newest message, which waits for its turn
        self._opened: tuple[str, Callable[[dict[str, Any]], None]] | None = None
        self._guest: Guest | None = None

    def answer(
        self, request: Any, reply: Callable[[dict[str, Any]], None], later: Callable[[Callable[[], None]], Any]
    ) -> None:
        """Answer a request.

        Parameters
        ----------
        request : object
            As a browser sent it: ``{"open": key}`` ("" for a new room), ``{"close": True}``, ``{"join": code}``,
            ``{"follow": bool}`` or ``{"leave": True}``.
        reply : callable
            Sends ``{"open": code, "key": key}``, ``{"joined": code, "view": settings}``, ``{"ended": code}`` or
            ``{"error": sentence}``; to a lecturer also ``{"rows": list}``, to who follows him ``{"view": settings}``,
            whenever they are others.
        later : callable
            Has a function called by the thread that answers, with the document's lock.
        """
        asked = request if isinstance(request, Mapping) else {}

        def tell(message: dict[str, Any]) -> None:
            (kind, *_) = message
            waits = kind in self._waiting
            self._waiting[kind] = message
            if not waits:
                later(lambda: reply(self._waiting.pop(kind)))

        try:
            if isinstance(key := asked.get("open"), str):
                self._leave_guest()
                key = key if len(key) <= MAX_KEY_CHARACTERS else ""
                if self._opened is not None and self._opened[0] != code_of(key):  # a page has one room
                    process_rooms().close(self._opened[0])
                    self._opened = None
                code, key = process_rooms().open(key, tell, view=self._view, address=self.address)
                self._opened = code, tell
                reply({"open": code, "key": key})
            elif isinstance(code := asked.get("join"), str):
                joined = self._join(code[:MAX_KEY_CHARACTERS], tell)
                reply({"joined": joined, "view": process_rooms().view(joined)})
            elif asked.get("close") is True and self._opened is not None:
                code, _ = self._opened
                self._opened = None
                process_rooms().close(code)
                reply({"ended": code})
            elif isinstance(on := asked.get("follow"), bool) and self._guest is not None:
                process_rooms().follow(self._guest, on)
            elif asked.get("leave") is True:
                self._leave_guest()
        except RoomError as error:
            reply({"error": str(error)})

    def _join(self, code: str, tell: Callable[[dict[str, Any]], None]) -> str:
        guest = process_rooms().join(code, self._row, tell, address=self.address)
        self._leave_guest()
        self._guest = guest
        return guest.code

    def _row(self) -> GuestRow:
        """Return what the room shows of this browser, but for its number."""
        frames = self.frames
        values = self._values()
        open_one = lessons().get(values["lesson"])
        key, question, right, choice = frames.last_answer or ("", -1, False, -1)
        if open_one is None or key != open_one.key:
            question, right, choice = -1, False, -1
        lesson = None if open_one is None else [open_one.title, question, right, choice]
        return [frames.portrait_name, settings_of(values, _default_values(), SETTING), lesson]

    def _values(self) -> dict[str, Any]:
        frames = self.frames
        values = dict(frames.values)
        if values["system"] != NORMAL and isinstance(frames.scene.system, ELinear | System):
            values["parameters"] = dict(frames.scene.system.parameters)  # all, also those as they are at first
        return values

    def _view(self) -> dict[str, Any]:
        """Return what this browser shows, as far as it is other than at first."""
        return settings_of(self._values(), _default_values(), CONTROL_NAMES)

    @property
    def is_in_a_room(self) -> bool:
        """Whether it has opened or entered one."""
        return self._guest is not None or self._opened is not None

    def _leave_guest(self) -> None:
        if self._guest is not None:
            process_rooms().leave(self._guest)
            self._guest = None

    def leave(self) -> None:
        """Its browser has gone."""
        self._leave_guest()
        if self._opened is not None:
            process_rooms().leave_open(*self._opened)
            self._opened = None
