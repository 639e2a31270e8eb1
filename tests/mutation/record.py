"""What was found, kept as a text: killed and tried by room and module, who lives, and what need not be tried and why.

A run replaces the modules that it tried and leaves the others.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from .explained import ALLOWED, reason
from .mutants import mutants
from .targets import modules, room

RESULTS = Path(__file__).with_name("results.md")
_ROW = re.compile(r"^\| (\S+) \| (\d+) of (\d+) \| \d+ % \| (\d+) \| (\d+) \|(?: (\w+) \|)?$", re.MULTILINE)
_ALIVE = re.compile(r"^- `(\S+?):(\d+: .*?)`(?:: (.*))?$", re.MULTILINE)


class Found(NamedTuple):
    """What became of a module's mutants: so many killed of those tried, of all there are; which live."""

    name: str
    killed: int
    tried: int
    all: int
    seed: int
    alive: tuple[str, ...]
    commit: str = ""  # at which it was tried


def read(text: str) -> dict[str, Found]:
    """Read what `written` wrote, by module."""
    alive: dict[str, list[str]] = {}
    for name, change, _ in _ALIVE.findall(text):
        alive.setdefault(name, []).append(change)
    rows = _ROW.findall(text)
    return {
        name: Found(name, int(killed), int(tried), int(every), int(seed), tuple(alive.get(name, ())), commit)
        for name, killed, tried, every, seed, commit in rows
    }


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
        "commit given; a share of a small sample is no more than that. Who lives are those of them that no test has",
        "noticed since: `--again --record` tries them once more.",
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
    lines += ["", "## Who lives", ""]
    for one in kept:
        lines += [f"- `{one.name}:{change}`{reason(one.name, change)}" for change in one.alive]
    lines += ["", "## What need not be tried", "", "Mutants of lines that hold these words, with the reason.", ""]
    counts: Counter[int] = Counter()
    there = modules()
    for module in sorted({one.module for one in ALLOWED} & there.keys()):  # those of the front end only Node can count
        source = there[module].read_text()
        texts = source.splitlines()
        for mutant in mutants(source):
            counts.update(
                [i for i, one in enumerate(ALLOWED) if one.module == module and one.words in texts[mutant.line - 1]][:1]
            )
    for i, one in enumerate(ALLOWED):
        count = f" ({counts[i]})" if one.module in there else ""
        lines.append(f"- `{one.module}`: `{one.words}`{count}: {one.why}")
    return "\n".join(lines) + "\n"


def _share(name: str, killed: int, tried: int) -> str:
    return f"| {name} | {killed} of {tried} | {100 * killed // tried} % "


def write(found: Iterable[Found]) -> None:
    """Put what was found in the place of what was known of these modules."""
    RESULTS.write_text(written({**known(), **{one.name: one for one in found}}.values()))


def known() -> dict[str, Found]:
    """Return what is on record, by module."""
    return read(RESULTS.read_text()) if RESULTS.exists() else {}
