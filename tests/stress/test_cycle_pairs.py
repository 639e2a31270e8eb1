"""Limit cycles of random systems of Case III, close pairs among them: no fewer than brute force finds."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, psi
from codim2_core.portrait.cycles.limit_cycles import limit_cycles

from .oracle import fixed_points


@st.composite
def case_III(draw):
    unit = st.floats(0.0, 1.0)
    a, d = draw(st.floats(0.1, 3.0)), -draw(st.floats(0.1, 3.0))
    b = math.sqrt(-a * d) * (1.01 + 1.5 * draw(unit) ** 2) * draw(st.sampled_from([-1, 1]))
    r, t = 0.03 + 0.92 * draw(unit), 2 * math.pi * draw(unit)
    f = -np.array([[a, -b], [b, d]]) @ [r * math.cos(t), r * math.sin(t)]
    return (a, b, d), (float(f[0]), float(f[1])), draw(st.sampled_from([1, 2, 3, 4, 6, 10]))


@settings(max_examples=4)
@given(case_III())
def test_no_fewer_than_brute_force_finds(drawn):
    abd, f, n = drawn
    cycles = limit_cycles(ELinear(*abd, f), psi.hill(n))
    if any(cycle.kind == "semistable" for cycle in cycles):
        return
    assert len(cycles) >= len(fixed_points(abd, f, n))
