"""Checks of what is said of a motion, phase by phase, by the other description of it: what holds each sentence.

Of the limit ε → 0 the regularised motion with a small ε is asked, of one with ε > 0 its own states: where it is, in
which direction it left, how far away it stays.
"""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import psi
from codim2_core.results.words import written_label

EPS = 1e-6
CONSTANT = psi.constant()


class Told:
    """One motion, one of its phases, and what holds it."""

    def __init__(self, system, family, start, run, k):
        self.system, self.psi, self.start, self.run = system, family or CONSTANT, start, run
        self.phase = run.phases[k] if k < len(run.phases) else None
        self.before = run.phases[k - 1] if k else None
        end = run.times[-1]
        self.other = c2.simulate(system, self.psi, start, (0.0, end), eps=EPS) if run.eps == 0.0 and end > 0.0 else run

    def state(self, share):
        """Return the state of the regularised motion at a share of the phase."""
        t = self.phase.t_start + share * (self.phase.t_end - self.phase.t_start)
        return self.other.dense(min(t, self.other.times[-1]))

    def distance(self, share):
        return math.hypot(*self.state(share)[:2]) / (self.run.eps or EPS)

    def e(self, share):
        """Return e of the regularised motion there."""
        xy = self.state(share)[:2] / (self.run.eps or EPS)
        zeta = float(np.hypot(*xy))
        return self.psi.modulus(zeta) * xy / zeta if zeta else xy

    def z(self):
        return tuple(self.run.dense(self.phase.t_start if self.phase else self.run.times[-1])[2:].tolist())

    def sets(self, family=None):
        return c2.critical_sets(self.system, family or self.psi, self.z())


def outside(told, _):
    assert math.hypot(*told.start[:2]) > 0.0
    assert told.phase.kind == "slip"


def slides(told, fields):
    """The regularised motion is where the critical set is that the sentence names."""
    assert told.phase.kind == "slide"
    name = fields.get("onto", fields.get("C", "C"))
    assert written_label(told.phase.onto) in name or "C" in name
    if told.phase.onto.startswith("cycle"):
        assert max(told.distance(share) for share in np.linspace(0.5, 1.0, 9)) < 1e3
        return
    t = 0.5 * (told.phase.t_start + told.phase.t_end)
    if told.other.times[-1] < t:  # it went around a cycle for too long: from near C, for a while in the fast time
        z = told.run.dense(t)[2:]
        (C,) = c2.critical_sets(told.system, told.psi, tuple(z))
        beside = c2.simulate(told.system, told.psi, (*(1.01 * EPS * C.x2), *z), (0.0, EPS), eps=EPS)
        assert math.dist(beside.states[-1, :2] / EPS, C.x2) < 1e-2 * np.hypot(*C.x2)
        return
    here = tuple(told.other.dense(t)[2:].tolist())
    nearest = min(c2.critical_sets(told.system, told.psi, here), key=lambda C: math.dist(C.e, told.e(0.5)))
    assert math.dist(nearest.e, told.e(0.5)) < 0.02
    assert nearest.kind.startswith("stable") or told.run.eps > 0.0


def leaves(told, fields):
    """It goes away, in the direction that the sentence names."""
    theta = float(fields["theta"].replace("−", "-"))
    if told.other.times[-1] < told.phase.t_end:  # it went around a cycle for too long: from nearby, it turns there
        z = told.run.dense(0.5 * (told.phase.t_start + told.phase.t_end))[2:]
        start = (50 * EPS * math.cos(theta + 0.3), 50 * EPS * math.sin(theta + 0.3), *z)
        x, y = c2.simulate(told.system, told.psi, start, (0.0, 0.1), eps=EPS).states[-1, :2]
        assert math.cos(math.atan2(y, x) - theta) > 0.99
        return
    x, y = told.state(0.3)[:2]
    assert math.cos(math.atan2(y, x) - theta) > 0.99
    assert told.distance(0.3) > 20.0


