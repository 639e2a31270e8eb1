"""A state where the kernels read it."""

import math
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from codim2_core import System
from codim2_core import psi as families
from codim2_core.motion.initial_value.field import field
from codim2_core.motion.initial_value.functions import functions_of
from codim2_core.motion.initial_value.kernels import slow
from codim2_core.motion.initial_value.kernels.rate import MotionConstants

CURVED = System(
    U=("-2*c + 1.5*c*s + 2.4*sin(z1) + 0.3*x", "-s + 0.9*cos(z1) - 0.2*y*z2 + 0.4*c**2"),
    W=("1 + c*y - 0.3*s", "0.4*c - z2 + x*s"),
)
TANH, HILL = families.tanh(), families.hill(3)


def placed(system, z, psi=TANH):
    """The workspace that the kernels read, with z in place."""
    S, own = np.zeros(slow.SLOW_EXTENT), functions_of(field(system), psi)
    own.enter(S)
    S[slow.VALUE : slow.SLOPES + 1] = own.addresses[:2].view(float)
    S[slow.SLOW_RATES] = len(z)
    S[slow.SET_PLACE + 4 : slow.SET_PLACE + 4 + len(z)] = z
    return S


def motion_of(system, psi, eps, rtol=1e-6, floor=0.01, line=(0.0, 0.0)):
    own = functions_of(field(system), psi).addresses.tolist()
    return MotionConstants(*own, 2 + system.m, eps, rtol, floor, *line, 0.0)


def directions(system, z):
    """The zeros of Theta."""
    at = field(system)

    def theta_rate(t):
        u, v = at.value(math.cos(t), math.sin(t), 0.0, 0.0, *z)[:2]
        return math.cos(t) * v - math.sin(t) * u

    net = np.linspace(-math.pi, math.pi, 60)
    return [brentq(theta_rate, a, b, xtol=1e-15) for a, b in pairwise(net) if theta_rate(a) * theta_rate(b) < 0.0]
