"""What stands still in a layer problem is found once, however many ask."""

import gc
import pickle
import weakref
from collections import Counter

import pytest

import codim2_core as c2
from codim2_core import psi
from codim2_core.cycles.limit_cycles import cycles_of
from codim2_core.layer_problem import closed_equator, critical, disc_zeros, equator, problem
from codim2_core.layer_problem.problem import LayerProblem
from codim2_core.portrait.classify import portrait

CASE_III = c2.presets["case3-n3"]
TYPED = c2.examples.nonunique_sliding()


@pytest.fixture
def calls(monkeypatch):
    """Count what is computed anew of the things that every part of a picture asks for."""
    from codim2_core.cycles import limit_cycles, section

    counted: Counter = Counter()
    modules = (problem, critical, equator, closed_equator, disc_zeros, limit_cycles, section)
    for name in ("locate", "sets_at", "equilibria_at", "equator_cycle", "search", "find"):
        for module in modules:
            if hasattr(module, name):
                original = getattr(module, name)

                def count(*arguments, _name=name, _original=original, **options):
                    what = getattr(arguments[0], "plane", None)  # of which system, and under which Psi
                    what = what if isinstance(what, tuple) else getattr(arguments[0], "key", None)
                    under = arguments[1] if _name == "sets_at" else None
                    counted[_name, what, under] += 1
                    return _original(*arguments, **options)

                monkeypatch.setattr(module, name, count)
    return counted


@pytest.mark.parametrize("key", ["case1-cm4", "case2-ncm4", "case3-n3"])
def test_everything_in_a_frame_is_computed_once(calls, key):
    preset = c2.presets[key]
    scene = c2.Scene(preset.system, preset.psi, preset.z)
    for name in scene:
        scene[name]
    own = {key: count for key, count in calls.items() if key[1] in (preset.system.at(preset.z).plane, None)}
    assert {key[0] for key in own} >= {"locate", "sets_at", "equilibria_at"}
    searches = [count for key, count in own.items() if key[0] == "search"]
    assert sum(searches) <= 9  # a theorem answers, or once for each Psi that outcomes compare
    assert {count for key, count in own.items() if key[0] != "search"} == {1}
    before = dict(scene.runs)
    for name in scene:
        scene[name]
    assert dict(scene.runs) == before


def test_a_general_system_likewise(calls):
    scene = c2.Scene(TYPED, psi.tanh(), 0.25)
    for name in scene:
        scene[name]
    assert set(calls.values()) == {1}
    own = TYPED.at(0.25).key
    assert {key[0] for key in calls if key[1] == own} == {"equilibria_at", "sets_at"}
    elsewhere = [key for key in calls if key[1] != own]
    assert len(elsewhere) == 2 * TYPED.m  # thm:geneps1(d) looks along z, to either side
    assert {key[2] for key in elsewhere} == {psi.tanh()}


def test_another_psi_shares_what_does_not_depend_on_it():
    first = LayerProblem(CASE_III.system.at(CASE_III.z), psi.hill(3))
    other = first.under(psi.hill(1))
    assert other.equator is first.equator
    assert other.location is first.location
    assert other.equator_cycle is first.equator_cycle
    assert other.critical[0].trace != first.critical[0].trace
    assert first.under(psi.hill(3)) is first
    assert other.under(psi.constant()).equator is first.equator


def test_one_that_nobody_holds_is_gone_at_once_and_those_under_another_psi_go_on_without_it():
    first = LayerProblem(CASE_III.system.at(CASE_III.z), psi.hill(3))
    other, gone = first.under(psi.hill(1)), weakref.ref(first)
    on, critical = first.equator, other.critical
    gc.disable()  # a search for garbage stops everybody who drags
    try:
        del first
        assert gone() is None
    finally:
        gc.enable()
    assert other.equator.theta.tolist() == on.theta.tolist()
    assert other.critical is critical
    assert other.under(psi.hill(1)) is other
    assert other.under(psi.hill(3)).equator is other.equator


def test_it_is_pickled_by_what_it_is_a_problem_of():
    first = LayerProblem(CASE_III.system.at(CASE_III.z), psi.hill(3))
    for one in (first, first.under(psi.hill(1)), c2.Scene(CASE_III.system, psi.hill(2), CASE_III.z).problem):
        again = pickle.loads(pickle.dumps(one))
        assert (again.at.plane, again.psi) == (one.at.plane, one.psi)
        assert again.critical[0].trace == one.critical[0].trace


def test_results_from_above_are_kept_in_it():
    own = LayerProblem(CASE_III.system.at(CASE_III.z), CASE_III.psi)
    assert own.keep(cycles_of) is own.keep(cycles_of)
    assert own.keep(portrait) is own.keep(portrait)
    assert own.keep(portrait) == c2.classify(CASE_III.system, CASE_III.psi, CASE_III.z)
    known = LayerProblem(own.at, own.psi).give(cycles_of, own.keep(cycles_of))
    assert known.keep(cycles_of) is own.keep(cycles_of)


def test_the_slow_flow_of_a_typed_law_on_a_cycle_is_the_mean_of_w():
    """U is e-linear and W is not: W at the mean of e_Psi is not the mean of W."""
    ours = CASE_III.system.at(CASE_III.z)
    a, b, d, f1, f2 = ours.plane
    U = (f"{a!r}*c - {b!r}*s + {f1!r}", f"{b!r}*c + {d!r}*s + {f2!r}")
    typed = c2.System(U=U, W=("c**2 + s**2",))
    regularisation = psi.hill(4)
    same = c2.limit_cycles(ours, regularisation)[0]
    found = c2.limit_cycles(typed, regularisation, 0.0)[0]
    assert found.period == pytest.approx(same.period, rel=1e-12)
    assert found.slow_flow[0] > float(same.mean_e @ same.mean_e) + 1e-4


@pytest.mark.parametrize("system", [c2.ELinear(-2.0, 0.0, -1.0), c2.ELinear(-1.0, 0.0, -1.0), TYPED])
def test_where_the_equator_has_directions_no_closed_orbit_is_looked_for(monkeypatch, system):
    def never(_at):
        raise AssertionError("looked for")

    monkeypatch.setattr(problem, "equator_cycle", never)
    own = LayerProblem(system.at((0.2,) * system.m), psi.tanh())
    assert len(own.equator) or own.equator.all_directions
    assert own.equator_cycle is None
