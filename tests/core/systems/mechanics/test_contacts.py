"""Several contacts: against one contact, closed forms, quadratures, the limit eps -> 0, and another convex solver."""

import itertools
import math
import pickle
import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import codim2_core as c2
from codim2_core import psi
from codim2_core.systems.mechanics import contact, contacts

from ....words.recognition import recognise
from .plates import INERTIA, MASS, MU, Driven, foot, plate, shaken_plate

EYE = ((1, 0), (0, 1))
RADIUS, G = 0.7, 9.81
DRIVEN = ("F*cos(2*t) + 0.3*v", "1")


def three_feet():
    """Return a plate on three feet of equal load."""
    angles = 0.3 + np.arange(3) * math.tau / 3.0
    load = MASS * G / 3.0
    return plate([foot(RADIUS * math.cos(a), RADIUS * math.sin(a), load) for a in angles.tolist()])


def two_blocks():
    """Return two blocks joined by a spring, of which one is pulled."""
    rows = ((1, 0, 0, 0), (0, 1, 0, 0)), ((0, 0, 1, 0), (0, 0, 0, 1))
    return contacts(
        np.eye(4).tolist(), [(row, 0.3, 10) for row in rows], ("4*stretch", 0, "5 - 4*stretch", 0),
        ("u1", "v1", "u2", "v2"), {"stretch": "u2 - u1"},
    )  # fmt: skip


def kinds(motion):
    return [phase.kinds for phase in motion.phases]


def test_one_contact_is_the_system_of_a_contact():
    own = ((1, 0), (0, 1.5)), ((1, 0.2), (0, 1))
    one = contacts(own[0], [(own[1], 0.3, 9.81)], DRIVEN, ("u", "v"), {"t": "1"}, {"F": 4.0})
    system = contact(*own, DRIVEN, 0.3, 9.81, ("u", "v"), ("t",), {"t": "1"}, parameters={"F": 4.0})
    assert one.at(0) == system
    run = one.simulate_nonsmooth((1.0, 0.5, 0.0), (0.0, 6.0))
    reference = c2.simulate_nonsmooth(system, one.mechanisms[0].state(u=1.0, v=0.5, t=0.0), (0.0, 6.0))
    assert kinds(run) == [("stick" if phase.kind == "slide" else "slip",) for phase in reference.phases]
    assert [phase.t_end for phase in run.phases] == pytest.approx([p.t_end for p in reference.phases], rel=1e-8)
    times = np.linspace(0.0, 6.0, 40)
    expected = one.mechanisms[0].named(reference.dense(times))
    assert run.dense(times)[:, 0] == pytest.approx(expected["u"], abs=1e-7)
    assert run.dense(times)[:, 1] == pytest.approx(expected["v"], abs=1e-7)


def test_contacts_that_do_not_couple_move_as_if_alone():
    force = ("2.5*cos(2*t) + 0.5", "sin(3*t)"), ("1 + 3*sin(t)", "0.3*u2")
    alone = [
        contacts(((m, 0), (0, m)), [(EYE, mu, 10)], row, (f"u{i}", f"v{i}"), {"t": 1})
        for i, (m, mu, row) in enumerate(zip((1, 2), (0.2, 0.35), force, strict=True), 1)
    ]
    rows = ((1, 0, 0, 0), (0, 1, 0, 0)), ((0, 0, 1, 0), (0, 0, 0, 1))
    both = contacts(
        np.diag([1, 1, 2, 2]).tolist(), [(rows[0], 0.2, 10), (rows[1], 0.35, 10)], (*force[0], *force[1]),
        ("u1", "v1", "u2", "v2"), {"t": 1},
    )  # fmt: skip
    start, times = (0.4, 0.1, -0.3, 0.5, 0.0), np.linspace(0.0, 5.0, 60)
    run = both.simulate_nonsmooth(start, (0.0, 5.0))
    single = [one.simulate_nonsmooth((*start[2 * i : 2 * i + 2], 0.0), (0.0, 5.0)) for i, one in enumerate(alone)]
    assert len({phase.kinds for phase in run.phases}) >= 3
    for i, one in enumerate(single):
        assert run.dense(times)[:, 2 * i : 2 * i + 2] == pytest.approx(one.dense(times)[:, :2], abs=1e-7)


