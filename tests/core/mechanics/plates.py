"""Rigid plates on feet, and their regularised equations of motion written again, for other solvers."""

from collections.abc import Callable
from dataclasses import dataclass

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


@dataclass(frozen=True)
class Driven:
    """A plate in the axes of the ground, its feet (x, y, mu, N) in its own: it turns by phi, and springs hold it.

    The force is ``(F1 cos(om t) - k qx, F2 sin(om t) - k qy, T cos 1.3 t)``, the state (u, v, w, phi, qx, qy, t).
    """

    mass: float
    inertia: float
    feet: tuple[tuple[float, float, float, float], ...]
    push: tuple[float, float]
    omega: float
    spring: float
    torque: float

    def contacts(self) -> Contacts:
        """Return the mechanism."""
        (F1, F2), k, om = self.push, self.spring, self.omega
        rows = [
            (((1, 0, f"-({x})*sin(phi) - ({y})*cos(phi)"), (0, 1, f"({x})*cos(phi) - ({y})*sin(phi)")), mu, normal)
            for x, y, mu, normal in self.feet
        ]
        force = f"({F1})*cos({om}*tt) - {k}*qx", f"({F2})*sin({om}*tt) - {k}*qy", f"({self.torque})*cos(1.3*tt)"
        M = np.diag([self.mass, self.mass, self.inertia]).tolist()
        return contacts(M, rows, force, ("u", "v", "w"), {"phi": "w", "qx": "u", "qy": "v", "tt": 1})

    def rate(self, eps: float) -> Callable[..., np.ndarray]:
        """Return (u, v, w, phi, qx, qy)' by Newton and Euler, with friction ``-mu N x/sqrt(x^2 + eps^2)``."""
        x, y, mu, normal = np.array(self.feet).T

        def rate(t: float, state: np.ndarray) -> np.ndarray:
            u, v, w, phi, qx, qy = state
            px, py = x * np.cos(phi) - y * np.sin(phi), x * np.sin(phi) + y * np.cos(phi)
            slip = np.stack([u - w * py, v + w * px])
            pull = -mu * normal * slip / np.sqrt((slip**2).sum(axis=0) + eps**2)
            X = pull[0].sum() + self.push[0] * np.cos(self.omega * t) - self.spring * qx
            Y = pull[1].sum() + self.push[1] * np.sin(self.omega * t) - self.spring * qy
            turning = (px * pull[1] - py * pull[0]).sum() + self.torque * np.cos(1.3 * t)
            return np.array([X / self.mass, Y / self.mass, turning / self.inertia, w, u, v])

        return rate
