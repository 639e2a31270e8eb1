"""The Markdown of lessons as safe HTML: formulas as MathML, settings as buttons, numbers that can be dragged, facts.

``[four directions](portrait:case1-cm4)`` opens a portrait, ``[f₁ = 1.2](set:f1=1.2,f2=0)`` sets controls,
``[f₁](drag:f1)`` is a number to drag, ``[](fact:limit_directions)`` a fact of the present scene. HTML in a lesson is
shown as text, not run.
"""

from __future__ import annotations

import html
import json
import re
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

#: What a link of each scheme becomes: (what follows the colon, HTML of its text) to HTML.
Resolve = Callable[[str, str, str], str]


class LinkError(ValueError):
    """A link of a lesson that leads nowhere."""


@cache
def parser() -> MarkdownIt:
    """Return the parser: CommonMark with tables, $formulas$ and front matter; raw HTML is text."""
    reader = MarkdownIt("commonmark", {"html": False, "typographer": False}).enable("table")
    reader.use(front_matter_plugin).use(
        dollarmath_plugin, renderer=lambda text, how: formula(text, how["display_mode"]), double_inline=True
    )
    reader.validateLink = lambda _url: True  # type: ignore[method-assign]  # schemes are judged by `resolve`
    return reader


def formula(text: str, display: bool = False) -> str:
    """Return a formula in LaTeX as MathML."""
    return convert(text, display="block" if display else "inline")


def render_html(tokens: Sequence[Token], resolve: Resolve) -> str:
    """Return the HTML of tokens of `parser`.

    Parameters
    ----------
    tokens : sequence of Token
    resolve : callable
        (scheme, target, HTML of the link's text) to HTML; raises LinkError for what leads nowhere.
    """
    for token in tokens:
        if token.children:
            token.children = _links(token.children, resolve)
    renderer = RendererHTML(parser())
    renderer.rules.update(parser().renderer.rules)  # type: ignore[attr-defined]  # its protocol names no rules
    return renderer.render(tokens, parser().options, {})


def _links(children: list[Token], resolve: Resolve) -> list[Token]:
    """Replace every link by what it is in a lesson."""
    found: list[Token] = []
    inside: list[Token] | None = None
    target = ""
    for token in children:
        if token.type == "link_open":
            inside, target = [], str(token.attrGet("href") or "")
        elif token.type == "link_close" and inside is not None:
            text = RendererHTML(parser()).renderInline(inside, parser().options, {})
            scheme, _, rest = target.partition(":")
            made = Token("html_inline", "", 0)
            made.content = resolve(scheme, rest, text)
            found.append(made)
            inside = None
        elif inside is not None:
            inside.append(token)
        else:
            found.append(token)
    return found


def button(values: dict[str, Any], words: str) -> str:
    """Return a button that sets values of controls."""
    return f'<button type="button" class="set" data-set="{html.escape(json.dumps(values))}">{words}</button>'


def draggable(name: str, words: str) -> str:
    """Return a number that is dragged sideways, or moved with the arrow keys."""
    control, label = html.escape(name), re.sub("<[^>]*>", "", words)
    return (
        f'<span class="drag" role="slider" tabindex="0" aria-label="{label}" data-drag="{control}">'
        f"<i>{words}</i> = <b></b></span>"
    )


def live(name: str) -> str:
    """Return a place for a fact of the present scene."""
    return f'<output class="fact" data-fact="{html.escape(name)}"></output>'


def inline(text: str, resolve: Resolve) -> str:
    """Return a line of Markdown as HTML, without a paragraph around it."""
    return render_html(parser().parseInline(text), resolve)
