"""Laws of physics engines that reach |e| = 1 at a finite slip: their conditions, creep, cycles and eps."""

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import codim2_core as c2
from codim2_core.systems.psi import ENGINES

CLAMP, IPC = c2.psi.engine("sap"), c2.psi.engine("ipc")
LAWS = {
    "drake": lambda r: r / math.hypot(1.0, r),
    "sap": lambda r: min(r, 1.0),
    "mujoco": lambda r: min(r, 1.0),
    "genesis": lambda r: min(r, 1.0),
    "ipc": lambda r: r * (2.0 - r) if r < 1.0 else 1.0,
    "newton": lambda r: r * (2.0 - r) if r < 1.0 else 1.0,
}
CHATTERING = c2.ELinear(200.0, 200.0, -172.0, (-100.0, -100.0))


@pytest.mark.parametrize("name", ENGINES)
def test_an_engines_psi_is_its_law_of_friction(name):
    law = c2.psi.engine(name)
    for r in (0.0, 1e-9, 0.2, 0.5, 0.9, 0.9999, 1.0, 1.7, 40.0):
        assert law.modulus(r) == pytest.approx(LAWS[name](r), rel=1e-15, abs=1e-300)
        h = 1e-6
        if 1e-3 < r != 1.0:
            radial, tangential = law.jacobian_factors(r)
            assert radial == pytest.approx((LAWS[name](r + h) - LAWS[name](r - h)) / (2.0 * h), abs=1e-8)
            assert tangential == pytest.approx(LAWS[name](r) / r, rel=1e-15)
    m = np.append(np.linspace(0.0, 0.999, 20), 1.0 - np.geomspace(1e-4, 1e-14, 8))
    assert law.modulus(law.radius(m)) == pytest.approx(m, rel=1e-13)


@pytest.mark.parametrize("text", ["max(1/(2 - sqrt(s))**2 - s, 0)", "max(1/(2 - min(sqrt(s), 1))**2 - s, 0)"])
def test_a_formula_that_touches_zero_is_zero_from_there_on(text):
    """The first has a pole at s = 4: there, as from s = 1 on, the law has saturated."""
    law = c2.psi.custom(text)
    assert law.saturation == pytest.approx(1.0, abs=1e-7)
    assert not law(np.array([1.0, 2.0, 4.0, 1e6, math.inf])).any()
    check = law.check()
    assert {c.name: c.where for c in check if not c} == pytest.approx({"R1": 0, "R2": 0, "R3": 1, "R4": 0}, abs=1e-7)
    assert "outside it the layer problem is the nonsmooth system" in check.R3.sentence


def test_claims_that_need_R3_fail_without_it():
    verdicts = {one.theorem: str(one.verdict.value) for one in c2.certificates(CHATTERING, CLAMP)}
    assert [verdicts[f"lem:ePsi({part})"] for part in "abcd"] == ["holds", "holds", "fails", "fails"]
    assert verdicts["rem:jaco_properties"] == "fails"
    assert verdicts["thm:geneps0(c)"] == "holds"


@pytest.mark.parametrize(
    ("name", "trace", "slip"),
    [
        ("drake", -19.0526, 1.0 / math.sqrt(3.0)),
        ("tanh", -6.5611, math.atanh(0.5)),
        ("ipc", -10.7797, 1.0 - math.sqrt(0.5)),
        ("sap", 28.0, 0.5),
    ],
)
def test_the_trace_decides_who_sticks(name, trace, slip):
    """At e = (1/2, 0), where r' and r'/r of the law r(slip) weigh a = 200 and d = -172."""
    law = c2.psi.tanh() if name == "tanh" else c2.psi.engine(name)
    e = math.tanh if name == "tanh" else LAWS[name]
    (C,) = c2.critical_sets(CHATTERING, law)
    np.testing.assert_allclose(C.x2, (slip, 0.0), atol=1e-12)
    slope = (e(slip + 1e-6) - e(slip - 1e-6)) / 2e-6
    assert C.trace == pytest.approx(200.0 * slope - 172.0 * e(slip) / slip, abs=1e-6)
    assert C.trace == pytest.approx(trace, abs=1e-4)
    assert C.kind == ("stable focus" if trace < 0.0 else "unstable focus")
    assert C.creep(1e-3) == pytest.approx(1e-3 * slip, rel=1e-12)


