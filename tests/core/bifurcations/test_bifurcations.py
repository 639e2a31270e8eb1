"""Bifurcation curves and regions against the solvers, brute force, 50-digit normal forms and simulated cycles."""

import math
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from codim2_core import ELinear, bifurcations, classify, critical_sets, equator_equilibria, psi
from codim2_core.bifurcations.geometry import Geometry
from codim2_core.layer_problem.linearisation import determinant_sign
from codim2_core.layer_problem.lyapunov import first_lyapunov, psi_derivatives
from tests.core.strategies import coefficient

matrices = st.tuples(coefficient, coefficient, coefficient)
families = st.one_of(
    st.sampled_from([psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.custom("1/(1+s)**2")]),
    st.integers(1, 6).map(psi.hill),
)
CASE3 = (172.0, 186.0, -200.0)


def contains(loop, point):
    x, y = loop[:, 0] - point[0], loop[:, 1] - point[1]
    nx, ny = np.roll(x, -1), np.roll(y, -1)
    spans = (y > 0.0) != (ny > 0.0)
    right = x - y * (nx - x) / np.where(spans, ny - y, 1.0) > 0.0
    return bool((spans & right).sum() % 2)


def distance(found, f):
    """From f to the nearest border of a region: a polygon is not quite the curve."""
    start = np.concatenate([np.zeros((1, 2)), *(loop for r in found for loop in r.boundary)])
    step = np.concatenate([np.zeros((1, 2)), *(np.roll(x, -1, axis=0) - x for r in found for x in r.boundary)])
    square = np.maximum((step**2).sum(axis=1), 1e-300)
    along = np.clip(((f - start) * step).sum(axis=1) / square, 0.0, 1.0)
    return float(np.hypot(*(start + along[:, None] * step - f).T).min())


def region_at(found, f):
    inside = [r for r in found if r.bounded and sum(contains(loop, f) for loop in r.boundary) % 2]
    assert len(inside) <= 1
    return inside[0] if inside else found[-1]


# The saddle-node curve and the ellipse ------------------------------------------------------------------------------


@given(matrices, st.floats(0.0, 1.0))
def test_across_the_saddle_node_curve_the_number_of_directions_changes_by_two(abd, u):
    a, b, d = abd
    curve = bifurcations.saddle_node(*abd)
    branch = curve.branches[int(u * (len(curve) - 1e-9))]
    assume(len(branch) > 3)
    i = 1 + int(u * (len(branch) - 4))
    f, along = branch[i], branch[i + 1] - branch[i - 1]
    size, length = max(map(abs, abd)), float(np.hypot(*along))
    assume(length > 1e-4 * size)
    across = 1e-5 * size * np.array([-along[1], along[0]]) / length
    counts = [len(equator_equilibria(ELinear(a, b, d, tuple(f + sign * across)))) for sign in (-1, 1)]
    near_other = any(np.hypot(*(f - p.place)) < 1e-2 * size for p in curve.special)
    if not near_other and not (a == d == 0.0):
        assert abs(counts[0] - counts[1]) == 2


@given(matrices)
def test_cusps_are_triple_zeros(abd):
    a, b, d = abd
    for point in bifurcations.saddle_node(*abd).special:
        if point.type not in ("cusp", "pitchfork"):
            continue
        # Theta, Theta' and Theta'' vanish at the angle that the three equations give
        theta = min(Geometry(*abd).cusps, key=lambda t: math.dist(Geometry(*abd).saddle_node_at(t), point.place))
        c, s = math.cos(theta), math.sin(theta)
        f1, f2, k, size = *point.place, a - d, max(map(abs, abd))
        assert -k * s * c + f2 * c - f1 * s + b == pytest.approx(0.0, abs=1e-14 * size)
        assert -k * (c * c - s * s) - f2 * s - f1 * c == pytest.approx(0.0, abs=1e-14 * size)
        assert 4 * k * s * c - f2 * c + f1 * s == pytest.approx(0.0, abs=1e-7 * size)


