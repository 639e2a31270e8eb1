"""Orbits whose turns are known: for Psi = 1 and f = 0, x2' = A x2 in the time T, as e_Psi = p and dT = ebar dtau."""

import math

import numpy as np
import pytest

from codim2_core import psi
from codim2_core.portrait.cycles.ray_section_kernel import first_turns
from codim2_core.portrait.stepping.layout import LANES, SHARED_SIZE
from codim2_core.portrait.stepping.right_hand_side import field_of_psi

SEVERAL = 2 * LANES + 1
FIELD = field_of_psi(psi.constant())
RTOL = 1e-12


def parameters(a, b, d, f=(0.0, 0.0)):
    shared = np.zeros(SHARED_SIZE)
    shared[:5] = a, b, d, *f
    return shared


def sphere(x2):
    """States (n, 3) of points (n, 2) of kappa_2."""
    w = 1.0 / np.hypot(1.0, np.hypot(*x2.T))
    return np.column_stack([x2 * w[:, None], w])


def plane(states):
    return states[:, :2] / states[:, 2:]


def turned(x2, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * x2[..., 0] - s * x2[..., 1], s * x2[..., 0] + c * x2[..., 1]], axis=-1)


class Spiral:
    """``A = growth + b J``: orbits turn by b T and grow by exp(growth T)."""

    def __init__(self, growth, b, f=(0.0, 0.0)):
        self.growth, self.b = growth, b
        self.shared = parameters(growth, b, growth, f)

    def at(self, x2, T):
        return turned(x2, self.b * T) * np.exp(self.growth * T)[..., None]

    def turns(self, x2, **options):
        """Follow orbits from points (n, 2) of kappa_2 until they have turned about the critical set."""
        return followed(sphere(x2), self.shared, **options)


def followed(
    states, shared, centre=(0.0, 0.0), goal=math.tau, sense=0, floor=1e-9, sunk=1e-9, t_max=1e3, rtol=RTOL, limit=500,
    record=0,
):  # fmt: skip
    *found, steps = first_turns(
        states, shared, FIELD.address, np.array(centre), np.full(len(states), goal), sense, floor, sunk, t_max, rtol,
        limit, record,
    )  # fmt: skip
    return *found, steps[:, :4]


SPIRALS = pytest.mark.parametrize(("growth", "b"), [(-0.2, 1.0), (0.15, 1.3), (0.1, -0.8), (-0.1, -1.1)])
