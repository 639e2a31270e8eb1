"""What is said of the paper's claims is so on the system at hand: counts by nets, kinds by orbits, means by sums."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings

import codim2_core as c2
from codim2_core import ELinear, System, examples, psi
from codim2_core.theorems.certificates import certificates
from codim2_core.words import ROOMS, recognise
from tests.core.strategies import regularisations, systems

ONE, HILL = psi.constant(), psi.hill(3)
NET = (np.arange(4000) + 0.37) * (math.tau / 4000)
CIRCLE = np.stack([np.cos(NET), np.sin(NET)], axis=-1)


def number(text):
    mantissa, _, power = text.replace("−", "-").partition(" · 10")
    return float(mantissa) * 10.0 ** int(power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")) or 0)


class Case:
    """A system at one z, with what its claims may be held against."""

    def __init__(self, system, family, z=(), cycles=None):
        self.system, self.psi, self.cycles = system, family, cycles
        self.z = z or (0.0,) * system.m
        self.at = system.at(self.z)
        U = self.at.U(CIRCLE)
        self.theta = CIRCLE[:, 0] * U[:, 1] - CIRCLE[:, 1] * U[:, 0]
        self.rho = (CIRCLE * U).sum(axis=1)
        angle = np.unwrap(np.arctan2(U[:, 1], U[:, 0]))
        self.turns = round(float(angle[-1] - angle[0]) / math.tau)
        self.size = max(self.at.size, 1e-9)
        self.name = c2.classify(self.at, family)
        self.degenerate = bool(self.name.degeneracies)

    @property
    def directions(self):
        return int((np.sign(self.theta) != np.sign(np.roll(self.theta, 1))).sum())

    @property
    def sets(self):
        """Zeros of U in the open disc, by Newton's method from a net."""
        e = np.concatenate([r * CIRCLE[::160] for r in (0.05, 0.3, 0.55, 0.8, 0.97)])
        for _ in range(60):
            h = 1e-6
            base = self.at.U(e)
            J = np.stack([(self.at.U(e + h * np.eye(2)[k]) - base) / h for k in (0, 1)], axis=-1)
            J = J + 1e-12 * self.size * np.eye(2)
            e = e - np.clip(np.linalg.solve(J, base[:, :, None])[:, :, 0], -0.3, 0.3)
        good = (np.abs(self.at.U(e)).max(axis=1) < 1e-9 * self.size) & (np.hypot(*e.T) < 1.0 - 1e-9)
        return np.unique(np.round(e[good], 5) + 0.0, axis=0)

    @property
    def matrix(self):
        f = self.at.U(np.zeros(2))
        return np.stack([self.at.U(np.eye(2)[k]) - f for k in (0, 1)], axis=-1), f

    @property
    def form(self):
        return self.at.normal_form

    @property
    def length(self):
        A, f = self.matrix
        return float(np.hypot(*np.linalg.solve(A, f)))

    def linear(self):
        """Whether U is affine in e, by values."""
        A, f = self.matrix
        return float(np.abs(self.at.U(0.7 * CIRCLE) - (0.7 * CIRCLE @ A.T + f)).max()) < 1e-9 * self.size


def e_psi(family, xy, eps=1.0):
    s = (xy**2).sum(axis=-1) / eps**2
    return xy / np.sqrt((xy**2).sum(axis=-1) + eps**2 * np.asarray(family(s)))[..., None]


PLACES = 10.0 ** np.linspace(-2, 2, 9)[:, None, None] * CIRCLE[None, ::400]


def ok(test):
    """A check from something that is true or false."""
    return lambda case, fields: test(case, fields) or pytest.fail(f"it is not so: {fields}")


def equivariant(case, _):
    R = np.array([[math.cos(0.7), -math.sin(0.7)], [math.sin(0.7), math.cos(0.7)]])
    np.testing.assert_allclose(e_psi(case.psi, PLACES @ R.T), e_psi(case.psi, PLACES) @ R.T, atol=1e-12)


