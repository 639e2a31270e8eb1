"""A random search for contradictions between skeletons, the index and the theorems: 10 000 systems a case."""

from __future__ import annotations

import sys
import time

import numpy as np

from ..core.skeletons import contradictions, random_psi, random_system

SYSTEMS = 10_000


def report(systems: int = SYSTEMS) -> str:
    """Return a table of how many systems were looked at, and what was found."""
    rows = []
    for case in ("I", "II", "III"):
        rng = np.random.default_rng(7)
        start, found = time.perf_counter(), []
        for _ in range(systems):
            at, psi = random_system(rng, case), random_psi(rng)
            wrong = contradictions(at, psi)
            if wrong:
                found.append((at.plane, psi.text, wrong))
        seconds = time.perf_counter() - start
        for plane, text, wrong in found[:10]:
            print(case, plane, text, wrong, file=sys.stderr)
        rows.append(f"| {case} | {systems} | {len(found)} | {1e3 * seconds / systems:.1f} |")
    return "\n".join(
        ["| random skeletons: case | systems | contradictions | ms a system |", "|---|---|---|---|", *rows]
    )


if __name__ == "__main__":
    print(report(int(sys.argv[1]) if len(sys.argv) > 1 else SYSTEMS))
