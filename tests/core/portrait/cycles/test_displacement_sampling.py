"""Samples of a displacement, on sections made up so that every answer is known."""

import math

import numpy as np
import pytest

from codim2_core.portrait.cycles.displacement_sampling import Samples, near_fold, zeros
from codim2_core.portrait.cycles.ray_section import COARSE_RTOL, FINE_RTOL

from .sections import UNEVEN, Line


@pytest.mark.parametrize("apart", [1e-1, 1e-2, 1e-3])
@pytest.mark.parametrize("backward", [False, True])
def test_two_zeros_close_together_are_separated(apart, backward):
    at = (0.3123, 0.3123 + apart, -1.1)
    f = lambda xi: (xi - at[0]) * (xi - at[1]) * (xi - at[2])
    samples = Samples(Line(f), np.linspace(-3.0, 3.0, 24), backward)
    assert samples.resolve(lambda xi, shift: [])
    changes, touching, band = zeros(samples.q, samples.shift, samples.noise)
    assert (len(changes), touching, band) == (3, [], False)
    for (i, j), root in zip(changes, sorted(at), strict=True):
        assert samples.xi[i] <= root <= samples.xi[j]
        if apart < 0.1 and root > 0.0:  # what is close together is judged by samples that are all fine
            assert samples.fine[i - 1 : j + 2].all()
    assert len(samples.xi) < 200
    assert np.sign(samples.shift[0]) == (1.0 if backward else -1.0)


def test_a_fold_is_touched_and_a_map_too_wild_is_said_to_be():
    samples = Samples(Line(lambda xi: (xi - 0.4) ** 2), np.linspace(-3.0, 3.0, 24))
    assert samples.resolve(lambda xi, shift: [])
    changes, touching, _ = zeros(samples.q, samples.shift, samples.noise)
    assert changes == []
    assert [samples.xi[i] for i in touching] == [pytest.approx(0.4, abs=1e-4)]
    assert np.diff(samples.xi).min() > 2e-6 / 33  # narrower than `NARROWEST` nothing is divided
    wild = Samples(Line(lambda xi: np.sin(3e4 * xi) + 0.5), np.linspace(-3.0, 3.0, 24))
    assert not wild.resolve(lambda xi, shift: [])
    assert 900 < len(wild.xi) <= 4 * 900
    lost = Samples(Line(lambda xi: np.where(xi < 1.0, np.nan, 1.0)), np.linspace(-3.0, 3.0, 24))
    assert not lost.resolve(lambda xi, shift: [0])
    assert len(lost.xi) == 24
    looked = Samples(Line(lambda xi: 1.0 + 0.0 * xi), np.linspace(-3.0, 3.0, 24))
    assert looked.resolve(lambda xi, shift: [i for i in (3, 9) if xi[i + 1] - xi[i] > 0.1])
    assert len(looked.xi) == 24 + 2 * 16
    # where nothing is doubtful, only signs are looked for
    assert {rtol for _, rtol, _ in looked.section.asked} == {COARSE_RTOL}
    assert not looked.fine.any()
    doubtful = Samples(Line(lambda xi: (xi - 0.4) ** 2 + 1e-3), np.linspace(-3.0, 3.0, 24))
    assert doubtful.resolve(lambda xi, shift: [i for i in (3, 9) if xi[i + 1] - xi[i] > 0.1])
    assert {rtol for _, rtol, _ in doubtful.section.asked[1:2]} == {FINE_RTOL}


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(("centre", "height", "bend"), [(0.37, 3e-4, 2.0), (1.62, -0.2, 0.3), (2.11, 5.0, 70.0)])
def test_how_near_a_fold_is_the_height_of_a_parabola(centre, height, bend, sign):
    """Wherever its vertex lies between uneven samples."""
    shift = sign * (height + bend * (UNEVEN - centre) ** 2)
    assert near_fold(UNEVEN, shift, np.zeros(8)) == pytest.approx(abs(height), rel=1e-9, abs=1e-12)
    assert near_fold(-UNEVEN[::-1], shift[::-1], np.zeros(8)) == pytest.approx(abs(height), rel=1e-9, abs=1e-12)
    broken = np.where(np.abs(UNEVEN - centre) < 0.45, np.nan, shift)
    assert near_fold(UNEVEN, broken, np.zeros(8)) == math.inf  # its vertex is not seen
