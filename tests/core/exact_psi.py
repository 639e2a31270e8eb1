"""Psi and its derivative as functions of numbers with many digits, as def:Psi and the laws themselves write them."""

from __future__ import annotations

from collections.abc import Callable

import mpmath as mp

from codim2_core import Psi

Exact = Callable[[mp.mpf], mp.mpf]


def _tanh_slope(s: mp.mpf) -> mp.mpf:
    if s < mp.mpf(10) ** -15:  # where the closed form cancels
        return -mp.mpf(1) / 3 + 2 * s / 15
    r = mp.sqrt(s)
    return (1 - r * mp.coth(r)) / mp.sinh(r) ** 2


#: By family, and of what is typed by its text: Psi and Psi'.
_EXACT: dict[str, tuple[Exact, Exact]] = {
    "constant": (lambda s: mp.mpf(1), lambda s: mp.mpf(0)),
    "rational": (lambda s: 1 / (1 + s), lambda s: -1 / (1 + s) ** 2),
    "exponential": (lambda s: mp.exp(-s), lambda s: -mp.exp(-s)),
    "tanh": (lambda s: s / mp.sinh(mp.sqrt(s)) ** 2 if s else mp.mpf(1), _tanh_slope),
    "exp(-s)": (lambda s: mp.exp(-s), lambda s: -mp.exp(-s)),
    "1/(1 + s)**2": (lambda s: 1 / (1 + s) ** 2, lambda s: -2 / (1 + s) ** 3),
    "1/(1 + s/3)": (lambda s: 3 / (3 + s), lambda s: -3 / (3 + s) ** 2),
    "(1 + s)/(1 + 2*s)": (lambda s: (1 + s) / (1 + 2 * s), lambda s: -1 / (1 + 2 * s) ** 2),
    "1 + 0.1*sin(s)*exp(-s)": (
        lambda s: 1 + mp.mpf(0.1) * mp.sin(s) * mp.exp(-s),
        lambda s: mp.mpf(0.1) * (mp.cos(s) - mp.sin(s)) * mp.exp(-s),
    ),
}


def hill(n: float) -> tuple[Exact, Exact]:
    """The Hill family."""
    n = mp.mpf(n)
    return (
        lambda s: 3 / (3 + (4 * s) ** n),
        lambda s: -12 * n * (4 * s) ** (n - 1) / (3 + (4 * s) ** n) ** 2 if s else mp.mpf(0),
    )


def regularisation(psi: Psi) -> tuple[Exact, Exact]:
    """(Psi, Psi') of s > 0."""
    return hill(psi.parameter) if psi.family == "hill" else _EXACT[psi.text if psi.family == "custom" else psi.family]
