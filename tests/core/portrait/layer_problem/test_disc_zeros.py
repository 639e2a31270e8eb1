"""Critical sets of general systems: none is missing, each is one, J is exact, and what is degenerate has its name."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from codim2_core import critical_sets, hemisphere, psi
from codim2_core.portrait.layer_problem.disc_zeros import disc_zeros
from codim2_core.systems.typed import System
from tests.core.general_systems import ATTRACTING, polynomials, smooth, turns
from tests.core.strategies import regularisations, systems
from tests.work import calls

FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3)]


def zeros_of(*U, **parameters):
    return disc_zeros(System(U=U, parameters=parameters).at().key)


@pytest.mark.parametrize("regularisation", FAMILIES, ids=str)
def test_attracting_and_repelling_directions(regularisation):
    """eq:criticalman: x2 = +-sqrt((1 +- 2/sqrt 5) Psi(x2^2)), that is e = (1 +- sqrt 5)/4; a node and a saddle."""
    minus, plus = critical_sets(ATTRACTING, regularisation, 0.7)
    for C, sign, kind in ((minus, -1, "stable node"), (plus, 1, "saddle")):
        np.testing.assert_allclose(C.e, [(1 + sign * math.sqrt(5)) / 4, 0.0], rtol=1e-15, atol=1e-17)
        x = C.x2[0]
        assert x == pytest.approx(sign * math.sqrt((1 + sign * 2 / math.sqrt(5)) * regularisation(x * x)), rel=1e-13)
        assert C.kind == kind
        np.testing.assert_allclose(C.slow_flow, [-0.7], rtol=1e-15)
        radial, tangential = regularisation.jacobian_factors(abs(x))
        np.testing.assert_allclose(
            C.jacobian, [[(4 * C.e[0] - 1) * radial, 0], [0, -tangential]], rtol=1e-13, atol=1e-15
        )


@given(systems, regularisations)
@settings(max_examples=20)
def test_elinear_systems_written_as_text(system, regularisation):
    at = system.at()
    a, b, d, f1, f2 = at.plane
    closed = critical_sets(at, regularisation)
    typed = System(U=(f"({a!r})*c - ({b!r})*s + ({f1!r})", f"({b!r})*c + ({d!r})*s + ({f2!r})"))
    determinant, size = a * d + b * b, max(map(abs, at.plane))
    reach = math.hypot(d * f1 + b * f2, a * f2 - b * f1)
    assume(abs(determinant) > 1e-3 * size**2 and abs(reach / abs(determinant) - 1.0) > 1e-3)
    found = critical_sets(typed, regularisation)
    assert len(found) == len(closed)
    for C, exact in zip(found, closed, strict=True):
        np.testing.assert_allclose(C.e, exact.e, rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(C.p, exact.p, rtol=0.0, atol=1e-11)
        np.testing.assert_allclose(C.jacobian, exact.jacobian, rtol=0.0, atol=1e-11 * size)
        assert C.trace == pytest.approx(exact.trace, abs=1e-11 * size)
        assert C.determinant == pytest.approx(exact.determinant, abs=1e-11 * size**2)
        if abs(exact.trace) > 1e-9 * size and abs(exact.discriminant) > 1e-9 * size**2:
            assert C.kind == exact.kind


@given(st.one_of(polynomials, smooth))
@settings(max_examples=20)
def test_the_indices_add_up_to_the_turns_of_the_field(system):
    """Independent of the search and of the zeros of Theta: angles of U added up along the circle."""
    at = system.at()
    counted = turns(at)
    assume(counted is not None)
    found = disc_zeros(at.key)
    assert found.degree == counted
    if not (found.curve or found.degenerate.any()):
        assert found.proven
        assert found.consistent


@given(polynomials, st.tuples(st.floats(-0.6, 0.6), st.floats(-0.6, 0.6)), regularisations)
@settings(max_examples=20)
def test_a_zero_that_was_put_in_is_found(system, e, regularisation):
    """Subtracting the value at e makes e a zero."""
    at = system.at()
    u, v = at.U(e)
    shifted = System(U=(f"{system.U[0].text} - ({float(u)!r})", f"{system.U[1].text} - ({float(v)!r})"))
    D = shifted.at().DU(e)
    determinant = float(D[0, 0] * D[1, 1] - D[0, 1] * D[1, 0])  # LAPACK's divides by what is nearly 0
    assume(abs(determinant) > 1e-4 * np.abs(D).max() ** 2 > 0.0)
    found = critical_sets(shifted, regularisation)
    away = [np.abs(C.e - e).max() for C in found]
    nearest = int(np.argmin(away))
    assert away[nearest] < 1e-12 * shifted.at().size / np.linalg.svd(D, compute_uv=False)[1]
    C = found[nearest]
    assert (C.kind == "saddle") == (determinant < 0)
    np.testing.assert_allclose(hemisphere.flow(shifted.at(), regularisation, C.p), 0.0, atol=1e-13 * shifted.at().size)


@pytest.mark.parametrize(
    ("c", "s"),
    [
        ((-0.5, 0.1, 0.3), (-0.6, 0.2)), ((0.0, 0.25, -0.5, 0.5), (0.0, 0.3, -0.45, 0.6)), ((0.2, 0.2001), (0.0,)),
        ((0.2, 0.200001), (0.1, -0.3)), ((0.99,), (0.05,)), ((0.9999,), (0.0, 1e-4)),
    ],
)  # fmt: skip
def test_grids_of_zeros(c, s):
    found = zeros_of("*".join(f"(c - {v})" for v in c), "*".join(f"(s - {v})" for v in s))
    expected = sorted((u, v) for u in c for v in s if math.hypot(u, v) < 1)
    assert found.proven
    assert len(found.e) == len(expected)
    np.testing.assert_allclose(
        sorted(map(tuple, found.e)), expected, rtol=0.0, atol=1e-14 / min([1e-3, *np.diff(sorted(c))])
    )
    assert found.consistent


def test_fold():
    """c^2 = p: no critical set, one degenerate, two."""
    assert len(zeros_of("c**2 - p", "s - 1/7", p=-1e-9).e) == 0
    two = zeros_of("c**2 - p", "s - 1/7", p=1e-9)
    np.testing.assert_allclose(two.e[:, 0], [-math.sqrt(1e-9), math.sqrt(1e-9)], rtol=1e-9)
    assert two.index.tolist() == [-1, 1]
    one = zeros_of("c**2 - p", "s - 1/7", p=0.0)
    assert one.degenerate.tolist() == [True]
    assert one.index.tolist() == [0]
    assert one.proven
    assert one.consistent
    np.testing.assert_allclose(one.e, [[0.0, 1 / 7]], atol=1e-7)
    (C,) = critical_sets(System(U=("c**2", "s - 1/7")), psi.rational())
    assert C.kind == "saddle-node"
    assert C.determinant == 0.0


@pytest.mark.parametrize("shift", [-1e-9, 0.0, 1e-9])
def test_a_zero_on_the_equator(shift):
    found = zeros_of("(c - 0.6 - p*0.6)*(c + 2)", "s - 0.8 - p*0.8", p=shift)
    assert len(found.e) == (1 if shift < 0 else 0)
    np.testing.assert_allclose(found.on_equator, [math.atan2(0.8, 0.6)] * (shift == 0.0), rtol=0.0, atol=1e-14)
    assert (found.degree is None) == (shift == 0.0)


@pytest.mark.parametrize(
    "U", [("c*(c - s)", "s*(c - s)"), ("c + s - 1/2", "2*c + 2*s - 1"), ("c*s", "0"), ("sin(3*c - s)", "3*c - s")]
)
def test_curves_of_zeros(U):
    found = zeros_of(*U)
    assert found.curve
    assert len(found.e) == 0


@pytest.mark.parametrize(
    "U",
    [
        ("sin(400*c)*cos(300*s)", "cos(350*s*c) - sin(200*c)"),
        (
            "+".join(f"sin({k}*c)*cos({k}*s)" for k in range(1, 40)),
            "+".join(f"cos({k}*c + {k}*s)" for k in range(1, 40)),
        ),
        ("abs(abs(c) - 0.5)", "abs(s)"),
        ("(c**1000)**1000", "(s**1000)**1000"),
        ("c**2 + s**2 - 1", "c**2 + s**2 - 1"),
    ],
)
def test_wild_fields_end_in_bounded_work(U):
    assert calls(lambda: disc_zeros(System(U=U).at().key)) < 100_000


@pytest.mark.parametrize(
    ("U", "kinds"),
    [
        (("2*abs(c) + c", "s"), ["saddle-node"]),  # index 0: U1 is positive on both sides
        (("abs(c - 1/4)", "s"), ["saddle-node"]),
        (("abs(c - 3/10)*abs(c + 3/10)", "s"), ["degenerate"] * 2),  # two: the degree says nothing of either
        (("c*abs(c)", "s"), ["degenerate"]),  # index 1
        (("c**3", "s"), ["degenerate"]),
        (("c**2", "s"), ["saddle-node"]),
        (("2*c + abs(c)", "s"), ["unstable node"]),  # slopes 1 and 3
        (("-2*c + abs(c)", "-s"), ["stable node"]),
        (("-c", "s + s*abs(s)"), ["saddle"]),  # no corner: twice the slope from either side
        (("-3*c/5 + abs(c)/2 - s", "c"), ["stable focus"]),  # traces -1/10 and -11/10
        (("3*c/5 + abs(c)/2 - s", "c"), ["unstable focus"]),
        (("-c/5 + abs(c)/2 - s", "c"), ["degenerate"]),  # traces 3/10 and -7/10
        (("-(c - 1/4)/5 + abs(c - 1/4)/2 - (s - 1/8)", "c - 1/4"), ["degenerate"]),
        (
            ("-(c - 1/4)/5 - (s - 1/8)", "c - 1/4 + abs(s - 3/4)*(s - 1/8)/8"),
            ["stable focus"],
        ),  # the corner is elsewhere
        # the radial direction counts 1 - |e|^2 = 0.19 there
        (("(c - 9/10) + abs(c - 9/10)/10 - s", "2*(c - 9/10) - 3/10*s"), ["stable focus"]),
        (("11/5*(c - 9/10) + abs(c - 9/10)/10 - s", "2*(c - 9/10) - 3/10*s"), ["unstable focus"]),
    ],
)
@pytest.mark.parametrize("factor", ["1", "1e-5", "3e4"])
def test_a_critical_set_on_a_corner_has_a_kind_where_its_sides_agree(U, kinds, factor):
    system = System(U=tuple(f"{factor}*({row})" for row in U))
    assert [C.kind for C in critical_sets(system, psi.constant())] == kinds


@pytest.mark.parametrize("apart", [1e-3, 1e-4])
def test_a_fold_close_to_another_critical_set_is_one_of_its_own(apart):
    found = disc_zeros(System(U=("(c - p)**2*(c - p - q)", "s"), parameters={"p": 0.3, "q": apart}).at().key)
    np.testing.assert_allclose(found.e, [(0.3, 0.0), (0.3 + apart, 0.0)], atol=1e-2 * apart)
    assert found.degenerate.tolist() == [True, False]
    assert found.index.tolist() == [0, 1]


R = "0.25", "0.0625", "0.5625", "0.140625"  # squares in binary
EXACT_FOLDS = [
    ("c*c-c+0.25+s*s", "s"),
    ("c*c-c+0.25", "-s"),
    ("c*c-c+0.25", "s+0.125"),
    ("c*s-0.25", "c+s-1"),
    ("(c-0.125)*(c-0.125)", "s"),
    *((f"c*c+s*s-{r}", f"s-{math.sqrt(float(r))!r}") for r in R),
    *((f"c*c+s*s-{r}", f"0.1*(c+{math.sqrt(float(r))!r})") for r in R),
    *((f"c*c+s*s-{r}", f"-2*(c-{math.sqrt(float(r))!r})") for r in R),
    *((f"s*s-{2 * math.sqrt(float(r))!r}*s+{r}", "c+0.25*s") for r in R),
]


@pytest.mark.parametrize("U", EXACT_FOLDS, ids=str)
def test_a_fold_whose_formula_is_zero_in_all_digits_over_an_interval_is_one_saddle_node(U):
    """U is 0 in doubles next to its double zero, where Newton's method ends at once: no zero is proved there."""
    zeros = zeros_of(*U)
    assert zeros.degenerate.tolist() == [True]
    assert zeros.consistent
    assert [C.kind for C in critical_sets(System(U=U), psi.constant())] == ["saddle-node"]


def test_a_slider_that_meets_an_exact_fold_meets_one_critical_set():
    system = System(U=("c*c+s*s-p", "s-0.5"), parameters={"p": 0.3})
    assert [len(critical_sets(system.evolve(p=p), psi.constant())) for p in (0.2499, 0.25, 0.2501)] == [0, 1, 2]


@pytest.mark.parametrize(
    "U",
    [
        ("c**3", "s**3"),
        ("c**3", "-s**3"),
        ("c**3+s**3", "c**3-s**3"),
        ("c**5", "s**3"),
        ("c*abs(c)", "-s*abs(s)"),
        ("c**3-3*c*s*s", "3*c*c*s-s**3"),
        ("c*c-s*s", "2*c*s"),
        ("c*(c*c+s*s)", "s*(c*c+s*s)"),
        ("-s**3", "c**3"),
        ("(c-0.3)**3", "(s-0.2)**3"),
        ("c*c", "s*s"),
    ],
    ids=str,
)
def test_a_jacobian_of_zeros_is_degenerate_and_not_named_by_rounding(U):
    assert [C.kind for C in critical_sets(System(U=U), psi.constant())] == ["degenerate"]
