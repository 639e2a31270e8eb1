"""A system and Psi as the compiled stepping reads them: the address of the field and its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..psi.function import Psi
from ..systems.frozen import FrozenSystem
from ..systems.typed import System
from . import fields, fields_typed
from .field_parameters import FACTOR, field_numbers
from .psi_gain import gains, gains_of_block, gains_of_blocks, has_gains

ALONE = np.zeros((1, 2))
ALONE.flags.writeable = False


@dataclass(frozen=True)
class CompiledProblem:
    """A right-hand side, scaled so that |U| is about 1.

    Attributes
    ----------
    address : int
        Of the field.
    shared : ndarray (SHARED_SIZE,)
        Its parameters.
    functions : tuple
        The compiled functions behind the addresses: they must outlive their use.
    factors : slice
        The parameters to which the right-hand side is proportional.
    own : ndarray (m, 2)
        Address and parameter of the gain of each of several Psi, see `lanes.integrate`.
    """

    address: int
    shared: NDArray[np.float64]
    functions: tuple[Any, ...]
    factors: slice
    own: NDArray[np.float64]

    @property
    def reversed(self) -> CompiledProblem:
        """The same right-hand side against time."""
        shared = self.shared.copy()
        shared[self.factors] *= -1.0
        return replace(self, shared=shared)


def problem(at: FrozenSystem, psi: Psi, backward: bool = False) -> CompiledProblem:
    """Prepare a right-hand side, compiling what is new of it.

    Parameters
    ----------
    at : Coefficients or Frozen
    psi : Psi
    backward : bool
        Against time.
    """
    if at.typed is None:
        field = fields.field(psi)
        return CompiledProblem(field.address, field_numbers(at, psi, backward), (field,), slice(0, 5), ALONE)
    function, gain = prepare(at.typed, psi)
    return CompiledProblem(
        function.address,
        field_numbers(at, psi, backward, gain.address),
        (function, gain),
        slice(FACTOR, FACTOR + 1),
        ALONE,
    )


def problems(at: FrozenSystem, psis: Sequence[Psi], backward: bool = False) -> CompiledProblem:
    """Prepare a right-hand side whose lanes have a Psi of their own, of at most BLOCKS.

    Parameters
    ----------
    at : Coefficients or Frozen
    psis : sequence of Psi
    backward : bool
        Against time.
    """
    general = None if at.typed is None else fields_typed.general_field(at.typed)
    field, smooth = (fields.field_of_gain(), True) if general is None else (general.function, general.smooth)
    mixed, each = gains_of_blocks(), [gains_of_block(psi, smooth) for psi in psis]
    own = np.array([(gain.address, psi.parameter) for gain, psi in zip(each, psis, strict=True)], float)
    factors = slice(0, 5) if general is None else slice(FACTOR, FACTOR + 1)
    shared = field_numbers(at, psis[0], backward, mixed.address)
    return CompiledProblem(field.address, shared, (field, mixed, *each), factors, own)


def prepare(system: System, psi: Psi) -> tuple[Any, Any]:
    """Compile the field of a general system, and the gain of Psi that it calls, for all z and parameters."""
    own = fields_typed.general_field(system)
    return own.function, gains(psi, own.smooth)


def is_compiled(system: System | None, psi: Psi) -> bool:
    """Whether `right_hand_side` answers without compiling anything (but for what the disk cache holds).

    Parameters
    ----------
    system : System or None
        None for e-linear systems, which share their fields.
    psi : Psi
    """
    if system is not None:
        return fields_typed.is_compiled(system) and has_gains(psi)
    return fields.is_compiled(psi)
