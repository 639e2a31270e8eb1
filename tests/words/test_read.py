"""Each sentence is the one that was read next to its check; nothing that a visitor reads is outside the registries."""

import ast
import re

import pytest
from codim2_app.picture import phrases

from .inventory import READ, ROOT, STATIC, browser, lines
from .test_registry import beside

#: Texts in the app that are no notices: each is held elsewhere.
ASIDE = {
    "picture/phrases.py": "the title of the page",
    "lessons": "the course, held in tests/app/lessons",
    "server/cli.py": "the command's own help",
    "server/commands": "the command's own help",
    "server/first_page.py": "a page of its own, held in tests/app/server",
    "server/kernel_cache.py": "the log",
    "picture/frame/workers.py": "the log; what is told is said by phrases",
    "picture/draw/layers.py": "tooltips of layers",
    "picture/state/controls.py": "tooltips of controls",
    "view/glossary.py": "the glossary, held in tests/browser/test_explorer.py",
    "panels": "tooltips of tabs",
    "exports": "legends of figures, held in tests/app/exports",
    "site/docs": "pages of the site, held in tests/app/site/docs",
}


def test_every_sentence_is_as_it_was_read():
    kept, now = READ.read_text(encoding="utf-8").splitlines(), lines()
    changed = sorted(set(now) ^ set(kept))
    assert kept == now, "read its check, then `python -m tests.words --accept`:\n" + "\n".join(changed)


def docs(tree):
    """Texts that Panel and param show as tooltips (of a declared control, panel or setting), and those of the log."""
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return {
        part.value
        for call in calls
        if (name := ast.unparse(call.func)) in ("Panel", "ClassSelector", "field", "Setting")
        or name.endswith(".warning")
        for part in ast.walk(call)
        if isinstance(part, ast.Constant) and isinstance(part.value, str)
    }


def test_no_notice_is_made_beside_the_registry():
    missed = []
    for path in sorted((ROOT / "app" / "codim2_app").rglob("*.py")):
        name = path.relative_to(ROOT / "app" / "codim2_app").as_posix()
        tips = docs(ast.parse(path.read_text(encoding="utf-8")))
        outside = [(line, text) for line, text in beside(path.read_text(encoding="utf-8")) if text not in tips]
        if any(name.startswith(one) for one in ASIDE if one != "panels"):
            continue
        missed += [f"{name}:{line}: {text}" for line, text in outside]
    assert not missed, "\n".join(missed)


def test_no_sentence_is_made_in_a_script_beside_words_js():
    missed = []
    for path in sorted(STATIC.rglob("*.js")):
        source = re.sub(r"^\s*(//|\*|/\*).*$", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
        texts = re.findall(r'"([A-Z][^"\n]* [^"\n]* [^"\n]*[.…])"', source)
        missed += [f"{path.name}: {text}" for text in texts if text not in browser().values()]
    assert not missed, "\n".join(missed)


@pytest.mark.parametrize("key", phrases.SENTENCES)
def test_every_notice_is_said_somewhere(key):
    sources = (
        path.read_text(encoding="utf-8")
        for path in (ROOT / "app" / "codim2_app").rglob("*.py")
        if path.name != "phrases.py"
    )
    assert any(f'"{key}"' in source for source in sources)


def test_every_sentence_of_the_browser_is_said_somewhere():
    sources = "\n".join(path.read_text(encoding="utf-8") for path in STATIC.rglob("*.js") if path.name != "words.js")
    assert {key for key in browser() if f"SAYS.{key}" not in sources} == set()


#: Constructions that no sentence has: they read as translated, or do not say who does what.
REFUSED = re.compile(
    r"what stands still|\b(is|are) told\b|left to (ε|terms)|\bturns its\b|lets go|[Cc]ounted once here|has just met"
    r"|\bWho \w+s\b|\bnot so\b|all else|the one way|come to no end|: left out|just now"
)
MOST_WORDS = 25
#: Flesch's reading ease of all sentences together; 70 reads as plain English (Flesch 1948).
READING_EASE = 70.0


def spoken(line):
    """Sentences of a line of the registry, as words: formulas and fields count as what is spoken for them."""
    text = line.split("]: ", 1)[-1] if "]: " in line else line.split(": ", 2)[-1]
    return [re.findall(r"[^\W\d_]{2,}|\{\w+|\d+|[a-zA-ZΨΣΘ]\b", one) for one in re.split(r"(?<=[.?!…])\s+", text)]


def test_sentences_are_short_and_plain():
    assert not [line for line in lines() if REFUSED.search(line.split("]: ", 1)[-1])]
    every = [words for line in lines() for words in spoken(line) if words]
    assert not [words for words in every if len(words) > MOST_WORDS]
    said = [word.lower() for words in every for word in words]
    syllables = sum(max(1, len(re.findall(r"[aeiouy]+", word.removesuffix("e")))) for word in said)
    ease = 206.835 - 1.015 * len(said) / len(every) - 84.6 * syllables / len(said)
    assert ease > READING_EASE, ease
