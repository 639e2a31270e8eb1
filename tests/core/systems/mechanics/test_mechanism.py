"""A mechanism's system, against its equations of motion solved as numbers, and against published motions."""

import math
import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core import ELinear, System, examples, psi
from codim2_core.systems.mechanics import Mechanism, contact, contacts

from ....words.recognition import recognise

number = st.floats(-2.0, 2.0).map(lambda v: round(v, 3))


def values(system, e, xy, z):
    """Return U and W as numbers."""
    if isinstance(system, ELinear):
        at = system.at(z)
        return np.concatenate([at.U(e), at.B @ e + at.g])
    known = {**dict(system.parameters), "c": e[0], "s": e[1], "x": xy[0], "y": xy[1]}
    known.update((f"z{i}", v) for i, v in enumerate(z, 1))
    return np.array([float(row.evaluate(known)) for row in (*system.U, *system.W)])


@st.composite
def mechanisms(draw):
    """A mechanism in a position q and n velocities, with the same as functions of numbers."""
    n, held = draw(st.integers(3, 5)), draw(st.booleans())
    rows = 3 if held else 2
    array = lambda *shape: np.array(draw(st.lists(number, min_size=(k := math.prod(shape)), max_size=k))).reshape(shape)
    L = np.tril(array(n, n), -1) + np.diag(1.0 + np.abs(array(n)))
    M = L @ L.T
    J0, J1 = array(rows, n), array(rows, n)
    J0[:, :rows] += 6.0 * np.eye(rows)
    Q0, Q1, w, drift = array(n), array(n), array(2, 2), array(n)
    mu, N = 0.1 * (np.eye(2) + 0.3 * array(2, 2)), 1.0 + abs(draw(number))
    names = tuple(f"v{i}" for i in range(n))
    text = lambda a, b: f"({a!r}) + ({b!r})*sin(q)"
    J = [[text(float(a), float(b)) for a, b in zip(p, q, strict=True)] for p, q in zip(J0, J1, strict=True)]
    parts = {
        "M": M, "J": J[:2], "mu": mu.tolist(), "velocities": names, "slow": ("q", *names[rows:]),
        "normal": J[2] if held else "N*(1 + q**2)", "parameters": {"N": N},
        "force": [f"({float(a)!r}) + ({float(b)!r})*v0*cos(q)" for a, b in zip(Q0, Q1, strict=True)],
        "rates": {"q": " + ".join(f"({float(d)!r})*{v}" for d, v in zip(drift, names, strict=True))},
        "surface": [f"({float(a)!r})*q + ({float(b)!r})*q**2" for a, b in w],
    }  # fmt: skip

    def rates(e, xy, z):
        """Return (x, y, z)' by the equations of motion, solved as numbers."""
        q, kept = z[0], z[1:]
        Jq, dJ = J0 + J1 * math.sin(q), J1 * math.cos(q)
        slip = np.array([*(xy + w @ [q, q**2]), 0.0])[:rows]
        v = np.concatenate([np.linalg.solve(Jq[:, :rows], slip - Jq[:, rows:] @ kept), kept])
        Q, friction, dq = Q0 + Q1 * v[0] * math.cos(q), -Jq[:2].T @ mu @ e, drift @ v
        if held:
            matrix = np.block([[M, -(Jq[2] + friction)[:, None]], [Jq[2:], np.zeros((1, 1))]])
            acceleration = np.linalg.solve(matrix, np.append(Q, -(dJ[2] @ v) * dq))[:-1]
        else:
            acceleration = np.linalg.solve(M, Q + N * (1.0 + q**2) * friction)
        return np.array([*(Jq[:2] @ acceleration + (dJ[:2] @ v - w @ [1.0, 2.0 * q]) * dq), dq, *acceleration[rows:]])

    return Mechanism(**parts), rates


@settings(max_examples=20)
@given(mechanisms(), st.floats(0.0, 6.3), st.tuples(number, number), st.lists(number, min_size=6, max_size=6))
def test_a_mechanism_moves_by_its_equations_of_motion(pair, theta, xy, some):
    mechanism, rates = pair
    z, e = np.array(some[: len(mechanism.slow)]), np.array([math.cos(theta), math.sin(theta)])
    expected = rates(e, np.array(xy), z)
    assert values(mechanism.system, e, xy, tuple(z)) == pytest.approx(expected, rel=1e-8, abs=1e-8)