def test_a_plate_that_translates_is_a_point_mass_and_one_that_spins_stops_as_its_radius_says():
    whole = three_feet()
    run = whole.simulate_nonsmooth((0.6, 0.8, 0.0), (0.0, 1.0))
    assert kinds(run) == [("slip",) * 3, ("stick",) * 3]
    assert run.phases[0].t_end == pytest.approx(1.0 / (MU * G), rel=1e-9)
    assert run.dense(0.1) == pytest.approx(np.array([0.6, 0.8, 0.0]) * (1.0 - 0.1 * MU * G), abs=1e-9)
    spun = whole.simulate_nonsmooth((0.0, 0.0, 3.0), (0.0, 1.0))
    assert spun.phases[0].t_end == pytest.approx(3.0 * INERTIA / (MU * MASS * G * RADIUS), rel=1e-9)


def test_spin_and_slip_end_together_as_an_independent_quadrature_says():
    whole, start = three_feet(), (1.0, 0.2, 2.0)
    run = whole.simulate_nonsmooth(start, (0.0, 2.0))
    angles = 0.3 + np.arange(3) * math.tau / 3.0
    place = RADIUS * np.stack([np.cos(angles), np.sin(angles)])

    def rate(_t, state):
        u, v, w = state
        slip = np.array([u - w * place[1], v + w * place[0]])
        pull = -MU * MASS * G / 3.0 * slip / np.hypot(*slip)
        turning = (place[0] * pull[1] - place[1] * pull[0]).sum() / INERTIA
        return [w * v + pull[0].sum() / MASS, -w * u + pull[1].sum() / MASS, turning]

    def stop(_t, state):
        return np.abs(state).max() - 1e-6

    stop.terminal = True  # pyright: ignore[reportFunctionMemberAccess] (as SciPy wants it)
    own = solve_ivp(rate, (0.0, 2.0), start, "DOP853", rtol=1e-11, atol=1e-14, events=stop, dense_output=True)
    last = own.y[:, -1]
    left = np.abs(last).max() / np.abs(rate(0.0, last)).max()
    assert run.phases[0].t_end == pytest.approx(own.t[-1] + left, abs=1e-8)
    times = np.linspace(0.0, 0.95 * own.t[-1], 30)
    assert run.dense(times) == pytest.approx(own.sol(times).T, abs=1e-8)


