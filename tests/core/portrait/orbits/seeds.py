"""Seeds, families of Psi, and the ends of trajectories that nothing stops early."""

import numpy as np

from codim2_core import psi
from codim2_core.portrait.orbits.trajectories import trajectories
from codim2_core.systems.elinear import ELinear

FAMILIES = [
    psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(4.0), psi.hill(3.7), psi.hill(200.0),
    psi.custom("1/(1+s)**2"),
]  # fmt: skip
NAMES = [p.text for p in FAMILIES]
PIXEL = 1.0 / 180.0
CASE_I = ELinear(-2.0, 0.5, -1.0, (-0.5, 0.2))


def sunflower(count, radius=0.97):
    k = np.arange(count)
    r, t = radius * np.sqrt((k + 0.5) / count), 2.399963 * k + 0.4
    return np.stack([r * np.cos(t), r * np.sin(t)], axis=-1)


def ring(count, radius):
    t = 2 * np.pi * (np.arange(count) + 0.38) / count
    return radius * np.stack([np.cos(t), np.sin(t)], axis=-1)


def ends(system, p, seeds, tolerance=1e-12, **options):
    """Final states at t_max, with no early end."""
    options = {"t_max": 8.0, "capture": 1e-15, "view": 1e12} | options
    return trajectories(system, p, seeds, rtol=tolerance, atol=max(tolerance, 1e-15), samples="ends", **options)


def only(result):
    assert len(set(result.status)) == 1, result.status
    return result.status[0]
