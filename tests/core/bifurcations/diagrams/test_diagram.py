"""One-parameter diagrams: special values in closed form, and branches against the exact answer at single values."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import codim2_core as c2
from codim2_core.bifurcations.diagrams.equilibrium_branches import equilibrium_branches
from codim2_core.bifurcations.diagrams.result import Branches
from codim2_core.portrait.layer_problem import vary
from tests.core.general_systems import NONUNIQUE

PSIS = (c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(3), c2.psi.rational(), c2.psi.exponential())


def found(D: Branches, kind: str) -> list[float]:
    return [s.value for s in D.special if s.kind == kind]


def check(system: object, psi: c2.Psi, z: tuple[float, ...], D: Branches, value: float) -> None:
    """Branches at one value are what the exact functions say there."""
    at, psi_at, z_at = vary.vary(system, psi, z, D.along, value)
    equator, critical = c2.equator_equilibria(at, z_at), c2.critical_sets(at, psi_at, z_at)
    branches = [b for b in D.limit_directions if b.value[0] <= value <= b.value[-1]]
    assert len(branches) == len(equator)
    taken = set()
    for b in branches:
        theta = np.interp(value, b.value, b.theta)
        away = [abs(math.remainder(theta - t, 2 * math.pi)) for t in equator.theta]
        i = int(np.argmin(away))
        assert away[i] < 0.05
        assert b.kind == equator.kind(i)
        taken.add(i)
    assert len(taken) == len(equator)
    sets = [b for b in D.critical if b.value[0] <= value <= b.value[-1]]
    assert [b.kind for b in sets] == [C.kind for C in critical]
    for b, C in zip(sets, critical, strict=True):
        p = [np.interp(value, b.value, b.p[:, k]) for k in (0, 1)]
        assert np.hypot(*(p - C.p)) < 0.05
    closed = [b for b in D.closed if b.value[0] - 0.4 <= value <= b.value[-1] + 0.4]
    assert len(equator) > 0 or closed


def test_pitchforks_and_transcriticals_of_the_symmetric_case() -> None:
    D = equilibrium_branches(c2.ELinear(-1, 0, -1.5), c2.psi.constant(), "f1", (-2, 2))
    assert_allclose(found(D, "pitchfork"), [-0.5, 0.5], rtol=0.0, atol=1e-12)
    assert_allclose(found(D, "transcritical"), [-1, 1], rtol=0.0, atol=1e-12)
    assert len(D.special) == 4
    places = [s.place for s in D.special if s.kind == "pitchfork"]
    assert_allclose(places, [(1, 0), (-1, 0)], rtol=0.0, atol=1e-12)
    assert {b.kind for b in D.critical} == {"stable node"}
    assert_allclose(D.critical[0].radius[[0, -1]], 1, rtol=0.0, atol=1e-12)


def test_all_directions_exchange_cusp_and_neutral_equator() -> None:
    ball = equilibrium_branches(c2.ELinear(-1, "z", -1, f=("z", 0)), c2.psi.tanh(), "z1", (-1, 1), z=(0.5,))
    assert_allclose(found(ball, "all directions"), [0], rtol=0.0, atol=1e-12)
    # theta = 0 is always a limit direction, and another one passes through it
    D = equilibrium_branches(c2.ELinear(-1, 0.5, -1.5, f=(0.3, -0.5)), c2.psi.tanh(), "f1", (-2, 2))
    assert_allclose(found(D, "exchange of limit directions"), [-0.5], rtol=0.0, atol=1e-11)
    # through the end of the saddle-node curve
    D = equilibrium_branches(c2.ELinear(-1, 0, -1.5, f=(-0.5, 0)), c2.psi.constant(), "b", (-1, 1))
    assert_allclose(found(D, "pitchfork"), [0], rtol=0.0, atol=1e-9)
    cusp = c2.bifurcations.saddle_node(c2.ELinear(-1, 0.2, -1.5)).special[0]
    assert cusp.type == "cusp"
    f1, f2 = cusp.place
    D = equilibrium_branches(
        c2.ELinear(-1, 0.2, -1.5, f=(f"{f1!r} + z", f"{f2!r} - 2*z")), c2.psi.tanh(), "z", (-0.3, 0.2), z=0
    )
    assert_allclose(found(D, "cusp"), [0], rtol=0.0, atol=1e-9)
    D = equilibrium_branches(c2.ELinear(1, 2, -1), c2.psi.tanh(), "a", (0, 3))
    assert_allclose(found(D, "neutral equator"), [1], rtol=0.0, atol=1e-12)
    assert [b.kind for b in D.closed] == ["attracting from outside", "repelling from outside"]


def test_a_close_pair_between_two_grid_points_is_found() -> None:
    for gap in (1e-3, 1e-5, 1e-6):
        # |A^-1 f| = |1 - u^2 + gap^2| passes 1 twice, at u = +-gap (and at u = sqrt(2)), with u = z - 0.1234
        text = f"1 - (z - 0.1234)**2 + {gap**2!r}"
        D = equilibrium_branches(c2.ELinear(-1, 0, -1, f=(text, 0)), c2.psi.tanh(), "z1", (-1, 1), z=(0,))
        assert_allclose(found(D, "transcritical"), [0.1234 - gap, 0.1234 + gap], rtol=0.0, atol=max(1e-12, 1e-15 / gap))


def test_a_critical_set_that_touches_the_equator_and_turns_back() -> None:
    D = equilibrium_branches(c2.ELinear(1.5, 0, 1, f=(0, 1)), c2.psi.hill(3), "b", (-3, 3))
    assert_allclose(found(D, "touching the equator"), [0], rtol=0.0, atol=1e-10)
    assert found(D, "transcritical") == []
    assert [(b.value[0], b.value[-1]) for b in D.critical if 0 in (b.value[0], b.value[-1])] or len(D.critical) >= 2


def test_poles_are_gaps() -> None:
    D = equilibrium_branches(c2.ELinear("1/z", 1, 1, f=(0.1, 0.2)), c2.psi.tanh(), "z1", (-2, 2), z=(1,))
    assert len(D.gaps) == 1
    low, high = D.gaps[0]
    assert low < 0 < high
    assert high - low < 0.02
    assert all(not low < s.value < high for s in D.special)


def test_persistently_degenerate_systems_have_their_branches() -> None:
    # Theta has a double zero all along: f1 = -b, a = d, f2 = 0
    D = equilibrium_branches(c2.ELinear("z", 1, "z", f=(0, -1)), c2.psi.tanh(), "z1", (-2, 2), z=(1,))
    assert {b.kind.split(", ")[1] for b in D.limit_directions} == {"angularly non-hyperbolic: saddle-node"}
    D = equilibrium_branches(c2.ELinear("z", 0, "z"), c2.psi.tanh(), "z1", (-2, 2), z=(1,))
    assert D.limit_directions == ()
    D = equilibrium_branches(c2.ELinear(0, 1, 0, f=(0.2, 0.1)), c2.psi.tanh(), "f1", (-2, 2))
    assert {b.kind for b in D.critical} == {"centre (linear)"}
    assert {b.kind for b in D.closed} == {"neutral"}


coefficients = st.one_of(st.floats(-2, 2), st.sampled_from([-1.0, -0.5, 0.0, 0.5, 1.0]))


@settings(max_examples=8, deadline=None)
@given(
    st.tuples(*[coefficients] * 5),
    st.sampled_from(["a", "b", "d", "f1", "f2", "z1"]),
    st.sampled_from(PSIS),
    st.lists(st.floats(-2.9, 2.9), min_size=8, max_size=8),
)
def test_branches_agree_with_the_exact_answers(
    plane: tuple[float, ...], name: str, psi: c2.Psi, values: list[float]
) -> None:
    a, b, d, f1, f2 = (round(v, 3) for v in plane)
    system = c2.ELinear(a, b, d, f=(f1, f2))
    if name == "z1":
        system = c2.ELinear(f"{a} + z*{d}", f"{b} - z**2/3", d, f=(f"{f1}*sin(3*z) + 0.17", f"{f2} + 0.31"))
    z = (0,) if name == "z1" else ()
    D = equilibrium_branches(system, psi, name, (-3, 3), z=z)
    assert list(D.special) == sorted(D.special, key=lambda s: s.value)
    special = np.array([s.value for s in D.special])
    for value in values:
        if len(special) and abs(special - value).min() < 1e-3:
            continue
        at, psi_at, z_at = vary.vary(system, psi, z, name, value)
        if (c2.equator_equilibria(at, z_at).multiplicity == 1).all() and not {
            d.name for d in c2.classify(at, psi_at, z_at).degeneracies
        } & {"all directions", "transcritical", "line of equilibria", "det A = 0"}:
            check(system, psi, z, D, value)


def test_values_are_located_to_the_last_digits() -> None:
    """Every special value again, by 50 digits of the closed condition behind it."""
    mp = pytest.importorskip("mpmath")
    D = equilibrium_branches(c2.ELinear(-1.3, 0.7, 0.9, f=(0.35, -0.42)), c2.psi.hill(2), "b", (-3, 3))
    with mp.workdps(50):
        a, d, f1, f2 = mp.mpf(-1.3), mp.mpf(0.9), mp.mpf(0.35), mp.mpf(-0.42)
        for s in D.special:
            if s.kind == "transcritical":
                gap = lambda b: (a * d + b * b) ** 2 - (d * f1 + b * f2) ** 2 - (a * f2 - b * f1) ** 2
                assert abs(mp.findroot(gap, s.value) - s.value) < 1e-13
            elif s.kind == "det A = 0":
                assert abs(abs(s.value) - mp.sqrt(-a * d)) < 1e-13
            elif s.kind == "saddle-node":
                t0 = math.atan2(s.place[1], s.place[0])
                both = lambda t, b: (
                    b + f2 * mp.cos(t) - f1 * mp.sin(t) + (d - a) * mp.sin(2 * t) / 2,
                    (d - a) * mp.cos(2 * t) - f2 * mp.sin(t) - f1 * mp.cos(t),
                )
                assert abs(mp.findroot(both, (t0, s.value))[1] - s.value) < 1e-13
    assert len(found(D, "transcritical")) + len(found(D, "saddle-node")) >= 4


_PLANE = ("a", "b", "d", "f1", "f2")
#: Not affine in its formulas, but for k = 0 in fact: it takes the general path.
_TYPED = c2.System(U=("a*c - b*s + f1 + k*c*s", "b*c + d*s + f2"), parameters=dict.fromkeys((*_PLANE, "k"), 0.0))


@settings(max_examples=6)
@given(st.tuples(*5 * [st.integers(-200, 200)]), st.sampled_from(_PLANE))
def test_typed_systems_have_the_special_values_of_their_e_linear_twins(hundredths, name) -> None:
    """Every special value of the equator, and none besides; det A = 0 outside the disc is nothing in general."""
    # off the round numbers, which are on the borders for every value of a parameter
    a, b, d, f1, f2 = (
        n / 100 + off for n, off in zip(hundredths, (0.0037, 0.0011, 0.0059, 0.0023, 0.0043), strict=True)
    )
    values = dict(zip(_PLANE, (a, b, d, f1, f2), strict=True))
    span = (values[name] - 1.013, values[name] + 0.971)
    D = equilibrium_branches(_TYPED.evolve(**values), c2.psi.tanh(), name, span)
    E = equilibrium_branches(c2.ELinear(a, b, d, (f1, f2)), c2.psi.tanh(), name, span)
    kinds = ("saddle-node", "transcritical", "Hopf", "neutral equator")
    # closer than the brackets of a typed diagram, two events are told at one value: see the test below
    assume(min(np.diff(sorted(v for kind in kinds for v in found(E, kind))), default=1.0) > 1e-6)
    for kind in kinds:
        exact = found(E, kind)
        assume(min(np.diff(exact), default=1.0) > 1e-4)
        assert_allclose(found(D, kind), exact, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "span", "values"),
    [
        ("f1", (-1.0, 1.0), (1.492, -0.54, 0.774, 0.0, -0.536)),
        ("f1", (0.04423, 2.04423), (1.95737, 0.05311, 0.26559, 1.04423, 1.68843)),  # 1.8e-4 apart
        ("b", (-1.62589, 0.37411), (0.82437, -0.62589, -0.54541, -1.35077, -0.14357)),
    ],
)
def test_directions_that_are_there_between_two_values_only_are_found(name, span, values) -> None:
    """A pair is born and one of it meets a third, between two values at which the counts are the same."""
    D = equilibrium_branches(_TYPED.evolve(**dict(zip(_PLANE, values, strict=True))), c2.psi.tanh(), name, span)
    a, b, d, *f = values
    exact = found(equilibrium_branches(c2.ELinear(a, b, d, f), c2.psi.tanh(), name, span), "saddle-node")
    assert np.diff(exact).min() < 0.005
    assert_allclose(found(D, "saddle-node"), exact, rtol=0.0, atol=1e-9)


def test_events_closer_than_a_bracket_are_both_told_with_their_values() -> None:
    """A saddle-node and a transcritical bifurcation 1.4e-8 apart, held against the e-linear system's."""
    values = dict(zip(_PLANE, (0.0037, 0.3911, 1.4859, -0.6877, 1.4543), strict=True))
    span = (-1.0093, 0.9747)
    D = equilibrium_branches(_TYPED.evolve(**values), c2.psi.tanh(), "a", span)
    a, b, d, *f = values.values()
    wanted = equilibrium_branches(c2.ELinear(a, b, d, f), c2.psi.tanh(), "a", span).special[:2]
    assert [s.kind for s in D.special[:2]] == [s.kind for s in wanted] == ["transcritical", "saddle-node"]
    assert_allclose([s.value for s in D.special[:2]], [s.value for s in wanted], rtol=0.0, atol=1e-11)


def test_pitchforks_of_a_general_system_are_both_named() -> None:
    """sec:nonunique with the errata: 8 limit directions become 4 at |z| = 2^(-1/4), in two pitchforks."""
    D = equilibrium_branches(NONUNIQUE, c2.psi.tanh(), "z1", (-1.5, 1.5), 0.3)
    forks = [s for s in D.special if s.kind == "pitchfork"]
    assert_allclose([s.value for s in forks], 2**-0.25 * np.array([-1, -1, 1, 1]), atol=1e-7)
    assert_allclose([s.place for s in forks], [(1, 0), (-1, 0)] * 2, atol=1e-2)
    assert not [s for s in D.special if s.kind == "saddle-node"]
