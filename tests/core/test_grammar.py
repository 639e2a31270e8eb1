"""One grammar for all public functions: names for systems and Psi, numbers for a system, and results."""

import pickle

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.results.result import equal_values
from tests.core.test_arguments import GOOD, SLOW

SADDLE = c2.ELinear(-2.0, 0.3, -1.0, (-0.5, 0.0))
TURNING = c2.System(U=("z*c - s", "c + z*s"), W=("1",))
BALL = c2.examples.ball_in_pool()
ONE = c2.psi.constant()
STATE = (1.0, 0.0, 1.0, 0.0)
MATRIX = c2.ELinear(1.0, 1.3, -1.2)

SPELLINGS = {
    **{
        f"a, b, d of {name}": (
            lambda name=name, psi=psi: getattr(c2.bifurcations, name)(1.0, 1.3, -1.2, *psi),
            lambda name=name, psi=psi: getattr(c2.bifurcations, name)(MATRIX, *psi),
        )
        for name, psi in (
            ("saddle_node", ()), ("critical_boundary", ()), ("closed_equator", ()), ("regions", ()),
            ("hopf", (c2.psi.hill(3),)), ("node_focus", (c2.psi.hill(3),)),
        )
    },
    "a, b, d by name": (
        lambda: c2.bifurcations.hopf(a=1.0, b=1.3, d=-1.2, psi=c2.psi.hill(3)),
        lambda: c2.bifurcations.hopf(MATRIX, psi=c2.psi.hill(3)),
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", SPELLINGS)
def test_three_numbers_stand_for_a_system_where_only_the_plane_is_asked(what):
    before, now = SPELLINGS[what]
    assert before() == now()


NAMED = [f for f, given in GOOD.items() if given.get("psi") == c2.psi.tanh() and f not in SLOW]


@pytest.mark.parametrize("function", NAMED, ids=lambda f: f.__name__)
def test_the_name_of_a_psi_stands_for_it(function):
    given = GOOD[function]
    assert equal_values(function(**{**given, "psi": "tanh"}), function(**given))


@pytest.mark.parametrize("name", ["case1-cm4", "ball-stick", "case3-n2"])
def test_the_name_of_a_preset_stands_for_its_system_psi_and_z(name):
    preset = c2.presets[name]
    whole = preset.system, preset.psi, preset.z
    assert c2.classify(name) == c2.classify(system=name) == c2.classify(*whole)
    assert c2.equator_equilibria(name) == c2.equator_equilibria(preset.system, preset.z)
    assert c2.critical_sets(name, "hill:3") == c2.critical_sets(preset.system, c2.psi.hill(3), preset.z)
    assert c2.bifurcations.hopf(name) == c2.bifurcations.hopf(*whole)
    assert c2.Scene(name)["classification"] == c2.Scene(*whole)["classification"]
    assert c2.Scene(name, "tanh").psi == c2.psi.tanh()


def test_the_name_of_an_example_stands_for_its_system():
    assert c2.filippov_sliding("ball_in_pool", (1.0, 0.0)) == c2.filippov_sliding(BALL, (1.0, 0.0))
    run = c2.simulate_nonsmooth("ball_in_pool", STATE, (0.0, 1.0))
    assert run == c2.simulate_nonsmooth(BALL, STATE, (0.0, 1.0))
    with pytest.raises(TypeError, match="psi"):
        c2.classify("ball_in_pool", z=(1.0, 0.0))


def test_a_name_that_nothing_has_is_told_with_those_like_it():
    for call in (c2.classify, c2.Scene, c2.bifurcations.saddle_node):
        with pytest.raises(ValueError, match="nearest names are case1-cm4"):
            call("case1-cm44")


def test_results_that_hold_others_say_their_kinds_and_sentences():
    found = c2.critical_sets("case3-n2")
    assert found.kinds == tuple(one.kind for one in found)
    assert c2.certificates("case1-cm4").sentences[0] == c2.certificates("case1-cm4")[0].sentence


@pytest.mark.parametrize("function", [f for f in GOOD if f not in SLOW], ids=lambda f: f.__name__)
def test_a_result_is_printed_within_some_lines_and_pickled(function):
    if "register" in function.__name__:
        return
    found = function(**GOOD[function])
    assert repr(found).count("\n") < 5
    assert equal_values(pickle.loads(pickle.dumps(found)), found)


@pytest.mark.parametrize("way", ["regularised", "limit", "past", "several"])
def test_times_that_are_asked_for_are_those_of_the_result(way):
    asked = np.linspace(0.0, 0.3, 7)
    if way == "limit":
        run, whole = (c2.simulate_nonsmooth(BALL, STATE, (0.0, 0.3), times=t) for t in (asked, None))
    elif way == "past":
        asked = -asked / 10.0
        run, whole = (c2.simulate(BALL, ONE, STATE, (0.0, -0.03), eps=1e-3, times=t) for t in (asked, None))
        asked = asked[::-1]
    elif way == "several":
        (_, run), (_, whole) = (
            c2.simulate(BALL, ONE, [STATE] * 2, (0.0, 0.3), eps=1e-3, times=t) for t in (asked, None)
        )
    else:
        run, whole = (c2.simulate(BALL, ONE, STATE, (0.0, 0.3), eps=1e-3, times=t) for t in (asked, None))
    np.testing.assert_array_equal(run.times, asked)
    np.testing.assert_array_equal(run.states, whole.dense(asked))
    assert (run.success, run.message) == (True, run.reason)
    assert len(run.to_frame()) == 7
    assert run.phases == whole.phases
    np.testing.assert_array_equal(run.drawn().times, whole.drawn().times)


def test_times_beyond_where_a_motion_stops_are_left_out():
    stop = c2.Event(lambda t, q: q[2] - 0.9, terminal=True)
    run = c2.simulate_nonsmooth(BALL, STATE, (0.0, 1.0), events=stop, times=[0.01, 0.9])
    assert run.times.tolist() == [0.01]
    short = c2.simulate(BALL, ONE, STATE, (0.0, 1.0), eps=1e-3, max_steps=3)
    assert (short.success, short.message) == (False, short.reason)


def test_parameters_are_a_mapping_that_is_not_changed():
    assert BALL.parameters["mu"] == 0.2
    assert dict(BALL.parameters) == BALL.parameters == {"mu": 0.2, "m": 1.0, "K": 1.0, "g": 9.81}
    with pytest.raises(TypeError, match="item assignment"):
        BALL.parameters["mu"] = 0.3
    assert len({BALL, BALL.evolve(mu=0.2), BALL.evolve(mu=0.3)}) == 2


def test_an_e_linear_system_is_printed_as_it_was_given():
    for system in (SADDLE, c2.ELinear(-1, "mu*z", 2.5, f=("z", 0), g=("-z",), parameters={"mu": 0.1}),
                   c2.ELinear.from_matrix([[1, 2], [3, 4]])):  # fmt: skip
        assert eval(repr(system), {"ELinear": c2.ELinear}) == system
    assert repr(c2.ELinear(-2, 0, -1)) == "ELinear(a=-2, b=0, d=-1)"


@pytest.mark.parametrize(("example", "wrong"), [
    ("ball_in_pool", {"mu": -1.0}), ("ball_in_pool", {"m": 0.0}), ("spinning_disc", {"k": 0.0}),
    ("spinning_annulus", {"eta": 1.0}), ("tilting_block", {"mu2": 0.0}), ("ball_on_turntable", {"g": -9.81}),
    ("towed_wheel", {"l": 0.0}), ("driven_mass", {"omega": 0.0}), ("cart_at_rear_wheel", {"j": 0.0}),
    ("plate_on_three_feet", {"r": -1.0}),
])  # fmt: skip
def test_a_mechanism_that_there_is_not_is_refused(example, wrong):
    [name] = wrong
    with pytest.raises(ValueError, match=rf"\b{name} is .*give a number"):
        getattr(c2.examples, example)(**wrong)


UNREADABLE = ("__abstractmethods__", "__weakref__")  # Python lists them itself; the second with slots, before 3.11.5


@pytest.mark.parametrize("make", [
    lambda: SADDLE, lambda: SADDLE.at(), lambda: TURNING, lambda: TURNING.at(0.1), lambda: ONE,
    lambda: c2.Scene("case1-cm4"), lambda: c2.simulate_nonsmooth(BALL, STATE, (0.0, 0.1)),
    lambda: c2.simulate_nonsmooth(BALL, STATE, (0.0, 0.1)).phases[0],
])  # fmt: skip
def test_the_tab_key_lists_what_is_for_users(make):
    """What only the core asks is there and is not listed; and all that is listed is there."""
    found = make()
    assert all(hasattr(found, name) and name not in dir(found) for name in found._internal_)
    assert all(hasattr(found, name) for name in dir(found) if name not in UNREADABLE)


@pytest.mark.parametrize("name", ["psi", "examples", "mechanics", "bifurcations", "reference", "hemisphere"])
def test_the_tab_key_lists_public_names_only(name):
    module = getattr(c2, name)
    assert dir(module) == sorted(module.__all__)
