"""Portraits on both sides of a setting."""

import codim2_core as c2
from codim2_core.bifurcations.diagrams.neighbouring_portraits import sides
from codim2_core.portrait.layer_problem.vary import names


def test_the_pitchfork_has_two_on_one_side_and_four_on_the_other():
    # a = -1, d = -3/2, b = 0: four limit directions while |f1| < 1/2 (errata: fig:simCM2).
    system = c2.ELinear(-1.0, 0.0, -1.5, f=(-0.5, 0.0))
    found = sides(system, c2.psi.constant(), name="f1")
    assert (found.name, found.below, found.above) == ("f1", "CM2", "CM4")
    found = sides(system, c2.psi.constant(), name="d")
    assert (found.name, found.below, found.above) == ("d", "CM4", "CM2")


def test_what_the_system_lacks_is_replaced_by_what_it_has():
    ball, z = c2.examples.ball_in_pool(), (3.5 * 0.2 * c2.examples.GRAVITY, 0.0)
    assert sides(ball, c2.psi.constant(), z, "nothing").name == names(ball, c2.psi.constant(), z)[0]
    found = sides(ball, c2.psi.constant(), z, "z1")
    assert (found.name, found.below, found.above) == ("z1", "CM2", "NCM2")
