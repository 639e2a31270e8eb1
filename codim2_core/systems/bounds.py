"""Bounds of the numbers of a system, and the check of a z."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Sequence
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

# Products of two coefficients (det A, |adj A f|^2 needs four, after scaling) must stay finite.
MAX_NUMBER, MIN_NUMBER = 1e150, 1e-150


def at_place(z: Sequence[float], e: Sequence[float] = ()) -> str:
    """Write e and z for a sentence: " at e = (0.35, 0), z = 2"; nothing where there is neither."""
    parts = [f"e = ({e[0]:.3g}, {e[1]:.3g})"] if len(e) else []
    if len(z):
        parts.append(f"z = {z[0]:g}" if len(z) == 1 else f"z = ({', '.join(f'{v:g}' for v in z)})")
    return f" at {', '.join(parts)}" if parts else ""


def slow_names(m: int, rows: str) -> str:
    """Say which slow variables there are: "W has 1 row: use z"."""
    if m == 0:
        return f"{rows} has no rows: use no slow variable"
    return f"{rows} has 1 row: use z" if m == 1 else f"{rows} has {m} rows: use z1 to z{m}"


def slow_axis(what: str, name: object, m: int) -> int:
    """Return which of m slow variables is named, from 0: z1 to zm (z is z1)."""
    names = [f"z{i + 1}" for i in range(m)]
    if name == "z" and m:
        return 0
    if name not in names:
        raise ValueError(f"{what} is {reprlib.repr(name)}; this system has {', '.join(names) or 'no slow variable'}.")
    return names.index(str(name))


def slow_values(z: ArrayLike, m: int, needed: bool = True) -> tuple[float, ...]:
    """Check z: m finite numbers (a lone number will do for m = 1; none if no coefficient reads z)."""
    values: tuple[float, ...]
    if isinstance(z, tuple) and all(type(v) is float for v in z):  # as they mostly come: no array is made
        values = cast("tuple[float, ...]", z)
    else:
        try:
            values = tuple(float(v) for v in np.atleast_1d(np.asarray(z, float)))
        except (TypeError, ValueError, OverflowError) as error:
            raise ValueError(f"z is {reprlib.repr(z)}; give {m} finite number(s).") from error
    if any(not math.isfinite(v) for v in values):
        raise ValueError(f"z is {values}; give finite numbers.")
    if len(values) == m or (not values and not needed):
        return values
    if m == 0:
        raise ValueError(f"z has {len(values)} value(s), but this system has no slow variable (m = 0); leave z out.")
    raise ValueError(f"z has {len(values)} value(s), but this system has m = {m}; give z=({', '.join(['...'] * m)}).")
