"""Affine combinations of limit vectors in the e-linear system: a plane, and its point on Sigma (Figure 12)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...results.arrays import Array, read_only
from ...results.words import say
from ...systems.kinds import AnySystem
from ..layer_problem.location import Existence, locate


@dataclass(frozen=True, eq=False)
class AffinePlane:
    """The plane of affine combinations of limit vectors, (4.4), and its point on Sigma, (4.5)."""

    # (2 + m, 2) A over B: the combination with (l1, l2) is ``matrix @ (l1, l2) + offset``; it is convex for |(l1,
    # l2)| <= 1
    matrix: Array
    offset: Array  # (2 + m,) f over g
    # (2,) The (l1, l2) of the point on Sigma, -A^-1 f; None where det A = 0, and so no or many points
    place: Array | None
    point: Array | None  # (m,) What the plane has on Sigma: -B A^-1 f + g
    convex: bool  # whether it is a convex combination, |A^-1 f| <= 1: then there is sliding, else crossing
    sentence: str


_SENTENCES = {
    Existence.INSIDE: say("affine: convex"),
    Existence.NONE: say("affine: not convex"),
    Existence.EQUATOR: say("affine: limit vector"),
}
_SINGULAR = say("affine: none single")


def affine_plane(system: AnySystem, z: ArrayLike = ()) -> AffinePlane | None:
    """Return the plane F_C of the e-linear system at z and its meeting point with Sigma.

    None where U is not known to be e-linear, or W not to be affine in e. Shapes: z (m,).
    """
    at = system.at(z).as_given
    if at is None or at.m != system.m:
        return None
    matrix, offset = read_only(np.concatenate([at.A, at.B])), read_only(np.concatenate([at.f, at.g]))
    location = locate(at)
    if location.singular:
        return AffinePlane(matrix, offset, None, None, False, _SINGULAR)
    size = at.size
    place = np.linalg.solve(at.A / size, -at.f / size).astype(float)
    sentence = _SENTENCES[location.existence]
    point = at.B @ place + at.g
    return AffinePlane(
        matrix, offset, read_only(place), read_only(point), location.existence is not Existence.NONE, sentence
    )
