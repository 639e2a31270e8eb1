"""The atlas over any two parameters against the exact classes, the closed-form regions, and known areas."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import codim2_core as c2
from codim2_core.diagrams.class_maps.atlas import ClassMap, class_map
from codim2_core.diagrams.class_maps.line import class_line
from codim2_core.diagrams.sweep import class_name, classes, family
from codim2_core.layer_problem.vary import varied

BAD = c2.ELinear(172, 186, -200, f=(-86, -93))
PSIS = (c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(3), c2.psi.custom("1/(1+s)**2"))
numbers = st.one_of(st.floats(-2, 2).map(lambda v: round(v, 3)), st.sampled_from([-1.0, 0.0, 0.5, 1.0]))


def exact(system: object, psi: c2.Psi, z: tuple[float, ...] = ()) -> str:
    name = c2.classify(system, psi, z).name
    critical = c2.critical_sets(system, psi, z)
    return f"{name}, {critical[0].kind}" if critical else name


def holds(polygons: tuple[np.ndarray, ...], x: float, y: float) -> bool:
    """Whether a point is inside, by the number of crossings."""
    inside = False
    for ring in polygons:
        (x0, y0), (x1, y1) = ring.T, np.roll(ring, -1, axis=0).T
        crossed = (y0 > y) != (y1 > y)
        at = x0[crossed] + (y - y0[crossed]) / (y1 - y0)[crossed] * (x1 - x0)[crossed]
        inside ^= bool((at > x).sum() % 2)
    return inside


def area(M: ClassMap) -> float:
    (x0, x1), (y0, y1) = M.spans
    return (x1 - x0) * (y1 - y0)


@settings(max_examples=20, deadline=None)
@given(st.tuples(*[numbers] * 5), st.sampled_from(PSIS))
@example((0.219, 0.219, 0.219, 0.0, 0.0), PSIS[0])  # the zeros of Theta are complex, and double
def test_vectorised_classes_agree_with_the_exact_ones(plane: tuple[float, ...], psi: c2.Psi) -> None:
    a, b, d, f1, f2 = plane
    frozen = c2.ELinear(a, b, d, f=(f1, f2)).at()
    if c2.classify(frozen, psi).degeneracies:
        return
    equator = c2.equator_equilibria(frozen)
    if equator.distance < 1e-9:
        return
    # two values, so that the plane is not taken for a single system
    several = family(frozen, psi, (), "a", "b")(a=np.array([a, a + 1]), b=np.array([b, b + 1]))
    assert class_name(classes(several)[0]) == exact(frozen, psi)


def test_regions_of_the_f_plane_are_those_in_closed_form() -> None:
    a, b, d = -1.0, 0.3, -1.5
    M = class_map(c2.ELinear(a, b, d), c2.psi.constant(), ("f1", "f2"), ((-2, 2), (-2, 2)), steps=512)
    wanted = c2.bifurcations.regions(a, b, d)
    names = {r.name.split(",")[0] for r in M.regions}
    assert names == {r.name for r in wanted}
    for name in names:
        mine = sum(r.area for r in M.regions if r.name.split(",")[0] == name)
        theirs = 0.0
        for r in wanted:
            if r.name == name and r.bounded:
                for ring in r.boundary:
                    x, y = ring.T
                    theirs += 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))
        if name != "NCM2":
            # chords of a thousandth of the spans, and tips at cusps thinner than a cell
            assert mine == pytest.approx(theirs, rel=2e-3)
    for r in wanted:
        if r.bounded:
            assert sum(holds(s.boundary, *r.inside) and s.name.startswith(r.name) for s in M.regions) == 1


def test_the_ellipse_is_drawn_to_the_stated_accuracy() -> None:
    # a = d, b = 0: the ellipse is the circle |f| = 1, and there is nothing else than the point f = 0
    M = class_map(c2.ELinear(-1, 0, -1), c2.psi.tanh(), ("f1", "f2"), ((-2, 2), (-2, 2)), accuracy=1e-9)
    assert sorted(r.name for r in M.regions) == ["CM2, stable node", "NCM2"]
    assert [b.happening for b in M.boundaries] == [("transcritical",)]
    (line,) = M.boundaries[0].lines
    assert (line[0] == line[-1]).all()
    assert_allclose(np.hypot(*line.T), 1, rtol=0.0, atol=4e-9)
    assert M.regions[1].area == pytest.approx(np.pi, rel=1e-3)
    assert sum(r.area for r in M.regions) == pytest.approx(16, rel=1e-12)
    assert M.regions[1].width == pytest.approx(0.5, abs=0.05)
    assert len(M.regions[0].boundary) == 2


def test_hopf_and_node_focus_lines_along_n() -> None:
    M = class_map(BAD, c2.psi.hill(1), ("n", "a"), ((1, 4), (171.9, 172.1)))
    changes = {c.type: [] for c in c2.bifurcations.hill_changes(BAD)}
    for c in c2.bifurcations.hill_changes(BAD):
        changes[c.type].append(c.n)
    for b in M.boundaries:
        if b.happening in (("Hopf",), ("node-focus",)):
            for line in b.lines:
                at = np.interp(172.0, *(line[:, [1, 0]] if line[0, 1] < line[-1, 1] else line[::-1, [1, 0]]).T)
                assert min(abs(at - n) for n in changes[b.happening[0]]) < 1e-3
    assert {b.happening for b in M.boundaries} >= {("Hopf",), ("node-focus",)}


def test_case_iii_over_a_and_d_has_det_a_zero_and_the_cases() -> None:
    M = class_map(c2.ELinear(1, 0, -1.5), c2.psi.hill(1), ("a", "d"), ((-2, 2), (-2, 2)))
    assert {r.name for r in M.regions} >= {"CM4, saddle", "CM4, stable node", "CM4, unstable node"}
    assert ("det A = 0",) in {b.happening for b in M.boundaries}
    for r in M.regions:
        a, d = r.inside
        assert r.name == exact(c2.ELinear(a, 0, d), c2.psi.hill(1))


def test_slow_variables_parameters_and_poles() -> None:
    system = c2.ELinear("1/z", "k", -1, f=(0.3, 0.2), parameters={"k": 1.0})
    M = class_map(system, c2.psi.tanh(), ("z", "k"), ((-1, 1), (0, 1)), z=(0.5,))
    assert M.names == ("z1", "k")
    for r in M.regions:
        if r.width > 0.01:
            at = varied(*varied(system, c2.psi.tanh(), (0.5,), "z1", r.inside[0]), "k", r.inside[1])
            assert r.name == exact(*at)


def test_pitchforks_are_named_where_symmetry_makes_them() -> None:
    M = class_map(c2.ELinear(-1, 0, -1.5), c2.psi.tanh(), ("f1", "a"), ((-2, 2), (-1.9, -1.6)))
    assert {h for b in M.boundaries for h in b.happening} == {"pitchfork", "transcritical"}


def test_what_is_too_thin_is_listed_and_not_drawn() -> None:
    M = class_map(BAD, c2.psi.hill(2), ("f1", "f2"), ((-420, 420), (-420, 420)))
    assert {r.name for r in M.regions} == {"NCM2", "NCM4"}
    assert {name for name, _ in M.thin} >= {"CM4, stable node", "CM2, stable focus"}
    for name, (f1, f2) in M.thin:
        assert name == exact(BAD.evolve(f1=f1, f2=f2), c2.psi.hill(2))
    assert min(r.width for r in M.regions) == M.smallest_width > M.step


@settings(max_examples=20, deadline=None)
@given(
    st.tuples(*[numbers] * 5),
    st.sampled_from([("a", "b"), ("f1", "f2"), ("b", "f1"), ("d", "a"), ("f2", "d")]),
    st.sampled_from(PSIS),
    st.lists(st.tuples(st.floats(-1.95, 1.95), st.floats(-1.95, 1.95)), min_size=10, max_size=10),
)
def test_every_point_lies_in_one_region_and_has_its_class(
    plane: tuple[float, ...], names: tuple[str, str], psi: c2.Psi, points: list[tuple[float, float]]
) -> None:
    a, b, d, f1, f2 = plane
    system = c2.ELinear(a, b, d, f=(f1, f2))
    M = class_map(system, psi, names, ((-2, 2), (-2, 2)), steps=64, thin=0)
    assert sum(r.area for r in M.regions) == pytest.approx(area(M), rel=1e-9)
    borders = [line for boundary in M.boundaries for line in boundary.lines]
    thin = {name for name, _ in M.thin}
    for x, y in np.round(points, 3).tolist():
        around = [r for r in M.regions if holds(r.boundary, x, y)]
        assert len(around) == 1
        near = min((np.hypot(line[:, 0] - x, line[:, 1] - y).min() for line in borders), default=9.0)
        at = system.evolve(**{names[0]: x, names[1]: y})
        name = exact(at, psi)
        if near > 0.15 and not c2.classify(at, psi).degeneracies and name not in thin:
            assert around[0].name == name


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"names": ("f1",)}, "two of each"),
        ({"names": ("f1", "q")}, "cannot be varied"),
        ({"names": ("f1", "f1")}, "two different"),
        ({"spans": ((1, 0), (0, 1))}, "low < high"),
        ({"steps": 4}, "8 to 512"),
        ({"thin": 3}, "0 to 2"),
        ({"accuracy": 0}, "1e-12"),
    ],
)
def test_wrong_input_is_explained(changes: dict, message: str) -> None:
    arguments = {"names": ("f1", "f2"), "spans": ((0, 1), (0, 1)), **changes}
    names, spans = arguments.pop("names"), arguments.pop("spans")
    with pytest.raises(ValueError, match=message):
        class_map(c2.ELinear(1, 2, 3), c2.psi.tanh(), names, spans, **arguments)


FOLDING = c2.System(U=("2*c**2 - c - mu", "-s + k*c*s"), parameters={"mu": 0.5, "k": 0.3})


def of_general(system: c2.System, psi: c2.Psi) -> str:
    """The class of a general system, from the public functions."""
    equator, sets = c2.equator_equilibria(system), c2.critical_sets(system, psi)
    kinds = Counter(C.kind for C in sets)
    words = [kind if many == 1 else f"{many} {kind}s" for kind, many in sorted(kinds.items())]
    head = "NCM" if not sets else "CM" if len(sets) == 1 else f"{len(sets)}CM"
    ways = [(int((equator.lambda_rho < 0.0).sum()), "arrive"), (int((equator.lambda_rho > 0.0).sum()), "leave")]
    moves = ", ".join(f"{many} {verb}{'s' * (many == 1)}" for many, verb in ways if many)
    return ", ".join([f"{head}{len(equator)}", *words]) + f"; {moves}"


def test_equations_that_are_e_linear_have_the_map_of_their_coefficients() -> None:
    spans = ((-2, 2), (-2, 2))
    typed = c2.System(U=("-2*c - k*s + q", "k*c - s"), W=("c",), parameters={"k": 0.3, "q": 0.1})
    plain = c2.ELinear(-2, "k", -1, f=("q", 0.0), parameters={"k": 0.3, "q": 0.1})
    mine, theirs = (class_map(s, c2.psi.tanh(), ("k", "q"), spans, z, steps=64) for s, z in ((typed, 0.5), (plain, ())))
    assert [r.name for r in mine.regions] == [r.name for r in theirs.regions]
    assert [r.area for r in mine.regions] == pytest.approx([r.area for r in theirs.regions], rel=1e-9)


def test_equations_that_are_not_e_linear_are_sent_to_their_atlas() -> None:
    with pytest.raises(ValueError, match="use atlas"):
        class_map(FOLDING, c2.psi.tanh(), ("mu", "k"), ((-1, 1), (-1, 1)))


def test_stretches_along_one_parameter() -> None:
    found = class_line(FOLDING.evolve(k=1 / 3), c2.psi.tanh(), "mu", (-2, 2))
    assert [s.happening for s in found] == [("fold",), ("saddle-node",), ("transcritical",), ("saddle-node",), ()]
    assert_allclose([s.high for s in found], [-1 / 8, 0, 1, 5 / 3, 2], atol=1e-7)
    assert found[0].low == -2
    assert all(one.high == other.low for one, other in pairwise(found))
    for s in found:
        middle = 0.5 * (s.low + s.high)
        assert s.name == of_general(FOLDING.evolve(k=1 / 3, mu=middle), c2.psi.tanh())
    linear = class_line(c2.ELinear(-2, 0, -1, f=("k", 0.1), parameters={"k": 0.3}), c2.psi.tanh(), "k", (-2, 2))
    assert [s.name for s in linear] == [*(outer := ["NCM2", "CM2, stable node"]), "CM4, stable node", *outer[::-1]]