def test_pitchforks_of_the_astroid_are_where_d2_says():
    curve = bifurcations.saddle_node(-1, 0, -1.5)
    assert {p.type for p in curve.special} == {"pitchfork"}
    places = sorted(np.round(p.place, 12).tolist() for p in curve.special)
    assert places == [[-0.5, 0.0], [0.0, -0.5], [0.0, 0.5], [0.5, 0.0]]
    for point in curve.special:
        found = classify(ELinear(-1, 0, -1.5, tuple(np.round(point.place, 12))), psi.constant())
        assert [d.name for d in found.degeneracies] == ["pitchfork"]


@pytest.mark.parametrize(
    ("abd", "types"),
    [
        ((-1, 0.3, -2), ["cusp"] * 4),
        ((-1, 0.5, -2), ["cusp"] * 4 + ["double saddle-node"]),
        ((-1, 0.8, -2), ["cusp"] * 4 + ["double saddle-node"] * 2),
        ((-1, -1.4, -2), ["cusp"] * 4 + ["double saddle-node"] * 2),
        ((-1, 1.5, -2), ["quadruple zero"] * 2),
        ((-1, 1.6, -2), []),
        ((-1, 1, -1), []),
        ((-1, 0, -1), ["all directions"]),
        ((0, 0, 0), ["all directions"]),
    ],
)
def test_special_points_by_b_over_k(abd, types):
    curve = bifurcations.saddle_node(*abd)
    assert sorted(p.type for p in curve.special) == sorted(types)
    for p in curve.special:
        if p.type == "double saddle-node":
            # around it each double zero splits or vanishes; where the curve touches itself one of them splits
            counts = set()
            for t in np.linspace(0, 2 * np.pi, 24, endpoint=False):
                f = np.array(p.place) + 1e-3 * np.array([np.cos(t), np.sin(t)])
                counts.add(len(equator_equilibria(ELinear(*abd, tuple(f)))))
            assert counts == ({2, 4} if abd[1] == 0.5 else {0, 2, 4})


def test_degenerate_curves_are_named():
    circle = bifurcations.saddle_node(-1, 0.5, -1)
    np.testing.assert_allclose(np.hypot(*circle.branches[0].T), 0.5, rtol=1e-14)
    assert "circle" in circle.name
    assert bifurcations.saddle_node(2, 0, 2).branches[0].tolist() == [[0.0, 0.0]]
    segment = bifurcations.critical_boundary(1, 2, -4)
    assert "segment" in segment.name
    ends = segment.branches[0]
    A = np.array([[1.0, -2.0], [2.0, -4.0]])
    assert np.hypot(*ends[1]) == pytest.approx(np.linalg.norm(A, 2))
    assert np.linalg.matrix_rank(np.column_stack([A, ends[1]]), tol=1e-12) == 1
    assert bifurcations.critical_boundary(0, 0, 0).branches[0].tolist() == [[0.0, 0.0]]
    assert "also" in bifurcations.critical_boundary(0, 1, 0).name


@given(matrices)
def test_ellipse_is_where_the_critical_set_leaves(abd):
    assume(determinant_sign(*abd) != 0)
    A = np.array([[abd[0], -abd[1]], [abd[1], abd[2]]])
    assume(np.linalg.cond(A) < 1e6)
    (branch,) = bifurcations.critical_boundary(*abd).branches
    np.testing.assert_allclose(np.hypot(*np.linalg.solve(A, branch.T)), 1.0, rtol=1e-9)
    for f in branch[::90]:
        counts = [len(critical_sets(ELinear(*abd, tuple(f * r)), psi.constant())) for r in (1 - 1e-7, 1 + 1e-7)]
        assert counts == [1, 0]


