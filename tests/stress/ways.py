"""Whatever can be had in two ways, of random systems: what the two say is compared, and printed where they differ.

``python -m tests.stress --ways [--seconds S] [--seed N]``
"""

from __future__ import annotations

import math
import random
import time
from collections.abc import Callable, Iterator, Sequence

import numpy as np

import codim2_core as c2
from codim2_core import psi
from codim2_core.bifurcations.atlases.regions import inside_polygons
from codim2_core.motion.compare_with_limit import agreement
from tests.core.polylines import away

FAMILIES = (psi.constant(), psi.rational(), psi.tanh(), psi.hill(3.0))
#: Of the ranges: nearer to a curve, or of the span to a special value, nothing is compared.
ASIDE = 2e-3
SAME = 1e-6

Check = Callable[[random.Random], tuple[str, list[str]]]


def elinear(rng: random.Random) -> c2.ELinear:
    """Case III, in which there may be limit cycles, three times of four."""
    a, d = rng.uniform(0.2, 2.0), rng.uniform(-2.0, 2.0)
    if rng.random() < 0.75:
        d = -abs(d)
    b = rng.choice((-1, 1)) * rng.uniform(0.5, 2.5) * math.sqrt(abs(a * d))
    return c2.ELinear(*(round(v, 3) for v in (a, b, d)), (round(rng.uniform(-1, 1), 3), round(rng.uniform(-1, 1), 3)))


def general(rng: random.Random) -> c2.System:
    """Cubic in e, with a parameter p and a slow variable."""
    k = [round(rng.uniform(-1.0, 1.0), 3) for _ in range(14)]
    return c2.System(
        U=(
            "p*c+({})*c+({}-0.9)*s+({})*c*c+({})*c*s+({})*s*s+({})*c**3+({})*z".format(*k[:7]),
            "({}+0.9)*c+({}+p/2)*s+({})*c*c+({})*c*s+({})*s*s+({})*s**3+({})*z*c".format(*k[7:]),
        ),
        W=("1",),
        parameters={"p": 0.0},
    )


def as_text(system: c2.ELinear, angle: float = 0.0, bend: str = "") -> c2.System:
    """The same system, written as formulas in axes turned by an angle, with parameters f1, f2 and one that is 0."""
    a, b, d = (float(system.value_of(name)) for name in "abd")
    c, s = math.cos(angle), math.sin(angle)
    R = np.array([[c, -s], [s, c]])
    A = R @ np.array([[a, -b], [b, d]]) @ R.T
    U = ["({!r})*c + ({!r})*s + ({!r})*f1 + ({!r})*f2".format(*row) for row in np.hstack([A, R]).tolist()]
    return c2.System(U=(U[0] + bend, U[1]), W=(), parameters={"f1": system.f[0], "f2": system.f[1], "k": 0.0})


def both_kinds_of_branches(rng: random.Random) -> tuple[str, list[str]]:
    """Branches along f1 of an e-linear system: in coefficients, as text in other axes, and by the general path."""
    system, family, angle = elinear(rng), rng.choice(FAMILIES), rng.uniform(-math.pi, math.pi)
    what = f"branches of {system!r}, {family.text}, along f1"
    first, turned, general = (
        _special(c2.branches(one, family, "f1", (-1.5, 1.5)))
        for one in (system, as_text(system, angle), as_text(system, bend="+k*c*s"))
    )
    places = [(p[0], p[1], p[2] * complex(math.cos(angle), math.sin(angle))) for p in first]
    said = [*_missing(places, turned, "only in coefficients"), *_missing(turned, places, "only as turned text")]
    first, general = ([(*mark[:2], 0j) for mark in marks] for marks in (first, general))  # places less exactly
    return what, said + _missing(first, general, "not in general") + _missing(general, first, "only in general")


def _special(found: c2.Branches) -> list[tuple[str, float, complex]]:
    marks = {(point.kind, point.value, 0j) for branch in found.cycles for point in branch.special}
    return sorted(marks | {(one.kind, one.value, complex(*one.place)) for one in found.standing}, key=lambda m: m[1])


def _missing(these: list[tuple[str, float, complex]], those: list[tuple[str, float, complex]], where: str) -> list[str]:
    near = lambda p, q: p[0] == q[0] and abs(p[1] - q[1]) < 10 * SAME and abs(p[2] - q[2]) < math.sqrt(SAME)
    return [f"{where}: {p}" for p in these if p[0] != "span" and not any(near(p, q) for q in those)]


