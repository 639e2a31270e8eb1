"""Branches of limit cycles of general systems: their e-linear twins, integrations by SciPy, separatrices of saddles."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import codim2_core as c2

ONE = c2.psi.constant()
CASE3 = c2.ELinear(172, 186, -200, (-86, -93))
FOLD = c2.ELinear(1.6215774162507035, -2.4647033090719974, -2.095840045086004, (1.3369924, -1.0251566))
SLOW_MEETING = c2.ELinear(0.286, -0.709, -1.339, (-0.057, -0.94))
TWO_MEETINGS = c2.ELinear(1.831, -1.525, -1.013, (0.743, -0.799))
LOOP = c2.ELinear(0.6285923608169889, -1.2085733311350155, -1.5844770979730014, (-0.861192783343166, 0.99838561970375))
QUADRATIC = c2.System(
    U=("m*c - s + 0.3*c**2 - 2*c*(c**2 + s**2)", "c + m*s - 0.2*c*s - 2*s*(c**2 + s**2)"), parameters={"m": 0.1}
)
BOGDANOV = c2.System(U=("s", "-0.1 + m*s + c**2 - c*s"), parameters={"m": -0.28})
EIGHT = c2.System(U=("s", "c - 4*c**3 + m*s - c**2*s"), parameters={"m": 0.2})


def twin(system, angle):
    """Write the e-linear system in turned axes as text: affine in fact, as k = 0, but not in its formulas."""
    k, q = repr(math.cos(angle)), repr(math.sin(angle))
    u, v = f"({k}*c + {q}*s)", f"({k}*s - {q}*c)"
    U = f"(a*{u} - b*{v} + f1 + k*c*s)", f"(b*{u} + d*{v} + f2)"
    numbers = {name: system.value_of(name) for name in ("a", "b", "d", "f1", "f2")} | {"k": 0.0}
    return c2.System(U=(f"{k}*{U[0]} - {q}*{U[1]}", f"{q}*{U[0]} + {k}*{U[1]}"), parameters=numbers)


@pytest.mark.parametrize(("system", "n", "along", "span"), [
    (CASE3, 3, "n", (2.0, 4.0)), (CASE3, 3, "a", (171.8, 172.4)), (FOLD, 3, "b", (-2.55, -2.2)),
    (FOLD, 3, "f1", (1.25, 1.4)), (LOOP, 2, "f1", (-0.9, -0.8)),
])  # fmt: skip
def test_an_e_linear_system_as_text_has_the_same_branches(system, n, along, span):
    psi = c2.psi.hill(n)
    (one,), (two,) = (c2.branches(S, psi, along, span).cycles for S in (system, twin(system, 0.7)))
    first, second = one.special, two.special
    if first[0].kind != second[0].kind:
        second = second[::-1]
    assert [p.kind for p in first] == [p.kind for p in second]
    for p, q in zip(first, second, strict=True):
        loose = p.kind.startswith("heteroclinic")  # a limit of cycles here, a gap's zero there
        assert q.value == pytest.approx(p.value, rel=1e-7 if loose else 1e-8)
        assert q.period == pytest.approx(p.period, rel=1e-7)
        assert q.amplitude == pytest.approx(p.amplitude, abs=5e-3 if math.isinf(p.period) else 2e-4)


def test_a_branch_that_comes_down_ends_at_the_first_saddle_node():
    """Two lie ahead as f1 falls: the one that is farther away was told."""
    psi = c2.psi.rational()
    (branch,) = c2.branches(twin(TWO_MEETINGS, 0.0), psi, "f1", (-1.0, 2.5)).cycles
    special = c2.branches(TWO_MEETINGS, psi, "f1", (-1.0, 2.5), with_cycles=False).special
    *_, last = (one.value for one in special if one.kind == "saddle-node")
    assert [point.kind for point in branch.special] == ["Hopf", "saddle-node on the equator"]
    assert branch.end.value == pytest.approx(last, abs=1e-9)
    assert not c2.limit_cycles(TWO_MEETINGS.evolve(f1=last - 1e-3), psi)


def test_a_branch_that_slows_down_at_a_saddle_node_ends_there():
    """Its periods grow as exp(c/sqrt(distance)), to 1e13 within 2e-6: a loop was told that much before."""
    psi = c2.psi.tanh()
    (branch,) = c2.branches(twin(SLOW_MEETING, 0.0), psi, "f1", (-1.396, 1.282)).cycles
    special = c2.branches(SLOW_MEETING, psi, "f1", (-1.396, 1.282), with_cycles=False).special
    value, _ = (one.value for one in special if one.kind == "saddle-node")
    assert [point.kind for point in branch.special] == ["Hopf", "saddle-node on the equator"]
    assert branch.end.value == pytest.approx(value, abs=1e-9)


def motion(system, psi, value):
    """x2' = U(e_Psi(x2)), with the integral of its divergence by differences."""
    at = system.evolve(**{next(iter(dict(system.parameters))): value}).at()

    def U(x):
        return at.U(np.array(x) / math.sqrt(x[0] ** 2 + x[1] ** 2 + float(psi(x[0] ** 2 + x[1] ** 2))))

    def field(_, x):
        h = 1e-5
        across = U((x[0] + h, x[1]))[0] - U((x[0] - h, x[1]))[0] + U((x[0], x[1] + h))[1] - U((x[0], x[1] - h))[1]
        return [*U(x[:2]), across / (2 * h)]

    return field


