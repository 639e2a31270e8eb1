"""Values of the parameter of Psi, such as n of the Hill family, at which the critical set changes kind (Figure 17)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from ...portrait.layer_problem.critical import critical_sets
from ...results.result import Results, Tabled
from ...results.tables import table_number
from ...results.words import say
from ...systems.coefficients import Coefficients
from ...systems.elinear import ELinear
from ...systems.kinds import takes_names
from ...systems.psi.constructors import hill, with_parameter
from ...systems.psi.function import Psi
from ..diagrams.equilibrium_branches import equilibrium_branches

KINDS = ("Hopf", "node-focus")
SPAN_PIECES = 7  # of all values allowed, searched one after the other: evenly in the logarithm where all are positive


@dataclass(frozen=True, slots=True)
class ParameterChange(Tabled):
    """A value of the parameter of Psi where the critical set changes its kind.

    Attributes
    ----------
    type : "Hopf" or "node-focus"
    n : float
        The value.
    before, after : str
        The kinds of C just below and just above it.
    sentence : str
    """

    _head_ = ("change", "at", "before", "after", "what happens")

    type: str
    n: float
    before: str
    after: str
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        return self.type, table_number(self.n), self.before, self.after, self.sentence


@takes_names
def hill_changes(system: ELinear | Coefficients, z: ArrayLike = ()) -> Results[ParameterChange]:
    """`parameter_changes` of the Hill family (4.28). The paper's Case III changes at n = 284/129 (Hopf).

    Parameters
    ----------
    system, z
        As for `parameter_changes`.

    Returns
    -------
    Results of ParameterChange
        A tuple.

    Examples
    --------
    >>> from codim2_core import bifurcations, presets
    >>> [one.type for one in bifurcations.hill_changes(presets["case3-n2"].system)]
    ['node-focus', 'Hopf', 'node-focus']
    """
    return parameter_changes(system, hill(2.0), z)


@takes_names
def parameter_changes(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> Results[ParameterChange]:
    """Every value of the parameter of Psi at which the critical set changes its kind, in increasing order.

    They are the special values of the branch of the critical set along that parameter.

    Parameters
    ----------
    system : ELinear, or Coefficients
    psi : Psi
        Of a family with a parameter, whose value here does not matter.
    z : (m,) floats

    Returns
    -------
    Results of ParameterChange
        A tuple.
        For all values allowed. Empty without a critical set, or if it is a saddle.

    Raises
    ------
    ValueError
        z does not fit the system, or Psi has no parameter.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> changes = bifurcations.parameter_changes("case3-n2")
    >>> [round(one.n*129, 9) for one in changes if one.type == "Hopf"]
    [284.0]
    """
    shape = with_parameter(psi, psi.parameter).record.parameter
    assert shape is not None
    at = system.at(z)
    if not any(C.kind != "saddle" for C in critical_sets(at, with_parameter(psi, shape.low))):
        return Results()
    ends = np.linspace(shape.low, shape.high, SPAN_PIECES + 1)
    if shape.low > 0.0:
        ends = np.geomspace(shape.low, shape.high, SPAN_PIECES + 1)
    pieces = (equilibrium_branches(at, psi, shape.name, span, ()).special for span in pairwise(ends.tolist()))
    found = [(one.value, one.kind) for special in pieces for one in special if one.kind in KINDS]
    changes = []
    for i, (n, kind) in enumerate(found):
        low = 0.5 * (n + (found[i - 1][0] if i else shape.low))
        high = 0.5 * (n + (found[i + 1][0] if i + 1 < len(found) else shape.high))
        before, after = (critical_sets(at, with_parameter(psi, v))[0].kind for v in (low, high))
        changes.append(
            ParameterChange(
                kind, n, before, after, say("changes over Ψ", name=shape.name, value=n, before=before, after=after)
            )
        )
    return Results(changes)
