"""Sums, products and solutions of linear equations whose entries are formulas; what is a number stays one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partialmethod

from ...formulas.expression import Expression
from ...formulas.tape import Builder, compact

MatrixRow = tuple[int, ...]
Matrix = tuple[MatrixRow, ...]


class Algebra(Builder):
    """Formulas as entries of one tape: equal ones are one entry, so they may be many times in one another."""

    def __init__(self) -> None:
        super().__init__(simplify=True)
        self.zero = self.number(0.0)

    # Of entries u and v: u + v, u - v, u v and u/v; of u: its square root, and -u.
    plus = partialmethod(Builder.apply, "+")
    minus = partialmethod(Builder.apply, "-")
    times = partialmethod(Builder.apply, "*")
    divide = partialmethod(Builder.apply, "/")
    square_root = partialmethod(Builder.apply, "sqrt")
    negative = partialmethod(Builder.apply, "neg")

    def enter(self, row: Expression, meanings: Mapping[str, int]) -> int:
        """Return the entry of a formula, other entries put in for names."""
        return self.enter_tape(row.tape, meanings)

    def formula(self, entry: int) -> Expression:
        """Return the formula of an entry."""
        return Expression(compact(self.nodes, entry))

    def dot(self, u: Sequence[int], v: Sequence[int]) -> int:
        """Return the sum of products of two rows of one length."""
        total = self.zero
        for one, other in zip(u, v, strict=True):
            total = self.plus(total, self.times(one, other))
        return total

    def solved_positive(self, M: Matrix, columns: Sequence[MatrixRow]) -> tuple[MatrixRow, ...]:
        """Solve M x = b for several columns b, M symmetric and positive definite: so no pivot is ever 0."""
        n = len(M)
        A, B = [list(row) for row in M], [list(column) for column in columns]
        for k in range(n):
            pivot = self.value(A[k][k])
            if pivot is not None and not pivot > 0.0:
                raise ValueError("M is not positive definite; give the mass matrix of the kinetic energy, v·Mv/2.")
            for i in range(k + 1, n):
                if A[i][k] == self.zero:
                    continue
                factor = self.divide(A[i][k], A[k][k])
                for j in range(k + 1, n):
                    A[i][j] = self.minus(A[i][j], self.times(factor, A[k][j]))
                for b in B:
                    b[i] = self.minus(b[i], self.times(factor, b[k]))
        for b in B:
            for k in reversed(range(n)):
                b[k] = self.divide(self.minus(b[k], self.dot(A[k][k + 1 :], b[k + 1 :])), A[k][k])
        return tuple(map(tuple, B))

    def determinant(self, A: Matrix) -> int:
        """Return the determinant, by its first row: for the two or three rows that there are."""
        if not A:
            return self.number(1.0)
        total = self.zero
        for j, entry in enumerate(A[0]):
            minor = self.determinant(tuple((*row[:j], *row[j + 1 :]) for row in A[1:]))
            total = (self.minus if j % 2 else self.plus)(total, self.times(entry, minor))
        return total

    def solve(self, A: Matrix, b: MatrixRow) -> MatrixRow | None:
        """Solve A x = b of two or three rows by Cramer's rule; None if the determinant is 0 whatever the names are."""
        size = self.determinant(A)
        if size == self.zero:
            return None
        changed = (tuple((*row[:j], b[i], *row[j + 1 :]) for i, row in enumerate(A)) for j in range(len(A)))
        return tuple(self.divide(self.determinant(one), size) for one in changed)
