"""The examples as the explorer offers them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

from ..systems.elinear import ELinear
from ..systems.typed import System
from .example import Example
from .literature import ball_on_turntable, tilting_block, unit_vector_control
from .paper import attracting_repelling, ball_in_pool, nonunique_sliding


def _example(
    title: str,
    label: str,
    sentence: str,
    make: Callable[..., ELinear | System],
    ranges: dict[str, tuple[float, float]],
    z: tuple[float, ...],
    slow: tuple[tuple[str, float, float], ...],
    launch: tuple[float, ...],
    t_end: float,
) -> Example:
    return Example(make.__name__, title, label, sentence, make, MappingProxyType(ranges), z, slow, launch, t_end)


catalogue: Mapping[str, Example] = MappingProxyType(
    {
        example.key: example
        for example in (
            _example(
                "Ball at the bottom of a pool",
                "sec:ballpool",
                "It sticks and rolls where |z| < 7μmg/(2K); faster, it slips.",
                ball_in_pool,
                {"mu": (0.05, 1.0), "m": (0.2, 3.0), "K": (0.0, 4.0), "g": (1.0, 20.0)},
                (4.0, 0.0),
                (("v₁", -12.0, 12.0), ("v₂", -12.0, 12.0)),
                (9.0, 3.0, 9.0, 0.0),
                5.0,
            ),
            _example(
                "Attracting and repelling directions",
                "sec:mateslidecross",
                "Trajectories that arrive within π/3 of θ = 0 cross, all others slide.",
                attracting_repelling,
                {},
                (0.5,),
                (("z", -2.0, 2.0),),
                (-1.0, 1.2, 1.0),
                3.0,
            ),
            _example(
                "Non-unique sliding",
                "sec:nonunique",
                "Two stable critical sets with different slow flows: sliding depends on the side of approach.",
                nonunique_sliding,
                {},
                (0.0,),
                (("z", -1.5, 1.5),),
                (-0.25, 0.3, -0.4),
                5.0,
            ),
            _example(
                "Block on a tilting incline",
                "orthotropic Coulomb friction",
                "It sticks while gravity lies in the friction ellipse, then slips.",
                tilting_block,
                {
                    "mu1": (0.05, 1.0),
                    "mu2": (0.05, 1.0),
                    "phi": (-math.pi, math.pi),
                    "rate": (0.0, 0.2),
                    "g": (1.0, 20.0),
                },
                (0.15,),
                (("incline", 0.0, 1.2),),
                (1.5, 1.0, 0.15),
                40.0,
            ),
            _example(
                "Unit-vector sliding-mode control",
                "a point in the plane",
                "It slides where the disturbance is smaller than the gain.",
                unit_vector_control,
                {"K": (0.2, 5.0), "k": (0.1, 3.0), "w1": (-3.0, 3.0), "w2": (-3.0, 3.0), "h": (-1.0, 1.0)},
                (1.0, 0.5),
                (("q₁", -5.0, 5.0), ("q₂", -5.0, 5.0)),
                (2.5, -1.0, 1.0, 0.5),
                6.0,
            ),
            _example(
                "Ball on a turntable",
                "rolls at 2Ω/7",
                "It rolls on a circle, at 2/7 of the turntable's rate, or slips if that is too fast.",
                ball_on_turntable,
                {"mu": (0.05, 1.0), "Omega": (-8.0, 8.0), "g": (1.0, 20.0)},
                (1.0, 0.0, 0.5, 0.0),
                (("v₁", -4.0, 4.0), ("v₂", -4.0, 4.0), ("r₁", -2.0, 2.0), ("r₂", -2.0, 2.0)),
                (1.0, 2.5, 1.0, 0.0, 0.5, 0.0),
                8.0,
            ),
        )
    }
)
