"""The result of a variation: derivatives of a motion by its initial state and by numbers of its system."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...results.arrays import Array
from ...results.result import Result
from ...results.tables import html_table, paragraphs, table_number


@dataclass(frozen=True, eq=False)
class Variation(Result):
    """Derivatives of a motion, the variational equation solved along it; arrays are read-only.

    In the limit eps -> 0 they go through arrival, sliding, crossing and exit at the equator by saltation matrices.
    Columns belong to the state at the start, then to `names`.

    Attributes
    ----------
    names : tuple of str
        Numbers of the system by which it is differentiated: q of them.
    times : ndarray (k,)
        Ends of the steps of the motion as far as its derivatives are known; all of them, unless `reason` says why not.
    propagators : ndarray (k - 1, n + q, n + q)
        Change of (state, names) at the end of each step by that at its beginning, with what happens at its end.
    error : ndarray (n, n + q)
        Estimate of the error of `last`: its change as the equation is solved in parts half as long. That of the motion
        itself is not in it.
    rate : ndarray (n,)
        Of the state at the last time.
    reason : str
        Why it is not known further; empty where all of it is known.
    within : ndarray (n, k) or None
        Basis of the changes that are not left out where it stays in an invariant line that repels; None elsewhere.
    """

    names: tuple[str, ...]
    times: Array = field(repr=False)
    propagators: Array = field(repr=False)
    error: Array = field(repr=False)
    rate: Array = field(repr=False)
    reason: str
    within: Array | None = field(default=None, repr=False)

    def _tables_(self) -> str:
        states = ["x", "y", *(f"z{i}" for i in range(1, len(self.rate) - 1))]
        head = (f"at t = {table_number(float(self.times[-1]))}", *(f"∂/∂{name}" for name in (*states, *self.names)))
        body = [(name, *map(table_number, row)) for name, row in zip(states, self.last.tolist(), strict=True)]
        return html_table(head, body) + paragraphs([self.reason] if self.reason else [])

    @cached_property
    def matrices(self) -> Array:
        """Derivatives of the state (k, n, n + q) at `times`: by the state at the start, and by `names`."""
        n, size = len(self.rate), self.propagators.shape[1]
        found = np.empty((len(self.times), n, size))
        product = np.eye(size)
        found[0] = product[:n]
        for k, step in enumerate(self.propagators, 1):
            product = step @ product
            found[k] = product[:n]
        found.flags.writeable = False
        return found

    @property
    def last(self) -> Array:
        """Derivatives of the last state, (n, n + q)."""
        return self.matrices[-1]

    def by(self, name: str) -> Array:
        """Return the derivative (k, n) of the state at `times` by one of `names`.

        Raises
        ------
        ValueError
            The motion was not differentiated by it.
        """
        if name not in self.names:
            raise ValueError(f"{name!r} is none of {self.names}; ask for variation({name!r}).")
        return self.matrices[:, :, len(self.rate) + self.names.index(name)]

    def through(self, normal: ArrayLike) -> tuple[Array, Array]:
        """Return the derivatives of when, and of where, the motion passes a section at the last time.

        Parameters
        ----------
        normal : (n,)
            Gradient by the state of the function that is zero on the section, such as that of a terminal `Event`.

        Returns
        -------
        time : ndarray (n + q,)
        place : ndarray (n, n + q)
            Of a Poincare map, where the motion starts on a section and ends on it.

        Raises
        ------
        ValueError
            The normal has another length, or the motion touches the section.
        """
        across = np.asarray(normal, float)
        if across.shape != self.rate.shape:
            raise ValueError(
                f"normal has shape {across.shape}; give {len(self.rate)} numbers, one for each of x, y, z."
            )
        speed = float(across @ self.rate)
        if speed == 0.0:
            raise ValueError("the motion touches the section at its last time; give one that it passes.")
        time = -(across @ self.last) / speed
        return time, self.last + np.outer(self.rate, time)

    @cached_property
    def exponents(self) -> Array:
        """Growth rates (n,) of the motion, largest first: over a long one, estimates of its Lyapunov exponents.

        Logarithms of the factors by which small parallelepipeds grow, by the time; -inf for directions that a motion
        in the limit eps -> 0 loses as it arrives at Sigma.
        """
        n = len(self.rate)
        Q, logs = np.eye(n), np.zeros(n)
        for step in self.propagators:
            Q, R = np.linalg.qr(step[:n, :n] @ Q)
            size = np.abs(np.diag(R))
            size[step[:n].any(axis=1).sum() :] = 0.0  # lost, and not what rounding leaves of it
            logs += np.log(size, out=np.full(n, -np.inf), where=size > 0.0)
        found = np.sort(logs / (self.times[-1] - self.times[0]))[::-1].copy()
        found.flags.writeable = False
        return found
