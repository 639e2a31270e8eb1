"""Complete elliptic integrals in typed text: by mpmath, in every form that a formula has."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from codim2_core.formulas.arrays import program
from codim2_core.formulas.expression import parse
from codim2_core.formulas.functions import known
from codim2_core.formulas.functions.elliptic import BLUR
from codim2_core.numerics.enclosure import enclose

from ..exact_elliptic import NAMES, exact

PARAMETERS = st.one_of(
    st.floats(-3.0, 1.0, exclude_max=True),
    st.floats(-16.0, 0.0).map(lambda power: 1.0 - 10.0**power),
    st.floats(-300.0, 0.0).map(lambda power: 10.0**power).filter(lambda m: m < 1.0),
)


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=20)
@given(PARAMETERS)
@example(0.0)
@example(-1.0)
@example(0.5)
@example(1.0 - 2.0**-53)
def test_an_integral_is_what_mpmath_says(name, m):
    expression, true = parse(f"{name}(x)", ("x",)), pytest.approx(float(exact(name, m)), rel=BLUR * 2.0**-51)
    assert expression.evaluate({"x": m}) == true
    assert expression.evaluate({"x": np.array([m])}).tolist() == [true]
    assert known[name].scalar(m) == true


@pytest.mark.parametrize("name", NAMES)
@given(PARAMETERS)
@example(0.0)
@example(0.04)
@example(-0.07)
@settings(max_examples=20)
def test_the_slope_is_that_of_the_exact_integral(name, m):
    """The compiled slope, and the formula's derivative where it does not divide by 0."""
    with mpmath.workdps(80):
        h = mpmath.mpf(10) ** -25 * (1 - mpmath.mpf(m))
        true = float((exact(name, m + h) - exact(name, m - h)) / (2 * h)) if abs(m) > 1e-4 else None
    plane = parse(f"{name}(c)", ("c", "s"))
    value, slope, other = program(((plane,), ())).evaluate(np.array([[m, 0.0]]))[0, 0]
    assert value == pytest.approx(plane.evaluate({"c": m}), rel=BLUR * 2.0**-51)  # compiled code fuses operations
    assert other == 0.0
    if true is not None:
        assert slope == pytest.approx(true, rel=1e-12)
    derivative = parse(f"{name}(x)", ("x",)).derivative("x")
    assert parse(derivative.text, ("x",)) == derivative
    if name != "ellipc2" or abs(m) > 0.01:
        assert derivative.evaluate({"x": m}) == pytest.approx(slope, rel=1e-10)


def test_at_the_ends():
    assert [known[name].scalar(0.0) for name in NAMES] == pytest.approx(
        [math.pi / 2, math.pi / 2, math.pi / 4, 3 * math.pi / 16, math.pi / 32], rel=1e-15
    )
    assert [known[name].scalar(1.0) for name in NAMES] == [math.inf, 1.0, 1.0, 1.0, math.inf]
    assert all(math.isnan(known[name].scalar(1.5)) for name in NAMES)
    zero = np.array([[0.0, 0.0]])
    slopes = [program(((parse(f"{name}(c)", ("c", "s")),), ())).evaluate(zero)[0, 0, 1] for name in NAMES]
    # (2n - 1)/2 times the integral of cos^(2n) sin^2: Wallis
    assert slopes == pytest.approx([math.pi * w for w in (1 / 8, -1 / 8, 1 / 32, 3 / 64, 15 / 512)], rel=1e-14)


@pytest.mark.parametrize("name", NAMES)
@given(st.floats(-2.0, 1.0), st.floats(0.0, 1.0))
@settings(max_examples=20)
def test_bounds_hold_what_is_exact(name, m, half):
    run = program(((parse(f"{name}(c)", ("c", "s")),), ()))
    out, work = np.empty((1, 6)), np.empty((len(run.op), 6))
    low, high = m - half, min(m + half, 1.0)
    enclose(*run.arrays, low, high, 0.0, 0.0, work, out)
    for at in np.linspace(low, high, 7):
        if -2.0 < at < 1.0:
            assert out[0, 0] <= exact(name, float(at)) <= out[0, 1]
            value, slope = run.evaluate(np.array([[at, 0.0]]))[0, 0, :2]
            assert out[0, 0] <= value <= out[0, 1]
            assert out[0, 2] <= slope <= out[0, 3]
    enclose(*run.arrays, low, 1.01, 0.0, 0.0, work, out)
    assert out[0, :4].tolist() == [-math.inf, math.inf, -math.inf, math.inf]
