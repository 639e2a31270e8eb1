"""The registry: no sentence twice, none next to it, and numbers and names in it are written in one way."""

import ast
import re
from pathlib import Path

from codim2_core.results.words import ROOMS, SENTENCES, recognise, say

ROOT = Path(__file__).parents[2]
#: What is no statement about a system: data with texts of its own, and what is said of a wrong input.
ASIDE = {
    "words": "the registry",
    "special_kinds.py": "rows that the registry reads",
    "jit": "what is logged of the compiler, and what is asked of it that it cannot do",
    "paper.py": "what the paper's labels are called",
    "presets": "captions of the presets, data",
    "examples": "what a system is, data",
    "reference": "what moves, and where it is from, data; its values are held in tests/core/motion/reference",
    "arguments.py": "what may be given",
    "formulas": "how a text is to be written",
    "conditions.py": "conditions of Ψ, held in tests/core/systems/psi",
    "hill.py": "conditions of Ψ, held in tests/core/systems/psi",
    "typed.py": "conditions of Ψ, held in tests/core/systems/psi",
    "options.py": "what may be given",
    "vary.py": "what may be given",
}
SHOWN = re.compile(r"(?:^|[.:] )[^.]*\w[^.]*\s[^.]*\w[^.]*\.$|[a-z)]\. [A-ZΘΨΣ]", re.DOTALL)


def texts(tree):
    """Yield each literal text with its line: not docstrings, not what is raised for a wrong input."""
    inside = {part for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for part in ast.walk(node)}
    passed = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr):
            passed.add(node.value)
        raised = node.exc if isinstance(node, ast.Raise) else None
        if isinstance(raised, ast.Call) and "Stop" not in ast.unparse(raised.func):
            passed.update(ast.walk(raised))
    for node in ast.walk(tree):
        if node in passed:
            continue
        if isinstance(node, ast.JoinedStr):
            yield node.lineno, "".join(v.value if isinstance(v, ast.Constant) else "0" for v in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in inside:
            yield node.lineno, node.value


def beside(source):
    """Sentences in a source: texts of three words or more that end in a full stop."""
    found = texts(ast.parse(source))
    return [(line, text) for line, text in found if len(text.split()) > 2 and SHOWN.search(text)]


def test_no_sentence_is_made_beside_the_registry():
    missed = [
        f"{path.relative_to(ROOT)}:{line}: {text}"
        for path in sorted((ROOT / "codim2_core").rglob("*.py"))
        if not ASIDE.keys() & set(path.parts)
        for line, text in beside(path.read_text())
    ]
    assert not missed, "\n".join(missed)


def test_every_sentence_is_registered_once():
    assert sum(map(len, ROOMS.values())) == len(SENTENCES)
    assert len({sentence.says for sentence in SENTENCES.values()}) == len(SENTENCES)
    assert all(sentence.when and sentence.says.strip() == sentence.says for sentence in SENTENCES.values())


def test_every_sentence_is_said_somewhere():
    files = (path for path in (ROOT / "codim2_core").rglob("*.py") if path.parent.name != "words")
    sources = "\n".join(path.read_text() for path in files)
    composed = {"becomes homoclinic", "becomes heteroclinic"}  # `continuation.branch_ends`
    composed |= {"no cycle", "one cycle", "cycles", "Hopf", "left", "reached", "along", "along one"}
    said = {key for key in SENTENCES if f'"{key}"' in sources or f"'{key}'" in sources}
    assert {re.split("[,:]", key)[0] for key in SENTENCES.keys() - said} <= composed


def test_numbers_and_names_are_written_in_one_way():
    text = say("comes down", label="Q2", theta=-1.0471975)
    assert text == "Comes down to Q₂ and leaves Σ along θ = −1.047."
    assert say("leaves", theta=-6.12e-17) == "It leaves Σ along θ = 0."
    assert say("end of the branch span", name="f1", value=1.5e-7) == "f₁ = 1.5 · 10⁻⁷: the end of the span."
    assert recognise(text) == [("comes down", {"label": "Q₂", "theta": "−1.047"})]
    assert [key for key, _ in recognise(say("cycle shrinks", C="C2"))] == ["cycle shrinks"]


def test_no_identifier_of_a_program_is_read():
    for key, sentence in SENTENCES.items():
        plain = re.sub(r"\{[^}]*\}", "", sentence.says)
        assert not re.search(r"lambda|_crit|\bPsi\b|\beps\b|z'|\b[QCfz][0-9]\b|simulate|\w\(\)", plain), key
