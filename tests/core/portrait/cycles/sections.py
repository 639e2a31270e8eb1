"""Sections made up so that every answer is known, and orbits that are circles."""

import numpy as np

UNEVEN = np.array([0.0, 0.3, 0.5, 1.1, 1.2, 2.0, 2.3, 3.1])


class Line:
    """A section with a displacement that is a function of xi; q is 2 xi."""

    def __init__(self, displacement):
        self.given, self.asked = displacement, []

    def states(self, xi):
        return np.zeros((len(xi), 3)), 2.0 * xi

    def displacement(self, xi, rtol=1e-9, backward=False, noise=0.0):
        self.asked.append((len(xi), rtol, backward))
        with np.errstate(all="ignore"):
            return self.given(np.asarray(xi, float)) * (-1.0 if backward else 1.0)
