"""The page's HTML, written by the server, so that controls and first picture are there before any script runs."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict
from functools import cache, lru_cache
from importlib.metadata import version
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

from codim2_core.systems.psi import FAMILIES

from ..exports.printing import has_typst
from ..panels.challenge import GOALS
from ..panels.registry import FIRST, PANELS_BY_NAME
from ..picture.draw.bundle import bundle
from ..picture.draw.gallery import FIRST_PRESET, gallery
from ..picture.draw.layers import LAYERS, TRACES, layer_table, looks, swatches
from ..picture.draw.packing import unpack
from ..picture.draw.svg import draw
from ..picture.draw.theme import MEASURES, custom_properties, themes
from ..picture.phrases import PAGE_TITLE, say
from ..picture.slow_layers.outcomes import WORDS as OUTCOMES
from ..picture.state.choices import MAX_TRAJECTORIES, SETTING, SLOW_CONTROLS
from ..picture.state.chosen_system import BOXES, OWN_SYSTEM, STARTERS, titles
from ..picture.state.controls import NUMBERS, ExplorerState, first_values, preset_values
from ..picture.state.links import SYSTEM_DEFAULTS, VERSION, Link, PageView
from ..picture.state.portraits import portrait_keys, portraits
from ..picture.state.slider_range import edited_range, slider_range
from .glossary import EQUATION, GLOSSARY, MARKS, OPENING, PAPER

if TYPE_CHECKING:
    from jinja2 import Template

SCRIPT_FOLDER = Path(__file__).parents[1] / "static"

#: Controls by group: the matrix A, f, the slow variable, how f drifts with it, the slow flow.
GROUPS = {"A": ("a", "b", "d"), "f": ("f1", "f2"), "z": ("z",), "drift": ("k1", "k2"), "slow": ("B1", "B2", "g0")}


@cache
def template(name: str) -> Template:
    """Return a template of the folder of scripts."""
    from jinja2 import Environment, FileSystemLoader, select_autoescape  # late: frames need no template

    loader = FileSystemLoader(SCRIPT_FOLDER)
    return Environment(loader=loader, autoescape=select_autoescape(), trim_blocks=True).get_template(name)


def stylesheet() -> str:
    """Return all rules; they are scoped to `.codim2`, their colours are the table's, and small screens come last."""
    names = ("explorer", "sharing", "second", "room/room", "chart/chart", "beamer", "narrow")
    own, sharing, second, room, charts, beamer, narrow = (
        (SCRIPT_FOLDER / f"{name}.css").read_text(encoding="utf-8") for name in names
    )
    panels = (panel.style for panel in PANELS_BY_NAME.values())
    return "\n".join((custom_properties(), own, sharing, second, swatches(), charts, *panels, room, beamer, narrow))


def _embedded_rules(look: PageView) -> str:
    """Return the rules of a page in a frame, which shows the controls that its link names."""
    rules = (SCRIPT_FOLDER / "embed.css").read_text(encoding="utf-8")
    for name in look.controls:
        boxes = ", ".join(f'[data-control="{box}"]' for box in (name, f"slow-{name}", f"parameter-{name}"))
        chosen = f".codim2.embed.embed.embed:not(.notebook) .controls :is({boxes}):not(.row, .parameters)"
        rules += f"\n{chosen} {{ display: grid; }}"
    return rules


@cache
def script() -> str:
    """Return the front end as one ES module."""
    return bundle(*(panel.script for panel in PANELS_BY_NAME.values()), SCRIPT_FOLDER / "explorer.js")


@cache
def export_script() -> str:
    """Return the menu "Export", which is loaded when it is first opened."""
    return bundle(SCRIPT_FOLDER / "export_menu.js")


@cache
def presenter_script() -> str:
    """Return what the presenter's window of a lecture runs."""
    return bundle(SCRIPT_FOLDER / "presenter.js")


@cache
def digest() -> str:
    """Return what stands for the front end as it is."""
    return hashlib.sha256(script().encode()).hexdigest()[:16]


@cache
def edition() -> str:
    """Return what stands for the explorer as a page has it: a page of one is not driven by a server of another."""
    written = [(SCRIPT_FOLDER / name).read_text(encoding="utf-8") for name in ("explorer.html", "page.html")]
    versions = [version(name) for name in ("codim2", "bokeh", "panel")]
    return hashlib.sha256("\n".join((*versions, digest(), stylesheet(), *written)).encode()).hexdigest()[:16]


def address_of_script() -> str:
    """Return where a page of the explorer's server finds the front end, from where the page is."""
    return f"./explorer.js?v={digest()}"


def front_end_constants() -> dict[str, Any]:
    """Return what the front end must know whatever is open: presets by what is other than the defaults, colours."""
    first = first_values()
    return {
        "numbers": list(NUMBERS),
        "panels": {key: dict(panel.settings) for key, panel in PANELS_BY_NAME.items()},
        "defaults": first,
        "setting": list(SETTING),
        "opening": OPENING,
        "first": FIRST_PRESET,
        "layers": layer_table(),
        "traces": looks(TRACES),
        "families": {
            name: {"typed": family.typed, "parameter": family.parameter and family.parameter.name}
            for name, family in FAMILIES.items()
        },
        "boxes": {
            choice: [{"name": b.name, "label": b.label, "text": b.text, "lines": b.lines} for b in boxes]
            for choice, boxes in BOXES.items()
        },
        "goals": list(GOALS.items()),
        "starters": {OWN_SYSTEM: {title: dict(texts) for title, texts in STARTERS.items()}},
        "presets": {item["key"]: {**item, "values": _differences(first, item["key"])} for item in portraits()},
        "themes": themes(),
        "measures": MEASURES,
        "link": {"version": VERSION, "brought": list(SYSTEM_DEFAULTS)},
    }


