"""The mutants themselves: each is valid code, differs in one place, and they are those that one expects."""

import ast
import importlib
from pathlib import Path

from .mutants import mutants
from .targets import TARGETS

SOURCE = '''"""A docstring with 1 + 2."""
LIMIT: float = 0.5

def f(x, y=None):
    """Not -x."""
    if x < 1e-9 and not y:
        raise ValueError(f"{x + 1}")
    return -x * sin(y) - 3  # a comment
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
    }


def test_every_mutant_is_valid_code_and_differs():
    plain = ast.dump(ast.parse(SOURCE))
    for mutant in mutants(SOURCE):
        assert ast.dump(ast.parse(mutant.source)) != plain, mutant.text
        assert "# a comment" in mutant.source
        assert mutant.source.splitlines()[mutant.line - 1] != SOURCE.splitlines()[mutant.line - 1]


def test_targets_exist():
    for module, tests in TARGETS.items():
        importlib.import_module(f"codim2_core.{module}")
        assert all((Path(__file__).parents[1] / test.split("::")[0]).exists() for test in tests), module
