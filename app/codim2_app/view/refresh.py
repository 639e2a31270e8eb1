"""Turn a request of the browser into a frame: state, then scene, then only what is visible and has changed.

The browser decides when to ask: one request is out at a time and newer values replace older ones there, so that
nothing ever queues here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from typing import Any

from param.parameterized import batch_call_watchers

from codim2_core.portrait.portrait_name import Classification, PortraitName
from codim2_core.results.words import printed_sentence
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.psi.function import Psi
from codim2_core.systems.typed import System

from ..lessons.library import lessons
from ..panels import registry
from ..panels.parameters.axes import opening_axes
from ..picture.draw import glyphs
from ..picture.draw.packing import pack
from ..picture.frame.background_results import Jobs
from ..picture.frame.budget import BackgroundLayers, Budget, OmittedLayer, PendingLayer, layers_of
from ..picture.frame.faults import sentence_of
from ..picture.frame.frame_contents import Blocks, RequestedLayers, make_frame
from ..picture.frame.frame_context import FrameContext
from ..picture.frame.neighbouring_portraits import neighbouring_portraits
from ..picture.frame.process_load import load
from ..picture.frame.scenes import complete_changes, cut_after, evolve_scene, locked_controls, make_scene
from ..picture.frame.window import Window, inputs, resample_for_window
from ..picture.frame.work_queue import FailedResult
from ..picture.phrases import say
from ..picture.slow_layers.typed_start import launch_of
from ..picture.state.choices import SLIDER_AXES
from ..picture.state.chosen_system import GIVEN, NORMAL, System_, describe, rest_sentence, texts_of
from ..picture.state.cleaning import InputError, clean
from ..picture.state.compatible_changes import compatible_changes, culprit
from ..picture.state.controls import TYPED_IN, ExplorerState, first_values, preset_values
from ..picture.state.drag_critical_set import GRAB, PUSH, push_for
from ..picture.state.request_reading import read_request


def left_out(scene: Scene, values: Mapping[str, Any], given: bool) -> list[str]:
    """Say what was requested in vain: parameters and boxes that the system has not, a lesson, a motion's start."""
    said = []
    system = scene.system
    if not isinstance(system, (ELinear, System)):
        return said
    own = () if values["system"] == NORMAL and not given else [*system.parameters]
    boxes = [] if given else list(texts_of(values["system"], {}))
    for key, asked, there in (("no such parameter", "parameters", own), ("no such box", "texts", boxes)):
        unknown = [name[:20] for name in values[asked] if name not in there]
        if unknown:
            has = f"it has {', '.join(there)}" if there else "it has none"
            said.append(say(key, names=", ".join(unknown[:3]), there=has))
    if values["lesson"] and values["lesson"] not in lessons():
        named, some = values["lesson"][:40], ", ".join(list(lessons())[:3])
        said.append(say("no such lesson", name=named, some=some))
    try:
        launch_of(values, system)
    except InputError as error:
        said.append(str(error))
    return said


#: Controls that are axes of the picture's parameters.
MOVED = frozenset(SLIDER_AXES)
#: The control along which a degenerate setting is looked at from both sides, before one is moved.
FIRST_MOVED = "f1"
#: Controls that say which parameters there are.
AXES_OF = frozenset({"system", "texts", "psi"})
#: Layers that others start from, and that are small: whoever computes those is given these.
STANDING = frozenset({"equator", "equator_cycle", "location", "critical", "name", "classification", "slow_flow"})
#: How often a frame is begun anew because what it lacked is there.
MOST_ROUNDS = 4


