"""Turns and their derivatives, against differences of turns nearby."""

import pytest

from codim2_core import ELinear, System, psi
from codim2_core.bifurcations.continuation.turns import SectionBase, VariedRay
from codim2_core.portrait.cycles.ray_section import TurnSection
from codim2_core.portrait.layer_problem.problem import LayerProblem
from codim2_core.portrait.layer_problem.vary import value_of, vary

SYSTEM = ELinear(1.0, 1.3, -1.2, (0.33, 0.07))
CUBIC = System(U=("c - k*s + 0.33 - 0.1*c**3", "k*c - 1.2*s + 0.07 + 0.2*c*c"), parameters={"k": 1.3})
XI = [-3.0, -1.0, -0.4, 0.0, 0.5]


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize("critical", [False, True])
@pytest.mark.parametrize(
    ("system", "p", "name"),
    [
        (SYSTEM, psi.hill(3), "f1"),
        (SYSTEM, psi.tanh(), "a"),
        (SYSTEM, psi.constant(), "d"),
        (SYSTEM, psi.hill(2.5), "n"),
        (CUBIC, psi.rational(), "k"),
    ],
)
def test_derivatives_are_those_of_turns_nearby(system, p, name, backward, critical):
    def problem(value):
        changed, member, _ = vary(system, p, (), name, value)
        return LayerProblem(changed.at(()), member)

    value, h = value_of(system, p, (), name), 1e-5
    C = problem(value).critical[0]
    foot = SectionBase(problem, value, C.e, critical)
    own = VariedRay(problem, 1.0, (-10.0, 10.0), foot, foot, TurnSection(problem(value), C).u)

    def turns(dx, dv):
        courses = [own.course(x + dx, value + dv, backward) for x in XI]
        return [None if course is None else course.turn for course in courses]

    asked = [turns(*moved) for moved in ((0.0, 0.0), (h, 0.0), (-h, 0.0), (0.0, h), (0.0, -h))]
    seen = 0
    for here, right, left, above, below in zip(*asked, strict=True):
        if None in (here, right, left, above, below):
            continue
        seen += 1
        assert here.by_xi == pytest.approx((right.shift - left.shift) / (2 * h), abs=1e-6, rel=1e-6)
        assert here.by_value == pytest.approx((above.shift - below.shift) / (2 * h), abs=1e-6, rel=1e-5)
        assert here.rate == pytest.approx((right.chi - left.chi) / (2 * h), rel=1e-7)
    assert seen >= 2