def homogeneous(case, _):
    np.testing.assert_allclose(e_psi(case.psi, 3.0 * PLACES, 3.0), e_psi(case.psi, PLACES), atol=1e-12)


def increases(case, _):
    moduli = np.hypot(*np.moveaxis(e_psi(case.psi, PLACES), -1, 0))
    assert (np.diff(moduli, axis=0) > -1e-15).all()
    assert (moduli < 1.0 + 1e-15).all()


def positive_definite(case, _):
    h = 1e-6
    flat = PLACES.reshape(-1, 2)
    flat = flat[np.hypot(*e_psi(case.psi, flat).T) < 0.99]
    columns = [e_psi(case.psi, flat + h * v) - e_psi(case.psi, flat - h * v) for v in np.eye(2)]
    D = np.stack(columns, axis=-1)
    assert (np.trace(D, axis1=1, axis2=2) > 0.0).all()
    assert (np.linalg.det(D) > 0.0).all()


def all_reach(case, _):
    """Orbits of the layer problem from all over it come to C, of an unstable one backwards in time."""
    (e,) = case.sets
    assert case.directions in (0, 2, 4) or case.degenerate
    (C,) = c2.critical_sets(case.at, case.psi)
    np.testing.assert_allclose(C.e, e, atol=1e-4)
    if np.hypot(*C.p) > 0.98 or np.abs(C.eigenvalues.real).min() < 1e-2 * np.abs(C.eigenvalues).max():
        return
    seeds = np.concatenate([r * CIRCLE[::800] for r in (0.2, 0.6, 0.9)])
    rate = float(np.abs(C.eigenvalues.real).min()) * math.sqrt(1.0 - float(C.p @ C.p))
    lines = c2.trajectories(case.at, case.psi, seeds, t_max=200.0 / rate, backward=case.form.a > 0.0).points
    assert max(math.dist(line[-1], C.p) for line in lines) < 0.05


def four_saddles(case, _):
    assert case.directions == 4
    assert len(case.sets) == 1
    A, _f = case.matrix
    assert np.linalg.det(A) < 0.0
    found = c2.equator_equilibria(case.at)
    assert (found.lambda_rho * found.lambda_theta < 0.0).all()


def no_set(case, _):
    assert len(case.sets) == 0
    assert case.directions in (2, 4) or case.degenerate


def slow_of_C(case, _):
    A, f = case.matrix
    e = -np.linalg.solve(A, f)
    (C,) = c2.critical_sets(case.at, case.psi)
    np.testing.assert_allclose(C.slow_flow, case.at.W(e), atol=1e-9 * case.size)


def combinations(case, _):
    """Weights of limit vectors whose (x, y) parts cancel give one and the same z part."""
    rng = np.random.default_rng(5)
    U, W = case.at.U(CIRCLE), case.at.W(CIRCLE)
    (C,) = c2.critical_sets(case.at, case.psi)
    for _ in range(40):
        k = rng.choice(len(CIRCLE), 3, replace=False)
        M = np.vstack([U[k].T, np.ones(3)])
        if abs(np.linalg.det(M)) > 1e-6 * case.size**2:
            weights = np.linalg.solve(M, [0.0, 0.0, 1.0])
            np.testing.assert_allclose(
                weights @ W[k], C.slow_flow, atol=1e-7 * case.size * max(1.0, abs(weights).max())
            )


def mean_over(case, _):
    A, f = case.matrix
    for cycle in case.cycles:
        np.testing.assert_allclose(cycle.mean_e, -np.linalg.solve(A, f), atol=1e-6)


def stands_still(case, _):
    for C in c2.critical_sets(case.at, case.psi):
        (line,) = c2.trajectories(case.at, case.psi, [C.p], t_max=1e-3 / case.size).points
        assert math.dist(line[0], line[-1]) < 1e-6


def slow_for_every_psi(case, _):
    flows = [[C.slow_flow for C in c2.critical_sets(case.at, one)] for one in (ONE, HILL, psi.tanh())]
    for other in flows[1:]:
        np.testing.assert_allclose(other, flows[0], atol=1e-9 * max(1.0, case.size))


