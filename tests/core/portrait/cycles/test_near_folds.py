"""Close to a fold of cycles, on either side, the count is named as undecided within what it is decided by."""

import pytest

import codim2_core as c2

from ....words.recognition import recognise

A = (-0.4902411495421009, -0.8112187473479301, 0.4224017699157944)
F2, FOLD = 0.26872945922028, 0.111040034272268  # of f1, to within 1e-11 by bisection; two cycles below it


def gap(system):
    """Cycles, and how near a fold they are said to be; None if nothing is said of one."""
    found = c2.limit_cycles(system, c2.psi.hill(6))
    said = dict(pair for note in found.notes for pair in recognise(note))
    near = said.get("near a fold")
    return len(found), near and near["gap"]


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("distance", [1e-10, 1e-9, 1e-8, 1e-7])
def test_within_1e_6_of_a_fold_the_count_is_undecided(side, distance):
    count, near = gap(c2.ELinear(*A, (FOLD + side * distance, F2)))
    assert near is not None
    assert count == (0 if side > 0.0 else 2)  # as found: the note says that it may be the other


@pytest.mark.parametrize(("side", "wanted"), [(-1.0, 2), (1.0, 0)])
def test_further_away_it_is_not(side, wanted):
    assert gap(c2.ELinear(*A, (FOLD + side * 1e-5, F2))) == (wanted, None)


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_general_systems_say_it_as_well(side):
    """The same system with a term of c^3 that vanishes to rounding: no e-linear system any more."""
    a, b, d = A
    U = f"{a!r}*c - {b!r}*s + {FOLD + side * 1e-8!r} + 1e-13*c**3", f"{b!r}*c + {d!r}*s + {F2!r}"
    assert gap(c2.System(U=U))[1] is not None
