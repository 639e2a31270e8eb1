"""What is said of a motion, phase by phase, is what the other description of it does there.

Of the limit ε → 0 the regularised motion with a small ε is asked, of one with ε > 0 its own states: where it is, in
which direction it left, how far away it stays.
"""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, examples, psi
from codim2_core.words import ROOMS, named, recognise

EPS = 1e-6
CONSTANT, HILL = psi.constant(), psi.hill(3)
CASE_3 = ELinear(172.0, 186.0, -200.0, ("-172*z", "-186*z"), B=((0.5, 0.0),))  # C at e = (z, 0), z' = e_1/2
TYPED_3 = System(U=("172*c - 186*s - 172*z", "186*c - 200*s - 186*z"), W=("c/2",))
ARRIVING = (8.5e-4, 5.2e-4)
TWO_NODES = System(U=("-c*(c - 1/2)*(c + 1/2)", "-s"))
SUBCRITICAL = System(U=("z*c - s + c*(c**2 + s**2)", "c + z*s + s*(c**2 + s**2)"), W=("1",))
CYCLE = System(U=("c - s - 2*c*(c**2 + s**2)", "c + s - 2*s*(c**2 + s**2)"))


class Told:
    """One motion, one of its phases, and what holds it."""

    def __init__(self, system, family, start, run, k):
        self.system, self.psi, self.start, self.run = system, family or CONSTANT, start, run
        self.phase = run.phases[k] if k < len(run.phases) else None
        self.before = run.phases[k - 1] if k else None
        end = run.times[-1]
        self.other = c2.simulate(system, self.psi, EPS, start, (0.0, end)) if run.eps == 0.0 and end > 0.0 else run

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
    assert named(told.phase.onto) in name or "C" in name
    if told.phase.onto.startswith("cycle"):
        assert max(told.distance(share) for share in np.linspace(0.5, 1.0, 9)) < 1e3
        return
    t = 0.5 * (told.phase.t_start + told.phase.t_end)
    if told.other.times[-1] < t:  # it went around a cycle for too long: from beside C, for a while in the fast time
        z = told.run.dense(t)[2:]
        (C,) = c2.critical_sets(told.system, told.psi, tuple(z))
        beside = c2.simulate(told.system, told.psi, EPS, (*(1.01 * EPS * C.x2), *z), (0.0, EPS))
        assert math.dist(beside.states[-1, :2] / EPS, C.x2) < 1e-2 * np.hypot(*C.x2)
        return
    here = tuple(told.other.dense(t)[2:].tolist())
    nearest = min(c2.critical_sets(told.system, told.psi, here), key=lambda C: math.dist(C.e, told.e(0.5)))
    assert math.dist(nearest.e, told.e(0.5)) < 0.02
    assert nearest.kind.startswith("stable") or told.run.eps > 0.0


def leaves(told, fields):
    """It goes away, in the direction that the sentence names."""
    theta = float(fields["theta"].replace("−", "-"))
    if told.other.times[-1] < told.phase.t_end:  # it went around a cycle for too long: from beside, it turns there
        z = told.run.dense(0.5 * (told.phase.t_start + told.phase.t_end))[2:]
        start = (50 * EPS * math.cos(theta + 0.3), 50 * EPS * math.sin(theta + 0.3), *z)
        x, y = c2.simulate(told.system, told.psi, EPS, start, (0.0, 0.1)).states[-1, :2]
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
        run = c2.simulate(told.system, told.psi, EPS, (*start, *told.z()), (0.0, 3.0))
        assert np.hypot(*run.states[-1, :2]) > 1e3 * EPS


def ways_out(told, fields):
    nothing_attracts(told, fields)
    angles = set()
    for t in np.linspace(0.1, 6.2, 24):
        p = 1e-4 * np.array([math.cos(t), math.sin(t)])
        run = c2.simulate(told.system, told.psi, EPS, (*p, *told.z()), (0.0, 8.0))
        angles.add(round(float(np.arctan2(*run.states[-1, 1::-1])) % math.tau, 2) % 6.28)
    assert len(angles) == int(fields.get("count", 1))


