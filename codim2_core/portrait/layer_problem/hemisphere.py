"""The blown-up hemisphere: the charts kappa_1 and kappa_2, the disc that shows it, and the flow on it.

With ``rho = sqrt(x^2 + y^2 + eps^2)`` the point (x, y, eps) is ``rho (p, ebar)`` on the hemisphere
``|p|^2 + ebar^2 = 1``, (3.3), and p in the closed unit disc is its projection. The equator is |p| = 1.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...results.arrays import Array
from ...systems.arguments import checked_functions
from ...systems.arguments import psi as read_psi
from ...systems.frozen import FrozenSystem
from ...systems.kinds import PsiLike

__all__ = [
    "disc_from_entry", "disc_from_scaling", "e_psi", "entry_from_scaling", "flow", "height", "outside_flow",
    "scaling_from_disc",
]  # fmt: skip


def disc_from_scaling(x2: ArrayLike) -> Array:
    """``p = x2/sqrt(1 + |x2|^2)``: from the scaling chart kappa_2, (3.7), to the disc. Shapes (..., 2).

    Examples
    --------
    >>> from codim2_core import hemisphere
    >>> hemisphere.disc_from_scaling((3.0, 4.0)).round(6).tolist()
    [0.588348, 0.784465]
    """
    x2 = np.asarray(x2, float)
    return x2 / np.hypot(1.0, np.hypot(x2[..., :1], x2[..., 1:]))


def scaling_from_disc(p: ArrayLike) -> Array:
    """``x2 = p/ebar``: from the open disc to the scaling chart kappa_2. Shapes (..., 2).

    Raises
    ------
    ValueError
        A point has |p| >= 1: the equator lies at infinity in kappa_2.

    Examples
    --------
    >>> from codim2_core import hemisphere
    >>> hemisphere.scaling_from_disc((0.6, 0.0)).round(12).tolist()
    [0.75, 0.0]
    """
    p = np.asarray(p, float)
    ebar = height(p)
    if not np.all(ebar > 0.0):
        raise ValueError("a point has |p| >= 1; the chart κ₂ covers |p| < 1 only (the equator is at infinity).")
    return p / ebar[..., None]


def height(p: ArrayLike) -> Array:
    """``ebar = sqrt(1 - |p|^2)`` above each point of the closed disc; (...,) for p of shape (..., 2).

    Examples
    --------
    >>> from codim2_core import hemisphere
    >>> round(float(hemisphere.height((0.6, 0.0))), 12)
    0.8
    """
    p = np.asarray(p, float)
    r = np.hypot(p[..., 0], p[..., 1])
    return np.sqrt(np.maximum((1.0 - r) * (1.0 + r), 0.0))


def entry_from_scaling(x2: ArrayLike, rho_2: float = 0.0) -> tuple[Array, Array, Array]:
    """``kappa_12``, (3.8): from kappa_2 to the entry chart kappa_1.

    The angle is the two-argument arctangent (the paper prints arctan(y2/x2), which loses the quadrant).

    Parameters
    ----------
    x2 : (..., 2)
    rho_2 : float
        eps.

    Returns
    -------
    rho, epsilon_1, theta : (...,)

    Examples
    --------
    >>> from codim2_core import hemisphere
    >>> _, epsilon_1, theta = hemisphere.entry_from_scaling((0.0, 2.0))
    >>> round(float(epsilon_1)**2, 12), round(float(theta), 6)
    (0.2, 1.570796)
    """
    x2 = np.asarray(x2, float)
    epsilon_1 = 1.0 / np.hypot(1.0, np.hypot(x2[..., 0], x2[..., 1]))
    return rho_2 * epsilon_1, epsilon_1, np.arctan2(x2[..., 1], x2[..., 0])


def disc_from_entry(epsilon_1: ArrayLike, theta: ArrayLike) -> Array:
    """``p = xi (cos theta, sin theta)``, ``xi = sqrt(1 - epsilon_1^2)``: from kappa_1, (3.6), to the disc.

    The paper prints xi = (1 - epsilon_1)^(1/2) at (3.10); the square is missing there.

    Examples
    --------
    >>> from codim2_core import hemisphere
    >>> hemisphere.disc_from_entry(0.75, 0.0).round(6).tolist()
    [0.661438, 0.0]
    """
    epsilon_1, theta = np.asarray(epsilon_1, float), np.asarray(theta, float)
    if not ((epsilon_1 >= 0.0) & (epsilon_1 <= 1.0)).all():
        raise ValueError("epsilon_1 has a value beyond 0 to 1, where it is on the hemisphere.")
    xi = np.sqrt((1.0 - epsilon_1) * (1.0 + epsilon_1))
    return np.stack([xi * np.cos(theta), xi * np.sin(theta)], axis=-1)


def e_psi(psi: PsiLike, p: ArrayLike) -> Array:
    """``e_Psi`` at points of the closed disc, (2.19) with |(x, y, eps)| = 1. Shapes (..., 2).

    Examples
    --------
    With Psi = 1 it is p itself:

    >>> from codim2_core import ELinear, hemisphere, psi
    >>> hemisphere.e_psi(psi.constant(), (0.3, 0.4)).round(12).tolist()
    [0.3, 0.4]
    """
    p = np.asarray(p, float)
    q = p[..., 0] ** 2 + p[..., 1] ** 2
    h2 = np.maximum(1.0 - q, 0.0)
    with np.errstate(divide="ignore"):
        s = np.where(h2 > 0.0, q / np.where(h2 > 0.0, h2, 1.0), np.inf)
    shape = np.where(h2 > 0.0, h2 * read_psi("psi", psi)(np.where(np.isinf(s), 0.0, s)), 0.0)
    return p / np.sqrt(q + shape)[..., None]


def flow(coefficients: FrozenSystem, psi: PsiLike, p: ArrayLike) -> Array:
    """``p' = U - p (p.U)``, U at e_Psi(p): the layer problem (3.26) on the disc, in the time T (dT = dt/rho).

    One smooth field on the closed disc: charts kappa_1 and kappa_2 together. Shapes (..., 2).

    Examples
    --------
    It is zero on the critical set:

    >>> from codim2_core import ELinear, hemisphere, psi
    >>> at = ELinear(-2, 0, -1, (-0.5, 0)).at()
    >>> bool(abs(hemisphere.flow(at, psi.constant(), (-0.25, 0.0))).max() < 1e-15)
    True
    """
    p = np.asarray(p, float)
    U = coefficients.U(e_psi(psi, p))
    return U - p * np.sum(p * U, axis=-1, keepdims=True)


def outside_flow(coefficients: FrozenSystem, theta: ArrayLike) -> tuple[Array, Array]:
    """``(rho'/rho, theta')`` outside, (2.12): lambda_rho(theta) and Theta(theta), each (...,).

    Examples
    --------
    >>> from codim2_core import ELinear, hemisphere, psi
    >>> at = ELinear(-2, 0, -1, (-0.5, 0)).at()
    >>> [float(rate) for rate in hemisphere.outside_flow(at, 0.0)]
    [-2.5, 0.0]
    """
    theta = np.asarray(theta, float)
    c, s = np.cos(theta), np.sin(theta)
    U = coefficients.U(np.stack([c, s], axis=-1))
    return U[..., 0] * c + U[..., 1] * s, U[..., 1] * c - U[..., 0] * s


globals().update(checked_functions(__name__, globals(), __all__))


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)
