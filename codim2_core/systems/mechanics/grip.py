"""Whether a contact grips: the friction that sticking needs, next to what there is."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...results.words import say

ROUNDINGS = 16  # operations that what is given to a grip has gone through, at most, each off by half a unit


@dataclass(frozen=True, eq=False)
class Grip:
    """The friction that sticking needs, and that there is; in the units of the mechanism's forces.

    Attributes
    ----------
    needed : ndarray (2,)
        Friction with which the point of contact would stick.
    normal : float
        The normal force then.
    mu : ndarray (2, 2)
        Coulomb's coefficient: there is friction up to N mu e, |e| = 1.
    held : bool
        Whether the normal force is that of a constraint.
    """

    needed: NDArray[np.float64]
    normal: float
    mu: NDArray[np.float64]
    held: bool = False
    _errors: tuple[float, ...] = field(default=(0.0, 0.0, 0.0), repr=False)  # of needed and normal, by rounding

    @cached_property
    def e(self) -> NDArray[np.float64]:
        """Point e (2,) at which friction -N mu e sticks: the critical set, inside. Infinite where mu has no inverse."""
        available = self.normal * self.mu
        if abs(np.linalg.det(available)) == 0.0:
            return np.full(2, np.inf) if self.needed.any() else np.zeros(2)
        return np.asarray(-np.linalg.solve(available, self.needed), np.float64)

    @property
    def share(self) -> float:
        """|e|: the share of the friction that there is, which sticking needs; it is enough up to 1."""
        return float(np.hypot(*self.e))

    @cached_property
    def _share_error(self) -> float:
        """Bound of the error of |e| by rounding."""
        if not np.isfinite(self.e).all() or not self.e.any():
            return 0.0
        relative = ROUNDINGS * np.finfo(float).eps + self._errors[2] / abs(self.normal)
        lost = np.array(self._errors[:2]) + relative * (np.abs(self.normal * self.mu) @ np.abs(self.e))
        return float(np.hypot(*(np.abs(np.linalg.inv(self.normal * self.mu)) @ lost)))

    @property
    def sticks(self) -> bool:
        """Whether it can stick: the normal force presses, and the friction that there is is enough, or just enough."""
        return self.normal > 0.0 and self.share <= 1.0 + self._share_error

    def edge(self, count: int = 96) -> NDArray[np.float64]:
        """Return the friction cone at this normal force: points N mu e (count, 2), by direction of e."""
        theta = np.arange(count) * (2.0 * np.pi / count)
        return self.normal * np.stack([np.cos(theta), np.sin(theta)], axis=-1) @ self.mu.T

    @property
    def sentence(self) -> str:
        """Return the verdict for an engineer."""
        needed = float(np.hypot(*self.needed))
        if not self.normal > 0.0:
            return say("cannot stick, opens", normal=self.normal)
        there = needed / self.share if 0.0 < self.share < np.inf else self.normal * float(np.linalg.norm(self.mu, 2))
        if not self.sticks:
            return say("grip lost", needed=needed, there=0.0 if self.share == np.inf else there)
        if self.share >= 1.0 - self._share_error:
            return say("grips just", needed=needed)
        # Coulomb's law with one mu: the matrix A = -N mu J M^-1 J^T is negative definite, so the set is stable
        certain = not self.held and self.mu[0, 0] == self.mu[1, 1] and not self.mu[0, 1] and not self.mu[1, 0]
        return say("grips" if certain else "can grip", needed=needed, there=there)
