"""Checks of what is said of a portrait, by motions and orbits that the sentences were not made from.

Of the way to Sigma motions of the nonsmooth system are asked, of what follows there orbits of the regularised system
with a small eps.
"""

import dataclasses
import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import psi
from codim2_core.results.words import count_word

EPS = 1e-5
NEAR = 0.05  # where motions towards Sigma start


def still(system):
    """The system with z' = 0."""
    if isinstance(system, c2.ELinear):
        return dataclasses.replace(system, B=((0.0, 0.0),) * system.m, g=(0.0,) * system.m)
    return system.evolve(W=("0",) * system.m)


class Portrait:
    """A system at one z with what its sentences may be held against."""

    def __init__(self, system, family, z=()):
        self.system, self.psi, self.z = system, family, tuple(z) or (0.0,) * system.m
        self.at = system.at(self.z)
        self.equator = c2.equator_equilibria(system, self.z)
        self.critical = c2.critical_sets(system, family, self.z)
        self.size = max(self.at.size, 1e-9)
        self.sharp = self.slowest()

    def slowest(self):
        """How slow the slowest thing on the equator is, of the speed: what is nearly degenerate takes too long."""
        rates = np.abs([*self.equator.lambda_rho, *self.equator.lambda_theta])
        cycle = c2.equator_cycle(self.system, self.z)
        if cycle is not None:
            return abs(cycle.exponent)
        return float(rates.min()) / self.size if len(rates) else 1.0

    def ray(self, i):
        theta = float(self.equator.theta[i])
        return np.array([math.cos(theta), math.sin(theta)])

    def arrives(self, angle, radius=NEAR):
        """Whether the nonsmooth motion from there comes to Sigma in good time: a phase that is no slip follows."""
        start = (radius * math.cos(angle), radius * math.sin(angle), *self.z)
        motion = c2.simulate_nonsmooth(self.system, start, (0.0, 60.0 / self.size), psi=self.psi)
        return any(phase.t_start > 0.0 for phase in motion.phases) or "Σ" in motion.status.value

    def stays(self, angle):
        """Largest |(x, y)|/eps late in the regularised motion from near Sigma at that angle.

        Late: well after the limit has come to Sigma, which a spiral does as slowly as its exponent says: a turn may
        take it out tenfold before the next takes it in. The sentence is of one z, and so z stands still.
        """
        system = still(self.system)
        start = (200 * EPS * math.cos(angle), 200 * EPS * math.sin(angle), *self.z)
        limit = c2.simulate_nonsmooth(system, start, (0.0, 1e6 * EPS / self.size), psi=self.psi)
        came = limit.phases[0].t_end
        end = 1.2 * came + 4e4 * EPS / self.size
        motion = c2.simulate(system, self.psi, start, (0.0, end), eps=EPS, max_steps=400_000)
        late = motion.times >= 1.2 * came + 0.4 * (motion.times[-1] - 1.2 * came)
        return float(np.hypot(*motion.states[late, :2].T).max()) / EPS

    def index(self, Q):
        return int(Q[1:].translate(str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789"))) - 1


def radial(portrait, sign):
    return int((np.sign(portrait.equator.lambda_rho) == sign).sum())


def every(portrait):
    return "both" if len(portrait.equator) == 2 else f"all {count_word(len(portrait.equator))}"


def all_arrive(portrait, fields):
    assert fields.get("which") in (every(portrait), None if len(portrait.equator) == 1 else "")
    for i in range(len(portrait.equator)):
        assert portrait.ray(i) @ portrait.at.U(portrait.ray(i)) < 0.0
        if portrait.equator.lambda_theta[i] < -1e-3 * portrait.size:
            assert portrait.arrives(float(portrait.equator.theta[i]) + 1e-3)


def all_leave(portrait, fields):
    assert fields.get("which") in (every(portrait), None if len(portrait.equator) == 1 else "")
    for i in range(len(portrait.equator)):
        assert portrait.ray(i) @ portrait.at.U(portrait.ray(i)) > 0.0
    assert not any(portrait.arrives(angle) for angle in (0.3, 2.0, 4.1))


def both(portrait, fields):
    arriving, leaving = radial(portrait, -1), radial(portrait, 1)
    assert fields["arriving"] == count_word(arriving)
    rest = "the other" + (f" {count_word(leaving)}" if leaving > 1 else "")
    assert fields["leaving"] == (rest if arriving + leaving == len(portrait.equator) else count_word(leaving))
    for i, rate in enumerate(portrait.equator.lambda_rho):
        along = float(portrait.ray(i) @ portrait.at.U(portrait.ray(i)))
        assert along * rate > 0.0 or abs(rate) < 1e-12 * portrait.size
        if rate < -1e-2 * portrait.size and portrait.equator.lambda_theta[i] < -1e-2 * portrait.size:
            assert portrait.arrives(float(portrait.equator.theta[i]) + 1e-3)


def spirals(portrait, way):
    """Whether nonsmooth motions come nearer with each turn (way < 0), or go away."""
    for angle in (0.0, 2.0):
        start = (NEAR * math.cos(angle), NEAR * math.sin(angle), *portrait.z)
        motion = c2.simulate_nonsmooth(portrait.system, start, (0.0, 60.0 / portrait.size), psi=portrait.psi)
        slip = motion.times <= motion.phases[0].t_end
        x, y = motion.states[slip, :2].T
        turns = np.abs(np.unwrap(np.arctan2(y, x))[-1] - angle) / (2 * math.pi)
        radius = np.hypot(x, y)
        whole = np.unwrap(np.arctan2(y, x)) - angle
        at = [int(np.argmin(np.abs(np.abs(whole) - 2 * math.pi * k))) for k in (0, 1)]
        assert turns > 1.0 or radius.max() > 20 * NEAR or radius.min() < 0.05 * NEAR
        if turns > 1.0:
            assert way * (radius[at[1]] - radius[at[0]]) > 0.0


def crossing(portrait, _):
    assert not portrait.critical
    for angle in (0.4, 1.9, 3.3, 5.0):
        if portrait.arrives(angle):
            assert portrait.stays(angle) > 50.0  # it was near, and is away again


def repelled(portrait, _):
    assert not portrait.critical
    assert not any(portrait.arrives(angle) for angle in (0.4, 1.9, 3.3, 5.0))


def near_critical(portrait, which=0):
    """Distance to a critical set after a while, over that at the start, for orbits that begin close to it."""
    C = portrait.critical[which]
    angle = np.linspace(0.0, 6.0, 6)
    room = min(1e-3, 0.1 * (1.0 - float(np.hypot(*C.p))))
    seeds = C.p + room * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    rate = float(np.abs(C.eigenvalues.real).min()) * math.sqrt(1.0 - float(C.p @ C.p))  # of T
    found = c2.trajectories(portrait.system, portrait.psi, seeds, portrait.z, t_max=4.0 / max(rate, 1e-9))
    return np.array([math.dist(line[-1], C.p) / room for line in found.points])


def slow(portrait):
    """Whether a linearisation at a critical set is too near the imaginary axis to be seen within a test."""
    return any(np.abs(C.eigenvalues.real).min() < 1e-2 * np.abs(C.eigenvalues).max() for C in portrait.critical)


def stable(portrait, fields):
    assert portrait.critical[0].kind == fields["kind"]
    if not slow(portrait):
        assert near_critical(portrait).max() < 1.0


def stable_sliding(portrait, fields):
    stable(portrait, fields)
    if portrait.sharp > 0.02 and not slow(portrait):
        for angle in (0.4, 1.9, 3.3, 5.0):
            assert portrait.arrives(angle)
        C = portrait.critical[0]
        if np.hypot(*C.x2) < 20.0:
            assert portrait.stays(0.4) < 100.0 + 2 * np.hypot(*C.x2)


def unreached(portrait, fields):
    stable(portrait, fields)
    assert not any(portrait.arrives(angle) for angle in (0.4, 1.9, 3.3, 5.0))


def unstable(portrait, fields):
    assert portrait.critical[0].kind == fields["kind"]
    if not slow(portrait):
        assert near_critical(portrait).min() > 1.0


def saddle(portrait, _):
    assert np.linalg.det(portrait.at.DU(np.zeros(2))) < 0.0
    for family in (psi.constant(), psi.hill(3), psi.tanh()):
        assert c2.critical_sets(portrait.system, family, portrait.z)[0].kind == "saddle"
    seeds = portrait.critical[0].p * 0.5 + 0.3 * np.stack([np.cos(np.arange(5.0)), np.sin(np.arange(5.0))], axis=-1)
    ends = c2.trajectories(portrait.system, portrait.psi, seeds, portrait.z, t_max=200.0 / portrait.size).points
    if portrait.sharp > 0.02 and not slow(portrait):
        assert (np.hypot(*np.array([line[-1] for line in ends]).T) > 0.9).mean() > 0.7


def kinds_of_general(portrait, _):
    for i, C in enumerate(portrait.critical):
        if C.kind.startswith(("stable", "unstable")) and not slow(portrait):
            ratio = near_critical(portrait, i)
            assert ratio.max() < 1.0 if C.kind.startswith("stable") else ratio.min() > 1.0


CLASSES = {
    "all directions": lambda p, _: np.testing.assert_allclose(
        [c2.equator_equilibria(p.system, p.z).all_directions], [True]
    ),
    "closed equator": lambda p, _: (not len(p.equator)) or pytest.fail("there are limit directions"),
    "closed equator, stable": lambda p, _: spirals(p, -1),
    "closed equator, unstable": lambda p, _: spirals(p, 1),
    "one arrives": all_arrive,
    "one leaves": all_leave,
    "all arrive": all_arrive,
    "all leave": all_leave,
    "both": both,
    "some arrive": lambda p, f: count_word(radial(p, -1)) == f["moving"] or pytest.fail(str(f)),
    "some leave": lambda p, f: count_word(radial(p, 1)) == f["moving"] or pytest.fail(str(f)),
    "none moves": lambda p, _: np.testing.assert_allclose(p.equator.lambda_rho, 0.0, atol=1e-9 * p.size),
    "neutral directions": lambda p, f: np.testing.assert_allclose(
        [p.equator.lambda_rho[p.index(Q)] for Q in f["which"].split() if Q.startswith("Q")], 0.0, atol=1e-9 * p.size
    ),
    "directions unproved": lambda p, _: np.testing.assert_allclose([p.equator.proven], [False]),
    "no directions found": lambda p, _: (not p.equator.proven and not len(p.equator)) or pytest.fail("proven"),
    "no set found": lambda p, _: p.critical and pytest.fail("there are critical sets"),
    "only set": kinds_of_general,
    "sets": kinds_of_general,
    "sets unproved": kinds_of_general,
    "crossing": crossing,
    "repelled": repelled,
    "stable sliding": stable_sliding,
    "stable, unreached": unreached,
    "stable in part": stable,
    "saddle": saddle,
    "unstable": unstable,
    "centre": lambda p, _: np.testing.assert_allclose(p.critical[0].trace, 0.0, atol=1e-6 * p.size),
    "no isolated set": lambda p, _: p.critical and pytest.fail("there are critical sets"),
    "no critical set": lambda p, _: p.critical and pytest.fail("there are critical sets"),
    "none stable": kinds_of_general,
    "not stable": kinds_of_general,
    "one stable": kinds_of_general,
    "several stable": kinds_of_general,
}


def tends(portrait, Q, wanted):
    """Whether directions next to a limit direction turn to it."""
    theta = float(portrait.equator.theta[portrait.index(Q)])
    turned = []
    for side in (1.0, -1.0):
        e = np.array([math.cos(theta + side * 1e-4), math.sin(theta + side * 1e-4)])
        u, v = portrait.at.U(e)
        turned.append(side * (e[0] * v - e[1] * u) < 0.0)
    assert sum(turned) == wanted


def slides(portrait, outcome):
    C = portrait.critical[-1] if len(portrait.critical) == 1 else portrait.critical[int(outcome.onto[1:]) - 1]
    if outcome.arrives == "open set" and portrait.sharp > 0.02 and not slow(portrait) and np.hypot(*C.x2) < 20.0:
        assert portrait.stays(outcome.theta + 1e-3 if outcome.theta is not None else 0.0) < 100.0
        assert np.allclose(C.slow_flow, outcome.slow_flow)


def around(portrait, outcome):
    if outcome.arrives == "open set" and portrait.sharp > 0.02:
        assert portrait.stays(outcome.theta + 1e-3 if outcome.theta is not None else 0.0) < 1000.0


def crosses(portrait, outcome):
    if outcome.arrives == "open set" and portrait.sharp > 0.02:
        assert portrait.stays(outcome.theta + 1e-3) > 50.0
        i = int(outcome.onto[1:]) - 1
        assert portrait.equator.lambda_rho[i] > 0.0
        assert outcome.leaving == pytest.approx(float(portrait.equator.theta[i]))


def never(portrait, outcome):
    if portrait.sharp > 0.02:
        theta = outcome.theta or 0.0
        assert not portrait.arrives(theta + 1e-4) or outcome.verdict != "misses" or portrait.equator.lambda_theta.any()
        assert portrait.ray(portrait.index(outcome.label)) @ portrait.at.U(
            portrait.ray(portrait.index(outcome.label))
        ) > 0.0 if outcome.label.startswith("Q") else True  # fmt: skip


def says(verdict, why=""):
    def check(_, outcome):
        assert (outcome.verdict, outcome.why) == (verdict, why)

    return check


OUTCOMES = {
    "open set": lambda p, o: tends(p, o.label, 2),
    "one side": lambda p, o: tends(p, o.label, 1),
    "one side, all angles": lambda p, o: tends(p, o.label, 1),
    "single direction": lambda p, o: tends(p, o.label, 0),
    "spiral": lambda p, _: spirals(p, -1),
    "neutral approach": says("undecided", "neutral"),
    "repels": lambda p, o: (tends(p, o.label, 0), never(p, o)),
    "leads away": lambda p, o: (tends(p, o.label, 2 - (p.equator.multiplicity[p.index(o.label)] == 2)), never(p, o)),
    "turns away": lambda p, o: tends(p, o.label, 2),
    "all lead away": lambda p, _: p.arrives(0.3) and pytest.fail("it arrives"),
    "all directions": lambda p, _: p.equator.all_directions or pytest.fail("no"),
    "some lead": says("undecided", "several"),
    "at rest": says("undecided", "neutral"),
    "no directions found": says("undecided", "unfollowed"),
    "neutral equator": says("undecided", "neutral"),
    "equator repels": lambda p, _: spirals(p, 1),
    "slides": slides,
    "slides around": around,
    "slides on a cycle": around,
    "crosses": crosses,
    "crosses spiralling": lambda p, o: p.critical == () or o.verdict == "cross" or pytest.fail("no"),
    "several ends": says("undecided", "several"),
    "saddle ahead": says("undecided", "several"),
    "neutral ahead": says("undecided", "neutral"),
    "rest ahead": says("undecided", "neutral"),
    "unfollowed": says("undecided", "unfollowed"),
    "alike": lambda _, o: {v for _, v, _ in o.families} <= {"slide", "cycle"} or pytest.fail(str(o.families)),
}
