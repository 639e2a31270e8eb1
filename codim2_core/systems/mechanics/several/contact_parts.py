"""Parts of a mechanism with several contacts, read and checked; the mechanism as each contact sees it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from ....formulas.expression import Expression
from ....formulas.names import FAST_NAMES
from ...reading import short_repr
from .. import formula_reading
from ..algebra import Algebra
from ..formula_reading import FormulaRow, Matrix
from ..mechanism import Mechanism

MAX_CONTACTS = 8


@dataclass(frozen=True)
class ContactParts:
    """One contact: rows J of its slip, Coulomb's coefficient, normal force, velocity of the other body; as formulas."""

    J: Matrix
    mu: Expression
    normal: Expression
    surface: FormulaRow


def read_contacts(given: Any, n: int, names: Sequence[str]) -> tuple[ContactParts, ...]:
    """Read contacts ``(J, mu, normal)`` or ``(J, mu, normal, surface)``, in positions and parameters."""
    if isinstance(given, str) or not hasattr(given, "__getitem__") or not 1 <= len(given) <= MAX_CONTACTS:
        raise ValueError(
            f"contacts is {short_repr(given)}; give from 1 to {MAX_CONTACTS} of them, each (J, mu, normal) or "
            "(J, mu, normal, surface)."
        )
    found: list[ContactParts] = []
    for i, one in enumerate(given, 1):
        what = f"contacts[{i}]"
        if isinstance(one, str) or not hasattr(one, "__getitem__") or len(one) not in (3, 4):
            raise ValueError(f"{what} is {short_repr(one)}; give (J, mu, normal) or (J, mu, normal, surface).")
        J, mu, normal, surface = (*one, (0.0, 0.0))[:4]
        for part, value in (("mu", mu), ("normal", normal)):
            if not isinstance(value, str) and hasattr(value, "__len__"):
                raise ValueError(
                    f"{what}: {part} is {short_repr(value)}; give a number or text: with a matrix, "
                    "or the row of a constraint, which contacts stick is not known to be unique."
                )
        found.append(
            ContactParts(
                formula_reading.matrix(J, f"{what}: J", 2, n, names),
                formula_reading.formula(mu, f"{what}: mu", names),
                formula_reading.formula(normal, f"{what}: normal", names),
                formula_reading.row(surface, f"{what}: surface", 2, names),
            )
        )
    return tuple(found)


def mechanisms(
    M: Matrix, contacts: Sequence[ContactParts], force: FormulaRow, velocities: Sequence[str], rates: Any, known: Any
) -> tuple[Mechanism, ...]:
    """Return for each contact the mechanism in which it may be at its set while the others slip.

    The friction of the others, ``-mu N J^T e`` with ``e = (J v - w)/|J v - w|``, is part of the applied force.
    """
    found: list[Mechanism] = []
    for i, own in enumerate(contacts):
        algebra = Algebra()
        applied = [algebra.enter(row, {}) for row in force]
        for other in (*contacts[:i], *contacts[i + 1 :]):
            applied = _with_friction(algebra, applied, other, velocities)
        slow = (*_slow_velocities(own.J, velocities), *rates)
        rows = [algebra.formula(entry) for entry in applied]
        found.append(Mechanism(M, own.J, rows, own.mu, own.normal, velocities, slow, rates, own.surface, known))
    return tuple(found)


def _with_friction(algebra: Algebra, applied: list[int], other: ContactParts, velocities: Sequence[str]) -> list[int]:
    """Add the friction of a contact that slips to a force."""
    rows = [[algebra.enter(entry, {}) for entry in row] for row in other.J]
    v = [algebra.name(word) for word in velocities]
    slip = [
        algebra.minus(algebra.dot(row, v), algebra.enter(w, {})) for row, w in zip(rows, other.surface, strict=True)
    ]
    size = algebra.square_root(algebra.dot(slip, slip))
    most = algebra.times(algebra.enter(other.mu, {}), algebra.enter(other.normal, {}))
    pull = [algebra.times(most, algebra.divide(part, size)) for part in slip]
    return [algebra.minus(one, algebra.dot([row[j] for row in rows], pull)) for j, one in enumerate(applied)]


def _slow_velocities(J: Matrix, velocities: Sequence[str]) -> tuple[str, ...]:
    """Return all velocities but two that the slip determines: where it can be, by a determinant that is a number."""
    algebra = Algebra()
    rows = [[algebra.enter(entry, {}) for entry in row] for row in J]
    pairs = {
        pair: algebra.formula(algebra.determinant(tuple(tuple(row[j] for j in pair) for row in rows)))
        for pair in combinations(range(len(velocities)), 2)
    }
    able = [pair for pair, size in pairs.items() if size.constant != 0.0]
    if not able:
        raise ValueError("contacts: the rows of a J are dependent; give two directions in which its point can slip.")
    gone = min(able, key=lambda pair: pairs[pair].constant is None)
    return tuple(word for j, word in enumerate(velocities) if j not in gone)


def refuse_fast_names(force: FormulaRow) -> None:
    """Refuse a force that reads the slip or e of a contact."""
    used = next((word for row in force for word in row.names if word in FAST_NAMES), None)
    if used is not None:
        raise ValueError(f"force reads {used}, which of the contacts has each of its own; write it in the velocities.")