def manifold(case, _):
    """Late in a motion that slides x and y are ε times what C is, up to a part that is small with ε."""
    for C in c2.critical_sets(case.at, case.psi):
        if C.kind.startswith("stable") and np.abs(C.eigenvalues.real).min() > 0.05 * np.abs(C.eigenvalues).max():
            away = []
            for eps in (1e-4, 1e-5):
                end = 30.0 * eps / np.abs(C.eigenvalues.real).min()
                run = c2.simulate(case.system, case.psi, eps, (*(eps * C.x2), *case.z), (0.0, end))
                there = c2.critical_sets(case.system, case.psi, tuple(run.states[-1, 2:]))
                away.append(min(math.dist(run.states[-1, :2] / eps, D.x2) for D in there))
            assert away[1] < 0.3 * away[0] + 1e-7


def rotated(case, fields):
    q, A = case.form, case.matrix[0]
    phi = number(fields.get("phi", "0"))
    R = np.array([[math.cos(phi), -math.sin(phi)], [math.sin(phi), math.cos(phi)]])
    np.testing.assert_allclose(R @ A @ R.T, q.A, atol=1e-4 * case.size)
    assert q.A[0, 1] == -q.A[1, 0]


def form_of(case, _):
    """The normal form has the trace, the determinant and the length of A, as a rotation leaves them."""
    q, A = case.form.A, case.matrix[0]
    assert q[0, 1] == -q[1, 0]
    np.testing.assert_allclose(
        [np.trace(q), np.linalg.det(q), (q**2).sum()],
        [np.trace(A), np.linalg.det(A), (A**2).sum()],
        atol=1e-9 * max(1.0, case.size**2),
    )


def equal_diagonal(case, fields):
    q = case.form
    assert (case.directions == 2) == (abs(q.b) < math.hypot(q.f1, q.f2)) or case.degenerate


def on_axes(case, _):
    q = case.form
    axis = 0.0 if q.f2 == 0.0 else 0.5 * math.pi
    for t in (axis, axis + math.pi):
        e = np.array([math.cos(t), math.sin(t)]) if case.at.as_given is not None else None
        if e is not None:
            u = case.at.U(e)
            assert abs(e[0] * u[1] - e[1] * u[0]) < 1e-12 * case.size
    force = abs(q.f1 + q.f2)
    assert case.directions == (4 if force < abs(q.d - q.a) else 2) or case.degenerate


def ball(case, _):
    A, f = case.matrix
    sticks = np.hypot(*f) < abs(A[0, 0])
    assert bool(c2.critical_sets(case.at, case.psi)) == sticks
    run = c2.simulate(case.system, case.psi, 1e-4, (1e-3, 1e-3, *case.z), (0.0, 0.2))
    assert (np.hypot(*run.states[-1, :2]) < 1e-2) == sticks
    if sticks:
        (C,) = c2.critical_sets(case.at, case.psi)
        np.testing.assert_allclose(C.slow_flow, 5.0 / 7.0 * f, atol=1e-9)


def attracting_repelling(case, _):
    assert case.directions == 6
    angles = np.arange(6) * math.pi / 3.0
    rates = [np.interp(t % math.tau, NET, case.rho) for t in angles]
    assert [rate < 0.0 for rate in rates] == [False] + [True] * 5
    kinds = {one: [C.kind for C in sorted(c2.critical_sets(case.at, one), key=lambda C: C.e[0])] for one in (ONE, HILL)}
    assert all(found == ["stable node", "saddle"] for found in kinds.values())


def within_a_third(case, _):
    for angle in (0.2, -0.8, 1.0, 1.3, 2.6, -1.9):
        start = 0.05 * np.array([math.cos(angle), math.sin(angle)])
        run = c2.simulate_nonsmooth(case.system, (*start, *case.z), (0.0, 0.6), case.psi)
        kinds = [phase.kind for phase in run.phases]
        if len(kinds) > 1:
            assert ("cross" in kinds) == (abs(angle) < math.pi / 3.0), (angle, kinds)


