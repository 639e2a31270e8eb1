"""The mutants themselves: each is valid code, differs in one place, and they are those that one expects."""

import ast
from pathlib import Path

import pytest

from . import interpreted
from .__main__ import Choice, survivors
from .explained import ALLOWED
from .live import changes, functions, put_in
from .mutants import mutants
from .reach import Reach, reaching
from .record import Found, read, written
from .targets import ELSEWHERE, ROOT, front_end, guards, is_kernel, modules, room

SOURCE = '''"""A docstring with 1 + 2."""
LIMIT: float = 0.5

def f(x, y=None):
    """Not -x."""
    if x < 1e-9 and not y:
        raise ValueError(f"{x + 1}")
    return -x * sin(y) - 3  # a comment

def g(x):
    return zip(x, x.reshape(-1, 2), strict=True), "a" + x
'''


def test_expected_mutants_of_a_snippet():
    found = {(m.before, m.after) for m in mutants(SOURCE)}
    assert found == {
        ("0.5", "0.625"),
        ("x < 1e-9 and not y", "x < 1e-09 or not y"),
        ("x < 1e-9 and not y", "not y"),
        ("x < 1e-9 and not y", "x < 1e-09"),
        ("x < 1e-9", "x >= 1e-09"),
        ("1e-9", "1e-05"),
        ("not y", "y"),
        ("-x * sin(y) - 3", "-x * sin(y) + 3"),
        ("-x * sin(y) - 3", "-x * sin(y)"),
        ("-x * sin(y) - 3", "-3"),
        ("-x * sin(y)", "-x / sin(y)"),
        ("-x * sin(y)", "-x"),
        ("-x * sin(y)", "sin(y)"),
        ("-x", "x"),
        ("sin(y)", "cos(y)"),
        ("3", "4"),
        ("2", "3"),
    }


def test_every_mutant_is_valid_code_and_differs():
    plain = ast.dump(ast.parse(SOURCE))
    for mutant in mutants(SOURCE):
        assert ast.dump(ast.parse(mutant.source)) != plain, mutant.text
        assert "# a comment" in mutant.source
        assert mutant.source.splitlines()[mutant.line - 1] != SOURCE.splitlines()[mutant.line - 1]

        assert mutant.source.count("\n") == SOURCE.count("\n")  # all lines keep their numbers


def test_tests_of_every_room_exist():
    for name in {*map(room, modules()), *ELSEWHERE}:
        tests = (*guards(name), *guards(name, kernels=True))
        assert tests, name
        assert all((Path(__file__).parents[1] / test).exists() for test in tests), name


def test_what_is_explained_is_there():
    known = {**modules(), **front_end()}
    for one in ALLOWED:
        assert one.module in known, one.module
        assert one.words in known[one.module].read_text(), one
    assert len(set(ALLOWED)) == len(ALLOWED)
    assert [one.module for one in ALLOWED] == sorted(one.module for one in ALLOWED)
    assert all(one.words and one.why.endswith(".") for one in ALLOWED)


LIVING = """
LIMIT = 3

def area(r, factor=2):
    return factor * r * r

class Disc:
    size = 4

    def twice(self):
        return sum(2 * x for x in (1, 2))
"""


def in_place(before, after, tmp_path):
    path = str(tmp_path / "living.py")
    assert before in LIVING
    names = {}
    exec(compile(LIVING, path, "exec"), names)
    old, new = (compile(text, path, "exec") for text in (LIVING, LIVING.replace(before, after)))
    changed = changes(old, new)
    done = changed is not None and put_in(changed, functions(frozenset({path})).get(path, {}))
    return done, names["area"](3), names["Disc"]().twice()


def test_functions_are_changed_while_they_live(tmp_path):
    assert in_place("factor * r * r", "factor * r + r", tmp_path) == (True, 9, 6)
    assert in_place("2 * x", "2 + x", tmp_path) == (True, 18, 7)


@pytest.mark.parametrize(("before", "after"), [("LIMIT = 3", "LIMIT = 4"), ("size = 4", "size = 5"), ("r=2", "r=3")])
def test_what_runs_on_import_is_not_changed_in_place(before, after, tmp_path):
    assert in_place(before, after, tmp_path) == (False, 18, 6)


