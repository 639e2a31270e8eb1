"""Certificates of Lemma 2.6 and Remark 3.2: claims about the regularisation alone."""

from __future__ import annotations

import math

import numpy as np

from ...results.arrays import Array
from ...results.words import say
from ...systems.psi.function import Psi
from .facts import RAY_ANGLES, Certificate, verdict_of

ZETA = np.geomspace(1e-3, 1e3, 49)
CLAIM_ROUNDING = 1e-12


def e_psi(psi: Psi, xy: Array, eps: float) -> Array:
    """(2.19) as it is written, ``(x, y)/sqrt(x^2 + y^2 + eps^2 Psi((x^2 + y^2)/eps^2))``; (k, 2)."""
    s = (xy**2).sum(axis=-1)
    return xy / np.sqrt(s + eps**2 * psi(s / eps**2))[..., None]


def psi_claims(psi: Psi) -> tuple[Certificate, ...]:
    """Evaluate Lemma 2.6 and Remark 3.2; a Psi outside the class of Definition 2.3 need not meet them."""
    return _equivariant(psi), _homogeneous(psi), _one_to_one(psi), _shorter(psi), _positivity_claim(psi)


def _points() -> Array:
    return ZETA[:, None] * np.stack([np.cos(1.0 + ZETA), np.sin(1.0 + ZETA)], axis=-1)


def _equivariant(psi: Psi) -> Certificate:
    points, angles = _points(), RAY_ANGLES[1::5]
    c, s = np.cos(angles), np.sin(angles)
    turns = np.stack([np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)], axis=-2)  # from the right
    turned, here = points @ turns, e_psi(psi, points, 1.0)
    worst = float(np.abs(e_psi(psi, turned.reshape(-1, 2), 1.0).reshape(turned.shape) - here @ turns).max())
    return Certificate(
        "lem:ePsi(a)", say("lem:ePsi(a)"),
        verdict_of(worst <= CLAIM_ROUNDING), (("largest difference", worst),), say("through the square"),
    )  # fmt: skip


def _homogeneous(psi: Psi) -> Certificate:
    points, worst = _points(), 0.0
    here = e_psi(psi, points, 1.0)
    for k in (0.01, 0.3, 7.0, 1000.0):
        worst = max(worst, float(np.abs(e_psi(psi, k * points, k) - here).max()))
    return Certificate(
        "lem:ePsi(b)", say("lem:ePsi(b)"),
        verdict_of(worst <= CLAIM_ROUNDING), (("largest difference", worst),),
        say("one scale"),
    )  # fmt: skip


def _one_to_one(psi: Psi) -> Certificate:
    modulus = np.array([float(v) for v in psi.modulus(ZETA)])
    rises = bool((np.diff(modulus) >= 0.0).all() and (np.diff(modulus[modulus < 1.0 - 1e-12]) > 0.0).all())
    inner = ZETA[modulus < 0.999]
    back = np.array([float(psi.radius(float(psi.modulus(float(zeta))))) for zeta in inner])
    worst = float(np.abs(back / inner - 1.0).max(initial=0.0))
    return Certificate(
        "lem:ePsi(c)", say("lem:ePsi(c)"),
        verdict_of(rises and worst <= 1e-9 and psi.saturation == math.inf),
        (("least increase of |e_Ψ| sampled", float(np.diff(modulus).min())), ("largest |ζ(|e_Ψ|)/ζ − 1|", worst)),
        say("one place"),
    )  # fmt: skip


def _shorter(psi: Psi) -> Certificate:
    s = ZETA**2
    # 1 - |e|^2 = Psi/(s + Psi), without cancellation
    values = psi(s)
    least = float((values / (s + values)).min())
    return Certificate(
        "lem:ePsi(d)", say("lem:ePsi(d)"), verdict_of(psi.saturation == math.inf and least >= 0.0),
        (("least 1 − |e_Ψ|² sampled", least),), say("complement"),
    )  # fmt: skip


def _positivity_claim(psi: Psi) -> Certificate:
    s = ZETA[ZETA < 30.0] ** 2
    P, slope = psi(s), psi.derivative(s)
    weight = s + P
    trace, determinant = (s * (1.0 - slope) + 2.0 * P) / weight**1.5, (P - slope * s) / weight**2
    least = min(float((trace * np.sqrt(weight)).min()), float((determinant * weight).min()))
    # against differences of e_Psi itself
    zeta, h = 0.7, 1e-5
    e = lambda x, y: e_psi(psi, np.array([[x, y]]), 1.0)[0]
    D = np.stack([(e(zeta + h, 0.0) - e(zeta - h, 0.0)), (e(zeta, h) - e(zeta, -h))], axis=-1) / (2.0 * h)
    radial, tangential = psi.jacobian_factors(zeta)
    gap = float(np.abs(D - np.diag([radial, tangential])).max())
    return Certificate(
        "rem:jaco_properties", say("lem:ePsi(e)"),
        verdict_of(least >= 0.0 and gap <= 1e-7 and psi.saturation == math.inf),
        (("least of tr·|(ζ, √Ψ)| and det·(ζ² + Ψ)", least), ("difference from differences of e_Ψ", gap)),
        say("saddle stays"),
    )  # fmt: skip
