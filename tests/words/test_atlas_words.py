"""What is said of a point of codimension two is what stands still there, and about it."""

import math

import numpy as np

import codim2_core as c2

from .read_back import number
from .recognition import recognise

TAKENS = c2.System(U=("s", "mu + k*s + c**2 + c*s"), parameters={"mu": 0.0, "k": 0.0})
CUSPED = c2.System(U=("mu + k*c + c**3", "-s"), parameters={"mu": 0.0, "k": 0.0})
PLANES = {
    "takens": (TAKENS, ("mu", "k"), ((-1.5, 0.5), (-1.5, 1.5))),
    "cusped": (CUSPED, ("mu", "k"), ((-0.6, 0.65), (-0.7, 0.75))),
    "ends": (
        c2.System(U=("mu + c*k - s**2 - c**2/2", "s"), parameters={"mu": 0.0, "k": 0.0}),
        ("mu", "k"),
        ((-2, 2), (-2, 2)),
    ),
    "linear": (c2.ELinear(1, 0.4, -1), ("f1", "f2"), ((-3, 3), (-3, 3))),
    "bad": (c2.ELinear(172, 186, -200), ("f1", "f2"), ((-300, 300), (-300, 300))),
}
PSI = c2.psi.hill(2)


def theta_of(fields):
    return number(fields["theta"])


def on_equator(system, theta):
    e = np.array([math.cos(theta), math.sin(theta)])
    at = system.at()
    return at.U(e), at.DU(e), e, np.array([-e[1], e[0]])


def cusp_of_directions(system, fields):
    U, D, n, t = on_equator(system, theta_of(fields))
    assert abs(t @ U) < 1e-3 * system.at().size
    assert abs(t @ D @ t - n @ U) < 1e-3 * system.at().size
    equator = c2.equator_equilibria(system)
    assert max(equator.multiplicity) == 3 or len(equator) in (2, 4)


def two_borders_touch(system, fields):
    U, D, _, t = on_equator(system, theta_of(fields))
    assert np.abs(U).max() < 2e-3 * system.at().size
    assert abs(t @ D @ t) < 2e-3 * system.at().size


def fold_on_the_equator(system, fields):
    U, D, _, _ = on_equator(system, theta_of(fields))
    assert np.abs(U).max() < 2e-3
    assert abs(np.linalg.det(D)) < 2e-3


def cusp_of_sets(system, _):
    counts = {len(c2.critical_sets(system.evolve(mu=mu, k=k), PSI)) for mu, k in ((1e-4, -0.1), (1e-4, 0.1))}
    assert counts == {1, 3}


def both_eigenvalues_zero(system, _):
    sets = c2.critical_sets(system.evolve(mu=-1e-6, k=0.0), PSI)
    assert min(abs(C.eigenvalues).max() for C in sets) < 0.2


def lyapunov_turns(system, _):
    C = min(c2.critical_sets(system, PSI), key=lambda C: abs(C.trace))
    assert abs(C.trace) < 1e-3 * math.sqrt(C.determinant)


def two_at_once(system, fields):
    kinds = {"saddle-node", "transcritical", "Hopf", "neutral equator", "pitchfork"}
    kinds |= {"fold of critical sets", "pitchfork of critical sets"}
    assert {fields["one"], fields["other"]} <= kinds
    equator = c2.equator_equilibria(system)
    sets = c2.critical_sets(system, PSI)
    near = [abs(equator.lambda_theta).min(initial=1e9), abs(equator.lambda_rho).min(initial=1e9)]
    near += [min((abs(C.trace) for C in sets), default=1e9), min((abs(C.determinant) for C in sets), default=1e9)]
    assert min(near) < 0.05 * system.at().size


CHECKS = {
    "cusp of directions": cusp_of_directions,
    "two borders touch": two_borders_touch,
    "fold on the equator": fold_on_the_equator,
    "cusp of sets": cusp_of_sets,
    "both eigenvalues zero": both_eigenvalues_zero,
    "Lyapunov turns": lyapunov_turns,
    "two at once": two_at_once,
}


def test_each_point_is_what_it_is_called_and_every_sentence_is_said():
    seen = set()
    for system, names, ranges in PLANES.values():
        for point in c2.atlas(system, PSI, dict(zip(names, ranges, strict=True))).points:
            at = system.evolve(**dict(zip(names, map(float, point.place), strict=True)))
            for key, fields in recognise(point.sentence):
                CHECKS[key](at, fields)
                seen.add(key)
    assert seen == CHECKS.keys()
