"""The bifurcation presets show what their figures show."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import bifurcations
from codim2_core.systems.presets.bifurcations import bifurcation_presets

PRESETS = bifurcation_presets()


@pytest.mark.parametrize("kind", ["pitchfork", "saddle-node", "transcritical"])
def test_a_walk_is_one_slider_across_the_curve(kind):
    before, at, after = (PRESETS[f"{kind}-{when}"] for when in ("before", "at", "after"))
    plane = lambda p: (p.a, p.b, p.d, p.f2, p.parameter)
    assert plane(before) == plane(at) == plane(after)
    assert (before.f1 - at.f1) * (after.f1 - at.f1) < 0
    a, b, d = at.a, at.b, at.d
    curve = (
        bifurcations.critical_boundary(c2.ELinear(a, b, d))
        if kind == "transcritical"
        else bifurcations.saddle_node(c2.ELinear(a, b, d))
    )
    distance = min(np.hypot(*(branch - (at.f1, at.f2)).T).min() for branch in curve.branches)
    assert distance < 1e-12
    if kind == "pitchfork":
        assert any(p.type == "pitchfork" and np.allclose(p.place, (at.f1, at.f2)) for p in curve.special)


@pytest.mark.parametrize("count", [0, 2, 4])
def test_conics_meet_as_often_as_their_name_says(count):
    preset = PRESETS[f"conics-{count}"]
    found = c2.equator_equilibria(preset.system)
    assert len(found) == count
    k = preset.d - preset.a
    x, y = np.cos(found.theta), np.sin(found.theta)
    hyperbola = k * x * y + preset.f2 * x - preset.f1 * y + preset.b
    np.testing.assert_allclose(hyperbola, 0.0, atol=1e-15)
    # branches of (x - x0)(y - y0) = const are told apart by the sign of x - x0, x0 = f1/(d - a)
    assert len(set(np.sign(x - preset.f1 / k))) == {0: 0, 2: 1, 4: 2}[count]