def test_the_regularised_motion_comes_to_the_limit_like_eps():
    """While the first block waits, it creeps by eps x2, e up to 0.82; the other slips."""
    system, start, times = two_blocks(), (0.0, 0.0, 0.0, 0.0, 0.0), np.linspace(0.0, 0.9, 60)
    limit = system.simulate_nonsmooth(start, (0.0, 0.9)).dense(times)
    runs = [system.simulate(psi.constant(), start, (0.0, 0.9), eps=eps) for eps in (1e-3, 1e-4, 1e-5)]
    errors = [np.abs(run.dense(times) - limit).max() for run in runs]
    assert errors[0] / errors[1] == pytest.approx(10.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(10.0, rel=0.1)


def test_after_a_departure_the_regularised_motion_is_ahead_like_eps_to_four_fifths():
    """The force passes its bound r as 1 + alpha t; there 1 - |e_Psi| = (eps/x)^2/2 for Psi = 1.

    So the slip follows ``x' = r (alpha t + (eps/x)^2/2)``, in the limit ``r alpha t``. With x = A X, t = B T,
    A = r alpha B^2 and B^5 = eps^2/(r^2 alpha^3) this is X' = T + 1/(2 X^2) without eps: X - T^2/2 comes to a number,
    and A is of the order eps^(4/5): neither eps nor eps log(1/eps).
    """
    system, start, r, alpha = two_blocks(), (0.0,) * 5, 3.0, 4.0 / 3.0 * math.sin(2.0 * math.pi / 3.0)
    inner = solve_ivp(lambda T, X: T + 0.5 / X**2, (-30.0, 30.0), [1.0 / math.sqrt(60.0)], "Radau", rtol=1e-10)
    ahead, t, errors = inner.y[0, -1] - 450.0, math.pi / 3.0 + 0.03, []
    limit = system.simulate_nonsmooth(start, (0.0, t), rtol=1e-11).states[-1, 0]
    for eps in (1e-6, 1e-7, 1e-8):  # 1 % of the last is 7e-9
        own = system.simulate(psi.constant(), start, (0.0, t), eps=eps, rtol=1e-11).states[-1, 0]
        errors.append(own - limit)
        B = (eps**2 / (r**2 * alpha**3)) ** 0.2
        assert errors[-1] == pytest.approx(ahead * r * alpha * B**2, rel=0.01)
    assert np.diff(np.log10(errors)) == pytest.approx([-0.8, -0.8], abs=0.02)


def test_a_motion_that_takes_too_many_steps_says_when_it_stopped():
    run = two_blocks().simulate_nonsmooth((0.0,) * 5, (0.0, 3.0), max_steps=7)
    assert run.status.name == "STEP_LIMIT"
    said = dict(recognise(run.reason))
    assert float(said["last time"]["t"]) == pytest.approx(run.times[-1], rel=1e-5)


def gauss_seidel(M, Q, J, k, r, rounds=4000):
    """Return v' by projected block Gauss-Seidel on the forces that hold (c, 2): as engines solve it."""
    back = np.array([np.linalg.solve(M, one.T) for one in J])
    force = np.zeros_like(k)
    u = np.linalg.solve(M, Q)
    for _ in range(rounds):
        for i in range(len(J)):
            rate = np.linalg.norm(J[i] @ back[i], 2)
            new = force[i] + (J[i] @ u + k[i]) / rate
            size = np.hypot(*new)
            new = new if size <= r[i] else new * r[i] / size
            u = u - back[i] @ (new - force[i])
            force[i] = new
    return u


def random_case(seed):
    """Return M, J, Q, r of a mechanism at rest, and what its contacts do."""
    rng = np.random.default_rng(seed)
    n, count = int(rng.integers(2, 6)), int(rng.integers(1, 4))
    L = rng.normal(size=(n, n))
    M, J = L @ L.T + 0.5 * np.eye(n), rng.normal(size=(count, 2, n))
    Q, r = rng.normal(size=n) * rng.uniform(0.1, 4.0), rng.uniform(0.2, 2.0, count)
    parts = [(rows.tolist(), 0.5, 2.0 * b) for rows, b in zip(J, r.tolist(), strict=True)]
    own = contacts(M.tolist(), parts, Q.tolist(), [f"v{i}" for i in range(n)])
    return M, J, Q, r, own.decide(np.zeros(n))


@pytest.mark.parametrize("seed", range(16))
def test_which_contacts_stick_is_what_another_solver_finds(seed):
    M, J, Q, r, found = random_case(seed)
    assert found.acceleration == pytest.approx(gauss_seidel(M, Q, J, np.zeros((len(J), 2)), r), abs=1e-6)
    assert Q - M @ found.acceleration == pytest.approx(np.einsum("cin,ci->n", J, r[:, None] * found.e), abs=1e-9)
    for kind, e, rate in zip(found.kinds, found.e, found.rates, strict=True):
        assert np.hypot(*e) < 1.0 if kind == "stick" else e == pytest.approx(rate / np.hypot(*rate))


def test_the_pulled_block_slips_until_the_spring_pulls_the_other_along():
    """x'' = 2 - 4 x from rest: the spring pulls with 4 x = 3, all that holds the first, at cos 2t = -1/2."""
    run = two_blocks().simulate_nonsmooth((0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 6.0))
    assert kinds(run) == [("stick", "slip"), ("slip", "slip"), ("slip", "stick"), ("stick", "stick")]
    assert run.phases[1].t_start == pytest.approx(math.pi / 3.0, abs=1e-9)
    assert run.dense(1.0) == pytest.approx([0.0, 0.0, math.sin(2.0), 0.0, 0.5 * (1.0 - math.cos(2.0))], abs=1e-9)


def test_a_plate_turns_about_its_heavy_foot():
    """A torque at rest: with the light foot at distance 2 it turns about the heavy one, if that holds the pull."""
    light, heavy, torque = 2.0, 40.0, 3.0
    whole = plate([foot(0.0, 0.0, heavy), foot(2.0, 0.0, light)], (0, 0, torque))
    found = whole.decide((0.0, 0.0, 0.0))
    assert found.kinds == ("stick", "slip")
    assert found.acceleration == pytest.approx([0.0, 0.0, (torque - 2.0 * MU * light) / INERTIA])
    assert found.e[0] == pytest.approx([0.0, -light / heavy])  # it holds what the light foot pushes sideways


def test_redundant_contacts_have_one_acceleration_and_forces_by_psi():
    still = three_feet().decide((0.0, 0.0, 0.0))
    assert still.kinds == ("stick",) * 3
    assert not still.unique_e
    assert still.acceleration == pytest.approx(np.zeros(3), abs=1e-12)
    assert "redundant" in still.sentence
    pulled = plate([foot(-1.0, 0.0, 5.0), foot(1.0, 0.0, 8.0)], (1.2, 0.0, 0.0))
    found, shares = pulled.decide((0.0, 0.0, 0.0)), []
    for family in (psi.constant(), psi.tanh()):
        last = pulled.simulate(family, (0.0, 0.0, 0.0), (0.0, 1.0), eps=1e-4).states[-1]
        zeta = np.hypot(*pulled.slips(last).T) / 1e-4
        shares.append(family.modulus(zeta))
    assert found.e[:, 0] == pytest.approx(shares[0], abs=1e-4)
    assert MU * np.array([5.0, 8.0]) @ found.e[:, 0] == pytest.approx(1.2)


def test_a_system_at_one_contact_has_the_friction_of_the_others():
    """Contact 1 is at its set, the other slips with (2, 1), the spring is stretched by 0.2."""
    system = two_blocks()
    z = {"u2": 2.0, "v2": 1.0, "stretch": 0.2}
    names = system.mechanisms[0].slow
    frozen = system.at(0).at(tuple(z[name] for name in names))
    assert frozen.U((0.6, 0.8)) == pytest.approx([0.8 - 3.0 * 0.6, -3.0 * 0.8])
    W = dict(zip(names, frozen.W((0.6, 0.8)), strict=True))
    pull = 3.0 / math.sqrt(5.0)
    assert pytest.approx({"u2": 4.2 - 2.0 * pull, "v2": -pull, "stretch": 2.0}) == W
    (C,) = c2.critical_sets(system.at(0), psi.constant(), tuple(z[name] for name in names))
    assert C.e == pytest.approx([0.8 / 3.0, 0.0])


def test_contacts_are_values():
    system = two_blocks()
    assert pickle.loads(pickle.dumps(system)) == system
    assert system != three_feet()
    assert "\n" not in repr(system)
    run = system.simulate_nonsmooth((0.0, 0.0, 0.1, 0.0, 0.0), (0.0, 1.0))
    assert pickle.loads(pickle.dumps(run)) == run
    assert "\n" not in repr(run)
    assert list(run.to_frame().columns) == ["t", "u1", "v1", "u2", "v2", "stretch", "contacts"]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"contacts": ()}, "contacts is (); give from 1 to 8"),
        ({"contacts": [(EYE, 0.3)]}, "contacts[1] is"),
        ({"contacts": [(EYE, ((1, 0), (0, 2)), 1)]}, "mu is ((1, 0), (0, 2))"),
        ({"contacts": [(EYE, 0.3, (1, 0))]}, "which contacts stick is not known to be unique"),
        ({"contacts": [(EYE, 0.3, "1 + u")]}, "normal"),
        ({"contacts": [(((1, 0), (2, 0)), 0.3, 1)]}, "the rows of a J are dependent"),
        ({"force": ("c", 0)}, "force reads c"),
        ({"M": ((1, 0), (0, -1))}, "M is not positive definite"),
        ({"M": ((1, 2), (0, 1))}, "M is not symmetric"),
    ],
)
def test_what_is_not_known_is_refused(change, said):
    given = {"M": EYE, "contacts": [(EYE, 0.3, 1)], "force": (0, 0), "velocities": ("u", "v"), **change}
    with pytest.raises(ValueError, match=re.escape(said)):
        contacts(**given)


