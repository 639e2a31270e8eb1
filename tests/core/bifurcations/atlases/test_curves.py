"""Every curve of an atlas against what is known in closed form, or by functions evaluated otherwise."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

import codim2_core as c2
from codim2_core.bifurcations.atlases.atlas import curves_over
from codim2_core.bifurcations.families.first_lyapunov import first_lyapunov
from codim2_core.portrait.layer_problem.closed_equator import equator_cycle
from codim2_core.results.words import say

PSIS = (c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(3), c2.psi.exponential(), c2.psi.custom("1/(1+s)**2"))
TAKENS = c2.System(U=("s", "mu + k*s + c**2 + c*s"), parameters={"mu": 0.0, "k": 0.0})
TWICE = say("two at once", one="saddle-node", other="saddle-node")
numbers = st.floats(-3.0, 3.0).map(lambda v: round(v, 4))


def over_f(a, b, d, psi):
    """The e-linear system typed as a general one, over the plane of f."""
    reach = 1.3 * (abs(a) + abs(b) + abs(d)) + 0.1
    system = c2.System(U=("a*c - b*s + f1", "b*c + d*s + f2"), parameters={"a": a, "b": b, "d": d, "f1": 0, "f2": 0})
    return c2.atlas(system, psi, {"f1": (-reach, reach), "f2": (-reach, reach)})


def of_kind(found, *kinds):
    return [one for one in found.curves if one.kind in kinds]


def length(lines):
    return sum(np.hypot(*np.diff(line, axis=0).T).sum() for line in lines)


def gaps(found, a, b, d, psi):
    """How far the points of each kind are from meeting what defines them, by closed forms."""
    A = np.array([[a, -b], [b, d]])
    out = {}
    for one in found.curves:
        c, s = one.places.T
        f = one.points
        if one.kind == "saddle-node":
            gap = np.abs(f - np.stack([b * s - (a - d) * c**3, (a - d) * s**3 - b * c], axis=-1)).max()
        elif one.kind == "transcritical":
            gap = np.abs(np.hypot(*(A @ np.stack([c, s]) + f.T))).max()
        elif one.kind in ("Hopf", "node-focus"):
            gap = max(traces(A, psi, np.linalg.solve(A, -place), one.kind) for place in f)
        else:
            gap = 0.0
        out[one.kind] = max(out.get(one.kind, 0.0), float(gap))
    return out


def traces(A, psi, e, kind):
    """tr J, or tr(J)^2 - 4 det J, over the tangential eigenvalue of D e_Psi."""
    modulus = math.hypot(*e)
    if modulus > 1.0 - 1e-7:
        return 0.0
    radial, tangential = psi.jacobian_factors(psi.radius(modulus))
    n = e / modulus
    t = np.array([-n[1], n[0]])
    trace = radial / tangential * (n @ A @ n) + t @ A @ t
    return abs(trace) if kind == "Hopf" else abs(trace**2 - 4.0 * radial / tangential * np.linalg.det(A))


@settings(max_examples=8, suppress_health_check=[HealthCheck.too_slow], deadline=None)
@given(numbers, numbers, numbers, st.sampled_from(PSIS))
def test_e_linear_systems_typed_as_general_ones_agree_with_the_closed_forms(a, b, d, psi):
    if min(abs(a), abs(d), abs(a - d), abs(a * d + b * b)) < 0.05:
        return
    found = over_f(a, b, d, psi)
    assert max(gaps(found, a, b, d, psi).values()) < 1e-9
    for kind, curve in (
        ("saddle-node", c2.bifurcations.saddle_node(c2.ELinear(a, b, d))),
        ("transcritical", c2.bifurcations.critical_boundary(c2.ELinear(a, b, d))),
        ("Hopf", c2.bifurcations.hopf(c2.ELinear(a, b, d), psi)),
    ):
        assert length(one.points for one in of_kind(found, kind)) == pytest.approx(length(curve.branches), rel=0.02), (
            kind
        )


def test_a_matrix_in_its_own_axes_has_the_same_curves_and_its_own_places():
    turn = 0.7
    c, s = math.cos(turn), math.sin(turn)
    R = np.array([[c, -s], [s, c]])
    A = R @ np.array([[-2.0, -0.5], [0.5, -1.0]]) @ R.T
    f = R @ (-0.3, 0.2)
    (a11, a12), (a21, a22) = A.tolist()
    entries = [[f"{a11!r} + k", a12], [a21, f"{a22!r} + k"]]
    given_ = c2.ELinear.from_matrix(entries, f.tolist(), parameters={"k": 0.0})
    found = c2.atlas(given_, c2.psi.tanh(), {"k": (-1, 1), "f1": (-2, 2)})
    assert found.curves
    for one in of_kind(found, "saddle-node", "transcritical"):
        for (k, f1), place in list(zip(one.points, one.places, strict=True))[::7]:
            at = given_.evolve(k=float(k), f1=float(f1)).at()
            assert abs(at.U(place) @ (-place[1], place[0])) < 1e-9


@pytest.mark.parametrize("psi", PSIS, ids=lambda psi: psi.family)
def test_fold_hopf_and_node_focus_of_a_system_that_is_known(psi):
    """U = (s, mu + k s + c^2 + c s): fold mu = 0, Hopf mu = -k^2, and tr J = k + c, det DU = -2c on critical sets."""
    found = c2.atlas(TAKENS, psi, {"mu": (-1.5, 0.5), "k": (-1.5, 1.5)})
    (fold,), (hopf,) = of_kind(found, "fold of critical sets"), of_kind(found, "Hopf")
    assert np.abs(fold.points[:, 0]).max() < 1e-12
    assert sorted(fold.points[[0, -1], 1]) == pytest.approx([-1.5, 1.5], abs=1e-9)
    assert np.abs(hopf.points[:, 0] + hopf.points[:, 1] ** 2).max() < 1e-12
    assert sorted(hopf.points[[0, -1], 1]) == pytest.approx([0.0, 1.0], abs=5e-6)
    for one in of_kind(found, "node-focus"):
        for (mu, k), place in zip(one.points, one.places, strict=True):
            c = math.copysign(math.sqrt(max(-mu, 0.0)), place[0])
            if -1.0 + 1e-7 < c < -1e-6:  # nearer to 0 the digits of mu do not tell those of c
                radial, tangential = psi.jacobian_factors(psi.radius(abs(c)))
                assert (k + c) ** 2 == pytest.approx(-8.0 * c * radial / tangential, abs=1e-10)
    assert {curve.kind for curve in found.curves} >= {"transcritical", "node-focus"}
    assert all(np.abs(one.points[:, 0] + 1.0).max() < 1e-12 for one in of_kind(found, "transcritical"))


def test_its_points_of_codimension_two():
    found = c2.atlas(TAKENS, c2.psi.tanh(), {"mu": (-1.5, 0.5), "k": (-1.5, 1.5)})
    (takens,) = [point for point in found.points if point.kind == "Bogdanov–Takens"]
    assert np.abs(takens.place).max() < 1e-10
    corners = [point.place for point in found.points if point.kind == "saddle-node on the equator"]
    assert min(math.dist(place, (-1.0, 1.0)) for place in corners) < 1e-10


def test_cusps_of_limit_directions_are_where_the_paper_has_them():
    a, b, d = 1.0, 0.4, -1.0
    found = over_f(a, b, d, c2.psi.constant())
    twice = math.asin(-2.0 * b / (3.0 * (a - d)))
    angles = [0.5 * v + k * math.pi for v in (twice, math.pi - twice) for k in (0, 1)]
    expected = [
        (b * math.sin(t) - (a - d) * math.cos(t) ** 3, (a - d) * math.sin(t) ** 3 - b * math.cos(t)) for t in angles
    ]
    cusps = [point.place for point in found.points if point.kind == "cusp"]
    assert len(cusps) == len(expected) == 4
    assert all(min(math.dist(place, other) for other in expected) < 1e-9 for place in cusps)


def test_first_lyapunov_coefficients_and_where_they_vanish():
    a, b, d, psi = 172.0, 186.0, -200.0, c2.psi.hill(2)
    curve = c2.bifurcations.hopf(c2.ELinear(a, b, d), psi)
    found = c2.atlas(c2.ELinear(a, b, d, (-86, -93)), psi, {"f1": (-300, 300), "f2": (-300, 300)})
    for one in of_kind(found, "Hopf"):
        A = np.array([[a, -b], [b, d]])
        for place, number in list(zip(one.points, one.numbers, strict=True))[2:-2:5]:
            e = -np.linalg.solve(A, place)
            modulus = math.hypot(*e)
            x2 = e / modulus * psi.radius(modulus)
            assert number == pytest.approx(float(first_lyapunov(A, psi, x2[None])[0]), rel=1e-6, abs=1e-9)
    mine = sorted(point.place for point in found.points if point.kind == "generalised Hopf")
    theirs = sorted(point.place for point in curve.special if point.type == "generalised Hopf")
    assert len(mine) == len(theirs)
    assert np.allclose(mine, theirs, rtol=0.0, atol=1e-6)


def test_the_curve_of_a_neutral_equator():
    a, b, d = -1.0, 2.0, 1.3
    found = over_f(a, b, d, c2.psi.tanh())
    curves = of_kind(found, "neutral equator")
    assert curves
    for one in curves:
        for f in one.points[1:-1]:
            cycle = equator_cycle(c2.ELinear(a, b, d, tuple(f)))
            assert cycle is not None
            assert abs(cycle.exponent) < 1e-8 * cycle.period
    # it ends where a critical set and two limit directions meet on the equator, or where two pairs of these do
    corners = [point.place for point in found.points if point.kind == "saddle-node on the equator"]
    doubles = [point.place for point in found.points if point.sentence == TWICE]
    ends = [end for one in curves for end in one.points[[0, -1]]]
    assert all(min(math.dist(end, place) for place in corners + doubles) < 1e-9 for end in ends)
    assert {min(math.dist(end, place) for place in doubles) < 1e-9 for end in ends} == {True, False}
    for line in c2.bifurcations.closed_equator(c2.ELinear(a, b, d)).branches:
        for f in line[::6]:
            assert min(np.hypot(*(one.points - f).T).min() for one in curves) < 0.2


def test_pitchforks_of_the_spinning_disc():
    """The radii of gyration 1/2 and sqrt(2/3) of the literature, whatever mu."""
    found = c2.atlas(c2.examples.spinning_disc(), c2.psi.constant(), {"k": (0.3, 1), "mu": (0.05, 1)})
    assert {one.kind for one in found.curves} == {"pitchfork"}
    values = sorted(float(one.points[0, 0]) for one in found.curves)
    assert values == pytest.approx([0.5, math.sqrt(2.0 / 3.0)], abs=1e-9)
    assert all(np.ptp(one.points[:, 0]) < 1e-9 for one in found.curves)


def test_a_system_quadratic_in_e():
    system = c2.System(U=("mu*c**2 - c + s/3 - 0.2", "-s + k*c*s + 0.3*c"), parameters={"mu": 1.0, "k": 1.0})
    psi = c2.psi.rational()
    found = c2.atlas(system, psi, {"mu": (-3, 3), "k": (-3, 3)})
    for one in of_kind(found, "transcritical"):
        for (mu, k), (c, s) in zip(one.points[::6], one.places[::6], strict=True):
            assert np.abs(system.evolve(mu=mu, k=k).at().U((c, s))).max() < 1e-12

            def through(v, k=k, at=(c, s)):
                return float(system.evolve(mu=v, k=k).at().U(at)[0])

            assert mu == pytest.approx(brentq(through, mu - 0.5, mu + 0.5, xtol=1e-14), abs=1e-9)
    for one in of_kind(found, "fold of critical sets"):
        for (mu, k), p in zip(one.points[1:-1:6], one.places[1:-1:6], strict=True):
            zeta = math.hypot(*p) / math.sqrt(1.0 - p @ p)
            e = p / math.hypot(*p) * psi.modulus(zeta)
            at = system.evolve(mu=mu, k=k).at()
            assert np.abs(at.U(e)).max() < 1e-9
            assert abs(np.linalg.det(at.DU(e))) < 1e-9
    # where saddle-nodes are, limit directions are counted on both sides
    for one in of_kind(found, "saddle-node"):
        i = len(one.points) // 2
        along = one.points[i + 1] - one.points[i - 1]
        normal = 2e-3 * np.array([-along[1], along[0]]) / math.hypot(*along)
        counts = [
            len(c2.equator_equilibria(system.evolve(mu=mu, k=k)))
            for mu, k in (one.points[i] + normal, one.points[i] - normal)
        ]
        assert abs(counts[0] - counts[1]) == 2


def test_where_a_symmetry_splits_a_critical_set_into_three():
    """U is odd in c: critical sets with c = 0 lie at s = 1/5, and split where mu + k/5 = 0."""
    system = c2.System(U=("c*(mu + k*s - c**2)", "1/5 - s + c**2/3"), parameters={"mu": 0.5, "k": 0.3})
    found = c2.atlas(system, c2.psi.tanh(), {"mu": (-1, 1), "k": (-2, 2)})
    (curve,) = of_kind(found, "pitchfork of critical sets")
    assert np.abs(curve.points @ (1.0, 0.2)).max() < 1e-9
    assert np.abs(np.ptp(curve.points, axis=0) - (0.8, 4.0)).max() < 1e-9
    assert not of_kind(found, "fold of critical sets")
    assert found.unfinished == ()
    assert not found.looked.unlike
    assert np.abs(curve.numbers + 1.0).max() == 0.0  # tr DU = -1 there: T = -1 + bend s^2, by Psi = tanh above -1


@pytest.mark.parametrize("n", [2.0, 3.0, 4.0])
def test_nothing_crosses_where_curves_end_at_one_place_of_the_equator(n):
    """At f and at -f the same happens: what ends at a saddle-node on the equator crosses nothing there."""
    found = curves_over(c2.ELinear(172, 186, -200), c2.psi.hill(n), "f1", "f2", ((-400, 400), (-400, 400)))
    of = {kind: np.array([p.place for p in found.points if p.kind == kind]).reshape(-1, 2) for kind in
          ("crossing", "saddle-node on the equator")}  # fmt: skip
    corners, crossed = of["saddle-node on the equator"], of["crossing"]
    assert len(corners) >= 2
    assert np.abs(crossed[:, None] - corners).max(axis=2).min() > 1e-2
    assert np.abs(crossed[:, None] + crossed).max(axis=2).min(axis=1).max() < 1e-4
