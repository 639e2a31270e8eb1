"""Checks of what is claimed of e_Psi, and of sets and slow flows whatever Psi."""

import math

import numpy as np

import codim2_core as c2
from codim2_core import psi

from .claim_case import HILL, ONE, PLACES, e_psi


def equivariant(case, _):
    R = np.array([[math.cos(0.7), -math.sin(0.7)], [math.sin(0.7), math.cos(0.7)]])
    np.testing.assert_allclose(e_psi(case.psi, PLACES @ R.T), e_psi(case.psi, PLACES) @ R.T, rtol=0.0, atol=1e-12)


def homogeneous(case, _):
    np.testing.assert_allclose(e_psi(case.psi, 3.0 * PLACES, 3.0), e_psi(case.psi, PLACES), rtol=0.0, atol=1e-12)


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


def stands_still(case, _):
    for C in c2.critical_sets(case.at, case.psi):
        (line,) = c2.trajectories(case.at, case.psi, [C.p], t_max=1e-3 / case.size).points
        assert math.dist(line[0], line[-1]) < 1e-6


def slow_for_every_psi(case, _):
    flows = [[C.slow_flow for C in c2.critical_sets(case.at, one)] for one in (ONE, HILL, psi.tanh())]
    for other in flows[1:]:
        np.testing.assert_allclose(other, flows[0], rtol=0.0, atol=1e-9 * max(1.0, case.size))


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
