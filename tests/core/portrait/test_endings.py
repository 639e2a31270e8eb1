"""The small questions about ends: nearest direction, half-saddles, signs at multiple zeros, tangents at C."""

import itertools
import math
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.layer_problem.eigendirections import to_disc
from codim2_core.orbits.result import Status
from codim2_core.portrait import endings
from codim2_core.portrait.saddle_manifold import starts
from codim2_core.portrait.verdicts import judge, with_flow


def equator(theta, multiplicity, sign=1.0, lambda_rho=None):
    """Limit directions of Theta = sign * product of sin((t - theta_i)/2)^m_i, which changes sign at the odd ones."""
    theta, multiplicity = np.array(theta, float), np.array(multiplicity)

    def Theta(t):
        return sign * np.prod(np.sin(0.5 * (t - theta)) ** multiplicity)

    step = 1e-6
    slopes = [
        (Theta(t + step) - Theta(t - step)) / (2.0 * step) if m == 1 else 0.0
        for t, m in zip(theta, multiplicity, strict=True)
    ]
    beyond = [int(np.sign(Theta(t + 1e-3))) if m % 2 else 0 for t, m in zip(theta, multiplicity, strict=True)]
    rho = np.ones(len(theta)) if lambda_rho is None else np.array(lambda_rho, float)

    class Equator(SimpleNamespace):
        def __len__(self):
            return len(self.theta)

    return Equator(
        theta=theta,
        multiplicity=multiplicity,
        lambda_theta=np.array(slopes),
        lambda_rho=rho,
        radially_degenerate=rho == 0.0,
        all_directions=False,
        arcs=np.zeros((0, 2)),
        beyond=() if 1 in multiplicity or not any(beyond) else tuple(beyond),
    ), beyond


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    "multiplicity", [m for m in itertools.product((1, 2, 3), repeat=4) if sum(m) % 2 == 0 and 1 in m]
)
def test_the_sign_beyond_a_multiple_zero(multiplicity, sign):
    found, beyond = equator([0.3, 1.4, 2.9, 4.4], multiplicity, sign)
    assert [endings.angular_sign(found, i) for i in range(4)] == beyond


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("multiplicity", [(3, 3), (3, 2, 5), (2, 3, 2, 3)])
def test_without_a_simple_zero_the_sign_beyond_is_given(multiplicity, sign):
    found, beyond = equator([0.3, 1.4, 2.9, 4.4][: len(multiplicity)], multiplicity, sign)
    assert [endings.angular_sign(found, i) for i in range(len(multiplicity))] == beyond
    found.beyond = ()
    assert [endings.angular_sign(found, i) for i in range(len(multiplicity))] == [0] * len(multiplicity)


@pytest.mark.parametrize("radial", [1.0, -1.0])
def test_half_saddles(radial):
    """Where orbits along the equator and across it go opposite ways; at an even zero on one side of it."""
    found, beyond = equator([0.3, 1.4, 2.9, 4.4], [1, 3, 2, 2], lambda_rho=[radial] * 4)
    expected = [radial * beyond[0] > 0.0, radial * beyond[1] > 0.0, True, True]
    assert [endings.half_saddle(found, i) for i in range(4)] == expected
    assert set(expected[:2]) == {True, False}
    neutral, _ = equator([0.3, 1.4], [1, 1], lambda_rho=[0.0, radial])
    assert not endings.half_saddle(neutral, 0)
    assert endings.radially_neutral(neutral, 0)
    assert not endings.radially_neutral(neutral, 1)
    small, _ = equator([0.3, 1.4], [1, 1], lambda_rho=[radial * 1e-16, radial])
    assert endings.radially_neutral(small, 0)
    slow, _ = equator([0.3, 1.4], [1, 1], lambda_rho=[radial * 1e-11, radial])  # slow, but its sign is known
    assert not endings.radially_neutral(slow, 0)


def test_the_nearest_direction_is_found_across_the_cut():
    found, _ = equator([0.2, 3.0, 6.2], [1, 1, 2])
    for angle, i, gap in (
        (0.25, 0, 0.05),
        (-0.1, 2, 0.1 - (2.0 * math.pi - 6.2)),
        (6.5, 0, 0.2 - (6.5 - 2.0 * math.pi)),
        (-3.1, 1, 2.0 * math.pi - 6.1),
        (9.3, 1, 9.3 - 3.0 - 2.0 * math.pi),
    ):
        assert endings.nearest(found, angle) == (i, pytest.approx(abs(gap)))


