"""Where limit cycles vanish, as curves in (f1, f2): folds, loops through the equator, the closed equator."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from codim2_core import ELinear, bifurcations, branches, equator_cycle, psi
from codim2_core.bifurcations.families.disc import corners as corner_angles
from codim2_core.bifurcations.families.disc import saddle_node_force
from codim2_core.portrait.cycles.heteroclinic_cycle import loop_gap
from codim2_core.portrait.cycles.limit_cycles import limit_cycles
from codim2_core.portrait.cycles.ray_section import heteroclinic_arcs
from codim2_core.portrait.layer_problem.problem import LayerProblem
from tests.core.polylines import away

ABD = (1.0, 1.3, -1.2)
A = np.array([[1.0, -1.3], [1.3, -1.2]])


def system(f):
    return ELinear(*ABD, tuple(f))


def continue_cycles(system, p, name, span):
    return branches(system, p, along=name, span=span).cycles


def loops(at, p):
    """The arcs in the sense in which orbits turn about C, and the gaps of their loops."""
    problem = LayerProblem(at, p)
    arcs = [arc for arc in heteroclinic_arcs(problem) if arc.sense == math.copysign(1, at.b)]
    return [(arc, loop_gap(problem, problem.critical[0], arc)) for arc in arcs]


@pytest.fixture(scope="module")
def folds():
    return bifurcations.cycle_folds(ELinear(*ABD), psi.hill(3))


@pytest.fixture(scope="module")
def loop_curve():
    return bifurcations.heteroclinic(ELinear(*ABD), psi.hill(3))


def corners():
    return list(saddle_node_force(A, np.array(corner_angles(A))))


def ends_of_the_border(abd):
    """Where borders touch, and where that of saddle-nodes crosses itself."""
    a, b, d = abd
    M = np.array([[a, -b], [b, d]])
    double = [s.place for s in bifurcations.saddle_node(ELinear(*abd)).special if s.type == "double saddle-node"]
    return [*saddle_node_force(M, np.array(corner_angles(M))), *map(np.array, double)]


def from_nearest(point, places):
    return min(np.hypot(*(point - place)) for place in places)


def test_closed_equator_has_exponent_zero():
    curve = bifurcations.closed_equator(ELinear(*ABD))
    assert curve.kind == "equator"
    assert len(curve) == 2
    assert away(-curve.branches[1], curve.branches[0]).max() < 1e-3  # of its chords
    a, b, d = ABD
    for f in curve.branches[0][3:-3:8]:

        def rate(t, f=f):
            c, s = math.cos(t), math.sin(t)
            return (a * c * c + d * s * s + f[0] * c + f[1] * s) / abs((d - a) * s * c + f[1] * c - f[0] * s + b)

        # whole turns by the trapezoidal rule would do; quad is of another kind than the closed form
        assert abs(quad(rate, 0.0, 2 * math.pi, limit=400, epsabs=1e-10)[0]) < 1e-7
    ends = [curve.branches[0][0], curve.branches[0][-1]]
    assert max(from_nearest(end, ends_of_the_border(ABD)) for end in ends) < 1e-9


@pytest.mark.parametrize("abd", [(0.0466, 2.228, -0.8324), (-0.585, -2.4198, 2.807)])
def test_a_curve_next_to_the_border_of_closed_equators_is_found(abd):
    """It lies between the rays on which changes of sign were looked for once."""
    curve = bifurcations.closed_equator(ELinear(*abd))
    assert len(curve) == 2
    for line in curve.branches:
        way = np.diff(line, axis=0)
        for i in range(len(line) // 4, len(line) - len(line) // 4, 5):
            across = 1e-6 * np.array([-way[i, 1], way[i, 0]]) / np.hypot(*way[i])
            sides = [equator_cycle(ELinear(*abd, tuple(line[i] + s * across))).exponent for s in (-1.0, 1.0)]
            assert sides[0] * sides[1] < 0.0
        assert max(from_nearest(end, ends_of_the_border(abd)) for end in (line[0], line[-1])) < 1e-9


def test_equator_of_reversible_systems_and_none():
    flat = bifurcations.closed_equator(ELinear(1.0, 3.0, -1.0))
    assert "reversible" in flat.sentence
    for line in flat.branches:
        assert np.allclose(abs(line[:, 0]), abs(line[:, 1]))
    for curve in (
        bifurcations.closed_equator(ELinear(-1, 1, -2)),
        bifurcations.heteroclinic(ELinear(-1, 1, -2), psi.tanh()),
        bifurcations.cycle_folds(ELinear(-1, 1, -2), psi.tanh()),
    ):
        assert len(curve) == 0
        assert "Case III" in curve.sentence
    with pytest.raises(ValueError, match="psi"):
        bifurcations.heteroclinic(ELinear(1, 1.3, -1.2), 3.0)


def test_loops_close_on_their_curve(loop_curve):
    """On its two sides the branch of Q passes inside and outside of P; test_cycle_branch follows it by SciPy."""
    assert len(loop_curve) == 2
    line, ratio = loop_curve.branches[0], loop_curve.values[0]
    assert len(line) == len(ratio)
    p = psi.hill(3)
    for i in range(2, len(line) - 2):
        ((arc, gap),) = loops(system(line[i]).at(()), p)
        inner = 7 <= i < len(line) - 5
        assert abs(gap) < (1e-8 if inner else 2e-7)  # next to its ends, at corners, it changes ever faster
        assert arc.ratio == pytest.approx(ratio[i], rel=1e-9 if inner else 1e-7)
    assert min(from_nearest(end, corners()) for end in (line[0], line[-1])) < 1e-9
    place = {s.type: s.place for s in loop_curve.special}["neutral loop"]
    ((arc, _),) = loops(system(place).at(()), p)
    assert arc.ratio == pytest.approx(1.0, abs=1e-6)


def test_branches_of_cycles_end_on_the_curve_of_loops(loop_curve):
    line = loop_curve.branches[0]
    f = line[len(line) // 2]
    found = continue_cycles(system(f), psi.hill(3), "f1", (f[0] - 0.05, f[0] + 0.05))
    ends = [s.value for b in found for s in b.special if s.kind == "heteroclinic cycle through the equator"]
    assert ends == [pytest.approx(f[0], abs=1e-7)]


def test_folds_from_generalised_hopf_points(folds):
    p = psi.hill(3)
    points = [np.array(s.place) for s in bifurcations.hopf(ELinear(*ABD), p).special if s.type == "generalised Hopf"]
    ends = [end for line in folds.branches for end in (line[0], line[-1])]
    for point in points:
        assert from_nearest(point, ends) < 1e-9
    for line, sizes in zip(folds.branches, folds.values, strict=True):
        assert len(line) == len(sizes)
        assert not line.flags.writeable
        assert np.hypot(*np.linalg.solve(A, line.T)).max() <= 1.0 + 1e-9
    assert {s.type for s in folds.special} <= {"touching", "resonant loop"}


def test_on_the_curve_a_branch_of_cycles_turns_round(folds):
    p = psi.hill(3)
    for line, sizes in list(zip(folds.branches, folds.values, strict=True))[::2]:
        i = int(np.argmin(abs(sizes - 0.6 * sizes.max())))
        f = line[i]
        found = continue_cycles(system(f), p, "f2", (f[1] - 0.03, f[1] + 0.03))
        values = [fold.value for branch in found for fold in branch.folds]
        assert min(abs(value - f[1]) for value in values) < 1e-7


def test_cusps_of_cycles_are_named_where_the_folds_turn_back():
    """Inside the tongue next to a cusp there are three cycles, and one outside it."""
    abd, p = (0.12726841122583082, -1.18719452785014, -0.5793015965026732), psi.hill(3)
    curve = bifurcations.cycle_folds(ELinear(*abd), p)
    cusps = [np.array(s.place) for s in curve.special if s.type == "cusp of cycles"]
    assert len(cusps) == 4
    assert "cusp" in next(s.sentence for s in curve.special if s.type == "cusp of cycles")
    for cusp in cusps:
        line = min(curve.branches, key=lambda line: from_nearest(cusp, line))
        i = int(np.argmin(np.hypot(*(line - cusp).T)))
        assert np.hypot(*(line[i] - cusp)) < 1e-12
        # the two arms of the tongue, on one side of the cusp
        arms = [line[max(i - 3, 0)] - cusp, line[min(i + 3, len(line) - 1)] - cusp]
        assert arms[0] @ arms[1] > 0.9 * np.hypot(*arms[0]) * np.hypot(*arms[1])
    tongue = limit_cycles(ELinear(*abd, (-1.0450119219070992, 0.07895443583277581)), p)
    assert len(tongue) == 3


def test_two_cycles_meet_on_a_fold_however_narrow_the_strip_is_in_which_they_are_two():
    """Here it is narrower than 1e-5: the outer one ends in a connection of saddles, the inner one at C."""
    p = psi.hill(3)
    curve = bifurcations.cycle_folds(ELinear(1.0, 1.5, -2.0), p)
    line, i = curve.branches[0], int(np.argmin(abs(curve.values[0] - 0.05)))
    along = line[i + 1] - line[i - 1]
    across = np.array([along[1], -along[0]]) / np.hypot(*along)
    counts = [
        len(limit_cycles(ELinear(1.0, 1.5, -2.0, tuple(line[i] + h * across)), p)) for h in (-1e-5, -1e-7, 1e-7, 1e-5)
    ]
    assert counts in ([0, 0, 2, 0], [0, 2, 0, 0])


def test_two_cusps_that_one_step_passes_are_both_named():
    """The curve turns back at its cusps and nowhere else: two close ones leave the sign of the bend as it was."""
    a, b, d = 0.3053288537408046, 0.6464953582754809, -0.33297978971701897
    curve = bifurcations.cycle_folds(ELinear(a, b, d), psi.hill(2))
    cusps = [np.array(s.place) for s in curve.special if s.type == "cusp of cycles"]
    assert len(cusps) == 6
    assert len(curve.branches) == 2  # from one generalised Hopf point to the other, cut nowhere
    for line, sizes in zip(curve.branches, curve.values, strict=True):
        line = line[np.diff(sizes, append=math.nan) != 0.0]  # a corner is added with the size of the fold before it
        steps = np.diff(line, axis=0)
        back = [line[i] for i in range(1, len(steps)) if steps[i] @ steps[i - 1] < 0.0]
        for place in back:
            assert min(np.hypot(*(cusp - place)) for cusp in cusps) < 1e-9
