"""The path of the critical set's linearisation as one parameter varies: the trails of Figure 17."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...portrait.layer_problem.critical import critical_sets
from ...portrait.layer_problem.vary import vary
from ...results.arrays import Array
from ...results.result import Pictured
from ...results.tables import html_table, table_number
from ...systems.psi.function import Psi


@dataclass(frozen=True, eq=False)
class LinearisationPath(Pictured):
    """The critical set's linearisation (3.23) along one parameter."""

    name: str
    values: Array = field(repr=False)
    exists: NDArray[np.bool_] = field(repr=False)
    trace: Array = field(repr=False)
    determinant: Array = field(repr=False)
    discriminant: Array = field(repr=False)
    eigenvalues: NDArray[np.complex128] = field(repr=False)
    kind: tuple[str, ...] = field(repr=False)

    @property
    def pieces(self) -> tuple[tuple[int, int], ...]:
        """First and last place of each run of values with one kind of critical set."""
        starts = [i for i, kind in enumerate(self.kind) if not i or kind != self.kind[i - 1]]
        return tuple(zip(starts, [*(i - 1 for i in starts[1:]), len(self.kind) - 1], strict=True)) if starts else ()

    def _tables_(self) -> str:
        found = [
            (*(table_number(self.values[k]) for k in (i, j)), self.kind[i] or "none", table_number(self.trace[i]))
            for i, j in self.pieces
        ]
        head = (f"from {self.name}", "to", "critical set", "tr J at first")
        return html_table(head, found)


def linearisation_path(system: Any, psi: Psi, name: str, values: ArrayLike, z: ArrayLike = ()) -> LinearisationPath:
    """Trace, determinant and eigenvalues of the critical set along one parameter (Figure 17).

    Where a general system has several critical sets, the one nearest (in p) to the last; first the innermost. Raises
    ValueError: The name cannot be varied, a value is not finite or beyond what it may be, or z does not fit. Shapes:
    values (k,), z (m,).
    """
    given = np.atleast_1d(np.array(values, float))
    if given.ndim != 1 or not np.isfinite(given).all():
        raise ValueError(f"values of {name} have shape {given.shape}; give a list of finite numbers.")
    exists, kind = np.zeros(len(given), bool), [""] * len(given)
    trace, determinant, discriminant = np.zeros((3, len(given)))
    last = np.zeros(2)
    for i, value in enumerate(given.tolist()):
        found = critical_sets(*vary(system, psi, z, name, value))
        if found:
            C = min(found, key=lambda C, last=last: float(np.hypot(*(C.p - last))))
            exists[i], kind[i], last = True, C.kind, C.p
            trace[i], determinant[i], discriminant[i] = C.trace, C.determinant, C.discriminant
    arrays = given, exists, trace, determinant, discriminant, _eigenvalues(trace, determinant, discriminant)
    for array in arrays:
        array.flags.writeable = False
    return LinearisationPath(name, *arrays, tuple(kind))


def _eigenvalues(trace: Array, determinant: Array, discriminant: Array) -> NDArray[np.complex128]:
    half, root = 0.5 * trace, 0.5 * np.sqrt(abs(discriminant))
    real = discriminant >= 0.0
    large = half + np.where(half < 0.0, -root, root)
    small = determinant / np.where(large != 0.0, large, 1.0)  # without the cancellation in half - root
    first = np.where(real, np.maximum(large, small), half) + 1j * np.where(real, 0.0, root)
    second = np.where(real, np.minimum(large, small), half) - 1j * np.where(real, 0.0, root)
    return np.stack([first, second], axis=-1)
