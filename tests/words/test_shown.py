"""Names, tips, glossary, lessons and the command's help are written as the sentences are: in one spelling."""

import re

from codim2_app.picture import phrases

from codim2_core.results.words import SENTENCES

from .inventory import browser
from .shown import faults, shown


def test_what_is_shown_is_written_as_the_sentences_are():
    found = [f"{where}: {fault}" for where, text in shown() for fault in faults(text)]
    assert not found, "\n".join(found)


def test_the_registries_are_held_by_the_same_rules():
    registries = {**SENTENCES, **phrases.SENTENCES}
    texts = {key: re.sub(r"\{[^}]*\}", "", sentence.says) for key, sentence in registries.items()} | browser()
    found = [f"{key}: {fault}" for key, text in texts.items() for fault in faults(text)]
    assert not found, "\n".join(found)
