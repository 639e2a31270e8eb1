"""The explorer as one component: the same class in a page and in a notebook.

The server writes the markup, Bokeh holds the picture, and one hand-made front end (static/*.js) drives both. A
request and its frame are two small events past all property syncing, so that a tick is one message each way.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from difflib import get_close_matches
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar

import panel as pn
import param
from bokeh.document import Document
from bokeh.models import StyledElement
from panel.custom import JSComponent
from panel.io.save import Comm  # pyright: ignore[reportPrivateImportUsage] (the one that its files are made with)
from panel.models.esm import DataEvent, ESMEvent
from panel.viewable import Child
from param.parameterized import resolve_value
from tornado.ioloop import IOLoop

from codim2_core.scene import Scene
from codim2_core.scene.launched_orbits import LaunchedOrbits

from ..exports.figure import figure
from ..exports.printing import pdf, png
from ..exports.view import View
from ..picture.draw.figure import make_figure
from ..picture.draw.packing import pack, unpack
from ..picture.draw.still import page_of, still
from ..picture.frame.document_callbacks import next_tick_scheduler
from ..picture.frame.frame_contents import make_frame
from ..picture.phrases import say
from ..picture.state.chosen_system import System_
from ..picture.state.controls import CONTROL_NAMES, ExplorerState
from .answers import AnswerQueue
from .cell import Cell, running_kernel
from .markup import SCRIPT_FOLDER, digest, edition, explorer_html, first_words, offered_text, script, settings
from .refresh import Frames
from .shared import SHARED_CONTROLS, ControlTypes, declare, join
from .warmup import is_ready


def with_parameters(kind: Any, system: System_ | None) -> Any:
    """Return a kind of explorer that has the parameters of a system; its own names stay what they are."""
    names = [] if system is None else [name for name in system.variable if not hasattr(kind, name)]
    if system is None or not names:
        return kind
    declared = {name: param.Number(system.value_of(name), label=name) for name in names}
    hidden = {**kind._rename, **dict.fromkeys(names)}  # noqa: SLF001 (Panel names what the browser does not get so)
    return type(kind.__name__, (kind,), {**declared, "_rename": hidden, "_own": tuple(names), "__doc__": kind.__doc__})


def join_parameters(view: Any, names: tuple[str, ...]) -> None:
    """Let parameters of the view be those of its state, both ways."""

    def to_state(*changes: Any) -> None:
        view.state.parameters = {**view.state.parameters, **{one.name: one.new for one in changes}}

    def from_state(*_: Any) -> None:
        given = view.state.parameters
        view.param.update(**{name: given[name] for name in names if name in given})

    from_state()
    view.param.watch(to_state, list(names))
    view.state.param.watch(from_state, "parameters")


COMPILING = say("compiling")


def is_marimo(comm: Any) -> bool:
    """Whether a comm is marimo's, whose pages drop messages: they hear of parameters only."""
    return type(comm).__module__.partition(".")[0] == "marimo"


class Comms(dict[str, Any]):
    """Comms of a view by model; marimo binds all `values` to the cell that it shows last: its own alone."""

    def values(self) -> Any:
        """Return the newest one."""
        return list(super().values())[-1:]


def _is_static(doc: Any, comm: Any) -> bool:
    """Whether nothing will answer: a file that is saved (with a comm of no kernel), or a widget."""
    return getattr(doc, "session_context", None) is None and (comm is None or type(comm) is Comm)


