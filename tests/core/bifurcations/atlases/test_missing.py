"""What an atlas says of itself: where all is degenerate, where U has no value, and what it has missed, or may have."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.bifurcations.atlases.regions import inside_polygons
from codim2_core.bifurcations.diagrams.classes import classes_over
from codim2_core.numerics.arclength import distance

ONE = c2.psi.constant()


@pytest.mark.parametrize("low", [0, -1.3])
def test_a_line_on_which_u_is_zero_is_named_and_has_no_points(low):
    system = c2.System(U=("mu*(c**2 - c)", "mu*(s*c + k)"), parameters={"mu": 0.5, "k": 0.1})
    found = c2.atlas(system, ONE, {"mu": (low, 1), "k": (-1, 1)})
    ((name, value),) = found.degenerate
    assert name == "mu"
    assert abs(value) < 1e-12
    (line,) = [one for one in found.curves if one.kind == "degenerate"]
    assert np.abs(line.points[:, 0]).max() < 1e-12
    assert all(abs(point.place[0]) > 1e-6 for point in found.points)
    assert all(np.ptp(one.points[:, 0]) > 0.5 for one in found.curves if one is not line)  # none runs along it


def test_so_is_one_on_which_every_direction_is_a_limit_direction():
    system = c2.System(U=("-c*(1 + c*s) + k*s", "-s*(1 + c*s) + k*k*c + k*mu"), parameters={"mu": 0.5, "k": 0.1})
    found = c2.atlas(system, ONE, {"mu": (0, 1), "k": (-1, 1.5)})
    ((name, value),) = found.degenerate
    assert (name, value) == ("k", pytest.approx(0.0, abs=1e-12))
    assert c2.equator_equilibria(system.evolve(k=0.0)).all_directions


def test_a_region_is_named_next_to_the_line_of_its_symmetry():
    """On k = 0 foci are nodes, for no curve's sake: the discriminant is -k^2."""
    system = c2.System(U=("-mu*c*(1 + c^2/2) - k*s", "-mu*s*(1 + c^2/2) + k*c"), parameters={"mu": 0.5, "k": 0.3})
    found = c2.atlas(system, ONE, {"mu": (0.1, 1), "k": (-1, 1)})
    assert not found.looked.unlike
    assert all("focus" in region.name for region in found.regions)


def test_none_is_said_to_be_missing_for_a_symmetry_alone():
    """Beside a pitchfork Theta and Theta' change their signs in many cells that hold no zero of both."""
    found = c2.atlas(c2.examples.spinning_disc(), ONE, {"k": (0.3, 1), "mu": (0.05, 1)})
    assert found.unfinished == ()
    assert [one.kind for one in found.curves] == ["pitchfork"] * 2


def wrong_places(system, psi, found, z=(), count=100):
    """Random places, away from all curves, in a region of another class."""
    classes = classes_over(system, psi, z, found.names, found.ranges)
    widths = np.array([high - low for low, high in found.ranges])
    places = np.random.default_rng(0).uniform(*np.array(found.ranges).T, (count, 2))
    near = np.min([distance(places / widths, one.points / widths) for one in found.curves], axis=0) < 2e-3
    names = [classes.name(code) for code in classes.decided(places).tolist()]
    owned = np.stack([inside_polygons(places, region.boundary) for region in found.regions])
    return [
        place for place, beside, name, owner in zip(places, near, names, owned.T, strict=True)
        if not beside and {found.regions[i].name for i in np.flatnonzero(owner)} != {name}
    ]  # fmt: skip


def test_what_happens_at_a_corner_of_u_is_seen_to_be_missing():
    system = c2.System(U=("-c", "mu - abs(s - k)"), parameters={"mu": 0.1, "k": 0.1})
    found = c2.atlas(system, ONE, {"mu": (-0.5, 0.5), "k": (-0.5, 0.5)})  # two critical sets are born at mu = 0
    assert found.looked.unlike
    classes = classes_over(system, ONE, (), ("mu", "k"), found.ranges)
    for place in found.looked.unlike:
        (own,) = [one for one in found.regions if inside_polygons(np.array([place]), one.boundary)[0]]
        assert classes.name(int(classes.decided(np.array([place]))[0])) != own.name


@pytest.mark.slow
def test_a_fold_where_u_vanishes_to_higher_order_all_along_is_followed_by_bisection():
    """At p = .512 two sets are born, s^2 as c^3, at no regular zero: 22 of 400 places were in the wrong region."""
    system = c2.System(
        U=("-0.257*c*c+0.375*exp(c)-0.887*cos(3*s)+p*exp(c)",
           "1.669*s*s+0.067*s**3-0.585*c**3+z*c**3+p*c*s*s"),
        W=("1",), parameters={"p": 0.0},
    )  # fmt: skip
    found = c2.atlas(system, c2.psi.rational(), {"p": (-2, 2), "z1": (-2, 2)}, (0.1,))
    assert not wrong_places(system, c2.psi.rational(), found, (0.1,), 400)


def test_where_equations_have_no_value_is_a_region_of_its_own():
    system = c2.System(U=("c**2 - mu", "-s + log(k)"), parameters={"mu": 0.5, "k": 0.3})
    found = c2.atlas(system, ONE, {"mu": (-2, 2), "k": (-1, 1)})
    (border,) = [one for one in found.curves if one.kind == "undefined"]
    assert np.abs(border.points[:, 1]).max() < 1e-9
    assert found.regions[0].name == "undefined"
    assert found.regions[0].area == pytest.approx(4.0, abs=1e-9)
    nowhere = system.evolve(U=("c**2 - mu", "-s + log(k - 9)"))
    with pytest.raises(ValueError, match="finite"):
        c2.atlas(nowhere, ONE, {"mu": (-2, 2), "k": (-1, 1)})


def test_a_curve_along_an_edge_is_found_from_the_portraits_next_to_it():
    """A saddle-node at p = -1.9931: two limit directions less than a cell of the net apart, in the first cell."""
    system = c2.System(
        U=("0.639*c*s+0.084*c*c-0.06*tanh(2*s)+p*c*s*s", "0.05*sin(2*c)+0.226*c**3-1.399*c*s*s+2.028*exp(c)+p*c**3"),
        W=(),
        parameters={"p": 0.0},
    )
    found = c2.atlas(system, c2.psi.hill(2.0), {"p": (-2, 2), "n": (1.2, 6)})
    assert not found.looked.unlike
    edge = [one for one in found.curves if one.kind == "saddle-node" and one.points[:, 0].max() < -1.9]
    assert len(edge) == 1
    np.testing.assert_allclose(np.sort(edge[0].points[[0, -1], 1]), (1.2, 6.0), atol=1e-9)
    value = float(edge[0].points[0, 0])
    counts = [len(c2.equator_equilibria(system.evolve(p=p))) for p in (-2.0, value - 1e-6, value + 1e-6, -1.9)]
    assert counts == [4, 4, 2, 2]
    for p in (-1.9999, -1.995):
        (region,) = [one for one in found.regions if inside_polygons(np.array([[p, 3.1]]), one.boundary)[0]]
        assert region.name.startswith("NCM4")