@lru_cache(maxsize=4)
def _front_end_json(*_: Any) -> str:
    return json.dumps(front_end_constants(), ensure_ascii=False, separators=(",", ":"))


def offered_text() -> str:
    """Return `front_end_constants` as JSON, written anew when something is registered: it costs 10 ms."""
    return _front_end_json(tuple(PANELS_BY_NAME), tuple(portrait_keys()), tuple(FAMILIES), tuple(LAYERS), tuple(BOXES))


@cache
def _declared() -> dict[str, Any]:
    """Return what controls are, whatever their values."""
    declared = {name: ExplorerState.param[name] for name in NUMBERS}
    return {
        "ranges": {name: list(one.softbounds) for name, one in declared.items()},
        "symbols": {name: one.label for name, one in declared.items()},
        "docs": {name: one.doc for name, one in declared.items()},
    }


def settings(state: ExplorerState, locked: tuple[str, ...] = (), look: PageView | None = None) -> dict[str, Any]:
    """Return what the front end must know of one view."""
    return {
        **_declared(),
        "values": state.values(),
        "locked": list(locked),
        "film": has_typst(),
        "look": asdict(look or PageView()),
    }


def page_config(state: ExplorerState, locked: tuple[str, ...] = (), look: PageView | None = None) -> dict[str, Any]:
    """Return all that the front end must know."""
    return {**front_end_constants(), **settings(state, locked, look), "edition": edition()}


def _differences(first: Mapping[str, Any], key: str) -> dict[str, Any]:
    return {name: value for name, value in preset_values(key).items() if value != first[name]}


def explorer_html(
    state: ExplorerState,
    first: Mapping[str, Any] | None = None,
    locked: tuple[str, ...] = (),
    look: PageView | None = None,
    docs: bool = False,
    worker_edition: str = "",
) -> str:
    """Return the explorer's markup: controls with their values, legend, and the first picture as SVG.

    Parameters
    ----------
    state : ExplorerState
    first : mapping, optional
        "svg", and the words of the portrait: "name", "case", "sentence".
    locked : tuple of str
        Controls that the user's own system does not have.
    look : Look, optional
        An embedded page has but the picture and the controls that it names.
    docs : bool
        Whether the site is there to be linked to.
    worker_edition : str
        Of a page that a worker answers; "" where a server does, which has rooms and codes for phones.
    """
    values = state.values()

    def control(name: str) -> dict[str, Any]:
        declared = type(state).param[name]
        low, high, step = slider_range(*edited_range(values, name, declared.softbounds), values[name])
        return {"name": name, "symbol": declared.label, "doc": declared.doc, "value": values[name],
                "low": low, "high": high, "step": step}  # fmt: skip

    groups = groupby(portraits(), key=lambda item: item["group"])
    return template("explorer.html").render(
        css=stylesheet() + (_embedded_rules(look) if look and look.embed else ""),
        groups={group: [control(name) for name in names] for group, names in GROUPS.items()},
        exponent=control("n"),
        portraits=[(group, list(items)) for group, items in groups],
        count=len(portrait_keys()),
        gallery=[] if locked or (look and look.embed) else gallery(),
        title=PAGE_TITLE,
        equation=EQUATION,
        families=FAMILIES,
        layers=LAYERS,
        panels=PANELS_BY_NAME,
        first_tabs=FIRST,
        outcomes=OUTCOMES,
        systems=titles(),
        slow_controls=SLOW_CONTROLS,
        values=values,
        locked=locked,
        paper=PAPER,
        docs=docs,
        glossary=GLOSSARY,
        marks=MARKS,
        most=MAX_TRAJECTORIES,
        first=first or {},
        look=look or PageView(),
        edition=worker_edition or edition(),
        worker=bool(worker_edition),
    )


def first_words(header: dict[str, Any], first: bytes, layers: list[str]) -> dict[str, str]:
    """Return what the page says and shows before any script runs."""
    portrait = header.get("portrait")
    if portrait is None:
        return {}
    sentence = portrait["sentence"].split(". ", 1)[-1]
    case = f"Case {portrait['case']}" if portrait["case"] else ""
    return {"name": portrait["name"], "case": case, "sentence": sentence, "svg": draw(first, layers)}


def markup_of_frame(link: Link, first: bytes, docs: bool = False, worker_edition: str = "") -> str:
    """Return the markup of an address, drawn as its first frame says."""
    words = first_words(unpack(first)[0], first, link.state.layers)
    return explorer_html(link.state, words, (), link.look, docs, worker_edition)


def page_frame(title: str, bokeh_script: str, begin: str) -> str:
    """Return the page around the explorer; it asks no other host for anything.

    Parameters
    ----------
    title : str
    bokeh_script : str
        Where the page finds BokehJS, from where it is.
    begin : str
        The function of the front end that opens the explorer.
    """
    from bokeh.embed import json_item  # late: frames need no figure

    from ..picture.draw.figure import make_figure

    return template("page.html").render(
        title=title,
        explorer_script=address_of_script(),
        bokeh_script=bokeh_script,
        begin=begin,
        figure=json_item(make_figure()),
        refused={"full": say("places taken"), "other": say("no connection")},
    )
