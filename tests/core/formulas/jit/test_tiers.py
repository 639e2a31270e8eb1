"""A kernel that is not at hand runs as Python until that has taken as long as compiling it would."""

import math

import numpy as np
import pytest
from numba.core.caching import NullCache

import codim2_core as c2
from codim2_core.formulas.jit import call_at, call_field, carray, interpreted, kernel, policy, right_hand_sides
from codim2_core.formulas.jit.interpreted import THREE_POINTERS
from tests.core.formulas.jit.fresh import computed
from tests.core.polylines import away

SEEDS = [(0.3, 0.2), (1.4, 0.3), (-0.5, 0.1)]
TRAJECTORIES = f"""
import codim2_core as c2
preset = c2.presets["case1-cm4"]
run = c2.trajectories(preset.system, preset.psi, {SEEDS})
found = run.ends, run.codes, run.times, run.evaluations
"""


def test_a_small_job_compiles_nothing_and_finds_the_same(tmp_path):
    (ends, codes, times, evaluations), compiled = computed(tmp_path, TRAJECTORIES)
    assert compiled == []
    preset = c2.presets["case1-cm4"]
    own = c2.trajectories(preset.system, preset.psi, SEEDS)
    assert evaluations == own.evaluations
    np.testing.assert_array_equal(codes, own.codes)
    np.testing.assert_allclose(ends, own.ends, rtol=1e-10, atol=1e-12)
    for here, there in zip(own.times, times, strict=True):
        assert there[-1] == pytest.approx(here[-1], rel=1e-8)


SCENES = """
import sys
import codim2_core as c2
from codim2_core.formulas.jit import tiers
from tests.core.formulas.jit.test_tiers import told_of
tiers.SECONDS_PER_BYTE = float("inf")
found = told_of(sys.argv[1])
"""


def told_of(name):
    """What is drawn and said of a preset, as numbers and words."""
    preset = c2.presets[name]
    scene = c2.Scene(preset.system, preset.psi, preset.z, launch=[(0.3, 0.2)])
    drawn = [scene["inside"], scene["outside"]]
    return {
        "name": scene["classification"].sentence,
        "directions": np.stack([scene["equator"].theta, scene["equator"].lambda_rho]),
        "sets": np.array([one.e for one in scene["critical"]]),
        "cycles": [(one.period, one.multiplier) for one in scene["closed_orbits"].cycles],
        "separatrices": [(one.origin, one.end, one.status) for one in scene["separatrices"]],
        "goes": [str(one) for one in scene["launched"].goes],
        "status": [[str(one) for one in layer.status] for layer in drawn],
        "lines": [[np.array(line) for line in layer.points] for layer in drawn],
    }


@pytest.mark.parametrize("name", c2.presets)
def test_a_scene_is_the_same_as_python(tmp_path, name):
    """To a quarter of a pixel where it is drawn; the last digits differ: nothing is fused, no sum reordered."""
    found, compiled = computed(tmp_path, SCENES, name)
    own = told_of(name)
    assert compiled == []
    for what in ("name", "separatrices", "goes", "status"):
        assert found[what] == own[what], what
    for what in ("directions", "sets", "cycles"):
        np.testing.assert_allclose(found[what], own[what], rtol=1e-6, atol=1e-9, err_msg=what)
    for here, there in zip(own["lines"], found["lines"], strict=True):
        for a, b in zip(here, there, strict=True):
            assert len(a) < 2 or away(b, a).max() < 0.005


# --- one kernel at a time: these are kept nowhere, so that they are never at hand


def tiers_of(made):
    made._cache = NullCache()
    return made._compile_for_args.__self__


@pytest.fixture
def rents():
    """This thread does as a process of its own does by default."""
    with policy.in_thread(policy.RENT):
        yield


@pytest.mark.usefixtures("rents")
def test_a_long_call_is_given_up_and_its_arguments_are_put_back():
    @kernel
    def add_up(numbers, count):
        for _ in range(count):
            numbers[0] += 1.0
        return numbers[0]

    tiers = tiers_of(add_up)
    numbers = np.zeros(1)
    assert add_up(numbers, 1000) == 1000.0
    assert not add_up.signatures
    tiers.cost = tiers.seconds + 1e-3
    assert add_up(numbers, 10_000_000) == numbers[0] == 10_001_000.0
    assert len(add_up.signatures) == 1
    spent = tiers.seconds
    assert add_up(numbers, 1) == 10_001_001.0
    assert tiers.seconds == spent  # Numba's dispatcher no longer asks


