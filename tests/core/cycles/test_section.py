"""Sections and their return maps: geometry by its definition, maps where x2' = A x2 is solved in closed form."""

import math
from fractions import Fraction
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest

import codim2_core as c2
from codim2_core.cycles import return_map
from codim2_core.cycles.return_map import INWARD, OUTWARD, RETURNED, UNDECIDED
from codim2_core.cycles.section import COARSE, FINE, INNER, Section, rays
from codim2_core.cycles.turn_section import OUTER, SPACING, TurnSection
from codim2_core.stepping.layout import LANES

PSIS = [c2.psi.constant(), c2.psi.rational(), c2.psi.tanh(), c2.psi.hill(3)]
EVERY = pytest.mark.parametrize("psi", PSIS, ids=lambda p: p.text)
XI = np.array([-9.0, -3.0, 0.0, 1.0, 4.0])


def section(psi, f=(0.4, -0.3), ray=None, a=1.0, b=3.0, d=-2.0):
    at = c2.ELinear(a, b, d, f).at()
    return Section(at, psi, c2.critical_sets(at, psi)[0], ray)


@pytest.mark.parametrize("e", [(0.0, 0.0), (0.3, -0.2), (-0.9, 0.4), (0.0, 0.999999)])
def test_rays_are_where_no_term_of_a_and_d_is_left_and_end_on_the_equator(e):
    for a, d in ((1.0, -2.0), (-0.3, 5.0)):
        found = rays(a, d, e, 1.0 - e[0] ** 2 - e[1] ** 2)
        assert len({(u[0] > 0.0, u[1] > 0.0) for *_, u in found}) == 4
        for reach, other, u in found:
            assert a * u[0] ** 2 + d * u[1] ** 2 == pytest.approx(0.0, abs=1e-14)
            assert math.hypot(*u) == pytest.approx(1.0)
            assert min(reach, other) > 0.0
            for r in (0.0, 0.4, reach):
                assert (e[0] + r * u[0]) ** 2 + (e[1] + r * u[1]) ** 2 - 1.0 == pytest.approx(
                    (r - reach) * (r + other), abs=1e-12
                )


@EVERY
def test_states_lie_on_the_ray_in_e(psi):
    one = section(psi)
    assert one.ray == max(range(4), key=lambda i: section(psi, ray=i).reach)
    for own in (one, section(psi, ray=(one.ray + 1) % 4)):
        states, q = own.states(XI)
        np.testing.assert_allclose((states**2).sum(axis=1), 1.0, rtol=0.0, atol=1e-14)
        r = own.reach / (1.0 + np.exp(-XI))
        np.testing.assert_allclose(
            c2.hemisphere.e_psi(psi, states[:, :2]), own.e + r[:, None] * own.u, rtol=0.0, atol=1e-12
        )
        x2 = states[:, :2] / states[:, 2:]
        np.testing.assert_allclose(np.exp(q), (x2 - own.critical.x2) @ own.u, rtol=1e-6)
        near = np.array([math.log(INNER / (1.0 - INNER))])
        away = own.states(near)[0]
        assert np.hypot(*(away[0, :2] / away[0, 2] - own.critical.x2)) == pytest.approx(own.inner, rel=0.5)
        assert (away[0, :2] / away[0, 2] - own.critical.x2) @ own.u == pytest.approx(own.inner, rel=1e-3)
        far = np.array([20.0, 100.0])
        there = own.states(own.xi_at_radius(far))[0]
        np.testing.assert_allclose(np.hypot(*there[:, :2].T) / there[:, 2], far, rtol=0.1)
        grid = own.grid()
        assert (np.diff(grid) > 0.0).all()
        assert grid[0] == pytest.approx(math.log(INNER))
        assert grid[-1] <= 600.0
        assert len(grid) <= 2 * LANES  # one more would be followed alone
        zeta = 1.0 / own.states(grid[grid >= math.log(9.0) - 1e-9])[0][:, 2]
        assert (zeta[1:] / zeta[:-1]).max() < 4.0  # no gap between the samples near C and those far out


