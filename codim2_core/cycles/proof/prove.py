"""Prove how many limit cycles there are: by a theorem, or by a certificate that the independent checker accepts."""

from __future__ import annotations

import json
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...layer_problem.problem import LayerProblem
from ...words import say
from .certificate import Written, alone, written
from .check import check
from .flow import Flow, Undecided
from .result import Proof, covers

Array = NDArray[np.float64]

MOST_STEPS = 200_000  # of orbits, in search of a certificate
MOST_ROWS = 60_000  # corners and edges in one that is checked
REFUSED = (ArithmeticError, LookupError)


def proved(problem: LayerProblem, cycles: list[Array], forbidden: str | None) -> Proof:
    """Prove that a layer problem has just these limit cycles, as far as that can be done.

    Parameters
    ----------
    problem : LayerProblem
    cycles : list of ndarray (m, 2)
        Closed polylines in the projected disc, from the inside to the outside.
    forbidden : str or None
        Why a theorem forbids cycles.
    """
    nothing = tuple(False for _ in cycles)
    if problem.at.affine is None:
        return Proof(False, nothing, say("proofs e-linear only"))
    if forbidden is not None:
        return Proof(True, (), forbidden)
    if not covers(problem.psi):
        return Proof(False, nothing, say("proof not for this Psi"))
    try:
        return _all(problem, cycles)
    except Undecided as why:
        return _each(problem, cycles, say(str(why)))
    except REFUSED:
        return _each(problem, cycles, say("proof refused"))


def _all(problem: LayerProblem, cycles: list[Array]) -> Proof:
    flow = Flow(problem, MOST_STEPS, _in_kappa_2(cycles[0]) if cycles else None)
    certificate = written(problem, flow, [_crossing(flow, cycle) for cycle in cycles])
    if check(_bounded(certificate)) != (len(cycles), True):
        raise Undecided("proof refused")
    return Proof(True, tuple(True for _ in cycles), say("proved by a certificate"), json.dumps(certificate))


def _each(problem: LayerProblem, cycles: list[Array], why: str) -> Proof:
    """Prove cycles one by one, where the count is not proved; say why it is not."""
    found, certificate = [], None
    for cycle in cycles:
        try:
            flow = Flow(problem, MOST_STEPS, _in_kappa_2(cycle))
            one = alone(problem, flow, _crossing(flow, cycle))
            found.append(check(_bounded(one)) == (1, False))
            if found[-1]:
                certificate = one if certificate is None else _joined(certificate, one)
        except (Undecided, *REFUSED):
            found.append(False)
    return Proof(False, tuple(found), why, None if certificate is None else json.dumps(certificate))


def _joined(first: Written, then: Written) -> Written:
    """Join two certificates of the same system."""
    shift = len(first["walks"])
    rings = [[rows, paths, [i + shift, j + shift], *rest] for rows, paths, (i, j), *rest in then["rings"]]
    return first | {"walks": first["walks"] + then["walks"], "rings": first["rings"] + rings}


def _bounded(certificate: Written) -> Written:
    """Return a certificate, if it is not too long to be checked."""
    rows = sum(len(way) for way, _ in certificate["walks"])
    rows += sum(len(layer) for layers, *_ in certificate["rings"] for layer in layers)
    if rows > MOST_ROWS:
        raise Undecided("proof is too long")
    return certificate


def _in_kappa_2(p: Array) -> Array:
    return p / np.sqrt(1.0 - (p**2).sum(axis=1))[:, None]


def _crossing(flow: Flow, p: Array) -> float:
    """Return where a cycle crosses the section: its distance from C in e."""
    beside = [flow.beside(x, flow.mirror * y) for x, y in _in_kappa_2(p).tolist()]
    for (along, before), (onward, after) in pairwise(beside):
        if (before < 0.0) != (after < 0.0) and (along > 0.0 or onward > 0.0):
            r = along - before * (onward - along) / (after - before)
            if r > 0.0:
                return r
    raise Undecided("proof fails at a cycle")
