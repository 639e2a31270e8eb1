"""Formulas of the site as MathML, which browsers draw themselves: no script, and no font of another host."""

from __future__ import annotations

from typing import Any

from ..lessons.markdown import formula


def inline(translator: Any, node: Any) -> None:
    """Write a formula within a line; called by Sphinx."""
    from docutils.nodes import SkipNode

    translator.body.append(formula(node.astext()))
    raise SkipNode


def block(translator: Any, node: Any) -> None:
    """Write a formula of its own, with its number if it has one; called by Sphinx."""
    from docutils.nodes import SkipNode

    translator.body.append(f'<div class="formula">{formula(node.astext(), display=True)}</div>\n')
    raise SkipNode
