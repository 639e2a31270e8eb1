"""Names of e-linear portraits by the million: a filter, and the exact path for what it does not decide.

A portrait's name (Figure 15, Figure 16) needs four signs: those of a and d with det A (Table 1), that of
|A^-1 f| - 1 (Theorem 4.1), and whether Theta has 0, 2 or 4 zeros, which is the sign of the discriminant of the quartic

    N(t) = (b - f2) t^4 - 2 (f1 + d - a) t^3 + 2 b t^2 - 2 (f1 - d + a) t + (b + f2),   t = tan(theta/2),

and, where that is positive, two more. Each is computed with a bound on its rounding error; where a bound does not
decide, the system goes to `classify`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...portrait.classify import portrait_name
from ...portrait.layer_problem.problem import LayerProblem
from ...results.arrays import Array
from ...systems.elinear import ELinear
from ...systems.psi import constructors

#: Case I, II, III, each with its portraits: index of a name + 1 is its code; 0 is undecided.
PORTRAIT_NAMES: tuple[tuple[str, str], ...] = tuple(
    (case, f"{exists}{count}") for case in ("I", "II", "III") for exists in ("NCM", "CM") for count in (0, 2, 4)
)
#: Codes of names that index theory excludes: U turns w times along the equator, w is the sum of the indices of the
#: critical sets (a saddle's in Case II), and n limit directions allow |w - 1| <= n/2 (Section 3.1).
IMPOSSIBLE = tuple(
    code
    for code, (case, name) in enumerate(PORTRAIT_NAMES, 1)
    if 2 * abs((0 if name.startswith("N") else -1 if case == "II" else 1) - 1) > int(name[-1])
)
#: Relative error allowed for each of the polynomials below: they have fewer than 60 roundings of 2^-53, and `classify`
#: names as degenerate what is within a few roundings of it.
ERROR = 2.0**-46
MAX_COEFFICIENT, MIN_COEFFICIENT = 1e40, 1e-40  # of the coefficients: the discriminant has degree 6 in them
MIN_PRODUCT = 1e-280  # below it products may have lost digits to underflow
BLOCK_SYSTEMS = 4096  # named at once: what is computed of them stays in the processor's cache

Codes = NDArray[np.int64]


def _critical_cases(a: Array, b: Array, d: Array, f1: Array, f2: Array) -> tuple[Codes, Codes, Array]:
    """Cases (0, 1, 2; -1 undecided), whether there is a critical set, and how far both lie from a border."""
    product, square = a * d, b * b
    det, det_size = product + square, np.abs(product) + square
    opposite = (a > 0.0) != (d > 0.0)
    case = np.where(opposite, np.where(det < 0.0, 1, 2), 0)
    # |adj(A) f| against |det A|
    df1, bf2, af2, bf1 = d * f1, b * f2, a * f2, b * f1
    reach, needed = (df1 + bf2) ** 2 + (af2 - bf1) ** 2, det * det
    gap = needed - reach
    gap_size = (np.abs(df1) + np.abs(bf2)) ** 2 + (np.abs(af2) + np.abs(bf1)) ** 2 + det_size * det_size
    unsure = opposite & (np.abs(det) <= ERROR * det_size)
    unsure |= (np.abs(gap) <= ERROR * gap_size) | (gap_size < MIN_PRODUCT)
    near = np.minimum(np.abs(gap) / (needed + reach), np.abs(det) / det_size)
    return np.where(unsure, -1, case), (gap > 0.0).astype(np.int64), near


def _half_direction_counts(a: Array, b: Array, d: Array, f1: Array, f2: Array) -> tuple[Codes, Array]:
    """Half the numbers of zeros of Theta (-1 undecided), and how far they lie from a border."""
    k = d - a
    c4, c3, c2, c1, c0 = b - f2, -2.0 * (f1 + k), 2.0 * b, -2.0 * (f1 - k), b + f2
    s4 = np.abs(b) + np.abs(f2)
    s3 = 2.0 * (np.abs(f1) + np.abs(a) + np.abs(d))
    s2, s1, s0 = np.abs(c2), s3, s4
    first = 12.0 * c4 * c0 - 3.0 * c3 * c1 + c2 * c2
    first_size = 12.0 * s4 * s0 + 3.0 * s3 * s1 + s2 * s2
    second = 72.0 * c4 * c2 * c0 + 9.0 * c3 * c2 * c1 - 27.0 * c4 * c1 * c1 - 27.0 * c0 * c3 * c3 - 2.0 * c2 * c2 * c2
    second_size = (
        72.0 * s4 * s2 * s0 + 9.0 * s3 * s2 * s1 + 27.0 * s4 * s1 * s1 + 27.0 * s0 * s3 * s3 + 2.0 * s2 * s2 * s2
    )
    cube, square = 4.0 * first * first * first, second * second
    disc = cube - square
    disc_size = 4.0 * first_size * first_size * first_size + second_size * second_size
    p, p_size = 8.0 * c4 * c2 - 3.0 * c3 * c3, 8.0 * s4 * s2 + 3.0 * s3 * s3
    c44, c33, s44, s33 = c4 * c4, c3 * c3, s4 * s4, s3 * s3
    q = 64.0 * c44 * c4 * c0 - 16.0 * c44 * c2 * c2 + 16.0 * c4 * c33 * c2 - 16.0 * c44 * c3 * c1 - 3.0 * c33 * c33
    q_size = 64.0 * s44 * s4 * s0 + 16.0 * s44 * s2 * s2 + 16.0 * s4 * s33 * s2 + 16.0 * s44 * s3 * s1 + 3.0 * s33 * s33
    none = (p > ERROR * p_size) | (q > ERROR * q_size)
    both = (p < -ERROR * p_size) & (q < -ERROR * q_size)
    pairs = np.where(disc < 0.0, 1, np.where(none, 0, np.where(both, 2, -1)))
    unsure = (np.abs(disc) <= ERROR * disc_size) | (disc_size < MIN_PRODUCT)
    return np.where(unsure, -1, pairs), np.abs(disc) / (np.abs(cube) + square)


def _filter(plane: Array) -> tuple[NDArray[np.int8], Array]:
    """Return codes (0 undecided) and margins of systems (n, 5): a, b, d, f1, f2."""
    codes, margins = np.zeros(len(plane), np.int8), np.zeros(len(plane))
    for low in range(0, len(plane), BLOCK_SYSTEMS):
        rows = slice(low, low + BLOCK_SYSTEMS)
        columns = np.ascontiguousarray(plane[rows].T)
        a, _, d, *_ = columns
        size = np.abs(columns).max(axis=0)
        with np.errstate(all="ignore"):
            case, exists, near = _critical_cases(*columns)
            pairs, nearer = _half_direction_counts(*columns)
            margin = np.minimum(np.minimum(near, nearer), np.minimum(np.abs(a), np.abs(d)) / size)
        sure = (size >= MIN_COEFFICIENT) & (size <= MAX_COEFFICIENT) & (a != 0.0) & (d != 0.0)
        sure &= (case >= 0) & (pairs >= 0)
        codes[rows] = np.where(sure, 1 + 6 * case + 3 * exists + pairs, 0)
        margins[rows] = np.where(sure, margin, 0.0)
    return codes, margins


def names(plane: ArrayLike) -> tuple[NDArray[np.int8], NDArray[np.float64], dict[int, tuple[str | None, str]]]:
    """Name the portraits of e-linear systems.

    codes: Index in `PORTRAIT_NAMES` plus 1; 0 for systems with another name (see the third result); margins: How far
    from its nearest border each lies, 0 to 1; 0.0 where the exact path decided; others: By index: (case, name) of
    what is degenerate, and so in no row of `PORTRAIT_NAMES`. Raises ValueError: The shape is another, or a
    coefficient is not finite or too large. Shapes: plane (n, 5).
    """
    values = np.ascontiguousarray(plane, dtype=float)
    if values.ndim != 2 or values.shape[1] != 5:
        raise ValueError(f"plane has shape {values.shape}; give (n, 5): a, b, d, f1, f2 of each system.")
    codes, margins = _filter(values)
    others: dict[int, tuple[str | None, str]] = {}
    psi = constructors.constant()  # the name is the same for every Psi
    for i in np.flatnonzero(codes == 0):
        a, b, d, f1, f2 = values[i].tolist()
        found = portrait_name(LayerProblem(ELinear(a, b, d, (f1, f2)).at(), psi))
        pair = (found.case, found.name)
        if found.case is not None and pair in PORTRAIT_NAMES:
            codes[i] = 1 + PORTRAIT_NAMES.index((found.case, found.name))
        else:
            others[int(i)] = pair
    return codes, margins, others
