"""A proved portrait, and the certificate that shows it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from ....results.arrays import Array
from ....results.result import Result
from ....systems.psi.function import Psi

__all__ = ["Proof", "covers"]

COVERED = ("constant", "rational", "exponential", "tanh", "hill")  # the families whose Psi the checker encloses


def covers(psi: Psi) -> bool:
    """Whether there may be certificates with this Psi: the checker knows its family, and it is smooth."""
    return psi.family in COVERED and (psi.family != "hill" or psi.parameter >= 1.0)


class FoundCycle(Protocol):
    """A limit cycle, as far as a proof needs to know it (`LimitCycle`)."""

    @property
    def points(self) -> Array: ...
    @property
    def stable(self) -> bool: ...
    @property
    def kind(self) -> str: ...


@dataclass(frozen=True, eq=False)
class Proof(Result):
    """Whether the count of limit cycles is proved, and what else is; true in a condition exactly then.

    Attributes
    ----------
    whole : bool
        There are just the cycles that were found, and no other.
    cycles : tuple of bool
        For each cycle, from the inside: it is proved, and hyperbolic. All of them are, or none.
    reason : str
        By what theorem, or certificate, or what is not decided and where.
    certificate : str or None
        JSON, to be checked by ``python check.py < FILE`` with `checker`; None where a theorem alone decides it.
    limit_directions : tuple of (int, int), or None
        The signs of lambda_rho and lambda_theta at each, in order along the equator; None where they are not shown, as
        where one of these numbers is 0.
    critical_sets : tuple of str, or None
        The kind of each: "saddle", "stable node", "unstable focus", ...; None as before.
    """

    whole: bool
    cycles: tuple[bool, ...]
    reason: str
    certificate: str | None = field(default=None, repr=False)
    limit_directions: tuple[tuple[int, int], ...] | None = None
    critical_sets: tuple[str, ...] | None = None

    def __bool__(self) -> bool:
        return self.whole

    @property
    def portrait(self) -> bool:
        """Whether the limit directions, the critical sets and the limit cycles stand proved, all of them."""
        return self.whole and self.limit_directions is not None and self.critical_sets is not None

    @staticmethod
    def checker() -> str:
        """Return the path of the program that checks a certificate: Python and NumPy are all that it needs."""
        return str(Path(__file__).with_name("check.py"))

    def save(self, path: str | Path) -> None:
        """Write the certificate to a file.

        Raises
        ------
        ValueError
            There is none.
        """
        if self.certificate is None:
            raise ValueError(f"there is no certificate to save: {self.reason}")
        Path(path).write_text(self.certificate, encoding="utf-8")
