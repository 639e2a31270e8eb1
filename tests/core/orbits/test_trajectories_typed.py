"""Trajectories of typed systems: the compiled field, what compiles and what does not, and what it does outside."""

import math

import numpy as np
import pytest
from numba import njit
from scipy.integrate import solve_ivp

from codim2_core import examples, hemisphere, psi
from codim2_core.expressions.expression import parse
from codim2_core.expressions.source import program
from codim2_core.orbits.departures import departures
from codim2_core.orbits.trajectories import Status, continuation, is_warm, trajectories, warm
from codim2_core.stepping.layout import K0, LANES, PARAMETERS, SIGN, STATE, WIDTH, WORKSPACE, call_field
from codim2_core.stepping.problem import problem
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.typed import System
from codim2_core.systems.typed_formulas import MOST_NUMBERS

from .seeds import ring, sunflower

FAMILIES = [
    psi.constant(),
    psi.rational(),
    psi.exponential(),
    psi.tanh(),
    psi.hill(4.0),
    psi.hill(3.7),
    psi.custom("1/(1+s)**2"),
]
NAMES = [p.text for p in FAMILIES]
AR, NU = examples.attracting_repelling(), examples.nonunique_sliding()
ODD = System(
    U=("sin(3*c) - k*exp(s) + x*y", "tanh(c) - s + c**3*sqrt(2 + c*s) - x/(1 + y**2)"), W=("-z",), parameters={"k": 0.5}
)


def as_text(system):
    """The same e-linear system as typed formulas."""
    a, b, d, f1, f2 = system.at(()).plane
    values = {"a": a, "b": b, "d": d, "f1": f1, "f2": f2}
    return System(U=("a*c - b*s + f1", "b*c + d*s + f2"), parameters=values)


@njit
def evaluate(address, S, P):
    call_field(address, S, STATE, K0, P)


def compiled(at, p, states, signs):
    """Field (LANES, 3) as compiled, in its own time unit."""
    todo = problem(at, p)
    S, P = np.zeros(WORKSPACE), np.zeros(PARAMETERS)
    P[:SIGN], P[SIGN:] = todo.shared, signs
    S[STATE : STATE + WIDTH] = states.T.ravel()
    evaluate(todo.address, S, P)
    return S[K0 : K0 + WIDTH].reshape(3, LANES).T


# ---- the field ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
@pytest.mark.parametrize("system", [AR, NU, ODD], ids=["attracting-repelling", "nonunique", "odd"])
def test_compiled_field_is_the_flow_on_the_disc(system, p):
    at = system.at(0.3)
    points = np.concatenate([sunflower(LANES - 2), [[0.0, 0.0], [0.6, -0.8]]])
    w = hemisphere.height(points)
    found = compiled(at, p, np.column_stack([points, w]), -1.0) * at.speed
    expected = hemisphere.flow(at, p, points)
    assert np.abs(found[:, :2] - expected).max() < 1e-14 * at.speed * 4
    radial = (points * at.U(hemisphere.e_psi(p, points))).sum(axis=1)
    assert np.abs(found[:, 2] + w * radial).max() < 1e-14 * at.speed * 4


@pytest.mark.parametrize("system", [AR, NU, ODD], ids=["attracting-repelling", "nonunique", "odd"])
def test_outside_e_is_the_direction_and_x_y_the_place(system):
    at = system.at(0.3)
    e, rho = ring(LANES, 1.0), np.geomspace(1e-3, 3.0, LANES)
    found = compiled(at, psi.tanh(), np.column_stack([e, rho]), 1.0) * at.speed
    U = at.U(e, rho[:, None] * e)
    radial = (e * U).sum(axis=1)
    assert np.abs(found[:, :2] - (U - e * radial[:, None])).max() < 1e-13 * at.speed
    assert np.abs(found[:, 2] - rho * radial).max() < 1e-13 * at.speed


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
@pytest.mark.parametrize("backward", [False, True])
def test_text_and_built_in_are_the_same_system(p, backward):
    built_in = ELinear(-2.0, 0.5, -1.0, (-0.5, 0.2))
    seeds = np.concatenate([sunflower(24), ring(12, 1.4), ring(4, 1.0)])
    options = {"rtol": 1e-12, "atol": 1e-13, "capture": 1e-14, "t_max": 3.0, "view": 1e9, "backward": backward}
    one = trajectories(built_in, p, seeds, samples="ends", **options)
    other = trajectories(as_text(built_in), p, seeds, samples="ends", **options)
    # Rounding off the sphere counts against Psi = 1 too: nothing here grows by more than e^9.
    assert np.abs(one.ends - other.ends).max() < 1e-9
    assert one.status == other.status


