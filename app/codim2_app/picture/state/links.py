"""Links: an address carries what is other than in its portrait or in the first setting, and a version.

The version says what the first setting was when the link was made, so that a link shows in later releases what it
showed then. The browser writes links by the same rule: static/page/links.js.
"""

from __future__ import annotations

import json
import re
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any
from urllib.parse import parse_qsl, urlencode

from ..draw.theme import MAX_HALF_VIEW, NEAREST
from ..phrases import say
from .chosen_system import BOXES, NORMAL, OWN_SYSTEM, STARTERS
from .cleaning import LONGEST_TEXT, InputError, clean
from .controls import CONTROL_NAMES, ExplorerState, preset_values
from .system_opening_values import opening_values

VERSION = 1
#: What a link of each version leaves out. A release that opens otherwise gets a new version next to these.
DEFAULTS_BY_VERSION: Mapping[int, Mapping[str, Any]] = MappingProxyType(
    {
        1: {
            "a": -2.0, "b": 0.0, "d": -1.0, "f1": -0.5, "f2": 0.0, "system": "normal", "texts": {}, "parameters": {},
            "z": 0.0, "z2": 0.0, "z3": 0.0, "z4": 0.0, "k1": 0.5, "k2": 0.0, "B1": 1.0, "B2": 0.0, "g0": 0.0,
            "psi": "constant", "n": 2.0, "psi_text": "1/(1+s)**2", "trajectories": 64,
            "layers": [
                "outside", "inside", "continuations", "cycles", "rho", "theta", "lines", "launched", "equator",
                "critical",
            ],
            "preset": "", "panel": "atlas", "along": "f1", "zoom": 0, "across": "f1", "cycle_curves": "hide",
            "atlas_zoom": 0, "up": "f2", "solid": "sphere", "drift": "z", "log_eps": -2.0, "launch": "0.6, 0.8, 0",
            "orbits": "", "orbit": 1, "pinned": "", "orbit_eps": "hide", "lesson": "", "quiz": "", "goal": "",
            "t_end": 8.0, "beside": "", "ranges": {}, "census": "normal", "census_size": 1, "cut": 0.0,
        },
    }
)  # fmt: skip
#: What another choice of system brings: always written where the system is not that of the portrait.
SYSTEM_DEFAULTS = tuple(opening_values(NORMAL))

#: What a link of an earlier release says otherwise, by name and value: the panel Time is now a part of Orbits.
RENAMED_VALUES: Mapping[tuple[str, str], Mapping[str, str]] = MappingProxyType(
    {("panel", "time"): {"panel": "orbits", "orbit": "0", "orbit_eps": "show"}}
)

MAX_COMPRESSED, MAX_QUERY = 20_000, 60_000  # characters
MOST_CONTROLS, MAX_VIEWS, MAX_NAME_CHARACTERS = 12, 24, 200
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,39}")


@dataclass(frozen=True, slots=True)
class PageView:
    """The view of a page: the part of the picture that is seen, and the parts that an embedded page shows."""

    seen: tuple[float, ...] = ()  # (left, right, bottom, top); () is the whole picture
    embed: bool = False  # only the picture and the chosen controls, for a frame in another page
    controls: tuple[str, ...] = ()  # names of controls, slow variables and parameters that an embedded page shows
    # 1, for the beamer: the picture fills the page, with large letters; 2: with a panel next to it. An embedded
    # page has no such mode
    beamer: int = 0
    lift: bool = False  # the picture is lifted onto the hemisphere
    # views to go through on a beamer: ``{"name", "set", "seen"}``, what is other than at first, and what is seen
    views: tuple[Mapping[str, Any], ...] = ()


@dataclass(frozen=True, slots=True)
class Link:
    """The state in an address; a value that cannot be used keeps its default, and is one of the errors."""

    state: ExplorerState
    errors: tuple[InputError, ...] = ()
    look: PageView = field(default_factory=PageView)


def read_link(query: str | Mapping[str, str]) -> Link:
    """Read the query of an address: a portrait's values, then those of the other names over them.

    Parameters
    ----------
    query : str or mapping
        ``v`` is the version; ``s`` holds a whole query squeezed (deflate, base64), over which the others stand;
        ``seen``, ``embed``, ``controls``, ``beamer``, ``lift``, ``views``, ``room`` and ``done`` are of the page; all
        else are values of controls.

    Returns
    -------
    Link
        Names that there are not, and a link that is cut short or of a later release, are listed among the errors.
    """
    given = dict(parse_qsl(query, keep_blank_values=True) if isinstance(query, str) else query.items())
    errors: list[InputError] = []
    if "s" in given:
        try:
            given = {**dict(parse_qsl(decompress_query(given.pop("s")), keep_blank_values=True)), **given}
        except ValueError as error:
            errors.append(InputError("", str(error)))
    for name in ("room", "done"):  # of the page: see static/room, static/panels/lessons.js
        given.pop(name, None)
    if "v" not in given and given.get("lesson"):  # typed by hand: pages write a version, and leave out the first panel
        given.setdefault("panel", "lessons")
    first = _defaults_of(given.pop("v", ""), errors)
    look = _look(given, errors)
    for (name, text), now in RENAMED_VALUES.items():
        if given.get(name) == text:
            given |= now
    good: dict[str, Any] = {}
    for name, text in given.items():
        if name in CONTROL_NAMES:
            try:
                good[name] = clean(name, text)
            except InputError as error:
                errors.append(InputError(error.control, str(error), text[:LONGEST_TEXT]))
    if good.get("system") == OWN_SYSTEM and good.get("texts"):  # of a release that began with other formulas
        good["texts"] = {**STARTERS["Two answers at once"], **good["texts"]}
    unknown = [name[:20] for name in given if name not in CONTROL_NAMES and not name.startswith("bokeh-")]
    if unknown:
        shown = ", ".join(map(repr, unknown[:3])) + (f" and {len(unknown) - 3} more" if len(unknown) > 3 else "")
        errors.append(InputError("", say("address names", names=shown)))
    return Link(ExplorerState.from_values(good, first), tuple(errors), look)


