"""One thing varied by its name."""

from __future__ import annotations

import pytest

import codim2_core as c2
from codim2_core.portrait.layer_problem.vary import limits, names, value_of, vary

TEXT = c2.ELinear(1.0, "k*z1", -2, f=(0.1, "z2"), g=(0, 1), parameters={"k": 2.0})
HILL = c2.psi.hill(2)


def test_only_numbers_parameters_and_given_slow_variables_can_be_varied() -> None:
    assert names(TEXT, HILL, (0.3, 0.4)) == ("a", "d", "f1", "k", "z1", "z2", "n")
    assert names(TEXT.at((0.3, 0.4)), c2.psi.tanh(), (0.3, 0.4)) == ("a", "b", "d", "f1", "f2")
    assert names(c2.ELinear.from_matrix([[1, 2], [3, 4]], f=(1, 2)), HILL) == ("f1", "f2", "n")
    owner = c2.ELinear("n", 1, 1, parameters={"n": 4})
    assert names(owner, HILL) == ("b", "d", "f1", "f2", "n")
    assert vary(owner, HILL, (), "n", 7)[0].at().a == 7
    assert limits(owner, HILL, "n")[1] > limits(TEXT, HILL, "n")[1] == 1000
    for psi in (HILL, c2.psi.tanh()):  # with a parameter, and without
        assert limits(TEXT, psi, "a") == limits(TEXT, psi, "z1") == (-1e150, 1e150)


@pytest.mark.parametrize("name", ["a", "d", "f1", "k", "z1", "z2", "n"])
def test_varied_changes_that_one_thing(name: str) -> None:
    z = (0.3, 0.4)
    system, psi, slow = vary(TEXT, HILL, z, name, 5.5)
    for other in names(TEXT, HILL, z):
        wanted = 5.5 if other == name else value_of(TEXT, HILL, z, other)
        assert value_of(system, psi, slow, other) == wanted
    assert TEXT.at(z).plane != system.at(slow).plane or name == "n"
    assert (system is TEXT) == (name in ("z1", "z2", "n"))
    assert (psi is HILL) == (name != "n")


def test_a_frozen_system_and_short_names() -> None:
    frozen = TEXT.at((0.3, 0.4))
    assert vary(frozen, HILL, (), "b", 9)[0].plane == (1, 9, -2, 0.1, 0.4)
    assert vary(TEXT, HILL, (0.3, 0.4), "z", 9)[2] == (9, 0.4)
    assert value_of(TEXT, HILL, (0.3, 0.4), "z") == 0.3
    assert vary(c2.ELinear("z", 1, 1), HILL, 0.5, "z1", 2)[2] == (2,)


@pytest.mark.parametrize(
    ("system", "name", "value", "message"),
    [
        (TEXT, "b", 1, "choose one of a, d, f1, k, z1, z2, n"), (TEXT, "z3", 1, "cannot be varied"),
        (TEXT, "zeta", 1, "cannot be varied"), (TEXT, "a", "x", "give a number"),
        (TEXT, "z1", float("nan"), "finite"), (TEXT, "z1", 2e150, "of size up to"),
        (TEXT, "a", -2e150, "of size up to"), (TEXT.at((1, 1)), "a", float("inf"), "finite"),
        (TEXT.at((1, 1)), "z1", 1, "cannot be varied"), (TEXT, "n", 0, "allowed is"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_explained(system: object, name: str, value: float, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        vary(system, HILL, (0.3, 0.4), name, value)