@pytest.mark.parametrize("psi", [ONE, c2.psi.tanh()])
def test_cycles_of_a_quadratic_system_close_and_have_their_multipliers(psi):
    found = c2.branches(QUADRATIC, psi, "m", (-0.2, 0.9))
    (branch,) = found.cycles
    assert [p.kind for p in branch.special] == ["Hopf", "span"]
    assert branch.start.value == pytest.approx(0.0, abs=1e-10)
    assert branch.start.period == pytest.approx(2 * math.pi, rel=1e-9)
    assert "supercritical" in branch.start.sentence
    assert branch.stable[1:].all()
    assert (np.diff(branch.value[1:]) > 0.0).all()  # the side on which C is unstable
    for i in (5, len(branch) // 2, len(branch) - 1):
        start = branch.section[i] / math.sqrt(1.0 - branch.section[i] @ branch.section[i])
        end = solve_ivp(
            motion(QUADRATIC, psi, branch.value[i]), (0.0, branch.period[i]), [*start, 0.0],
            method="DOP853", rtol=1e-11, atol=1e-12,
        )  # fmt: skip
        assert math.dist(end.y[:2, -1], start) < 1e-8
        assert end.y[2, -1] == pytest.approx(branch.exponent[i], abs=1e-6)
        p = end.y[:2] / np.sqrt(1.0 + (end.y[:2] ** 2).sum(axis=0))
        assert np.hypot(*p).max() == pytest.approx(branch.amplitude[i], abs=2e-3)


def test_a_branch_ends_where_the_separatrices_of_the_saddle_meet():
    (branch,) = c2.branches(BOGDANOV, ONE, "m", (-0.4, -0.15)).cycles
    assert [p.kind for p in branch.special] == ["Hopf", "homoclinic cycle"]
    assert branch.end.period == math.inf
    # the unstable and the stable branch meet on the axis s = 0: followed once by SciPy's DOP853, with brentq
    assert branch.end.value == pytest.approx(-0.220637931195, abs=1e-6)
    assert (np.diff(branch.period[-6:-1]) > 0.0).all()


def test_a_loop_between_two_branches_is_not_passed_over():
    """Both foci give birth to a cycle; both end in one loop of two halves, from which a cycle about all three comes."""
    cycles = c2.branches(EIGHT, ONE, "m", (-0.1, 0.6)).cycles
    kinds = sorted(tuple(p.kind for p in branch.special) for branch in cycles)
    assert kinds == [("Hopf", "homoclinic cycle")] * 2 + [("homoclinic cycle", "fold of cycles", "equator")]
    ends = [p.value for branch in cycles for p in branch.special if p.kind == "homoclinic cycle"]
    assert np.ptp(ends) < 1e-8
    for m in (0.18, 0.2):
        assert cycles.count(m) == len(c2.limit_cycles(EIGHT.evolve(m=m), ONE))


@pytest.mark.parametrize("span", [(-0.5, 0.5), (-0.4, 0.63)])
def test_a_band_of_closed_orbits_at_one_value_is_no_branch(span):
    """For p = 0 it is reversible, s to -s: a centre. It was told as a branch from a Hopf point to the equator."""
    system = c2.System(U=("s*(1 + 0.3*c)", "0.1 - c + 0.2*c*c + p*s"), W=(), parameters={"p": 0.0})
    found = c2.branches(system, c2.psi.constant(), "p", span)
    assert len(found.cycles) == 0
    assert found.cycles.notes == ("p = 0: closed orbits fill a band within resolution, so none is a limit cycle.",)
    assert {point.kind for point in found.special} == {"Hopf", "neutral equator"}
    for p in (-0.1, 0.0, 0.1):
        assert not c2.limit_cycles(system.evolve(p=p), c2.psi.constant())


#: U with a parameter p, Psi, and values of p at which the cycles are counted: each was told wrongly once.
COUNTED = {
    "a guess where the section ends": (
        "p*c+(0.065)*c+(-0.203-0.9)*s+(-0.772)*c*c+(-0.015)*c*s+(0.582)*s*s+(-0.736)*c**3+(0.367)*z",
        "(0.191+0.9)*c+(-0.134+p/2)*s+(0.442)*c*c+(-0.096)*c*s+(0.643)*s*s+(-0.241)*s**3+(0.264)*z*c",
        ONE, (-0.6, 0.1, 0.9),
    ),
    "an equator that is neutral twice": (
        "p*c + 0.152*c - 1.432*s - 0.822*c*c + 0.495*c*s + 0.539*s*s - 0.02*c**3",
        "0.56*c + (p/2 - 0.217)*s + 0.29*c*c + 0.097*c*s - 0.86*s*s - 0.69*s**3",
        c2.psi.tanh(), (0.1, 0.3, 0.34, 0.5, 0.96),
    ),
    "a loop at -0.146819, and a fold of critical sets on the cycle behind it": (
        "p*c-0.844*s+0.276*c*c-0.442*c*s-0.052*s*s-0.619*c**3+1.027*c*c*s+0.283*sin(3*s)",
        "(0.312+0.5*p)*s+0.666*c-0.302*s*s-0.825*c*c*s-0.434*c*s*s",
        c2.psi.tanh(), (-0.14690, -0.14678),
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", COUNTED)
def test_branches_pass_as_many_cycles_as_there_are(what):
    *U, psi, values = COUNTED[what]
    system = c2.System(U=U, W=("1",), parameters={"p": 0.0})
    cycles = c2.branches(system, psi, "p", (-1.5, 1.5), (0.0,)).cycles
    for p in values:
        assert cycles.count(p) == len(c2.limit_cycles(system.evolve(p=p), psi, (0.0,)))


LOOP_END = "heteroclinic cycle through the equator"
#: a, b, d, f2, Psi, and special points along f1 by the section of e-linear systems: where first turns erred once.
TWINS = {
    "a saddle-node behind a loop": (
        1.184, 0.972, -0.714, -0.405, c2.psi.rational(),
        [("Hopf", -0.4437243606), ("saddle-node on the equator", -0.4392948859)],
    ),
    "a loop within rounding": (
        1.665, 1.485, -1.25, 0.955, c2.psi.tanh(), [("Hopf", 1.076032916), (LOOP_END, 1.075828473)],
    ),
    "a loop that is come to slowly": (
        0.254, -0.554, -0.424, 0.59, c2.psi.rational(),
        [("Hopf", -0.5486660973), ("fold of cycles", -0.5486486322), (LOOP_END, -0.5539182552)],
    ),
    "a loop reached on a second ray": (
        0.827, 0.636, -0.408, 0.668, c2.psi.hill(3), [("Hopf", 0.8913636816), (LOOP_END, 0.8929875537)],
    ),
    "a loop beyond which no ray leads": (
        1.518, 1.302, -1.114, 0.609, c2.psi.tanh(), [("Hopf", 0.7094619183), (LOOP_END, 0.7094612041)],
    ),
    "two folds within a step": (
        1.368, -1.154, -0.861, -0.562, c2.psi.rational(),
        [("Hopf", 0.6192034789), ("fold of cycles", 0.6186910493), ("fold of cycles", 0.6188995189),
         (LOOP_END, 0.6168848345)],
    ),
    "no fold by rounding where a cycle becomes the equator": (
        0.264, 0.33, -0.226, -0.163, c2.psi.tanh(), [("Hopf", -0.1384648567), ("equator", -0.1252226403)],
    ),
    "a loop through the equator however high": (
        0.722, -0.663, -0.54, -0.689, c2.psi.hill(3), [("Hopf", 0.7662471938), (LOOP_END, 0.7723450217)],
    ),
}  # fmt: skip


@pytest.mark.parametrize("angle", [0.0, 0.7])
@pytest.mark.parametrize("name", TWINS)
def test_first_turns_tell_what_the_global_section_did(name, angle):
    a, b, d, f2, family, special = TWINS[name]
    system = c2.ELinear(a, b, d, (0.0, f2))
    (branch,) = c2.branches(twin(system, angle) if angle else system, family, "f1", (-1.5, 1.5)).cycles
    assert [one.kind for one in branch.special] == [kind for kind, _ in special]
    assert [one.value for one in branch.special] == pytest.approx([value for _, value in special], abs=2e-9)


LOW = c2.System(
    U=(
        "p*c + 0.162 - 0.614*s - 1.082*c*c - 0.091*c*s + 0.088*s*s + 0.137*c**3 - 0.311*c*c*s + 0.117*s**3"
        " + 0.696*sin(3*s)",
        "(-0.091 + 0.5*p)*s - 0.108 + 1.24*c - 0.006*s*s - 0.761*c**3 - 0.909*c*c*s",
    ),
    parameters={"p": 0.0},
)


@pytest.mark.parametrize("family", [c2.psi.tanh(), c2.psi.hill(4)], ids=str)
def test_a_branch_of_the_smallest_heights_alone_is_one_and_no_band(family):
    """Low over the equator three pieces with gaps were told, on rays that its cycles cross lowest."""
    found = c2.branches(LOW, family, "p", (-1.5, 1.5)).cycles
    for value in (-1.2, -0.4, 0.1, 0.35):
        assert found.count(value) == len(c2.limit_cycles(LOW.evolve(p=value), family))
    if family == c2.psi.tanh():
        assert len(found) == 3
        assert [found.count(v) for v in (-0.8, -0.6, -0.4, 0.1, 0.206, 0.207, 0.2129)] == [1, 1, 1, 1, 1, 0, 2]


def test_a_ray_taken_next_to_a_loop_leads_on():
    """Rounding led a new ray back, over the branch to its Hopf point; `limit_cycles` sees where the branch ends."""
    U = (
        "p*c + 0.307 + 0.665*c - 0.726*s + 0.447*c*c - 0.33*c*s - 0.235*s*s - 0.565*c**3 + 0.8*s**3",
        "p/2*s - 0.341 - 0.778*c + 0.482*s + 0.989*c*c - 0.645*c*s + 0.243*s*s + 0.555*c**3 - 0.213*s**3",
    )
    system = c2.System(U=U, parameters={"p": 0.0})
    found = c2.branches(system, ONE, "p", (-1.5, 1.5)).cycles
    kinds = [[one.kind for one in branch.special] for branch in found]
    assert kinds == [["Hopf", LOOP_END], ["Hopf", "homoclinic cycle"]]
    low, high = -0.41177, -0.41174
    assert [len(c2.limit_cycles(system.evolve(p=v), ONE)) for v in (low, high)] == [0, 1]
    assert low < found[1].end.value < high