def at_phase_of(told, _):
    """Motions with other eps leave at other angles."""
    start = np.array([0.0, 0.0, *told.z()])
    C = told.sets()
    start[:2] = 0.0 if not C or np.hypot(*C[0].p) > 1e-6 else 1e-9
    ends = [c2.simulate(told.system, told.psi, eps, start * eps / EPS, (0.0, 20.0)).states[-1] for eps in (1e-6, 2e-6)]
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
    "Hopf, cycle": lambda told, fields: (hopf(told, fields), moves("slide")(told, fields)),
    "Hopf, delayed": hopf,
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
    "Hopf, nothing takes over": hopf,
    "for the constant": lambda told, _: told.psi is CONSTANT or pytest.fail("a family was given"),
    "blow-up time": blow,
    "undefined from": blow,
}
AGREEMENT, FIRST_STEPS = "tests/core/motion/test_agreement.py", "tests/core/motion/test_nonsmooth.py"
CYCLES_END = "tests/core/motion/test_slide_slip.py"
#: Held by tests of their own: what `leave` and `agreement` return, and how a cycle of a typed system ends.
ELSEWHERE = {
    "repels angularly": FIRST_STEPS,
    "nothing leaves": FIRST_STEPS,
    "phases agree": AGREEMENT,
    "phases agree, less": AGREEMENT,
    "phases differ": AGREEMENT,
    "at an event": "tests/core/initial_value/test_events.py",
    "cycle ends": CYCLES_END,
    "cycle ends at once": CYCLES_END,
    "cycle ends, not found": CYCLES_END,
    "cycle ends, not decided": CYCLES_END,
    "saddle reached": CYCLES_END,
}
CASES = {
    "focus": (ELinear(-1, 0.5, -1, (0.1, 0)), None, (1, 0.2), 3),
    "in a line": (ELinear(-1, 0, -1.5, (0.3, 0)), CONSTANT, (0.5, 0), 1),
    "across in a line": (ELinear(-1, 0, -1.5, (1.3, 0)), CONSTANT, (-0.5, 0), 3),
    "from a saddle": (ELinear(1, 0, -1.5), CONSTANT, (0, 0), 1),
    "fold in a line": (System(U=("z - c**2", "-s"), W=("-1",)), CONSTANT, (0.3, 0, 0.5), 3),
    "fold": (System(U=("z - c**2", "-s + 0.1*c"), W=("-1",)), CONSTANT, (0.3, 0.1, 0.5), 3),
    "ball": (examples.ball_in_pool(K=2.0), CONSTANT, (-1, 0.3, 10, 0), 2.5),
    "block": (examples.tilting_block(), CONSTANT, (0.3, 0.1, 0.1), 5),
    "Case III": (CASE_3, HILL, (*ARRIVING, 0.3), 2.6),
    "Case III, no psi": (CASE_3, None, (0.1, 0, 0.5), 5),
    "Case III, no psi, on Sigma": (CASE_3, None, (0, 0, 0.5), 5),
    "Case III, typed": (TYPED_3, HILL, (*ARRIVING, 0.3), 1),
    "three sets": (examples.nonunique_sliding(), None, (0, 0, 0.1), 5),
    "all directions away": (ELinear(1, 0, 1), None, (0, 0), 5),
    "spirals away, no psi": (ELinear(1, 3, 1), None, (0, 0), 5),
    "spirals away": (ELinear(1, 3, 1, (0.2, 0)), CONSTANT, (0, 0), 5),
    "two nodes": (TWO_NODES, None, (0, 0), 1),
    "cycle": (CYCLE, CONSTANT, (0, 0), 1),
    "cycle, no psi": (CYCLE, None, (0, 0), 1),
    "one way out": (ELinear(-1, 0, -2, (3, 0)), None, (0, 0), 1),
    "saddle": (ELinear(1, 0, -1), None, (0, 0), 1),
    "node and way out": (System(U=("c**2 - 1/8", "-2*s")), None, (0, 0), 1),
    "moves out": (ELinear(-1, 0, -1, ("z", 0.0), g=(1,)), CONSTANT, (0, 0, 1), 1),
    "moves in": (ELinear(-1, 0, -1, ("z", 0.0), g=(-1,)), CONSTANT, (0, 0, 1), 1),
    "off the equator": (ELinear(-1, 0.2, -1.2, ("z", 0.1), g=(1,)), CONSTANT, (0, 0, 0.5), 0.8),
    "stable middle": (ELinear(-1, 0, -2), CONSTANT, (0, 0), 1),
    "beside the middle": (ELinear(-1, 0, -2, (0.3, 0.2)), CONSTANT, (0, 0), 1),
    "no psi": (ELinear(-1, 0, -2, (0.3, 0.2)), None, (0, 0), 1),
    "blows up": (System(U=("x**2", "-s")), CONSTANT, (1, 0.1), 5),
    "undefined": (System(U=("-c", "-s"), W=("1/sqrt(2 - z)",)), CONSTANT, (1, 0.1, 0), 50),
    "starts in a line": (ELinear(-1, 0, -1, (0.2, 0.1)), CONSTANT, (0, 0), 1),
    "rests": (System(U=("c", "s + c")), CONSTANT, (0, 0), 1),
    "fold, no psi": (System(U=("z - c**2", "-s + 0.1*c"), W=("-1",)), None, (0.3, 0.1, 0.5), 3),
    "subcritical Hopf": (SUBCRITICAL, None, (0, 0, -0.5), 2),
    "crosses": (examples.attracting_repelling(), CONSTANT, (0.2, 0.25, 0.5), 2),
}
SEEN = set()


def hold(system, family, start, run, asked):
    texts = [phase.reason for phase in run.phases] + [run.reason]
    for k, text in enumerate(texts):
        told = Told(system, family, start, run, k)
        told.asked = asked
        for key, fields in recognise(text):
            if key in ROOMS["motion"]:
                SEEN.add(key)
                MOTIONS[key](told, fields)


@pytest.mark.parametrize("name", CASES)
def test_of_the_limit(name):
    system, family, start, t = CASES[name]
    run = c2.simulate_nonsmooth(system, start, (0.0, t), family)
    hold(system, family, tuple(map(float, start)), run, t)


@pytest.mark.parametrize("name", ["across in a line", "fold", "ball", "one way out", "off the equator", "blows up"])
def test_of_the_regularised_motion(name):
    system, family, start, t = CASES[name]
    run = c2.simulate(system, family or CONSTANT, 1e-5, start, (0.0, t))
    hold(system, family, tuple(map(float, start)), run, t)


@pytest.mark.parametrize("name", c2.presets)
def test_of_every_portrait(name):
    preset = c2.presets[name]
    angle = float(len(name))
    start = (0.05 * math.cos(angle), 0.05 * math.sin(angle), *(preset.z or (0.0,) * preset.system.m))
    run = c2.simulate_nonsmooth(preset.system, start, (0.0, 0.2), preset.psi)
    hold(preset.system, preset.psi, start, run, 0.2)


def test_every_sentence_of_a_motion_is_held():
    assert MOTIONS.keys() | ELSEWHERE.keys() == ROOMS["motion"].keys()