@pytest.mark.parametrize("system", [AR, NU, ODD], ids=["attracting-repelling", "nonunique", "odd"])
def test_against_an_independent_integrator(system):
    at, p, seeds = system.at(0.3), psi.exponential(), sunflower(5, 0.9)
    options = {"t_max": 3.0, "rtol": 1e-11, "atol": 1e-12, "capture": 1e-15, "samples": "ends"}
    result = trajectories(system, p, seeds, 0.3, **options)
    for seed, end in zip(seeds, result.ends, strict=True):
        other = solve_ivp(lambda t, q: hemisphere.flow(at, p, q), (0, 3), seed, method="DOP853", rtol=1e-12, atol=1e-13)
        assert np.abs(other.y[:, -1] - end[:2]).max() < 1e-9


def test_exact_spiral_outside():
    """(x, y)' = k (x, y) + w (-y, x): rho = rho0/(1 - k rho0 T), theta = theta0 - w/k ln(1 - k rho0 T)."""
    k, w = -0.7, 1.9
    system = System(U=("k*x - w*y", "w*x + k*y"), parameters={"k": k, "w": w})
    seeds, T = ring(8, 2.5), 4.0
    with pytest.raises(ValueError, match="only rescales time"):
        System(U=("1e-200*c", "1e-200*s")).at()
    result = trajectories(system, psi.constant(), seeds, t_max=T, rtol=1e-12, atol=1e-13, view=10.0, capture=1e-15)
    growth = 1.0 - k * 1.5 * T
    angle = np.arctan2(seeds[:, 1], seeds[:, 0]) - w / k * math.log(growth)
    assert np.abs(result.ends[:, :2] - np.stack([np.cos(angle), np.sin(angle)], axis=-1)).max() < 1e-10
    assert np.abs(result.ends[:, 2] / (1.5 / growth) - 1.0).max() < 1e-10


def test_a_formula_that_ends_at_the_sphere_is_never_left():
    """Steps stray off |p|^2 + w^2 = 1 by their own error; e must not stray beyond |e| = 1 with them."""
    system = System(U=("-c + 0.3*sqrt(1 + 1e-13 - c**2 - s**2)", "-s + 0.4*c"))
    for p in (psi.constant(), psi.tanh()):
        result = trajectories(system, p, np.concatenate([sunflower(30), ring(10, 1.0)]), rtol=1e-3, atol=1e-3)
        assert np.isfinite(result.buffer).all()
        assert Status.STEP_LIMIT not in result.status


# ---- compiled once ------------------------------------------------------------------------------------------------


def test_neither_parameters_nor_z_nor_psi_compile_anything():
    system = System(U=("2*c**2 - q*c - 1/3 + z/7", "-s*q"), W=("-z",), parameters={"q": 1.0})
    trajectories(ELinear(-1.0, 0.0, -1.0), psi.tanh(), [(0.1, 0.2)])
    assert not is_warm(psi.constant(), system)
    warm(psi.constant(), system)
    address = problem(system.at(0.0), psi.constant()).address
    for p in FAMILIES[:-1]:
        other = system.evolve(q=2.5).at(0.7)
        assert is_warm(p, other)
        assert problem(other, p, backward=True).address == address
    assert is_warm(psi.tanh(), System(U=system.U, W=("-2*z",), parameters={"q": 7.0}))
    assert not is_warm(psi.tanh(), system.evolve(U=("2*c**2 - q*c", "-s*q")))
    fresh = psi.custom("1/(1+s)**2.5")
    assert not is_warm(fresh, system)
    warm(fresh, system)
    assert is_warm(fresh, system)


@pytest.mark.parametrize("system", [ODD.at(0.3), ELinear(-2.0, 0.5, -1.0, (-0.5, 0.2)).at()], ids=["typed", "built in"])
def test_reversed_is_backward(system):
    ahead, back = problem(system, psi.hill(3.7)), problem(system, psi.hill(3.7), backward=True)
    np.testing.assert_array_equal(ahead.reversed.shared, back.shared)
    np.testing.assert_array_equal(back.reversed.shared, ahead.shared)


def test_parameters_may_have_any_name():
    names = ["D", "S", "P", "lane", "factor", "q", "u", "gain", "px", "n0", "t1", "w", "rho", "carray"]
    values = {name: 0.1 * (i + 1) for i, name in enumerate(names)}
    system = System(U=("-c + " + "*".join(names), " + ".join(names) + " - 9*s"), parameters=values)
    at = system.at()
    points = sunflower(LANES)
    found = compiled(at, psi.rational(), np.column_stack([points, hemisphere.height(points)]), -1.0) * at.speed
    assert np.abs(found[:, :2] - hemisphere.flow(at, psi.rational(), points)).max() < 1e-12