def write_link(values: Mapping[str, Any], look: PageView | None = None) -> str:
    """Return the query of an address that shows these values (all of them, as `ExplorerState.values`)."""
    base = {**DEFAULTS_BY_VERSION[VERSION], **preset_values(values["preset"]), "preset": ""}
    brought = SYSTEM_DEFAULTS if values["system"] != base["system"] else ()
    wanted = {name: value for name, value in values.items() if value != base[name] or name in brought}
    if values["system"] in BOXES:  # texts that one sees are part of a link, whatever a later release begins with
        wanted["texts"] = {**{box.name: box.text for box in BOXES[values["system"]]}, **values["texts"]}
    query = {"v": str(VERSION), **{name: _to_text(value) for name, value in wanted.items()}}
    if look is not None:
        if look.seen:
            query["seen"] = ",".join(f"{v:.6g}" for v in look.seen)
        if look.embed:
            query["embed"] = "1"
        if look.controls:
            query["controls"] = ",".join(look.controls)
        if look.beamer:
            query["beamer"] = str(look.beamer)
        if look.lift:
            query["lift"] = "1"
        if look.views:
            query["views"] = json.dumps(look.views, separators=(",", ":"))
    return urlencode(query)


def compress_query(query: str) -> str:
    """Return a query as one that carries it compressed, where that is shorter."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(query.encode()) + packer.flush()
    short = f"v={VERSION}&s={urlsafe_b64encode(packed).decode().rstrip('=')}"
    return min(query, short, key=len)


def decompress_query(text: str) -> str:
    """Return the query that a squeezed one carries.

    Raises
    ------
    ValueError
        It is cut short, changed, or too long.
    """
    sentence = say("address changed")
    if len(text) > MAX_COMPRESSED:
        raise ValueError(say("address too long", most=MAX_COMPRESSED))
    try:
        packed = urlsafe_b64decode(text + "=" * (-len(text) % 4))
        reader = zlib.decompressobj(-15)
        query = reader.decompress(packed, MAX_QUERY)
        if not reader.eof:
            raise ValueError(sentence)
        return query.decode()
    except (ValueError, zlib.error) as error:
        raise ValueError(sentence) from error


def _defaults_of(version: str, errors: list[InputError]) -> Mapping[str, Any]:
    """Return what a link of this version leaves out; one without a version, typed or old, leaves out nothing."""
    if version == "":
        return {}
    if version.isdecimal() and int(version[:9]) in DEFAULTS_BY_VERSION:
        return DEFAULTS_BY_VERSION[int(version[:9])]
    errors.append(InputError("", say("address of a later version", version=version[:9], newest=VERSION)))
    return DEFAULTS_BY_VERSION[VERSION]


def _look(given: dict[str, str], errors: list[InputError]) -> PageView:
    """Take what is of the page out of the given texts."""
    seen, embed, controls, beamer, lift, views = (
        given.pop(name, "") for name in ("seen", "embed", "controls", "beamer", "lift", "views")
    )
    names = [name for name in controls.split(",") if name]
    good = [name for name in names if _NAME.fullmatch(name)][:MOST_CONTROLS]
    if len(good) < len(names):
        errors.append(InputError("", say("controls of a frame", most=MOST_CONTROLS)))
    embedded = embed not in ("", "0")
    beamed = 0 if embedded or beamer in ("", "0") else 2 if beamer == "2" else 1
    kept = () if embedded else _views(views, errors)
    return PageView(_rectangle(seen, errors), embedded, tuple(good), beamed, lift not in ("", "0"), kept)


def _views(text: str, errors: list[InputError]) -> tuple[Mapping[str, Any], ...]:
    """Return kept views, each value cleaned as one of an address is."""
    if not text:
        return ()
    try:
        found = []
        for view in json.loads(text)[:MAX_VIEWS]:
            values = {
                name: clean(name, _to_text(value)) for name, value in view["set"].items() if name in CONTROL_NAMES
            }
            seen = _rectangle(",".join(map(str, view["seen"] or ())), errors)
            found.append({"name": str(view["name"])[:MAX_NAME_CHARACTERS], "set": values, "seen": list(seen) or None})
        return tuple(found)
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        errors.append(InputError("", say("views of a link")))
        return ()


def _rectangle(text: str, errors: list[InputError]) -> tuple[float, ...]:
    if not text:
        return ()
    try:
        left, right, bottom, top = (float(word) for word in text[:200].split(","))
    except ValueError:
        left = right = bottom = top = 0.0
    far = max(map(abs, (left, right, bottom, top)))
    if far <= 3 * MAX_HALF_VIEW and all(
        1.9 * NEAREST <= size <= 2.1 * MAX_HALF_VIEW for size in (right - left, top - bottom)
    ):
        return left, right, bottom, top  # as far as the picture's own tools go, and no closer: so far it is sampled
    errors.append(
        InputError(
            "",
            say(
                "part of the picture", given=text[:40], least=2 * NEAREST, most=2 * MAX_HALF_VIEW, far=3 * MAX_HALF_VIEW
            ),
        )
    )
    return ()


def _to_text(value: Any) -> str:
    """Write a value so that `clean` reads the same value back."""
    if isinstance(value, Mapping):
        return json.dumps(value, separators=(",", ":"))
    if isinstance(value, Iterable) and not isinstance(value, str):
        return ",".join(value)
    return repr(value) if isinstance(value, float) else str(value)
