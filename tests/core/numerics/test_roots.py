"""One root by values about it."""

import numpy as np
import pytest

from codim2_core.numerics.root_between import root_through


@pytest.mark.parametrize("count", [2, 3, 4, 6])
def test_it_is_exact_where_the_place_is_a_polynomial_of_the_value(count):
    place = np.polynomial.Polynomial(np.random.default_rng(count).normal(size=count))
    values = np.linspace(-1.3, 0.9, count)
    assert root_through(place(values), values) == pytest.approx(place(0.0), abs=1e-12)


def test_it_finds_a_root_that_is_no_sample():
    x = np.array([0.7, 0.75, 0.8, 0.85])
    assert root_through(x, np.cos(2.0 * x)) == pytest.approx(np.pi / 4.0, abs=1e-6)