@given(matrices)
@example((2.0, 1.0, -2.0))  # touching points that lie on the grid
def test_all_meetings_of_the_two_curves_are_found(abd):
    plane = Geometry(*abd)
    A = np.array([[abd[0], -abd[1]], [abd[1], abd[2]]])
    assume(determinant_sign(*abd) != 0 and np.linalg.cond(A) < 100 and abd[0] * abd[2] != 0.0)
    G = lambda t: (np.linalg.solve(A, plane.saddle_node(np.asarray(t)).T) ** 2).sum(axis=0) - 1  # noqa: E731
    for t in (*plane.crossing, *plane.touching):
        assert G(t) == pytest.approx(0.0, abs=1e-9)
    values = G(np.linspace(0.0, 2 * np.pi, 4001))
    signs = np.sign(values[np.abs(values) > 1e-12])  # a grid point on a touching point has the sign of its rounding
    found = sorted(plane.crossing)
    apart = min((b - a for a, b in pairwise([*found, found[0] + 2 * np.pi])), default=1.0) if found else 1.0
    assume(apart > 4e-3 and not plane.cusps_on_ellipse)
    assert (signs[1:] * signs[:-1] < 0).sum() == len(found)


# Regions ------------------------------------------------------------------------------------------------------------

TYPICAL = [
    (-1, 1, -1), (-2, 0, -1), (-1, 0.3, -2.5), (1, 0.3, -1), (1, 1.2, -1.2), CASE3, (-1, 0, -1), (0, 1, 0),
    (1, 1, -1), (0, 1, -1), (-2, 0.4, 0), (-1, 1.5, -2), (-1, 0.5, -2), (-1, 0.7, -2), (1, 3 * math.sqrt(2), -2),
    (0, 0, 0), (1, 0, 0), (-1, 0, -1.5),
]  # fmt: skip


@pytest.mark.parametrize("abd", TYPICAL)
def test_regions_agree_with_classification_of_random_points(abd):
    found = bifurcations.regions(*abd)
    rng = np.random.default_rng(7)
    extent = 1.2 * max((float(abs(loop).max()) for r in found for loop in r.boundary), default=1.0)
    hit = set()
    for f in rng.uniform(-extent, extent, (600, 2)):
        if distance(found, f) < 2e-3 * extent:
            continue
        region = region_at(found, f)
        assert classify(ELinear(*abd, tuple(f)), psi.constant()).name == region.name
        hit.add(id(region))
    areas = {id(r): region_area(r) for r in found if r.bounded}
    assert all(key in hit for key, area in areas.items() if area > 0.03 * extent**2)


def region_area(region):
    loops = region.boundary
    return sum(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)) for x, y in (loop.T for loop in loops))


@settings(max_examples=120)
@given(matrices, st.integers(0, 2**32 - 1))
def test_regions_of_random_matrices(abd, seed):
    size = max(map(abs, abd))
    # Below 1e-6 of the rest a or d counts as 0 and the sliver |A^-1 f| < 1 is no region: a point inside may lie on it.
    assume(all(v == 0.0 or abs(v) > 2e-6 * size for v in (abd[0], abd[2])))
    found = bifurcations.regions(*abd)
    extent = 1.2 * max((float(abs(loop).max()) for r in found for loop in r.boundary), default=1.0)
    system = ELinear(*abd)
    for r in found:
        if region_area(r) > 1e-3 * size**2:  # the polygons of slivers may overlap, by the distance of chord and arc
            assert region_at(found, r.inside) is r
        assert r.name == classify(system.evolve(f=r.inside), psi.rational()).name
    for f in np.random.default_rng(seed).uniform(-extent, extent, (25, 2)):
        if distance(found, f) > 2e-3 * extent:
            assert classify(system.evolve(f=tuple(f)), psi.constant()).name == region_at(found, f).name


@given(matrices)
def test_regions_are_symmetric_and_fill_the_plane(abd):
    found = bifurcations.regions(*abd)
    size = max(map(abs, abd), default=1.0)
    assert not found[-1].bounded
    assert sum(not r.bounded for r in found) == 1
    # f -> -f with e -> -e: every region has a mirror image of the same name, or is its own
    for name in {r.name for r in found}:
        bounded = sorted(region_area(r) for r in found if r.name == name and r.bounded)
        assert all(a > 0 for a in bounded)
    # what lies inside the outermost border is the sum of the bounded regions
    outside = sum(abs(region_area_of(loop)) for loop in found[-1].boundary)
    assert outside == pytest.approx(sum(region_area(r) for r in found if r.bounded), abs=1e-4 * size**2)


