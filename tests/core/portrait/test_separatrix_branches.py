"""Branches: outside, held against a curve that is known; how they are drawn to their ends, step by step."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.orbits.result import Status
from codim2_core.portrait import separatrices, separatrix_branches
from codim2_core.portrait.endings import CONNECTION, SLOW, SPEEDS, Ending
from codim2_core.portrait.separatrix import Separatrices, Separatrix
from codim2_core.words import say

from .test_endings import equator

PSI = c2.psi.constant()


# ---- outside, where U depends on x or y -----------------------------------------------------------------------------


def parabola(bend, tangential, speed, turn):
    """U = speed (c, 2 bend x c + tangential (s - bend x c)), turned: tangent to y = bend x^2, where s = bend x c."""
    k, m = math.cos(turn), math.sin(turn)
    c, s, x = f"(({k!r})*c + ({m!r})*s)", f"(({k!r})*s - ({m!r})*c)", f"(({k!r})*x + ({m!r})*y)"
    u, v = f"({speed!r})*{c}", f"({speed!r})*(2*({bend!r})*{x}*{c} + ({tangential!r})*({s} - ({bend!r})*{x}*{c}))"
    return c2.System(U=(f"({k!r})*({u}) - ({m!r})*({v})", f"({m!r})*({u}) + ({k!r})*({v})"))


@pytest.mark.parametrize("turn", [0.0, 0.7, 2.4])
@pytest.mark.parametrize(("bend", "tangential", "speed"), [(0.4, -1.5, 1.0), (-0.3, 0.5, -0.05), (0.5, 0.2, 30.0)])
def test_a_bent_branch_outside_is_the_invariant_curve(bend, tangential, speed, turn):
    system = parabola(bend, tangential, speed, turn)
    found = c2.separatrices(system, PSI, t_max=1.0 / abs(speed))  # drawn for longer, as it starts slowly
    outside = {one.departure_angle: one for one in found if not one.inside}
    axis = [t for t in outside if abs(math.sin(t - turn)) < 1e-9]
    assert len(axis) == 2  # the curve leaves Sigma along both senses of its tangent
    for angle in axis:
        one = outside[angle]
        assert one.direction == ("unstable" if speed > 0.0 else "stable")
        line = one.points if speed > 0.0 else one.points[::-1]
        np.testing.assert_allclose(line[0], (math.cos(angle), math.sin(angle)), rtol=0.0, atol=1e-15)
        radius = np.hypot(*line.T)
        rho, theta = radius - 1.0, np.arctan2(*line.T[::-1]) - turn
        x, y = rho * np.cos(theta), rho * np.sin(theta)
        np.testing.assert_allclose(y, bend * x * x, rtol=0.0, atol=2e-8)
        assert np.abs(line).max() == pytest.approx(2.0, abs=1e-9)
        assert (np.diff(radius) > 0.0).all()
        assert rho[1] < 2e-4
        assert (one.end, one.connection, one.gap) == ("outside", False, None)
        assert one.arrival_angle == pytest.approx(math.atan2(*line[-1][::-1]), abs=1e-12)
        limits = c2.equator_equilibria(system)
        i = int(np.argmin(np.abs(limits.theta - angle)))
        assert one.origin == f"Q{i + 1}"
        assert one.status == say("branch leaves" if speed > 0.0 else "branch arrives", Q=f"Q{i + 1}")


def test_a_bent_branch_that_stays_in_view_says_why():
    """Slow beyond all time: U leads away from Sigma ever slower, and the branch ends where its time does."""
    system = c2.System(U=("c*exp(-40*(x**2 + y**2))", "s*exp(-40*(x**2 + y**2))/2 + 0*x"))
    outside = [one for one in c2.separatrices(system, PSI, t_max=1.0) if not one.inside]
    assert outside
    for one in outside:
        assert one.status.endswith(Status.T_MAX.value)
        assert np.abs(one.points).max() < 2.0


@pytest.mark.parametrize("view", [2.0, 3.5])
@pytest.mark.parametrize("angle", [0.2, 1.4, 2.5, 4.4, 5.9])
@pytest.mark.parametrize("rho", [1.0, -1.0])
def test_a_ray_goes_from_the_equator_to_the_edge(angle, rho, view):
    limits, _ = equator([0.1, angle], [1, 1], lambda_rho=[1.0, rho])
    one = separatrix_branches.ray(limits, 1, view)
    near, far = one.points if rho > 0.0 else one.points[::-1]
    u = np.array([math.cos(angle), math.sin(angle)])
    np.testing.assert_allclose(near, u, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(far / np.hypot(*far), u, rtol=0.0, atol=1e-15)
    assert np.abs(far).max() == pytest.approx(view, rel=1e-14)
    assert (one.origin, one.end, one.inside) == ("Q2", "outside", False)
    assert one.direction == ("unstable" if rho > 0.0 else "stable")
    assert one.status == say("ray leaves" if rho > 0.0 else "ray arrives", Q="Q2")
    assert one.departure_angle == one.arrival_angle == angle


def test_outside_the_half_saddles_are_the_others():
    """There lambda_rho, and not -lambda_rho, is the radial eigenvalue; both sides share the multiple zeros."""
    limits, beyond = equator([0.3, 1.4, 2.9, 4.4], [1, 1, 2, 2], lambda_rho=[1.0, 1.0, 1.0, 0.0])
    assert [separatrix_branches.outside_half_saddle(limits, i) for i in range(4)] == [
        beyond[0] < 0,
        beyond[1] < 0,
        True,
        False,
    ]
    assert set(beyond[:2]) == {1, -1}


# ---- on the hemisphere, to their ends -------------------------------------------------------------------------------


@pytest.mark.parametrize("backward", [False, True])
def test_each_branch_starts_at_its_saddle_and_is_followed_as_long_as_it_needs(monkeypatch, backward):
    """Up from a Q it takes several times 1/|lambda_rho|, beside the time that any branch takes."""
    begun, stiff = [], []
    sign = 1.0 if backward else -1.0
    limits, beyond = equator([0.3, 1.4, 2.9, 4.4, 5.5], [1, 1, 1, 1, 2])
    half = [i for i in range(4) if beyond[i] * sign > 0] + [4]
    limits.lambda_rho[:] = sign * np.array([1.0, 2.0, 0.01, 0.02, 3.0])  # of the sign that goes up the hemisphere

    def note(places, options):
        begun.append((np.asarray(places).tolist(), options["t_max"]))
        stiff.append((options["stiff"], options["backward"], options["atol"] < options["rtol"]))
        return SimpleNamespace(points=[np.array([(0.0, 0.0), (0.1, 0.1)])] * len(places))

    monkeypatch.setattr(separatrix_branches, "continuation", lambda _at, _psi, theta, **options: note(theta, options))
    monkeypatch.setattr(separatrix_branches, "trajectories", lambda _at, _psi, p, **options: note(p, options))
    seen = []
    monkeypatch.setattr(
        separatrix_branches, "starts", lambda *given: seen.append(given[3:]) or (np.ones((2, 2)), np.array(TANGENTS))
    )

    def joined(parts):
        return SimpleNamespace(points=[line for part in parts for line in part.points])

    def ended(_at, _psi, lines, *_, **options):
        assert options["backward"] is backward
        return [Ending("C1", 0.5, "why")] * (len(lines.points) - 1) + [Ending("Q2", 1.4, CONNECTION)]

    monkeypatch.setattr(separatrix_branches, "joined", joined)
    monkeypatch.setattr(separatrix_branches, "endings", ended)
    places = []
    monkeypatch.setattr(
        separatrix_branches, "_tails", lambda *given: places.extend(given[3]) or [[np.array([p])] for p in given[3]]
    )
    sets = tuple(
        SimpleNamespace(kind=kind, p=np.array(p), eigenvalues=np.array([1.5, -0.7]))
        for kind, p in (("stable node", (0.2, 0.0)), ("saddle", (-0.2, 0.1)))
    )
    problem = SimpleNamespace(at=SimpleNamespace(speed=2.0), psi=PSI, equator=limits, critical=sets)
    found = separatrix_branches.branches_inside(problem, 900.0, 1e-9, 0.005, backward)
    assert stiff == [(True, backward, True)] * (len(half) + 1)
    for (theta, time), i in zip(begun, half, strict=False):
        assert theta == [limits.theta[i]]
        rate = abs(limits.lambda_rho[i])
        assert time == pytest.approx(min(900.0, SPEEDS / 2.0 + SLOW / rate))
    assert begun[-1] == ([[1.0, 1.0]] * 2, 900.0)
    assert seen == [(-0.7 if backward else 1.5, pytest.approx(1e-10))]
    assert [one.origin for one in found] == [f"Q{i + 1}" for i in half] + ["C2", "C2"]
    directions = [*limits.theta[half], *(math.atan2(t[1], t[0]) for t in TANGENTS)]
    assert [one.departure_angle for one in found] == pytest.approx(directions)
    for k, one in enumerate(found):
        line = one.points[::-1] if backward else one.points
        begin = np.array([math.cos(directions[k]), math.sin(directions[k])]) if k < len(half) else sets[1].p
        end = sets[0].p if k + 1 < len(found) else np.array([math.cos(1.4), math.sin(1.4)])
        np.testing.assert_allclose(line, [begin, (0.0, 0.0), (0.1, 0.1), end], rtol=0.0, atol=1e-15)
        assert (one.direction, one.inside, one.gap) == ("stable" if backward else "unstable", True, None)
        assert one.connection == (k + 1 == len(found))
        assert (one.end, one.arrival_angle) == (("Q2", 1.4) if one.connection else ("C1", 0.5))
    none = SimpleNamespace(at=problem.at, psi=PSI, equator=equator([], [])[0], critical=sets[:1])
    assert separatrix_branches.branches_inside(none, 900.0, 1e-9, 0.005, backward) == []


TANGENTS = [(0.6, -0.8), (-0.6, 0.8)]
PIXEL = 0.005
END = np.array([0.5, 0.5])


def tailed(monkeypatch, last, rounds=(), end=END, ebar=0.5, backward=False, speed=2.0):
    """Tail of one line left at `last`, as its continuations (points, status) are given; and the times asked for."""
    asked, given = [], iter(rounds)

    def trajectories(_at, _psi, starts, **options):
        asked.append((starts.tolist(), options["t_max"]))
        assert options["backward"] is backward
        assert options["atol"] < options["rtol"] == 1e-9
        points, status = next(given)
        return SimpleNamespace(points=[np.array([starts[0], *points])], status=[status])

    monkeypatch.setattr(separatrix_branches, "trajectories", trajectories)
    lines = SimpleNamespace(points=[np.array([(0.0, 0.0), last])], ends=np.array([(*last, ebar)]))
    at = SimpleNamespace(speed=speed, U=lambda e: np.array([-e[1], e[0]]))
    (tail,) = separatrix_branches._tails(at, PSI, lines, [end], 1e-9, PIXEL, backward)
    return np.concatenate([np.zeros((0, 2)), *tail]).tolist(), asked


def test_a_line_that_has_arrived_is_drawn_to_its_end(monkeypatch):
    assert tailed(monkeypatch, (0.499, 0.5)) == ([[0.5, 0.5]], [])
    assert tailed(monkeypatch, (0.3, 0.1), end=None) == ([], [])


def test_a_line_that_was_cut_off_is_followed_to_where_it_comes_nearest(monkeypatch):
    beside = [(0.4, 0.5), (0.49, 0.5), (0.6, 0.5)]  # passes by
    tail, asked = tailed(monkeypatch, (0.3, 0.5), [(beside, Status.LEFT_VIEW)])
    assert tail == [[0.4, 0.5], [0.49, 0.5], [0.5, 0.5]]
    assert asked == [([[0.3, 0.5]], 50.0)]  # 100 in the unit of the speed
    tail, asked = tailed(monkeypatch, (0.3, 0.5), [(beside, Status.T_MAX)])
    assert (len(tail), len(asked)) == (3, 1)  # gone again: not followed on, though there was time
    far = [(0.4, 0.5), (0.45, 0.5)]
    tail, asked = tailed(monkeypatch, (0.3, 0.5), [(far, Status.EQUILIBRIUM)])
    assert tail == [[0.4, 0.5], [0.45, 0.5]]  # too far to be drawn straight
    assert len(asked) == 1
    near = [(0.4, 0.5), (0.498, 0.5)]
    tail, asked = tailed(monkeypatch, (0.3, 0.5), [(near, Status.T_MAX)])
    assert (tail[-1], len(asked)) == ([0.5, 0.5], 1)  # within a pixel


@pytest.mark.parametrize("status", [Status.T_MAX, Status.STEP_LIMIT])
def test_a_slow_line_is_followed_ever_longer(monkeypatch, status):
    steps = [[(0.31 + 0.02 * k, 0.5), (0.32 + 0.02 * k, 0.5)] for k in range(9)]
    tail, asked = tailed(monkeypatch, (0.3, 0.5), [(points, status) for points in steps], backward=True)
    assert 3 <= len(asked) < 9
    assert [begin for begin, _ in asked] == [[[0.3, 0.5]], *([list(points[-1])] for points in steps[: len(asked) - 1])]
    times = [time for _, time in asked]
    np.testing.assert_allclose(np.array(times[1:]) / times[:-1], 16.0)
    assert tail == [list(point) for points in steps[: len(asked)] for point in points]
    tail, asked = tailed(monkeypatch, (0.3, 0.5), [(steps[0], status), ([(0.45, 0.5)], Status.EQUILIBRIUM)])
    assert len(asked) == 2


def test_below_what_a_point_of_the_disc_can_tell_nothing_is_followed(monkeypatch):
    assert tailed(monkeypatch, (0.3, 0.5), ebar=1e-8) == ([], [])
    begin = [math.cos(0.3), math.sin(0.3)]
    assert tailed(monkeypatch, begin, end=END) == ([], [])


@pytest.mark.parametrize("backward", [False, True])
def test_on_the_equator_a_branch_goes_along_it(monkeypatch, backward):
    begin, end = (np.array([math.cos(t), math.sin(t)]) for t in (0.3, 1.0))
    tail, asked = tailed(monkeypatch, (1.0 - 1e-15) * begin, end=end, backward=backward)
    assert asked == []
    assert tail[-1] == end.tolist()
    angles = np.unwrap([0.3, *np.arctan2(*np.transpose(tail)[::-1])])
    assert angles[-1] - angles[0] == pytest.approx(0.7 - (2.0 * math.pi if backward else 0.0))
    inside = tailed(monkeypatch, (1.0 - 1e-6) * begin, [([0.99 * begin], Status.EQUILIBRIUM)], end=end)
    assert inside[0] == [(0.99 * begin).tolist()]  # not at the equator: it stays where it came nearest
    deep = tailed(monkeypatch, (1.0 - 1e-15) * begin, end=0.9 * end)
    assert deep == ([], [])


# ---- what is said of them -------------------------------------------------------------------------------------------


def branch(direction="unstable", end="C", connection=False, status="As it is."):
    return Separatrix("Q1", direction, end, np.zeros((2, 2)), 0.0, 0.0, True, connection, None, status)


def test_notes_name_connections_once_and_what_is_undecided():
    limits, _ = equator([0.3, 1.4], [1, 1], lambda_rho=[1.0, 0.0])
    fine = [branch(), branch("stable"), branch(end="Q2")]
    neutral = say("branches not followed", Q="Q2")
    assert separatrices._notes(limits, fine) == (neutral,)
    pair = [branch(connection=True, status="Joined."), branch("stable", connection=True, status="Joined as well.")]
    assert separatrices._notes(limits, [*fine, *pair, pair[0]]) == ("Joined.", neutral)
    lost = branch(end="undecided", status="Lost.")
    assert separatrices._notes(limits, [lost, *fine]) == (neutral, say("branch undecided", origin="Q1", status="Lost."))
    limits.all_directions = True
    assert separatrices._notes(limits, []) == (neutral, say("no separatrices"))


def test_lines_are_refined_where_they_are_too_coarse_to_tell_a_connection(monkeypatch):
    drawn = []

    def inside(_problem, longest, _rtol, pixel, back):
        assert longest == (700.0 if given is None else given)
        drawn.append((pixel, back))
        return [branch("stable" if back else "unstable")]

    monkeypatch.setattr(separatrices, "branches_inside", inside)
    monkeypatch.setattr(separatrices, "drawn_time", lambda *_: 700.0)
    monkeypatch.setattr(
        separatrices, "connected", lambda branches, gaps, within: kept.append((len(branches), gaps, within)) or branches
    )
    limits, _ = equator([], [])
    problem = SimpleNamespace(equator=limits, at=SimpleNamespace(reads_position=False, speed=1.0))
    finer = {(0, 1): 1e-9}
    for gaps, again in (({}, False), ({(0, 1): 0.011}, False), ({(0, 1): 0.009}, True), ({(0, 1): 1, (1, 2): 0}, True)):
        seen, kept = [gaps, finer], []
        monkeypatch.setattr(separatrices, "gaps_between", lambda _, seen=seen: seen.pop(0))
        drawn.clear()
        given = None if again else 20.0
        found = separatrices.separatrices_of(problem, pixel=0.005, tolerance=1e-6, t_max=given)
        assert len(found) == 2
        assert not any(one.points.flags.writeable for one in found)
        assert drawn == [(0.005, False), (0.005, True), *([(1e-6, False), (1e-6, True)] if again else [])]
        assert kept == [(2, finer if again else gaps, 1e-6)]


def test_the_table_stands_without_a_picture(monkeypatch):
    found = Separatrices((branch(), branch("stable", "undecided")), ("A note.",))
    assert found.graph == (("Q1", "C"), ("undecided", "Q1"))  # in the direction of time
    for picture in (None, "<svg/>"):
        monkeypatch.setattr("codim2_core.drawing.svg", lambda _, picture=picture: picture)
        text = found._repr_html_()
        assert text.startswith(picture or "<table")
        assert "A note." in text
        assert text.count("hemisphere") == 2
        assert "None" not in text
