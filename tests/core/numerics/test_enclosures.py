"""Every operation of a typed formula is enclosed, with its derivatives, over any box."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core.formulas.arrays import polynomial_degree, program
from codim2_core.numerics.enclosure import enclose
from codim2_core.systems.typed import System
from tests.core.general_systems import polynomials, smooth


@given(st.one_of(polynomials, smooth), st.tuples(st.floats(-1, 1), st.floats(-1, 1)), st.floats(1e-6, 0.5))
@settings(max_examples=20)
def test_enclosures_contain(system, middle, half):
    """The range of U and its derivatives over a box lies in the enclosure, by 30-digit arithmetic at random points."""
    run = program(system.at().key)
    out = np.empty((2, 6))
    (c, s), work = middle, np.empty((len(run.op), 6))
    enclose(*run.arrays, c - half, c + half, s - half, s + half, work, out)
    points = np.array(middle) + half * np.random.default_rng(0).uniform(-1, 1, (50, 2))
    values = run.evaluate(points)
    slack = 1e-14 * max(1.0, np.abs(values).max())
    for row in range(2):
        for j in range(3):
            assert (values[:, row, j] >= out[row, 2 * j] - slack).all()
            assert (values[:, row, j] <= out[row, 2 * j + 1] + slack).all()


ROWS = ["sin(9*c)", "cos(9*s - 1)", "tan(c/2)", "exp(2*c)", "log(2 + s)", "sqrt(1.3 + c)", "tanh(3*s)", "sinh(c)",
        "cosh(2*s)", "atan(5*c)", "abs(s)", "(c - s)**3", "(c - s)**4", "1/(2 + c)**2", "(2 + c)**1.5", "(2 + c)**s",
        "c/(3 - s)", "-c*s"]  # fmt: skip


@pytest.mark.parametrize("text", ROWS)
def test_every_operation_is_enclosed_and_differentiated(text):
    system = System(U=(text, "s"))
    run = program(system.at().key)
    rng = np.random.default_rng(3)
    for half in (0.4, 0.05, 1e-4):
        for c, s in rng.uniform(-0.6, 0.6, (20, 2)):
            out, work = np.empty((2, 6)), np.empty((len(run.op), 6))
            enclose(*run.arrays, c - half, c + half, s - half, s + half, work, out)
            points = np.array([c, s]) + half * rng.uniform(-1, 1, (200, 2))
            points[:4] = np.array([c, s]) + half * np.array([(1, 1), (1, -1), (-1, 1), (-1, -1)])
            with np.errstate(all="ignore"):
                exact = np.concatenate([system.at().U(points)[:, :1], system.at().DU(points)[:, 0]], axis=1)
            values = run.evaluate(points)[:, 0]
            defined = np.isfinite(exact).all(axis=1)
            np.testing.assert_allclose(values[defined], exact[defined], rtol=1e-14, atol=1e-15)
            for j in range(3):
                assert (exact[defined, j] >= out[0, 2 * j]).all()
                assert (exact[defined, j] <= out[0, 2 * j + 1]).all()
    tight = values[:, 0].max() - values[:, 0].min()
    assert out[0, 1] - out[0, 0] < 3 * tight + 1e-12


@pytest.mark.parametrize("text", ["((x**2 + y**2)/0.01)**0.75", "(x**2 + y**2)**1.5", "(x - y)**2.5/3", "x**3 + y"])
def test_what_vanishes_on_sigma_is_enclosed_by_zero(text):
    """Rounded outwards a zero would lie below 0, where a power has no value: nothing was known, and nothing found."""
    found = []
    for row in (f"5 - 6*c*(1 + {text})", "5 - 6*c"):
        run = program(System(U=(row, "-s")).at().key)
        out, work = np.empty((2, 6)), np.empty((len(run.op), 6))
        enclose(*run.arrays, 0.8, 0.9, -0.1, 0.1, work, out)
        found.append(out[0])
    np.testing.assert_allclose(found[0], found[1], atol=1e-12)


@pytest.mark.parametrize(
    ("U", "degree"),
    [(("c*s - 1", "(c + s)**3"), 3), (("c/2 + x*c**9", "exp(z)*s"), 9), (("c/s", "s"), None), (("exp(c)", "s"), None)],
)
def test_degree_of_polynomials(U, degree):
    assert polynomial_degree(System(U=U).U) == degree