@pytest.mark.parametrize("name", ["sap", "ipc"])
@pytest.mark.parametrize(
    "system", [CHATTERING, c2.ELinear(1.0, 1.5, -1.1, (-0.4, -0.1))], ids=["chattering", "two cycles"]
)
def test_cycles_through_the_saturated_part_close_and_have_their_multipliers(name, system):
    """Independently: the law written out, the field split at |x2| = 1, the multiplier by Liouville's formula."""
    A = np.array([[system.a, -system.b], [system.b, system.d]])
    e, law = LAWS[name], c2.psi.engine(name)
    cycles = c2.limit_cycles(system, law)
    if name == "sap":
        assert [cycle.stable for cycle in cycles] == ([True, False] if system is CHATTERING else [False, True])
    for cycle in cycles:
        place = cycle.points[0]
        start = place / math.sqrt(1.0 - place @ place)
        sense = 1.0 if cycle.multiplier < 1.0 else -1.0

        def rate(_, y, sense=sense):
            x, r = y[:2], math.hypot(*y[:2])
            u, v = (x / r) ** 2
            radial = 0.0 if r >= 1.0 else 1.0 if name == "sap" else 2.0 - 2.0 * r
            trace = radial * (system.a * u + system.d * v) + e(r) / r * (system.a * v + system.d * u)
            return sense * np.append(A @ (x * (e(r) / r)) + system.f, trace)

        t, y = 0.0, np.append(start, 0.0)

        def crossing(_, y):
            return math.hypot(*y[:2]) - 1.0

        crossing.terminal = True
        while t < cycle.period * (1.0 - 1e-14):
            way = solve_ivp(rate, (t, cycle.period), y, "DOP853", rtol=1e-12, atol=1e-13, events=crossing)
            t, y = way.t[-1], way.y[:, -1]
            if way.status == 1:
                speed = rate(t, y)
                y = y + 1e-12 / math.hypot(*speed[:2]) * speed
        np.testing.assert_allclose(y[:2], start, atol=1e-6 * np.abs(start).max() + 1e-8)
        assert math.log(cycle.multiplier) == pytest.approx(sense * sense * y[2] * sense, abs=1e-5)


def test_outside_the_motion_is_that_of_the_nonsmooth_system():
    """On |x2| > 1, ``ln |x2|`` grows as ``lambda_rho/Theta`` along theta: a quadrature, eq:Theta."""
    system = c2.ELinear(1.0, 3.0, -0.9, (0.2, -0.1))
    for law in (CLAMP, IPC):
        run = c2.trajectories(system, law, [(0.95, 0.0)], t_max=0.6, rtol=1e-10)
        p = run.points[0][-1]
        x2 = p / math.sqrt(1.0 - p @ p)
        assert math.hypot(*x2) > 1.0

        def slope(theta):
            u = mpmath.matrix([mpmath.cos(theta), mpmath.sin(theta)])
            U = mpmath.matrix([[1.0, -3.0], [3.0, -0.9]]) * u + mpmath.matrix([0.2, -0.1])
            return (u[0] * U[0] + u[1] * U[1]) / (u[0] * U[1] - u[1] * U[0])

        grown = float(mpmath.quad(slope, [0.0, math.atan2(x2[1], x2[0])]))
        start = 0.95 / math.sqrt(1.0 - 0.95**2)
        assert math.hypot(*x2) == pytest.approx(start * math.exp(grown), rel=1e-7)


def test_what_needs_R3_says_so():
    found = c2.bifurcations.cycle_folds(c2.ELinear(172.0, 186.0, -200.0), IPC)
    assert not found.branches
    assert "R3" in found.sentence
    assert not c2.limit_cycles(CHATTERING, CLAMP, prove=True).proved
    assert c2.limit_cycles(c2.ELinear(1.0, 1.5, -1.0, (-0.4, -0.1)), CLAMP).notes  # a band about a linear centre


