"""Branches of limit cycles: against integrations of another kind, closed forms, and the count at each parameter."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, System, branches, critical_sets, equator_cycle, equator_equilibria, psi, separatrices
from codim2_core.portrait.cycles.limit_cycles import limit_cycles
from codim2_core.portrait.layer_problem.vary import vary

CASE_III = ELinear(172, 186, -200, (-86, -93))
HOPF = 284 / 129
FOLD = ELinear(1.6215774162507035, -2.4647033090719974, -2.095840045086004, (1.3369924, -1.0251566))
LOOP = ELinear(0.6285923608169889, -1.2085733311350155, -1.5844770979730014, (-0.861192783343166, 0.99838561970375))


def continue_cycles(system, p, name, span, z=()):
    return branches(system, p, along=name, span=span, z=z).cycles


def kinds(branch):
    return [point.kind for point in branch.special]


def test_case_III_from_its_hopf_point():
    (branch,) = continue_cycles(CASE_III, psi.hill(3), "n", (2.0, 4.0))
    assert kinds(branch) == ["Hopf", "span"]
    assert branch.start.value == pytest.approx(HOPF, abs=1e-12)
    assert "supercritical" in branch.start.sentence
    assert branch.stable[1:].all()
    # pinned by an extrapolation method, see test_limit_cycles
    assert branch.end.value == 4.0
    assert branch.end.period == pytest.approx(0.6066957493683202, rel=1e-9)
    assert (np.diff(branch.value) > 0.0).all()
    assert (np.diff(branch.amplitude) > 0.0).all()
    # a square root, as at a Hopf point
    rate = branch.amplitude[1:4] ** 2 / (branch.value[1:4] - HOPF)
    assert rate.max() / rate.min() == pytest.approx(1.0, abs=0.05)
    C = critical_sets(CASE_III, psi.hill(HOPF))[0]
    assert branch.start.period == pytest.approx(2 * math.pi / abs(C.eigenvalues[0].imag), rel=1e-12)
    for array in (branch.value, branch.period, branch.amplitude, branch.multiplier, branch.stable, branch.section):
        assert len(array) == len(branch)
        assert not array.flags.writeable


@pytest.mark.parametrize(("system", "name", "span"), [(FOLD, "f1", (1.25, 1.4)), (FOLD, "b", (-2.55, -2.2))])
def test_through_a_fold_to_the_equator(system, name, span):
    p = psi.hill(3)
    (branch,) = continue_cycles(system, p, name, span)
    assert branch.start.kind == "equator" or branch.end.kind == "equator"
    (fold,) = branch.folds
    i = int(np.flatnonzero(branch.value == fold.value)[0])
    assert branch.multiplier[i] == pytest.approx(1.0, abs=1e-8)
    assert branch.stable[i - 1] != branch.stable[i + 1]
    step = 1e-6 * (span[1] - span[0])
    side = math.copysign(1.0, branch.value[i - 1] - fold.value)
    assert len(limit_cycles(vary(system, p, (), name, fold.value + side * step)[0], p)) == 2
    assert len(limit_cycles(vary(system, p, (), name, fold.value - side * step)[0], p)) == 0
    end = branch.end if branch.end.kind == "equator" else branch.start
    assert abs(equator_cycle(vary(system, p, (), name, end.value)[0]).exponent) < 1e-12
    assert end.period == math.inf


def test_branch_ends_in_a_loop_through_the_equator():
    """Beside its end a separatrix goes elsewhere on the one side than on the other."""
    p = psi.hill(2)
    (branch,) = continue_cycles(LOOP, p, "f1", (-0.9, -0.8))
    assert kinds(branch) == ["Hopf", "fold of cycles", "fold of cycles", "heteroclinic cycle through the equator"]
    assert branch.end.period == math.inf
    assert (np.diff(branch.period[-6:-1]) > 0.0).all()
    assert branch.end.value == pytest.approx(branch.value[-2], abs=1e-5)
    beside = [separatrices(LOOP.evolve(f1=branch.end.value + h), p).graph for h in (-1e-7, 1e-7)]
    assert set(beside[0]) != set(beside[1])


def test_saddle_node_on_the_equator():
    (branch,) = continue_cycles(LOOP, psi.rational(), "f2", (0.9, 1.1))
    assert kinds(branch) == ["Hopf", "saddle-node on the equator"]
    end = branch.end.value
    assert len(equator_equilibria(LOOP.evolve(f2=end - 1e-9))) != len(equator_equilibria(LOOP.evolve(f2=end + 1e-9)))


def test_a_line_of_critical_points_ends_a_branch():
    (branch,) = continue_cycles(CASE_III, psi.hill(3), "d", (-205.0, -190.0))
    assert kinds(branch) == ["det A = 0", "span"]
    assert branch.start.value == pytest.approx(-(186**2) / 172, rel=1e-9)
    assert branch.period[1] > 10 * branch.period[-1]


def test_named_degeneracies_and_empty_results():
    centre = ELinear(1, 3, -1, (0.5, -0.5))
    found = continue_cycles(centre, psi.tanh(), "a", (0.5, 1.5))
    assert len(found) == 0
    assert "band" in found.notes[0]
    assert "reversible" in continue_cycles(centre, psi.tanh(), "b", (2.0, 3.0)).reason
    assert "Bendixson" in continue_cycles(ELinear(1, 3, 2, (0.5, 0.1)), psi.tanh(), "f1", (0.0, 1.0)).reason
    assert (
        "None is born at a Hopf point"
        in continue_cycles(ELinear(1, 3, -2, (0.5, 0.0)), psi.tanh(), "f1", (0.3, 0.6)).reason
    )


def test_a_slow_variable_as_the_parameter():
    system = ELinear("1+z", 3, "z-1", (0.5, -0.3))
    (branch,) = continue_cycles(system, psi.tanh(), "z1", (-0.1, 0.1), z=(0.0,))
    assert kinds(branch) == ["Hopf", "equator"]
    assert abs(critical_sets(system, psi.tanh(), (branch.start.value,))[0].trace) < 1e-12


def test_small_cycles_grow_like_a_square_root_from_the_start():
    """Below the sampled map a cycle is placed by the expansion at C, down to 1e-6 of the picture."""
    sizes, exponents = [], []
    steps = [1e-6, 1e-8, 1e-10, 1e-11]
    for step in steps:
        p = psi.hill(HOPF + step)
        (cycle,) = limit_cycles(CASE_III, p)
        assert cycle.kind == "stable"
        C = critical_sets(CASE_III, p)[0]
        sizes.append(np.hypot(*(cycle.points - C.p).T).max() / math.sqrt(step))
        # it attracts as fast as C repels, twice over: ln multiplier = -T tr J
        exponents.append(math.log(cycle.divergence_multiplier) / (-cycle.period * C.trace))
    assert sizes == pytest.approx([sizes[0]] * len(sizes), rel=5e-3)
    assert exponents == pytest.approx([1.0] * len(steps), rel=1e-2)


@st.composite
def families(draw):
    a, d = draw(st.floats(0.3, 2.5)), -draw(st.floats(0.3, 2.5))
    if draw(st.booleans()):
        a, d = d, a
    b = math.sqrt(-a * d) * (1.05 + draw(st.floats(0.0, 1.5))) * draw(st.sampled_from([-1, 1]))
    r, t = draw(st.floats(0.2, 0.9)), draw(st.floats(0.0, 2 * math.pi))
    f = -np.array([[a, -b], [b, d]]) @ (r * math.cos(t), r * math.sin(t))
    p = draw(st.sampled_from([psi.constant(), psi.rational(), psi.tanh(), psi.hill(2), psi.hill(4)]))
    return ELinear(a, b, d, tuple(f)), p, draw(st.sampled_from(["a", "b", "d", "f1", "f2"])), draw(st.floats(0.2, 1.0))


#: A step that was expected within the span and corrected beyond it ended there, 1e-3 outside.
BEYOND = ELinear(1.3984375, -2.2449096063371905, -1.5, (-0.69921875, 1.1224548031685952))


@settings(max_examples=6, deadline=None, derandomize=True)
@example((BEYOND, psi.constant(), "f2", 0.75))
@given(families())
def test_no_cycle_is_missing(family):
    system, p, name, width = family
    at = system.at(())
    span = (getattr(at, name) - width, getattr(at, name) + 0.8 * width)
    found = continue_cycles(system, p, name, span)
    narrow = [branch for branch in found if branch.end.kind == "undecided" and np.ptp(branch.value) < 1e-6 * width]
    # what is followed no further lives in a part of the span in which its last cycles are within rounding
    assert all("band" in note for note in found.notes) or len(found.notes) == len(narrow)
    for value in np.linspace(*span, 8)[1:-1] + 0.013 * width:
        special = [point.value for branch in found for point in branch.special]
        if min((abs(value - v) for v in special), default=1.0) < 1e-4:
            continue
        assert found.count(value) == len(limit_cycles(vary(system, p, (), name, value)[0], p))
    for branch in found:
        for one, two in pairwise(branch.value.tolist()):
            assert span[0] - 1e-9 <= min(one, two) <= max(one, two) <= span[1] + 1e-9


@pytest.mark.parametrize("span", [(-100.0, -70.0), (-200.0, 200.0), (-1e4, 1e4)])
@pytest.mark.parametrize(("name", "middle"), [("f1", -86.0), ("f2", -93.0)])
def test_branches_on_a_narrow_part_of_the_span_are_those_of_the_part(name, middle, span):
    """The slider's span of Case III: C is on the hemisphere on a part of it that falls between two values."""
    part = continue_cycles(CASE_III, psi.hill(3), name, (middle - 2.0, middle + 2.0))
    there = limit_cycles(CASE_III, psi.hill(3))
    whole = continue_cycles(CASE_III, psi.hill(3), name, span)
    assert whole.span == span
    assert [b for b in whole if b.value.min() < middle < b.value.max()]
    assert whole.count(middle) == len(there)
    assert [kinds(b) for b in whole] == [kinds(b) for b in part]
    for one, other in zip(whole, part, strict=True):
        assert [p.value for p in one.special] == pytest.approx([p.value for p in other.special], abs=1e-6)


