"""One figure of the paper: a system, where on Sigma, Psi, and the view that shows it."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...results import drawing
from ...results.paper import cite
from ...results.tables import paragraphs
from ..elinear import ELinear
from ..examples import catalogue
from ..psi.constructors import make
from ..psi.function import Psi
from ..typed import System


@dataclass(frozen=True)
class Preset:
    """One figure of the paper: values of the e-linear system, or one of the examples.

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
        The e-linear system, unless there is an `example`.
    B, g : (m, 2) and (m,)
        Its slow flow; without them it has no slow variables.
    example : str
        A key of `examples.catalogue`, or "".
    z : tuple of float
    family : str
        Of Psi.
    parameter : float or None
        That of the family; None for its default.
    launch : tuple of float
        Where a motion starts that shows its point, (x, y, z1, ...); () leaves it to the example or to who shows it.
    t_end : float
        How long that motion is followed.
    view : str
        What shows it: "" the picture, "connections", "conics", "outcomes", "sphere", "stack", "filippov", "psi",
        "planes", "along" or "time".
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
    B: tuple[tuple[float, float], ...] = ()
    g: tuple[float, ...] = ()
    example: str = ""
    z: tuple[float, ...] = ()
    family: str = "constant"
    parameter: float | None = None
    launch: tuple[float, ...] = ()
    t_end: float = 0.0
    view: str = ""
    portrait: tuple[str | None, str, str | None] = field(default=("I", "CM0", None))
    degeneracy: str | None = None

    def _repr_svg_(self) -> str | None:
        return drawing.svg(self)

    def _repr_html_(self) -> str:
        said = paragraphs([f"{self.title} ({cite(self.label)})" if self.label else self.title, self.note])
        return drawing.image(self) + said

    @property
    def system(self) -> ELinear | System:
        """The system."""
        if self.example:
            return catalogue[self.example].make()
        return ELinear(self.a, self.b, self.d, (self.f1, self.f2), B=self.B or None, g=self.g or None)

    @property
    def psi(self) -> Psi:
        """The regularisation function."""
        return make(self.family, self.parameter)
