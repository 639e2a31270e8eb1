"""What a visitor may send: formulas, links, requests. Each target takes one and checks what is answered."""

from __future__ import annotations

import base64
import json
import time
import zlib
from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any

from codim2_app.exports.export_request import ExportRequest, seen_by
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.frame.budget import Budget
from codim2_app.picture.frame.faults import FAULT
from codim2_app.picture.phrases import say
from codim2_app.picture.state.chosen_system import BOXES
from codim2_app.picture.state.controls import CONTROL_NAMES, ExplorerState
from codim2_app.picture.state.links import read_link
from codim2_app.view.refresh import Frames
from hypothesis import strategies as st

from codim2_core.formulas.expression import parse
from codim2_core.formulas.reader import ExpressionError

SECONDS = 2.0  # of processor time that one input may take of the thread that answers all, on a slow machine
LONGEST = 1200  # characters of what is told


def said(sentence: object) -> None:
    """Check that something is said, and not more than can be read."""
    assert 0 < len(str(sentence)) < LONGEST, len(str(sentence))


class Nobody(Executor):
    """Computes nothing: what is asked of it is never there."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        return Future()


NOBODY = Nobody()


def formula(text: str) -> None:
    """Read a formula or refuse it; what is read has a value, a derivative, and reads back equal."""
    try:
        found = parse(text, ("s", "c", "z"))
    except ExpressionError as error:
        said(error)
        return
    at = {"s": 0.6, "c": 0.8, "z": -0.3}
    assert isinstance(found.evaluate(at), float)
    assert isinstance(found.derivative("s").evaluate(at), float)
    if len(found.text) < 1000:
        assert parse(found.text, ("s", "c", "z")) == found


def link(query: dict[str, str]) -> None:
    """Read a link: whatever is in it, there is a state, and a first frame of it."""
    opened = read_link(query)
    for error in opened.errors:
        said(error)
    answered(frames(opened.state, opened.errors), {"all": True})


def requests(asked: list[Any]) -> None:
    """Answer one request after the other in one session."""
    session = frames(ExplorerState())
    for request in asked:
        if isinstance(request, dict) and "take" in request:
            take(session, request["take"])
        else:
            answered(session, request)


def frames(state: ExplorerState, errors: Any = ()) -> Frames:
    """A session whose slow work is never done."""
    made = Frames(state, None, lambda psi, system, _: psi.expression is None and system.typed is None, errors, Budget())
    made.jobs = Jobs(NOBODY)
    return made


def answered(session: Frames, request: Any) -> None:
    header, _ = unpack(session.answer(request))
    json.dumps(header, allow_nan=False)
    for sentence in header.get("errors", {}).values():
        assert sentence != FAULT
        assert say("address failed") not in sentence
        said(sentence)


def take(session: Frames, request: Any) -> None:
    """Read a wish for a file, or refuse it."""
    try:
        ExportRequest.read(request)
    except ValueError as error:
        said(error)
        return
    seen_by(request, session.values, session.own)


TARGETS: dict[str, Callable[[Any], None]] = {"formula": formula, "link": link, "requests": requests}

_CALLS = ["sin", "cos", "exp", "abs", "min", "max", "sign", "sqrt", "atan", "tanh", "log"]
_TOKENS = [
    *"+-*/^().,[]_ 019", *(f"{name}(" for name in _CALLS), "**", "1e308", "1e-320", "0.1", "s", "c", "z", "pi", "e",
    "s^2", "c*s", "θ", "\x00", "1/0", "__", "#",
]  # fmt: skip
_NUMBERS = st.sampled_from(
    ["", "0", "-1", "1e308", "1e-320", "nan", "inf", "-0", "0x10", "1_0", "１", "1,5", "1e400", "−1"]
)
_KEYS = st.sampled_from([*CONTROL_NAMES, "v", "s", "seen", "embed", "controls"])
FORMULAS = st.lists(st.sampled_from(_TOKENS), max_size=40).map("".join) | st.text(max_size=40)
_WORDS = st.sampled_from([
    "typed", "normal", "own", "ball_in_pool", "custom", "hill", "tanh", "case1-cm0", "fig-3", "inside", "U1", "U2", "V",
    "W", "orbits", "psi", "solid", "tables", "f1", "z", "along", "plane",
])  # fmt: skip
_TEXTS = FORMULAS | _NUMBERS | _WORDS
_NESTED = st.recursive(_TEXTS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(_WORDS, inner, max_size=3))
_SQUEEZED = (st.binary(max_size=60) | st.text(max_size=60).map(str.encode)).map(
    lambda data: base64.urlsafe_b64encode(zlib.compress(data, 9)[2:-4]).decode().rstrip("=")
)
_JSON = _NESTED | st.none() | st.booleans() | st.integers() | st.floats() | st.sampled_from([10**400, -(10**400)])
_VALUES = _JSON | st.lists(_JSON, max_size=5) | st.dictionaries(_WORDS, _JSON, max_size=4)
_BOXES = st.sampled_from(sorted({box.name for boxes in BOXES.values() for box in boxes}))
_TYPED = {
    "texts": st.dictionaries(_BOXES, FORMULAS, max_size=3),
    "psi_text": FORMULAS,
    "z": _NUMBERS,
    "layers": st.lists(_WORDS, max_size=4),
}
_FORMS = st.fixed_dictionaries(
    {"system": st.sampled_from(["own", "typed"]), "psi": st.sampled_from(["custom", "hill"])}, optional=_TYPED
)
_SETTINGS = _FORMS | st.dictionaries(st.sampled_from(CONTROL_NAMES), _VALUES, max_size=4)
_KINDS = st.sampled_from(["svg", "zip", "json", "npz", "py", "tex", "html", "exe"])
_WISHES = st.fixed_dictionaries(
    {
        "take": st.fixed_dictionaries(
            {"kind": _KINDS}, optional=dict.fromkeys(("id", "theme", "legend", "sliders", "window", "layers"), _VALUES)
        )
    }
)
_REQUESTS = st.fixed_dictionaries(
    {"set": _SETTINGS | _VALUES},
    optional=dict.fromkeys(("id", "rest", "all"), _JSON)
    | {"window": st.lists(st.floats(-50, 50), min_size=4, max_size=6) | _JSON},
)
INPUTS: dict[str, st.SearchStrategy[Any]] = {
    "formula": FORMULAS,
    "link": st.dictionaries(_KEYS, _TEXTS | _SQUEEZED | _NESTED.map(json.dumps), max_size=5),
    "requests": st.lists(_REQUESTS | _WISHES | _VALUES, min_size=1, max_size=4),
}


def tried(name: str, given: Any) -> None:
    """Give one input to a target; AssertionError if it takes too long."""
    began = time.thread_time()
    TARGETS[name](given)
    took = time.thread_time() - began
    assert took < SECONDS, f"{took:.1f} s of processor time"
