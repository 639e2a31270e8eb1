"""Certificates: never "fails" on a random search, and they do fail on what is wrong."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, presets, psi
from codim2_core.theorems.certificates import Verdict, certificates
from tests.core.strategies import coefficient, regularisations, systems

LABELS = [
    "thm:geneps0(a)", "thm:geneps0(b)", "thm:geneps0(c)", "thm:geneps0(d)", "thm:geneps1(b)", "thm:geneps1(c)",
    "thm:lineps1(a)", "thm:lineps1(b)", "thm:case1(a)", "thm:case1(b)", "thm:case1(c)", "thm:case2(a)", "thm:case2(b)",
    "sec:geneps0, index theory", "prop:LC",
]  # fmt: skip
round_systems = st.builds(
    lambda a, b, d, f1, f2: ELinear(a, b, d, (f1, f2)), *(st.integers(-3, 3).map(float) for _ in range(5))
)


def verdicts(system, regularisation, **more):
    return {c.theorem: c.verdict for c in certificates(system, regularisation, **more)}


@settings(max_examples=200)
@given(st.one_of(systems, round_systems), regularisations, coefficient, coefficient)
def test_nothing_ever_fails(system, regularisation, B1, g1):
    for found in (system, system.evolve(B=[[B1, 1.0], [0.5, g1]], g=[g1, B1])):
        certified = certificates(found, regularisation)
        assert [c.theorem for c in certified] == LABELS
        for c in certified:
            assert c.verdict is not Verdict.FAILS, c
            assert c.sentence
            assert all(np.isfinite(value) for _, value in c.numbers)
            assert bool(c.numbers) or c.verdict is Verdict.DOES_NOT_APPLY or "≡" in c.sentence


@pytest.mark.parametrize("name", [name for name, preset in presets.items() if preset.portrait[0]])
def test_the_theorem_of_each_preset_holds(name):
    preset = presets[name]
    found = verdicts(preset.system.at(preset.z), preset.psi)
    case, portrait, _ = preset.portrait
    # At |A^-1 f| = 1 both parts ask for an inequality, and U vanishes on the equator: no degree there.
    expected = Verdict.DOES_NOT_APPLY if preset.degeneracy == "transcritical" else Verdict.HOLDS
    if case in ("I", "II"):
        part = "a" if portrait.startswith("CM") else "b"
        assert found[f"thm:case{1 if case == 'I' else 2}({part})"] is expected
    assert found["sec:geneps0, index theory"] is expected
    assert (found["thm:geneps0(c)"] is Verdict.HOLDS) == portrait.endswith("CM0")


def test_the_bound_on_the_divergence_is_attained_and_kept():
    (c,) = (c for c in certificates(ELinear(-2, 0.3, -1, (0.1, 0.2)), psi.hill(3)) if c.theorem == "thm:case1(a)")
    numbers = dict(c.numbers)
    assert -1.0 - 1e-6 < numbers["largest √(ζ²+Ψ) div"] <= -1.0 + 1e-12
    assert numbers["its bound −min(|a|, |d|)"] == -1.0


def test_a_wrong_cycle_fails_and_a_right_one_holds():
    system = ELinear(172, 186, -200, (-86, -93), B=[[1.0, 2.0]], g=[0.25])
    right = SimpleNamespace(slow_flow=[0.75], mean_e=[0.5, 0.0])
    wrong = SimpleNamespace(slow_flow=[0.7])
    assert verdicts(system, psi.hill(3))["prop:LC"] is Verdict.DOES_NOT_APPLY
    assert verdicts(system, psi.hill(3), cycles=[])["prop:LC"] is Verdict.DOES_NOT_APPLY
    assert verdicts(system, psi.hill(3), cycles=[right])["prop:LC"] is Verdict.HOLDS
    assert verdicts(system, psi.hill(3), cycles=[right, wrong])["prop:LC"] is Verdict.FAILS


def test_psi_is_checked():
    with pytest.raises(ValueError, match="psi is 1"):
        certificates(ELinear(1, 0, 1), 1)
