"""What was found, kept as a text: killed and tried by room and module. A run replaces the modules that it tried."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from .targets import room

RESULTS = Path(__file__).with_name("results.md")
_ROW = re.compile(r"^\| (\S+) \| (\d+) of (\d+) \| \d+ % \| (\d+) \| (\d+) \|(?: (\w+) \|)?$", re.MULTILINE)


class Found(NamedTuple):
    """What became of a module's mutants: so many killed of those tried, of all there are."""

    name: str
    killed: int
    tried: int
    all: int
    seed: int
    commit: str = ""  # at which it was tried


def read(text: str) -> dict[str, Found]:
    """Read what `written` wrote, by module."""
    return {name: Found(name, *map(int, numbers), commit) for name, *numbers, commit in _ROW.findall(text)}


def written(found: Iterable[Found]) -> str:
    """Write what was found as Markdown."""
    kept = sorted(one for one in found if one.tried)
    rooms: dict[str, list[Found]] = {}
    for one in kept:
        rooms.setdefault(room(one.name) if not one.name.startswith("static") else "static", []).append(one)
    lines = [
        "# What the tests notice",
        "",
        "Written by `python -m tests.mutation ROOM --record`: one expression of a module is changed at a time, and the",
        "tests of its room are run. A part of a module's mutants is a sample, drawn with the seed and tried at the",
        "commit given; a share of a small sample is no more than that.",
        "",
        "| room | killed |  |",
        "|---|---|---|",
    ]
    for name, ones in rooms.items():
        lines.append(_share(name, sum(one.killed for one in ones), sum(one.tried for one in ones)) + "|")
    lines += ["", "| module | killed |  | all | seed | commit |", "|---|---|---|---|---|---|"]
    lines += [
        f"{_share(one.name, one.killed, one.tried)}| {one.all} | {one.seed} |{f' {one.commit} |' * bool(one.commit)}"
        for one in kept
    ]
    return "\n".join(lines) + "\n"


def _share(name: str, killed: int, tried: int) -> str:
    return f"| {name} | {killed} of {tried} | {100 * killed // tried} % "


def write(found: Iterable[Found]) -> None:
    """Put what was found in the place of what was known of these modules."""
    RESULTS.write_text(written({**known(), **{one.name: one for one in found}}.values()))


def known() -> dict[str, Found]:
    """Return what is on record, by module."""
    return read(RESULTS.read_text()) if RESULTS.exists() else {}
