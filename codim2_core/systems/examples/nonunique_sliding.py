"""Sliding that depends on the direction of approach, Section 5.3, (5.16): two stable critical sets."""

from __future__ import annotations

from ..typed import System
from .example import Example


def nonunique_sliding() -> System:
    """Sliding that depends on the direction of approach, Section 5.3, (5.16): two stable critical sets.

    Examples
    --------
    At z = 0 two critical sets attract:

    >>> from codim2_core import critical_sets, examples, psi
    >>> critical_sets(examples.nonunique_sliding(), psi.constant(), 0.0).kinds
    ('stable node', 'saddle', 'stable node')
    """
    return System(
        U=("-c*(c - chi(z)/2)*(c + chi(z)/2)", "-s/2"),
        W=("-2*c + 1/4",),
        definitions={"chi(z)": "(1 + 2*z**2)/(1 + z**2)"},
    )


EXAMPLE = Example(
    make=nonunique_sliding,
    title="Non-unique sliding",
    label="sec:nonunique",
    source="N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, Section 5.3",
    sentence="Two stable critical sets with different slow flows: sliding depends on the side of approach.",
    ranges={},
    z=(0.0,),
    slow=(("z", -1.5, 1.5),),
    launch=(-0.25, 0.3, -0.4),
    t_end=5.0,
)