def leaves_after(told, fields):
    """As `leaves`, of the phase after the one that is told."""
    k = told.run.phases.index(told.phase)
    if told.phase.kind == "cross":
        told = Told(told.system, told.psi, told.start, told.run, k + 1)
    leaves(told, fields)


def invariant(told, _):
    """Both motions stay in one line through Sigma."""
    x, y = told.other.states[:, :2].T
    if told.start[:2] != (0.0, 0.0):
        assert np.abs(x * told.start[1] - y * told.start[0]).max() < 1e-9 * np.hypot(*told.start[:2])


def set_of(count):
    def check(told, _):
        z = np.array(told.z())
        ahead, behind = (
            len(c2.critical_sets(told.system, told.psi, tuple(z + s * 1e-3 * flow(told)))) for s in (1, -1)
        )
        assert ahead - behind == count

    return check


def flow(told):
    """Return the way in which z goes."""
    t = told.phase.t_start if told.phase else told.run.times[-1]
    return np.sign(told.run.dense(t)[2:] - told.run.dense(max(t - 1e-3, 0.0))[2:])


def hopf(told, _):
    """The trace of J changes its sign as z goes on."""
    z = told.run.dense(told.phase.t_start if told.phase else told.run.times[-1])[2:]
    beside = [tuple(z + s * 1e-3 * max(abs(z[0]), 1.0)) for s in (-1, 1)]
    traces = [c2.critical_sets(told.system, told.psi, at)[0].trace for at in beside]
    assert traces[0] * traces[1] < 0.0


def by_psi(told, _):
    """Two families of Psi let it end differently."""
    z = told.run.dense(told.run.times[-1])[2:] if len(told.run.times) else np.array(told.start[2:])
    start = (*(1e-3 * np.array(told.start[:2]) / max(np.hypot(*told.start[:2]), 1e-9)), *z)
    kinds = [c2.critical_sets(told.system, one, tuple(z))[0].kind for one in (CONSTANT, psi.hill(4), psi.tanh())]
    assert len({kind.split()[0] for kind in kinds}) > 1, start


def many_stable(told, fields):
    stable = [C for C in told.sets() if C.kind.startswith("stable")]
    assert len(stable) == int(fields["count"])


def nothing_attracts(told, _):
    assert not any(C.kind.startswith("stable") for C in told.sets())
    near = [1e-3 * np.array([math.cos(t), math.sin(t)]) for t in (0.2, 1.9, 3.5, 5.1)]
    for start in near:
        run = c2.simulate(told.system, told.psi, (*start, *told.z()), (0.0, 3.0), eps=EPS)
        assert np.hypot(*run.states[-1, :2]) > 1e3 * EPS


def ways_out(told, fields):
    nothing_attracts(told, fields)
    angles = set()
    for t in np.linspace(0.1, 6.2, 24):
        p = 1e-4 * np.array([math.cos(t), math.sin(t)])
        run = c2.simulate(told.system, told.psi, (*p, *told.z()), (0.0, 8.0), eps=EPS)
        angles.add(round(float(np.arctan2(*run.states[-1, 1::-1])) % math.tau, 2) % 6.28)
    assert len(angles) == int(fields.get("count", 1))


def at_phase_of(told, _):
    """Motions with other eps leave at other angles."""
    start = np.array([0.0, 0.0, *told.z()])
    C = told.sets()
    start[:2] = 0.0 if not C or np.hypot(*C[0].p) > 1e-6 else 1e-9
    ends = [
        c2.simulate(told.system, told.psi, start * eps / EPS, (0.0, 20.0), eps=eps).states[-1] for eps in (1e-6, 2e-6)
    ]
    assert not math.cos(math.atan2(*ends[0][1::-1]) - math.atan2(*ends[1][1::-1])) > 0.999


def on_equator(told, _):
    assert not told.sets()
    assert np.abs(c2.equator_equilibria(told.system, told.z()).lambda_rho).min() < 1e-9


