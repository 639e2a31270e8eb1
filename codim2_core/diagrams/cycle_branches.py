"""Branches of limit cycles of any system: by the global section where U is affine in e, else by turns on a ray."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..continuation.branches import continue_cycles
from ..continuation.result import CycleBranch, CycleBranches
from ..continuation.typed.typed_branches import continue_typed
from ..continuation.typed.typed_ends import MarkedValue
from ..layer_problem.vary import vary
from ..psi.function import Psi
from ..systems.affine import as_elinear
from ..words import say

__all__ = ["cycle_branches"]

MAX_REACH, MAX_AXES_TURN = 0.9 * math.pi, 0.1  # of the axes of the normal form along the span, and from value to value
AXES_SAMPLES = 129  # values of the span at which its axes are looked at


@dataclass(frozen=True)
class NormalForms:
    """The normal forms (lem:normalform) of an affine system along one parameter, in axes that turn little.

    Attributes
    ----------
    linear : ELinear or Coefficients
    of : (Psi, tuple of float, str)
        Psi, z and the name.
    axes : float
        Of the rotations into the normal form, half a turn apart, the ones nearest to this angle are taken.
    own : bool
        Places are told in the axes of a typed system, else in those of the normal form.
    """

    linear: Any
    of: tuple[Psi, tuple[float, ...], str]
    axes: float
    own: bool

    def rotation(self, value: float) -> tuple[float, float]:
        """Return the angle of the rotation at a value as it is, and as taken here."""
        psi, z, name = self.of
        system, _, z = vary(self.linear, psi, z, name, value)
        at = system.at(z)
        return at.rotation, at.by_rotation_near(self.axes).rotation

    def told(self, branch: CycleBranch) -> CycleBranch:
        """Return a branch with its places in the axes of the system."""
        turns = [self.rotation(v) for v in branch.value.tolist()]
        angle = np.array([-taken if self.own else plain - taken for plain, taken in turns])
        if not angle.any():
            return branch
        c, s = np.cos(angle), np.sin(angle)
        x, y = branch.section.T
        section = np.stack([c * x - s * y, s * x + c * y], axis=-1)
        section.flags.writeable = False
        return replace(branch, section=section)


def normal_forms(
    system: Any, psi: Psi, along: str, span: tuple[float, float], z: Sequence[float]
) -> NormalForms | None:
    """Return the normal forms along a span; None if U is not affine, or their axes turn too far or jump.

    They jump beside a symmetric part that is a multiple of the unit matrix.
    """
    linear: Any = as_elinear(system)
    if linear is None:
        return None
    own = system.typed is not None
    z = tuple(z) if system.frozen else tuple(system.at(z).z) or tuple(z)  # with the time of a clock
    forms = NormalForms(linear, (psi, z, along), 0.0, own)
    if getattr(linear, "given_matrix", None) is None and not (linear.frozen and linear.given is not None):
        return forms
    turns, skew = [], True
    for value in np.linspace(*span, AXES_SAMPLES).tolist():
        try:
            varied, _, at_z = vary(linear, psi, z, along, value)
            at = varied.at(at_z)
        except ValueError:
            continue
        turns.append(at.rotation)
        skew = skew and (at.given is None or at.given[1] + at.given[2] == 0.0)
    if own and not linear.frozen and skew:  # without a rotation
        (a, _), (b, d) = linear.given_matrix
        return replace(forms, linear=replace(linear, a=a, b=b, d=d, given_matrix=None))
    smooth = np.unwrap(turns, period=math.pi)
    if np.ptp(smooth) > MAX_REACH or (abs(np.diff(smooth)) > MAX_AXES_TURN).any():
        return None if own else forms
    return replace(forms, axes=0.5 * float(smooth.min() + smooth.max()))


def cycle_branches(
    system: Any,
    psi: Psi,
    along: str,
    spans: Sequence[tuple[float, float]],
    z: tuple[float, ...],
    marked: Sequence[MarkedValue],
) -> CycleBranches:
    """Continue the limit cycles along one parameter.

    Parameters
    ----------
    system, psi, along, z
        As of `branches`.
    spans : sequence of (low, high)
        In order; between them the system is not defined.
    marked : sequence of MarkedValue
        Special values of the equilibria.
    """
    whole = spans[0][0], spans[-1][1]
    forms = normal_forms(system, psi, along, whole, z)
    if forms is None or psi.saturation < math.inf:  # where the section of `continue_cycles` ends at finite |x2|
        parts = [continue_typed(system, psi, along, span, z, marked) for span in spans]
    else:
        parts = [continue_cycles(forms.linear, psi, along, span, forms.of[1], forms.axes) for span in spans]
        parts = [replace(part, branches=tuple(forms.told(branch) for branch in part)) for part in parts]
    if len(parts) == 1:
        return parts[0]
    reason = f" {say('elsewhere')} ".join(dict.fromkeys(part.reason for part in parts))
    notes = tuple(note for part in parts for note in part.notes)
    return CycleBranches(along, whole, tuple(branch for part in parts for branch in part), reason, notes)
