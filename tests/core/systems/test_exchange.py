"""A system for other programs: SciPy follows its right-hand side, SymPy reads and writes it."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import codim2_core as c2

SYSTEMS = {
    "e-linear": (c2.ELinear(-2, 0.3, -1, f=(-0.5, "z"), B=((1, 2),), g=(1,)), (0.4, 0.3, 0.1)),
    "typed": (c2.System(U=("-k*c + 0.2*z", "-s + x"), W=("c - z",), parameters={"k": 1.5}), (0.4, 0.3, 0.1)),
    "with time": (c2.System(U=("-c + 0.5*cos(t)", "-s")), (0.4, 0.3, 0.0)),
    "no z": (c2.System(U=("-c - s", "-s")), (0.4, 0.3)),
}


@pytest.mark.parametrize("name", SYSTEMS)
def test_scipy_follows_the_right_hand_side_to_the_same_end(name):
    system, start = SYSTEMS[name]
    psi, eps = c2.psi.rational(), 0.05
    ours = c2.simulate(system, psi, start, (0.0, 0.6), eps=eps, rtol=1e-10, atol=1e-12).states[-1]
    theirs = solve_ivp(system.rhs(psi, eps), (0.0, 0.6), start, rtol=1e-10, atol=1e-12, method="DOP853").y[:, -1]
    assert np.abs(ours - theirs).max() < 1e-8


def test_many_states_at_once_no_time_and_the_limit():
    system, start = SYSTEMS["with time"]
    f = system.rhs()
    one = f(0.7, start[:2])
    assert np.allclose(one, [-0.8 + 0.5 * np.cos(0.7), -0.6], atol=1e-15)
    many = f(0.7, np.transpose([start[:2]] * 3))
    assert many.shape == (2, 3)
    assert np.array_equal(many[:, 1], one)
    assert f(0.0, start).tolist() == [*f(0.0, start[:2]).tolist(), 1.0]
    assert np.isnan(f(0.0, (0.0, 0.0))).all()


def test_what_is_missing_or_too_much_is_refused():
    system = SYSTEMS["no z"][0]
    for psi, eps in ((None, 0.1), (c2.psi.constant(), -1.0), (None, float("nan"))):
        with pytest.raises(ValueError, match="eps is"):
            system.rhs(psi, eps)
    with pytest.raises(ValueError, match="state has 3 numbers"):
        system.rhs()(0.0, (1.0, 2.0, 3.0))


def test_sympy_in_and_out():
    sympy = pytest.importorskip("sympy")
    c, s, x, t, k = sympy.symbols("c s x t k", real=True)
    U = (-k * c + sympy.Max(0, t - 3) - sympy.Abs(x) / 4, -s * sympy.sqrt(1 + s**2))
    system = c2.System(U=U, parameters={"k": 2.0})
    typed = c2.System(U=("-k*c + max(0, t - 3) - abs(x)/4", "-s*sqrt(1 + s**2)"), parameters={"k": 2.0})
    for state in ((0.3, 0.4, 5.0), (-0.3, 0.1, 1.0)):
        assert np.allclose(system.rhs()(0.0, state), typed.rhs()(0.0, state), atol=1e-14)
    found, _ = system.to_sympy()
    assert all(sympy.simplify(one - other) == 0 for one, other in zip(found, U, strict=True))
    (first, second), (slow,) = SYSTEMS["e-linear"][0].to_sympy()
    z = sympy.Symbol("z", real=True)
    assert sympy.expand(second - (0.3 * c - s + z)) == 0
    assert first.coeff(c) == -2
    assert slow == c + 2 * s + 1


def test_switches_are_those_of_sympy_too():
    sympy = pytest.importorskip("sympy")
    (U, _), _ = c2.System(U=("-c + (t > 3)*(t < 4) + mod(t, 2) + floor(t)", "-s")).to_sympy()
    t = sympy.Symbol("t", real=True)
    values = [float(U.subs({"c": 0}).subs({sympy.Symbol("c", real=True): 0, t: at})) for at in (2.5, 3.5)]
    assert values == [0.5 + 2.0, 1.0 + 1.5 + 3.0]


def test_a_psi_that_is_none_is_refused():
    with pytest.raises(ValueError, match="psi is 'hill:3'"):
        c2.System(U=("-c", "-s")).rhs("hill:3", 1e-3)


def test_a_typed_system_is_what_its_repr_makes():
    for system, _ in SYSTEMS.values():
        assert eval(repr(system), {"ELinear": c2.ELinear, "System": c2.System}) == system
