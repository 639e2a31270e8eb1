"""The panel "Theorems": the paper's claims, evaluated, with the numbers that show them."""

from __future__ import annotations

from collections.abc import Sequence

from codim2_core.portrait.theorems.certificates import Certificate
from codim2_core.results.paper import cite

from ..picture.frame.frame_context import FrameContext
from .panel import Panel

CertificateRow = tuple[str, str, str, str, list[tuple[str, float]]]


def add(draft: FrameContext) -> None:
    """Add the certificates in the order of the paper, once the integrator is ready: Proposition 4.2 asks for cycles."""
    scene = draft.scene
    if not draft.ready or not draft.fresh("certificates", scene["certificates"]):
        return
    draft.header["theorems"] = certificate_rows(scene["certificates"])


def certificate_rows(certificates: Sequence[Certificate]) -> list[CertificateRow]:
    """Return theorem, statement, verdict, sentence and numbers (name, value) of each."""
    return [
        (cite(c.theorem), c.statement, c.verdict.value, c.sentence, [(name, float(value)) for name, value in c.numbers])
        for c in certificates
    ]


#: The paper's figures of what a setting may be degenerate in, by the name of that.
FIGURES = {"transcritical": "fig:transcrit", "saddle-node": "fig:SNBIF"}

PANEL = Panel(
    "theorems", "Theorems", add, "The paper's claims, evaluated on this system.",
    {name: cite(label, titled=True) for name, label in FIGURES.items()},
)  # fmt: skip
