"""Values of the parameter of Psi, such as n of the Hill family, at which the critical set changes kind (Figure 17)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..layer_problem.linearisation import determinant_sign
from ..layer_problem.location import locate
from ..numerics.sign_changes import roots
from ..psi.constructors import hill, many, with_parameter
from ..psi.function import Psi
from ..results import Results, Tabled
from ..systems.coefficients import Coefficients
from ..systems.elinear import ELinear
from ..tables import table_number
from ..words import say

SEGMENT_STEPS = 241


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


def parameter_changes(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> Results[ParameterChange]:
    """Every value of the parameter of Psi at which the critical set changes its kind, in increasing order.

    e does not depend on Psi, and J only through ``sigma = (1 - |e|^2)(1 - s Psi'(s)/Psi(s))``. With
    ``alpha = e.diag(a, d) e/|e|^2`` and ``beta = a + d - alpha``: tr J = 0 at sigma = -beta/alpha, and the discriminant
    is zero at ``(alpha sigma + beta)^2 = 4 sigma det A``: the values of sigma are closed forms and n(sigma) a root,
    looked for between `SEGMENT_STEPS` values of n.

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
        For all values allowed, to about 1e-14 relative. Empty without a critical set, or if it is a saddle.

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
    coefficients = system.at(z)
    a, b, d = coefficients.a, coefficients.b, coefficients.d
    location = locate(coefficients)
    if location.e is None or determinant_sign(a, b, d) <= 0:
        return Results()
    c, s = location.e
    square = c * c + s * s
    if square == 0.0:
        return Results()
    modulus = math.sqrt(square)
    # beta is formed from squares too: a + d - alpha would cancel
    alpha, beta = (a * c * c + d * s * s) / square, (a * s * s + d * c * c) / square

    def sigma(n: NDArray[np.float64]) -> NDArray[np.float64]:
        members = many(psi, n)
        radius = members.radius(np.full(len(n), modulus), np.full(len(n), location.complement))
        return location.complement * (1.0 + members.steepness(radius))

    wanted: list[tuple[str, float]] = []
    if alpha * beta < 0.0:
        wanted.append(("Hopf", -beta / alpha))
    root = math.sqrt(a * d + b * b)
    for tau in (-1.0, 1.0):
        inner = root * root - alpha * beta
        if inner >= 0.0 and alpha != 0.0:
            # alpha w^2 - 2 tau root w + beta = 0 for w = sqrt(sigma) > 0, without cancellation
            large = tau * root + math.copysign(math.sqrt(inner), tau)
            wanted += [("node-focus", w * w) for w in (large / alpha, beta / large if large else 0.0) if w > 0.0]
        elif alpha == 0.0 and tau * beta > 0.0:
            wanted.append(("node-focus", (beta / (2.0 * root)) ** 2))
    spaced = np.geomspace if shape.low > 0.0 else np.linspace
    grid = np.concatenate([[shape.low], spaced(shape.low, shape.high, SEGMENT_STEPS)[1:-1], [shape.high]])
    values = sigma(grid)
    found: list[tuple[float, str]] = []
    for kind, target in wanted:
        zeros = roots(lambda n, t=target: sigma(n) / t - 1.0, [grid], [values / target - 1.0]).zeros[0]
        found += [(n, kind) for n in zeros.tolist()]
    found.sort()
    changes = []
    for i, (n, kind) in enumerate(found):
        low = 0.5 * (n + (found[i - 1][0] if i else shape.low))
        high = 0.5 * (n + (found[i + 1][0] if i + 1 < len(found) else shape.high))
        before, after = (_change_kind(alpha, beta, root, v) for v in sigma(np.array([low, high])).tolist())
        changes.append(
            ParameterChange(
                kind, n, before, after, say("changes over Ψ", name=shape.name, value=n, before=before, after=after)
            )
        )
    return Results(changes)


def _change_kind(alpha: float, beta: float, root: float, sigma: float) -> str:
    trace, determinant = alpha * sigma + beta, sigma * root * root
    shape = "node" if trace * trace >= 4.0 * determinant else "focus"
    return ("stable " if trace < 0.0 else "unstable ") + shape
