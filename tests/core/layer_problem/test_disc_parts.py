"""Parts of the search for critical sets, each alone: turns about a zero, slow convergence, roundings, and clusters."""

import math

import numpy as np
import pytest

from codim2_core.expressions.arrays import program
from codim2_core.layer_problem import disc_zeros as module
from codim2_core.layer_problem.disc_zeros import disc_zeros
from codim2_core.systems.typed import System


def run(*U):
    return program((System(U=U).U, ()))  # also where it has no value


def power(k, c="(c - 1/4)", s="(s + 1/8)"):
    """Real and imaginary part of (c + i s)^k."""
    terms = [(math.comb(k, j), j) for j in range(k + 1)]
    parts = [
        "+".join(f"({n * (-1) ** (j // 2)})*{c}**{k - j}*{s}**{j}" for n, j in terms if j % 2 == odd) for odd in (0, 1)
    ]
    return parts[0], parts[1]


@pytest.mark.parametrize("k", [1, 2, 3, 5])
@pytest.mark.parametrize("radius", [1e-6, 0.1])
def test_a_power_of_the_plane_turns_as_often_as_it_says(k, radius):
    re, im = power(k)
    middle = np.array([0.25, -0.125])
    assert module._turns(run(re, im), middle, radius) == k
    assert module._turns(run(re, f"-({im})"), middle, radius) == -k
    assert module._turns(run(f"1e-9*({re})", f"1e9*({im})"), middle, radius) == k  # rows of very different size
    for far, turns in ((1.5, 0), (0.5, k)):
        assert module._turns(run(re, im), middle + radius * np.array([0.0, far]), radius) == turns


def test_what_cannot_be_counted_turns_nothing():
    middle = np.zeros(2)
    assert module._turns(run("c", "0*s"), middle, 0.1) == 0
    assert module._turns(run("0*c", "s"), middle, 0.1) == 0
    assert module._turns(run("c/(c - s)", "sqrt(s)"), middle, 0.1) == 0  # not finite all around
    assert module._turns(run("cos(5000*c)*c", "sin(5000*c)"), middle, 0.5) == 0  # too fast for the samples


def test_slow_convergence_reaches_multiple_zeros_and_tells_where_there_is_none():
    starts = np.array([(0.12, -0.19), (0.08, -0.21), (0.101, -0.2)])
    ends, ok = module._least_squares(run("(c - 1/10)**2", "s + 1/5"), starts, 1.0, 0.05)
    assert ok.all()
    np.testing.assert_allclose(ends, [(0.1, -0.2)] * 3, atol=1e-6)
    ends, ok = module._least_squares(run("(c - 1/10)**2 + 1e-9", "s + 1/5"), starts, 1.0, 0.05)
    assert not ok.any()
    np.testing.assert_allclose(ends[:, 1], -0.2, rtol=0.0, atol=1e-12)  # the best that there is
    ends, ok = module._least_squares(run("c - 1/2", "s"), np.zeros((1, 2)), 1.0, 1e-4)
    assert not ok.any()
    np.testing.assert_allclose(ends, [(0.1, 0.0)])  # no further than a thousand times the reach
    ends, ok = module._least_squares(run("log(c)", "s"), np.array([(-0.5, 0.1), (0.9, 0.1)]), 1.0, 0.1)
    assert ok.tolist() == [False, True]
    np.testing.assert_allclose(ends, [(-0.5, 0.1), (1.0, 0.0)])  # where it is not defined it stays


def test_sizes_and_roundings():
    """Rounding moves a zero by what U is known to over the smaller singular value of its slopes."""
    assert module._size(run("2*c", "3*s")) == pytest.approx(0.7 * 5.0)
    assert module._size(run("1/c", "2*s")) == pytest.approx(1.0 / 0.175 + 1.4)  # what is infinite is left out
    assert module._size(run("log(-1 + 0*c)", "s")) == 0.0
    rng = np.random.default_rng(5)
    D = rng.normal(size=(50, 2, 2)) * 10.0 ** rng.uniform(-5.0, 0.0, (50, 1, 1))
    plain, unit = np.zeros(50, bool), 2.0**-53
    least = np.linalg.svd(D, compute_uv=False)[:, 1]
    blur = module._blur(D, plain, 3.0)
    expected = 16.0 * unit * np.maximum(1.0, 3.0 / least)
    assert (blur >= 0.99 * expected).all()
    assert (blur <= 1.5 * expected).all()  # sqrt 2, for taking the norm of all four for the larger one
    np.testing.assert_allclose(module._blur(1e5 * D, plain, 3e5), blur)
    np.testing.assert_allclose(module._blur(0.0 * D[:1], plain[:1], 3.0), [16.0 * unit * 1e8])
    np.testing.assert_allclose(module._blur(D[:1], ~plain[:1], 3.0), [16.0 * unit * 1e6])
    np.testing.assert_allclose(module._blur(0.0 * D[:1], plain[:1], 0.0), [16.0 * unit])


def chain(count, half, middle=(0.0, 0.0), way=(0.0, 1.0)):
    return np.array(middle) + 2.0 * half * (np.arange(count) - 0.5 * (count - 1))[:, None] * np.array(way)


