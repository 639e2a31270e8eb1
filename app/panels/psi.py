"""The panel "Ψ" (fig:component): Psi itself, and the smooth step L_Psi(l; eps) that it makes of the sign function."""

from __future__ import annotations

import numpy as np

from ..frame.frame_context import FrameContext
from ..slow_layers.short import short
from .panel import Panel

S = np.linspace(0.0, 4.0, 81)
#: Distances in the chart kappa_2 at which |e_Psi| is sent; L(l; eps) is read from them in the browser for every eps.
ZETA = np.concatenate([np.linspace(0.0, 3.0, 61), np.geomspace(3.2, 400.0, 24)])


def add(draft: FrameContext) -> None:
    """Add Psi(s) and |e_Psi|(zeta), which change with Psi only."""
    psi = draft.scene.psi
    if draft.now.get("psi_curves") != psi:
        draft.now["psi_curves"] = psi
        draft.header["psi_curves"] = {
            "s": short(S),
            "psi": short(psi(S)),
            "zeta": short(ZETA),
            "modulus": short(psi.modulus(ZETA)),
            "text": psi.words,
        }


PANEL = Panel("psi", "Ψ", add, "The regularisation function, and the smooth step that it makes.")
