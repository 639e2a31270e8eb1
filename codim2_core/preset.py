"""One figure of the paper as values of the e-linear system."""

from __future__ import annotations

from dataclasses import dataclass, field

from . import regularisation
from .regularisation import Psi
from .systems import ELinear


@dataclass(frozen=True)
class Preset:
    """One figure of the paper as values of the e-linear system.

    Attributes
    ----------
    name : str
        The key in `presets`.
    group, title : str
        Where it is listed, and the line that is listed.
    label : str
        The paper's label(s).
    note : str
        What is to be seen, in the paper's words.
    a, b, d, f1, f2 : float
    hill : int or None
        n of the hill family eq:bad_reg, or None for Psi = 1.
    portrait : (case, name, kind or None)
        What must be true.
    degeneracy : str or None
        The degeneracy that the figure sits on, if any.
    """

    name: str = ""
    group: str = ""
    title: str = ""
    label: str = ""
    note: str = ""
    a: float = -1.0
    b: float = 0.0
    d: float = -1.0
    f1: float = 0.0
    f2: float = 0.0
    hill: int | None = None
    portrait: tuple[str, str, str | None] = field(default=("I", "CM0", None))
    degeneracy: str | None = None

    @property
    def system(self) -> ELinear:
        """The e-linear system, without slow variables."""
        return ELinear(self.a, self.b, self.d, (self.f1, self.f2))

    @property
    def psi(self) -> Psi:
        """The regularisation function."""
        return regularisation.constant() if self.hill is None else regularisation.hill(self.hill)
