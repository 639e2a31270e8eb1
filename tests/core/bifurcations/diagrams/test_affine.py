"""A general system whose U is affine in (c, s): places are in its own axes, and cycles those of an e-linear one."""

import math

import numpy as np
import pytest

import codim2_core as c2

PSI = c2.psi.hill(3)
#: A matrix and f whose cycles are born, fold and become the equator, in axes that turn by p*k + 0.4.
TURNING = tuple(
    text.replace("C", "cos(k*p+0.4)").replace("S", "sin(k*p+0.4)")
    for text in (
        "(0.693*C*C-0.845*S*S)*c+(-0.915+1.538*S*C)*s+C*(p+0.3)-0.476*S",
        "(0.915+1.538*S*C)*c+(0.693*S*S-0.845*C*C)*s+S*(p+0.3)+0.476*C",
    )
)
SPAN = (-0.1, 0.4)


def turning(k):
    return c2.System(U=TURNING, parameters={"k": k, "p": 0.0})


#: name, system, along, z
CASES = {
    "axes at rest": (turning(0.0), "p", ()),
    "axes that turn": (turning(1.5), "p", ()),
    "axes that turn past the cut of their angle": (turning(-4.0), "p", ()),
    "along z": (c2.System(U=tuple(u.replace("p", "z1").replace("k", "2.5") for u in TURNING)), "z1", (0.0,)),
    "a matrix, along f1": (c2.ELinear.from_matrix([[0.5, 1.0], [-2.0, -0.9]], (0.1, 0.3)), "f1", ()),
    "frozen, along n": (turning(1.5).evolve(p=0.1).at(), "n", ()),
    "a matrix that turns past the cut": (
        c2.ELinear.from_matrix([["0.2-p", "p"], ["p-0.4", "-0.9"]], ("0.3-p", 0.3), parameters={"p": 0.1}), "p", (),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_everything_told_stands_where_it_is_at_its_value(name):
    system, along, z = CASES[name]
    span = (-1.0, 1.0) if name.startswith("a matrix") else (2.0, 4.0) if along == "n" else SPAN
    found = c2.branches(system, PSI, along, span, z)
    assert found.critical
    assert found.limit_directions or found.closed

    def at(value):
        if along == "n":
            return system
        return system.at(value) if along == "z1" else system.evolve(**{along: float(value)}).at(z)

    for branch in found.limit_directions:
        for value, theta in zip(branch.value[1:-1], branch.theta[1:-1], strict=True):
            e = np.array([math.cos(theta), math.sin(theta)])
            U = at(value).U(e)
            assert abs(e[0] * U[1] - e[1] * U[0]) < 1e-10
    for branch in found.critical:
        for value, e in zip(branch.value[1:-1], branch.e[1:-1], strict=True):
            assert np.hypot(*at(value).U(e)) < 1e-10
    for one in found.standing:
        if one.kind == "transcritical":
            assert np.hypot(*at(one.value).U(one.place)) < 1e-8
            assert f"θ = {math.atan2(*one.place[::-1]) % math.tau:.4g}" in one.sentence
        if one.kind == "saddle-node":
            U = at(one.value).U(one.place)
            assert abs(one.place[0] * U[1] - one.place[1] * U[0]) < 1e-10
    assert len(found.cycles) or name.endswith("cut")
    for branch in found.cycles:
        i = len(branch) // 2
        lines = [
            cycle.points
            for cycle in c2.limit_cycles(at(branch.value[i]), c2.psi.hill(branch.value[i]) if along == "n" else PSI)
        ]
        assert min(np.hypot(*(line - branch.section[i]).T).min() for line in lines) < 0.02


def test_a_system_with_a_clock_is_that_of_the_instant_0():
    shaken = c2.System(U=("-mu*c + F*cos(w*t)", "-mu*s + 0.1"), parameters={"mu": 0.3, "F": 0.5, "w": 2.0})
    first, second = (c2.branches(shaken, PSI, "F", (-1.0, 1.0), z) for z in ((), (0.0,)))
    reach = math.sqrt(0.3**2 - 0.1**2)
    assert [one.value for one in first.special if one.kind == "transcritical"] == pytest.approx([-reach, reach])
    assert [one.value for one in first.special] == [one.value for one in second.special]
