"""The inputs of a scene that a layer may read, and the layer problem that they pose."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..portrait.layer_problem.problem import LayerProblem
from ..systems.frozen import FrozenSystem
from ..systems.kinds import AnySystem
from ..systems.psi.function import Psi


class SceneSetting(Protocol):
    """The checked parameters of a `Scene`, of which each layer reads some.

    Attributes
    ----------
    coefficients : FrozenSystem
        The system frozen at z.
    problem : LayerProblem
        Its layer problem under Psi; what one layer finds in it is kept for the others.
    """

    system: AnySystem
    psi: Psi
    z: tuple[float, ...]
    seeds: NDArray[np.float64] | None
    count: int
    launch: NDArray[np.float64]
    t_max: float | None
    length: float
    rtol: float
    atol: float
    view: float
    pixel: float
    window: tuple[float, float, float, float] | None
    cut: float
    coefficients: FrozenSystem
    problem: LayerProblem