@pytest.mark.parametrize("span", [(-1.7, -0.3), (-1.05, -1.04), (-1.044955, -1.044945)])
def test_two_folds_next_to_each_other_are_both_told_however_long_the_steps(span):
    """Between them there are three cycles; on the widest span they are 1.2e-6 of it apart."""
    system = ELinear(0.127, -1.187, -0.5793, (-1.045, 0.07895))
    (branch,) = continue_cycles(system, psi.hill(3.0), "f1", span)
    assert [fold.value for fold in branch.folds] == pytest.approx([-1.0449507283, -1.0449490082], abs=2e-10)
    counts = [len(limit_cycles(system.evolve(f1=f1), psi.hill(3.0))) for f1 in (-1.0449515, -1.0449499, -1.0449482)]
    assert counts == [1, 3, 1]


def test_a_fold_next_to_a_point_of_the_branch_is_told():
    """One cycle at f1 = 1.2606 and three at 1.2607, of 68, 520 and 540 units of time."""
    system, p = ELinear(1.51, 3.031, -1.869, (0.0, -0.611)), psi.hill(3)
    found = continue_cycles(system, p, "f1", (-1.5, 1.5))
    folds = sorted(point.value for branch in found for point in branch.folds)
    assert folds[-2:] == pytest.approx([1.260628045, 1.262375516], abs=1e-8)
    for value in (1.2606, 1.2607):
        assert found.count(value) == len(limit_cycles(system.evolve(f1=value), p))


