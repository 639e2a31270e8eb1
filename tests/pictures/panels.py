"""What the panels are sent: the columns of each, at settings without any symmetry, as JSON.

`tests/app/static/played/drawing.js` draws them as the page does; what it draws is kept next to them.
"""

from __future__ import annotations

import json
import re
from concurrent.futures import Executor, Future
from typing import Any
from urllib.parse import parse_qsl

from codim2_app.panels.registry import PANELS_BY_NAME
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.state.links import read_link
from codim2_app.view.markup import page_config
from codim2_app.view.refresh import Frames

NODE = "a=-2.1&b=0.3&d=-1.3&f1=-0.25&f2=0.2&k1=0.6&k2=-0.25&B1=1.2&B2=-0.4&g0=0.3&psi=rational"
SADDLE = "a=1.5&b=0.5&d=-1.2&f1=0.4&f2=-0.3&k1=0.4&k2=0.3&B1=-0.8&B2=0.5&g0=0.2&psi=rational"
#: What is drawn: the panel is the word up to the first hyphen, the rest is the link.
DRAWN = {
    "atlas-plane": NODE,
    "atlas-hopf": "preset=case3-n3",
    "atlas-map": f"{SADDLE}&across=a&up=f2",
    "numbers-node": f"{NODE}&layers=equator,critical,outcomes,cycles",
    "numbers-cycles": "preset=case3-n3&layers=equator,critical,cycles,outcomes",
    "numbers-none": "a=-1&b=1&d=-1&f1=0.3&f2=0&layers=equator,critical,cycles",
    "planes-saddle": SADDLE,
    "planes-over": "preset=case3-n3",
    "diagram-saddle": f"{SADDLE}&along=f1",
    "diagram-cycles": "preset=case3-n3&along=n",
    "theorems-node": NODE,
    "along-node": NODE,
    "along-plane": "system=ball_in_pool",
    "solid-sphere": f"{NODE}&trajectories=8",
    "solid-stack": f"{SADDLE}&solid=stack",
    "solid-filippov": f"{SADDLE}&solid=filippov",
    "orbits-typed": f"{NODE}&orbit_eps=show&launch=0.6,0.8,0.3&t_end=3&log_eps=-1",
    "orbits-ball": "system=ball_in_pool&orbit_eps=show",
    "psi-rational": f"{NODE}&log_eps=-0.5",
    "orbits-two": f"{NODE}&orbits=-0.4,0.3:mine;1.2,0.8;0.2,-0.5,-",
    "orbits-over-time": f"{NODE}&orbits=-0.4,0.3:mine;1.2,0.8;0.2,-0.5,-&orbit=2&orbit_eps=show",
    "census-normal": f"{NODE}&census_size=0",
    "lessons-list": "",
    "lessons-first": "lesson=01-friction",
}
#: Entries of a header that belong to a session, or are no panel's.
LEFT_OUT = ("id", "load", "errors", "late", "ready", "lines", "blocks", "set", "portrait")


class AtOnce(Executor):
    """Computes in the thread that asks."""

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Return the finished future."""
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future


def columns(name: str) -> str:
    """Return what the script of a panel needs to draw one of `DRAWN`, as JSON."""
    key = name.partition("-")[0]
    link = read_link({**dict(parse_qsl(DRAWN[name])), "panel": key})
    assert not link.errors, (name, link.errors)
    frames = Frames(link.state)
    frames.jobs = Jobs(AtOnce())
    header: dict[str, Any] = {}
    blocks: dict[str, list[int]] = {}
    for _ in range(6):
        made, arrays = unpack(frames.answer({"all": not header, "rest": True}))
        header |= made
        blocks |= {block: array.tolist() for block, array in arrays.items() if _of(key, block)}
        if not made.get("late"):
            break
    else:
        raise AssertionError(f"{name}: never comes to rest: {made['late']}")
    settings = page_config(link.state)
    script = PANELS_BY_NAME[key].script.read_text(encoding="utf-8")  # what it never names, it does not read
    shown = {
        "panel": key,
        "values": link.state.values(),
        "tools": {it: settings[it] for it in ("symbols", "ranges", "docs")}
        | {"settings": PANELS_BY_NAME[key].settings},
        "slow": [one["symbol"] for one in header["system"]["slow"]],
        "header": {it: value for it, value in header.items() if it not in LEFT_OUT and re.search(rf"\b{it}\b", script)},
        "blocks": blocks,
    }
    for other in {"stack", "filippov"} - {link.state.solid}:  # what is not looked at
        shown["header"].pop(other, None)
    for lesson in shown["header"].get("lesson", {}).get("list", ()):
        lesson["values"] = {"lesson": lesson["key"]}
    if "thumbnails" in shown["header"]:
        shown["header"]["thumbnails"] = header["thumbnails"][:2]
    return _lines(_plain(shown)) + "\n"


def _lines(shown: dict[str, Any]) -> str:
    """Return JSON with a line for each entry, so that a change is seen as one."""

    def text(value: Any) -> str:
        return json.dumps(value, ensure_ascii=False, separators=(",", ":"))

    def whole(value: dict[str, Any]) -> str:
        return "{\n" + ",\n".join(f"{text(name)}:{text(one)}" for name, one in value.items()) + "}"

    return "{" + ",\n".join(
        f"{text(name)}:{whole(one) if isinstance(one, dict) else text(one)}" for name, one in shown.items()
    ) + "}"  # fmt: skip


def _of(key: str, block: str) -> bool:
    """Say whether an array is a panel's: those of the picture's layers are not."""
    return key == "atlas" and block.partition(".")[0] in ("map", "map_curves")


def _plain(value: Any) -> Any:
    """Round numbers: what machines differ by is no picture."""
    if isinstance(value, float):
        return round(value, 4) + 0.0
    if isinstance(value, dict):
        return {name: _plain(one) for name, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return value
