"""The rate of a motion, its slopes and sizes, and what bounds a step."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from codim2_core import System
from codim2_core.expressions.names import MOST_SLOW_VARIABLES
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import explicit, radau, rate, slow
from codim2_core.initial_value.kernels.stages import workspace
from codim2_core.initial_value.problem import plane_problem
from codim2_core.stepping.numbers import PSI

from .placing import CURVED, HILL, TANH, motion_of


@pytest.mark.parametrize("psi", [TANH, HILL], ids=lambda psi: psi.text)
@pytest.mark.parametrize("line", [None, (0.6, -0.8), (1.0, 0.0), (0.0, 1.0)])
@pytest.mark.parametrize("eps", [0.3, 1e-4])
def test_rate_slopes_and_sizes_are_those_in_python(psi, line, eps):
    motion = motion_of(CURVED, psi, eps, line=line or (0.0, 0.0))
    problem = plane_problem(field(CURVED), psi, eps, 1e-6, 1e-8, line)
    work = workspace(4, psi.parameter)
    for y in np.random.default_rng(5).normal(size=(4, 4)) * ([eps, eps, 1.0, 1.0] if line is None else [1.0]):
        rate.rate(motion, y, work.S, work.rate)
        np.testing.assert_allclose(work.rate[:4], problem.F(y), rtol=1e-12, atol=1e-12)
        rate.sizes(motion, y, work.size)
        np.testing.assert_allclose(work.size[:4], [math.hypot(y[0], y[1], eps)] * 2 + [*(abs(y[2:]) + 0.01)])
        if line is None:
            rate.jacobian(motion, y, work.S, work.J)
            J = problem.J(y)
            np.testing.assert_allclose(work.J[:4, :4], J, rtol=1e-6, atol=1e-7 / eps)
            bound, reach = radau.linearised(motion, y, 1e3, np.zeros(4), work)
            assert bound == pytest.approx(problem.limit(y, problem.F(y), J), rel=1e-5)
            size = work.size[:4]
            assert reach == pytest.approx((abs(J) * size / size[:, None]).sum(axis=1).max(), rel=1e-5)


def test_in_contact_with_sigma_the_way_inward_bounds_no_step():
    """A straight fall, U = -(0.6, 0.8), through rho: 0.9 of the way, unless it is within 20 eps."""
    falls = System(U=("-0.6", "-0.8"))
    motion, work = motion_of(falls, TANH, 1e-3), workspace(2, 0.0)
    outside, inside = (
        radau.linearised(motion, np.array([0.6 * x, 0.8 * x]), 1.0, np.zeros(4), work)[0] for x in (0.0201, 0.0199)
    )
    assert outside == pytest.approx(0.9 * (0.0201**2 + 1e-6) / 0.0201)
    assert inside == math.inf
    rising = radau.linearised(motion, np.array([-0.3, -0.4]), 1.0, np.zeros(4), work)[0]
    assert rising == math.inf


def test_what_is_read_and_what_is_written_stands_apart():
    """One array holds the arguments, the values and the slopes of all that is called, and the rows of both methods."""
    m, rows = MOST_SLOW_VARIABLES, {k: v for k, v in vars(explicit)["_rows"].items() if k != "DENSE"}
    table = (2 + m) * (4 + m)
    of_motion = [
        (rate.RADIUS, 2), (rate.GAIN, 1), (PSI, 1), (rate.ARGUMENTS, 4 + m), (rate.VALUE, 2 + m), (rate.SLOPES, table),
        *((row, explicit.WIDTH) for row in rows.values()), (explicit.DENSE, explicit.DEGREE * explicit.WIDTH),
    ]  # fmt: skip
    of_slide = [
        (slow.VALUE, 1), (slow.SLOPES, 1), (slow.SLOW, 1), (slow.PLACE, 4 + m), (slow.RATES, 4 + m), (slow.TABLE, table)
    ]  # fmt: skip
    for spans, end in ((of_motion, explicit.ROOM), (of_motion + of_slide, slow.EXTENT)):
        spans = sorted(spans)
        assert spans[0][0] >= 0
        for (at, count), (then, _) in pairwise([*spans, (end, 0)]):
            assert at + count <= then
    assert len(workspace(3, 0.25).S) == explicit.ROOM
    assert workspace(3, 0.25).S[PSI] == 0.25