def test_as_many_numbers_as_are_allowed():
    values = {f"k{i}": math.sin(1.0 + i) for i in range(MOST_NUMBERS)}
    names = list(values)
    system = System(U=("-c + " + " + ".join(names[:16]), "-s + " + "+c*".join(names[16:])), parameters=values)
    at, points = system.at(), sunflower(LANES)
    for p in (psi.hill(3.7), psi.hill(5)):  # whose parameter lies among those numbers
        found = compiled(at, p, np.column_stack([points, hemisphere.height(points)]), -1.0) * at.speed
        assert np.abs(found[:, :2] - hemisphere.flow(at, p, points)).max() < 1e-13 * at.speed


# ---- formulas as source -------------------------------------------------------------------------------------------

FORMULAS = [
    "2*c**2 - c - 1/2",
    "-(-c)**3 + s**-2 + c**0.5",
    "sin(c)*cos(s)/tan(1 + c) + abs(c - s)",
    "exp(-c)*log(2 + s)*sqrt(1 + c)*tanh(k) + sinh(c) - cosh(s) + atan(c*k)",
    "(c + s)**(1 + k) + 7",
    "-3",
]


def value(rows, values):
    written = program(rows, {name: name for name in values}, ("c", "s"))
    scope = {"math": math, **values}
    exec("\n".join([*written.before, *written.inside]), scope)
    return [eval(result, scope) for result in written.results], written


def test_source_means_the_formula():
    names = ("c", "s", "k")
    for text in FORMULAS:
        row = parse(text, names)
        for values in ({"c": 0.4, "s": 0.7, "k": 1.3}, {"c": 0.9, "s": 0.2, "k": -0.4}):
            assert value([row], values)[0][0] == pytest.approx(row.evaluate(values), rel=1e-14)


def test_equal_parts_are_computed_once_and_constant_ones_before_the_loop():
    rows = [parse(text, ("c", "s", "k")) for text in ("sin(c*s)*exp(k) + c*s", "sin(c*s) - exp(k)")]
    (_, _), written = value(rows, {"c": 0.3, "s": 0.4, "k": 0.5})
    assert len(written.before) == 1
    assert len(written.inside) == 5


@pytest.mark.parametrize(
    ("text", "entire"),
    [("c**3 - exp(s)*c/k", True), ("1/c", False), ("sqrt(c)", False), ("c**-1", False), ("sqrt(k)*c", True),
     ("log(1 + c)", False), ("c**k", False), ("abs(c)", False)],
)  # fmt: skip
def test_where_formulas_end_is_known(text, entire):
    assert program([parse(text, ("c", "s", "k"))], {n: n for n in "csk"}, ("c", "s")).entire is entire


# ---- up the hemisphere from a limit direction ---------------------------------------------------------------------


@pytest.mark.parametrize("p", [psi.constant(), psi.rational(), psi.tanh()], ids=lambda p: p.text)
def test_departure_is_on_the_orbit_to_fourth_order(p):
    """Start three times lower, follow up to where the other start is: they agree to ebar^4."""
    at = NU.at(0.3)
    chi = (1 + 2 * 0.3**2) / (1 + 0.3**2)
    theta = math.acos(math.sqrt(chi**2 + 2) / 2)  # Q2 of sec:nonunique
    low, high = (departures(at, p, [theta], rtol, False)[0] for rtol in (1e-13, 1e-6))
    assert high[2] / low[2] > 3.0
    drift = []
    for sign in (1.0, -1.0):  # also of a start that leaves the term of second order out
        start = low if sign > 0 else np.array([math.cos(theta), math.sin(theta), low[2]])

        def field(_, y):
            q, w = y[:2], y[2]
            zeta = math.hypot(*q) / w
            U = at.U(q / math.hypot(*q) * float(p.modulus(zeta)))
            return np.append(U - q * (q @ U), -w * (q @ U))

        def up(_, y):
            return y[2] - high[2]

        up.terminal = True
        path = solve_ivp(field, (0, 100), start, events=up, rtol=1e-13, atol=1e-18, method="DOP853")
        end = path.y_events[0][0]
        drift.append(abs(math.atan2(end[1], end[0]) - math.atan2(high[1], high[0])))
    assert drift[0] < 3e-12
    if p.family == "constant":  # the others are far smaller there
        assert drift[1] > 1e-8


def test_continuation_leads_to_the_critical_set_of_its_side():
    z = 0.3
    chi = (1 + 2 * z * z) / (1 + z * z)
    theta = math.acos(math.sqrt(chi**2 + 2) / 2)
    result = continuation(NU, psi.rational(), [theta, math.pi - theta], z, t_max=200.0)
    assert result.status == (Status.EQUILIBRIUM,) * 2
    assert result.ends[0, 0] > 0.1
    assert result.ends[1, 0] == pytest.approx(-result.ends[0, 0], abs=1e-5)


def test_what_is_no_limit_direction_is_refused():
    with pytest.raises(ValueError, match="no limit direction"):
        continuation(NU, psi.rational(), [0.2], 0.3)
    with pytest.raises(ValueError, match="lambda_rho"):
        continuation(AR, psi.rational(), [0.0], 0.3)
