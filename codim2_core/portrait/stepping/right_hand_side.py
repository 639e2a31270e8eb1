"""A system and Psi as the compiled stepping reads them: the address of the field and its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...results.arrays import Array
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi
from . import fields
from .field_parameters import FACTOR, field_numbers
from .fields_typed import general_field, packed_formulas
from .psi_gain import gain_parameter, gains, gains_of_block, gains_of_blocks

ALONE = np.zeros((1, 2))
ALONE.flags.writeable = False


@dataclass(frozen=True)
class CompiledProblem:
    """A right-hand side, scaled so that |U| is about 1."""

    address: int  # of the field
    shared: Array  # (SHARED_SIZE,) Its parameters
    functions: tuple[Any, ...]  # what is behind the addresses: it must outlive their use
    factors: slice  # the parameters to which the right-hand side is proportional
    own: Array  # (m, 2) Address and parameter of the gain of each of several Psi, see `lanes.integrate`

    @property
    def reversed(self) -> CompiledProblem:
        """The same right-hand side against time."""
        shared = self.shared.copy()
        shared[self.factors] *= -1.0
        return replace(self, shared=shared)


def problem(at: FrozenSystem, psi: Psi, backward: bool = False) -> CompiledProblem:
    """Prepare a right-hand side."""
    if at.typed is None:
        field = fields.field(psi)
        shared = field_numbers(at, gain_parameter(psi), backward)
        return CompiledProblem(field.address, shared, (field, psi), slice(0, 5), ALONE)
    formulas, smooth = packed_formulas(at.key)
    return _general_problem(at, formulas, gains(psi, smooth), psi, backward, (psi,), ALONE)


def problems(at: FrozenSystem, psis: Sequence[Psi], backward: bool = False) -> CompiledProblem:
    """Prepare a right-hand side whose lanes have a Psi of their own, of at most BLOCKS."""
    formulas, smooth = (None, True) if at.typed is None else packed_formulas(at.key)
    mixed, each = gains_of_blocks(), [gains_of_block(psi, smooth) for psi in psis]
    own = np.array([(gain.address, gain_parameter(psi)) for gain, psi in zip(each, psis, strict=True)], float)
    if formulas is not None:
        return _general_problem(at, formulas, mixed, psis[0], backward, (*each, *psis), own)
    field, shared = fields.field_of_gain(), field_numbers(at, gain_parameter(psis[0]), backward, mixed.address)
    return CompiledProblem(field.address, shared, (field, mixed, *each, *psis), slice(0, 5), own)


def _general_problem(
    at: FrozenSystem, formulas: Array, gain: Any, psi: Psi, backward: bool, kept: tuple[Any, ...], own: Array
) -> CompiledProblem:
    """Prepare the right-hand side of a general system."""
    field = general_field()
    shared = field_numbers(at, gain_parameter(psi), backward, gain.address, formulas.ctypes.data)
    return CompiledProblem(field.address, shared, (field, gain, formulas, *kept), slice(FACTOR, FACTOR + 1), own)
