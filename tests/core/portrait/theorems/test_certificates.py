"""Certificates: never "fails" on a random search, and they do fail on what is wrong."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, System, examples, presets, psi
from codim2_core.portrait.theorems.certificates import certificates
from codim2_core.portrait.theorems.facts import Verdict
from codim2_core.portrait.theorems.sliding_claims import psi_claims
from tests.core.general_systems import polynomials
from tests.core.strategies import coefficient, regularisations, systems

LABELS = [
    "lem:ePsi(a)", "lem:ePsi(b)", "lem:ePsi(c)", "lem:ePsi(d)", "rem:jaco_properties",
    "thm:geneps0(a)", "thm:geneps0(b)", "thm:geneps0(c)", "thm:geneps0(d)",
    "thm:geneps1(a)", "thm:geneps1(b)", "thm:geneps1(c)", "thm:geneps1(d)", "sec:geneps0, index theory",
    "lem:normalform", "sec:lin, D1", "sec:lin, D2", "thm:lineps1(a)", "thm:lineps1(b)", "prop:LC",
    "thm:case1(a)", "thm:case1(b)", "thm:case1(c)", "thm:case2(a)", "thm:case2(b)",
    "sec:ballpool", "sec:mateslidecross", "sec:nonunique",
]  # fmt: skip
round_systems = st.builds(
    lambda a, b, d, f1, f2: ELinear(a, b, d, (f1, f2)), *(st.integers(-3, 3).map(float) for _ in range(5))
)


def verdicts(system, regularisation, **more):
    return {c.theorem: c.verdict for c in certificates(system, regularisation, **more)}


@settings(max_examples=20)
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


def turned(system, angle):
    """The same system in axes turned by an angle, typed as text."""
    at = system.at()
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    A, f = (R @ at.A @ R.T).tolist(), (R @ at.f).tolist()
    return System(U=tuple(f"({row[0]!r})*c + ({row[1]!r})*s + ({value!r})" for row, value in zip(A, f, strict=True)))


@settings(max_examples=20)
@given(st.one_of(systems, round_systems), regularisations, st.sampled_from([0.0, 0.5 * np.pi, 0.3, 2.0]))
@example(ELinear(3.0, 0.0, 3.0, (0.0, 0.0)), psi.constant(), 0.3)  # stars, but for the rounding of the turn
@example(ELinear(3.0, 0.0, 3.0, (0.0, 0.0)), psi.constant(), 2.0)
@example(ELinear(1.0, 0.0, 1.0, (0.0, 0.0)), psi.constant(), 0.3)
@example(ELinear(0.875, 0.0, 0.875, (0.0, 0.0)), psi.constant(), 2.0)
def test_nothing_fails_for_typed_affine_systems(system, regularisation, angle):
    typed = turned(system, angle)
    try:
        typed.at()
    except ValueError:  # U = 0 but for rounding
        return
    for c in certificates(typed, regularisation):
        assert c.verdict is not Verdict.FAILS, c


@settings(max_examples=20)
@given(polynomials, regularisations)
def test_nothing_fails_for_general_systems(system, regularisation):
    for c in certificates(system, regularisation):
        assert c.verdict is not Verdict.FAILS, c
        assert c.sentence
        assert all(np.isfinite(value) for _, value in c.numbers), c


def applies(system, regularisation, z=()):
    return {c.theorem for c in certificates(system, regularisation, z) if c.verdict is Verdict.HOLDS}


@pytest.mark.parametrize("regularisation", [psi.constant(), psi.tanh(), psi.hill(3), psi.custom("exp(-s/2)")])
@pytest.mark.parametrize("z", [-1.3, -0.2, 0.0, 0.4, 1.7])
def test_the_three_examples(regularisation, z):
    always = {"lem:ePsi(a)", "lem:ePsi(b)", "lem:ePsi(c)", "lem:ePsi(d)", "rem:jaco_properties", "thm:geneps0(d)"}
    found = applies(examples.nonunique_sliding(), regularisation, z)
    assert found >= always | {"sec:nonunique", "thm:geneps1(a)", "thm:geneps1(b)", "thm:geneps1(c)", "thm:geneps1(d)"}
    assert "sec:ballpool" not in found
    found = applies(examples.attracting_repelling(), regularisation, z)
    assert found >= always | {"sec:mateslidecross", "thm:geneps1(a)", "thm:geneps1(d)", "sec:geneps0, index theory"}
    assert "sec:nonunique" not in found
    for place in ((4.0 * z, 1.0), (20.0, z)):
        found = applies(examples.ball_in_pool(), regularisation, place)
        assert found >= always | {"sec:ballpool", "sec:lin, D1", "lem:normalform"}
        assert "sec:mateslidecross" not in found


def test_what_is_next_to_an_example_is_none():
    beside = System(U=("2*c**2 - c - 1/2", "-s + 1e-6*c"), W=("-z",))
    assert "sec:mateslidecross" not in applies(beside, psi.tanh(), 0.5)
    assert "sec:ballpool" not in applies(ELinear(-1, 0, -1, (0.1, 0.0), B=[[-1, 0], [0, -1]]), psi.tanh())


@pytest.mark.parametrize(("system", "theorem"), [
    (ELinear(-1, 0.5, -1, (0.3, 0.9)), "sec:lin, D1"),
    (ELinear(-1, 2.0, -1, (0.3, 0.9)), "sec:lin, D1"),
    (ELinear(-1, 0.0, -2, (0.3, 0.0)), "sec:lin, D2"),
    (ELinear(-1, 0.0, -2, (0.0, 0.3)), "sec:lin, D2"),
    (ELinear(-1, 0.0, -2, (0.0, -1.3)), "sec:lin, D2"),
    (ELinear(-1, 0.0, 2, (-1.0, 0.0)), "sec:lin, D2"),
    (ELinear(-1, 0.0, -1.5, (-0.5, 0.0)), "sec:lin, D2"),
])  # fmt: skip
def test_degenerate_equators_have_the_closed_form(system, theorem):
    assert theorem in applies(system, psi.constant())
    assert theorem in applies(turned(system, 0.5 * np.pi), psi.constant()) or theorem.endswith("D2")


def shorter(p):
    (found,) = [c for c in psi_claims(p) if c.theorem == "lem:ePsi(d)"]
    return found.verdict.value


@pytest.mark.parametrize(
    "p", [psi.exponential(), psi.tanh(), psi.hill(1), psi.hill(40.5), psi.hill(200), psi.rational()]
)
def test_a_psi_that_underflows_is_positive_all_the_same(p):
    assert shorter(p) == "holds"


@pytest.mark.parametrize("text", ["1e-30/(1+s)", "1e-300"])
def test_a_psi_that_is_next_to_nothing_is_checked_like_any_other(text):
    found = psi.custom(text)
    assert [rule.holds for rule in found.check()][1:4] == [False, True, True]
    assert all(claim.verdict.value == "holds" for claim in psi_claims(found))