class Frames:
    """The picture of one browser: its state, its scene, and which results it has been sent.

    Parameters
    ----------
    state : ExplorerState
    system : ELinear or System, optional
        Drawn instead of one that the controls choose.
    ready : callable, optional
        Says whether all layers of this Psi and system can be drawn without waiting, also while a control may be moving;
        until then trajectories are left out.
    errors : sequence of InputError
        What the address requested in vain, sent with the first frames.
    budget : Budget, optional
        What may be computed here and now, where others wait meanwhile; by default everything.
    """

    def __init__(
        self,
        state: ExplorerState,
        system: System_ | None = None,
        ready: Callable[[Psi, Any, bool], bool] = lambda _psi, _at, _moving: True,
        errors: Sequence[InputError] = (),
        budget: Budget | None = None,
    ) -> None:
        self.state = state
        self.budget = budget
        self.given = None if system is None else dict(system.parameters)
        self.own = system
        #: What was requested last and could not be drawn, by control, as it was given; requested again with each frame.
        self.refused: dict[str, Any] = {e.control: e.given for e in errors if e.control in TYPED_IN}
        self._notices = [str(error) for error in errors if error.control not in TYPED_IN]
        self._unpublished: dict[str, Any] = {}
        self._begin(state.values())
        if budget is not None:
            self.scene.ask_before(budget.check_cost)
        self._notices += left_out(self.scene, self.values, self.given is not None)
        self.locked = locked_controls(self.scene, self.given is not None)
        axes = opening_axes(self.scene, self.values, self.locked)
        self.values |= axes
        self._unpublished |= axes
        self.ready = ready
        self.jobs = Jobs()
        self.window: Window | None = None
        self._moved = FIRST_MOVED  # the control moved last
        self._moving = False  # a control may be
        self._sent: dict[str, Any] = {}
        self._last: tuple[Mapping[str, Any], dict[str, Any], str] = ({}, {}, "")  # see `keep`
        self._unsent: dict[str, Any] = {}

    def _begin(self, wanted: Mapping[str, Any]) -> None:
        """Start from these values or, where they have no scene, from those of their portrait or the first ones."""
        try:
            self.scene, self.values = make_scene(wanted, self.own), dict(wanted)
        except Exception as error:  # a link that cannot be drawn opens on what can, and the log has the rest
            sentence_of(error, "a first picture")
            self.values = preset_values(wanted["preset"]) or first_values()
            self.scene = make_scene(self.values, self.own)
            self.refused |= {name: value for name, value in wanted.items() if value != self.values[name]}
            self._unpublished |= {name: self.values[name] for name in self.refused}

    def answer(self, request: Mapping[str, Any]) -> bytes:
        """Return the frame for ``{"id": number, "set": {control: value}, "all", "rest": bool}``.

        ``all`` asks for every layer again, as a browser does that has just connected; ``rest`` says that no control
        is moving, so that there is time for the open panel. A value that cannot be used, and a
        computation that fails, leave the last good picture: ``errors`` then holds the name of the control and a
        sentence, in this frame and in all that follow until that control is given another value. Under the name ""
        is what belongs to no control.
        """
        request, asked, left = read_request(request)
        self.window = Window.read(request.get("window"))
        sent = {} if request.get("all") else self._sent
        if asked:
            self._notices = []
        before = self.values
        notices = " ".join(filter(None, (*self._notices, left)))
        errors: dict[str, str] = {"": notices} if notices else {}
        good: dict[str, Any] = {}
        refused = {name: value for name, value in self.refused.items() if GRAB not in asked or name not in PUSH}
        wanted, self.refused = {**refused, **asked}, {}
        for name, value in wanted.items():  # in the order in which they were set
            try:
                held = name == GRAB
                good |= push_for(self.scene, self.values | good, value) if held else {name: clean(name, value)}
            except InputError as error:
                self.refused[name], errors[error.control] = value, str(error)
        rest = request.get("rest", False) or request.get("all", False)
        self._moving = not request.get("rest", False)
        header, blocks = self._accept(good, sent, errors, rest) or ({}, {})
        if "fault" in header:  # of a panel
            errors.setdefault("", header.pop("fault"))
        changed = {name: value for name, value in self.values.items() if value != before[name]}
        self._unpublished.update(changed)
        changes = {name: self.values[name] for name in {**self._unsent, **changed}}
        self._last, self._unsent = (sent, changes, left), {}
        if changes:
            header["set"] = changes
        errors = {name: printed_sentence(said) for name, said in errors.items()}
        return self._pack({"id": request.get("id", 0), "errors": errors, "load": load.measure(), **header}, blocks)

    def note(self, given: Any) -> None:
        """Take the values of a page that draws itself, by control: rooms and files go by them. Nothing is drawn."""
        good: dict[str, Any] = {}
        for name, value in read_request({"set": given})[1].items():
            if value != self.values.get(name):
                with suppress(InputError):  # the page says so
                    good[name] = clean(name, value)
        before = self.values
        try:
            self.values, _, self.scene = self._reach(good)
        except Exception:  # the page says which of them cannot be had
            self.values, _, self.scene = self._reach(compatible_changes(good, self._reach)[0])
        self._unpublished.update({name: value for name, value in self.values.items() if value != before[name]})
        self.publish()
        if self.budget is not None:
            self.budget.begin()
        with suppress(PendingLayer, OmittedLayer):
            self._sent = {**self._sent, "classification": self.scene["name"]}

    def keep(self) -> None:
        """Note that the last frame was not sent: what it said is said by the next one."""
        self._sent, self._unsent, left = dict(self._last[0]), self._last[1], self._last[2]
        if left:
            self._notices.append(left)

    def _pack(self, header: dict[str, Any], blocks: Blocks) -> bytes:
        drawn = self._sent.get("cycles") if "cycles" in self.values["layers"] else None
        cycles = getattr(drawn, "cycles", ())  # orbits keep away from these
        guards = glyphs.join([one.points for one in cycles]) if cycles else None
        if self.window is None:
            return pack(header, blocks, guards=guards)
        return pack(header, blocks, self.window.rectangle, self.window.pixel, guards=guards)

    def _accept(
        self, good: Mapping[str, Any], sent: Mapping[str, Any], errors: dict[str, str], rest: bool
    ) -> tuple[dict[str, Any], Blocks] | None:
        """Draw with all changes or, where that fails, with as many of them as can be had together."""
        try:
            return self._draw(good, sent, rest)
        except Exception as error:  # one change must not take the others with it
            said = sentence_of(error, "a frame")
            if not good:
                errors[culprit(error, "")] = said
                return None
        had, failed = compatible_changes(good, self._reach)
        try:
            drawn = self._draw(had, sent, rest)
        except Exception:  # a scene there is, but it cannot be drawn: so each is tried to the end
            had, failed = compatible_changes(good, lambda changes: self._draw(changes, sent, False))
            try:
                drawn = self._draw({}, sent, rest)
            except Exception as error:  # what was drawn before cannot be drawn again: the browser keeps what it has
                errors[""] = sentence_of(error, "a frame")
                return None
        self.refused |= {name: good[name] for name in failed}
        errors |= {culprit(error, name): sentence_of(error, f"the control {name}") for name, error in failed.items()}
        return drawn

    def _reach(self, changes: Mapping[str, Any]) -> tuple[dict[str, Any], list[str], Scene]:
        """Return the values after some changes, the names of those that are other than before, and their scene."""
        if self.given is None:
            changes = complete_changes(self.values, changes)
        values = {**self.values, **changes}
        changed = [name for name in changes if values[name] != self.values[name]]
        scene = evolve_scene(self.scene, values, [name for name in changed if name not in self.locked], self.given)
        if "cut" not in changed:
            values["cut"] = cut_after(self.scene, scene, changed)
            scene = scene if scene.cut == values["cut"] else scene.evolve(cut=values["cut"])
        if AXES_OF.intersection(changed):
            values |= opening_axes(scene, values, self.locked)
        return values, changed, scene

    def _draw(self, changes: Mapping[str, Any], sent: Mapping[str, Any], rest: bool) -> tuple[dict[str, Any], Blocks]:
        values, changed, scene = self._reach(changes)
        scene = resample_for_window(scene, self.window, rest)
        ready = self.ready(scene.psi, scene.coefficients, self._moving)
        drawable = ready or scene.coefficients.as_given is not None  # all of a general system needs the compiler
        if "preset" in changes:  # a whole state: nothing was moved
            self._moved = FIRST_MOVED
        else:
            self._moved = next((name for name in changed if name in MOVED), self._moved)
        header: dict[str, Any] = {"ready": False}
        blocks: Blocks = {}
        now_sent = dict(sent)
        for _ in range(MOST_ROUNDS if drawable else 0):
            asked = RequestedLayers(scene)
            if self.budget is not None:
                self.budget.begin()
            header, blocks, now_sent = make_frame(scene, values, sent, ready, self.window, asked)
            if header.get("portrait", {}).get("degeneracies"):
                self._add_sides(header, scene, values)
            late = asked.missing, asked.left_out
            draft = FrameContext(scene, values, header, blocks, now_sent, self.jobs, rest, ready, self.locked, *late)
            registry.add(draft)
            if asked.left_out:
                header["left_out"] = OmittedLayer.sentence(asked.left_out)
            if not asked.missing or not self._compute_beside(scene, asked.missing, header):
                break
        self._tell_system(header, scene, values, now_sent)
        if scene.pixel > inputs(self.window, rest=True)["pixel"]:
            header.setdefault("late", []).append("window")  # at rest it is drawn as finely as it is seen
        self.scene, self.values, self._sent = scene, values, now_sent
        return header, blocks

    def _add_sides(self, header: dict[str, Any], scene: Scene, values: Mapping[str, Any]) -> None:
        """Add what lies on both sides of a degenerate setting; of typed formulas it is computed in the background."""
        if self.budget is None or self.budget.is_bounded(scene):
            header["portrait"]["sides"] = neighbouring_portraits(scene, values, self._moved)
            return
        key = (scene.key("plane", "slow", "psi", "place"), self._moved)
        found = self.jobs.ask("sides", key, _sides_of, scene, dict(values), self._moved)
        if found is None:
            header.setdefault("late", []).append("sides")
        elif not isinstance(found, FailedResult):
            (header["portrait"]["sides"],) = found

    def _compute_beside(self, scene: Scene, missing: Sequence[str], header: dict[str, Any]) -> bool:
        """Have layers computed in the background; say whether they are there."""
        assert self.budget is not None  # it says what is missing
        names = tuple(dict.fromkeys(missing))
        known = {name: result for name, result in scene.results().items() if name in names or name in STANDING}
        found = self.jobs.ask("picture", (Budget.key(scene), names), layers_of, scene, names, known)
        if found is None:
            header.setdefault("late", []).append("picture")
            return False
        if isinstance(found, FailedResult):
            found = BackgroundLayers({}, {}, dict.fromkeys(names, found.sentence.rstrip(".")))
        self.budget.record_costs(scene, found)
        return True

    @property
    def portrait_name(self) -> str:
        """Name of the portrait that the browser has; "" while it has none."""
        name = self._sent.get("classification")
        return name.name if isinstance(name, Classification | PortraitName) else ""

    @property
    def last_answer(self) -> tuple[Any, ...]:
        """The lesson, the question answered last, whether rightly, and with which option; () if none was."""
        return self._sent.get("answered", ())

    @property
    def pending(self) -> Future[Any] | None:
        """Return the future of the layers that are computed in the background, if the picture waits for any."""
        return self.jobs.future("picture")

    def _tell_system(
        self, header: dict[str, Any], scene: Scene, values: Mapping[str, Any], now: dict[str, Any]
    ) -> None:
        """Describe the system when its formulas are others than those that the browser has."""
        choice = values["system"] if self.given is None else GIVEN
        key = (choice, tuple(values["texts"].items()))
        if now.get("system") != key and isinstance(scene.system, ELinear | System):
            now["system"] = key
            header["system"] = describe(choice, scene.system, values["texts"])
        own = (choice, tuple(values["parameters"].items()))
        if now.get("at_rest") != own:
            now["at_rest"] = own
            header["at_rest"] = rest_sentence(choice, values["parameters"])

    def publish(self) -> None:
        """Let the state follow what has been drawn, as one change; its watchers run now.

        Called when the frame is on its way, so that a watcher that sets further values asks for a frame after it.
        """
        fresh, self._unpublished = self._unpublished, {}
        if len(fresh) == 1:
            setattr(self.state, *next(iter(fresh.items())))  # param's batches cost as much as half of a frame's bytes
        elif fresh:
            with batch_call_watchers(self.state):
                for name, value in fresh.items():
                    setattr(self.state, name, value)

    def follow(self, changes: Mapping[str, Any]) -> bytes | None:
        """Return the frame for values that the state was given from outside, or None if they are those drawn.

        A portrait brings its values.

        Raises
        ------
        ValueError
            A value cannot be used, or the system gives it as text; the state is then what it was, as is the picture.
        """
        wanted = {name: value for name, value in changes.items() if value != self.values[name]}
        if not wanted:
            return None
        refused = [name for name in wanted if name in self.locked]
        before = self.values
        try:
            if refused:
                raise ValueError(f"{', '.join(refused)}: given by your system, and so not to be set.")
            clean("preset", wanted.get("preset", ""))
            wanted = {**preset_values(wanted.get("preset")), **wanted}
            good = {name: clean(name, value) for name, value in wanted.items() if name not in self.locked}
            header, blocks = self._draw(good, self._sent, rest=False)
        except Exception as error:  # in a notebook: the widget keeps what it shows, the cell has the error
            self._unpublished.update({name: self.values[name] for name in changes})
            self.publish()
            raise ValueError(sentence_of(error, "a frame")) from error
        self.refused = {name: value for name, value in self.refused.items() if name not in wanted}
        header["set"] = {name: value for name, value in self.values.items() if value != before[name]}
        self._unpublished.update(header["set"])
        return self._pack({"errors": {}, **header}, blocks)


def _sides_of(scene: Scene, values: Mapping[str, Any], control: str) -> tuple[dict[str, Any] | None]:
    return (neighbouring_portraits(scene, values, control),)
