"""The examples of all docstrings are run, and give what they say."""

import doctest
import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = {"app/codim2_app": "codim2_app", "codim2_core": "codim2_core"}


def examples():
    """Docstrings with examples, in every module that has one."""
    finder = doctest.DocTestFinder(exclude_empty=True)
    for folder, package in PACKAGES.items():
        for file in sorted((ROOT / folder).rglob("*.py")):
            if ">>>" not in file.read_text():
                continue
            inner = file.relative_to(ROOT / folder).with_suffix("").parts
            module = importlib.import_module(".".join((package, *(part for part in inner if part != "__init__"))))
            yield from (found for found in finder.find(module) if found.examples)


EXAMPLES = list(examples())


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.name)
def test_an_example_gives_what_it_says(example):
    said = []
    runner = doctest.DocTestRunner(verbose=False)
    runner.run(example, out=said.append)
    assert runner.failures == 0, "".join(said)
