"""Facts are what the core says, for every portrait of the paper."""

import numpy as np
import pytest
from codim2_app.lessons.facts import FACT_NAMES, facts_of

import codim2_core as c2


@pytest.mark.parametrize("key", list(c2.presets))
def test_facts_of_every_portrait_agree_with_the_core(key):
    preset = c2.presets[key]
    scene = c2.Scene(preset.system, preset.psi, z=preset.z or (0.0,) * preset.system.m, count=0)
    facts = facts_of(scene, FACT_NAMES)
    equator = c2.equator_equilibria(preset.system, scene.z)
    critical = c2.critical_sets(preset.system, preset.psi, scene.z)
    assert (facts["case"], facts["name"]) == preset.portrait[:2]
    assert facts["limit_directions"] == len(equator.theta)
    assert facts["arriving"] == int((equator.lambda_rho < 0).sum())
    assert facts["leaving"] == int((equator.lambda_rho > 0).sum())
    assert facts["critical_sets"] == len(critical)
    named = facts["stable"] + facts["unstable"] + facts["saddles"]
    assert named == sum(C.kind.startswith(("stable", "unstable", "saddle")) for C in critical)
    if len(critical) == 1:
        (C,) = critical
        assert (facts["kind"], facts["trace"], facts["determinant"]) == (C.kind, C.trace, C.determinant)
        assert facts["radius"] == pytest.approx(np.hypot(*C.e))
    else:
        assert facts["kind"] is facts["trace"] is facts["radius"] is None
    assert set(facts["verdicts"]) == {o.verdict for o in c2.approach_outcomes(preset.system, preset.psi, scene.z)}


def test_only_what_is_asked_for_is_computed():
    scene = c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)))
    facts_of(scene, ["limit_directions"])
    assert set(scene.runs) == {"equator", "location"}
