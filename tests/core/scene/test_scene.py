"""The scene recomputes exactly what a change reaches."""

import dataclasses
import gc
import weakref

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.scene import layers


def typed(**parameters):
    values = {"f1": -0.5, "f2": 0.1, "k1": 0.0, "k2": 0.0, **parameters}
    return c2.ELinear(-2.0, 0.3, -1.0, ("f1 + k1*z", "f2 + k2*z"), B=[[1.0, -2.0]], g=[0.25], parameters=values)


def fingerprint(value):
    """Bytes of everything in a result, so that equal results have equal fingerprints."""
    if isinstance(value, np.ndarray):
        return value.tobytes()
    if dataclasses.is_dataclass(value):
        return tuple(fingerprint(getattr(value, f.name)) for f in dataclasses.fields(value))
    if isinstance(value, (tuple, list)):
        return tuple(fingerprint(v) for v in value)
    return repr(value)


def ran(scene, **changes):
    """Layers computed by, and results changed by, a change of inputs."""
    for name in layers:
        scene[name]
    before = dict(scene.runs)
    after = scene.evolve(**changes)
    results = {name: fingerprint(after[name]) for name in layers}
    computed = {name for name in layers if after.runs[name] > before[name]}
    changed = {name for name in layers if results[name] != fingerprint(scene[name])}
    return computed, changed


EQUATOR = {"equator", "equator_cycle", "location", "nullclines_outside", "conics", "outside"}
HEMISPHERE = {"closed_orbits", "cycles", "separatrices", "critical", "nullclines_inside", "inside",
              "continuations", "name", "classification", "certificates", "outcomes", "launched",
              "eigendirections"}  # fmt: skip

SLOW = {"critical", "name", "classification", "certificates", "slow_flow", "outcomes", "cycles"}

CLOSELY = {"nullclines_inside", "nullclines_outside", "conics"}  # what stands still, as finely as it is seen

REACHES = {
    "a": ({"a": -1.7}, EQUATOR | HEMISPHERE | {"slow_flow"}),
    "b": ({"b": 0.2}, EQUATOR | HEMISPHERE | {"slow_flow"}),
    "d": ({"d": -0.8}, EQUATOR | HEMISPHERE | {"slow_flow"}),
    "f1": ({"f1": -0.3}, EQUATOR | HEMISPHERE | {"slow_flow"}),
    "f2": ({"f2": 0.2}, EQUATOR | HEMISPHERE | {"slow_flow"}),
    "cut": ({"cut": 1.0}, EQUATOR | HEMISPHERE | {"slow_flow"}),  # moved with the plane only
    "psi": ({"psi": c2.psi.rational()}, HEMISPHERE),
    "hill": ({"psi": c2.psi.hill(3)}, HEMISPHERE),
    "z": ({"z": 1.0}, {"certificates"}),  # the slow manifold is looked for along z
    "B": ({"B": [[2.0, 1.0]]}, SLOW),
    "g": ({"g": [0.5]}, SLOW),
    "length": ({"length": 5.0}, {"inside", "outside", "continuations"}),
    "t_max": ({"t_max": 6.0}, {"inside", "outside", "continuations"}),
    "rtol": ({"rtol": 1e-5}, {"inside", "outside", "continuations", "separatrices"}),
    "atol": ({"atol": 1e-6}, {"inside", "outside", "continuations", "separatrices"}),
    "pixel": ({"pixel": 1 / 90}, {"inside", "outside", "continuations", "separatrices", "launched"}),
    "view": ({"view": 2.5}, {"nullclines_outside", "conics", "outside", "launched"}),
    "window": ({"window": (0.1, 0.4, 0.2, 0.5)}, {"inside", "outside", *CLOSELY}),
    "count": ({"count": 40}, {"inside", "outside"}),
    "seeds": ({"seeds": [[0.3, 0.2], [1.5, 0.1]]}, {"inside", "outside"}),
    "launch": ({"launch": [[0.2, 0.1]]}, {"launched"}),
    "the whole picture": ({"window": (-2.0, 2.0, -2.0, 2.0)}, {"inside", "outside"}),
    "nothing": ({"a": -2.0, "psi": c2.psi.constant()}, set()),
}


