"""What samples of the return map foretell of an orbit: held against cycles that are followed, and against SciPy."""

import numpy as np
from scipy.integrate import solve_ivp

import codim2_core as c2
from codim2_core.cycles.foretold import ON_C, foretold
from codim2_core.layer_problem.problem import LayerProblem

STATES = 12


def random_problems(seed, count):
    """Layer problems of Case III about those of the paper and about one with two cycles, where C is a focus."""
    rng = np.random.default_rng(seed)
    while count:
        about = np.array([(1.0, 1.3, -1.2, 0.33, 0.07), (172.0, 186.0, -200.0, -86.0, -93.0)][count % 2])
        a, b, d, f1, f2 = about * rng.uniform(0.8, 1.2, 5)
        at, psi = c2.ELinear(a, b, d, (f1, f2)).at(), c2.psi.hill(rng.uniform(2.0, 5.0))
        found = c2.critical_sets(at, psi)
        if len(found) == 1 and found[0].kind.endswith("focus"):
            count -= 1
            yield LayerProblem(at, psi), found[0], c2.limit_cycles(at, psi), rng


def some_states(rng, C):
    """Points of the hemisphere, of which some are close to C."""
    p = rng.uniform(-1.0, 1.0, (STATES, 2)) * rng.choice([0.15, 0.9], (STATES, 1))
    p = np.where(rng.random((STATES, 1)) < 0.5, p, C.p + 0.3 * p)
    p = p[np.hypot(*p.T) < 0.99]
    return np.column_stack([p, np.sqrt(1.0 - (p**2).sum(axis=1))])


def turns_about(cycle, p):
    """How often a cycle goes round a point: 0 where the point lies outside."""
    x, y = (cycle.points - p).T
    return round((np.unwrap(np.arctan2(y, x))[-1] - np.arctan2(y, x)[0]) / (2.0 * np.pi))


def where(cycles, C, p):
    """Where the orbit through p goes by the cycles about it: an increasing return map has no other way."""
    inner = [i for i, cycle in enumerate(cycles) if not turns_about(cycle, p)]
    outer = [i for i, cycle in enumerate(cycles) if turns_about(cycle, p)]
    inward = cycles[max(inner)].kind == "stable" if inner else C.kind == "stable focus"
    outward = bool(outer) and cycles[min(outer)].kind == "stable"
    assert inward + outward < 2  # two neighbours do not both attract
    return (max(inner, default=ON_C)) if inward else min(outer) if outward else None


def test_orbits_go_where_the_cycles_about_them_lead():
    told = {"C": 0, "a cycle": 0, "others": 0}
    for problem, C, cycles, rng in random_problems(5, 60):
        if any(cycle.kind == "semistable" for cycle in cycles):
            continue
        states = some_states(rng, C)
        for state, k in zip(states, foretold(problem, states), strict=True):
            told["others" if k is None else "C" if k == ON_C else "a cycle"] += 1
            if k is not None:
                assert k == where(cycles, C, state[:2]), (problem.at, problem.psi, state)
    assert told["C"] > 100 < told["a cycle"], told


def ahead(problem, state, T):
    """Where an orbit is after the time T, in the disc, by SciPy in theta and ln |x2|: some come to 1e12 and back."""
    a, b, d, f1, f2 = problem.at.plane

    def velocity(_, place):
        radius = np.exp(place[1])
        c, s = np.cos(place[0]), np.sin(place[0])
        modulus = radius / np.sqrt(radius**2 + problem.psi(radius**2))  # of e_Psi
        U, V = modulus * (a * c - b * s) + f1, modulus * (b * c + d * s) + f2
        rate = np.hypot(1.0, radius) / radius  # dT = ebar dtau
        return rate * (c * V - s * U), rate * (c * U + s * V)

    x, y = state[:2] / state[2]
    found = solve_ivp(
        velocity, (0.0, T), (np.arctan2(y, x), np.log(np.hypot(x, y))), method="LSODA", rtol=1e-9, atol=1e-9
    )
    theta, radius = found.y[0, -1], np.exp(found.y[1, -1])
    return np.array([np.cos(theta), np.sin(theta)]) * radius / np.hypot(1.0, radius)


def test_orbits_that_are_followed_come_to_where_they_were_foretold():
    reached = {"C": 0, "a cycle": 0}
    for problem, C, cycles, rng in random_problems(11, 40):
        if len(cycles) == 0 or max(abs(np.log(cycle.multiplier)) for cycle in cycles) > 20.0:
            continue
        slowest = min(abs(np.log(cycle.multiplier)) for cycle in cycles)
        if slowest < 0.5 or abs(C.trace) < 0.05 * np.sqrt(C.determinant):
            continue  # 60 turns are not enough
        states = some_states(rng, C)[:3]
        for state, k in zip(states, foretold(problem, states), strict=True):
            if k is None:
                continue
            end = ahead(problem, state, 60.0 * cycles[0].period_T)
            onto = C.p[None] if k == ON_C else cycles[k].points
            assert np.hypot(*(onto - end).T).min() < 0.02, (problem.at, problem.psi, state)
            reached["C" if k == ON_C else "a cycle"] += 1
    assert min(reached.values()) >= 3, reached
