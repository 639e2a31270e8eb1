"""Sliding: the slow flow along a critical set."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...results.arrays import read_only
from ...systems.frozen import FrozenSystem
from ...systems.kinds import AnySystem, takes_names
from ..layer_problem.critical import CriticalSet
from ..layer_problem.disc_zeros import disc_zeros
from ..layer_problem.location import locate


@takes_names
def sliding_flow(system: AnySystem, z: ArrayLike = ()) -> NDArray[np.float64] | None:
    """Z' along the critical sets, (2.30): W at the zeros of U, whatever Psi is.

    For an e-linear system, which has at most one, it is ``-B A^-1 f + g`` (4.17): the Filippov convention,
    and the mean of z' over a limit cycle of the layer problem (Proposition 4.2).

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    z : (m,) floats

    Returns
    -------
    ndarray (m,), or (k, m) for a general system, or None
        A general system has a row for each critical set, in the order of `critical_sets`: where rows differ, sliding
        is not unique (Section 5.3). None where there is no critical set: nothing slides there.

    Examples
    --------
    It is -B A^-1 f + g:

    >>> from codim2_core import ELinear, sliding_flow
    >>> sliding_flow(ELinear(-2, 0, -1, (-0.5, 0), B=((4, 0),), g=(0.5,)), (0.0,)).tolist()
    [-0.5]
    """
    at = system.at(z)
    points = disc_zeros(at.key).e if at.affine is None else [e] if (e := locate(at).e) else []
    return at.of_critical_sets(read_only(np.stack([at.W(e) for e in points]))) if len(points) else None


def flow_on(at: FrozenSystem, critical: Sequence[CriticalSet]) -> NDArray[np.float64] | None:
    """Return what `sliding_flow` does of a frozen system whose critical sets are known."""
    return at.of_critical_sets(read_only(np.stack([C.slow_flow for C in critical]))) if critical else None
