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
from dataclasses import dataclass

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
