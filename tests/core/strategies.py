"""Hypothesis strategies shared by the core's tests."""

from hypothesis import strategies as st

from codim2_core import ELinear
from codim2_core import psi as families

coefficient = st.floats(-5.0, 5.0, allow_subnormal=False).map(lambda v: round(v, 6) + 0.0)
systems = st.builds(
    lambda a, b, d, f1, f2: ELinear(a, b, d, (f1, f2)), coefficient, coefficient, coefficient, coefficient, coefficient
)
regularisations = st.one_of(
    st.sampled_from([families.constant(), families.rational(), families.exponential(), families.tanh()]),
    st.integers(1, 16).map(families.hill),
    st.sampled_from(["1/(1+s)**2", "1/(1+s/3)", "exp(-s/2)"]).map(families.custom),
)