@pytest.mark.usefixtures("rents")
def test_what_is_no_arithmetic_of_pythons_runs_compiled_from_the_beginning():
    @kernel
    def divide(numbers, x):
        numbers[0] += 1.0
        return 1.0 / x

    tiers_of(divide)
    numbers = np.zeros(1)
    assert divide(numbers, 2.0) == 0.5
    assert not divide.signatures
    assert divide(numbers, 0.0) == math.inf
    assert divide.signatures
    assert numbers[0] == 2.0


def test_functions_of_math_are_those_of_machine_code_where_python_raises():
    @kernel
    def values(x):
        return math.sqrt(x), math.log(x), math.exp(-x), math.sinh(x), math.pow(x, 3.0)

    for x in (-1e300, 0.0, 1e300, 2.0):
        assert interpreted.run(values, (x,), math.inf, lambda: math.inf) == pytest.approx(values(x), nan_ok=True)


@pytest.mark.usefixtures("rents")
def test_while_another_process_compiles_it_is_not_compiled_here(monkeypatch):
    @kernel
    def twice(x):
        return 2.0 * x

    tiers_of(twice).cost = 0.0
    monkeypatch.setattr(policy._process, "at_work", lambda: True)
    assert [twice(1.0), twice(2.0)] == [2.0, 4.0]
    assert not twice.signatures
    monkeypatch.setattr(policy._process, "at_work", lambda: False)
    assert twice(2.0) == 4.0
    assert twice.signatures


def test_a_thread_that_only_loads_says_what_is_not_on_disk(tmp_path):
    script = """
from codim2_core.formulas.jit import policy
from codim2_core.portrait.orbits.trajectories import warm
try:
    with policy.in_thread(policy.LOAD):
        warm()
    found = ""
except policy.NotCompiledError as error:
    found = str(error)
"""
    said, compiled = computed(tmp_path, script)
    assert said == "states_of is not compiled; run `codim2 warm`."
    assert compiled == []


def _double(state, out, parameters):
    S, D, P = carray(state, (2,)), carray(out, (2,)), carray(parameters, (1,))
    for i in range(2):
        D[i] = P[0] * S[i]


def _double_of_other(state, out, parameters):
    call_at(int(carray(parameters, (1,))[0]), state, out, state)


@kernel
def _call(address, S, P):
    call_field(address, S, 0, 2, P)


@pytest.mark.usefixtures("rents")
def test_a_right_hand_side_keeps_its_address_when_it_is_compiled(monkeypatch):
    monkeypatch.setattr(right_hand_sides, "_machine_code_runs", False)
    own = right_hand_sides.right_hand_side(_double, cache=False)
    calling = right_hand_sides.right_hand_side(_double_of_other, cache=False)
    assert own.address in interpreted.waiting
    S = np.array([2.0, 3.0, 0.0, 0.0])
    for _ in range(2):  # as Python, and as machine code called by Python
        interpreted.run(_call, (own.address, S, np.array([5.0])), math.inf, lambda: math.inf)
        assert S.tolist() == [2.0, 3.0, 10.0, 15.0]
        interpreted.run(_call, (calling.address, S, np.array([float(own.address)])), math.inf, lambda: math.inf)
        assert S.tolist() == [2.0, 3.0, 4.0, 6.0]
        right_hand_sides.compile_waiting()
        assert own.address not in interpreted.waiting
    with policy.in_thread(policy.COMPILE):
        _call(calling.address, S, np.array([float(own.address)]))
    assert S.tolist() == [2.0, 3.0, 4.0, 6.0]
    later = right_hand_sides.right_hand_side(_double, cache=False)  # machine code may call it at once
    assert later.address not in interpreted.waiting
    out, numbers = np.zeros(2), np.array([3.0])
    THREE_POINTERS(later.address)(S.ctypes.data, out.ctypes.data, numbers.ctypes.data)
    assert out.tolist() == [6.0, 9.0]
