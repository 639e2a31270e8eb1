"""Checks of what is said of the paper's claims: counts by nets, kinds by orbits, means by sums."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import examples

from .claim_case import CIRCLE, PLACES, e_psi, ok
from .read_back import number

BALL, ATTRACTING, NONUNIQUE = examples.ball_in_pool(), examples.attracting_repelling(), examples.nonunique_sliding()


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
    np.testing.assert_allclose(C.slow_flow, case.at.W(e), rtol=0.0, atol=1e-9 * case.size)


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
                weights @ W[k], C.slow_flow, rtol=0.0, atol=1e-7 * case.size * max(1.0, abs(weights).max())
            )


def mean_over(case, _):
    A, f = case.matrix
    for cycle in case.cycles:
        np.testing.assert_allclose(cycle.mean_e, -np.linalg.solve(A, f), atol=1e-6)


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
        rtol=0.0,
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


def stands_still(case, _):
    for C in c2.critical_sets(case.at, case.psi):
        (line,) = c2.trajectories(case.at, case.psi, [C.p], t_max=1e-3 / case.size).points
        assert math.dist(line[0], line[-1]) < 1e-6


def one_sign(case, fields):
    """The divergence in the chart, by differences."""
    h = 1e-5
    flat = PLACES[:7].reshape(-1, 2)
    U = lambda xy: case.at.U(e_psi(case.psi, xy))
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


def flows_said(case, fields):
    found = sorted(c2.critical_sets(case.at, case.psi), key=lambda C: C.e[0])
    assert number(fields["first"]) == pytest.approx(found[0].slow_flow[0], rel=1e-3)
    assert number(fields["third"]) == pytest.approx(found[2].slow_flow[0], rel=1e-3)


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
    "not the ball": ok(lambda case, _: case.at.m != 2 or case.system is not BALL),
    "not attracting and repelling": ok(lambda case, _: case.system is not ATTRACTING or not case.z),
    "not non-unique": ok(lambda case, _: case.system is not NONUNIQUE or not case.z),
    "two slow flows": flows_said,
    "stands still": stands_still,
    "vanishes there": stands_still,
    "sign of the determinant": ok(lambda case, _: True),  # held by what it comes to, the next
    "one sign of two determinants": kinds_said,
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
    "not hyperbolic": ok(lambda case, _: flattest(case) < 1e-5),
    "not hyperbolic, several": ok(lambda case, _: flattest(case) < 1e-5),
    "a and d differ": ok(lambda case, _: case.form.a != case.form.d),
}


EXAMPLES = "tests/core/examples/test_examples.py"
#: True of every Psi, or of a system of the literature, and held where these are.
ELSEWHERE = {
    **dict.fromkeys(
        ("lem:ePsi(a)", "lem:ePsi(b)", "lem:ePsi(c)", "lem:ePsi(d)", "lem:ePsi(e)", "through the square", "one scale",
         "one place", "complement", "saddle stays"),
        "tests/core/psi/test_psi.py, tests/core/layer_problem/test_hemisphere.py",
    ),
    **dict.fromkeys(("independent of Ψ", "elsewhere in the chart"), "tests/core/layer_problem/test_critical.py"),
    **dict.fromkeys(("slow manifold", "up to second order"), "tests/core/motion/test_phases.py"),
    **dict.fromkeys(("ball", "ball, on the border", "ball sticks", "ball slips"), EXAMPLES),
    **dict.fromkeys(("attracting and repelling", "within a third"), "tests/core/layer_problem/test_structure_typed.py"),
    "non-unique": "tests/core/layer_problem/test_structure_typed.py",
}  # fmt: skip


def flattest(case):
    return min(
        float(np.abs(C.eigenvalues.real).min()) / float(np.abs(C.eigenvalues).max())
        for C in c2.critical_sets(case.at, case.psi)
    )
