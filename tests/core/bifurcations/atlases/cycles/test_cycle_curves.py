"""Folds of cycles over two parameters: against closed forms and branches."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.bifurcations.atlases.atlas import curves_over, with_folds_of_cycles
from codim2_core.bifurcations.atlases.cycles import cycle_curves

RADIAL = c2.System(
    U=(
        "mu*c - s + k*c*(c**2 + s**2) - 2*c*(c**2 + s**2)**2 + q*c**2",
        "c + mu*s + k*s*(c**2 + s**2) - 2*s*(c**2 + s**2)**2",
    ),
    parameters={"mu": -0.05, "k": 0.8, "q": 0.0},
)
RANGES = (-0.6, 0.2), (-1, 2)


def folds(system, psi, *names_and_ranges):
    return [one for one in with_folds_of_cycles(system, psi, curves_over(system, psi, *names_and_ranges)).curves
            if one.kind == "fold of cycles"]  # fmt: skip


@pytest.fixture
def no_lines(monkeypatch):
    """Only what begins at generalised Hopf points is followed: lines take seconds."""
    monkeypatch.setattr(cycle_curves, "LINE_OFFSETS", ())


@pytest.mark.usefixtures("no_lines")
@pytest.mark.parametrize("psi", [c2.psi.hill(2), pytest.param(c2.psi.tanh(), marks=pytest.mark.slow)])
def test_a_system_that_turns_has_its_fold_where_a_root_is_double(psi):
    """Circles |e|^2 = q with mu + k q - 2 q^2 = 0, of any Psi: two meet where mu = -k^2/8, at q = k/4."""
    (curve,) = folds(RADIAL, psi, "mu", "k", RANGES)
    mu, k = curve.points.T
    assert np.abs(mu + k**2 / 8.0).max() < 1e-10
    assert (k.min(), k.max()) == pytest.approx((0.0, 2.0), abs=1e-9)
    zeta = np.array([float(psi.radius(math.sqrt(q))) if q > 0.0 else 0.0 for q in k / 4.0])
    assert curve.numbers == pytest.approx(zeta / np.hypot(1.0, zeta), abs=2e-3)  # the farthest of a turn's nodes
    assert curve.label == "sec:case3"


@pytest.mark.slow
def test_a_branch_of_cycles_turns_back_on_the_curve():
    system = RADIAL.evolve(q=0.4)
    psi = c2.psi.tanh()
    (curve,) = folds(system, psi, "mu", "k", RANGES)
    mu, level = curve.points.T
    for i in (np.argmin(abs(level - 0.7)), np.argmin(abs(level - 1.4))):  # vertices: chords are as long as steps
        k = float(level[i])
        (branch,) = c2.branches(system.evolve(k=k), psi, along="mu", span=(-0.6, 0.2)).cycles.branches
        (fold,) = branch.folds
        assert mu[i] == pytest.approx(fold.value, abs=1e-6)


@pytest.mark.slow
def test_lines_find_what_no_generalised_hopf_point_begins():
    """k > 0.3: the curve leaves the square before it comes to k = 0."""
    (curve,) = folds(RADIAL, c2.psi.tanh(), "mu", "k", ((-0.6, 0.2), (0.3, 2)))
    assert np.abs(curve.points[:, 0] + curve.points[:, 1] ** 2 / 8.0).max() < 1e-10
    assert np.ptp(curve.points[:, 1]) == pytest.approx(1.7, abs=1e-9)


@pytest.mark.slow
@pytest.mark.usefixtures("no_lines")
def test_regions_are_not_cut_and_what_stops_within_is_told(monkeypatch):
    found = c2.atlas(RADIAL, c2.psi.tanh(), dict(zip(("mu", "k"), RANGES, strict=True)))
    assert all(one.kind != "fold of cycles" for one in found.curves)
    more = with_folds_of_cycles(RADIAL, c2.psi.tanh(), found)
    assert more.regions is found.regions
    assert more.points == found.points
    whole = c2.atlas(RADIAL, c2.psi.tanh(), dict(zip(("mu", "k"), RANGES, strict=True)), with_cycles=True)
    assert [one.kind for one in whole.curves] == [one.kind for one in more.curves]
    monkeypatch.setattr(cycle_curves, "ON_CURVE_DISTANCE", 0.0)  # as if it had not come to the point of its birth
    told = with_folds_of_cycles(RADIAL, c2.psi.tanh(), found).points
    stopped = [point for point in told if point.kind == "undecided"]
    assert [np.hypot(*point.place) < 0.02 for point in stopped] == [True]
    assert "continued only" in stopped[0].sentence
