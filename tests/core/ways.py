"""The ways in which a motion is stepped: formulas compiled, or called back; the kernels run as Python too."""

import math

import pytest

from codim2_core.initial_value import functions, slow_steps
from codim2_core.jit import interpreted
from codim2_core.stepping.compiling import CompiledCache

WAYS = ("compiled", "called back", "as Python")


def follow(monkeypatch: pytest.MonkeyPatch, way: str) -> None:
    """Follow motions in one way, whatever has been asked for before."""
    monkeypatch.setattr(functions, "CALLS_WORTH_COMPILING", 0 if way == "compiled" else math.inf)
    if way != "compiled":
        monkeypatch.setattr(functions, "_fields", CompiledCache(functions.MOST_SYSTEMS))
    if way == "as Python":
        for module in (interpreted, functions, slow_steps):
            monkeypatch.setattr(module, "is_at_hand", lambda kernel: False)
