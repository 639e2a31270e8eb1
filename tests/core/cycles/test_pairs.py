"""Cycles close together: beside folds, in tongues beside cusps, near C; held against brute force."""

import math
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, System, psi
from codim2_core.cycles.limit_cycles import limit_cycles
from codim2_core.cycles.resolution import unresolved, zeros

from .oracle import fixed_points

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
    assert len(cycles) == count == len(fixed_points(abd, f, n))
    kinds = [cycle.stable for cycle in cycles]
    assert all(one != other for one, other in pairwise(kinds))
    assert "all" not in cycles.reason.split()
    assert "not proved" in cycles.reason


@cache
def fold(which):
    """Two values of f beside a fold, how many cycles there are at each, and the direction; by brute force alone."""
    abd, f, n, _ = MISSED[which]
    along = np.array(f) / np.hypot(*np.linalg.solve([[abd[0], -abd[1]], [abd[1], abd[2]]], f))
    steps = [f + t * along for t in np.linspace(-0.06, 0.06, 13)]
    counts = [len(fixed_points(abd, g, n)) for g in steps]
    i = next(i for i in range(12) if abs(counts[i] - counts[i + 1]) == 2)
    low, high = steps[i], steps[i + 1]
    for _ in range(20):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if len(fixed_points(abd, middle, n)) == counts[i] else (low, middle)
    return low, high, counts[i : i + 2], along


@pytest.mark.parametrize("which", [0, 2])
@pytest.mark.parametrize("distance", [1e-2, 1e-4, 1e-6])
def test_both_sides_of_a_fold(which, distance):
    abd, _, n, _ = MISSED[which]
    low, high, counts, along = fold(which)
    assert len(found(abd, tuple(low - distance * along), n)) == counts[0]
    assert len(found(abd, tuple(high + distance * along), n)) == counts[1]


@st.composite
def case_III(draw):
    unit = st.floats(0.0, 1.0)
    a, d = draw(st.floats(0.1, 3.0)), -draw(st.floats(0.1, 3.0))
    b = math.sqrt(-a * d) * (1.01 + 1.5 * draw(unit) ** 2) * draw(st.sampled_from([-1, 1]))
    r, t = 0.03 + 0.92 * draw(unit), 2 * math.pi * draw(unit)
    f = -np.array([[a, -b], [b, d]]) @ [r * math.cos(t), r * math.sin(t)]
    return (a, b, d), (float(f[0]), float(f[1])), draw(st.sampled_from([1, 2, 3, 4, 6, 10]))


@settings(max_examples=12)
@given(case_III())
def test_no_fewer_than_brute_force_finds(drawn):
    abd, f, n = drawn
    cycles = found(abd, f, n)
    if any(cycle.kind == "semistable" for cycle in cycles):
        return
    assert len(cycles) >= len(fixed_points(abd, f, n))


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
        zeta = psi_radius(p, math.sqrt(square))
        assert np.hypot(*cycle.points.T) == pytest.approx(zeta / math.hypot(1.0, zeta), abs=3e-6)


def psi_radius(p, modulus):
    low, high = 0.0, 1.0
    while p.modulus(high) < modulus:
        high *= 2.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if p.modulus(middle) < modulus else (low, middle)
    return low


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
    doubtful = unresolved(q, shift, np.full(len(q), 1e-9))
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
    assert 5 in unresolved(q, shift, np.full(len(q), 1e-9))


def test_what_is_told_from_zero_and_what_is_not():
    q = np.arange(8.0) * 0.01
    noise = np.full(8, 1e-11)
    assert zeros(q, np.array([1, 0.5, 1e-12, 0.5, 1, -1, -2, -3.0]), noise) == ([(4, 5)], [2], False)
    assert zeros(q, np.array([1, 0.5, 1e-12, -0.5, -1, -1, -2, -3.0]), noise) == ([(1, 3)], [], False)
    assert zeros(10.0 * q, np.array([1, 1e-12, 0, 0, 1e-13, 1e-13, 0, -3.0]), noise)[2]