def region_area_of(loop):
    x, y = loop.T
    return 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))


@pytest.mark.parametrize("small", [1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 1e-12])
def test_close_to_degenerate_matrices_nothing_is_classified_wrongly(small):
    first = [(small, 1, -1), (1, 1, -small), (small, 3, -small), (small, 3, small), (-1, 0.5 + small, -2)]
    second = [(-1, 1.5 - small, -2), (-2, small, -1), (-2, 0, -1 - small), (1, 1 + small, -1), (-1, small, -1)]
    for abd in first + second:
        found = bifurcations.regions(*abd)
        border = np.concatenate([loop for r in found for loop in r.boundary])
        extent = 1.2 * float(abs(border).max())
        for f in np.random.default_rng(3).uniform(-extent, extent, (60, 2)):
            if distance(found, f) > 2e-3 * extent:
                assert classify(ELinear(*abd, tuple(f)), psi.constant()).name == region_at(found, f).name


def test_the_pinched_annulus_of_cusps_on_the_ellipse_is_two_regions():
    assert sorted(r.name for r in bifurcations.regions(-2, 0, -1)) == ["CM2", "CM2", "CM4", "NCM2"]


def test_input_is_checked_and_results_are_read_only():
    with pytest.raises(ValueError, match="finite"):
        bifurcations.regions(math.nan, 0, 1)
    with pytest.raises(ValueError, match="psi is 3"):
        bifurcations.hopf(*CASE3, 3)
    with pytest.raises(ValueError, match="psi is None"):
        bifurcations.node_focus(*CASE3, None)
    curve = bifurcations.saddle_node(-1, 0.3, -2)
    with pytest.raises(ValueError, match="read-only"):
        curve.branches[0][0, 0] = 1.0


# Hopf and node-focus ------------------------------------------------------------------------------------------------


@settings(max_examples=60)
@given(matrices, families)
def test_trace_and_discriminant_vanish_on_their_curves(abd, regularisation):
    curves = bifurcations.hopf(*abd, regularisation), bifurcations.node_focus(*abd, regularisation)
    for curve in curves:
        for branch in curve.branches:
            for f in branch[2:-2:23]:
                found = critical_sets(ELinear(*abd, tuple(f)), regularisation)
                if not found or np.hypot(*found[0].e) > 0.99 or abs(found[0].jacobian).max() == 0.0:
                    continue
                C, size = found[0], np.abs(found[0].jacobian).max()
                value = C.trace / size if curve.kind == "hopf" else C.discriminant / size**2
                assert value == pytest.approx(0.0, abs=1e-8)
                assert C.determinant > 0.0


@settings(max_examples=30)
@given(st.sampled_from([CASE3, (1, 1.5, -1.2), (2, -1.4, -0.7)]), families, st.integers(0, 2**32 - 1))
def test_the_sign_of_the_trace_changes_only_across_the_hopf_curve(abd, regularisation, seed):
    curve = bifurcations.hopf(*abd, regularisation)
    A = np.array([[abd[0], -abd[1]], [abd[1], abd[2]]])
    rng = np.random.default_rng(seed)
    ends = []
    for _ in range(2):
        t, m = rng.uniform(0, 2 * np.pi), 0.97 * np.sqrt(rng.uniform())
        ends.append(m * np.array([np.cos(t), np.sin(t)]))
    path = ends[0] + np.linspace(0, 1, 120)[:, None] * (ends[1] - ends[0])
    traces = [critical_sets(ELinear(*abd, tuple(-A @ e)), regularisation)[0].trace for e in path]
    e_curve = [-np.linalg.solve(A, b.T).T for b in curve.branches]
    crossings = 0
    for branch in e_curve:
        side = (branch - ends[0]) @ np.array([-(ends[1] - ends[0])[1], (ends[1] - ends[0])[0]])
        span = (ends[1] - ends[0]) @ (ends[1] - ends[0])
        for i in np.flatnonzero(side[1:] * side[:-1] < 0):
            w = side[i] / (side[i] - side[i + 1])
            u = (branch[i] + w * (branch[i + 1] - branch[i]) - ends[0]) @ (ends[1] - ends[0]) / span
            crossings += 0 < u < 1
    changes = sum(a * b < 0 for a, b in pairwise(traces))
    assert crossings >= changes
    assert (crossings - changes) % 2 == 0


