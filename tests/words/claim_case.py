"""A system at one z, with what is claimed of it held against."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import psi

ONE, HILL = psi.constant(), psi.hill(3)
NET = (np.arange(4000) + 0.37) * (math.tau / 4000)
CIRCLE = np.stack([np.cos(NET), np.sin(NET)], axis=-1)


class Case:
    """A system at one z, with what its claims may be held against."""

    def __init__(self, system, family, z=(), cycles=None):
        self.system, self.psi, self.cycles = system, family, cycles
        self.z = z or (0.0,) * system.m
        self.at = system.at(self.z)
        U = self.at.U(CIRCLE)
        self.theta = CIRCLE[:, 0] * U[:, 1] - CIRCLE[:, 1] * U[:, 0]
        self.size = max(self.at.size, 1e-9)
        self.name = c2.classify(self.at, family)
        self.degenerate = bool(self.name.degeneracies)

    @property
    def directions(self):
        return int((np.sign(self.theta) != np.sign(np.roll(self.theta, 1))).sum())

    @property
    def sets(self):
        """Zeros of U in the open disc, by Newton's method from a net."""
        e = np.concatenate([r * CIRCLE[::160] for r in (0.05, 0.3, 0.55, 0.8, 0.97)])
        for _ in range(60):
            h = 1e-6
            base = self.at.U(e)
            J = np.stack([(self.at.U(e + h * np.eye(2)[k]) - base) / h for k in (0, 1)], axis=-1)
            J = J + 1e-12 * self.size * np.eye(2)
            e = e - np.clip(np.linalg.solve(J, base[:, :, None])[:, :, 0], -0.3, 0.3)
        good = (np.abs(self.at.U(e)).max(axis=1) < 1e-9 * self.size) & (np.hypot(*e.T) < 1.0 - 1e-9)
        return np.unique(np.round(e[good], 5) + 0.0, axis=0)

    @property
    def matrix(self):
        f = self.at.U(np.zeros(2))
        return np.stack([self.at.U(np.eye(2)[k]) - f for k in (0, 1)], axis=-1), f

    @property
    def form(self):
        return self.at.normal_form

    @property
    def length(self):
        A, f = self.matrix
        return float(np.hypot(*np.linalg.solve(A, f)))

    def linear(self):
        """Whether U is affine in e, by values."""
        A, f = self.matrix
        return float(np.abs(self.at.U(0.7 * CIRCLE) - (0.7 * CIRCLE @ A.T + f)).max()) < 1e-9 * self.size


def e_psi(family, xy, eps=1.0):
    s = (xy**2).sum(axis=-1) / eps**2
    return xy / np.sqrt((xy**2).sum(axis=-1) + eps**2 * np.asarray(family(s)))[..., None]


PLACES = 10.0 ** np.linspace(-2, 2, 9)[:, None, None] * CIRCLE[None, ::400]


def ok(test):
    """A check from something that is true or false."""
    return lambda case, fields: test(case, fields) or pytest.fail(f"it is not so: {fields}")