def test_why_an_orbit_stops_on_the_equator():
    found, beyond = equator([0.3, 1.4, 2.9], [1, 1, 2], lambda_rho=[1.0, 1.0, 1.0])
    words = {(i, w): endings._stopping(found, i, w) for i in range(3) for w in (0.0, 0.1)}
    saddle = beyond.index(1)
    assert words[saddle, 0.1] == endings.CONNECTION
    assert words[saddle, 0.0] != endings.CONNECTION
    assert words[1 - saddle, 0.1] != endings.CONNECTION
    assert "degenerate" in words[2, 0.0]


@pytest.mark.parametrize("x2", [(0.0, 0.0), (0.3, -1.2), (4.0, 0.1)])
def test_tangents_are_carried_to_the_disc(x2):
    """p = x2/sqrt(1 + |x2|^2): its difference quotient along the vector, made a unit."""
    x2, step = np.array(x2), 1e-6
    for angle in (0.0, 0.8, 2.0, 4.5):
        v = 3.0 * np.array([math.cos(angle), math.sin(angle)])
        p = [y / math.sqrt(1.0 + y @ y) for y in (x2 - step * v, x2 + step * v)]
        expected = (p[1] - p[0]) / np.linalg.norm(p[1] - p[0])
        for size in (1.0, 1e-198, 1e198):
            np.testing.assert_allclose(to_disc(x2, tuple(size * v)), expected, rtol=0.0, atol=1e-8)


@pytest.mark.parametrize("f", [(0.0, 0.0), (0.3, -0.6)])
def test_an_orbit_comes_to_a_node_along_the_direction_it_is_on(f):
    """Of the two eigendirections, each with two sides, the one along which the orbit lies."""
    (C,) = c2.critical_sets(c2.ELinear(-1.0, 0.0, -3.0, f), c2.psi.constant())
    first, second = (np.array(to_disc(C.x2, tuple(v))) for v in np.linalg.eig(C.jacobian)[1].real.T)  # of a node
    for side in (1.0, -1.0):
        for ahead, other in ((first, second), (second, first)):
            found = endings._tangent_at(C, C.p + 0.1 * side * ahead + 0.01 * other)
            np.testing.assert_allclose((math.cos(found), math.sin(found)), side * ahead, rtol=0.0, atol=1e-12)
    (star,) = c2.critical_sets(c2.ELinear(-1.0, 0.0, -1.0), c2.psi.constant())
    assert endings._tangent_at(star, np.array([0.1, -0.1])) == pytest.approx(-math.pi / 4)
    (focus,) = c2.critical_sets(c2.ELinear(-1.0, 2.0, -1.0), c2.psi.constant())
    assert endings._tangent_at(focus, np.array([0.1, 0.0])) is None


def test_manifolds_start_as_far_out_as_the_tolerance_allows():
    """Against time an orbit from the start comes back to C, the nearer the smaller the tolerance."""
    at, p = c2.ELinear(1.2, 0.4, -0.7, (0.3, 0.2)).at(), c2.psi.rational()
    (C,) = c2.critical_sets(at, p)
    for value in C.eigenvalues.real.tolist():
        far, near = [], []
        for tolerance in (1e-4, 1e-8, 1e-12):
            points, tangents = starts(at, p, C, value, tolerance)
            np.testing.assert_allclose(tangents[0], -tangents[1], rtol=0.0, atol=1e-15)
            np.testing.assert_allclose(np.linalg.norm(tangents, axis=1), 1.0, rtol=0.0, atol=1e-14)
            assert (np.einsum("ij,ij->i", points - C.p, tangents) > 0.0).all()
            far.append(np.hypot(*(points - C.p).T).max())
            orbits = c2.trajectories(
                at, p, points, t_max=50.0 / abs(value), rtol=1e-12, atol=1e-14, backward=value > 0.0
            )
            near.append(max(np.hypot(*(line - C.p).T).min() for line in orbits.points))
        assert far[0] > far[1] > far[2] > 1e-3
        assert near[0] > near[2]
        assert near[2] < 1e-4