class ExplorerView(JSComponent, ControlTypes):
    """The live explorer.

    Parameters
    ----------
    state : ExplorerState, optional
    system : ELinear or System, optional
        Drawn instead of one that the controls choose; its parameters get sliders.
    **params
        Of any Panel component: sizing_mode, width, height, margin, styles, stylesheets, …; and values of the state.

    All values of the state but `orbits` are parameters of the view too: ``view.a = -1``, ``view.param.watch``,
    ``pn.bind(f, view.param.a)``, ``view.link(slider, a="value", bidirectional=True)``.
    """

    #: They are the state's, and go to the browser as frames.
    _rename: ClassVar[Mapping[str, str | None]] = dict.fromkeys(SHARED_CONTROLS)

    picture = Child()
    config = param.Dict({})
    offered = param.String("")
    first = param.Bytes(b"")
    markup = param.String("")
    latest = param.Bytes(b"")  # the last frame, where a page hears of parameters only

    _own: ClassVar[tuple[str, ...]] = ()  # parameters of its system
    _made = False

    _esm = script()

    @classmethod
    def _render_esm(cls, compiled: Any = True, server: bool = False) -> str:  # noqa: ARG003
        """Return the script as it is: Panel would look for indents to take away, for each page anew."""
        return script()

    def __init__(
        self,
        state: ExplorerState | None = None,
        system: System_ | None = None,
        **params: Any,
    ) -> None:
        given = {name: params.pop(name) for name in SHARED_CONTROLS if name in params}
        values = {name: resolve_value(value) for name, value in given.items()}
        self.state = ExplorerState.from_values(values) if state is None else state
        if state is not None:
            state.param.update(**values)
        self._opened: dict[str, Any] = {}
        self._system = system
        self._given_params = params
        self.frames = Frames(self.state, system, is_ready)
        self._answers: AnswerQueue | None = None
        self._cell: Cell | None = None
        self._first_values = self.state.values()
        own = (SCRIPT_FOLDER / "notebook.css").read_text(encoding="utf-8")
        layout = {**params, "stylesheets": [own, *params.get("stylesheets", ())]}
        if not {"sizing_mode", "width"} & params.keys():
            layout["sizing_mode"] = "stretch_width"
        picture = pn.pane.Bokeh(make_figure(), sizing_mode="stretch_both")
        opening = self._opening()
        drawn = {name: value for name, value in self.state.values().items() if name in SHARED_CONTROLS}
        linked = {name: value for name, value in given.items() if value is not values[name]}
        super().__init__(picture=picture, **opening, **layout, **{**drawn, **linked})
        self._comms = Comms()
        self.state.param.watch(self._follow, list(CONTROL_NAMES))
        join(self, self.state)
        if self._own:
            join_parameters(self, self._own)
        self._made = True

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse a name that nothing reads."""
        if not (self._made and name[0] != "_") or hasattr(self, name):
            super().__setattr__(name, value)
            return
        near = get_close_matches(name, [*SHARED_CONTROLS, *self._own], n=3)
        raise AttributeError(f"{name!r} is no parameter of this explorer; near it are: {', '.join(near) or 'none'}")

    def __repr__(self, *_: Any) -> str:
        """Return what is drawn, in a line."""
        return f"<explorer of {self.scene!r:.200}>"

    @property
    def scene(self) -> Scene:
        """The scene that is drawn."""
        return self.frames.scene

    @property
    def orbits(self) -> LaunchedOrbits:
        """The launched orbits: their lines, and where each goes to and comes from."""
        return self.frames.scene["launched"]

    def clone(self, **params: Any) -> ExplorerView:
        """Return another explorer of the same system, at the present values, with some parameters changed."""
        state = ExplorerState(**self.state.values())
        return type(self)(state, self._system, **{**self._given_params, **params})

    def _opening(self) -> dict[str, Any]:
        """Return what a browser starts from: the values of the controls, the first frame and the markup."""
        first = self.frames.answer({"all": True, "rest": True})
        self.frames.publish()  # what cannot be drawn is not in the state
        self._opened = self.frames.values
        header, _ = unpack(first)
        self._whole = bool(header.get("ready"))
        self.refused = tuple(header.get("errors", {}).values())
        config = {
            **settings(self.state, self.frames.locked),
            "edition": edition(),
            "page": False,
            "refused": self.frames.refused,
            "dark": pn.config.theme == "dark",
            "defaults": self._first_values,  # what a notebook opened with is its first setting
        }
        given = self.frames.given is not None
        words = first_words(header, first, self.state.layers)
        markup = explorer_html(self.state, words, ("system",) if given else ())
        return {"config": config, "offered": offered_text(), "first": first, "markup": markup}

    def get_root(self, doc: Any = None, comm: Any = None, preprocess: bool = True) -> Any:
        """Return the Bokeh model, without Panel's style sheets, which come from a public host in some set-ups.

        (A page that one server process wrote and another one answers; reused sessions; notebooks.) The explorer's
        own style sheet is in its markup.
        """
        root = super().get_root(doc, comm, preprocess)
        # A bundle is run as it is; else the browser would compile the script, which it reads, for 130 ms.
        root.update(bundle=digest())
        for model in root.references():
            sheets: Any = model.stylesheets if isinstance(model, StyledElement) else ()
            if sheets:
                model.update(stylesheets=[sheet for sheet in sheets if isinstance(sheet, str)])
        return root

    def _get_model(self, doc: Any, root: Any = None, parent: Any = None, comm: Any = None) -> Any:
        """Return the Bokeh model, also within a layout: of a file the finished picture, and of what is now."""
        static = _is_static(doc, comm)
        if static:
            self._wait()
        changed = self._models or self._opened is not self.frames.values
        if changed or (static and not self._whole):
            # a notebook shows it once more, or after its state was changed: as it is now
            self.param.update(**self._opening())
        return super()._get_model(doc, root, parent, comm)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Any:
        """Return what a notebook's cell shows."""
        if running_kernel() is None or pn.config.comms != "default":
            return super()._repr_mimebundle_(include, exclude)
        if self._cell is None:
            self._cell = Cell(self)
        return self._cell.outputs()

    def still(self, patient: bool = True) -> tuple[str, str, bool]:
        """Return the picture of the present state as an SVG file, its sentence, and whether nothing is left out.

        Patient: waits for the compiler, so that nothing is.
        """
        scene, values = self.frames.scene, self.frames.values
        ready = self._wait() if patient else is_ready(scene.psi, scene.coefficients)
        if not ready and scene.coefficients.as_given is None:
            return still(pack({}, {}), values["layers"]), COMPILING, False
        header, blocks, _ = make_frame(scene, values, {}, ready)
        sentence = header["portrait"]["sentence"]
        return still(pack(header, blocks), values["layers"]), sentence if ready else f"{sentence} {COMPILING}", ready

    def _wait(self) -> bool:
        """Wait until the integrator is compiled for what is drawn."""
        scene = self.frames.scene
        while not is_ready(scene.psi, scene.coefficients):
            time.sleep(0.05)
        return True

    def save(self, filename: Any, title: str | None = None, *arguments: Any, **options: Any) -> None:
        """Save the picture of the present state, which needs neither Python nor scripts: as a page or as a figure.

        Parameters
        ----------
        filename : str or path
            Ends in ``.html`` or ``.svg``, or, as `codim2 figure` draws it (extra ``figures``), in ``.png`` or ``.pdf``.
            What else Panel saves, and all of its options, are as in any component.
        title : str, optional
            Of the page.
        """
        kind = Path(filename).suffix if isinstance(filename, (str, PathLike)) else ""
        if arguments or options or kind not in (".html", ".svg", ".png", ".pdf"):
            super().save(filename, title, *arguments, **options)
            return
        if kind in (".png", ".pdf"):
            drawn = figure(View(self.frames.values, system=self._system))
            Path(filename).write_bytes(png(drawn) if kind == ".png" else pdf(drawn))
            return
        svg, sentence, _ = self.still()
        text = svg if kind == ".svg" else page_of(svg, sentence, title or sentence.partition(". ")[0])
        Path(filename).write_text(text, encoding="utf-8")

    def live(self) -> tuple[Any, str]:
        """Return a new Bokeh model that is joined to a page by a comm, and HTML that shows it."""
        doc, comm = Document(), pn.state._comm_manager.get_server_comm()  # noqa: SLF001 (as Panel's own views do)
        model = self._render_model(doc, comm)
        shown, _ = self._render_mimebundle(model, doc, comm)
        return model, shown["text/html"]

    def forget(self, model: Any) -> None:
        """Forget a model that no page shows any more."""
        pn.state._views.pop(model.ref["id"], None)  # noqa: SLF001 (as Panel's own views do)
        self._cleanup(model)

    def _register_events(self, *event_names: str, model: Any, doc: Any, comm: Any) -> None:
        """Listen to the browser.

        On a server the request is answered within Bokeh's own handling of the event, where the document's lock is
        held: Panel's scheduling would cost more than the frame, and threads more than they gain. Notebooks go Panel's
        way.
        """
        if comm is None and "data_event" in event_names:
            model.on_event("data_event", self._answer)
        else:
            super()._register_events(*event_names, model=model, doc=doc, comm=comm)

    def _answer(self, event: DataEvent) -> None:
        model = event.model
        if len(self._models) > 1 or model is None or model.document is None:
            self._handle_msg(event.data)
        else:
            if self._answers is None:
                later, after = next_tick_scheduler(model.document), IOLoop.current().call_later
                self._answers = AnswerQueue(self.frames, partial(_send, model), later, after)
                model.document.on_session_destroyed(lambda _: self._leave())
            self._answers.answer(event.data or {})

    def _leave(self) -> None:
        """Stop what is computed for this view alone: its browser has gone."""
        if self._answers is not None:
            self._answers.leave()
            self._answers = None

    def _handle_msg(self, data: Any) -> None:
        """Answer a request of one browser with one frame to all that show this view."""
        self._send_msg({"frame": self.frames.answer(data or {})})
        self.frames.publish()
        self._settle()

    def _send_msg(self, data: Any) -> None:
        """Send to all that show this view, also where an ipywidget holds the model in a document of its own."""
        super()._send_msg(data)
        for ref, (model, _) in self._models.items():
            known = pn.state._views.get(ref)  # noqa: SLF001 (Panel has no public way)
            if known is not None and is_marimo(known[3]):
                self.latest = data["frame"]
            if model.document is not None and (known is None or known[2] is not model.document):
                model.document.callbacks.send_event(ESMEvent(model=model, data=data))

    def _follow(self, *changes: param.parameterized.Event) -> None:
        """Draw what the state was given in Python; what it was given by `publish` is drawn already."""
        frame = self.frames.follow({change.name: change.new for change in changes})
        if frame is not None:
            self._send_msg({"frame": frame})
            self.frames.publish()
            self._settle()

    def _settle(self) -> None:
        if self._cell is not None:
            self._cell.refresh_still()

    def watch(self, callback: Callable[..., None], *names: str) -> None:
        """Call `callback` when one of the named values of the state has changed."""
        self.state.param.watch(callback, list(names))


def _send(model: Any, message: dict[str, Any]) -> None:
    """Send to the one page that shows a model, if it is still there."""
    if model.document is not None:
        model.document.callbacks.send_event(ESMEvent(model=model, data=message))


declare(ExplorerView)
