"""The panel "Ψ": Psi itself, its smooth step L_Psi(l; eps) (Figure 5), and the friction of physics engines.

Of an engine's law it says whether the system sticks under it or chatters: Psi decides.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from codim2_core.portrait.cycles.friction_law_comparison import compare_laws
from codim2_core.systems.frozen import FrozenSystem
from codim2_core.systems.psi.engines import ENGINES, engine

from ..picture.frame.frame_context import FrameContext
from ..picture.slow_layers.short import short
from .panel import Panel

S = np.linspace(0.0, 4.0, 81)
#: Distances in the chart kappa_2 at which |e_Psi| is sent; L(l; eps) is read from them in the browser for every eps.
ZETA = np.concatenate([np.linspace(0.0, 3.0, 61), np.geomspace(3.2, 400.0, 24)])
#: The laws of engines by their formulas, each with an engine that has it, and the titles of all that have.
LAWS: dict[str, tuple[str, list[str]]] = {}
for one in ENGINES.values():
    LAWS.setdefault(one.formula, (one.name, []))[1].append(one.title)


def add(draft: FrameContext) -> None:
    """Add Psi(s) and |e_Psi|(zeta), which change with Psi only, and what each engine's law makes of the system."""
    scene, psi = draft.scene, draft.scene.psi
    verdicts = draft.slow("engines", scene.key("plane"), engine_rows, scene.coefficients)
    if verdicts is not None:
        draft.header["engines"] = verdicts
    if draft.now.get("psi_curves") != psi:
        draft.now["psi_curves"] = psi
        draft.header["psi_curves"] = {
            "s": short(S),
            "psi": short(psi(S)),
            "zeta": short(ZETA),
            "modulus": short(psi.modulus(ZETA)),
            "text": psi.words,
        }


def engine_rows(at: FrozenSystem) -> list[list[Any]]:
    """Return engines, Psi, verdict, tr J, and the slip at rest and in a chatter, both over eps, of each law."""
    found = compare_laws(at, {formula: (engine(name), 1.0) for formula, (name, _) in LAWS.items()})
    return [
        [", ".join(titles), one.law, one.verdict, one.trace, one.creep, one.chatter]
        for one, (_, titles) in zip(found, LAWS.values(), strict=True)
    ]


PANEL = Panel("psi", "Ψ", add, "The regularisation function, and the smooth step that it makes.")
