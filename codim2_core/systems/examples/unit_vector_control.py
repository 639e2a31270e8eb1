"""Unit-vector sliding-mode control of a point in the plane under a disturbance."""

from __future__ import annotations

from ..typed import System
from .example import Example


def unit_vector_control(K: float = 2.0, k: float = 1.0, w1: float = 0.6, w2: float = 0.0, h: float = 0.4) -> System:
    """Unit-vector sliding-mode control of a point in the plane under a disturbance.

    The point q'' = u + w has the switching variable (x, y) = q' + k q and the control ``u = -k q' - K e``, so that
    ``(x, y)' = w - K e`` and, with z = q, ``z' = (x, y) - k z``. The disturbance is ``w = (w1, w2) + h z``. It slides
    where |w| < K, and then q falls as exp(-k t) whatever w does: that is what the control is for. With w = 0 it
    gets there from (x, y) in the time |(x, y)|/K.

    Source: S. Gutman, "Uncertain dynamical systems: a Lyapunov min-max approach", IEEE Trans. Automatic Control 24
    (1979) 437-443; C. Edwards, S. K. Spurgeon, "Sliding Mode Control", Taylor & Francis (1998), ch. 3.

    Parameters
    ----------
    K : float
        Gain of the control.
    k : float
        Rate at which q falls in the sliding mode.
    w1, w2 : float
        Constant part of the disturbance.
    h : float
        How it grows with q.

    Examples
    --------
    >>> from codim2_core import examples
    >>> print(examples.unit_vector_control().at(examples.catalogue["unit_vector_control"].z).m)
    2
    """
    return System(
        U=("w1 + h*z1 - K*c", "w2 + h*z2 - K*s"),
        W=("x - k*z1", "y - k*z2"),
        parameters={"K": K, "k": k, "w1": w1, "w2": w2, "h": h},
    )


EXAMPLE = Example(
    make=unit_vector_control,
    title="Unit-vector sliding-mode control",
    label="a point in the plane",
    source="S. Gutman, IEEE Trans. Automatic Control 24 (1979) 437-443",
    sentence="It slides where the disturbance is smaller than the gain.",
    ranges={"K": (0.2, 5.0), "k": (0.1, 3.0), "w1": (-3.0, 3.0), "w2": (-3.0, 3.0), "h": (-1.0, 1.0)},
    z=(1.0, 0.5),
    slow=(("q₁", -5.0, 5.0), ("q₂", -5.0, 5.0)),
    launch=(2.5, -1.0, 1.0, 0.5),
    t_end=6.0,
)
