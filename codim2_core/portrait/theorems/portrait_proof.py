"""Prove a portrait: its limit directions, its critical sets and its limit cycles."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.function import Psi
from ..cycles.limit_cycles import certificate_of, excluding_theorem
from ..cycles.proof.result import Proof
from ..layer_problem.problem import LayerProblem

__all__ = ["prove_portrait"]


@takes_names
def prove_portrait(system: AnySystem, psi: Psi, z: ArrayLike = ()) -> Proof:
    """Prove a portrait: its limit directions, its critical sets, and that it has no other limit cycles than are found.

    By a certificate that a program of its own checks, `Proof.checker`, where U is a polynomial in c and s, of degree up
    to 16, and Psi constant, rational, exponential, tanh, or of the Hill family with n >= 1. Where none is found, but a
    theorem excludes limit cycles, their count is proved, and nothing else. How: `codim2_core.portrait.cycles.proof`.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats

    Returns
    -------
    Proof
        Where something is degenerate, as two limit directions that have just met, it is not proved.

    Examples
    --------
    Two stable nodes and the saddle between them, eight limit directions, and no limit cycle:

    >>> from codim2_core import prove_portrait
    >>> found = prove_portrait("nonunique-sliding")
    >>> found.critical_sets, len(found.limit_directions), found.portrait
    (('stable node', 'saddle', 'stable node'), 8, True)
    """
    problem = LayerProblem(system.at(z), psi)
    found, theorem = certificate_of(problem), excluding_theorem(problem)
    return found if found or theorem is None else Proof(True, (), theorem)
