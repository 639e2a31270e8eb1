"""Find the sentences of `results.words` in a text."""

import re
from functools import cache
from string import Formatter

from codim2_core.results.words import SENTENCES


@cache
def _patterns() -> dict[str, re.Pattern[str]]:
    return {key: _pattern(sentence.says) for key, sentence in SENTENCES.items()}


def _pattern(template: str) -> re.Pattern[str]:
    parts, fields = list[str](), set[str]()
    for text, name, _, _ in Formatter().parse(template):
        parts += [re.escape(text), "" if not name else f"(?P={name})" if name in fields else f"(?P<{name}>.+?)"]
        fields |= {name} if name else set()
    return re.compile("".join(parts) + r"(?= |$)")


def recognise(text: str) -> list[tuple[str, dict[str, str]]]:
    """Return the key and the fields of each sentence of a text, in its order.

    Raises ValueError: Part of the text is no sentence that is listed here.
    """
    found, rest = [], text.strip()
    while rest:
        matches = [(m, key) for key, pattern in _patterns().items() if (m := pattern.match(rest))]
        if not matches:
            raise ValueError(f"{rest!r} begins with no sentence that is listed.")
        match, key = max(matches, key=lambda pair: len(SENTENCES[pair[1]].says))
        found.append((key, match.groupdict()))
        rest = rest[match.end() :].strip()
    return found
