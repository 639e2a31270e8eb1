"""General systems that several tests share."""

import numpy as np
from hypothesis import strategies as st

from codim2_core.systems.typed import System

ATTRACTING = System(U=("2*c**2 - c - 1/2", "-s"), W=("-z",))  # eq:ex4p5
NONUNIQUE = System(
    U=("-c*(c - chi(z)/2)*(c + chi(z)/2)", "-s/2"), W=("-2*c + 1/4",), definitions={"chi(z)": "(1 + 2*z**2)/(1 + z**2)"}
)  # eq:exmult

_number = st.floats(-2.0, 2.0, allow_subnormal=False).map(lambda v: round(v, 3) + 0.0)
_MONOMIALS = ["1", "c", "s", "c**2", "c*s", "s**2", "c**3", "c**2*s", "c*s**2", "s**3", "c**4", "c**3*s", "c**2*s**2"]


def _polynomial(coefficients):
    terms = zip(coefficients, _MONOMIALS, strict=False)
    return " + ".join(f"({a!r})*{monomial}" for a, monomial in terms)


def _rows(count):
    row = st.lists(_number, min_size=count, max_size=count).map(_polynomial)
    return st.tuples(row, row)


polynomials = st.sampled_from([3, 6, 10, 13]).flatmap(_rows).map(lambda U: System(U=U))
smooth = st.builds(
    lambda U, k: System(U=(f"{U[0]} + {k}*exp(c*s)", f"{U[1]} + sin({k}*c + s)/(2 + s)")), _rows(3), _number
)


def circle(n, radius=1.0):
    theta = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    return theta, radius * np.stack([np.cos(theta), np.sin(theta)], axis=-1)


def turns(at, n=20_001, radius=1.0):
    """Degree of U on a circle by adding up angles; None where U comes too near 0 for that."""
    U = at.U(circle(n, radius)[1])
    if np.hypot(U[:, 0], U[:, 1]).min() <= 1e-3 * np.abs(U).max():
        return None
    angles = np.unwrap(np.arctan2(U[:, 1], U[:, 0]), period=2 * np.pi)
    last = np.arctan2(U[0, 1], U[0, 0]) - np.arctan2(U[-1, 1], U[-1, 0])
    last = (last + np.pi) % (2 * np.pi) - np.pi
    return round((angles[-1] - angles[0] + last) / (2 * np.pi))