def normal_form_coefficient(A, f, regularisation_mp, x0):
    """First Lyapunov coefficient by the planar formula with partial derivatives, in 30 digits."""
    with mpmath.workdps(40):

        def U(x, y):
            r = mpmath.sqrt(x * x + y * y + regularisation_mp(x * x + y * y))
            return (A[0, 0] * x / r + A[0, 1] * y / r + f[0], A[1, 0] * x / r + A[1, 1] * y / r + f[1])

        x0 = mpmath.findroot(lambda x, y: U(x, y), tuple(map(mpmath.mpf, x0)))
        J = mpmath.matrix([[mpmath.diff(lambda x, y, i=i: U(x, y)[i], tuple(x0), n) for n in ((1, 0), (0, 1))]
                           for i in range(2)])  # fmt: skip
        w = mpmath.sqrt(mpmath.det(J))
        # columns Re q, -Im q of the eigenvector: (u, v)' = [[0, -w], [w, 0]] (u, v) + ...
        P = mpmath.matrix([[J[0, 1], 0], [-J[0, 0], -w]])
        Q = P**-1

        def G(u, v):
            x = P * mpmath.matrix([u, v])
            return Q * mpmath.matrix(U(x0[0] + x[0], x0[1] + x[1]))

        D = lambda i, n: mpmath.diff(lambda u, v: G(u, v)[i], (0, 0), n)  # noqa: E731
        Jc = Q * J * P
        sign = mpmath.sign(Jc[1, 0])  # with (u, v)' = [[0, -w], [w, 0]] the formula holds; else mirror
        w = sign * w
        F = {n: D(0, n) for n in ((2, 0), (1, 1), (0, 2), (3, 0), (1, 2))}
        H = {n: D(1, n) for n in ((2, 0), (1, 1), (0, 2), (2, 1), (0, 3))}
        sixteen = (
            F[3, 0] + F[1, 2] + H[2, 1] + H[0, 3]
            + (F[1, 1] * (F[2, 0] + F[0, 2]) - H[1, 1] * (H[2, 0] + H[0, 2])) / w
            + (F[0, 2] * H[0, 2] - F[2, 0] * H[2, 0]) / w
        )  # fmt: skip
        # r' = (sixteen/16) r^3 in these coordinates; |x| of the vector q = P (1, -i)/2 normalised to length 1
        scale = 2 / sum(abs(P[i, j]) ** 2 for i in range(2) for j in range(2))
        return float(sixteen / 16 * scale * 2 / abs(w)), float(abs(w))


@pytest.mark.parametrize(
    ("regularisation", "formula"),
    [
        (psi.constant(), lambda s: mpmath.mpf(1)),
        (psi.rational(), lambda s: 1 / (1 + s)),
        (psi.exponential(), lambda s: mpmath.exp(-s)),
        (psi.tanh(), lambda s: s / mpmath.sinh(mpmath.sqrt(s)) ** 2),
        (psi.hill(3), lambda s: 3 / (3 + (4 * s) ** 3)),
        (psi.custom("1/(1+s)**2"), lambda s: 1 / (1 + s) ** 2),
    ],
)
def test_first_lyapunov_coefficient_is_that_of_the_planar_normal_form(regularisation, formula):
    a, b, d = 1.0, 1.5, -1.2
    A = np.array([[a, -b], [b, d]])
    curve = bifurcations.hopf(a, b, d, regularisation)
    for branch, values in zip(curve.branches, curve.values, strict=True):
        for i in (60, 150):
            f = branch[i]
            (C,) = critical_sets(ELinear(a, b, d, tuple(f)), regularisation)
            expected, _ = normal_form_coefficient(A, f, formula, C.x2)
            assert values[i] == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("regularisation", [psi.constant(), psi.rational(), psi.hill(3)])
