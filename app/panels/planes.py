"""The panel "Planes": trace and determinant, and the eigenvalues, of the critical set (fig:bads).

The browser has the present point from the picture, and draws its trail; the server adds the curve over the parameter n
of Psi = 3/(3 + (4s)^n) or, for any other Psi, the points of the built-in families.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from codim2_core.diagrams.eigenvalue_path import linearisation_path
from codim2_core.layer_problem.critical import critical_sets
from codim2_core.psi import constructors
from codim2_core.psi.function import Psi
from codim2_core.systems.coefficients import Coefficients
from codim2_core.systems.frozen import AtZ

from ..frame.draft import Draft

#: Values of n along the curve, and those that are marked on it (fig:bads).
N = np.unique(np.concatenate([np.geomspace(0.5, 6.0, 120), [1.0, 2.0, 3.0, 4.0]]))
MARKED = (1.0, 2.0, 3.0, 4.0)
#: Families beside any Psi that is not of the Hill family, and the words at their points.
FAMILIES: tuple[tuple[str, Psi], ...] = (
    ("Ψ = 1", constructors.constant()),
    ("1/(1+s)", constructors.rational()),
    ("e⁻ˢ", constructors.exponential()),
    ("s/sinh²√s", constructors.tanh()),
    ("3/(3+16s²)", constructors.hill(2.0)),
)


def add(draft: Draft) -> None:
    """Add the curve over n, or the points of the families; of a system that is not e-linear, once nothing moves."""
    at, psi = draft.scene.coefficients, draft.scene.psi
    key = (*draft.scene.key("plane"), "hill" if psi.family == "hill" else psi)
    make = over_n if psi.family == "hill" else over_families
    if isinstance(at, Coefficients):
        if draft.now.get("planes") != key:
            draft.now["planes"] = key
            draft.header["planes"] = make(at, psi)
        return
    found = draft.slow("planes", key, lambda: make(at, psi))
    if found is not None:
        draft.header["planes"] = found


def over_n(at: AtZ, psi: Psi) -> dict[str, Any]:
    """Return the curve over n, as columns "trace", "determinant", "text" and "kind"; those of `MARKED` have text."""
    path = linearisation_path(at, psi, "n", N)
    rows = [
        (
            path.trace[i],
            path.determinant[i],
            f"n = {path.values[i]:g}" if path.values[i] in MARKED else "",
            path.kind[i],
        )
        for i in np.flatnonzero(path.exists)
    ]
    return _columns(rows, line=True, sentence="Dashed: over n of Ψ = 3/(3 + (4s)ⁿ), from 0.5 to 6.")


def over_families(at: AtZ, psi: Psi) -> dict[str, Any]:
    """Return the points of the built-in families that differ from this Psi, as `over_n` does."""
    rows = [
        (C.trace, C.determinant, words, C.kind)
        for words, other in FAMILIES
        if other != psi
        for C in critical_sets(at, other)
    ]
    return _columns(rows, line=False, sentence="Small dots: the same system with other Ψ.")


def _columns(rows: Sequence[tuple[float, float, str, str]], *, line: bool, sentence: str) -> dict[str, Any]:
    return {
        "line": line,
        "sentence": sentence if rows else "",
        "trace": [float(f"{row[0]:.8g}") for row in rows],
        "determinant": [float(f"{row[1]:.8g}") for row in rows],
        "text": [row[2] for row in rows],
        "kind": [row[3] for row in rows],
    }
