"""Attracting and repelling directions, Section 5.2, (5.12): some approaches cross, others slide."""

from __future__ import annotations

from ..typed import System
from .example import Example


def attracting_repelling() -> System:
    """Attracting and repelling directions, Section 5.2, (5.12): some approaches cross, others slide.

    Examples
    --------
    >>> from codim2_core import classify, examples, psi
    >>> classify(examples.attracting_repelling(), psi.constant(), 0.0).name
    '2 critical sets, 6 limit directions'
    """
    return System(U=("2*c**2 - c - 1/2", "-s"), W=("-z",))


EXAMPLE = Example(
    make=attracting_repelling,
    title="Attracting and repelling directions",
    label="sec:mateslidecross",
    source="N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, Section 5.2",
    sentence="Trajectories that come in within π/3 of θ = 0 turn away and leave Σ, all others slide.",
    ranges={},
    z=(0.5,),
    slow=(("z", -2.0, 2.0),),
    launch=(-1.0, 1.2, 1.0),
    t_end=3.0,
)
