"""What stands still in a layer problem is found once, however many ask."""

import pickle

import codim2_core as c2
from codim2_core import psi
from codim2_core.portrait.layer_problem.problem import LayerProblem

CASE_III = c2.presets["case3-n3"]


def test_another_psi_shares_what_does_not_depend_on_it():
    first = LayerProblem(CASE_III.system.at(CASE_III.z), psi.hill(3))
    other = first.with_psi(psi.hill(1))
    assert other.equator is first.equator
    assert other.location is first.location
    assert other.equator_cycle is first.equator_cycle
    assert other.critical[0].trace != first.critical[0].trace
    assert first.with_psi(psi.hill(3)) is first
    assert other.with_psi(psi.constant()).equator is first.equator


def test_it_is_pickled_by_what_it_is_a_problem_of():
    first = LayerProblem(CASE_III.system.at(CASE_III.z), psi.hill(3))
    for one in (first, first.with_psi(psi.hill(1)), c2.Scene(CASE_III.system, psi.hill(2), CASE_III.z).problem):
        again = pickle.loads(pickle.dumps(one))
        assert (again.at.plane, again.psi) == (one.at.plane, one.psi)
        assert again.critical[0].trace == one.critical[0].trace