@EVERY
def test_towards_the_equator_samples_go_on_evenly_in_the_logarithm_of_the_distance(psi):
    own = section(psi)
    grid = own.grid()
    states = own.states(grid)[0]
    distance = np.log(np.hypot(*states[:, :2].T) / states[:, 2])
    last = int(np.argmin(np.abs(grid - math.log(9.0))))  # the last of the inner samples, and the first that is passed
    steps = np.diff(distance[last:])[:-1]  # the last one is cut off
    assert len(steps) > 10
    np.testing.assert_allclose(steps, np.median(steps), rtol=0.12)  # they are placed by the expansion at the equator


@EVERY
def test_the_field_is_that_of_the_system_in_its_unit(psi):
    own, e = section(psi), np.array([(0.3, 0.1), (-0.2, 0.8)])
    at = own.coefficients
    assert own.rate == pytest.approx(math.hypot(1.0, 3.0, 2.0, 0.4, 0.3))
    np.testing.assert_allclose(own.rate * own.field(e), at.U(e), rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(own.rate * own.derivative(e), [[1.0, -3.0], [3.0, -2.0]], rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(own.inverse.T @ own.matrix, np.eye(2), rtol=0.0, atol=1e-14)
    assert section(psi, ray=2).ray == 2


@EVERY
@pytest.mark.parametrize("b", [3.0, -3.0])
@pytest.mark.parametrize("swap", [1.0, -1.0])
def test_without_f_a_turn_multiplies_x2(psi, b, swap):
    """A focus with trace -1: exp(-pi/omega) once round, omega^2 = det A - 1/4, whatever Psi is; T dtau = ebar dT."""
    own = section(psi, (0.0, 0.0), a=swap, b=b, d=-2.0 * swap)
    expected = -swap * math.pi / math.sqrt(7.0 - 0.25)
    for backward, sign in ((False, 1.0), (True, -1.0)):
        np.testing.assert_allclose(own.displacement(XI, FINE, backward), sign * expected, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(own.displacement(XI, COARSE), expected, rtol=0.0, atol=1e-6)
    ends, times, codes, _ = own.turn(own.states(XI)[0], FINE)
    assert (codes == RETURNED).all()
    np.testing.assert_allclose((ends**2).sum(axis=1), 1.0, rtol=0.0, atol=1e-13)
    assert (times > 0.0).all()
    zeta = np.hypot(*(own.states(XI[:1])[0][0, :2]))  # near C: T = tau
    assert times[0] / own.rate == pytest.approx(2.0 * math.pi / math.sqrt(6.75), rel=max(1e-3, 10.0 * zeta))


@EVERY
@pytest.mark.parametrize("f", [(0.0, 0.0), (0.02, -0.01)])
def test_orbits_that_do_not_return_are_told(psi, f):
    """A node, and outside a cycle's region the equator: inwards and outwards."""
    node = section(psi, f, a=-9.0, b=3.05, d=1.0)
    shift = node.displacement(node.grid()[::8], COARSE)
    assert not np.isnan(shift).any()
    codes = node.turn(node.states(node.grid()[::8])[0], COARSE)[2]
    assert (np.isinf(shift) == (codes != RETURNED)).all()
    assert (shift[codes == INWARD] == -np.inf).all()
    assert (shift[codes == OUTWARD] == np.inf).all()
    assert (codes != RETURNED).any()


def turned(psi, trace, U=None):
    """The ray of a typed system, U = A e with a focus of this trace."""
    a, d = 0.5 * trace + 0.3, 0.5 * trace - 0.3
    system = c2.System(U=U or (f"{a!r}*c - s + 0*c**2", f"c + {d!r}*s"), W=())
    at = system.at()
    sets = c2.critical_sets(at, psi)
    return TurnSection(at, psi, sets[0], sets), math.sqrt(1.0 - 0.3**2)


@EVERY
@pytest.mark.parametrize("trace", [-0.2, 0.3])
def test_first_turns_of_a_general_system_without_f(psi, trace):
    own, omega = turned(psi, trace)
    states, q = own.states(XI)
    np.testing.assert_allclose((states**2).sum(axis=1), 1.0, rtol=0.0, atol=1e-14)
    np.testing.assert_array_equal(q, XI)
    np.testing.assert_allclose(own.coordinate(states), XI, rtol=0.0, atol=1e-10)
    r = own.reach / (1.0 + np.exp(-XI))
    np.testing.assert_allclose(states[:, :2], own.critical.p + r[:, None] * own.u, rtol=0.0, atol=1e-14)
    for backward, sign in ((False, 1.0), (True, -1.0)):
        x2 = math.exp(sign * math.pi * trace / omega) * r / np.sqrt(1.0 - r * r)
        p = x2 / np.hypot(1.0, x2)
        rest = 1.0 / (np.hypot(1.0, x2) * (np.hypot(1.0, x2) + x2))  # 1 - p
        np.testing.assert_allclose(own.displacement(XI, FINE, backward), np.log(p / rest) - XI, rtol=0.0, atol=1e-6)


def test_the_ray_keeps_away_from_other_critical_sets():
    system = c2.System(U=("-(c - 1/10)*(c - 3/5)*(c + 1/2)", "-(s - 1/5)"))
    at, psi = system.at(), c2.psi.constant()
    sets = c2.critical_sets(at, psi)
    for C in sets:
        own = TurnSection(at, psi, C, sets)
        assert np.hypot(*(C.p + own.reach * own.u)) == pytest.approx(1.0, abs=1e-12)
        for D in sets:
            if D is not C:
                along = max(float((D.p - C.p) @ own.u), 0.0)
                assert np.hypot(*(D.p - C.p - along * own.u)) > 0.35 * np.hypot(*(D.p - C.p))
        states, _ = own.states(XI)
        np.testing.assert_allclose(own.coordinate(states), XI, rtol=0.0, atol=1e-9)
        r = own.reach / (1.0 + np.exp(-XI))
        np.testing.assert_allclose(states[:, :2], C.p + r[:, None] * own.u, rtol=0.0, atol=1e-14)
        np.testing.assert_allclose((states**2).sum(axis=1), 1.0, rtol=0.0, atol=1e-14)
        e = np.array([(0.3, 0.1)])
        np.testing.assert_allclose(own.rate * own.field(e), at.U(e), rtol=0.0, atol=1e-14)
        np.testing.assert_allclose(own.rate * own.derivative(e), at.DU(e), rtol=0.0, atol=1e-14)
        shift = own.displacement(np.array([-3.0, 3.0]))
        assert np.isinf(shift).all()  # nodes and a saddle: nothing turns
        if C.kind == "stable node":
            assert shift[0] == -np.inf
        grid = own.grid()
        first, last = own.states(grid[[0, -1]])[0]
        assert np.hypot(*(first[:2] - C.p)) == pytest.approx(INNER * own.reach, rel=1e-3)
        assert last[2] == pytest.approx(OUTER, rel=1e-2)
        np.testing.assert_allclose(np.diff(grid), SPACING, rtol=0.05)


INF, NAN = math.inf, math.nan
P, Q = (0.1, 0.2), (-0.4, 0.5)  # critical sets: the one the ray starts from, and another


@pytest.mark.parametrize(
    ("code", "end", "ebar", "expected"),
    [
        (RETURNED, (0.3, 0.2), 0.5, None),  # as far as it came
        (INWARD, (0.1005, 0.2), 0.5, -INF),
        (OUTWARD, (0.8, 0.2), 0.5, INF),
        (UNDECIDED, (0.8, 0.2), 0.5, NAN),
        (UNDECIDED, (0.10005, 0.2), 0.5, -INF),  # settled at the set itself
        (UNDECIDED, (-0.40005, 0.5), 0.5, INF),  # at another one
        (UNDECIDED, (0.8, 0.6), 5e-5, INF),  # on the equator
        (INWARD, (-0.40005, 0.5), 5e-5, -INF),
        (OUTWARD, (0.10005, 0.2), 0.5, -INF),
        (RETURNED, (0.10005, 0.2), 0.5, None),
    ],
)
def test_where_an_orbit_that_never_turned_has_settled(monkeypatch, code, end, ebar, expected):
    own = TurnSection.__new__(TurnSection)
    own.critical, own._rests = SimpleNamespace(p=np.array(P)), np.array([P, Q])
    own.u, own.reach, own.other = np.array([1.0, 0.0]), 0.8, 1.1
    monkeypatch.setattr(TurnSection, "kernel", (return_map, None))
    ends = np.array([(0.3, 0.2, 0.5), (*end, ebar)])
    monkeypatch.setattr(TurnSection, "turn", lambda *_: (ends, None, np.array([RETURNED, code]), None))
    xi = np.array([-0.3, 0.4])
    shift = own.displacement(xi)
    plain = own.coordinate(ends) - xi
    assert shift[0] == plain[0]  # whatever becomes of the other
    np.testing.assert_array_equal(shift[1], plain[1] if expected is None else expected)


@pytest.mark.parametrize("rtol", [1e-9, 1e-12])
def test_what_the_tolerance_cannot_tell_from_zero_is_zero(monkeypatch, rtol):
    """An error of 10 rtol in p is ``10 rtol (1/r + 1/(reach - r))`` in ln(r/(reach - r)), r = reach/(1 + exp(-q))."""
    own = TurnSection.__new__(TurnSection)
    own.critical, own._rests = SimpleNamespace(p=np.array(P)), np.array([P])
    own.u, own.reach, own.other = np.array([1.0, 0.0]), 0.8, 1.1
    monkeypatch.setattr(TurnSection, "kernel", (return_map, None))
    xi = np.array([-6.0, -3.0, -1.0, 0.0])
    r = own.reach / (1.0 + np.exp(-xi))
    for factor, told in ((5.0, False), (40.0, True)):
        for side in (1.0, -1.0):
            moved = np.log(r + side * factor * rtol) - np.log(own.reach - r)
            monkeypatch.setattr(TurnSection, "coordinate", lambda _, __, moved=moved: moved)
            ends = np.column_stack([np.array(P) + r[:, None] * own.u, np.full(4, 0.5)])
            monkeypatch.setattr(TurnSection, "turn", lambda *_, ends=ends: (ends, None, np.full(4, RETURNED), None))
            assert (own.displacement(xi, rtol) != 0.0).tolist() == [told] * 4


def test_of_sixteen_rays_the_one_that_keeps_furthest_away_is_taken():
    own = TurnSection.__new__(TurnSection)
    for away in ([(0.4, 0.3)], [(0.1, 0.0), (-0.5, 0.5)], [(0.3, 0.0), (0.0, 0.2), (-0.3, 0.0), (0.0, -0.2)]):
        u = own._direction([np.array(d) for d in away])
        assert math.hypot(*u) == pytest.approx(1.0)

        def room(v, away=away):
            """Of the distances of sets from a ray, the least."""
            along = np.linspace(0.0, 2.0, 801)[:, None] * v
            return min(np.hypot(*(along - np.array(d)).T).min() for d in away)

        others = [room(np.array([math.cos(t), math.sin(t)])) for t in np.linspace(0.0, 2.0 * math.pi, 180)]
        assert room(u) > 0.8 * max(others)


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize("b", [3.0, -3.0])
def test_an_orbit_has_gone_inward_when_it_is_far_within_where_it_began(monkeypatch, b, backward):
    """A thousandth of the innermost sample, or of a state that starts further in; and the sense is that of b."""
    own = section(PSIS[0], b=b)
    asked = []
    made = SimpleNamespace(returns=lambda *given: asked.append(given) or "returned")
    monkeypatch.setattr(Section, "kernel", (made, SimpleNamespace(address=7)))
    for distance in (0.5 * own.inner, 0.01 * own.inner, 30.0 * own.inner):
        x2 = own.critical.x2 + np.array([[1.0, 0.0], [0.0, distance]])
        states = np.column_stack([x2, np.ones(2)]) / np.hypot(1.0, np.hypot(*x2.T))[:, None]
        assert own.turn(states, 1e-9, backward, 5, 11, elsewhere=True) == "returned"
        _, *numbers, _, rtol, limit, record, elsewhere = asked.pop()
        address = numbers.pop(1)
        (shared,), (u,), (centre,), (sense,), (floor,), (sunk,) = numbers
        assert floor == pytest.approx(1e-3 * min(distance, own.inner), rel=1e-6)
        assert 0.0 < sunk < 1e-6
        assert (address, rtol, limit, record, elsewhere) == (7, 1e-9, 11, 5, True)
        np.testing.assert_array_equal(u, own.u)
        np.testing.assert_array_equal(centre, own.critical.x2)
        assert (sense > 0.0) == ((b > 0.0) != backward)
        np.testing.assert_allclose(
            shared[:5] * own.rate, np.array([1.0, b, -2.0, 0.4, -0.3]) * (-1.0 if backward else 1.0)
        )


def test_a_section_needs_a_critical_set():
    at = c2.ELinear(1.0, 3.0, -2.0, (9.0, 0.0)).at()
    inside = c2.critical_sets(c2.ELinear(1.0, 3.0, -2.0, (0.4, 0.3)), PSIS[0])[0]
    with pytest.raises(ValueError, match="no critical set"):
        Section(at, PSIS[0], inside)


@pytest.mark.parametrize("far", [1.0, 1e3, 1e6])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_reach_of_a_ray_has_all_digits_however_near_the_equator_its_foot_is(far, side):
    """|p + r u| = 1 for r = gap/(root + along) = root - along: one of them cancels."""
    at, psi = c2.ELinear(-1.0, 0.0, -2.0, (0.1, 0.0)).at(), c2.psi.rational()
    u = np.array([math.cos(math.pi / 32), math.sin(math.pi / 32)])  # the first of its directions
    x2 = side * far * u
    foot = SimpleNamespace(x2=x2, p=x2 / math.hypot(1.0, far))
    own = TurnSection(at, psi, foot, (foot,))
    assert own.u == pytest.approx(u, abs=1e-15)
    gap = Fraction(1) / (1 + Fraction(far) ** 2)
    along = side * math.sqrt(1 - gap)
    root = math.sqrt(along * along + float(gap))
    assert own.reach == pytest.approx(float(gap) / (root + along) if side > 0.0 else root - along, rel=1e-12)
    assert own.other == pytest.approx(float(gap) / own.reach, rel=1e-12)


def test_a_ray_that_starts_just_inside_the_equator_has_all_its_digits():
    """C = (1 - 1e-7, 0), and the ray leads outward: |p + r u| = 1 with 40 digits."""
    at, psi = c2.System(U=("-(c - 0.9999999) - 2*s", "2*(c - 0.9999999) - s")).at(), c2.psi.constant()
    (C,) = c2.critical_sets(at, psi)
    own = TurnSection(at, psi, C, (C,))
    with mpmath.workdps(40):
        x2, u = mpmath.matrix(C.x2.tolist()), mpmath.matrix(own.u.tolist())
        gap = 1 / (1 + x2[0] ** 2 + x2[1] ** 2)
        along = (x2[0] * u[0] + x2[1] * u[1]) * mpmath.sqrt(gap)
        reach = mpmath.sqrt(along**2 + gap) - along
    assert along > 0.9
    assert own.reach < 1e-6
    assert own.reach == pytest.approx(float(reach), rel=1e-13, abs=0.0)
    assert own.other == pytest.approx(float(gap / reach), rel=1e-13)
