"""Sign changes of a function where doubles are too coarse to go on."""

import numpy as np

from codim2_core.numerics.sign_changes import roots


def test_a_dip_narrower_than_doubles_hides_nothing():
    """Around 10^15 doubles are 1/8 apart; the root of the distance falls, grid by grid, until no double is between."""
    dip = lambda x: np.sqrt(np.abs(x - 1e15 - 0.37))
    grid = 1e15 + np.linspace(-3.0, 3.0, 8)
    found = roots(dip, [grid], [dip(grid)])
    assert not len(found[0][0])
    assert not len(found[1][0])
