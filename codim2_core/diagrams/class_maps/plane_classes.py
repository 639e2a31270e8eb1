"""The classes of e-linear systems over one or two parameters: signs of smooth functions, many points at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..sweep import UNDEFINED, Sweep, class_name, classes
from .classes import Array, Codes

__all__ = ["PlaneClasses", "happening"]


@dataclass(frozen=True, eq=False)
class PlaneClasses:
    """Classes of an e-linear family, see `classes.Named`.

    Attributes
    ----------
    family : Sweep
    symmetric : bool
        b = 0 and f1 = 0 or f2 = 0 everywhere: limit directions split in pitchforks.
    """

    family: Sweep
    symmetric: bool

    @classmethod
    def over(cls, family: Sweep, spans: tuple[tuple[float, float], ...]) -> PlaneClasses:
        """Look at the corners of the spans for a symmetry."""
        corner = family(**{name: np.array(span) for name, span in zip(family.names, spans, strict=True)})
        return cls(family, bool(not corner.b.any() and (not corner.f1.any() or not corner.f2.any())))

    @property
    def unproved(self) -> int:
        """Points without a proof: none, they are closed forms."""
        return 0

    def decided(self, at: Array) -> Codes:
        """Classes at points."""
        return classes(self.family(**dict(zip(self.family.names, at.T, strict=True))))

    def happening(self, before: int, after: int) -> tuple[str, ...]:
        """Name what happens between two classes."""
        return happening(before, after, self.symmetric)

    def name(self, code: int) -> str:
        """Name a class."""
        return class_name(code)


def happening(before: int, after: int, symmetric: bool) -> tuple[str, ...]:
    """Name what happens between two classes.

    Parameters
    ----------
    before, after : int
    symmetric : bool
        b = 0 and f1 = 0 or f2 = 0 everywhere: limit directions split in pitchforks.

    Returns
    -------
    tuple of str
        Of "saddle-node", "pitchfork", "transcritical", "det A = 0", "Hopf", "node-focus", "undefined".
    """
    if before == after:
        return ()
    if UNDEFINED in (before, after):
        return ("undefined",)
    found = []
    (count, kind), (count_, kind_) = divmod(before, 8), divmod(after, 8)
    if count != count_:
        found.append("pitchfork" if symmetric else "saddle-node")
    if kind != kind_:
        if not kind or not kind_:
            found.append("transcritical")
        elif 1 in (kind, kind_):
            found.append("det A = 0")
        elif 6 in (kind, kind_):
            found.append("Hopf")
        else:
            if (kind <= 3) != (kind_ <= 3):
                found.append("Hopf")
            if kind % 2 != kind_ % 2:
                found.append("node-focus")
            if kind % 2 == kind_ % 2 == 0:
                found.append("node-focus")  # from a stable to an unstable node: through a thin strip of foci
    return tuple(found)
