"""The rotation of the plane that brings a matrix into the normal form A = [[a, -b], [b, d]], Lemma B.1."""

from __future__ import annotations

import math
from fractions import Fraction

from .coefficients import Affine


def in_normal_form(
    a11: float, a12: float, a21: float, a22: float
) -> tuple[float, float, float, float, tuple[float, float]]:
    """Return (a, b, d, phi, (cos phi, sin phi)) of R(phi) A R(phi)^T = [[a, -b], [b, d]], Lemma B.1.

    Rotation leaves the antisymmetric part b = (A21 - A12)/2 and the trace alone and diagonalises the symmetric
    part, whose eigenvalues are mean -+ half the length of (A12 + A21, A22 - A11). Where these nearly cancel, the
    smaller one is the determinant of the symmetric part, exact, over the larger: its sign is that of the matrix.
    """
    shear, stretch = a12 + a21 + 0.0, a22 - a11 + 0.0  # no -0: atan2 would turn by a right angle
    phi = 0.5 * math.atan2(shear, stretch)
    mean, half = 0.5 * a11 + 0.5 * a22, 0.5 * math.hypot(shear, stretch)
    a, d = mean - half, mean + half
    if 0.5 * half < abs(mean) < 2.0 * half:
        F11, F12, F21, F22 = map(Fraction, (a11, a12, a21, a22))
        determinant = F11 * F22 - (F12 + F21) ** 2 / 4
        if mean > 0.0:
            a = float(determinant / Fraction(d))
        else:
            d = float(determinant / Fraction(a))
    if shear == 0.0:  # by no angle, or by a right angle: exactly
        return a, 0.5 * a21 - 0.5 * a12, d, phi, ((1.0, 0.0) if stretch >= 0.0 else (0.0, 1.0))
    return a, 0.5 * a21 - 0.5 * a12, d, phi, (math.cos(phi), math.sin(phi))


def rotate_f(given: Affine, c: float, s: float) -> tuple[float, float]:
    """Rotate f; a component that is zero, as f is an eigenvector of the symmetric part of A, is zero exactly."""
    f1, f2 = given[4:]
    u, v = c * f1 - s * f2, s * f1 + c * f2
    if min(abs(u), abs(v)) <= 1e-12 * max(abs(u), abs(v)):
        a11, a12, a21, a22, g1, g2 = map(Fraction, given)
        shear = (a12 + a21) / 2
        if g1 * (shear * g1 + a22 * g2) == g2 * (a11 * g1 + shear * g2):
            return (0.0, v) if abs(u) < abs(v) else (u, 0.0)
    return u, v
