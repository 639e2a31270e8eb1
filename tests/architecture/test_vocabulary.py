"""Names are verbs or what they stand for, and docstrings begin as an entry of a reference does."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
MODULES = sorted(path for room in ("app", "codim2_core") for path in (ROOT / room).rglob("*.py"))
#: A docstring that begins with one of these is no sentence that an index of functions could print.
OPENINGS = {"What", "Whom", "Who", "Whose", "Where", "How", "Which", "Why", "When", "That", "Of", "As", "From"}
OPENED = re.compile(rf'"""[\s`]*(?:{"|".join(OPENINGS)})\b')


def definitions(node):
    yield node
    for part in getattr(node, "body", ()):
        if isinstance(part, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            yield from definitions(part)


def test_every_docstring_begins_as_an_entry_of_a_reference():
    found = []
    for path in MODULES:
        text = path.read_text(encoding="utf-8")
        for node in definitions(ast.parse(text)) if OPENED.search(text) else ():
            said = ast.get_docstring(node)
            if said and said.split()[0].strip("`,:;.") in OPENINGS:
                found.append((path.relative_to(ROOT).as_posix(), said.split("\n")[0]))
    assert not found
