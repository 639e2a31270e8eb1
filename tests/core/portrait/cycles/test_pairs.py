"""Cycles close together: next to folds, in tongues next to cusps, near C; held against brute force."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, System, psi
from codim2_core.portrait.cycles.cycle_search import unresolved_intervals
from codim2_core.portrait.cycles.limit_cycles import limit_cycles

# (a, b, d), f, n of the Hill family, and how many cycles: each was missed by samples judged by their heights
MISSED = [
    ((-0.4902411495421009, -0.8112187473479301, 0.4224017699157944), (-0.0886254691981483, 0.26872945922028), 6, 2),
    ((0.12726841122583082, -1.18719452785014, -0.5793015965026732), (-1.0450119219070992, 0.07895443583277581), 3, 3),
    ((-1.5482872038332172, -2.4277789178008744, 1.631950389317028), (0.22187452725901338, 0.28654129415234203), 10, 2),
]


def found(abd, f, n):
    return limit_cycles(ELinear(*abd, f), psi.hill(n))


@pytest.mark.parametrize(("abd", "f", "n", "count"), MISSED)
def test_pairs_and_triples_that_were_missed(abd, f, n, count):
    cycles = found(abd, f, n)
    assert len(cycles) == count
    kinds = [cycle.stable for cycle in cycles]
    assert all(one != other for one, other in pairwise(kinds))
    assert "all" not in cycles.reason.split()
    assert "not proved" in cycles.reason


# f on both sides of a fold of `MISSED`, to 20 bisections: no cycle before it and two behind, by brute force
FOLDS = {
    0: ((-0.08858267324404355, 0.2685996936607017), (-0.08858267441090892, 0.2685996971988618)),
    2: ((0.22092215551003694, 0.28531134749358356), (0.22092217605344272, 0.2853113740244979)),
}


@pytest.mark.parametrize("which", FOLDS)
@pytest.mark.parametrize("distance", [1e-2, 1e-4, 1e-6])
def test_both_sides_of_a_fold(which, distance):
    abd, _, n, _ = MISSED[which]
    low, high = map(np.array, FOLDS[which])
    along = distance * low / np.hypot(*np.linalg.solve([[abd[0], -abd[1]], [abd[1], abd[2]]], low))
    outside, inside = (low - along, high + along) if np.hypot(*high) > np.hypot(*low) else (low + along, high - along)
    assert len(found(abd, tuple(outside), n)) == 0
    assert len(found(abd, tuple(inside), n)) == 2


# (a, b, d), f, n and how many cycles brute force found: sign changes of the return map of a plain integrator
COUNTED = [
    ((1.906, -4.057, -2.251), (2.966, -1.255), 2, 0), ((1.982, 2.386, -2.713), (2.55, 2.98), 1, 0),
    ((0.707, -1.76, -0.725), (-0.078, 0.455), 6, 2), ((1.8, -3.195, -1.828), (0.678, -0.103), 4, 2),
    ((2.114, 3.882, -2.026), (-1.276, 0.077), 4, 1), ((2.604, -5.814, -2.654), (-3.433, 0.511), 6, 1),
    ((2.409, -5.534, -2.66), (-1.731, 0.119), 6, 2), ((2.412, -2.458, -2.412), (0.079, -0.085), 2, 2),
]  # fmt: skip


@pytest.mark.parametrize(("abd", "f", "n", "count"), COUNTED)
def test_as_many_as_brute_force_found(abd, f, n, count):
    assert len(found(abd, f, n)) == count


@pytest.mark.parametrize("gap", [1e-2, 1e-3, 1e-4, 3e-5])
@pytest.mark.parametrize(
    ("where", "p"), [(0.05, psi.hill(3)), (0.4, psi.constant()), (0.8, psi.tanh()), (0.8, psi.hill(3))], ids=str
)
def test_a_pair_of_a_typed_system(gap, where, p):
    """Circles |e|^2 = where and where + gap, whatever Psi: multipliers from r' = r (where - r^2)(where + gap - r^2)."""
    factor = f"({where!r} - c**2 - s**2)*({where + gap!r} - c**2 - s**2)"
    cycles = limit_cycles(System(U=(f"-s + c*{factor}", f"c + s*{factor}")), p)
    assert [cycle.kind for cycle in cycles] == ["stable", "unstable"]
    for cycle, square in zip(cycles, (where, where + gap), strict=True):
        zeta = p.radius(math.sqrt(square))
        assert np.hypot(*cycle.points.T) == pytest.approx(zeta / math.hypot(1.0, zeta), abs=3e-6)


def test_a_double_cycle_is_one_semistable_cycle():
    factor = "(0.4 - c**2 - s**2)**2"
    (cycle,) = limit_cycles(System(U=(f"-s + c*{factor}", f"c + s*{factor}")), psi.tanh())
    assert cycle.kind == "semistable"


@settings(max_examples=20)
@given(
    st.lists(st.integers(-50, 50).map(lambda k: 0.02 * k), min_size=4, max_size=4),
    st.lists(st.floats(0.02, 0.5), min_size=11, max_size=11),
)
def test_a_resolved_interval_hides_no_zero(coefficients, gaps):
    """Of cubics, which four samples determine: a resolved interval has the zeros its ends ask for, and no other."""
    q = np.cumsum([-2.0, *gaps])
    cubic = np.polynomial.Polynomial(coefficients)
    shift = cubic(q)
    doubtful = unresolved_intervals(q, shift, np.full(len(q), 1e-9))
    roots = [z.real for z in cubic.roots() if abs(z.imag) < 1e-12]
    for i in range(len(q) - 1):
        inside = sum(q[i] < z < q[i + 1] for z in roots)
        if i not in doubtful and np.abs(shift[i : i + 2]).min() > 1e-9:
            assert inside == ((shift[i] < 0.0) != (shift[i + 1] < 0.0))


def test_uneven_samples_of_a_parabola_below_zero_between_them():
    """Heights fall to the last sample on one side and rise from the first on the other: slopes tell of the zeros."""
    q = np.array([-3.0, -2.5, -2.0, -1.5, -1.0, -0.9, 0.4, 0.6, 1.0, 1.5])
    shift = q * q - 0.01
    assert (shift > 0.0).all()
    assert 5 in unresolved_intervals(q, shift, np.full(len(q), 1e-9))
