"""Partners for as many others, without loading SciPy's optimisers."""

from __future__ import annotations

import math

from ..results.arrays import Array


def assign(cost: Array) -> list[int]:
    """Assign each row of a cost (n, m) its column at the least sum, by augmenting paths (Jonker and Volgenant 1987)."""
    n, m = cost.shape
    costs, of_row, of_column = cost.tolist(), [0.0] * (n + 1), [0.0] * (m + 1)
    row_of = [n] * (m + 1)  # of a column; column m stands for the row that seeks one
    for row in range(n):
        row_of[m], column = row, m
        least, before, seen = [math.inf] * m, [m] * m, [False] * (m + 1)
        while row_of[column] != n:
            seen[column] = True
            here = row_of[column]
            for j in range(m):
                if not seen[j] and (reduced := costs[here][j] - of_row[here] - of_column[j]) < least[j]:
                    least[j], before[j] = reduced, column
            nearest = min((j for j in range(m) if not seen[j]), key=least.__getitem__)
            step = least[nearest]
            for j in range(m + 1):
                if seen[j]:
                    of_row[row_of[j]] += step
                    of_column[j] -= step
                elif j < m:
                    least[j] -= step
            column = nearest
        while column != m:
            row_of[column], column = row_of[before[column]], before[column]
    return [row_of.index(row) for row in range(n)]