@pytest.mark.parametrize("factor", [1e-4, 1e5])
def test_where_manifolds_start_does_not_know_the_unit_of_time(factor):
    plain, scaled = (c2.ELinear(1.2 * k, 0.4 * k, -0.7 * k, (0.3 * k, 0.2 * k)).at() for k in (1.0, factor))
    p = c2.psi.rational()
    (one,), (other,) = (c2.critical_sets(at, p) for at in (plain, scaled))
    for i in range(2):
        first, second = (
            starts(at, p, C, float(C.eigenvalues.real[i]), 1e-8) for at, C in ((plain, one), (scaled, other))
        )
        np.testing.assert_allclose(second[0], first[0], rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(second[1], first[1], rtol=0.0, atol=1e-12)


def judged(*found, affine=True, many="Orbits"):
    limits, _ = equator([0.3, 1.4, 2.9], [1, 1, 1], lambda_rho=[1.0, 0.0, -1.0])
    sets = tuple(SimpleNamespace(kind=kind, slow_flow=(k,)) for k, kind in enumerate(("saddle", "stable node")))
    cycles = [SimpleNamespace(slow_flow=(k,)) for k in (10, 11)]
    at = SimpleNamespace(normal_form="there" if affine else None)
    problem = SimpleNamespace(equator=limits, critical=sets, keep=lambda _: cycles, at=at)
    return with_flow(problem, judge(problem, [endings.Ending(*one) for one in found], many))


def test_ends_are_judged():
    one = judged(("C2", 0.1, "why"))
    assert (one.verdict, one.onto, one.slow_flow) == ("slide", "C2", (1,))
    assert one.reason == "They reach the critical set C₂, a stable node: sliding."
    assert judged(("C2", 0.1, "why"), ("C2", 0.7, "how")).verdict == "slide"
    one = judged(("cycle 2", None, "why"))
    assert (one.verdict, one.onto, one.slow_flow) == ("cycle", "cycle 2", (11,))
    assert "on average" in one.reason
    assert "mean slow flow" in judged(("cycle 1", None, "why"), affine=False).reason
    for label, angle in (("Q1", 0.3), ("Q3", 2.9)):
        one = judged((label, angle, "why"))
        assert (one.verdict, one.onto, one.leaving, one.slow_flow) == ("cross", label, angle, None)
        assert f"θ = {angle}" in one.reason
    one = judged(("Q2", 1.4, "why"))
    assert (one.verdict, one.why) == ("undecided", "neutral")
    assert "Q₂, which is radially neutral" in one.reason
    one = judged(("equator", None, "why"))
    assert (one.verdict, one.onto, one.leaving) == ("cross", "equator", None)
    one = judged(("C1", 0.1, endings.CONNECTION))
    assert (one.verdict, one.why, one.onto) == ("undecided", "several", None)
    assert "the saddle C₁" in one.reason
    one = judged(("C1", 0.1, "why"), ("Q3", 2.9, "why"), ("C1", 0.1, "why"), many="A family")
    assert (one.verdict, one.why) == ("undecided", "several")
    assert one.reason == "A family, and they end at different places: C₁, Q₃."
    one = judged(("undecided", None, Status.EQUILIBRIUM.value))
    assert (one.verdict, one.why) == ("undecided", "neutral")
    one = judged(("undecided", None, "why"))
    assert (one.verdict, one.why) == ("undecided", "unfollowed")


def ended(monkeypatch, end, status=Status.T_MAX, then=None):
    """Ending of one orbit that is at `end` when its time is up, and then for good, or at the next of `then`."""
    at, psi = c2.ELinear(1.0, 3.0, -2.0, (3.0, 0.5)).at(), c2.psi.constant()
    limits, later = c2.equator_equilibria(at), iter(then or ())

    def followed(*_):
        now, place = next(later, (status, end))
        return SimpleNamespace(status=[now], ends=np.array([place]))

    monkeypatch.setattr(endings, "_followed", followed)
    lines = type("Lines", (SimpleNamespace,), {"__len__": lambda _: 1})(status=[status], ends=[end])
    (one,) = endings.endings(at, psi, lines, limits, c2.critical_sets(at, psi), lambda: ())
    return one, limits


def place(angle, w):
    r = math.sqrt(1.0 - w * w)
    return [r * math.cos(angle), r * math.sin(angle), w]


@pytest.mark.parametrize("height", [0.0, 5e-5, 2e-4, 0.5])
@pytest.mark.parametrize("aside", [0.0, 5e-5, 2e-4])
def test_an_orbit_cut_off_is_at_a_limit_direction_if_it_is_near_in_angle_and_in_height(monkeypatch, height, aside):
    _, limits = ended(monkeypatch, place(0.0, 0.5))
    assert len(limits) == 2
    assert not any(endings.radially_neutral_ones(limits))
    for i, theta in enumerate(limits.theta.tolist()):
        one, _ = ended(monkeypatch, place(theta + aside, height))
        near = max(height, aside) < endings.AT_SADDLE
        assert (one.label, one.angle) == ((f"Q{i + 1}", theta) if near else ("undecided", None))


def test_an_orbit_that_is_near_a_limit_direction_is_followed_before_it_is_said_to_end_there(monkeypatch):
    _, limits = ended(monkeypatch, place(0.0, 0.5))
    first, second = limits.theta.tolist()
    for then, label in (((Status.ARRIVED, place(second, 0.0)), "Q2"), ((Status.SPIRALLED, place(1.0, 0.0)), "equator")):
        one, _ = ended(monkeypatch, place(first, 5e-5), then=[then])
        assert one.label == label


NEUTRAL = equator([0.3, 1.4, 2.9, 4.4], [1, 1, 1, 1], lambda_rho=[1.0, 0.0, -1.0, 2.0])[0]
SADDLE = SimpleNamespace(p=np.array([0.3, 0.4]), kind="saddle")
NODE = SimpleNamespace(p=np.array([-0.2, 0.1]), kind="stable node")


def _ends(monkeypatch, place, height, status, then=None, critical=(SADDLE, NODE), cycles=()):
    """What is said of one trajectory; followed on, it is at `then`, a status and a place."""
    at = SimpleNamespace(speed=1.0)
    later = (Status.T_MAX, place) if then is None else then
    on = SimpleNamespace(status=[later[0]], ends=np.array([[*later[1], height]]))
    monkeypatch.setattr(endings, "_followed", lambda *given: on)
    monkeypatch.setattr(endings, "_tangent_at", lambda C, p: 0.7)

    class Lines(SimpleNamespace):
        def __len__(self):
            return 1

    lines = Lines(status=(status,), ends=np.array([[*place, height]]))
    (found,) = endings.endings(at, None, lines, NEUTRAL, critical, lambda: cycles)
    return found.label, found.sentence


def _beside(p, distance):
    return (p[0] + distance, p[1])


def test_an_equilibrium_is_the_set_that_is_near(monkeypatch):
    near, far = _beside(NODE.p, 9e-3), _beside(NODE.p, 1.1e-2)
    assert _ends(monkeypatch, near, 0.9, Status.EQUILIBRIUM) == ("C2", Status.EQUILIBRIUM.value)
    assert _ends(monkeypatch, far, 0.9, Status.EQUILIBRIUM)[0] == "undecided"
    assert _ends(monkeypatch, near, 0.9, Status.EQUILIBRIUM, critical=(NODE,))[0] == "C"


def test_only_what_has_stopped_at_a_saddle_is_said_to(monkeypatch):
    assert _ends(monkeypatch, _beside(SADDLE.p, 9e-5), 0.8, Status.T_MAX) == ("C1", endings.CONNECTION)
    assert _ends(monkeypatch, _beside(SADDLE.p, 9e-3), 0.8, Status.T_MAX)[0] == "undecided"
    assert _ends(monkeypatch, _beside(NODE.p, 9e-5), 0.8, Status.T_MAX)[0] == "undecided"
    # it passed by: followed on, it comes to the node
    passed = _ends(monkeypatch, _beside(SADDLE.p, 9e-5), 0.8, Status.T_MAX, (Status.EQUILIBRIUM, NODE.p))
    assert passed == ("C2", Status.EQUILIBRIUM.value)


@pytest.mark.parametrize(("turn", "height", "at_it"), [(5e-3, 5e-3, True), (5e-3, 0.5, False), (0.05, 5e-3, False)])
def test_at_a_neutral_direction_is_what_is_low_and_that_way(monkeypatch, turn, height, at_it):
    r = math.sqrt(1.0 - height**2)
    for i in range(4):
        angle = float(NEUTRAL.theta[i]) + turn
        label, said = _ends(monkeypatch, (r * math.cos(angle), r * math.sin(angle)), height, Status.T_MAX)
        assert (said == endings.AT_NEUTRAL_Q) == (at_it and i == 1)
        assert label == ("Q2" if at_it and i == 1 else "undecided")


@pytest.mark.parametrize("kind", ["stable", "unstable", "semistable"])
@pytest.mark.parametrize("backward", [False, True])
def test_cycles_that_are_come_to_that_way_in_time(kind, backward):
    """A semistable one attracts on one side, and repels on the other."""
    t = np.linspace(0.0, 2.0 * math.pi, 400)
    circles = [SimpleNamespace(kind=kind, points=r * np.column_stack([np.cos(t), np.sin(t)])) for r in (0.3, 0.6)]
    comes = kind == "semistable" or (kind == "unstable") == backward
    for r, expected in ((0.3, 0), (0.6, 1), (0.6005, None), (0.45, None)):
        p = r * np.array([math.cos(1.0), math.sin(1.0)])
        assert endings._on_cycle(circles, p, backward) == (expected if comes else None)