def nonunique(case, _):
    z = case.z[0]
    chi = (1.0 + 2.0 * z * z) / (1.0 + z * z)
    found = sorted(c2.critical_sets(case.at, case.psi), key=lambda C: C.e[0])
    np.testing.assert_allclose([C.e[0] for C in found], [-chi / 2, 0.0, chi / 2], atol=1e-9)
    assert [C.kind for C in found] == ["stable node", "saddle", "stable node"]
    np.testing.assert_allclose([C.slow_flow[0] for C in found], [chi + 0.25, 0.25, -chi + 0.25], atol=1e-9)
    assert case.directions == (8 if chi**2 < 2.0 else 4)


def flows_said(case, fields):
    found = sorted(c2.critical_sets(case.at, case.psi), key=lambda C: C.e[0])
    assert number(fields["first"]) == pytest.approx(found[0].slow_flow[0], rel=1e-3)
    assert number(fields["third"]) == pytest.approx(found[2].slow_flow[0], rel=1e-3)


def one_sign(case, fields):
    """The divergence in the chart, by differences."""
    h = 1e-5
    flat = PLACES[:7].reshape(-1, 2)
    U = lambda xy: case.at.U(e_psi(case.psi, xy))  # noqa: E731
    divergence = sum((U(flat + h * np.eye(2)[k]) - U(flat - h * np.eye(2)[k]))[:, k] for k in (0, 1))
    assert ((divergence > 0.0) if fields["sign"] == "positive" else (divergence < 0.0)).all()
    assert fields["kind"].split(" ", 1)[1] == c2.critical_sets(case.at, case.psi)[0].kind


def kinds_said(case, fields):
    sets = c2.critical_sets(case.at, case.psi)
    for C, words in zip(sets, fields["which"].split("; "), strict=True):
        assert words.endswith(C.kind)
        if C.kind in ("saddle-node", "degenerate"):
            continue
        h = 1e-6
        D = np.stack([(case.at.U(C.e + h * np.eye(2)[k]) - case.at.U(C.e - h * np.eye(2)[k])) for k in (0, 1)], axis=-1)
        if abs(np.linalg.det(D)) > 1e-9 * np.abs(D).max() ** 2:
            assert (np.linalg.det(D) < 0.0) == (C.kind == "saddle")


def ends(case, fields):
    cycle = c2.equator_cycle(case.at)
    line = c2.trajectories(case.at, case.psi, [[1.05, 0.0]], t_max=60.0 * cycle.period, view=1e3).points[0]
    if abs(cycle.exponent) > 1e-3 and abs(cycle.exponent) < 5.0:
        angle = np.unwrap(np.arctan2(*line.T[::-1]))
        after = float(np.interp(math.tau, np.abs(angle - angle[0]), np.hypot(*line.T) - 1.0))
        assert (after < 0.05) == (fields["ends"] == "attracts")
        assert {fields["ends"], fields["other"]} == {"attracts", "repels"}


def turns_add_up(case, _):
    index = sum({"saddle": -1, "saddle-node": 0}.get(C.kind, 1) for C in c2.critical_sets(case.at, case.psi))
    assert case.turns == index


def up(case, _):
    """Beside a direction, out and up the hemisphere, the rates of ρ and of ε/ρ are opposite."""
    for theta, rate in zip(
        c2.equator_equilibria(case.at).theta, c2.equator_equilibria(case.at).lambda_rho, strict=True
    ):
        e = np.array([math.cos(theta), math.sin(theta)])
        outside = float(e @ case.at.U(e))
        inside = -float(e @ case.at.U(0.999999 * e))
        assert outside == pytest.approx(rate, abs=1e-3 * case.size)
        assert inside == pytest.approx(-rate, abs=1e-3 * case.size)


