"""Regions of an atlas against the classes at many places, and faces against areas that are known."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.bifurcations.atlases.regions import inside_polygons, middle, net_of
from codim2_core.bifurcations.diagrams.classes import classes_over

QUADRATIC = c2.System(U=("mu*c**2 - c + s/3 - 0.2", "-s + k*c*s + 0.3*c"), parameters={"mu": 1.0, "k": 1.0})
PLANES = {
    "f": (c2.ELinear(1, 0.4, -1), c2.psi.tanh(), ("f1", "f2"), ((-3, 3), (-3, 3)), ()),
    "f, with thin regions": (c2.ELinear(1, 3, -2), c2.psi.hill(3), ("f1", "f2"), ((-5, 5), (-5, 5)), ()),
    "f, reversible": (c2.ELinear(1, 2, -1), c2.psi.hill(3), ("f1", "f2"), ((-2.4, 2.4), (-2.4, 2.4)), ()),
    "f, all neutral": (c2.ELinear(0, 2, 0), c2.psi.hill(3), ("f1", "f2"), ((-2.6, 2.6), (-2.5, 2.7)), ()),
    "a, n": (c2.ELinear(172, 186, -200, (-86, -93)), c2.psi.hill(3), ("a", "n"), ((150, 200), (1, 6)), ()),
    "a, f2": (c2.ELinear(1.5, 0.5, -1.2, (0.4, -0.3)), c2.psi.rational(), ("a", "f2"), ((-4, 4), (-3, 3)), ()),
    "a, d": (c2.ELinear(3, 2, -1.5, (0.3, 0.2)), c2.psi.hill(3), ("a", "d"), ((-4, 4), (-4, 4)), ()),
    "block": (c2.examples.tilting_block(), c2.psi.constant(), ("z1", "phi"), ((0.05, 1.2), (-3, 3)), (0.15,)),
    "quadratic": (QUADRATIC, c2.psi.tanh(), ("mu", "k"), ((-3, 3), (-3, 3)), ()),
}
TURN = np.linspace(0.0, 2.0 * math.pi, 201)
RING = np.stack([np.cos(TURN), np.sin(TURN)], axis=-1)


@pytest.mark.parametrize("plane", PLANES)
def test_every_place_is_in_the_region_of_its_class(plane):
    system, psi, names, ranges, z = PLANES[plane]
    found = c2.atlas(system, psi, dict(zip(names, ranges, strict=True)), z)
    widths = np.array([high - low for low, high in ranges])
    assert sum(region.area for region in found.regions) == pytest.approx(float(np.prod(widths)), rel=1e-9)
    classes = classes_over(system, psi, z, names, ranges)
    samples = np.array([region.sample for region in found.regions])
    assert [classes.name(code) for code in classes.decided(samples).tolist()] == [one.name for one in found.regions]
    count = 60 if plane == "quadratic" else 2000
    places = np.random.default_rng(5).uniform(*np.array(ranges).T, (count, 2))
    codes = classes.decided(places)
    owned = np.stack([inside_polygons(places, region.boundary) for region in found.regions])
    assert (owned.sum(axis=0) == 1).mean() > 0.999
    wrong = [
        place
        for place, code, owner in zip(places, codes.tolist(), owned.T, strict=True)
        if classes.name(code) not in {found.regions[i].name for i in np.flatnonzero(owner)}
    ]
    for place in wrong:  # only next to a curve, by the bend of its chords
        assert min((np.abs(one.points - place) / widths).max(axis=1).min() for one in found.curves) < 0.02
    assert len(wrong) <= 0.003 * count


def test_regions_of_a_few_parts_in_a_million_are_there():
    """A Hopf and a node-focus curve within 1/300 of the plane: held against the critical sets in the regions."""
    system, psi, names, ranges, _ = PLANES["f, with thin regions"]
    found = c2.atlas(system, psi, dict(zip(names, ranges, strict=True)))
    assert len(found.regions) == 24  # a half turn of the plane takes them into one another
    for region in found.regions:
        there = system.evolve(**dict(zip(names, region.sample, strict=True)))
        kinds = [C.kind for C in c2.critical_sets(there, psi)]
        head = f"{'CM' if kinds else 'NCM'}{len(c2.equator_equilibria(there))}"
        assert region.name == ", ".join([head, *kinds])
    assert sum("unstable node" in region.name for region in found.regions) == 4


def test_circles_cut_the_square():
    faces = net_of([0.5 + 0.2 * RING, 0.5 + 0.3 * RING, [0.5, 0.1] + 0.05 * RING]).faces()
    areas = sorted(face.area for face in faces)
    inner, outer, small = (math.pi * r * r for r in (0.2, 0.3, 0.05))
    assert areas == pytest.approx(sorted([inner, outer - inner, small, 1.0 - outer - small]), rel=1e-3)
    assert sum(areas) == pytest.approx(1.0, abs=1e-12)
    for face in faces:
        at, room = middle(face)
        assert inside_polygons(at[None], face.rings)[0]
        assert room > 0.02


def test_a_lobe_that_is_pinched_at_a_tip_is_a_region_of_its_own():
    """A transcritical curve turns back at a saddle-node on the equator, where a fold of critical sets begins."""
    system = c2.System(
        U=("-0.573*c*c-1.443*c+0.352*exp(c)-0.926*s**3+p*sin(2*c)", "1.165*sin(2*c)-2.475*s**3+0.25+z*c**3+p*cos(3*s)"),
        W=("1",),
        parameters={"p": 0.0},
    )
    found = c2.atlas(system, c2.psi.constant(), {"p": (-2, 2), "z1": (-2, 2)}, z=(0.0,))
    tip = next(point.place for point in found.points if point.kind == "fold on the equator" and point.place[0] > 1.0)
    for place in ((1.0676, 0.1858), (tip[0] - 0.004, tip[1] - 0.012)):
        (region,) = [one for one in found.regions if inside_polygons(np.array([place]), one.boundary)[0]]
        there = system.evolve(p=place[0])
        assert region.name == "4CM4, 2 saddles, stable node, unstable focus; 3 arrive, 1 leaves"
        assert len(c2.critical_sets(there, c2.psi.constant(), (place[1],))) == 4
        assert (c2.equator_equilibria(there, (place[1],)).lambda_rho < 0.0).sum() == 3
