"""Compare what a mechanism does under several laws of friction: sticks, chatters or slides."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...results.result import Results, Tabled
from ...results.tables import table_number
from ...systems.arguments import friction_laws
from ...systems.kinds import AnySystem, PsiLike, takes_names
from ..layer_problem.problem import LayerProblem
from .limit_cycles import cycles_of


@dataclass(frozen=True, slots=True)
class LawVerdict(Tabled):
    """The verdict on a system under one law of friction.

    Attributes
    ----------
    law : str
    verdict : str
        "sticks": a stable critical set, so the contact slides along Sigma, at rest but for its creep. "chatters": a
        stable limit cycle. "sticks or chatters": both, by where it starts. "undecided": a critical set with tr J = 0
        or det J = 0. Else "slides": no slip about 0 attracts.
    trace : float or None
        tr J of the critical set, of the stable one if there is one; None without one.
    creep : float or None
        Its slip speed ``eps |x2|`` where it is stable.
    chatter : float or None
        The largest slip speed on the stable limit cycle.
    notes : tuple of str
        Of the search for limit cycles.
    """

    _head_ = ("law", "verdict", "tr J", "creep", "chatter")

    law: str
    verdict: str
    trace: float | None
    creep: float | None
    chatter: float | None
    notes: tuple[str, ...] = ()

    def _row_(self) -> tuple[str, ...]:
        numbers = (self.trace, self.creep, self.chatter)
        return self.law, self.verdict, *("–" if v is None else table_number(v) for v in numbers)


class LawVerdicts(Results[LawVerdict]):
    """The verdicts of several laws, in their order."""

    __slots__ = ()


@takes_names
def compare_laws(system: AnySystem, laws: Mapping[str, tuple[PsiLike, float]], z: ArrayLike = ()) -> LawVerdicts:
    """Compare what a mechanism does under several laws of friction: sticks, chatters or slides.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    laws : mapping
        From a name to Psi and eps, in units of the velocity (x, y): see `psi.engine` and `psi.engine_eps`.
    z : (m,) floats

    Returns
    -------
    LawVerdicts

    Examples
    --------
    The same mechanism sticks under one law and chatters under another:

    >>> from codim2_core import ELinear, compare_laws, psi
    >>> laws = {name: (psi.engine(name), 1e-3) for name in ("drake", "ipc", "sap")}
    >>> for one in compare_laws(ELinear(200, 200, -172, (-100, -100)), laws):
    ...     print(f"{one.law}: {one.verdict}, tr J = {one.trace:.2f}, creep {one.creep or 0:.1e} m/s")
    drake: sticks, tr J = -19.05, creep 5.8e-04 m/s
    ipc: sticks, tr J = -10.78, creep 2.9e-04 m/s
    sap: chatters, tr J = 28.00, creep 0.0e+00 m/s
    """
    at = system.at(z)
    return LawVerdicts(
        _verdict_under(name, LayerProblem(at, law), eps) for name, (law, eps) in friction_laws(laws).items()
    )


def _verdict_under(name: str, problem: LayerProblem, eps: float) -> LawVerdict:
    stable = [C for C in problem.critical if C.kind.startswith("stable")]
    found = cycles_of(problem)
    chatters = [cycle for cycle in found if cycle.stable]
    neutral = any(C.kind in ("centre (linear)", "saddle-node", "degenerate") for C in problem.critical)
    verdict = " or ".join([*["sticks"][: len(stable)], *["chatters"][: len(chatters)]])
    C = next(iter([*stable, *problem.critical]), None)
    speed = None
    if chatters:
        r2 = (chatters[0].points ** 2).sum(axis=1)
        speed = eps * float(np.sqrt(r2 / (1.0 - r2)).max())
    return LawVerdict(
        name, verdict or ("undecided" if neutral else "slides"), None if C is None else C.trace,
        C.creep(eps) if C is not None and stable else None, speed, found.notes,
    )  # fmt: skip
