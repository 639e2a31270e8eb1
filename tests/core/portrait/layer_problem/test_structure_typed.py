"""Separatrices, outcomes and limit cycles of typed systems: exact cases, the paper's examples, e-linear twins."""

import math

import numpy as np
import pytest

from codim2_core import (
    System,
    approach_outcomes,
    critical_sets,
    examples,
    limit_cycles,
    psi,
    separatrices,
)

FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3), psi.custom("1/(1+s)**2")]
ANY_PSI = pytest.mark.parametrize("p", FAMILIES, ids=lambda p: p.text)
AR, NU = examples.attracting_repelling(), examples.nonunique_sliding()


@ANY_PSI
def test_attracting_repelling_crosses_exactly_within_a_third_of_pi(p):
    """sec:mateslidecross: |theta| < pi/3 crosses, all other angles slide on the stable node."""
    found = approach_outcomes(AR, p, 0.5)
    (stable,) = [i for i, C in enumerate(critical_sets(AR, p, 0.5)) if C.kind == "stable node"]
    edges = sorted(edge for low, high, outcome in found.arcs if not outcome.slides for edge in (low, high))
    inside = [e for e in edges if abs(math.remainder(e, 2 * math.pi)) > 1e-9]
    assert inside == pytest.approx([math.pi / 3, 2 * math.pi - math.pi / 3], abs=1e-12)
    for theta in np.linspace(-math.pi, math.pi, 50):
        outcome = found.outcome(theta)
        assert outcome.slides == (abs(theta) > math.pi / 3)
        if outcome.slides:
            assert (outcome.verdict, outcome.onto) == ("slide", f"C{stable + 1}")
            assert outcome.slow_flow == pytest.approx([-0.5])
            assert outcome.depends_on_psi is False
    assert "crossing" in found.outcome(0.3).reason


@pytest.mark.parametrize("z", [0.0, 0.6, 1.3])
def test_nonunique_sliding_depends_on_the_side(z):
    """sec:nonunique: slow flow chi + 1/4 from x < 0, -chi + 1/4 from x > 0."""
    chi = (1 + 2 * z * z) / (1 + z * z)
    found = approach_outcomes(NU, psi.rational(), z, compare=())
    assert len(found.arcs) == (8 if chi**2 < 2 else 4)
    for theta in np.linspace(0.03, 6.2, 40):
        if abs(math.cos(theta)) > 0.05:
            outcome = found.outcome(theta)
            assert outcome.verdict == "slide"
            assert outcome.slow_flow == pytest.approx([-math.copysign(chi, math.cos(theta)) + 0.25], abs=1e-13)


@ANY_PSI
def test_skeleton_of_attracting_repelling(p):
    found = separatrices(AR, p, 0.5)
    kinds = {f"C{i + 1}": C.kind for i, C in enumerate(critical_sets(AR, p, 0.5))}
    (node,), (saddle,) = ([n for n, kind in kinds.items() if kind.endswith(what)] for what in ("node", "saddle"))
    inside = {pair for pair, branch in zip(found.graph, found, strict=True) if branch.inside}
    expected = {(saddle, node), (saddle, "Q1"), ("Q2", saddle), ("Q6", saddle), ("Q3", node), ("Q5", node)}
    assert inside == expected
    # On y = 0 the flow stays there: the saddle's unstable branches are straight.
    for branch in found:
        if branch.origin == saddle and branch.direction == "unstable":
            assert np.abs(branch.points[:, 1]).max() < 1e-9


DUFFING = System(U=("s", "c - 6*c**3 + k*s*(m - c**2)"), parameters={"k": 1.0, "m": 0.13})


@pytest.mark.parametrize(
    ("m", "around_all", "around_one"),
    [(0.11, [], 0), (0.12, ["stable", "unstable"], 0), (0.127, ["stable", "unstable"], 0), (0.129, ["stable"], 2),
     (0.13, ["stable"], 2), (0.15, ["stable"], 2), (0.2, [], 0)],
)  # fmt: skip
def test_the_unfolding_of_two_wells(m, around_all, around_one):
    """Fold of big cycles, two homoclinic loops (0.127 < m < 0.129), Hopf at m = 1/6: each cycle is found once."""
    system = DUFFING.evolve(m=m)
    critical = critical_sets(system, psi.constant())
    assert [C.kind.split()[-1] for C in critical] == ["focus", "saddle", "focus"]
    found = limit_cycles(system, psi.constant())
    count = [sum(inside(cycle.points, C.p) for C in critical) for cycle in found]
    assert sorted(cycle.kind for cycle, n in zip(found, count, strict=True) if n == 3) == around_all
    assert [cycle.kind for cycle, n in zip(found, count, strict=True) if n == 1] == ["unstable"] * around_one
    assert len(found) == len(around_all) + around_one
    # The system is symmetric: the small ones are images of each other. (Near the loop periods grow like a logarithm.)
    small = [cycle.period for cycle, n in zip(found, count, strict=True) if n == 1]
    assert small == pytest.approx(small[:1] * len(small), rel=1e-6)


@pytest.mark.parametrize(("m", "count"), [(-0.31, 0), (-0.29, 1), (-0.22, 1), (-0.208, 1), (-0.205, 1), (-0.19, 0)])
def test_from_hopf_to_a_loop_beyond_which_nothing_returns(m, count):
    """Bogdanov and Takens: one cycle between the Hopf bifurcation, m = -0.3, and the loop; there it ends on an edge."""
    system = System(U=("s", "2*c**2 - 0.18 + s*(c - m)/2"), parameters={"m": m})
    found = limit_cycles(system, psi.constant())
    assert [cycle.kind for cycle in found] == ["unstable"] * count
    for cycle in found:
        assert cycle.divergence_multiplier == pytest.approx(cycle.multiplier, rel=1e-6)
        assert cycle.closure < 1e-10
        assert cycle.mean_e[1] == pytest.approx(0.0, abs=1e-9)  # as x2' = s


def inside(points, p):
    angle = np.unwrap(np.arctan2(points[:, 1] - p[1], points[:, 0] - p[0]))
    return abs(abs(angle[-1] - angle[0]) - 2 * math.pi) < 1.0


def test_a_band_of_closed_orbits_is_no_limit_cycle():
    found = limit_cycles(System(U=("-s*(1 + c**2)", "c*(1 + c**2)")), psi.rational())
    assert len(found) == 0
    assert any("band" in note for note in found.notes)
