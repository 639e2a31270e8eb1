"""Names of portraits: the theorems as properties, the borders by name."""

import pytest
from hypothesis import assume, given

from codim2_core import ELinear, classify, psi
from tests.core.strategies import regularisations, systems


def names(system, regularisation=None):
    return {d.name for d in classify(system, regularisation or psi.constant()).degeneracies}


@given(systems, regularisations)
def test_cases_are_those_of_the_table(system, regularisation):
    at, found = system.at(), classify(system, regularisation)
    det = at.a * at.d + at.b**2
    assume(at.a != 0 and at.d != 0 and abs(det) > 1e-9)
    expected = "I" if at.a * at.d > 0 else "II" if det < 0 else "III"
    assert found.case == expected
    assert found.sentence.startswith(f"Case {expected}, {found.name}.")


@pytest.mark.parametrize(
    ("system", "name", "degeneracy"),
    [
        (ELinear(-1, 0, -1), "CM∞", "all directions"),
        (ELinear(-1, 0, -1.5, (-0.5, 0)), "CM2", "pitchfork"),
        (ELinear(-1, 1, -1, (0.6, 0.8)), "CM1", "saddle-node"),
        (ELinear(-1, 0, -1, (0.6, 0.8)), "NCM2", "transcritical"),
        (ELinear(1, 1, -1, (0.5, 0.5)), "CM4", "line of equilibria"),
        (ELinear(1, 1, -1, (0.5, 0.2)), "NCM2", "det A = 0"),
        (ELinear(-1, 0, 0, (0.3, 0)), "CM4", "line of equilibria"),
        (ELinear(0, 0, 0), "CM∞", "everything stands still"),
        (ELinear(0, 1, 0), "CM0", "a = d = 0"),
        (ELinear(0, 1, -1), "CM0", "a = 0"),
    ],
)
def test_degenerate_settings_are_named(system, name, degeneracy):
    found = classify(system, psi.constant())
    assert degeneracy in {d.name for d in found.degeneracies}
    assert found.name == name
    assert all(d.sentence.endswith(".") for d in found.degeneracies)


@pytest.mark.parametrize("relative", [10.0**-k for k in range(3, 16)])
@pytest.mark.parametrize("scale", [1e-150, 1.0, 1e149])
def test_either_side_of_a_border_has_its_own_name(relative, scale):
    def at(f1, f2):
        return ELinear(-scale, scale, -scale, (f1 * scale, f2 * scale))

    assert classify(at(0.6, 0.8 * (1 - relative)), psi.constant()).name == "CM0"
    assert classify(at(0.6, 0.8 * (1 + relative)), psi.constant()).name == "CM2"

    def slip(f1):  # the ball: a = d, b = 0
        return ELinear(-scale, 0, -scale, (f1 * scale, 0))

    assert classify(slip(1 - relative), psi.constant()).name == "CM2"
    assert classify(slip(1 + relative), psi.constant()).name == "NCM2"


def test_hopf_in_case_three_is_named_at_its_parameter():
    system = ELinear(172, 186, -200, (-86, -93))
    assert names(system, psi.hill(284 / 129)) == {"tr J = 0"}
    assert names(system, psi.hill(2)) == names(system, psi.hill(3)) == set()
