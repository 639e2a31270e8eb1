"""What a person reads that is no sentence of a registry: names and tips of controls, glossary, lessons, the command."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from html import unescape
from typing import Any

from codim2_app.lessons.library import built_in
from codim2_app.panels import registry
from codim2_app.picture.draw.layers import LAYERS
from codim2_app.picture.state.controls import CONTROL_NAMES, ExplorerState
from codim2_app.server.cli import parser
from codim2_app.view.glossary import GLOSSARY, MARKS, OPENING

from codim2_core import presets, psi
from codim2_core.systems.examples import catalogue

from .inventory import STATIC

#: How nothing is written that a person reads, with what it is instead.
RULES = {
    "a name of the program; write its letter": (
        r"\b(lambda|lambda_\w+|\w+_crit|Psi|psi|eps|rho|theta|Sigma|sigma|tau|epsilon)\b"
    ),
    "a LaTeX key; write what a reader of the paper finds": r"\b(fig|thm|sec|eq|lem|prop|def|cor):\w",
    "a number as a program writes it": r"\b\d+(?:\.\d+)?e[+-]?\d",
    "a hyphen as a minus sign": r"(?<![\w.,/)\]-])-(?=\.?\d)",
    "a digit that is lowered in a name": r"\b[QCfzUkB][0-9]\b",
    "a prime that is typed": r"\b[xyz]' |\bd[xyz]/d[tT]\b",
    "another term for what the paper calls limit direction, critical set, layer problem": (
        r"(?i)fixed point(?! of the)|critical points?\b|steady state|direction of approach|fast subsystem|singular set"
    ),
    "another spelling": r"(?i)regularization|\bcolor\b|neighbor|\bcenter\b",
}  # fmt: skip
#: What is typed in a shell or in a cell stands as it is typed.
_TYPED = re.compile(r"`[^`]*`|'[^']*'|--[\w-]+|\b\w+:[A-Z]\b|\[[A-Z0-9_]+\]|\b[A-Z][A-Z0-9_]{2,}\b")


def faults(text: str) -> list[str]:
    """Return which rules a text breaks, and where."""
    bare = _TYPED.sub(" ", text)
    return [
        f"{rule}: {bare[max(0, one.start() - 25) : one.end() + 25]!r}"
        for rule, pattern in RULES.items()
        for one in re.finditer(pattern, bare)
    ]


def shown() -> Iterator[tuple[str, str]]:
    """Yield where a text stands, and the text."""
    yield from ((f"glossary {term}", f"{term}: {meaning}") for term, meaning in GLOSSARY)
    yield from ((f"mark {i}", mark[2]) for i, mark in enumerate(MARKS))
    yield "the opening portrait", OPENING
    yield from ((f"layer {name}", layer.words) for name, layer in LAYERS.items())
    yield from ((f"tip of the layer {name}", layer.tip) for name, layer in LAYERS.items())
    for name in CONTROL_NAMES:
        yield f"control {name}", f"{ExplorerState.param[name].label}: {ExplorerState.param[name].doc}"
    for panel in registry.PANELS_BY_NAME.values():
        yield f"tab {panel.key}", f"{panel.title}: {panel.tip}"
    for key, preset in presets.items():
        yield f"portrait {key}", f"{preset.title}: {preset.note}"
    for key, example in catalogue.items():
        yield f"example {key}", f"{example.title}: {example.sentence}"
    yield from ((f"family {name}", family.title) for name, family in psi.FAMILIES.items())
    yield from _markup()
    yield from _sheet()
    yield from _lessons()
    yield from _command(parser(), "codim2")


def _markup() -> Iterator[tuple[str, str]]:
    for path in sorted([*STATIC.rglob("*.html"), *STATIC.rglob("*.js")]):
        source = re.sub(r"\$\{[^}]*\}|\{[{%].*?[%}]\}", " ", path.read_text(encoding="utf-8"))
        for i, found in enumerate(re.findall(r'(?:title|aria-label|placeholder)="([^"<>]{3,})"', source)):
            yield f"{path.name} {i}", found
        for i, found in enumerate(re.findall(r"<(?!style)[a-z/][^<>]*>([^<>`]*[^\W\d_]{3,}[^<>`]*)<", source)):
            yield f"text of {path.name} {i}", " ".join(found.split())


def _sheet() -> Iterator[tuple[str, str]]:
    """Yield what the sheet "?" says of keys and marks, which stands in its script."""
    source = (STATIC / "page" / "help.js").read_text(encoding="utf-8")
    for i, (key, words) in enumerate(re.findall(r'^  \["([^"]+)", "([^"]+)"\],$', source, re.MULTILINE)):
        yield f"key {i}", f"{key}: {words}"
    marks = re.search(r"^const ARROWS = (.+)$", source, re.MULTILINE)
    assert marks, "the marks of help.js"
    for i, words in enumerate(re.findall(r'"([^"]+)"\]', marks[1])):
        yield f"eigenvector {i}", words


def _lessons() -> Iterator[tuple[str, str]]:
    for key, lesson in built_in().items():
        yield f"lesson {key}", f"{lesson.title}. {lesson.summary}"
        for i, part in enumerate(lesson.parts):
            for text in _texts(part):
                bare = re.sub(r"<math.*?</math>", " ", text, flags=re.DOTALL)
                yield f"lesson {key}, part {i + 1}", unescape(re.sub(r"<[^>]*>", " ", bare))


def _texts(part: Any) -> Iterator[str]:
    """Yield the texts of a part: of a question also those of its options."""
    for name in ("html", "explain", "hint"):
        yield getattr(part, name, "")
    for inner in (*getattr(part, "options", ()), getattr(part, "vary", None)):
        if inner is not None:
            yield from _texts(inner)


def _command(command: argparse.ArgumentParser, name: str) -> Iterator[tuple[str, str]]:
    if command.description:
        yield name, command.description
    for action in command._actions:
        if isinstance(action, argparse._SubParsersAction):
            for one in action._choices_actions:
                yield f"{name} {one.dest}", one.help or ""
            for key, inner in action.choices.items():
                yield from _command(inner, f"{name} {key}")
        elif action.help and action.help != argparse.SUPPRESS:
            yield f"{name} {action.dest}", action.help
