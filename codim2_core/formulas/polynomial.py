"""Formulas that are polynomials in c and s, as their coefficients: exact sums and products of the numbers in them."""

from __future__ import annotations

from fractions import Fraction

from .arrays import Program
from .opcodes import ADD, DIV, MUL, NEG, NUM, POWI, SUB, VAR

MAX_DEGREE = 16
Terms = dict[tuple[int, int], Fraction]  # the coefficient of c^i s^j by (i, j)


def polynomials(run: Program) -> tuple[Terms, ...] | None:
    """Return the rows of a tape as polynomials on Sigma; None if one is none, or of a degree beyond `MAX_DEGREE`."""
    entries: list[Terms | None] = []
    for op, left, right, number in zip(*(column.tolist() for column in run.arrays[:4]), strict=True):
        found = _terms(op, left, number, entries, right)
        entries.append(None if found is None or max(map(sum, found), default=0) > MAX_DEGREE else found)
    rows = [entries[i] for i in run.roots.tolist()]
    return None if None in rows else tuple(row for row in rows if row is not None)


def _terms(op: int, left: int, number: float, entries: list[Terms | None], right: int) -> Terms | None:
    if op == NUM:
        return {(0, 0): Fraction(number)} if number - number == 0.0 else None
    if op == VAR:
        return {(1, 0): Fraction(1)} if left == 0 else {(0, 1): Fraction(1)} if left == 1 else {}
    first = entries[left]
    if first is None:
        return None
    if op == NEG:
        return {place: -v for place, v in first.items()}
    if op == POWI:
        return _raise_terms(first, number)
    second = entries[right]
    if second is None:
        return None
    if op in (ADD, SUB):
        sign = 1 if op == ADD else -1
        return {at: first.get(at, Fraction()) + sign * second.get(at, Fraction()) for at in {**first, **second}}
    if op == MUL:
        return _multiply_terms(first, second)
    constant = second.get((0, 0), Fraction())
    if op == DIV and constant and all(place == (0, 0) or not v for place, v in second.items()):
        return {place: v / constant for place, v in first.items()}
    return None


def _multiply_terms(first: Terms, second: Terms) -> Terms:
    found: Terms = {}
    for (i, j), v in first.items():
        for (k, m), w in second.items():
            found[i + k, j + m] = found.get((i + k, j + m), Fraction()) + v * w
    return found


def _raise_terms(base: Terms, exponent: float) -> Terms | None:
    if not 0.0 <= exponent <= MAX_DEGREE:
        return None
    found: Terms = {(0, 0): Fraction(1)}
    for _ in range(int(exponent)):
        found = _multiply_terms(found, base)
    return found
