"""A kind of special value is a row of `critical_changes`: added there, diagrams, tables and the page have it."""

import math

import pytest
from codim2_app.panels.parameters.diagram import branch_columns

import codim2_core as c2
from codim2_core import critical_changes

NEUTRAL_SADDLE = critical_changes.CriticalChange(
    "neutral saddle",
    lambda trace, _: trace,
    lambda _, determinant: determinant < 0.0,
    "tr J = 0 > det J: a loop of this saddle would be neutral.",
    "tr J = 0 > det J",
    "eq:scjaco",
)
PLANE = c2.ELinear(1.0, 0.5, -2.0, (0.1, 0.2))
TYPED = c2.System(U=("a*c - 0.5*s + 0.1", "0.5*c - 2*s + 0.2 + k*c*s"), W=(), parameters={"a": 1.0, "k": 0.0})


@pytest.fixture
def row():
    critical_changes.CRITICAL_CHANGES.append(NEUTRAL_SADDLE)
    yield NEUTRAL_SADDLE
    critical_changes.CRITICAL_CHANGES.remove(NEUTRAL_SADDLE)


@pytest.mark.parametrize("system", [PLANE, TYPED], ids=["e-linear", "typed"])
def test_a_row_added_is_found_and_labelled(row, system):
    """With e = -A^-1 f and J = A De, tr J = 0 has a root in a: found here by bisection of a finite difference."""
    found = c2.branches(system, c2.psi.tanh(), "a", (1.0, 4.0), with_cycles=False)
    (special,) = (one for one in found.special if one.kind == row.kind)
    assert (special.label, special.sentence) == (row.label, row.says)
    (shown,) = (one for one in branch_columns(found)["special"] if one["kind"] == row.kind)
    assert (shown["value"], shown["sentence"]) == (pytest.approx(special.value), row.says)
    low, high = 1.0, 4.0
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _divergence(middle) < 0.0 else (low, middle)
    assert special.value == pytest.approx(low, abs=1e-7)


def _divergence(a):
    """The divergence of x2' = U(e_Psi(x2)) at its equilibrium, by central differences."""
    det = -2.0 * a + 0.25
    e = ((2.0 * 0.1 - 0.5 * 0.2) / det, (0.5 * 0.1 - a * 0.2) / det)
    scale = math.hypot(*e)

    def modulus(r):
        return r / math.sqrt(r * r + float(c2.psi.tanh()(r * r)))

    low, high = 0.0, 1e6
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if modulus(middle) < scale else (low, middle)
    x = (e[0] * low / scale, e[1] * low / scale)

    def U(x1, x2):
        r = math.hypot(x1, x2)
        c, s = x1 / r * modulus(r), x2 / r * modulus(r)
        return a * c - 0.5 * s + 0.1, 0.5 * c - 2.0 * s + 0.2

    h = 1e-5
    return (U(x[0] + h, x[1])[0] - U(x[0] - h, x[1])[0] + U(x[0], x[1] + h)[1] - U(x[0], x[1] - h)[1]) / (2 * h)