@pytest.mark.parametrize("change", REACHES)
def test_a_change_recomputes_what_it_reaches_and_nothing_else(change):
    changes, reached = REACHES[change]
    computed, changed = ran(c2.Scene(typed(), z=0.5), **changes)
    assert computed == reached
    assert changed <= computed


def test_z_reaches_the_picture_once_a_coefficient_depends_on_it():
    computed, _ = ran(c2.Scene(typed(k1=1.0), z=0.5), z=0.6)
    assert computed == EQUATOR | HEMISPHERE | {"slow_flow"}


def test_a_bad_change_leaves_the_scene_as_it_was():
    scene = c2.Scene(typed(), z=0.5)
    first = scene["classification"]
    for bad in ({"a": float("nan")}, {"q": 1.0}, {"view": 1.0}, {"seeds": [[1, 2, 3]]}, {"psi": 3.0}, {"z": [1, 2]},
                {"count": -1}, {"t_max": 0.0}, {"pixel": 0.0},
                {"length": -1.0}, {"rtol": 1.0}):  # fmt: skip
        with pytest.raises(ValueError, match=r"give|allowed|has"):
            scene.evolve(**bad)["inside"]
    assert scene["classification"] is first


def test_the_scene_shows_what_the_functions_say():
    system, psi = typed(), c2.psi.hill(2)
    scene = c2.Scene(system, psi, 0.5)
    assert scene["classification"] == c2.classify(system, psi, 0.5)
    np.testing.assert_array_equal(scene["equator"].theta, c2.equator_equilibria(system, 0.5).theta)
    (C,) = c2.critical_sets(system, psi, 0.5)
    np.testing.assert_array_equal(scene["critical"][0].p, C.p)
    np.testing.assert_array_equal(scene["slow_flow"], c2.sliding_flow(system, 0.5))
    drawn = scene["nullclines_inside"] + scene["nullclines_outside"]
    expected = c2.nullclines(system, psi, 0.5, view=scene.view)
    assert fingerprint(drawn) == fingerprint(expected)


@pytest.mark.parametrize("b", [4e-35, 1e-17, -4e-35])
def test_nothing_is_drawn_up_from_where_rounding_decides_whether_it_arrives(b):
    """At theta = 5 pi/3 lambda_rho = -b/sqrt(3) to first order, of terms of 1/4; at pi/3 it is b/sqrt(3)."""
    scene = c2.Scene(c2.ELinear(-1.0, b, 0.0, (0.5, 0.0)), c2.psi.constant())
    assert len(scene["continuations"]) == 0


GENERAL = c2.System(U=("a*c - s + z", "0.3*c + s"), W=("c",), parameters={"a": -2.0})


@pytest.mark.parametrize("system", [typed(), GENERAL])
def test_one_that_nobody_holds_is_gone_at_once(system):
    """In a cycle it would keep all that it has found until a search for garbage, which stops everybody who drags."""
    scene = c2.Scene(system, c2.psi.hill(3), [0.1] * system.m, launch=[(0.3, 0.2)], count=8)
    gone = []
    gc.disable()
    try:
        for _ in range(2):
            for name in scene:
                scene[name]
            gone += [weakref.ref(scene), weakref.ref(scene.problem)]
            scene = scene.evolve(z=[0.2] * system.m)
        del scene
        assert [one() for one in gone] == [None] * 4
    finally:
        gc.enable()


def test_a_scene_is_a_mapping_under_the_names_of_the_functions():
    scene = c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)), "hill:3")
    for name in ("classify", "critical_sets", "equator_equilibria", "limit_cycles", "approach_outcomes"):
        assert scene[name] == getattr(c2, name)(*(scene.system, scene.psi)[: 2 - (name == "equator_equilibria")])
        assert name in scene
    assert scene["sliding_flow"].tolist() == []
    assert "cycles" in scene
    assert "cycle" not in scene
    assert len(scene) == len(dict(scene.items())) == len(list(scene))
