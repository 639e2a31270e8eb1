"""The largest error of each number in a long run: ``python -m tests.precision [count] [seed]``.

In units of one rounding of the coefficients and of the number itself, with the system where it was met: what is larger
than the bounds in the tests belongs into their lists of worst cases.
"""

from __future__ import annotations

import sys

from . import test_critical, test_equator
from .samples import FAMILIES, STEEP, anywhere, with_critical_set


def main(count: int = 1000, seed: int = 0) -> None:
    """Print one line for each number."""
    worst: dict[str, tuple[float, str]] = {}

    def note(group: str, found: dict[str, float] | None, where: str) -> None:
        for name, error in (found or {}).items():
            key = f"{group}{name}"
            worst[key] = max(worst.get(key, (0.0, "")), (error, where))

    for group, families in (("", FAMILIES), ("steep Ψ: ", STEEP)):
        for plane, psi in with_critical_set(count, seed, families):
            note(group, test_critical.errors(plane, psi), f"{plane}, Ψ = {psi.text}")
    for plane in (*anywhere(count, seed), *(plane for plane, _ in with_critical_set(count, seed + 1))):
        for found in test_equator.errors(plane):
            note("", found, f"{plane}")
    for name, (error, where) in worst.items():
        print(f"{name:24s}{error:8.2f}  {where}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))
