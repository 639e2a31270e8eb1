"""Rigid plates on feet, and their regularised equations of motion written again, for other solvers."""

from collections.abc import Callable

import numpy as np

from codim2_core.mechanics import Contacts, contacts

MASS, INERTIA, MU = 2.0, 0.5, 0.3


def foot(x: float, y: float, normal: float, mu: float = MU):
    """Return a foot at (x, y), by the velocities (u, v, w) in the plate's own axes."""
    return ((1, 0, -y), (0, 1, x)), mu, normal


def plate(feet, force=(0, 0, 0), **more) -> Contacts:
    """Return a plate that slides on its feet: in its own axes, (u, v) turns with it."""
    own = ("{0}*w*v + ({1})", "-{0}*w*u + ({1})", "0*{0} + ({1})")
    rows = [text.format(MASS, part) for text, part in zip(own, force, strict=True)]
    return contacts(np.diag([MASS, MASS, INERTIA]).tolist(), feet, rows, ("u", "v", "w"), **more)


def shaken_plate(places: np.ndarray, loads: np.ndarray, push: np.ndarray) -> Contacts:
    """Return a plate under the push ``(F1 sin 2t, F2 cos 2t, T cos t)``."""
    F1, F2, T = push.tolist()
    feet = [foot(x, y, load) for (x, y), load in zip(places.tolist(), loads.tolist(), strict=True)]
    return plate(feet, (f"{F1}*sin(2*t)", f"{F2}*cos(2*t)", f"{T}*cos(t)"), rates={"t": 1})


def shaken_rate(places: np.ndarray, loads: np.ndarray, push: np.ndarray, eps: float) -> Callable[..., np.ndarray]:
    """Return (u, v, w)' of the same plate by Newton and Euler, with friction ``-mu N x/sqrt(x^2 + eps^2)``."""

    def rate(t: float, state: np.ndarray) -> np.ndarray:
        u, v, w = state
        slip = np.stack([u - w * places[:, 1], v + w * places[:, 0]])
        pull = -MU * loads * slip / np.sqrt((slip**2).sum(axis=0) + eps**2)
        X, Y = pull.sum(axis=1) + push[:2] * (np.sin(2.0 * t), np.cos(2.0 * t))
        turning = (places[:, 0] * pull[1] - places[:, 1] * pull[0]).sum() + push[2] * np.cos(t)
        return np.array([w * v + X / MASS, -w * u + Y / MASS, turning / INERTIA])

    return rate
