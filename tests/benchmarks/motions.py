"""The motions that are raced: a system, a start, a time, the same formulas as text; and where they end, to 1e-15.

`data/motions.json` holds the ends, computed once by Radau IIA of order 13 (seven stages) in 64-bit mantissas, which
shares nothing with what is raced, at two tolerances whose ends differ by the number that is stored with them.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from codim2_core import ELinear, System, examples
from codim2_core.systems.kinds import AnySystem

DATA = Path(__file__).parent / "data" / "motions.json"
EPS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
Array = np.ndarray


@dataclass(frozen=True)
class Motion:
    """One motion, Psi = 1."""

    system: AnySystem
    start: tuple[float, ...]  # (x, y, z1, ..., zm)
    t_end: float
    rows: tuple[str, ...]  # U and W as Python text in c, s, z[0], z[1], sin, cos

    def field(self, **names: object) -> Callable[..., Array]:
        """Return ``field(t, q, eps)`` on sqrt, sin, cos and pack that are given."""
        scope = dict(names)
        lines = [
            "def field(t, q, eps):",
            "    rho = sqrt(q[0]*q[0] + q[1]*q[1] + eps*eps)",
            "    c, s, z = q[0]/rho, q[1]/rho, q[2:]",
            f"    return pack([{', '.join(self.rows)}])",
        ]
        exec("\n".join(lines), scope)
        return scope["field"]  # type: ignore[return-value]


_PUSH, _SLOW = 3.5 * 0.2 * 9.81, 0.2 * 9.81
MOTIONS = {
    "ball": Motion(
        examples.ball_in_pool(K=2.0), (-1.0, 0.3, 10.0, 0.0), 3.0,
        (f"-{_PUSH!r}*c - 2*z[0]", f"-{_PUSH!r}*s - 2*z[1]", f"-{_SLOW!r}*c - 2*z[0]", f"-{_SLOW!r}*s - 2*z[1]"),
    ),
    "block": Motion(
        examples.tilting_block(), (0.3, 0.1, 0.1), 5.0,
        (
            f"-{0.3 * 9.81!r}*cos(z[0])*c + {9.81 * math.cos(0.5)!r}*sin(z[0])",
            f"-{0.6 * 9.81!r}*cos(z[0])*s + {9.81 * math.sin(0.5)!r}*sin(z[0])",
            "0*c + 0.02",
        ),
    ),
    "non-unique sliding": Motion(
        examples.nonunique_sliding(), (0.25, 0.3, 0.0), 2.0,
        ("-c*(c*c - 0.25*((1 + 2*z[0]*z[0])/(1 + z[0]*z[0]))**2)", "-0.5*s", "-2*c + 0.25"),
    ),
    "forced": Motion(
        System(U=("-c + 1.3*sin(z1)", "-s + 0.4*cos(2*z1)"), W=("1",)), (0.3, 0.2, 0.0), 10.0,
        ("-c + 1.3*sin(z[0])", "-s + 0.4*cos(2*z[0])", "0*c + 1.0"),
    ),
    "so(2,1)": Motion(ELinear(0.0, 1.0, 0.0, (0.3, 0.2)), (0.3, 0.2), 10.0, ("-s + 0.3", "c + 0.2")),
}  # fmt: skip


@lru_cache(maxsize=1)
def ends() -> dict[str, Array]:
    """Return the stored ends, by name and eps."""
    return {name: np.array(found["end"]) for name, found in json.loads(DATA.read_text()).items()}


def key(name: str, eps: float) -> str:
    """What an end is stored under."""
    return f"{name}, {eps:.0e}"
