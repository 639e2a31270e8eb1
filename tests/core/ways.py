"""The ways in which a motion is stepped: by compiled kernels, and as Python."""

import math
from functools import partial

import pytest

from codim2_core.formulas.jit import interpreted, policy, right_hand_sides
from codim2_core.motion.initial_value import functions, motion_steps, slow_steps
from codim2_core.motion.initial_value.kernels import slow

WAYS = ("compiled", "as Python")


def follow(monkeypatch: pytest.MonkeyPatch, way: str) -> None:
    """Follow motions in one way, whatever has been asked for before."""
    if way == "as Python":
        for module, name in ((motion_steps, "follow_steps"), (slow_steps, "sets"), (slow, "leave")):
            monkeypatch.setattr(module, name, partial(run_as_python, getattr(module, name)))
        flow = tuple(waiting(monkeypatch, one) for one in (slow._slow_velocity, slow._slow_slopes))
        own = tuple(waiting(monkeypatch, one) for one in (functions._interpreted_values, functions._interpreted_slopes))
        monkeypatch.setattr(slow_steps, "flow", lambda: flow)
        monkeypatch.setattr(functions, "_interpreters", lambda: own)


def run_as_python(kernel, *given):
    """Call a kernel that is compiled already as Python."""
    return interpreted.run(kernel, given, math.inf, lambda: math.inf)


def waiting(monkeypatch, function):
    """Return a right-hand side that is not compiled."""
    monkeypatch.setattr(right_hand_sides, "_machine_code_runs", False)
    with policy.in_thread(policy.RENT):
        return right_hand_sides.right_hand_side(function, cache=False)
