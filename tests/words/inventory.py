"""All that a person reads: the sentences of both registries, and those of the browser's half."""

from __future__ import annotations

import re
from pathlib import Path

from codim2_app.picture.phrases import SENTENCES as APP

from codim2_core.results.words import ROOMS

ROOT = Path(__file__).parents[2]
STATIC = ROOT / "app" / "codim2_app" / "static"
READ = Path(__file__).parent / "read.txt"
_SAID = re.compile(r'^  (\w+): "([^"]*)",$', re.MULTILINE)


def browser() -> dict[str, str]:
    """Return what `static/words.js` says, by its key."""
    source = (STATIC / "words.js").read_text(encoding="utf-8")
    start = source.index("export const SAYS = {")
    return dict(_SAID.findall(source[start : source.index("\n}", start)]))


def lines() -> list[str]:
    """Return one line a sentence: where it stands, its key, when it is said, and the sentence."""
    core = [f"core/{room}: {key} [{one.when}]: {one.says}" for room, said in ROOMS.items() for key, one in said.items()]
    app = [f"app: {key} [{one.when}]: {one.says}" for key, one in APP.items()]
    return [*core, *app, *(f"browser: {key}: {text}" for key, text in browser().items())]
