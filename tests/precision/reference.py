"""All reported numbers again in 50 digits, by other formulas, and what the rounding of the input may do to them.

`measure` compares: an error of 1 is one rounding (2^-53) of every coefficient and one of the result itself, so that
the bounds in these tests are in units of what no algorithm in doubles can avoid.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import mpmath as mp

from codim2_core import Psi
from tests.core.exact_psi import regularisation

DIGITS = 50
UNIT = mp.mpf(2) ** -53
Values = Sequence[mp.mpf]


def radius(psi: Psi, modulus: mp.mpf, start: float) -> mp.mpf:
    """The zeta with ``|e_Psi| = modulus``: Newton's method for ln zeta, where the slope is at least 1."""
    value, slope = regularisation(psi)
    if modulus == 0:
        return mp.mpf(0)
    target = mp.log(modulus / mp.sqrt((1 - modulus) * (1 + modulus)))
    zeta = mp.mpf(start)
    for _ in range(60):
        s = zeta * zeta
        P = value(s)
        step = (mp.log(zeta) - mp.log(P) / 2 - target) / (1 - s * slope(s) / P)
        zeta *= mp.exp(-step)
        if abs(step) < mp.mpf(10) ** (5 - mp.mp.dps):
            return zeta
    raise AssertionError(f"no radius for |e| = {mp.nstr(modulus, 17)} from {start}")


def derivative(psi: Psi, x: mp.mpf, y: mp.mpf) -> tuple[mp.mpf, mp.mpf, mp.mpf]:
    """D e_Psi(x, y; 1) by the quotient rule: (D11, D12, D22)."""
    value, slope = regularisation(psi)
    s = x * x + y * y
    r = mp.sqrt(s + value(s))
    k = (1 + slope(s)) / r**3
    return 1 / r - k * x * x, -k * x * y, 1 / r - k * y * y


def solution(q: Values) -> tuple[mp.mpf, mp.mpf]:
    """``-A^-1 f`` by Cramer's rule."""
    a, b, d, f1, f2 = q[:5]
    det = a * d + b * b
    return -(d * f1 + b * f2) / det, -(a * f2 - b * f1) / det


def critical(psi: Psi, start: float) -> Callable[[Values], list[mp.mpf]]:
    """The numbers of a critical set as a function of (a, b, d, f1, f2), in the order of `CRITICAL`."""

    def numbers(q: Values) -> list[mp.mpf]:
        a, b, d = q[:3]
        c, s = solution(q)
        m = mp.sqrt(c * c + s * s)
        zeta = radius(psi, m, start)
        factor = zeta / m if m else mp.mpf(0)
        x, y = c * factor, s * factor
        h = mp.sqrt(1 + zeta * zeta)
        D11, D12, D22 = derivative(psi, x, y)
        J = (a * D11 - b * D12, a * D12 - b * D22, b * D11 + d * D12, b * D12 + d * D22)
        trace, det = J[0] + J[3], J[0] * J[3] - J[1] * J[2]
        disc = trace**2 - 4 * det
        root = mp.sqrt(abs(disc))
        real, imaginary = (root, mp.mpf(0)) if disc >= 0 else (mp.mpf(0), root)
        eigen = [(trace + real) / 2, (trace - real) / 2, imaginary / 2]
        return [c, s, x, y, x / h, y / h, *J, trace, det, disc, *eigen]

    return numbers


CRITICAL = (
    "c", "s", "x2", "y2", "p1", "p2", "J11", "J12", "J21", "J22",
    "trace", "determinant", "discriminant", "eigenvalue 1", "eigenvalue 2", "frequency",
)  # fmt: skip


def direction(start: float) -> Callable[[Values], list[mp.mpf]]:
    """(theta, lambda_rho, lambda_theta) at the zero of Theta near `start`, as a function of (a, b, d, f1, f2)."""

    def numbers(q: Values) -> list[mp.mpf]:
        a, b, d, f1, f2 = q
        theta = mp.mpf(start)
        for _ in range(60):
            c, s = mp.cos(theta), mp.sin(theta)
            slope = (d - a) * (c * c - s * s) - f2 * s - f1 * c
            step = ((d - a) * s * c + f2 * c - f1 * s + b) / slope
            theta -= step
            if abs(step) < mp.mpf(10) ** (12 - mp.mp.dps):
                break
        else:
            raise AssertionError(f"no zero of Theta near {start}")
        c, s = mp.cos(theta), mp.sin(theta)
        slope = (d - a) * (c * c - s * s) - f2 * s - f1 * c
        return [theta, a * c * c + d * s * s + f1 * c + f2 * s, slope]

    return numbers


def sensitivities(function: Callable[[Values], Values], q: Sequence[float]) -> tuple[list[mp.mpf], list[mp.mpf]]:
    """Values y at q, and how far each moves when every q_i moves by its size, to first order: ``sum |q_i dy/dq_i|``."""
    exact = [mp.mpf(v) for v in q]
    values = list(function(exact))
    moves = [mp.mpf(0)] * len(values)
    h = mp.mpf(10) ** (-DIGITS // 2)
    for i, v in enumerate(exact):
        if v == 0:
            continue
        shifted = [*exact[:i], v * (1 + h), *exact[i + 1 :]]
        for k, (new, old) in enumerate(zip(function(shifted), values, strict=True)):
            moves[k] += abs(new - old) / h
    return values, moves


def measure(
    reported: Sequence[float],
    function: Callable[[Values], Values],
    q: Sequence[float],
    floors: Sequence[float] | None = None,
) -> list[float]:
    """Errors of the reported numbers in units of what one rounding of the input and of the output does.

    `floors`: sizes added to those of the numbers, where only an absolute error is promised.
    """
    with mp.workdps(DIGITS):
        values, moves = sensitivities(function, q)
        out = []
        for number, value, move, floor in zip(reported, values, moves, floors or [0.0] * len(values), strict=True):
            error, allowed = abs(mp.mpf(float(number)) - value), UNIT * (abs(value) + move + floor)
            out.append(0.0 if error == 0 else float(error / allowed) if allowed else float("inf"))
        return out
