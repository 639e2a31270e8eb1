"""Rigid plates on feet, and their regularised equations of motion written again, for other solvers."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from codim2_core.formulas.expression import parse
from codim2_core.systems.mechanics import Contacts, contacts

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


LOADS = (
    "{a}*sign(sin({w}*tm + {p}))", "{a}*max(0, tm - {t})", "{a}*exp(-((tm - {t})/{s})^2)", "{a}*(abs(tm - {t}) < {s})",
    "{a}*mod(tm, {t})", "{a}*min(1, abs(tm - {t}))", "{a}*floor({w}*tm)*cos({w}*tm)", "{a}*tanh((tm - {t})/{s})",
)  # fmt: skip


@dataclass(frozen=True)
class Blocks:
    """Two blocks of 1 kg in two dimensions joined by a spring of stiffness k, under loads: (u1, v1, u2, v2, l, tm)."""

    bounds: tuple[float, float]
    k: float
    loads: tuple[str, str, str, str]

    @classmethod
    def drawn(cls, rng: np.random.Generator) -> "Blocks":
        """Return random ones."""

        def load() -> str:
            parts = [("a", -3.0, 3.0), ("w", 0.5, 4.0), ("p", 0.0, 6.0), ("t", 0.5, 3.5), ("s", 0.003, 0.3)]
            return str(rng.choice(LOADS)).format(**{name: round(rng.uniform(a, b), 3) for name, a, b in parts})

        low, high = np.round(rng.uniform(0.4, 2.0, 2), 2).tolist()
        return cls((low, high), round(rng.uniform(0.0, 5.0), 2), (load(), "0", load(), load()))

    def contacts(self) -> Contacts:
        """Return the mechanism."""
        rows = ((1, 0, 0, 0), (0, 1, 0, 0)), ((0, 0, 1, 0), (0, 0, 0, 1))
        first, second, third, fourth = self.loads
        return contacts(
            np.eye(4).tolist(), [(row, bound, 1) for row, bound in zip(rows, self.bounds, strict=True)],
            (f"{first} + {self.k}*l", second, f"{third} - {self.k}*l", fourth), ("u1", "v1", "u2", "v2"),
            {"l": "u2 - u1", "tm": 1},
        )  # fmt: skip

    def tiny_steps(self, t_end: float, h: float = 1e-4) -> np.ndarray:
        """Return (u1, v1, u2, v2, l) by steps of Moreau: the load gives an impulse, then friction takes its most."""
        mid = (np.arange(round(t_end / h)) + 0.5) * h
        F = np.stack([parse(text, ("tm",)).evaluate({"tm": mid}) for text in self.loads], axis=-1).reshape(-1, 2, 2)
        v, stretch, most = np.zeros((2, 2)), 0.0, h * np.array(self.bounds)
        for push in F * h:
            pull = h * self.k * (stretch + 0.5 * h * (v[1, 0] - v[0, 0]))
            v = v + push + [[pull, 0.0], [-pull, 0.0]]
            size = np.hypot(*v.T)
            v = v * np.maximum(0.0, 1.0 - most / np.maximum(size, 1e-300))[:, None]
            stretch += h * (v[1, 0] - v[0, 0])
        return np.array([*v.ravel(), stretch])