def test_a_contact_that_loses_its_load_ends_the_motion():
    one = contacts(EYE, [(EYE, 0.3, "1 - t")], ("2", 0), ("u", "v"), {"t": 1})
    run = one.simulate_nonsmooth((0.0, 0.0, 0.0), (0.0, 2.0))
    assert run.status.name == "NO_FRICTION"
    assert run.reason.endswith("The bound μN of contact 1 is not positive there.")
    with pytest.raises(ValueError, match=r"state: contact 1 has mu N = -0\.3"):
        one.decide((0.0, 0.0, 2.0))


def shaken(seed):
    rng = np.random.default_rng(seed)
    return shaken_plate(rng.normal(size=(3, 2)), rng.uniform(2.0, 12.0, 3), rng.uniform(5.0, 8.0, 3))


@pytest.mark.parametrize(("seed", "rtol"), [(14, 1e-6), (15, 1e-6), (3, 1e-4), (7, 1e-4)])
def test_contacts_that_stop_because_others_do_have_no_slip_left_however_loose_the_tolerance(seed, rtol):
    """Three feet have six rows in three velocities: where two stop, so does the third."""
    whole, start = shaken(seed), (0.0, 0.0, 0.0, 0.0)
    run = whole.simulate_nonsmooth(start, (0.0, 3.0), rtol=rtol, atol=1e-2 * rtol, max_steps=2000)
    assert run.status.name == "T_END"
    for phase in run.phases:
        still = np.array(phase.kinds) == "stick"
        inside = (run.times >= phase.t_start) & (run.times < phase.t_end)
        assert np.abs(whole.slips(run.states[inside])[:, still]).max(initial=0.0) < 1e-13