def test_undecided_boxes_become_a_curve_a_zero_or_stay_undecided():
    half = 1e-4
    places, curve, left = module._undecided(run("c", "c*(2 + s)"), chain(400, half), half, 1.0)
    assert (places, curve, left) == ([], True, False)
    # as many boxes as long along a line on which U does not vanish, or does at one end only
    places, curve, left = module._undecided(run("c + 1/10", "c*(2 + s)"), chain(400, half), half, 1.0)
    assert (places, curve, left) == ([], False, True)
    for unit in ("1", "1e-8"):  # nor where all lead to one zero, in any unit of time
        regular = run(f"{unit}*(c - 1/50)", f"{unit}*(s + c)")
        assert module._undecided(regular, chain(400, half), half, float(unit)) == ([], False, True)
    # as many in one place, and few boxes, are no curve but a zero
    square = np.array([(x, y) for x in chain(16, half)[:, 1] for y in chain(16, half)[:, 1]])
    for boxes in (square, chain(9, half)):
        places, curve, left = module._undecided(run("c**2", "s + c/3"), boxes, half, 1.0)
        assert (len(places), curve, left) == (1, False, False)
        np.testing.assert_allclose(places[0], 0.0, atol=1e-6)
    # two places apart are two zeros; where there is none, something is left
    both = np.concatenate([chain(5, half, (0.3, 0.0)), chain(5, half, (-0.3, 0.0))])
    places, curve, left = module._undecided(run("(c**2 - 9/100)**2", "s"), both, half, 1.0)
    assert (sorted(p[0] for p in places), curve, left) == (pytest.approx([-0.3, 0.3], abs=5e-6), False, False)
    places, curve, left = module._undecided(run("(c - 3/10)**2", "s"), both, half, 1.0)
    assert ([p[0] for p in places], curve, left) == (pytest.approx([0.3], abs=5e-6), False, True)


def test_a_zero_without_a_slope_is_where_u_turns():
    """U = (c, s)/|e|^(1/2): no slope to follow, but it turns once; its half, which does not, stays undecided."""
    tiny = 1e-9
    boxes = chain(4, tiny, (0.2, 0.1), (1.0, 0.0))
    root = "((c - 1/5)**2 + (s - 1/10)**2 + 1e-300)**(-3/8)"
    places, curve, left = module._undecided(run(f"(c - 1/5)*{root}", f"(s - 1/10)*{root}"), boxes, tiny, 1.0)
    assert (len(places), curve, left) == (1, False, False)
    np.testing.assert_allclose(places[0], (0.2, 0.1), rtol=0.0, atol=1e-8)
    aside = boxes + np.array([3.0 * tiny, 0.0])  # the zero is in the box at the end
    places, curve, left = module._undecided(run(f"(c - 1/5)*{root}", f"(s - 1/10)*{root}"), aside, tiny, 1.0)
    assert (len(places), curve, left) == (1, False, False)
    places, curve, left = module._undecided(run(f"abs(c - 1/5)*{root} + 1e-3", f"(s - 1/10)*{root}"), boxes, tiny, 1.0)
    assert (places, curve, left) == ([], False, True)


@pytest.mark.parametrize("apart", [1e-3, 1e-4])
def test_a_fold_close_to_another_critical_set_is_one_of_its_own(apart):
    found = disc_zeros(System(U=("(c - p)**2*(c - p - q)", "s"), parameters={"p": 0.3, "q": apart}).at().key)
    np.testing.assert_allclose(found.e, [(0.3, 0.0), (0.3 + apart, 0.0)], atol=1e-2 * apart)
    assert found.degenerate.tolist() == [True, False]
    assert found.index.tolist() == [0, 1]


@pytest.mark.parametrize(
    ("U", "degenerate", "rough"),
    [
        (("2*c + abs(c)", "s"), False, False),  # a corner, one orientation
        (("c + 2*abs(c)", "s"), True, True),
        (("c**2", "s"), True, False),
        (("c*abs(c)", "s"), True, False),
        (("c", "2*s - c"), False, False),
        (("c/(c**2 + s**2)**(1/3)", "s/(c**2 + s**2)**(1/3)"), True, True),  # unbounded slopes
    ],
)
@pytest.mark.parametrize("unit", ["1", "1e-7", "1e6"])
def test_slopes_at_a_zero_say_whether_it_is_degenerate_and_rough(U, degenerate, rough, unit):
    field = run(*(f"{unit}*({row})" for row in U))
    D, found, uneven = module._slopes(field, np.zeros((1, 2)), np.ones(1, bool))
    assert (found.tolist(), uneven.tolist()) == ([degenerate], [rough])
    assert np.isfinite(D).all()
    if np.isfinite(field.at(np.zeros((1, 2)))).all():
        np.testing.assert_array_equal(D, field.at(np.zeros((1, 2)))[:, :, 1:])
        sure = module._slopes(field, np.zeros((1, 2)), np.zeros(1, bool))  # proven to be simple: nothing is asked
        assert (sure[1].tolist(), sure[2].tolist()) == ([False], [False])
