"""The panel "Planes": trace and determinant, the eigenvalues of the critical set, and the Psi compared (Figure 17).

The browser has the present point from the picture, and draws its trail; the server adds the curve over the parameter
of Psi, if it has one, or the points of other families.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from codim2_core.bifurcations.diagrams.eigenvalue_path import linearisation_path
from codim2_core.portrait.layer_problem.critical import critical_sets
from codim2_core.systems.coefficients import Coefficients
from codim2_core.systems.frozen import FrozenSystem
from codim2_core.systems.psi import FAMILIES, make
from codim2_core.systems.psi.function import Psi

from ...picture.frame.frame_context import FrameContext
from ...picture.phrases import say
from ..panel import Panel

CURVE_POINTS = 120  # along the curve over the parameter
S = np.linspace(0.0, 1.0, 51)  # as in Figure 17(c)


def add(draft: FrameContext) -> None:
    """Add the curve over the parameter of Psi, or points of other families; of a typed system, once nothing moves."""
    at, psi = draft.scene.coefficients, draft.scene.psi
    varies = psi.record.parameter is not None
    key = (*draft.scene.key("plane"), psi.family if varies else psi)
    make = over_parameter if varies else over_families
    if isinstance(at, Coefficients):
        if draft.now.get("planes") != key:
            draft.now["planes"] = key
            draft.header["planes"] = make(at, psi)
        return
    found = draft.slow("planes", key, make, at, psi)
    if found is not None:
        draft.header["planes"] = found


def over_parameter(at: FrozenSystem, psi: Psi) -> dict[str, Any]:
    """Return the curve over Psi's parameter: columns "trace", "determinant", "text" (of those compared) and "kind"."""
    family, shape = psi.record, psi.record.parameter
    assert shape is not None
    low, high = shape.shown
    spaced = np.geomspace if low > 0.0 else np.linspace
    path = linearisation_path(at, psi, shape.name, np.unique([*spaced(low, high, CURVE_POINTS), *family.compared]))
    rows = [
        (
            path.trace[i],
            path.determinant[i],
            f"{shape.name} = {path.values[i]:g}" if path.values[i] in family.compared else "",
            path.kind[i],
        )
        for i in np.flatnonzero(path.exists)
    ]
    sentence = say("over the parameter of Ψ", name=shape.name, title=family.title, low=low, high=high)
    members = [(f"{shape.name} = {value:g}", make(family.name, value)) for value in family.compared]
    return _plane_columns(rows, members, line=True, sentence=sentence)


def over_families(at: FrozenSystem, psi: Psi) -> dict[str, Any]:
    """Return the points of a member of each other family, as `over_parameter` does."""
    members = [make(family.name) for family in FAMILIES.values() if family.compared]
    named = [(f"Ψ = {other.words}" if other.record.identity else other.words, other) for other in members]
    rows = [
        (C.trace, C.determinant, text, C.kind)
        for text, other in named
        if other != psi
        for C in critical_sets(at, other)
    ]
    return _plane_columns(rows, named, line=False, sentence=say("other Ψ"))


def _plane_columns(
    rows: Sequence[tuple[float, float, str, str]], members: Sequence[tuple[str, Psi]], *, line: bool, sentence: str
) -> dict[str, Any]:
    return {
        "s": [float(f"{value:.4g}") for value in S],
        "psis": [[text, [float(f"{value:.5g}") for value in member(S)]] for text, member in members],
        "line": line,
        "sentence": sentence if rows else "",
        "trace": [float(f"{row[0]:.8g}") for row in rows],
        "determinant": [float(f"{row[1]:.8g}") for row in rows],
        "text": [row[2] for row in rows],
        "kind": [row[3] for row in rows],
    }


PANEL = Panel("planes", "Planes", add, "Trace and determinant, and eigenvalues, of each critical set; the Ψ compared.")
