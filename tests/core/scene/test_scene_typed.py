"""The scene of a typed system: the same layers, each recomputed exactly when a change reaches it."""

import dataclasses

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.scene import layers

from .test_scene import ran


def typed(**parameters):
    """q enters U alone, r and z1 enter W alone, z2 enters nothing."""
    values = {"q": 0.4, "r": 1.0, **parameters}
    return c2.System(U=("2*c**2 - c - 1/2", "q*c*s - s"), W=("-r*z1 + c", "s"), parameters=values)


def scene(**parameters):
    return c2.Scene(typed(**parameters), c2.psi.rational(), (0.5, 0.2), count=24)


EQUATOR = {"equator", "equator_cycle", "nullclines_outside", "conics", "outside"}
SLOW = {"critical", "name", "classification", "certificates", "slow_flow", "cycles", "outcomes"}
HEMISPHERE = {"closed_orbits", "cycles", "separatrices", "critical", "nullclines_inside", "inside",
              "continuations", "name", "classification", "certificates", "outcomes", "launched",
              "eigendirections"}  # fmt: skip
PLANE = EQUATOR | HEMISPHERE | {"slow_flow", "location"}
REACHES = {
    "parameter of U": ({"q": 0.3}, PLANE),
    "parameter of W": ({"r": 2.0}, SLOW),
    "formula of U": ({"U": ("2*c**2 - c - 1/3", "q*c*s - s")}, PLANE),
    "formula of W": ({"W": ("-r*z1 - c", "s")}, SLOW),
    "psi": ({"psi": c2.psi.tanh()}, HEMISPHERE),
    "z that neither reads": ({"z": (0.5, 0.9)}, set()),
    "z that W reads": ({"z": (0.6, 0.2)}, SLOW),
    "launch": ({"launch": [[0.2, 0.1]]}, {"launched"}),
    "nothing": ({"q": 0.4, "psi": c2.psi.rational()}, set()),
}


@pytest.mark.parametrize("change", REACHES)
def test_a_change_recomputes_what_it_reaches_and_nothing_else(change):
    changes, reached = REACHES[change]
    computed, changed = ran(scene(), **changes)
    assert computed == reached
    assert changed <= computed


def test_a_general_system_has_all_layers_but_the_location_in_closed_form():
    here = scene()
    for name in layers:
        assert (here[name] is None) == (name in {"equator_cycle", "location"})


def test_a_lineage_may_pass_from_one_kind_of_system_to_the_other():
    first = c2.Scene(c2.ELinear(-2.0, 0.3, -1.0, (-0.5, 0.1)))
    first["classification"], first["inside"]
    twin = c2.System(U=("-2*c - 0.3*s - 0.5", "0.3*c - s + 0.1"))
    other = first.evolve(system=twin)
    assert other.runs["inside"] == 1
    assert other["classification"].name == first["classification"].name
    one, two = first["critical"][0], other["critical"][0]
    assert two.p == pytest.approx(one.p, abs=1e-14)
    assert dataclasses.is_dataclass(two)


DEGENERATE = [
    ("0", "0"),  # nothing moves
    ("c**2", "c*s"),  # a curve of equilibria, every direction a limit direction
    ("c*(c**2 + s**2 - 1)", "s*(c**2 + s**2 - 1)"),  # U = 0 all along the equator
    ("c*(c**2 + s**2 - 1/4)", "s*(c**2 + s**2 - 1/4)"),  # a circle of equilibria
    ("c**2 - s**2", "2*c*s"),  # a critical set of index 2
    ("-c**3", "-s**3"),  # no linear part
    ("abs(c) - 1/2", "-s"),  # not smooth
    ("0", "s**2"),
    ("x", "y"),  # nothing on Sigma
    ("1e120*c", "-1e120*s"),
    ("-c + 1", "-s"),  # a critical set on the equator
]


@pytest.mark.parametrize("U", DEGENERATE, ids=lambda U: ", ".join(U))
def test_degenerate_systems_have_every_layer(U):
    shown = c2.Scene(c2.System(U=U), c2.psi.tanh(), count=12)
    for name in layers:
        assert shown[name] is not None or name in ("location", "equator_cycle", "slow_flow")
    for orbits in (shown["inside"], shown["outside"]):
        assert np.isfinite(orbits.buffer).all()
    assert shown["classification"].sentence
    for outcome in shown["outcomes"]:
        assert outcome.reason.endswith(".")
