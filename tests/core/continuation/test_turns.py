"""Turns side by side: against one at a time, and their derivatives against differences."""

import math

import numpy as np
import pytest

from codim2_core import ELinear, psi
from codim2_core.continuation.varied_system import Question, VariedSystem, follow
from codim2_core.layer_problem.vary import varied

SYSTEM = ELinear(1.0, 1.3, -1.2, (0.33, 0.07))
XI = [-3.0, -1.0, -0.4, 0.0, 0.5]


def family(p, name):
    def at(value):
        changed, member, _ = varied(SYSTEM, p, (), name, value)
        return changed.at(()), member

    made = VariedSystem(at, 1.0)
    made.ray = 1
    return made, p.parameter if name == "n" else getattr(SYSTEM.at(()), name)


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize(
    ("p", "name"), [(psi.hill(3), "f1"), (psi.tanh(), "a"), (psi.constant(), "d"), (psi.hill(2.5), "n")]
)
def test_derivatives_are_those_of_turns_nearby(p, name, backward):
    own, value = family(p, name)
    h = 1e-5

    def turns(dx, dv):
        return follow([Question(own, [x + dx for x in XI], [value + dv] * len(XI), [backward] * len(XI))])[0]

    asked = [turns(*moved) for moved in ((0.0, 0.0), (h, 0.0), (-h, 0.0), (0.0, h), (0.0, -h))]
    seen = 0
    for here, right, left, above, below in zip(*asked, strict=True):
        if None in (here, right, left, above, below):
            continue
        seen += 1
        assert here.by_xi == pytest.approx((right.shift - left.shift) / (2 * h), abs=1e-6, rel=1e-6)
        assert here.by_value == pytest.approx((above.shift - below.shift) / (2 * h), abs=1e-6, rel=1e-5)
        assert here.rate == pytest.approx((right.chi - left.chi) / (2 * h), rel=1e-7)
        assert here.drift == pytest.approx((above.chi - below.chi) / (2 * h), abs=1e-8, rel=1e-6)
    assert seen >= 2


def test_turns_of_several_families_are_what_they_are_alone():
    questions = []
    for k, (p, name) in enumerate([(psi.hill(3), "f1"), (psi.hill(3), "b"), (psi.tanh(), "f2"), (psi.hill(2), "n")]):
        own, value = family(p, name)
        own.ray = k
        questions.append(Question(own, XI, [value + 0.01 * i for i in range(len(XI))], [i % 2 == 0 for i in range(5)]))
    together = follow(questions)
    for question, found in zip(questions, together, strict=True):
        assert any(turn is not None for turn in found)
        for i, turn in enumerate(found):
            alone = follow([Question(question.family, *([v[i]] for v in question[1:4]))])[0][0]
            assert (alone is None) == (turn is None)
            if turn is not None:
                assert turn.value == question.values[i]
                assert turn.shift == pytest.approx(alone.shift, abs=1e-11)
                assert turn.exponent == pytest.approx(alone.exponent, abs=1e-11)
                assert turn.by_value == pytest.approx(alone.by_value, rel=1e-8)
                assert turn.p == pytest.approx(alone.p, abs=1e-14)


def test_there_is_no_turn_without_a_section():
    own, value = family(psi.hill(3), "a")
    found = follow([Question(own, [0.0, math.nan, 0.0], [-1.0, value, math.nan], [False] * 3)])
    assert found == [[None] * 3]


def test_where_turns_start_is_where_the_section_of_one_system_says():
    own, value = family(psi.hill(3), "f1")
    found = follow([Question(own, XI, [value] * len(XI), [False] * len(XI))])[0]
    section = own.section(value)
    states, q = section.states(np.array(XI))
    for turn, state, y in zip(found, states, np.exp(q), strict=True):
        if turn is not None:
            assert turn.p == pytest.approx(state[:2], abs=1e-14)
            assert turn.chi == pytest.approx(y / (1.0 + y), rel=1e-12)
            assert turn.shift == pytest.approx(float(section.displacement(np.array([turn.xi]), 1e-13)[0]), abs=1e-10)
