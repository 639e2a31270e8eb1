"""Response curves: closed forms along a parameter, folds, doublings and tori, and where sticks begin."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import brentq

from codim2_core import PeriodicStatus, System, periodic_motion, psi, reference, response_curve
from codim2_core.motion.periodic.result import KINDS_OF_CHANGE, change_point
from codim2_core.motion.periodic.shooting import matching_distances

from ....words.recognition import recognise
from .closed_forms import CIRCLE, LINE, DenHartog, Rotating

#: q'' + q + k q^3 + 0.1 q' = cos(w t) - S q'/|q'|, in a line.
DUFFING = System(
    U=("-z1 - k*z1**3 - 0.1*x - S*c + cos(w*z2)", "-S*s"), W=("x", "1"), parameters={"k": 0.5, "S": 0.1, "w": 1.6}
)
#: Without friction: q'' = q - q^3 - 0.3 q' + F cos(1.2 t).
WELLS = System(U=("z1 - z1**3 - 0.3*x + F*cos(1.2*z2)", "-y"), W=("x", "1"), parameters={"F": 0.1})
#: Van der Pol's oscillator, forced: x = q'.
VAN_DER_POL = System(U=("-z1 + 0.1*(1 - z1**2)*x + F*cos(w*z2)", "-y"), W=("x", "1"), parameters={"F": 0.4, "w": 1.1})


def of_w(w):
    return 2.0 * math.pi / w


@pytest.mark.parametrize("eps", [0.0, 0.1])
def test_a_mass_that_is_driven_round_along_its_frequency(eps):
    exact = Rotating(0.3, 0.2, 0.5, 1.6, eps)
    found = response_curve(CIRCLE.evolve(d=0.2, w=1.6), exact.start, of_w, "w", (1.3, 3.0), psi.constant(), eps)
    assert found.ends == ("span", "span")
    assert (found.values.min(), found.values.max()) == pytest.approx((1.3, 3.0))
    assert found.stable.all()
    for i in range(0, len(found), 5):
        one = Rotating(0.3, 0.2, 0.5, float(found.values[i]), eps)
        assert math.hypot(*found.state0[i, 2:4]) == pytest.approx(abs(one.R), abs=1e-9)
        assert found.amplitude[i, 0] == pytest.approx(abs(one.R), abs=1e-9)
        assert found.velocity_amplitude[i, 0] == pytest.approx(one.speed, abs=1e-9)
        assert matching_distances(found.multipliers[i], one.multipliers).max() < 1e-8


def test_a_motion_on_a_hilltop_to_where_a_period_multiplies_by_1e11():
    """The number of segments grows with the period; each time they are laid anew it goes on the same way."""
    exact = lambda w: Rotating(0.3, 0.2, 2.0, w, 0.1, -1.0)
    hilltop = CIRCLE.evolve(d=0.2, F=2.0, w=0.3, k=-1.0)
    found = response_curve(hilltop, exact(0.3).start, of_w, "w", (0.18, 1.0), psi.constant(), 0.1)
    assert (*found.ends, found.values.min(), found.values.max()) == ("span", "span", 0.18, 1.0)
    for w, amplitude, values in zip(found.values, found.amplitude[:, 0], found.multipliers, strict=True):
        one = exact(float(w))
        assert amplitude == pytest.approx(abs(one.R), abs=1e-9)
        assert np.abs(values[:2]) == pytest.approx(np.abs(one.multipliers).max(), rel=1e-6)
    assert not found.stable.any()
    assert found.special == ()


def test_den_hartogs_diagram_and_where_it_begins_to_stick():
    """It does not stop while the force at its turn, w^2 A, is above friction; it is followed on through the stick."""
    exact = lambda w: DenHartog(0.5, 1.0, w)
    start = (0.0, 0.0, exact(0.62).amplitude, 0.3)
    found = response_curve(LINE.evolve(mu=0.5, w=0.62), start, of_w, "w", (0.55, 0.65))
    assert found.ends == ("span", "span")
    (stick,) = found.special
    onset = brentq(lambda w: w * w * exact(w).amplitude - 0.5, 0.55, 0.7, xtol=1e-14)
    assert stick.value == pytest.approx(onset, abs=1e-6)
    told = {"name": "w", "value": "0.584975", "below": "2", "above": "0"}
    assert recognise(stick.sentence) == [("sticks change", told)]
    for w, amplitude, phases in zip(found.values, found.amplitude[:, 0], found.phases, strict=True):
        assert ("slide" in phases) == (w < onset)
        if w > onset:
            assert amplitude == pytest.approx(exact(w).amplitude, abs=1e-8)
    assert not found.state0[:, 1].any()  # it stays in the line


def test_a_resonance_that_has_no_bound_is_given_up():
    found = response_curve(
        LINE.evolve(mu=0.3, w=1.5), (0.0, 0.0, DenHartog(0.3, 1.0, 1.5).amplitude, 0.3), of_w, "w", (0.9, 2.0)
    )
    assert found.ends == ("grows", "span")
    assert 1.0 < found.values.min() < 1.01


@pytest.fixture(scope="module")
def bent():
    return response_curve(DUFFING, (0.0, 0.0, 2.0, 0.3), of_w, "w", (1.4, 2.6))


def test_folds_of_a_bent_resonance(bent):
    folds = [one for one in bent.special if one.kind == "fold"]
    assert [recognise(one.sentence)[0][0] for one in folds] == ["response folds"] * 2
    low, high = sorted(one.value for one in folds)
    assert (bent.values[:-1][np.diff(bent.values) < 0.0]).size or (bent.values[1:][np.diff(bent.values) < 0.0]).size
    for w, count in ((low - 0.02, 1), (low + 0.02, 3), (high - 0.02, 3), (high + 0.02, 1)):
        assert bent.crossings(w) == count
    inside = [i for i, w in enumerate(bent.values) if low + 0.1 < w < high - 0.1]
    seen = {(round(float(bent.amplitude[i, 0]), 3), bool(bent.stable[i])) for i in inside}
    assert {stable for _, stable in seen} == {True, False}
    for i in inside[::6]:  # each is a periodic motion by itself
        w = float(bent.values[i])
        alone = periodic_motion(DUFFING.evolve(w=w), bent.state0[i], of_w(w))
        assert alone.status is PeriodicStatus.FOUND
        assert alone.state0 == pytest.approx(bent.state0[i], abs=1e-6)
        assert (alone.stability == "stable") == bent.stable[i]


def test_a_fold_is_one_at_a_loose_tolerance_too():
    """Near it values of the parameter differ by less than their error."""
    found = response_curve(DUFFING.evolve(w=2.35), (0.0, 0.0, 3.0, 0.3), of_w, "w", (2.3, 2.6), rtol=1e-6)
    (fold,) = found.special
    assert fold.kind == "fold"
    assert [found.crossings(fold.value + by) for by in (-0.02, 0.02)] == [2, 0]
    assert set(found.stable) == {True, False}


def test_folds_come_from_those_of_small_eps(bent):
    near = response_curve(DUFFING, (0.0, 0.0, 2.0, 0.3), of_w, "w", (1.4, 2.6), psi.constant(), 1e-4)
    ours, theirs = (sorted(one.value for one in curve.special if one.kind == "fold") for curve in (bent, near))
    assert theirs == pytest.approx(ours, abs=1e-6)
    assert not any(one.kind == "phases change" for one in near.special)  # for eps > 0 none has an edge


def test_a_period_is_doubled():
    found = response_curve(WELLS, (0.0, 0.0, 1.0, 0.0), of_w(1.2), "F", (0.1, 0.3))
    (doubling,) = (one for one in found.special if one.kind == "period doubling")
    assert 0.2 < doubling.value < 0.28
    assert found.stable[found.values < doubling.value - 1e-3].all()
    i = int(np.argmin(np.where(found.values > doubling.value + 2e-3, found.values, np.inf)))
    F, last = float(found.values[i]), found.state0[i]
    assert not found.stable[i]
    twice = periodic_motion(WELLS.evolve(F=F), last + np.array([0.1, 0.0, 0.05, 0.0]), 2.0 * of_w(1.2))
    assert twice.found
    assert "repeats sooner" not in [key for key, _ in recognise(twice.reason)]
    assert recognise(doubling.sentence)[0][0] == "doubles"


def test_a_torus_branches_off():
    """By averaging, x ~ a cos(w t + phi) loses its stability where a^2 = 2, if it is far from resonance."""
    found = response_curve(VAN_DER_POL, (0.0, 0.0, 1.5, 0.0), of_w(1.1), "F", (0.1, 0.6))
    torus = [one for one in found.special if one.kind == "Neimark-Sacker"]
    assert len(torus) == 1
    i = int(np.abs(found.values - torus[0].value).argmin())
    assert found.amplitude[i, 0] ** 2 == pytest.approx(2.0, abs=0.2)
    assert found.stable[found.values > torus[0].value + 0.02].all()
    assert not found.stable[found.values < torus[0].value - 0.02].any()
    assert recognise(torus[0].sentence)[0][0] == "becomes a torus"


def test_real_pairs_are_no_torus_and_a_branch_is_no_fold():
    pairs = KINDS_OF_CHANGE["Neimark-Sacker"]
    assert pairs(np.array([1.1 + 0.0j, 0.9])) * pairs(np.array([1.2 + 0.0j, 0.9])) < 0.0
    row = lambda value, *of: SimpleNamespace(
        value=value, period=1.0, multipliers=np.array(of, complex), phases=("slip",)
    )
    assert change_point("w", "Neimark-Sacker", row(0.5, 2.0, 0.5), row(0.4), row(0.6)) is None
    through = change_point("w", "fold", row(0.5, 1.0), row(0.4), row(0.6), turns=False)
    turning = change_point("w", "fold", row(0.5, 1.0), row(0.4), row(0.45), turns=True)
    assert (through.kind, turning.kind) == ("branch point", "fold")
    assert recognise(through.sentence)[0][0] == "branches off"


@pytest.mark.parametrize(
    ("eps", "key", "i", "fastest"),
    [(0.0, "leine-block", 2, 0.4), (0.0, "leine-block", 2, 0.9), (1e-2, "leine-block-regularised", 1, 0.9)],
)
def test_leines_cycle_along_the_speed_of_its_belt(eps, key, i, fastest):
    """Without a clock: the period is an unknown. What sticks forgets everything."""
    block = System(U=("-z1 - c/(1 + 3*abs(x))", "-s"), W=("x + v",), parameters={"v": 0.2})
    found = response_curve(block, (-0.3, 0.0, 0.9), 11.0, "v", (0.15, fastest), psi.constant(), eps)
    assert found.ends == ("span", "span")
    assert float(found.period[found.values == 0.2][0]) == pytest.approx(
        reference.catalogue[key].values[i].value, abs=1e-8
    )
    order = np.argsort(found.values)
    assert (np.diff(found.period[order]) < 0.0).all()
    assert found.stable.all()
    if eps == 0.0:
        assert not found.multipliers.any()
        assert [recognise(one.sentence)[0][0] for one in found.special] == ["passages change"] * (fastest > 0.7)


def test_what_is_refused():
    start = Rotating(0.3, 0.0, 0.5, 2.0).start
    with pytest.raises(ValueError, match="two numbers about it"):
        response_curve(CIRCLE, start, of_w, "w", (2.5, 3.0))
    with pytest.raises(ValueError, match="along is 'q'"):
        response_curve(CIRCLE, start, of_w, "q", (1.0, 3.0))
    with pytest.raises(ValueError, match="one of a family"):  # it sticks for ever, anywhere
        response_curve(LINE.evolve(mu=2.0), (0.0, 0.0, 0.1, 0.0), of_w(0.6), "mu", (1.5, 2.5))
