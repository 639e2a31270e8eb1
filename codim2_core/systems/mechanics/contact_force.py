"""Whether a contact presses, opens or jams: the normal force at a state, and what it makes of itself.

The normal force N of a constraint with the row Jn gives, with the friction that it brings, the normal acceleration
``-b + p N``: b is how much the bodies approach without it, ``p = Jn M^-1 (Jn^T - J^T mu e)``. So N = b/p while b > 0
and p > 0; the contact opens where b falls through 0. Where friction makes p <= 0, Painlevé's paradox, a normal force
presses the bodies together: with b > 0 no normal force holds them apart, and the contact jams; with b <= 0 both N = 0
and N = b/p do, and the motion is not unique. In three dimensions p depends on the direction of the slip (M. Cheesman,
S. J. Hogan, K. U. Kristiansen, 2021).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...results.words import say

SENTENCE_OF_KIND = {
    "presses": "contact presses",
    "opens": "contact opens",
    "jams": "contact jams",
    "not unique": "contact not unique",
}


@dataclass(frozen=True)
class ContactForce:
    """The normal force at a state.

    Attributes
    ----------
    approach : float
        Normal acceleration with which the bodies approach without a normal force; N itself where N is given.
    gain : float
        Normal acceleration that a normal force of 1 gives, with its friction; 1 where N is given.
    """

    approach: float
    gain: float = 1.0

    @property
    def normal(self) -> float:
        """The normal force; NaN where there is none that holds, or more than one."""
        return self.approach / self.gain if self.kind == "presses" else 0.0 if self.kind == "opens" else math.nan

    @property
    def kind(self) -> str:
        """Return "presses", "opens", "jams" (Painlevé: no normal force holds) or "not unique" (Painlevé: two do)."""
        if self.gain > 0.0:
            return "presses" if self.approach > 0.0 else "opens"
        return "jams" if self.approach > 0.0 else "not unique"

    @property
    def sentence(self) -> str:
        """Return what happens to the contact, and why."""
        return say(SENTENCE_OF_KIND[self.kind])


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