def moves(kind):
    def check(told, _):
        assert told.phase.kind == kind
        assert (told.distance(0.5) < 1e3) == (kind == "slide")

    return check


def in_middle(is_set, stable=None):
    def check(told, _):
        sets = [C for C in told.sets() if np.hypot(*C.e) < 1e-6]
        assert bool(sets) == is_set
        if stable is not None:
            assert sets[0].kind.startswith("stable") == stable

    return check


def passes(told, _):
    assert told.phase.kind == "cross"
    assert told.distance(0.5) <= 20.0
    assert np.hypot(*told.run.states[-1, :2]) > 20.0 * told.run.eps or told.run.phases[-1].kind == "slide"


def goes_away(told, _):
    assert told.phase.kind == "slip"
    assert told.distance(0.9) > 20.0


def follows(told, fields):
    assert math.hypot(*told.start[:2]) <= 20.0 * EPS or told.before is not None or told.run.eps > 1e-5
    slides(told, fields)


def ended(reason):
    def check(told, _):
        assert told.run.status.value in told.run.reason
        assert (told.run.times[-1] >= told.asked - 1e-12) == (reason == "end")

    return check


def blow(told, fields):
    """Where it ends the states are beyond all bounds, or the formulas have no value."""
    key = "t"
    when = float(fields[key].replace("−", "-"))
    assert abs(told.run.times[-1] - when) < 1e-3 * max(1.0, when)


def true(*_):
    """What only joins two others."""


#: What holds each sentence; the sentences of the statuses by where the motion ends.
MOTIONS = {
    "starts outside": outside,
    "starts in a line": invariant,
    "arrives in a line": invariant,
    "slides in a line": slides,
    "crosses in a line": leaves_after,
    "leaves": leaves,
    "ends at the equator": leaves,
    "fold in a line": set_of(-2),
    "fold": set_of(-2),
    "Hopf, left": lambda told, _: told.sets()[0].kind.startswith("unstable") or pytest.fail("it is stable"),
    "Hopf, not analytic": hopf,
    "Hopf depends": hopf,
    "cycle shrinks": lambda told, fields: (hopf(told, fields), slides(told, fields)),
    "border moves in": moves("slide"),
    "border moves out": moves("slip"),
    "arrival depends": by_psi,
    "stability depends": by_psi,
    "spiral phase": at_phase_of,
    "middle is stable": in_middle(True, True),
    "middle is a set": in_middle(True, False),
    "middle": in_middle(False),
    "on the equator": on_equator,
    "several to slide on": many_stable,
    "one to slide on": slides,
    "other ways": lambda told, fields: len(c2.equator_equilibria(told.system, told.z())) > 1 or pytest.fail("no way"),
    "cycles to slide on": lambda told, _: (
        any(c.stable for c in c2.limit_cycles(told.system, CONSTANT)) or pytest.fail("no cycle")
    ),
    "one way out": lambda told, fields: (leaves(told, fields), ways_out(told, {"count": 1})),
    "no way out": nothing_attracts,
    "several ways out": ways_out,
    "cycle not seen": lambda told, _: len(c2.limit_cycles(told.system, told.psi, told.z())) == 0 or pytest.fail("seen"),
    "no z to follow": lambda told, _: told.system.m == 0 or pytest.fail("there is z"),
    "starts, follows nothing": goes_away,
    "starts, follows": follows,
    "comes, follows": follows,
    "goes on": follows,
    "passes": passes,
    "has left": goes_away,
    "no longer follows": goes_away,
    "end of span": ended("end"),
    "not unique": ended("stop"),
    "blows up": ended("stop"),
    "step limit": ended("stop"),
    "rests on a repelling set": lambda told, _: (
        told.sets()[0].kind.startswith("unstable") or pytest.fail("it attracts")
    ),
    "onward depends": lambda told, _: told.run.phases[-1].kind == "slide" or pytest.fail("it has not slid"),
    "blow-up time": blow,
    "undefined from": blow,
}
