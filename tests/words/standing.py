"""One system at one z with what stands still there, looked for anew."""

import numpy as np

import codim2_core as c2


class At:
    """One system at one z, with what stands still there."""

    def __init__(self, system, family, z=()):
        self.psi, self.at = family, system.at(z or (0.0,) * system.m)
        self.equator = c2.equator_equilibria(system, z or (0.0,) * system.m)
        self.cycle = c2.equator_cycle(self.at)
        self.sets = c2.critical_sets(self.at, family)

    def cycles(self):
        return c2.limit_cycles(self.at, self.psi)

    @property
    def length(self):
        """|A^-1 f|."""
        q = self.at.normal_form
        return float(np.hypot(*np.linalg.solve(q.A, q.f)))