@settings(max_examples=20)
@given(
    st.floats(0.05, 1.0), st.floats(-8.0, 8.0), st.floats(0.01, 2.0), st.tuples(number, number, number, number)
)  # fmt: skip
def test_a_ball_on_a_turntable_is_the_example(mu, Omega, r, z):
    ball = contact(
        M=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, "2/5*r**2", 0), (0, 0, 0, "2/5*r**2")),
        J=((1, 0, 0, "-r"), (0, 1, "r", 0)), force=(0, 0, 0, 0), mu="mu", normal="g",
        velocities=("v1", "v2", "w1", "w2"), slow=("v1", "v2", "r1", "r2"), rates={"r1": "v1", "r2": "v2"},
        surface=("-Omega*r2", "Omega*r1"), parameters={"mu": mu, "g": 9.81, "r": r, "Omega": Omega},
    )  # fmt: skip
    assert isinstance(ball, ELinear)
    at, known = ball.at(z), examples.ball_on_turntable(mu, Omega).at(z)
    for name in ("a", "b", "d", "f", "B", "g"):
        mine, paper = np.asarray(getattr(at, name)), np.asarray(getattr(known, name))
        assert mine == pytest.approx(paper, rel=1e-14, abs=1e-14)


def block(force, law: Any = "mu", normal="m*g", **parameters):
    """A block on the ground."""
    return Mechanism(
        M=(("m", 0), (0, "m")), J=((1, 0), (0, 1)), force=force, mu=law, normal=normal, velocities=("vx", "vy"),
        parameters={"m": 2.0, "g": 10.0, "mu": 0.5, **parameters},
    )  # fmt: skip


@settings(max_examples=20)
@given(st.tuples(number, number), st.floats(0.05, 2.0), st.floats(0.05, 2.0), number)
def test_it_grips_where_a_critical_set_is_inside(f, mu1, mu2, shear):
    """The grip is a linear equation for the friction; the critical set is found by the core."""
    mechanism = block((3.0 * f[0], 3.0 * f[1]), law=((mu1, shear / 9.0), (0.0, mu2)), g=1.0)
    grip, found = mechanism.grip(), c2.critical_sets(mechanism.system, psi.rational())
    if abs(grip.share - 1.0) > 1e-9:
        assert grip.sticks == bool(found)
    for one in found:
        assert one.e == pytest.approx(grip.e, abs=1e-9)


@pytest.mark.parametrize(("pull", "key"), [(9.0, "grips"), (11.0, "grip lost")])
def test_a_block_is_told_as_an_engineer_would(pull, key):
    """It weighs 20 N, mu 0.5: it cannot start to slip while |F| < 10 N."""
    grip = block(("F*cos(0.7)", "F*sin(0.7)"), F=pull).grip()
    assert grip.needed == pytest.approx([-pull * math.cos(0.7), -pull * math.sin(0.7)])
    assert np.hypot(*grip.edge(12).T) == pytest.approx(10.0)
    assert [found for found, _ in recognise(grip.sentence)] == [key]
    assert f"a friction of {pull:g}, and " in grip.sentence
    assert grip.sentence.endswith("10 is available in that direction.")


@pytest.mark.parametrize("seed", range(40))
def test_a_block_that_is_pulled_as_hard_as_friction_can_hold_holds(seed):
    """In every direction, with a matrix of friction too: a part in 10^12 more is lost, a part less is not the limit."""
    rng = np.random.default_rng(seed)
    angle, law = rng.uniform(0.0, math.tau), rng.uniform(0.1, 1.0, 2)
    law = np.diag(law if seed % 2 else law[[0, 0]])
    pull = 20.0 * law @ (math.cos(angle), math.sin(angle))
    at = lambda share: block((share * pull).tolist(), law=law.tolist()).grip()
    assert [at(share).sticks for share in (1.0, 1.0 + 1e-12, 1.0 - 1e-12)] == [True, False, True]
    said = [[key for key, _ in recognise(at(share).sentence)] for share in (1.0, 1.0 - 1e-12)]
    assert said == [["grips just"], ["can grip" if seed % 2 else "grips"]]


def test_the_block_of_four_newton_holds_in_every_function():
    whole = Mechanism(np.eye(2), np.eye(2), (4, 0), 0.4, 10, ("vx", "vy"))
    assert whole.grip().sentence == (
        "It just holds: sticking needs a friction of 4, and no more is available in that direction."
    )
    both = contacts(np.eye(2), [(np.eye(2), 0.4, 10)], (4, 0), ("vx", "vy"))
    assert both.decide((0, 0)).kinds == ("stick",)
    assert [phase.kinds for phase in both.simulate_nonsmooth((0, 0), (0, 9)).phases] == [("stick",)]
    assert [phase.kind for phase in c2.simulate_nonsmooth(whole.system, (0, 0), (0, 9)).phases] == ["slide"]