def test_a_linear_centre_is_no_supercritical_hopf_point():
    found = c2.branches(c2.ELinear(1.0, 1.5, -1.0, (-0.4, -0.1)), CLAMP, along="d", span=(-1.15, -0.8)).with_cycles()
    (hopf,) = (one for one in found.cycles[0].special if one.kind == "Hopf")
    assert "fill a band" in hopf.sentence
    (fold, *_) = (one for one in found.special if one.kind == "fold of cycles")
    for d, count in ((fold.value - 1e-5, 0), (fold.value + 1e-3, 2)):
        assert len(c2.limit_cycles(c2.ELinear(1.0, 1.5, d, (-0.4, -0.1)), CLAMP)) == count


def test_a_simulation_creeps_as_told():
    """A block pulled with half of what friction can carry: at rest it slips with eps |x2|."""
    block = c2.ELinear(-2.0, 0.0, -2.0, (1.0, 0.0))
    for name, slip in (("drake", 1.0 / math.sqrt(3.0)), ("sap", 0.5), ("ipc", 1.0 - math.sqrt(0.5))):
        law = c2.psi.engine(name)
        run = c2.simulate(block, law, [0.4, 0.1], (0.0, 2.0), eps=1e-3)
        (C,) = c2.critical_sets(block, law)
        assert C.creep(1e-3) == pytest.approx(1e-3 * slip, rel=1e-12)
        np.testing.assert_allclose(run.states[-1, :2], [1e-3 * slip, 0.0], atol=1e-9)


def test_eps_of_the_engines():
    assert c2.psi.engine_eps("ipc") == 1e-3
    assert c2.psi.engine_eps("newton", friction_epsilon=0.02) == 0.02
    assert c2.psi.engine_eps("drake", stiction_tolerance=1e-4) == 1e-4
    # 2 kg under gravity, mu 0.5: sigma w mu N dt = sigma mu g dt
    eps = c2.psi.engine_eps("sap", friction=0.5 * 2 * 9.81, inverse_mass=0.5, time_step=0.01)
    assert eps == pytest.approx(1e-3 * 0.5 * 9.81 * 0.01, rel=1e-14)
    with pytest.raises(ValueError, match="choose one of mujoco"):
        c2.psi.engine("bullet")
    with pytest.raises(ValueError, match="settings of 'sap' do not fit"):
        c2.psi.engine_eps("sap", friction=1.0)
    with pytest.raises(ValueError, match="solref"):
        c2.psi.engine_eps("mujoco", friction=1.0, normal=2.0, inverse_mass=1.0, solref=(-100.0, -1.0))


MUJOCO = """
<mujoco>
  <option timestep="0.002" cone="elliptic" impratio="{impratio}" gravity="{along} 0 {down}" integrator="implicitfast"/>
  <worldbody>
    <geom type="plane" size="9 9 1" friction="0.8" solref="{time} 1"/>
    <body pos="0 0 0.1">
      <joint type="slide" axis="1 0 0"/> <joint type="slide" axis="0 1 0"/> <joint type="slide" axis="0 0 1"/>
      <geom type="sphere" size="0.1" mass="{mass}" friction="0.8" solref="{time} 1"/>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.mark.parametrize("angle", [0.05, 0.3, 0.6])
@pytest.mark.parametrize("impratio", [1.0, 10.0])
@pytest.mark.parametrize(("mass", "time"), [(1.0, 0.02), (5.0, 0.01)])
def test_a_block_on_a_ramp_creeps_in_mujoco_as_predicted(angle, impratio, mass, time):
    mujoco = pytest.importorskip("mujoco")
    g, mu = 9.81, 0.8
    along, normal = g * math.sin(angle), mass * g * math.cos(angle)
    text = MUJOCO.format(impratio=impratio, along=along, down=-g * math.cos(angle), mass=mass, time=time)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    while data.time < 2.0:
        mujoco.mj_step(model, data)
    # v' = g sin(angle) - mu g cos(angle) e
    block = c2.ELinear(-mu * normal / mass, 0.0, -mu * normal / mass, (along, 0.0))
    (C,) = c2.critical_sets(block, c2.psi.engine("mujoco"))
    eps = c2.psi.engine_eps(
        "mujoco", friction=mu * normal, normal=normal, inverse_mass=1.0 / mass, impratio=impratio, solref=(time, 1.0)
    )
    assert float(data.qvel[0]) == pytest.approx(C.creep(eps), rel=1e-2)
