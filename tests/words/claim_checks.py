"""Checks of what is said of the paper's claims: counts by nets, kinds by orbits, means by sums."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import examples

from .claim_case import CIRCLE, PLACES, e_psi, ok
from .read_back import number

BALL, ATTRACTING, NONUNIQUE = examples.ball_in_pool(), examples.attracting_repelling(), examples.nonunique_sliding()


def rotated(case, fields):
    q, A = case.form, case.matrix[0]
    phi = number(fields.get("phi", "0"))
    R = np.array([[math.cos(phi), -math.sin(phi)], [math.sin(phi), math.cos(phi)]])
    np.testing.assert_allclose(R @ A @ R.T, q.A, atol=1e-4 * case.size)
    assert q.A[0, 1] == -q.A[1, 0]


def ends(case, fields):
    cycle = c2.equator_cycle(case.at)
    line = c2.trajectories(case.at, case.psi, [[1.05, 0.0]], t_max=60.0 * cycle.period, view=1e3).points[0]
    if abs(cycle.exponent) > 1e-3 and abs(cycle.exponent) < 5.0:
        angle = np.unwrap(np.arctan2(*line.T[::-1]))
        after = float(np.interp(math.tau, np.abs(angle - angle[0]), np.hypot(*line.T) - 1.0))
        assert (after < 0.05) == (fields["ends"] == "attracts")
        assert {fields["ends"], fields["other"]} == {"attracts", "repels"}


def none_there(case, _):
    assert not len(c2.equator_equilibria(case.at))
    assert case.directions == 0 or c2.equator_equilibria(case.at).all_directions


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
    "case1(b)": ok(lambda case, _: not len(case.sets)),
    "case1(c)": ok(lambda case, _: case.name.name in ("CM0", "CM2", "CM4", "NCM2", "NCM4")),
    "not Case I": ok(lambda case, _: case.form.a * case.form.d <= 0.0),
    "count not generic": ok(lambda case, _: case.degenerate),
    "none, on a border": ok(lambda case, f: case.degenerate and not len(case.sets) and int(f["count"]) > 0),
    "none, generic": ok(lambda case, f: case.directions == int(f["count"]) and not len(case.sets)),
    "portrait not generic": ok(lambda case, f: f["names"] == ", ".join(d.name for d in case.name.degeneracies)),
    "this one": ok(lambda case, f: f["name"] == f"{'CM' if len(case.sets) else 'NCM'}{case.directions}"),
    "case2(b)": ok(lambda case, _: not len(case.sets)),
    "not Case II": ok(lambda case, _: case.form.a * case.form.d >= 0.0 or np.linalg.det(case.form.A) >= -1e-12),
    "geneps0(a)": ok(lambda case, _: case.directions > 0 or case.degenerate),
    "all are equilibria": ok(lambda case, _: np.abs(case.theta).max() < 1e-12),
    "no equilibrium": none_there,
    "none isolated": none_there,
    "geneps0(c)": none_there,
    "there are directions": ok(
        lambda case, _: len(c2.equator_equilibria(case.at)) > 0 or c2.equator_equilibria(case.at).all_directions
    ),
    "equator ends": ends,
    "one set": ok(lambda case, _: len(case.sets) == (case.length < 1.0)),
    "no inverse": ok(lambda case, _: abs(np.linalg.det(case.matrix[0])) < 1e-9 * max(1.0, case.size**2)),
    "border of existence": ok(lambda case, f: abs(case.length - 1.0) < 1e-9 and abs(number(f["length"]) - 1) < 1e-5),
    "W not e-linear": ok(
        lambda case, _: np.abs(case.at.W(CIRCLE) + case.at.W(-CIRCLE) - 2 * case.at.W(np.zeros(2))).max() > 1e-9
    ),
    "no isolated critical set": ok(lambda case, _: not c2.critical_sets(case.at, case.psi)),
    "no slow variable": ok(lambda case, _: case.at.m == 0),
    "no sliding flow": ok(lambda case, _: not c2.critical_sets(case.at, case.psi)),
    "index not defined": ok(lambda case, _: case.degenerate),
    "no cycle given": ok(lambda case, _: case.cycles is None),
    "no slow variable, no mean": ok(lambda case, _: case.at.m == 0),
    "U not e-linear": ok(lambda case, _: not case.linear()),
    "every direction, b = 0": ok(lambda case, _: np.abs(case.theta).max() < 1e-12),
    "D1, here": ok(
        lambda case, f: (
            abs(number(f["b"]) - abs(case.form.b)) < 1e-4
            and abs(number(f["f"]) - math.hypot(case.form.f1, case.form.f2)) < 1e-4 * case.size
        )
    ),
    "not D2": ok(lambda case, _: case.form.b != 0.0 or case.form.f1 * case.form.f2 != 0.0),
    "nothing turns at f = 0, D2": ok(lambda case, _: np.abs(case.theta).max() < 1e-12),
    "not the ball": ok(lambda case, _: case.at.m != 2 or case.system is not BALL),
    "not attracting and repelling": ok(lambda case, _: case.system is not ATTRACTING or not case.z),
    "not non-unique": ok(lambda case, _: case.system is not NONUNIQUE or not case.z),
    "two slow flows": flows_said,
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


def flattest(case):
    return min(
        float(np.abs(C.eigenvalues.real).min()) / float(np.abs(C.eigenvalues).max())
        for C in c2.critical_sets(case.at, case.psi)
    )