def branches_and_cycles(rng: random.Random) -> tuple[str, list[str]]:
    """How many limit cycles the branches pass at random values, and how many there are."""
    system, family = general(rng), rng.choice(FAMILIES)
    found, said = c2.branches(system, family, "p", (-1.5, 1.5), (0.0,)).cycles, []
    special = [point.value for branch in found for point in branch.special]
    for value in (rng.uniform(-1.5, 1.5) for _ in range(12)):
        there = len(c2.limit_cycles(system.evolve(p=value), family, (0.0,)))
        if found.count(value) != there and min((abs(value - v) for v in special), default=1.0) > ASIDE * 3.0:
            said.append(f"at p = {value!r} the branches have {found.count(value)} cycles, and there are {there}")
    return f"cycles of {system.U}, {family.text}", said


def atlas_and_portraits(rng: random.Random) -> tuple[str, list[str]]:
    """The names of regions, and what stands still at random places and along the edges."""
    system, family = general(rng), rng.choice(FAMILIES)
    found, said = c2.atlas(system, family, {"p": (-2, 2), "z1": (-2, 2)}, (0.0,)), []
    places = [(rng.uniform(-2, 2), rng.uniform(-2, 2)) for _ in range(30)]
    for side in (-1.998, 1.998):
        places += [(side, rng.uniform(-2, 2)) for _ in range(5)] + [(rng.uniform(-2, 2), side) for _ in range(5)]
    for p, z in places:
        at = np.array([[p, z]])
        if any(away(at, curve.points)[0] < 4.0 * ASIDE for curve in found.curves):
            continue
        names = [region.name for region in found.regions if inside_polygons(at, region.boundary)[0]]
        there = system.evolve(p=p)
        equator, sets = c2.equator_equilibria(there, (z,)), c2.critical_sets(there, family, (z,))
        count = "NCM" if not sets else "CM" if len(sets) == 1 else f"{len(sets)}CM"
        kinds = [C.kind.split()[-1][:3] for C in sets]  # a focus, or foci
        good = len(names) == 1 and names[0].startswith(f"{count}{len(equator)}") and all(k in names[0] for k in kinds)
        if not good:
            said.append(f"at ({p!r}, {z!r}) the region is {names}: {count}{len(equator)}, {[C.kind for C in sets]}")
    return f"atlas of {system.U}, {family.text}", said


def limit_and_eps(rng: random.Random) -> tuple[str, list[str]]:
    """The phases of the limit, and those of a motion with a small eps, or with a smaller one: one may pass Sigma by."""
    system, family = general(rng), rng.choice(FAMILIES)
    angle = rng.uniform(0.0, math.tau)
    start = (0.3 * math.cos(angle), 0.3 * math.sin(angle), rng.uniform(-0.5, 0.5))
    limit = c2.simulate_nonsmooth(system, start, (0.0, 1.5), psi=family)
    said: list[str] = []
    for eps in (1e-6, 1e-8, 1e-10):
        run = c2.simulate(system, family, start, (0.0, 1.5), eps=eps)
        found = agreement(system, family, run, limit)
        said = (
            []
            if found.same or any("loses its stability here" in phase.reason for phase in run.phases)
            else [found.sentence]
        )
        if not said:
            break
    return f"motion of {system.U}, {family.text}, from {start}", said


CHECKS: tuple[Check, ...] = (both_kinds_of_branches, branches_and_cycles, atlas_and_portraits, limit_and_eps)


def differences(seed: int, checks: Sequence[Check]) -> Iterator[tuple[str, str, list[str], float]]:
    """Compare without end: the check, what was compared, how it differs, and the seconds it took."""
    for k in range(10**9):
        for check in checks:
            begun = time.monotonic()
            try:
                what, said = check(random.Random(f"{seed} {k}"))
            except Exception as error:  # printed, and on with the next
                what, said = f"{check.__name__} {seed} {k}", [repr(error)]
            yield check.__name__, what, said, time.monotonic() - begun


def compare(seconds: float, seed: int, checks: Sequence[Check] = CHECKS) -> int:
    """Compare until the time is over; print what differs, and how many were compared. 1 if something did."""
    end, tried, wrong, spent = time.monotonic() + seconds, {}, {}, {}
    for name, what, said, took in differences(seed, checks):
        tried[name] = tried.get(name, 0) + 1
        wrong[name] = wrong.get(name, 0) + bool(said)
        spent[name] = spent.get(name, 0.0) + took
        if said:
            print(f"{name}: {what}", *said, sep="\n    ", flush=True)
        if time.monotonic() > end:
            break
    for name, count in tried.items():
        print(f"{name}: {count} compared, {wrong[name]} differ, {spent[name] / count:.2f} s each (seed {seed})")
    return int(any(wrong.values()))