def z_stays(case, _):
    if case.at.m:
        runs = [c2.simulate(case.system, case.psi, eps, (eps, 0.0, *case.z), (0.0, 5.0 * eps)) for eps in (1e-4, 1e-6)]
        moves = [run.states[-1, 2:] for run in runs]
        assert np.abs(moves[1] - case.z).max() <= 0.02 * np.abs(moves[0] - case.z).max() + 1e-12


def none_there(case, _):
    assert not len(c2.equator_equilibria(case.at))
    assert case.directions == 0 or c2.equator_equilibria(case.at).all_directions


CHECKS = {
    "case1(a)": all_reach,
    "case1(b)": no_set,
    "case1(c)": ok(lambda case, _: case.name.name in ("CM0", "CM2", "CM4", "NCM2", "NCM4")),
    "not Case I": ok(lambda case, _: case.form.a * case.form.d <= 0.0),
    "count not generic": ok(lambda case, _: case.degenerate),
    "none, on a border": ok(lambda case, f: case.degenerate and not len(case.sets) and int(f["count"]) > 0),
    "none, generic": ok(lambda case, f: case.directions == int(f["count"]) and not len(case.sets)),
    "portrait not generic": ok(lambda case, f: f["names"] == ", ".join(d.name for d in case.name.degeneracies)),
    "this one": ok(lambda case, f: f["name"] == f"{'CM' if len(case.sets) else 'NCM'}{case.directions}"),
    "case2(a)": four_saddles,
    "case2(b)": no_set,
    "not Case II": ok(lambda case, _: case.form.a * case.form.d >= 0.0 or np.linalg.det(case.form.A) >= -1e-12),
    "one for each separatrix": four_saddles,
    "geneps0(a)": ok(lambda case, _: case.directions > 0 or case.degenerate),
    "all are equilibria": ok(lambda case, _: np.abs(case.theta).max() < 1e-12),
    "no equilibrium": none_there,
    "geneps0(b)": up,
    "none isolated": none_there,
    "goes on up": up,
    "geneps0(c)": none_there,
    "there are directions": ok(
        lambda case, _: len(c2.equator_equilibria(case.at)) > 0 or c2.equator_equilibria(case.at).all_directions
    ),
    "equator ends": ends,
    "geneps1: z": z_stays,
    "geneps1: z, why": z_stays,
    "one set": ok(lambda case, _: len(case.sets) == (case.length < 1.0)),
    "no inverse": ok(lambda case, _: abs(np.linalg.det(case.matrix[0])) < 1e-9 * max(1.0, case.size**2)),
    "border of existence": ok(lambda case, f: abs(case.length - 1.0) < 1e-9 and abs(number(f["length"]) - 1) < 1e-5),
    "slow flow of C": slow_of_C,
    "W not e-linear": ok(
        lambda case, _: np.abs(case.at.W(CIRCLE) + case.at.W(-CIRCLE) - 2 * case.at.W(np.zeros(2))).max() > 1e-9
    ),
    "no isolated critical set": ok(lambda case, _: not c2.critical_sets(case.at, case.psi)),
    "no slow variable": ok(lambda case, _: case.at.m == 0),
    "no sliding flow": ok(lambda case, _: not c2.critical_sets(case.at, case.psi)),
    "all combinations agree": combinations,
    "index": turns_add_up,
    "index not defined": ok(lambda case, _: case.degenerate),
    "none is missing": turns_add_up,
    "mean over a cycle": mean_over,
    "no cycle given": ok(lambda case, _: case.cycles is None),
    "no slow variable, no mean": ok(lambda case, _: case.at.m == 0),
    "mean is that of C": mean_over,
    "U not e-linear": ok(lambda case, _: not case.linear()),
    "rotation": form_of,
    "D1": equal_diagonal,
    "every direction, b = 0": ok(lambda case, _: np.abs(case.theta).max() < 1e-12),
    "D1, here": ok(
        lambda case, f: (
            abs(number(f["b"]) - abs(case.form.b)) < 1e-4
            and abs(number(f["f"]) - math.hypot(case.form.f1, case.form.f2)) < 1e-4 * case.size
        )
    ),
    "D2": on_axes,
    "not D2": ok(lambda case, _: case.form.b != 0.0 or case.form.f1 * case.form.f2 != 0.0),
    "nothing turns at f = 0, D2": ok(lambda case, _: np.abs(case.theta).max() < 1e-12),
    "ball": ball,
    "not the ball": ok(lambda case, _: case.at.m != 2 or case.system is not BALL),
    "ball, on the border": ok(lambda case, _: abs(case.length - 1.0) < 1e-9),
    "attracting and repelling": attracting_repelling,
    "not attracting and repelling": ok(lambda case, _: case.system is not ATTRACTING or not case.z),
    "within a third": within_a_third,
    "non-unique": nonunique,
    "not non-unique": ok(lambda case, _: case.system is not NONUNIQUE or not case.z),
    "two slow flows": flows_said,
    "lem:ePsi(a)": equivariant,
    "through the square": equivariant,
    "lem:ePsi(b)": homogeneous,
    "one scale": homogeneous,
    "lem:ePsi(c)": increases,
    "one place": increases,
    "lem:ePsi(d)": increases,
    "complement": ok(
        lambda case, _: np.allclose(
            1.0 - case.psi.modulus(np.geomspace(0.1, 10, 9)) ** 2,
            np.asarray(case.psi(np.geomspace(0.1, 10, 9) ** 2))
            / (np.geomspace(0.1, 10, 9) ** 2 + np.asarray(case.psi(np.geomspace(0.1, 10, 9) ** 2))),
        )
    ),
    "lem:ePsi(e)": positive_definite,
    "saddle stays": positive_definite,
    "stands still": stands_still,
    "vanishes there": stands_still,
    "sign of the determinant": ok(lambda case, _: True),  # held by what it comes to, the next
    "one sign of two determinants": kinds_said,
    "independent of Ψ": slow_for_every_psi,
    "elsewhere in the chart": slow_for_every_psi,
    "slow manifold": manifold,
    "up to second order": manifold,
    "m = 0, an equilibrium": ok(lambda case, _: case.at.m == 0),
    "frozen": ok(lambda case, _: getattr(case.system, "frozen", False)),
    "one sign": one_sign,
    "vanishes in one": ok(lambda case, _: len(c2.equator_equilibria(case.at)) == 1),
    "vanishes in": ok(
        lambda case, f: (
            int(f["count"]) == (case.directions if not case.degenerate else len(c2.equator_equilibria(case.at)))
        )
    ),
    "one set here": ok(lambda case, f: len(case.sets) == 1 and number(f["length"]) < 1.0 + 1e-6),
    "no set here": ok(lambda case, f: len(case.sets) == 0 and number(f["length"]) > 1.0 - 1e-6),
    "condition number": ok(lambda case, f: np.linalg.cond(case.matrix[0]) > 1e11),
    "no cycle there": ok(lambda case, _: case.cycles == ()),
    "D2, at the pitchfork": ok(lambda case, f: f["f"] == f["spread"]),
    "D2, here": ok(lambda case, f: number(f["spread"]) == pytest.approx(abs(case.form.d - case.form.a), rel=1e-4)),
    "no rotation": rotated,
    "rotated": rotated,
    "ball sticks": ball,
    "ball slips": ball,
    "not hyperbolic": ok(lambda case, _: flattest(case) < 1e-5),
    "not hyperbolic, several": ok(lambda case, _: flattest(case) < 1e-5),
    "a and d differ": ok(lambda case, _: case.form.a != case.form.d),
}