def test_small_orbits_on_the_hopf_curve_shrink_or_grow_as_the_coefficient_says(regularisation):
    a, b, d = 1.0, 1.5, -1.2
    A = np.array([[a, -b], [b, d]])
    curve = bifurcations.hopf(a, b, d, regularisation)
    for branch, values in list(zip(curve.branches, curve.values, strict=True))[:2]:
        for i in (80, 130, 200):
            f = branch[i]
            (C,) = critical_sets(ELinear(a, b, d, tuple(f)), regularisation)

            def field(_, x, f=f):
                return A @ x / math.sqrt(x @ x + regularisation(float(x @ x))) + f

            omega = math.sqrt(C.determinant)
            # in the eigenbasis a circle of radius r comes back as r (1 + 2 pi l1 r^2 |q|...): the sign is what counts
            _, vectors = np.linalg.eig(C.jacobian)
            q = vectors[:, 0]
            start = C.x2 + 0.02 * np.real(q)
            across = np.array([-np.real(q)[1], np.real(q)[0]])

            def returns(_, x, C=C, across=across):
                return float((x - C.x2) @ across)

            returns.direction = np.sign(across @ (C.jacobian @ np.real(q)))
            options = {"rtol": 1e-12, "atol": 1e-14, "events": returns, "method": "DOP853"}
            found = solve_ivp(field, (0, 8.5 * np.pi / omega), start, **options)
            radius = np.hypot(*(found.y_events[0] - C.x2).T)
            radius = radius[radius > 0.005]
            last = [r for r in radius if abs(r - 0.02) < 0.01][-1]
            assert np.sign(last - np.hypot(*(0.02 * np.real(q)))) == np.sign(values[i])


def test_generalised_hopf_points_are_zeros_of_the_coefficient():
    curve = bifurcations.hopf(*CASE3, psi.rational())
    A = np.array([[172.0, -186.0], [186.0, -200.0]])
    assert len(curve.special) == 4
    largest = max(float(abs(v).max()) for v in curve.values)
    for point in curve.special:
        assert point.type == "generalised Hopf"
        (C,) = critical_sets(ELinear(*CASE3, point.place), psi.rational())
        assert C.trace == pytest.approx(0.0, abs=1e-7)
        assert first_lyapunov(A, psi.rational(), C.x2[None])[0] == pytest.approx(0.0, abs=1e-7 * largest)


@given(families, st.floats(1e-3, 12.0))
def test_derivatives_of_psi(regularisation, s):
    formula = {
        "constant": lambda v: mpmath.mpf(1) + 0 * v,
        "rational": lambda v: 1 / (1 + v),
        "exponential": lambda v: mpmath.exp(-v),
        "tanh": lambda v: v / mpmath.sinh(mpmath.sqrt(v)) ** 2,
        "hill": lambda v: 3 / (3 + (4 * v) ** int(regularisation.parameter)),
        "custom": lambda v: 1 / (1 + v) ** 2,
    }[regularisation.family]
    found = psi_derivatives(regularisation, np.array([s]))
    with mpmath.workdps(40):
        expected = mpmath.taylor(formula, mpmath.mpf(s), 3)
    for j in (1, 2, 3):
        value = float(expected[j]) * math.factorial(j)
        # the Hill form divides by s^j
        assert found[j - 1][0] == pytest.approx(value, rel=1e-10, abs=1e-12 * max(1.0, s**-j))


