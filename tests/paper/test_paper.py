"""Sections, theorems and figures are named as the paper prints them."""

import os
from pathlib import Path

import pytest

from codim2_core.results.paper import PRINTED, cite
from tests.paper.numbering import numbers


@pytest.mark.skipif("CODIM2_PAPER" not in os.environ, reason="CODIM2_PAPER names no source of the paper")
def test_the_table_is_that_of_the_papers_source():
    source = Path(os.environ["CODIM2_PAPER"]).read_text(encoding="utf-8")
    found = numbers(source)
    for label, (printed, title) in PRINTED.items():
        assert found[label] == printed
        if label.startswith("sec:") and label != "sec:lin" and "chart" not in title:
            assert title in source


def test_an_unknown_label_is_refused():
    with pytest.raises(ValueError, match="is no label"):
        cite("fig:nowhere")
    assert cite("an equation, eq:vf") == "an equation, (2.7)"