def flattest(case):
    return min(
        float(np.abs(C.eigenvalues.real).min()) / float(np.abs(C.eigenvalues).max())
        for C in c2.critical_sets(case.at, case.psi)
    )


BALL, ATTRACTING, NONUNIQUE = examples.ball_in_pool(), examples.attracting_repelling(), examples.nonunique_sliding()
CYCLING = dataclasses.replace(c2.presets["case3-n3"].system, B=((1.0, 0.0),), g=(0.1,))
CASES = {
    "case1(a)": (ELinear(-1, 0.3, -1.6, (0.2, 0.1)), HILL),
    "case1(a), backwards": (ELinear(1, 0.3, 1.6, (0.2, 0.1)), ONE),
    "case1(b)": (ELinear(-1, 0.3, -1.6, (2.2, 0.1)), ONE),
    "case2(a)": (ELinear(1, 0.3, -1.6, (0.2, 0.1)), ONE),
    "case2(b)": (ELinear(1, 0.3, -1.6, (2.2, 0.1)), HILL),
    "geneps0(c)": (ELinear(-1, 3, -1.2, (0.2, 0.1)), ONE),
    "all are equilibria": (ELinear(-1, 0, -1), ONE),
    "border of existence": (ELinear(-1, 0, -1, (1, 0)), ONE),
    "none, on a border": (ELinear(-1, 0, -4, (-3, 0)), ONE),
    "no inverse": (ELinear(-1, 0, 0, (0.3, 0.2)), ONE),
    "D1, here": (ELinear(-1, 0.5, -1, (0.3, 0.9)), ONE),
    "D2, here": (ELinear(-1, 0, -2, (0.3, 0)), ONE),
    "D2, at the pitchfork": (ELinear(-1, 0, -1.5, (-0.5, 0)), ONE),
    "rotated": (System(U=("-c/2 + s - 0.1", "-s - c/3")), ONE),
    "U not e-linear": (System(U=("-c**3 + s/2", "-s")), ONE),
    "ball sticks": (BALL, ONE, (0.3, 0.2)),
    "ball slips": (BALL, ONE, (40.0, 3.0)),
    "within a third": (ATTRACTING, ONE, (0.3,)),
    "two slow flows": (NONUNIQUE, ONE, (0.2,)),
    "two slow flows, four directions": (NONUNIQUE, psi.tanh(), (1.2,)),
    "elsewhere in the chart": (ELinear(-1, 0.3, -1.6, (0.2, "0.1 + z/3"), B=((1, 2),), g=(0.2,)), HILL, (0.1,)),
    "all combinations agree": (ELinear(-1, 0.3, -1.6, (0.2, 0.1), B=((1, 2),), g=(0.2,)), ONE, (0.1,)),
    "W not e-linear": (System(U=("-c", "-s"), W=("c**2",)), ONE, (0.1,)),
    "mean is that of C": (CYCLING, HILL, (0.0,), True),
    "no cycle there": (ELinear(-1, 0.3, -1.6, (0.2, 0.1)), ONE, (), True),
    "not hyperbolic": (ELinear(0, 2, 0, (0.3, 0.1), B=((1, 2),)), ONE, (0.0,)),
    "condition number": (ELinear(1.0, 1.0, -1.0 + 1e-13, (0.3, 0.1)), ONE),
}


def hold(system, family, z=(), cycles=False):
    found = c2.limit_cycles(system, family, z) if cycles else None
    case = Case(system, family, z, None if found is None else tuple(found))
    keys = set()
    for certificate in certificates(system, family, z, cycles=found):
        told = [certificate.sentence]
        if certificate.verdict.value == "holds":
            told.append(certificate.statement)
        for text in told:
            for key, fields in recognise(text):
                if key in ROOMS["claims"]:
                    CHECKS[key](case, fields)
                    keys.add(key)
    return keys


@pytest.mark.parametrize("key", CASES)
def test_of_the_claims(key):
    assert key.split(", back")[0].split(", four")[0] in hold(*CASES[key])


@settings(max_examples=3)
@given(systems, regularisations)
def test_of_random_systems(system, family):
    assert hold(system, family)


@pytest.mark.parametrize("name", c2.presets)
def test_of_every_portrait(name):
    preset = c2.presets[name]
    assert hold(preset.system, preset.psi, preset.z)


def test_every_sentence_of_a_claim_is_held():
    assert CHECKS.keys() == ROOMS["claims"].keys()