@pytest.mark.parametrize("span", [(-1.2, 0.5), (-1.0, -0.7)])
def test_a_loop_through_the_equator_is_where_its_branches_meet_on_any_span(span):
    """Extrapolated from the last cycles it was -0.98101151, and another value on another span."""
    system = ELinear(0.935, -1.058, -0.622, f=(-0.221, 0.957))
    (branch,) = continue_cycles(system, psi.hill(3), "f1", span)
    assert branch.end.kind == "heteroclinic cycle through the equator"
    assert branch.end.value == pytest.approx(-0.9810675678, abs=1e-9)


#: U with a parameter p, Psi, the span, and values of p at which cycles were missed.
MISSED = {
    "next to a saddle-node of the equator": (
        "p*c + 0.416*c - 1.717*s - 0.291*c*c + 0.343*c*s - 0.478*s*s - 0.696*c**3",
        "0.155*c + (0.592 + p/2)*s - 0.024*c*c - 0.302*c*s + 0.755*s*s - 0.408*s**3",
        psi.tanh(), (-1.5, 1.5), (-0.48122, -0.485),
    ),
    "between special values that are close": (
        "p*c-2.303*s+0.06*c*c+1.226*c**3+1.272*c*s*s+0.831*sin(3*s)",
        "(0.12+0.5*p)*s+0.03+0.522*c-1.234*c**3+0.207*c*c*s+0.219*c*s*s-0.13*sin(3*s)",
        psi.rational(), (-1.5, 1.5), (-0.13, -0.07, -0.02),
    ),
}  # fmt: skip


@pytest.mark.parametrize("where", MISSED)
def test_a_branch_on_a_narrow_part_of_a_span_is_seen(where):
    *U, family, span, values = MISSED[where]
    system = System(U=U, parameters={"p": 0.0})
    found = continue_cycles(system, family, "p", span)
    for p in values:
        assert found.count(p) == len(limit_cycles(system.evolve(p=p), family))
