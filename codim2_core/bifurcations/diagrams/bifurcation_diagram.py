"""One-parameter bifurcation diagrams: limit directions, critical sets and limit cycles along one parameter."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ...portrait.layer_problem.vary import check_name, usual_span
from ...systems.kinds import AnySystem, in_axes_of, takes_names
from ...systems.psi.function import Psi
from .equilibrium_branches import equilibrium_branches
from .result import Branches

__all__ = ["Branches", "branches"]


@takes_names
def branches(
    system: AnySystem,
    psi: Psi,
    along: str,
    span: tuple[float, float] | None = None,
    z: ArrayLike = (),
    with_cycles: bool = True,
) -> Branches:
    """Follow limit directions, critical sets and limit cycles along one parameter, and mark where something changes.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    along : str
        What varies: one of a, b, d, f1, f2 that is a number, a parameter of the system, a slow variable z1, z2, ...
        (z is z1), or the parameter of Psi, such as n.
    span : (low, high), optional
        By default about the present value, as wide as what varies is large: `layer_problem.vary.usual_span`.
    z : (m,) floats
    with_cycles : bool
        Limit cycles take longer: without them `Branches.with_cycles` finds them later.

    Returns
    -------
    Branches
        Equilibria are found exactly at some fifty values of a grid, and Newton's method solves for the bifurcations
        between them, to the last digits: two that undo each other within a step, to which it does not come, are
        missed. Changes at a kink of U are found by bisection; what happens exactly at an end of the span is not told.
        Places are in the axes of the system, which for an `ELinear.from_matrix` are those of its normal form at each
        value. Branches of cycles are begun at Hopf points, at ends on the equator, and at the cycles seen at some
        values: one that has none of these is not seen.

    Raises
    ------
    ValueError
        Nothing variable has this name, the span is empty or beyond what the parameter may be, or z does not fit.

    Examples
    --------
    >>> import codim2_core as c2
    >>> found = c2.branches(c2.ELinear(172, 186, -200, (-86, -93)), c2.psi.hill(3), along="n", span=(1, 4))
    >>> [(one.kind, round(one.value, 6)) for one in found.special]
    [('node-focus', 1.333333), ('Hopf', 2.20155), ('node-focus', 3.211105)]
    >>> cycle = found.cycles[0]
    >>> cycle.start.kind, cycle.end.kind, bool(cycle.stable[-1]), round(float(cycle.period[-1]), 6)
    ('Hopf', 'span', True, 0.606696)
    """
    system = in_axes_of(system, along)
    check_name(system, psi, z, "along", along)
    span = usual_span(system, psi, z, along) if span is None else span
    found = equilibrium_branches(system, psi, along, span, z)
    return found.with_cycles() if with_cycles else found