def test_where_there_is_no_hopf_curve_it_says_why():
    assert not bifurcations.hopf(-1, 1, -2, psi.hill(4)).branches
    assert "Case III" in bifurcations.hopf(1, 0.1, -1, psi.constant()).sentence
    assert "everywhere" in bifurcations.hopf(0, 1, 0, psi.constant()).name
    reversible = bifurcations.hopf(1, 2, -1, psi.constant())
    assert "reversible" in reversible.sentence
    assert all((v == 0.0).all() for v in reversible.values)


def test_case_three_changes_at_284_129_and_two_more():
    found = bifurcations.hill_changes(ELinear(*CASE3, (-86, -93)))
    assert [c.type for c in found] == ["node-focus", "Hopf", "node-focus"]
    assert found[1].n == pytest.approx(284 / 129, abs=1e-12)
    # (-71 + 32.25 n)^2 = 4 (147 + 36.75 n)
    with mpmath.workdps(30):
        p, q, r = mpmath.mpf("32.25") ** 2, -2 * 71 * mpmath.mpf("32.25") - 147, mpmath.mpf(71) ** 2 - 588
        root = mpmath.sqrt(q * q - 4 * p * r)
        roots = [float((-q - root) / (2 * p)), float((-q + root) / (2 * p))]
    assert [found[0].n, found[2].n] == pytest.approx(roots, abs=1e-12)
    assert [found[0].before, *(c.after for c in found)] == [
        "stable node", "stable focus", "unstable focus", "unstable node",
    ]  # fmt: skip


@settings(max_examples=40)
@given(matrices, st.floats(0.05, 0.95), st.floats(0, 6.3))
def test_kinds_between_the_changes_of_n(abd, m, t):
    assume(determinant_sign(*abd) > 0)
    A = np.array([[abd[0], -abd[1]], [abd[1], abd[2]]])
    assume(np.linalg.cond(A) < 1e4)
    system = ELinear(*abd, tuple(-A @ np.array([m * math.cos(t), m * math.sin(t)])))
    changes = bifurcations.hill_changes(system)
    edges = [0.02, *(c.n for c in changes if 0.02 < c.n < 900), 900]
    for low, high in pairwise(edges):
        if high / low < 1 + 1e-6:
            continue
        kinds = {critical_sets(system, psi.hill(low * (high / low) ** u))[0].kind for u in (0.03, 0.4, 0.97)}
        assert len(kinds) == 1
    for c in changes:
        if 0.02 < c.n < 900 and all(abs(o.n / c.n - 1) > 1e-5 for o in changes if o is not c):
            kinds = [critical_sets(system, psi.hill(c.n * (1 + s * 1e-6)))[0].kind for s in (-1, 1)]
            assert kinds == [c.before, c.after]


def test_the_cycle_of_case_three_is_born_stable_with_the_amplitude_of_the_normal_form():
    # fig:bad_sketches: a supercritical Hopf bifurcation at n = 284/129
    n = 284 / 129
    system = ELinear(*CASE3, (-86, -93))
    A, f = system.at().A, system.at().f
    (C,) = critical_sets(system, psi.hill(n))
    l1 = float(first_lyapunov(A, psi.hill(n), C.x2[None])[0])
    assert l1 < 0.0
    regularisation = psi.hill(n + 0.004)
    (near,) = critical_sets(system, regularisation)
    mu, omega = near.trace / 2, math.sqrt(near.determinant)
    z = math.sqrt(-mu / (omega * l1))
    q = np.linalg.eig(near.jacobian)[1][:, 0]
    predicted = max(np.hypot(*(2 * z * np.real(q * np.exp(1j * v)))) for v in np.linspace(0, np.pi, 200))

    def field(_, x):
        s = x[0] * x[0] + x[1] * x[1]
        return A @ x / math.sqrt(s + regularisation(s)) + f

    times = np.linspace(40, 41, 300)
    found = solve_ivp(
        field, (0, 41), near.x2 + 2 * z * np.real(q), t_eval=times, rtol=1e-8, atol=1e-10, method="DOP853"
    )
    amplitude = np.hypot(*(found.y.T - near.x2).T).max()
    assert amplitude == pytest.approx(predicted, rel=0.1)
