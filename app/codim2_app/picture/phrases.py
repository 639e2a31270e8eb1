"""Sentences of the explorer to a visitor: what it leaves out, waits for or cannot show, each written once.

Sentences about systems are the core's (`codim2_core.results.words`); what is wrong with a value is written
where the value is checked.
"""

from __future__ import annotations

from pathlib import Path

from codim2_core.results.words import Sentence, read_tables

#: What the page asks; also the title of a file that is none of the paper's figures.
PAGE_TITLE = "When friction stops pointing anywhere"

SENTENCES: dict[str, Sentence] = read_tables(Path(__file__).with_name("phrases.toml"))


def say(key: str, **fields: object) -> str:
    """Return a sentence with its fields filled in."""
    return SENTENCES[key].says.format(**fields)
