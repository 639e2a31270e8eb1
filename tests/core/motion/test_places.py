"""Where a motion lies, and which critical set it follows, against the formulas of the regularisation."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.initial_value.field import field
from codim2_core.initial_value.sheet import solved
from codim2_core.motion import phases, places
from codim2_core.motion.followed import followed, in_disc, place
from codim2_core.motion.limit import decide
from codim2_core.motion.result import Phase

PSIS = [c2.psi.constant(), c2.psi.rational(), c2.psi.exponential(), c2.psi.tanh(), c2.psi.hill(3)]
EVERY = pytest.mark.parametrize("psi", PSIS, ids=lambda p: p.text)
BENT = c2.System(U=("c**2 - z/2", "-2*s + x"), W=("1",))  # at c = -+sqrt(z/2): attracting, and a saddle


@EVERY
def test_a_point_of_the_disc_has_its_e(psi):
    for e in ((0.3, -0.4), (-0.05, 0.01), (0.0, 0.9)):
        p = in_disc(psi, np.array(e))
        assert c2.hemisphere.e_psi(psi, p) == pytest.approx(e, abs=1e-12)
    assert in_disc(psi, np.zeros(2)).tolist() == [0.0, 0.0]
    for e in ((0.6, 0.8), (3.0, -4.0)):
        assert in_disc(psi, np.array(e)) == pytest.approx(np.array(e) / math.hypot(*e), abs=1e-15)


@EVERY
@pytest.mark.parametrize("eps", [1e-3, 0.5])
def test_the_place_of_a_state(psi, eps):
    """e_Psi = (x, y)/sqrt(r^2 + eps^2 Psi(r^2/eps^2)) and p = (x, y)/sqrt(r^2 + eps^2)."""
    states = np.array([(0.3, -0.2), (1e-3, 2e-3), (-2.0, 0.1), (0.0, 0.0)])
    r2 = (states**2).sum(axis=1)
    e = states / np.sqrt(r2 + eps**2 * np.array([float(psi(r / eps**2)) for r in r2]))[:, None]
    p = states / np.sqrt(r2 + eps**2)[:, None]
    of_state = places.OfState(lambda t: states, psi, eps, 0.0, 1.0).at(np.arange(4.0))
    np.testing.assert_allclose(of_state[0], e, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(of_state[1], p, rtol=0.0, atol=1e-14)
    for (x, y), own_e, own_p in zip(states.tolist(), e, p, strict=True):
        found = place(psi, eps, x, y)
        np.testing.assert_allclose(found[0], own_e, rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(found[1], own_p, rtol=0.0, atol=1e-14)


def test_the_zero_near_a_guess():
    formulas = field(BENT)
    for z, root in ((0.5, 0.5), (0.02, 0.1)):
        for side in (1.0, -1.0):
            e = solved(formulas, np.array([side * (root + 0.05), 0.1]), np.array([z]))
            assert e == pytest.approx([side * root, 0.0], abs=1e-14)
    assert solved(formulas, np.array([0.3, 0.0]), np.array([-0.5])) is None  # no zero
    assert solved(formulas, np.array([0.0, 0.0]), np.array([0.5])) is None  # a singular slope
    assert solved(formulas, np.array([0.05, 0.0]), np.array([0.5])) is None  # a first step too long


@EVERY
def test_a_state_on_a_critical_set_follows_it(psi):
    formulas, eps, z = field(BENT), 1e-6, 0.18
    for C in c2.critical_sets(BENT, psi, (z,)):
        for far, follows in ((0.0, True), (5e-4, True), (0.2, False), (0.4, False)):
            p = C.p + far * np.array([0.6, 0.8])
            x2 = p / math.sqrt(1.0 - p @ p)
            one = followed(formulas, psi, eps, np.array([*(eps * x2), z]))
            assert (one is not None) == follows
            if one is not None:
                assert one.e == pytest.approx(C.e, abs=1e-12)
                assert one.p == pytest.approx(C.p, abs=1e-12)
                assert one.attracts == C.kind.startswith("stable")
    nothing = c2.System(U=("c - 2", "s"), W=("1",))
    assert followed(field(nothing), psi, eps, np.array([0.0, 0.0, z])) is None


class Motion:
    """Straight from (1, -1) through 0 at t = 1, then at rest there until 2, then out along y."""

    times = np.array([0.0, 0.5, 1.0, 2.0, 2.5])
    states = np.array([(1.0, -1.0, 0.1), (0.5, -0.5, 0.1), (0.0, 0.0, 0.1), (0.0, 0.0, 0.1), (0.0, 0.5, 0.1)])

    def __call__(self, t):
        return np.stack([np.interp(t, self.times, column) for column in self.states.T], axis=-1)


def test_in_the_limit_a_place_on_the_equator_is_a_direction_also_at_sigma():
    slip, out = places.OfState(Motion(), None, 0.0, 0.0, 1.0), places.OfState(Motion(), None, 0.0, 2.0, 2.5)
    e, p = slip.at(np.array([0.0, 0.8, 1.0]))
    np.testing.assert_allclose(e, [(math.sqrt(0.5), -math.sqrt(0.5))] * 3)
    np.testing.assert_array_equal(p, e)
    np.testing.assert_allclose(out.at(np.array([2.0, 2.2]))[0], [(0.0, 1.0)] * 2)
    between = places.OfState(Motion(), None, 0.0, 2.0, 2.2)
    np.testing.assert_allclose(between.at(np.array([2.0]))[0], [(0.0, 1.0)])


def test_places_on_sets_cycles_and_where_it_leaves():
    t = np.array([0.0, 0.5, 1.0])
    motion = lambda t: np.stack([0.0 * t, 0.0 * t, 0.1 + 0.2 * t], axis=-1)
    rough = np.array([(0.2, 0.01), (0.4, -0.01)])
    e, p = places.OnSet(BENT, PSIS[1], motion, np.array([0.0, 1.0]), rough).at(t)
    np.testing.assert_allclose(e, np.stack([np.sqrt(0.05 + 0.1 * t), 0.0 * t], axis=-1), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(p, [in_disc(PSIS[1], one) for one in e], rtol=0.0, atol=1e-14)
    e, p = places.OnCycle(
        np.array([0.0, 2.0]), np.array([(0.0, 1.0), (1.0, 3.0)]), np.array([(0.5, 0.0), (0.1, 0.2)])
    ).at(t)
    np.testing.assert_allclose(e, np.stack([0.5 * t, 1.0 + t], axis=-1))
    np.testing.assert_allclose(p, np.stack([0.5 - 0.2 * t, 0.1 * t], axis=-1))
    e, p = places.Leaving(2.0).at(t)
    np.testing.assert_allclose(e, [(math.cos(2.0), math.sin(2.0))] * 3)
    np.testing.assert_array_equal(p, e)


def test_beyond_the_equator_a_set_is_not_polished():
    """C = (z, 0) has left the disc: what was followed is the place on the equator."""
    system = c2.System(U=("z - c", "-s"), W=("1",))
    motion = lambda t: np.stack([0.0 * t, 0.0 * t, 1.0 + t], axis=-1)
    on_set = places.OnSet(system, PSIS[1], motion, np.array([-1.0, 1.0]), np.array([(0.0, 0.0), (1.0, 0.0)]))
    e, p = on_set.at(np.array([-0.5, 0.1, 0.9]))
    np.testing.assert_allclose(e, [(0.5, 0.0), (0.55, 0.0), (0.95, 0.0)], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(p, [in_disc(PSIS[1], one) for one in e], rtol=0.0, atol=1e-12)


def test_at_the_moment_of_arrival_the_nearest_moment_off_sigma_tells_the_direction():
    slip = places.OfState(Motion(), None, 0.0, 0.0, 2.5)  # rests in between
    e, _ = slip.at(np.array([1.0, 1.4, 2.0]))
    np.testing.assert_allclose(e, [(math.sqrt(0.5), -math.sqrt(0.5)), (math.sqrt(0.5), -math.sqrt(0.5)), (0.0, 1.0)])
    late = places.OfState(Motion(), None, 0.0, 0.6, 1.0)  # no step ends off Sigma: from the middle of the phase
    np.testing.assert_allclose(late.at(np.array([1.0]))[0], [(math.sqrt(0.5), -math.sqrt(0.5))])


def test_an_ascent_is_the_orbit_up_the_hemisphere():
    system = c2.ELinear(-1.0, 0.0, -2.0, (0.3, 0.0))
    ascent = places.Ascent(system, PSIS[0], np.zeros(0), theta=0.1)  # theta = 0 is a limit direction
    path = ascent.path()
    assert path[0] == pytest.approx((1.0, 0.0), abs=1e-6)
    assert path[-1] == pytest.approx((0.3, 0.0), abs=1e-3)
    inside = places.Ascent(system, PSIS[0], np.zeros(0), start=np.array([0.5, 0.5])).path()
    assert inside[0] == pytest.approx((0.5, 0.5))
    assert inside[-1] == pytest.approx((0.3, 0.0), abs=1e-3)
    turning = places.Ascent(c2.ELinear(-0.1, 3.0, -0.1), PSIS[0], np.zeros(0), theta=1.0).path()
    assert np.hypot(*turning[0]) == pytest.approx(places.BESIDE)
    assert 0.99 < places.BESIDE < 1.0
    assert math.atan2(turning[0, 1], turning[0, 0]) == pytest.approx(1.0)
    none = places.Ascent(c2.ELinear(-1.0, 0.0, -2.0, (3.0, 0.0)), PSIS[0], np.zeros(0), theta=0.0).path()
    assert none.shape == (0, 2)  # orbits only come down there
    assert not none.flags.writeable
    line = places.Ascent(system, PSIS[0], np.zeros(0), along=(np.zeros(2), np.ones(2)))
    assert line.path().tolist() == [[0.0, 0.0], [1.0, 1.0]]


def test_the_distance_to_a_closed_line():
    square = np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])
    for p, expected in (((0.0, 0.2), 0.8), ((1.5, 0.3), 0.5), ((4.0, 5.0), 5.0), ((0.7, -0.1), 0.3)):
        assert phases._distance(np.array(p), square) == pytest.approx(expected)


def test_runs_on_one_set_are_joined_over_an_excursion():
    def run(first, last, onto="C", e=(0.0, 0.0), end=(0.1, 0.0)):
        return phases._Run(first, last, float(first), float(last), onto, (np.array(e), np.array(end)))

    joined = phases._joined([run(0, 3), run(5, 8, e=(0.12, 0.0), end=(0.3, 0.0))])
    assert [(one.first, one.last, one.t_start, one.t_end) for one in joined] == [(0, 8, 0.0, 8.0)]
    assert joined[0].e[1].tolist() == [0.3, 0.0]
    assert len(phases._joined([run(0, 3), run(5, 8, e=(0.25, 0.0))])) == 2  # elsewhere
    assert len(phases._joined([run(0, 3), run(4, 8, e=(0.25, 0.0))])) == 1  # the next step end
    assert len(phases._joined([run(0, 3), run(5, 8, onto="C2")])) == 2


def test_the_angle_through_which_a_motion_turns():
    reader = phases._ReadMotion(BENT, PSIS[0], 1e-3, Motion(), None, 1e-8)
    angle = np.linspace(0.0, 7.0, 60)
    for sign in (1.0, -1.0):
        circle = np.stack([3.0 + np.cos(sign * angle), np.sin(sign * angle) - 5.0], axis=-1)
        assert reader.turned(circle) == pytest.approx(sign * 7.0, rel=1e-3)
        assert reader.turned(circle[20:]) == pytest.approx(sign * (7.0 - angle[20]), rel=0.05)


def test_the_time_within_a_step_at_which_something_changes():
    class Step:
        times, lengths = np.array([1.0, 3.0, 3.5]), np.array([2.0, 0.5])
        states = np.array([(4.0, 0.0), (0.0, 0.0), (2.0, 0.0)])

        def within(self, i, u):
            return (1.0 - u) * self.states[i] + u * self.states[i + 1]

    reader = phases._ReadMotion(BENT, PSIS[0], 0.05, Step(), None, 1e-8)
    assert reader.boundary(0, reader.near) == pytest.approx(1.0 + 2.0 * 0.75)  # r = 20 eps = 1
    assert reader.boundary(1, reader.near) == pytest.approx(3.25)
    assert reader.boundary(0, lambda state: state[0] > 0.8) == pytest.approx(1.0 + 2.0 * 0.8)


@pytest.mark.parametrize("onto", [None, "C", "C1", "C3"])
def test_the_number_in_a_label(onto):
    assert decide._index(onto) == (2 if onto == "C3" else 0)


def test_ways_out_and_names():
    limits = SimpleNamespace(lambda_rho=np.array([1.0, 1.0, -1.0, -1.0]), lambda_theta=np.array([-1.0, 1.0, -1.0, 1.0]))
    assert decide._ways_out(limits) == [0]
    assert decide.critical_name(BENT, PSIS[0], np.array([0.5]), np.array([0.4, 0.0])) in ("C1", "C2")
    sets = c2.critical_sets(BENT, PSIS[0], (0.5,))
    for i, C in enumerate(sets):
        assert decide.critical_name(BENT, PSIS[0], np.array([0.5]), C.e + 0.1) == f"C{i + 1}"


@pytest.mark.parametrize("A", [((1.0, 2.0), (3.0, -1.0)), ((0.0, -2.0), (1.0, 0.5)), ((0.3, 4.0), (-1.0, 0.0))])
def test_the_zero_of_a_linear_field_however_its_components_are_coupled(A):
    (a, b), (c, d) = A
    system = c2.System(U=(f"({a})*c + ({b})*s - z", f"({c})*c + ({d})*s - z/2"), W=("1",))
    expected = np.linalg.solve(A, (0.3, 0.15))
    for away in ((0.2, -0.1), (-0.3, 0.2)):
        assert solved(field(system), expected + np.array(away), np.array([0.3])) == pytest.approx(expected, abs=1e-14)


def test_from_the_middle_of_the_hemisphere():
    """x = y = 0 on a saddle: orbits around it go to both nodes; on an unstable focus: all to the cycle."""
    none = np.zeros(0)
    two = c2.System(U=("-c*(c - 1/2)*(c + 1/2)", "-s"))
    found = decide.from_middle(two, PSIS[0], none)
    assert (found.kind, "different places" in found.reason) == ("stop", True)
    nodes = [f"C{i + 1}" for i, C in enumerate(c2.critical_sets(two, PSIS[0])) if C.kind == "stable node"]
    plain = found.reason.translate(str.maketrans("₁₂₃", "123"))
    assert all(name in plain for name in nodes)
    cycle = c2.System(U=("c - s - 2*c*(c**2 + s**2)", "c + s - 2*s*(c**2 + s**2)"))
    assert decide.from_middle(cycle, PSIS[0], none).kind == "cycle"
    assert decide.from_middle(c2.ELinear(-1.0, 0.0, -2.0), PSIS[0], none).kind == "slide"
    aside = decide.from_middle(c2.ELinear(-1.0, 0.0, -2.0, (0.3, 0.2)), PSIS[0], none)
    assert (aside.kind, aside.onto) == ("slide", "C")
    assert aside.e == pytest.approx([0.3, 0.1])
    out = decide.from_middle(c2.ELinear(-1.0, 0.0, -2.0, (3.0, 0.0)), PSIS[0], none)
    assert (out.kind, out.theta) == ("leave", pytest.approx(0.0, abs=1e-9))


def test_a_start_on_sigma_without_psi():
    none = np.zeros(0)
    one = decide.starting(c2.ELinear(-1.0, 0.0, -2.0, (0.3, 0.2)), None, none)
    assert (one.kind, one.onto, "leads away" in one.reason) == ("slide", "C", False)
    two = decide.starting(c2.System(U=("-c*(c - 1/2)*(c + 1/2)", "-s")), None, none)
    assert (two.kind, "2 stable" in two.reason) == ("stop", True)
    out = decide.starting(c2.ELinear(-1.0, 0.0, -2.0, (3.0, 0.0)), None, none)
    assert (out.kind, out.theta, "Q₁" in out.reason) == ("leave", pytest.approx(0.0, abs=1e-9), True)
    many = decide.starting(c2.ELinear(1.0, 0.0, -1.0), None, none)
    assert (many.kind, "2 directions lead" in many.reason) == ("stop", True)
    beside = decide.starting(c2.System(U=("c**2 - 1/8", "-2*s")), None, none)  # a node, and the way out at theta = 0
    assert (beside.kind, "Q₁ leads away" in beside.reason) == ("slide", True)


def test_all_usual_psi_are_asked_only_where_none_is_given(monkeypatch):
    asked = []

    def outcome_towards(problem, theta, compare):
        asked.append((problem.psi, compare))
        return SimpleNamespace(depends_on_psi=compare is None, verdict="misses", reason="It turns.")

    monkeypatch.setattr(decide, "outcome_towards", outcome_towards)
    given, none = (decide.arriving(BENT, psi, np.array([0.3]), 0.2) for psi in (PSIS[3], None))
    assert asked == [(PSIS[3], ()), (c2.psi.constant(), None)]
    assert (given.kind, given.reason) == ("away", "It turns.")
    assert (none.kind, "depends on Ψ" in none.reason) == ("stop", True)


def test_a_stable_set_in_the_middle_has_its_name_and_around_another_orbits_start_evenly(monkeypatch):
    none = np.zeros(0)
    three = c2.System(U=("c*(c - 1/2)*(c + 1/2)", "-s"))
    found = decide.from_middle(three, PSIS[0], none)
    assert (found.kind, found.onto) == ("slide", "C2")
    assert decide.from_middle(c2.ELinear(-1.0, 0.0, -2.0), PSIS[0], none).onto == "C"
    asked = []
    answer = decide.Decision("stop", "They part.")
    monkeypatch.setattr(decide, "from_hemisphere", lambda *all: asked.append(all) or answer)
    found = decide.from_middle(c2.System(U=("-c*(c - 1/2)*(c + 1/2)", "-s")), PSIS[0], none)
    assert (found.kind, found.reason.endswith("They part."), "C₂" in found.reason) == ("stop", True, True)
    ring = asked[0][3]
    np.testing.assert_allclose(np.hypot(*ring.T), 1e-3)
    turns = np.diff(np.unwrap(np.arctan2(ring[:, 1], ring[:, 0])))
    np.testing.assert_allclose(turns, math.tau / len(ring))
    assert len(ring) >= 6


@pytest.mark.parametrize("theta", [0.0, 2.0, -1.2])
def test_a_start_where_the_critical_set_is_on_the_equator(theta):
    """U = e0 - e: on the equator at e0, in the direction theta, with or without psi."""
    e0 = (math.cos(theta), math.sin(theta))
    exact = c2.System(U=(f"({e0[0]!r}) - c", f"({e0[1]!r}) - s"))
    for psi in (None, PSIS[1]):
        found = decide.starting(exact, psi, np.zeros(0))
        assert (found.kind, found.onto) == ("border", "C")
        assert math.remainder(found.theta - theta, math.tau) == pytest.approx(0.0, abs=1e-12)
        assert found.e == pytest.approx(e0, abs=1e-12)


def test_phases_are_told_apart_by_what_they_say_alone():
    one, other = Phase("slide", 0.0, 1.0, "Why.", "C"), Phase("slide", 0.0, 1.0, "Why.", "C", places.Leaving(0.3))
    assert one == other
    assert repr(one) == repr(other) == "Phase(kind='slide', t_start=0.0, t_end=1.0, reason='Why.', onto='C')"
    with pytest.raises(ValueError, match="has no place"):
        one.e(0.5)