def test_a_block_that_is_pulled_up_comes_off():
    grip = block((1.0, 0.0), normal="m*g - 25").grip()
    assert not grip.sticks
    assert grip.sentence == "The contact opens: sticking would need a normal force of −5."


def test_a_cone_and_not_a_pyramid():
    """SimBenchmark's rolling test: a box of 10 kg, 25 balls of 1 kg rolling on it, 150 N along the diagonal, mu 0.4.

    The balls roll on the box, so each has 2/7 of its acceleration. An engine with a pyramid, sqrt 2 too strong along
    the diagonal, does not move at all.
    """
    side = 150.0 / math.sqrt(2.0)
    box = Mechanism(
        M=(("10 + 2/7*25", 0), (0, "10 + 2/7*25")), J=((1, 0), (0, 1)), force=(side, side), mu=0.4,
        normal="(10 + 25)*9.81", velocities=("vx", "vy"),
    )  # fmt: skip
    assert not box.grip().sticks
    run = c2.simulate_nonsmooth(box.system, (0.0, 0.0), (0.0, 1.0))
    speed = float(np.hypot(*run.dense(1.0)[:2]))
    assert (speed, 2.0 / 7.0 * speed) == pytest.approx((0.7385, 0.2110), abs=6e-5)
    pyramid = block((side, side), law="sqrt(2)*mu", normal="35*g", mu=0.4, g=9.81)
    assert pyramid.grip().sticks


def test_friction_may_change_the_normal_force():
    """A contact whose slip turns with the motion that a constraint forbids: N = 1/(1 - h mu c)."""
    rod = Mechanism(
        M=np.eye(3), J=((1, 0, "h"), (0, 1, 0)), force=(0.3, 0.0, -1.0), mu=0.4, normal=(0, 0, 1),
        velocities=("v1", "v2", "v3"), parameters={"h": 0.5},
    )  # fmt: skip
    assert isinstance(rod.system, System)
    for theta in (0.0, 1.0, 2.5):
        e = np.array([math.cos(theta), math.sin(theta)])
        N = 1.0 / (1.0 - 0.4 * 0.5 * e[0])  # v3' = 0 = -1 + N - h N mu c
        assert values(rod.system, e, (0, 0), ()) == pytest.approx(np.array([0.3, 0.0]) - 0.4 * N * e, abs=1e-12)
    assert rod.grip().normal == pytest.approx(1.0 + 0.5 * 0.3)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"velocities": ("v",)}, "there are 1 velocities; name from 2 to 12."),
        ({"velocities": ("c", "v")}, "velocities has the name 'c'"),
        ({"velocities": ("v", "v")}, "velocities names 'v' twice"),
        ({"M": ((1, 2), (2, 1))}, "M is not positive definite"),
        ({"M": ((1, 2), (0, 1))}, "M is not symmetric"),
        ({"M": ((1, 0),)}, "give 2 rows of 2 entries"),
        ({"J": ((1, 0), (2, 0))}, "the slip does not determine vx and vy"),
        ({"force": ("q", 0)}, "the name 'q' is not known here"),
        ({"slow": ("vx",)}, "1 of the 2 velocities are no slow variables (vy)"),
        ({"slow": ("q",)}, "the slow variable q is no velocity; say how it moves"),
        ({"rates": {"q": "vx"}}, "rates has 'q', which is no slow variable"),
        ({"parameters": {"vx": 1.0}}, "the parameter vx has the name of a velocity"),
        ({"normal": None}, "normal is None; give a number, or text in"),
        ({"mu": ((1, 0), (0,))}, "mu[2] is (0,); give 2 entries"),
    ],
)
def test_what_is_wrong_is_said(change, said):
    parts = dict(M=np.eye(2), J=np.eye(2), force=(0, 0), mu=0.3, normal=1, velocities=("vx", "vy"))
    with pytest.raises(ValueError, match=re.escape(said)):
        Mechanism(**{**parts, **change})


def test_a_grip_that_depends_on_e_is_refused():
    with pytest.raises(ValueError, match="depends on e"):
        block(("0.1*c", 0.0)).grip()
