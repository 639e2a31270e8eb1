"""A proved count of limit cycles, and the certificate that shows it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from ...psi.function import Psi

__all__ = ["Proof", "covers"]

COVERED = ("constant", "rational", "exponential", "tanh", "hill")  # the families whose Psi the checker encloses


def covers(psi: Psi) -> bool:
    """Whether there may be certificates with this Psi: the checker knows its family, and it is smooth."""
    return psi.family in COVERED and (psi.family != "hill" or psi.parameter >= 1.0)


@dataclass(frozen=True)
class Proof:
    """Whether the count of limit cycles stands proved; true in a condition exactly then.

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
    """

    whole: bool
    cycles: tuple[bool, ...]
    reason: str
    certificate: str | None = field(default=None, repr=False)

    def __bool__(self) -> bool:
        return self.whole

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