def test_what_runs_on_import_is_imported_anew():
    """Constants, and those made by a generator or a list; but not a function within a function."""
    plain = "N = tuple(2 * k for k in range(3))\nL = [k for k in N]\n\ndef f():\n    return sum(2 * k for k in N)\n"
    old = compile(plain, "a.py", "exec")
    assert changes(old, compile(plain.replace("N = tuple(2 *", "N = tuple(3 *"), "a.py", "exec")) is None
    assert changes(old, compile(plain.replace("range(3)", "range(4)"), "a.py", "exec")) is None
    assert changes(old, compile(plain.replace("[k for", "[k + 1 for"), "a.py", "exec")) is None
    found = changes(old, compile(plain.replace("sum(2 *", "sum(3 *"), "a.py", "exec"))
    assert [code.co_qualname for code in found] == ["f"]


def test_the_quickest_tests_that_reach_a_function_come_first():
    theme, svg = (str(ROOT / "app" / "draw" / f"{name}.py") for name in ("theme", "svg"))
    key = (theme, "f", 3)
    slow, quick, very = (f"tests/app/draw/test_mathml.py::{name}" for name in ("slow", "quick", "very_slow"))
    other, constants = "tests/app/draw/test_glyphs.py::other", "tests/app/draw/test_svg.py::constants"
    reach = {
        slow: Reach(4.0, frozenset({key})),
        quick: Reach(1.0, frozenset({key, (theme, "g", 7)})),
        other: Reach(0.1, frozenset({(theme, "g", 7), (svg, "f", 3)})),
        very: Reach(900.0, frozenset({key})),
        constants: Reach(0.2, frozenset()),  # enters nothing, but its file imports both
    }
    assert reaching(reach, {key}, theme, 6.0) == [quick, slow]
    assert reaching(reach, None, svg, 6.0) == [other, constants]
    assert reaching(reach, None, theme, 1.3) == [other, constants, quick]
    assert reaching(reach, {(theme, "h", 1)}, theme, 6.0) == []


def test_those_that_lived_can_be_tried_again():
    found = list(mutants(SOURCE))
    printed = f"some: words\n  lives  a/b.py:{found[3].text}\n  lives  a/c.py:{found[4].text}\nb.c 3 of 5 killed\n"
    again = Choice(None, 0, survivors(printed))
    assert again.of(found, "a/b.py") == [found[3]]
    twice = list(mutants("def f(x):\n    return x + 1\n\ndef g(x):\n    return x * 1\n"))
    ones = [mutant for mutant in twice if (mutant.before, mutant.after) == ("1", "2")]
    moved = survivors(f"  lives  a/b.py:{ones[1].line + 1}: 1  →  2\n")  # a line has gone since
    assert Choice(None, 0, moved).of(twice, "a/b.py") == [ones[1]]
    both = survivors("  lives  a/b.py:2: 1  →  2\n" * 2)
    assert Choice(None, 0, both).of(twice, "a/b.py") == ones
    assert Choice(3, 1, None).of(found, "a/b.py") == Choice(3, 1, None).of(found, "a/b.py")
    assert len(Choice(3, 1, None).of(found, "a/b.py")) == 3


def test_what_was_found_is_read_as_it_was_written():
    some = Found("core.sliding.slow_plane", 3, 5, 40, 7)
    other = Found("static/widgets/ball.js", 2, 2, 2, 0, "1a2b3c4")
    text = written([some, other])
    assert read(text) == {one.name: one for one in (some, other)}
    assert "| core.sliding | 3 of 5 | 60 % |" in text


def test_kernels_run_as_python_with_fewer_lanes():
    file, there, fewer = interpreted.FEWER
    assert (ROOT / file).read_text().count(f"\n{there}\n") == 1
    assert fewer != there
    stand_ins = interpreted.STAND_INS
    assert stand_ins["_double_of_bits"](stand_ins["_bits_of_double"](-0.3)) == -0.3
    assert stand_ins["_bits_of_double"](1.0) == 1023 << 52


def test_kernels_are_told_from_other_modules():
    assert is_kernel("core.stepping.lanes")
    assert is_kernel("core.cycles.ray_section_kernel")
    assert not is_kernel("core.cycles.periodic_orbit")
