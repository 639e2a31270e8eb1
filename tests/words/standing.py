"""One system at one z with what stands still there, looked for anew."""

import math

import numpy as np

import codim2_core as c2


def near(one, other, width):
    return math.cos(one - other) > math.cos(width)


class At:
    """One system at one z, with what stands still there."""

    def __init__(self, system, family, z=()):
        self.psi, self.at = family, system.at(z or (0.0,) * system.m)
        self.equator = c2.equator_equilibria(system, z or (0.0,) * system.m)
        self.cycle = c2.equator_cycle(self.at)
        self.sets = c2.critical_sets(self.at, family)

    def theta(self, angle):
        u, v = self.at.U(np.array([math.cos(angle), math.sin(angle)]))
        return math.cos(angle) * v - math.sin(angle) * u

    def directions(self, angle, width=0.2):
        return [i for i, t in enumerate(self.equator.theta.tolist()) if near(t, angle, width)]

    def cycles(self):
        return c2.limit_cycles(self.at, self.psi)

    @property
    def length(self):
        """|A^-1 f|."""
        q = self.at.normal_form
        return float(np.hypot(*np.linalg.solve(q.A, q.f)))

    @property
    def determinant(self):
        return float(np.linalg.det(self.at.normal_form.A))


def order(at, angle):
    """With which power Θ leaves zero there, on the two sides."""
    near_, far = (np.abs([at.theta(angle + s * h) for s in (1, -1)]).max() for h in (2e-3, 4e-3))
    return round(math.log2(far / near_))