@pytest.mark.parametrize("seed", [3, 8])
def test_a_shaken_plate_on_redundant_feet_is_the_limit_of_the_regularised_one(seed):
    """It sticks, turns about a foot, slides on all and comes to rest, in every order."""
    whole = shaken(seed)
    start, times = (0.0, 0.0, 0.0, 0.0), np.linspace(0.0, 3.0, 200)
    run = whole.simulate_nonsmooth(start, (0.0, 3.0))
    assert run.status.name == "T_END"
    assert len(run.phases) > 3
    own = whole.simulate(psi.constant(), start, (0.0, 3.0), eps=1e-6)
    assert np.abs(own.dense(times) - run.dense(times)).max() < 1e-4  # of slips that are 0.1 and more
    assert max(np.abs(whole.slips(run.states)).max(axis=(1, 2))) > 0.1


def test_a_motion_has_the_times_that_were_asked_for_a_table_and_a_picture():
    whole, times = plate([foot(0.0, 0.5, 5.0)], rates={"t": 1}), np.linspace(0.0, 1.0, 7)
    plain = whole.simulate_nonsmooth((1.0, 0.2, 0.0, 0.0), (0.0, 1.0))
    run = whole.simulate_nonsmooth((1.0, 0.2, 0.0, 0.0), (0.0, 1.0), times=times)
    assert run.times.tolist() == times.tolist()
    assert run.states.tolist() == plain.dense(times).tolist()
    assert run.dense(0.37).tolist() == plain.dense(0.37).tolist()
    own = whole.simulate(psi.constant(), (1.0, 0.2, 0.0, 0.0), (0.0, 1.0), eps=1e-2, times=times)
    assert own.states[:, 3] == pytest.approx(times)
    table = run.to_frame([0.25, 0.5])
    assert table["u"].tolist() == plain.dense([0.25, 0.5])[:, 0].tolist()
    assert set(table["contacts"]) <= {"slip", "stick"}
    drawn = run._repr_svg_()
    assert [f">{name}<" in drawn for name in ("u", "v", "w")] == [True] * 3
    with pytest.raises(ValueError, match="give times from 0 to 1"):
        whole.simulate_nonsmooth((1.0, 0.2, 0.0, 0.0), (0.0, 1.0), times=[0.0, 2.0])


@pytest.mark.parametrize(
    ("driven", "start", "end"),
    [
        (
            Driven(1.44, 0.33, ((0.01, 0.2, 0.58, 1.49), (0.25, -1.16, 0.22, 4.77)), (0.34, -2.77), 0.96, 2.09, 1.66),
            (-0.58, -0.05, 0.28, 0.72), (-0.2386, 0.5077, -0.4727, 1.7979, 0.0146, -1.0871),
        ),
        (
            Driven(2.87, 0.89, ((0.34, -0.33, 0.35, 2.9), (-0.67, -0.71, 0.59, 2.99)), (-3.17, 0.11), 0.98, 0.41, 1.14),
            (1.28, -1.0, 1.68, 1.04), (0.0669, 0.0022, 0.0343, 3.2439, 0.6430, -1.5124),
        ),
        (
            Driven(2.0, 0.7, ((0.2, 0.1, 0.3, 5.0), (0.7, -0.8, 0.3, 5.0)), (-3.4, -6.9), 1.0, 0.0, 0.5),
            (0.5, 0.0, 1.0, 0.0), (2.05383, -1.50286, 0.33845, 2.61857),
        ),
    ],
)  # fmt: skip
def test_a_stuck_foot_lets_go_while_another_slips(driven, start, end):
    """Where it lets go its slip grows like t^2, and the foot that slips turns: Radau with eps = 1e-5 has the end."""
    run = driven.contacts().simulate_nonsmooth((*start, 0.0, 0.0, 0.0), (0.0, 4.0 if driven.spring == 0.0 else 3.0))
    assert run.status.name == "T_END"
    assert run.states[-1, : len(end)] == pytest.approx(end, abs=1.5e-4)
    lets_go = [b for a, b in itertools.pairwise(run.phases) if a.kinds.count("stick") == 1 and "holds" in b.reason]
    assert lets_go
    assert all(phase.t_end - phase.t_start > 1e-3 for phase in run.phases)
