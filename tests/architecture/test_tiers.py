"""Marks come from one place, and the plain command leaves out only what is slow."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests import tiers

ROOT = Path(__file__).parents[2]
DUMMY = """
import pytest

def test_one():
    pass

def test_two():
    pass

@pytest.mark.parametrize("n", range(7))
def test_many(n):
    pass
"""


@pytest.mark.parametrize(
    ("folder", "name", "found"),
    [
        ("core", "core/a.py::test_a", ["fast"]), ("app", "app/a.py::test_costly", []),
        ("browser", "browser/a.py::test_a", ["browser"]), ("faults", "faults/a.py::test_a", ["slow"]),
        ("words", "words/a.py::test_a", []),
    ],
)  # fmt: skip
def test_marks_of_a_test(folder, name, found):
    assert tiers.marks(folder, name, frozenset({"app/a.py::test_costly"})) == found


def test_every_folder_of_slow_tests_is_left_out_unless_it_is_asked_for(tmp_path):
    """Tried on a copy of the configuration with tests that do nothing."""
    tests = tmp_path / "tests"
    for folder in ("core/psi", "words", *tiers.SLOW):
        (tests / folder).mkdir(parents=True)
        for part in [tests / folder, *(tests / folder).parents][: folder.count("/") + 2]:
            (part / "__init__.py").touch()
        (tests / folder / "test_it.py").write_text(DUMMY)
    for name in ("pyproject.toml", "tests/conftest.py", "tests/leftovers.py", "tests/tiers.py"):
        (tmp_path / name).write_text((ROOT / name).read_text())
    (tests / "costly.txt").write_text("core/psi/test_it.py::test_two\n")
    (tests / "sampled.txt").write_text("3 core/psi/test_it.py::test_many\n4 words/test_it.py::test_many\n")

    both = (2 + 3) + (2 + 2)  # without what is sampled
    asked = {
        ("-n0",): both,
        ("-n0", "-m", "fast"): 1 + 3,
        ("-n0", "-m", "slow"): 9 * len(tiers.SLOW) + 4 + 5,
        (f"tests/{tiers.SLOW[0]}",): 9,
        ("tests/words",): 4,
        ("tests/words/test_it.py",): 9,
        ("-p", "no:xdist"): both,  # where pytest-xdist is not installed
    }
    # each in a child of one process, which has imported what all need
    code = f"""
import os, sys
import hypothesis.stateful, pytest
for arguments in {list(asked)!r}:
    if not (child := os.fork()):
        pytest.main(["-q", "-p", "no:cacheprovider", "-W", "ignore:Module already imported", *arguments])
        sys.stdout.flush()
        os._exit(0)
    os.waitpid(child, 0)
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert list(map(int, re.findall(r"(\d+) passed", done.stdout))) == list(asked.values()), done.stdout


def test_what_is_sampled_has_several_cases():
    rows = [row.split() for row in tiers.SAMPLED.read_text().splitlines()]
    assert rows == sorted(rows, key=lambda row: row[1])
    for each, name in rows:
        file, _, function = name.partition("::")
        assert int(each) > 1, name
        assert re.search(rf"(@[^\n]*\n(.+\n)*)def {function}\(", (tiers.TESTS / file).read_text()), name


def test_those_in_the_browser_come_first_and_all_else_keeps_its_order():
    class Item:
        def __init__(self, folder, name):
            self.path, self.name, self.found = tiers.TESTS / folder / "test_it.py", name, []

        def add_marker(self, name):
            self.found.append(name)

        def get_closest_marker(self, name):
            return name if name in self.found else None

    items = [Item(*one) for one in (("app", "a"), ("browser", "z"), ("browser", "b"), ("core", "d"), ("core", "c"))]
    tiers.mark(items)
    assert [item.name for item in items] == ["z", "b", "a", "d", "c"]


def test_each_process_begins_with_its_files_of_what_waits():
    files, others = [["a0", "a1"], ["b0", "b1"], ["c0"], ["d0"]], [f"o{i}" for i in range(7)]
    assert tiers.spread(files, others, 3) == [
        *("a0", "a1", "d0", "o0"), *("b0", "b1", "o1", "o2"), *("c0", "o3", "o4", "o5", "o6"),
    ]  # fmt: skip
    assert tiers.spread(files, others, 1) == ["a0", "a1", "b0", "b1", "c0", "d0", *others]
