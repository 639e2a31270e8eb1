"""What a person reads names sections, theorems and figures as the paper prints them, and no label of its source."""

import ast
import os
import re
from pathlib import Path

import pytest

from codim2_core.results.paper import PRINTED, cite
from tests.paper.numbering import numbers

ROOT = Path(__file__).parents[2]
LABEL = re.compile(r"\b(?:fig|sec|thm|prop|lem|eq|tab|def|rem):[A-Za-z]\w*(?:\(\w\))?")
PRINT = re.compile(
    r"(?<!\w)(?:Figure|Section|Theorem|Lemma|Proposition|Definition|Remark|Table|Appendix) "
    r"(?:[A-C](?:\.\d)?|\d+(?:\.\d+)*)(?!\w)(?:\(\w\))?"
)
PURE = re.compile(rf"(?:{LABEL.pattern}|D[12]|index theory)(?:, (?:{LABEL.pattern}|D[12]|index theory))*")

# In small: one counter for theorems and their kin in a section, letters for parts, one run of figures.
SMALL = r"""\begin{document}\section{A}\label{sec:a}
\begin{remark}x\end{remark}\begin{theorem}\label{thm:t}\begin{enumerate}
\item{a\label{thm:ta}}\item{b\label{thm:tb}}\end{enumerate}\end{theorem}
\begin{figure}\begin{subfigure}\caption{}\label{fig:p}\end{subfigure}
\begin{subfigure}\caption{}\label{fig:q}\end{subfigure}\caption{}\label{fig:w}\end{figure}
\section{B}\subsection{C}\label{sec:c}\begin{lemma}\label{lem:l}\end{lemma}\begin{table}\caption{}\label{tab:t}\end{table}
\appendix\section{D}\label{sec:d}\begin{lemma}\label{lem:m}\end{lemma}\end{document}"""


def test_labels_are_numbered_by_the_rules_of_the_class():
    assert numbers(SMALL) == {
        "sec:a": "Section 1", "thm:t": "Theorem 1.2", "thm:ta": "Theorem 1.2(a)", "thm:tb": "Theorem 1.2(b)",
        "fig:p": "Figure 1(a)", "fig:q": "Figure 1(b)", "fig:w": "Figure 1", "sec:c": "Section 2.1",
        "lem:l": "Lemma 2.1", "tab:t": "Table 1", "sec:d": "Appendix A", "lem:m": "Lemma A.1",
    }  # fmt: skip


@pytest.mark.skipif("CODIM2_PAPER" not in os.environ, reason="CODIM2_PAPER names no source of the paper")
def test_the_table_is_that_of_the_papers_source():
    source = Path(os.environ["CODIM2_PAPER"]).read_text(encoding="utf-8")
    found = numbers(source)
    for label, (printed, title) in PRINTED.items():
        assert found[label] == printed
        if label.startswith("sec:") and label != "sec:lin" and "chart" not in title:
            assert title in source


def strings():
    """All text of the product that is no docstring: (file, text)."""
    for path in sorted([*(ROOT / "codim2_core").rglob("*.py"), *(ROOT / "app").rglob("*.py")]):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        bodies = [node.body for node in ast.walk(tree) if isinstance(getattr(node, "body", None), list)]
        silent = {id(line.value) for body in bodies for line in body if isinstance(line, ast.Expr)}
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in silent:
                yield path.relative_to(ROOT).as_posix(), node.value
    for path in sorted((ROOT / "app" / "codim2_app" / "static").rglob("*.js")):
        text = path.read_text(encoding="utf-8")
        yield path.relative_to(ROOT).as_posix(), re.sub(r"/\*.*?\*/|(?m:(?<!:)//.*$)", "", text, flags=re.S)
    for path in (
        *sorted((ROOT / "app" / "codim2_app" / "lessons").rglob("*.md")),
        *sorted((ROOT / "app" / "codim2_app" / "static").glob("*.html")),
    ):
        yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def texts():
    return [(name, text) for name, text in strings() if name != "codim2_core/results/paper.py"]


def test_labels_stand_alone_as_data_and_never_in_a_sentence(texts):
    wrong = [(name, text[:80]) for name, text in texts if LABEL.search(text) and not PURE.fullmatch(text)]
    assert wrong == []


def test_labels_that_are_data_can_be_printed(texts):
    for _, text in texts:
        if PURE.fullmatch(text) and LABEL.search(text):
            assert not LABEL.search(cite(text))


def test_what_is_named_as_printed_is_in_the_table(texts):
    known = {printed for printed, _ in PRINTED.values()}
    named = {(name, found) for name, text in texts for found in PRINT.findall(text)}
    assert named
    for name, found in named:
        assert found in known or re.sub(r"\(\w\)$", "", found) in known, (name, found)


def test_an_unknown_label_is_refused():
    with pytest.raises(ValueError, match="is no label"):
        cite("fig:nowhere")
    assert cite("an equation, eq:vf") == "an equation, (2.7)"
